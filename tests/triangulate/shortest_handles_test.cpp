// The shortest handles between three and four polygons against an enumeration that knows nothing of strips: faces are
// added edge by edge, and a branch is given up only where the faces that it has, and the cheapest ones for the polygon
// edges that it lacks, are longer than what the library found.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "support/handle_support.h"
#include "support/share.h"
#include "support/shortest_support.h"
#include "triangulate/four_in_order.h"

namespace {

using tpa::u32;
using tpa::u8;
using tpa::Vec3;
using namespace handle_support;
using namespace shortest_support;

class Enumeration {
 public:
  Enumeration(const Loops& loops, double limit, bool filtered)
      : loops_(loops),
        limit_(limit),
        filtered_(filtered),
        star_(size_t(loops.mu), std::vector<int>(size_t(loops.mu), -1)),
        degree_(size_t(loops.mu)) {
    for (int a = 0; a < loops.mu; ++a) {
      double least = limit;
      for (int c = 0; c < loops.mu; ++c)
        if (loops.of[size_t(c)] != loops.of[size_t(a)])
          least = std::min(least, loops.Half(a, c) + loops.Half(loops.next[size_t(a)], c));
      least_.push_back(least);
      rest_ += least;
    }
    Extend();
    std::sort(lengths_.begin(), lengths_.end());
  }
  const std::vector<double>& lengths() const { return lengths_; }

 private:
  bool PolygonEdge(int a, int b) const { return loops_.next[size_t(a)] == b; }
  bool Used(int a, int b) const { return star_[size_t(a)][size_t(b)] >= 0; }
  bool Missing(int a, int b) const { return !Used(a, b) && !PolygonEdge(b, a) && (PolygonEdge(a, b) || Used(b, a)); }
  bool Allowed(int a, int b) const {
    return !Used(a, b) && !PolygonEdge(b, a) && (loops_.of[size_t(a)] != loops_.of[size_t(b)] || PolygonEdge(a, b));
  }
  // The faces at v from its next vertex round: all of them once the last one has come back to the previous vertex.
  bool FanIsSound(int v, bool& closed) const {
    int at = loops_.next[size_t(v)], steps = 0;
    for (; star_[size_t(v)][size_t(at)] >= 0; ++steps) at = star_[size_t(v)][size_t(at)];
    closed = PolygonEdge(at, v);
    return !closed || steps == degree_[size_t(v)];
  }
  void Put(const Face& f, int sign) {
    for (size_t c = 0; c < 3; ++c) {
      const int a = f[c], b = f[(c + 1) % 3];
      star_[size_t(a)][size_t(b)] = sign > 0 ? f[(c + 2) % 3] : -1;
      degree_[size_t(a)] += sign;
      length_ += sign * loops_.Half(a, b);
      if (PolygonEdge(a, b)) rest_ -= sign * least_[size_t(a)];
    }
    sign > 0 ? faces_.push_back(f) : faces_.pop_back();
  }
  bool Sound(const Face& f) const {
    bool closed = false;
    return FanIsSound(f[0], closed) && FanIsSound(f[1], closed) && FanIsSound(f[2], closed);
  }
  void Close(int a, int b) {
    for (int c = 0; c < loops_.mu; ++c) {
      bool closed = false;
      if (c == a || c == b || !Allowed(b, c) || !Allowed(c, a)) continue;
      if ((FanIsSound(c, closed) && closed) || (filtered_ && !IsFree(a, b, c))) continue;
      const double length = length_, rest = rest_;  // put back as they were, so that rounding does not add up
      Put({a, b, c}, 1);
      if (Sound({a, b, c})) Extend();
      Put({a, b, c}, -1);
      length_ = length, rest_ = rest;
    }
  }
  void Extend() {
    if (static_cast<int>(faces_.size()) > loops_.Faces() || length_ + rest_ > limit_) return;
    for (int a = 0; a < loops_.mu; ++a)
      for (int b = 0; b < loops_.mu; ++b)
        if (a != b && Missing(a, b)) return Close(a, b);
    if (WhyNotSphere(faces_, loops_.sides).empty()) lengths_.push_back(length_);
  }

  const Loops& loops_;
  double limit_, length_ = 0, rest_ = 0;
  bool filtered_;
  std::vector<std::vector<int>> star_;
  std::vector<int> degree_;
  std::vector<double> least_, lengths_;
  std::vector<Face> faces_;
};

// The library's handles are the shortest of all that the enumeration finds, each as often as it occurs.
void ExpectShortest(const Loops& loops, u32 wanted, bool filtered) {
  const Found found = Find(loops, wanted, tpa::no_way, all_work, filtered);
  ASSERT_TRUE(found.complete);
  ASSERT_EQ(found.handles.size(), wanted);
  ExpectHandlesInOrder(found, loops);
  const double last = found.lengths.back();
  const std::vector<double> all = Enumeration(loops, last * (1 + rounding), filtered).lengths();
  ASSERT_GE(all.size(), wanted) << "handles were found that are none";
  for (size_t i = 0; i < wanted; ++i) ASSERT_NEAR(found.lengths[i], all[i], rounding * last) << "number " << i;
}

void CompareKeys(const std::vector<std::vector<int>>& keys, unsigned seeds, u32 wanted, bool filtered = false) {
  for (const auto& sides : keys)
    for (Positions positions : all_positions)
      for (unsigned seed = 1; seed <= support::Share(seeds); ++seed) {
        SCOPED_TRACE(Name(sides) + " positions " + std::to_string(int(positions)) + " seed " + std::to_string(seed));
        ExpectShortest(Make(sides, positions, seed), wanted, filtered);
      }
}

TEST(Shortest, OfThreeAsByEnumeration) { CompareKeys({{3, 3, 3}, {4, 3, 3}, {3, 5, 3}, {4, 3, 4}, {5, 4, 3}}, 10, 24); }
// Each handle once: of many, none is missing and none comes twice.
TEST(Shortest, OfThreeAllOfMany) { CompareKeys({{3, 3, 3}}, 1, 600); }

TEST(ShortestLong, OfFourAsByEnumeration) { CompareKeys({{3, 3, 3, 3}}, 2, 8); }

TEST(Shortest, OfFourUnequalAsByEnumeration) {
  for (Positions positions : {Positions::random, Positions::tied})
    ExpectShortest(Make({3, 4, 3, 3}, positions, 1), 8, false);
}

TEST(Shortest, HaveFreeFacesOnly) {
  CompareKeys({{3, 3, 3}, {4, 3, 3}, {5, 3, 4}}, 4, 16, true);
  CompareKeys({{3, 3, 3, 3}}, 1, 4, true);
}

// No face is asked about twice.
TEST(Shortest, AskAboutEachFaceOnce) {
  const Loops loops = Make({5, 4, 6, 3}, Positions::random, 2);
  tpa::ShortLoops input{loops.points.data(), {0, 5, 9, 15, 18}, {}};
  std::set<Face> asked;
  int times = 0;
  std::pair<std::set<Face>*, int*> record{&asked, &times};
  input.filter = {[](void* caller, const tpa::HandleFace& f) {
                    const auto& [faces, count] = *static_cast<std::pair<std::set<Face>*, int*>*>(caller);
                    faces->insert(Normal(Face{int(f.v[0]), int(f.v[1]), int(f.v[2])})), ++*count;
                    return AskIsFree<tpa::HandleFace>(nullptr, f);
                  },
                  &record};
  const tpa::u64 bytes = tpa::four_scratch_bytes(input, 8);
  std::vector<double> room(bytes / sizeof(double));
  tpa::ShortestScratch scratch;
  ASSERT_TRUE(tpa::lay_out_four(input, 8, reinterpret_cast<tpa::u8*>(room.data()), bytes, scratch));
  bool complete = false;
  EXPECT_EQ(tpa::shortest_of_four(input, tpa::no_way, all_work, scratch, complete), 8u);
  EXPECT_TRUE(complete);
  EXPECT_EQ(size_t(times), asked.size());
}

// A limit takes away exactly what is longer.
TEST(Shortest, StopsAtTheLimit) {
  for (const auto& sides : std::vector<std::vector<int>>{{6, 5, 7}, {4, 5, 3, 4}}) {
    const Loops loops = Make(sides, Positions::random, 3);
    const Found all = Find(loops, 20, tpa::no_way, all_work);
    ASSERT_EQ(all.handles.size(), 20u);
    const Found some = Find(loops, 20, 0.5 * (all.lengths[6] + all.lengths[7]), all_work);
    ASSERT_EQ(some.handles.size(), 7u);
    for (size_t i = 0; i < 7; ++i) EXPECT_EQ(some.lengths[i], all.lengths[i]);
  }
}

// Turning the numbers of a loop, or the order of loops, does not change the lengths.
TEST(Shortest, DoesNotDependOnNumbers) {
  const Loops loops = Make({5, 4, 6, 3}, Positions::random, 11);
  Loops renumbered;
  for (const int l : {2, 0, 3, 1}) {
    std::vector<Vec3> loop;
    for (int v = 0; v < loops.mu; ++v)
      if (loops.of[size_t(v)] == l) loop.push_back(loops.points[size_t(v)]);
    std::rotate(loop.begin(), loop.begin() + 1 + l % 2, loop.end());
    renumbered.Add(loop);
  }
  const Found one = Find(loops, 16, tpa::no_way, all_work), other = Find(renumbered, 16, tpa::no_way, all_work);
  ASSERT_EQ(one.handles.size(), other.handles.size());
  for (size_t i = 0; i < one.handles.size(); ++i)
    EXPECT_NEAR(one.lengths[i], other.lengths[i], rounding * one.lengths[i]);
}

TEST(Shortest, LongLoopsGiveHandlesInOrder) {
  for (const auto& sides : std::vector<std::vector<int>>{{15, 15, 15}, {15, 3, 9}, {7, 6, 7, 6}}) {
    const Loops loops = Make(sides, Positions::random, 5);
    ExpectSixteenInOrder(Find(loops, 16, tpa::no_way, all_work), loops);
  }
}

// Work is bounded whatever the loops: what has been found by then is reported as incomplete.
TEST(Shortest, GivesUpWhenTheWorkIsDone) {
  const Loops loops = Make({15, 15, 15, 15}, Positions::random, 1);
  const Found found = Find(loops, 16, tpa::no_way, 20000);
  EXPECT_FALSE(found.complete);
  ExpectHandlesInOrder(found, loops);
}

}  // namespace
