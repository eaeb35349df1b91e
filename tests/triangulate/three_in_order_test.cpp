// The shortest handles between three polygons, longer ones too, against all pairs of inner triangles: for each pair,
// the shortest strips between them, one after another, from a computation of its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "support/share.h"
#include "support/shortest_support.h"
#include "tool/scenes/elementary.h"

namespace {

using namespace shortest_support;
using Lengths = std::vector<double>;  // in order, at most so many as are wanted

// The shortest strips from an edge (x, y), forwards on loop X and backwards on Y, to every edge: [steps on X][on Y].
class Strips {
 public:
  Strips(const Loops& loops, int loop_x, int x, int loop_y, int y, size_t wanted, bool filtered)
      : p_(loops.sides[size_t(loop_x)]),
        q_(loops.sides[size_t(loop_y)]),
        wanted_(wanted),
        cell_(size_t((p_ + 1) * (q_ + 1) * states)) {
    int first_x = 0, first_y = 0;
    for (int l = 0; l < loop_x; ++l) first_x += loops.sides[size_t(l)];
    for (int l = 0; l < loop_y; ++l) first_y += loops.sides[size_t(l)];
    for (int i = 0; i <= p_; ++i)
      for (int j = 0; j <= q_; ++j) {
        const int a = first_x + (x + i) % p_, b = first_y + (y + 2 * q_ - j) % q_;
        const int before_a = first_x + (x + i + p_ - 1) % p_, before_b = first_y + (y + 2 * q_ - j + 1) % q_;
        if (i + j == 0) At(0, 0, 0) = {loops.Distance(a, b)};
        const bool by_x = i > 0 && (!filtered || IsFree(before_a, a, b)),
                   by_y = j > 0 && (!filtered || IsFree(b, before_b, a));
        for (int s = 0; s < states; ++s) {
          if (by_x) Merge(At(i - 1, j, s), loops.Distance(a, b), At(i, j, AfterX(s)));
          if (by_y) Merge(At(i, j - 1, s), loops.Distance(a, b), At(i, j, AfterY(s)));
        }
      }
  }
  // Not all steps of both loops, nor all of one in a row: an edge would come twice.
  Lengths To(int i, int j) const {
    Lengths all;
    if (i == p_ && j == q_) return all;
    for (int s = 0; s < states; ++s)
      if ((i < p_ || (s & split_x)) && (j < q_ || (s & split_y)))
        for (double length : At(i, j, s)) all.push_back(length);
    std::sort(all.begin(), all.end());
    if (all.size() > wanted_) all.resize(wanted_);
    return all;
  }

 private:
  // What a path has had: a step on x, on y, the last of them on x, steps on x at two places, on y.
  static constexpr int had_x = 1, had_y = 2, last_x = 4, split_x = 8, split_y = 16, states = 32;
  static int AfterX(int s) { return s | had_x | last_x | ((s & had_x) && !(s & last_x) ? split_x : 0); }
  static int AfterY(int s) { return (s & ~last_x) | had_y | ((s & had_y) && (s & last_x) ? split_y : 0); }
  Lengths& At(int i, int j, int s) { return cell_[size_t(((i * (q_ + 1)) + j) * states + s)]; }
  const Lengths& At(int i, int j, int s) const { return cell_[size_t(((i * (q_ + 1)) + j) * states + s)]; }
  void Merge(const Lengths& from, double edge, Lengths& to) const {
    for (double length : from) to.insert(std::upper_bound(to.begin(), to.end(), length + edge), length + edge);
    if (to.size() > wanted_) to.resize(wanted_);
  }
  int p_, q_;
  size_t wanted_;
  std::vector<Lengths> cell_;
};

class Oracle {
 public:
  Oracle(const Loops& loops, size_t wanted, bool filtered) : loops_(loops), wanted_(wanted), filtered_(filtered) {
    const int p = loops.sides[0], q = loops.sides[1], r = loops.sides[2];
    const auto ab = All(0, 1), bc = All(1, 2), ca = All(2, 0);
    for (int a = 0; a < p; ++a)
      for (int b = 0; b < q; ++b)
        for (int c = 0; c < r; ++c) {
          if (filtered && !IsFree(a, p + b, p + q + c)) continue;
          // i steps on A, j on B, k on C lie between the triangles in the strips AB, AB, CA.
          for (int i = 0; i <= p; ++i)
            for (int j = 0; j <= q; ++j)
              for (int k = 0; k <= r; ++k) {
                if (filtered && !IsFree((a + i) % p, p + q + (c + k) % r, p + (b + q - j) % q)) continue;
                Combine(ab[Place(0, 1, a, b, i, j)], bc[Place(1, 2, b, c, q - j, r - k)],
                        ca[Place(2, 0, c, a, k, p - i)]);
              }
        }
  }
  const Lengths& lengths() const { return best_; }

 private:
  size_t Place(int lx, int ly, int x, int y, int i, int j) const {
    const int p = loops_.sides[size_t(lx)], q = loops_.sides[size_t(ly)];
    return size_t(((x * q + y) * (p + 1) + i) * (q + 1) + j);
  }
  std::vector<Lengths> All(int lx, int ly) const {
    const int p = loops_.sides[size_t(lx)], q = loops_.sides[size_t(ly)];
    std::vector<Lengths> all;
    for (int x = 0; x < p; ++x)
      for (int y = 0; y < q; ++y) {
        const Strips strips(loops_, lx, x, ly, y, wanted_, filtered_);
        for (int i = 0; i <= p; ++i)
          for (int j = 0; j <= q; ++j) all.push_back(strips.To(i, j));
      }
    return all;
  }
  void Combine(const Lengths& ab, const Lengths& bc, const Lengths& ca) {
    for (double x : ab)
      for (double y : bc)
        for (double z : ca) {
          if (best_.size() == wanted_ && x + y + z >= best_.back()) break;
          best_.insert(std::upper_bound(best_.begin(), best_.end(), x + y + z), x + y + z);
          if (best_.size() > wanted_) best_.pop_back();
        }
  }
  const Loops& loops_;
  size_t wanted_;
  bool filtered_;
  Lengths best_;
};

void ExpectAsOracle(const std::vector<int>& sides, Positions positions, unsigned seed, tpa::u32 wanted, bool filtered) {
  SCOPED_TRACE(handle_support::Name(sides) + " positions " + std::to_string(int(positions)) + " seed " +
               std::to_string(seed));
  const Loops loops = Make(sides, positions, seed);
  const Found found = Find(loops, wanted, tpa::no_way, all_work, filtered);
  ASSERT_TRUE(found.complete);
  ExpectHandlesInOrder(found, loops);
  const Lengths want = Oracle(loops, wanted, filtered).lengths();
  ASSERT_EQ(found.lengths.size(), want.size());
  for (size_t i = 0; i < want.size(); ++i) ASSERT_NEAR(found.lengths[i], want[i], rounding * want[i]) << "number " << i;
}

TEST(ShortestThree, OfShortLoopsAsAllPairsOfTriangles) {
  for (const auto& sides : std::vector<std::vector<int>>{{3, 3, 3}, {3, 5, 4}, {6, 4, 7}, {7, 7, 7}})
    for (Positions positions : all_positions)
      for (unsigned seed = 1; seed <= support::Share(4u); ++seed) ExpectAsOracle(sides, positions, seed, 12, false);
}

TEST(ShortestThree, OfLongerLoopsAsAllPairsOfTriangles) {
  for (const auto& sides : std::vector<std::vector<int>>{{16, 3, 3}, {3, 17, 4}, {16, 5, 4}, {6, 5, 20}})
    for (Positions positions : all_positions) ExpectAsOracle(sides, positions, 1, 8, false);
}

TEST(ShortestThree, HaveFreeFacesOnly) {
  for (const auto& sides : std::vector<std::vector<int>>{{5, 6, 4}, {16, 3, 4}})
    for (Positions positions : {Positions::random, Positions::tied}) ExpectAsOracle(sides, positions, 1, 8, true);
}

// Three rings about the corners of a triangle, wobbly.
Loops Rings(const std::vector<int>& sides, unsigned seed) {
  std::mt19937 engine(seed);
  const auto unit = [&engine] { return static_cast<double>(engine()) / 4294967296.0; };
  constexpr double turn = 6.283185307179586;
  Loops loops;
  for (size_t l = 0; l < 3; ++l) {
    std::vector<Vec3> loop;
    const double at = turn * static_cast<double>(l) / 3;
    for (int v = 0; v < sides[l]; ++v) {
      const double t = turn * v / sides[l];
      loop.push_back({1.25 * tool::cosine(at) + tool::cosine(t) + 0.05 * unit(),
                      1.25 * tool::sine(at) - tool::sine(t) + 0.05 * unit(),
                      0.4 * static_cast<double>(l) + 0.05 * unit()});
    }
    loops.Add(loop);
  }
  return loops;
}

TEST(ShortestThree, LongLoopsGiveHandlesInOrder) {
  for (const auto& sides :
       std::vector<std::vector<int>>{{16, 16, 16}, {20, 20, 20}, {30, 30, 30}, {24, 9, 7}, {200, 20, 40}}) {
    SCOPED_TRACE(handle_support::Name(sides));
    const Loops loops = Rings(sides, 1);
    const Found found = Find(loops, 16, tpa::no_way, all_work);
    EXPECT_TRUE(found.complete);
    ASSERT_EQ(found.handles.size(), 16u);
    ExpectHandlesInOrder(found, loops);
  }
}

// Regular rings one above the other: so many handles of equal length that they cannot all be looked at.
TEST(ShortestThree, OfEqualOnesAFewWillDo) {
  for (const int n : {9, 16, 24}) {
    Loops loops;
    for (int l = 0; l < 3; ++l) {
      std::vector<Vec3> loop;
      for (int v = 0; v < n; ++v) {
        const double t = 6.283185307179586 * v / n;
        loop.push_back({tool::cosine(t), l == 1 ? tool::sine(t) : -tool::sine(t), 0.7 * l});
      }
      loops.Add(loop);
    }
    const Found found = Find(loops, 16, tpa::no_way, 1u << 24);
    EXPECT_TRUE(found.complete) << n;
    ASSERT_EQ(found.handles.size(), 16u);
    ExpectHandlesInOrder(found, loops);
    EXPECT_NEAR(found.lengths[0], found.lengths[15], 1e-9);
  }
}

// The shortest through each of the polygon's edges in turn: the search begins with one of them, and may not matter.
TEST(ShortestThree, DoNotDependOnNumbers) {
  const Loops loops = Rings({21, 18, 24}, 2);
  const Found one = Find(loops, 8, tpa::no_way, all_work);
  for (const int by : {1, 5, 11}) {
    Loops turned;
    for (const int l : {1, 2, 0}) {
      std::vector<Vec3> loop;
      for (int v = 0; v < loops.mu; ++v)
        if (loops.of[size_t(v)] == l) loop.push_back(loops.points[size_t(v)]);
      std::rotate(loop.begin(), loop.begin() + by, loop.end());
      turned.Add(loop);
    }
    const Found other = Find(turned, 8, tpa::no_way, all_work);
    ASSERT_EQ(other.lengths.size(), one.lengths.size());
    for (size_t i = 0; i < one.lengths.size(); ++i)
      EXPECT_NEAR(other.lengths[i], one.lengths[i], rounding * one.lengths[i]);
  }
}

// Seen from the other side: all loops the other way round.
TEST(ShortestThree, AreTheSameInAMirror) {
  const Loops loops = Rings({17, 12, 20}, 3);
  Loops mirrored;
  for (const int l : {0, 2, 1}) {
    std::vector<Vec3> loop;
    for (int v = loops.mu; v-- > 0;)
      if (loops.of[size_t(v)] == l) loop.push_back(loops.points[size_t(v)]);
    mirrored.Add(loop);
  }
  const Found one = Find(loops, 8, tpa::no_way, all_work), other = Find(mirrored, 8, tpa::no_way, all_work);
  ASSERT_EQ(other.lengths.size(), one.lengths.size());
  for (size_t i = 0; i < one.lengths.size(); ++i)
    EXPECT_NEAR(other.lengths[i], one.lengths[i], rounding * one.lengths[i]);
}

TEST(ShortestThree, StopAtTheLimit) {
  const Loops loops = Rings({18, 17, 16}, 1);
  const Found all = Find(loops, 12, tpa::no_way, all_work);
  ASSERT_EQ(all.lengths.size(), 12u);
  const Found some = Find(loops, 12, 0.5 * (all.lengths[4] + all.lengths[5]), all_work);
  EXPECT_TRUE(some.complete);
  EXPECT_EQ(some.lengths, Lengths(all.lengths.begin(), all.lengths.begin() + 5));
}

TEST(ShortestThree, TellWhenTheWorkIsDone) {
  const Loops loops = Rings({60, 60, 60}, 1);
  for (const tpa::u64 work : {tpa::u64{100}, tpa::u64{1200000}, tpa::u64{1800000}}) {
    const Found found = Find(loops, 16, tpa::no_way, work);
    EXPECT_FALSE(found.complete);
    ExpectHandlesInOrder(found, loops);
  }
}

}  // namespace
