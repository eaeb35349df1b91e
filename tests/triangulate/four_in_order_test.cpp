// The shortest handles between four polygons, longer ones too, against all places of inner triangles: for both types of
// plan, triangle after triangle, the shortest strips between them from a computation of its own.
#include "triangulate/four_in_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "support/shortest_support.h"

namespace {

using namespace shortest_support;
using Lengths = std::vector<double>;  // in order, at most so many as are wanted

void Enter(double length, size_t wanted, Lengths& to) {
  if (to.size() == wanted && length >= to.back()) return;
  to.insert(std::upper_bound(to.begin(), to.end(), length), length);
  if (to.size() > wanted) to.pop_back();
}
void EnterSums(const Lengths& a, const Lengths& b, size_t wanted, Lengths& to) {
  for (double x : a)
    for (double y : b) {
      if (to.size() == wanted && x + y >= to.back()) break;
      Enter(x + y, wanted, to);
    }
}

// The turns of a strip: x and y stand for all steps on one side in a row.
enum Shape { nothing, x, y, xy, yx, xyx, yxy, more, shapes };
constexpr Shape after_x[shapes] = {x, x, yx, xyx, yx, xyx, more, more};
constexpr Shape after_y[shapes] = {y, xy, y, xy, yxy, more, yxy, more};
bool SplitsX(int s) { return s == xyx || s == more; }
bool SplitsY(int s) { return s == yxy || s == more; }
bool XFirst(int s) { return s <= xy; }
bool YFirst(int s) { return s <= y || s == yx; }

// Strips with their lengths by shape.
using Strip = std::array<Lengths, shapes>;

class Oracle {
 public:
  Oracle(const Loops& loops, size_t wanted, bool filtered) : loops_(loops), wanted_(wanted), filtered_(filtered) {
    for (int l = 0, first = 0; l < 4; first += loops.sides[size_t(l++)]) first_[size_t(l)] = first;
    for (int l = 0; l < 4; ++l)
      for (int m = 0; m < 4; ++m)
        if (l != m) MeasureStrips(l, m);
    // A and D, which are gone through most often, are the shorter ones.
    std::array<int, 4> by = {0, 1, 2, 3};
    std::stable_sort(by.begin(), by.end(), [&](int l, int m) { return Sides(l) < Sides(m); });
    Tetrahedra(by[0], by[2], by[3], by[1]), Tetrahedra(by[0], by[3], by[2], by[1]);
    for (int a = 0; a < 4; ++a)
      for (int b = a + 1; b < 4; ++b) {
        const int c = a > 0 ? 0 : b > 1 ? 1 : 2;
        Rows(a, b, c, 6 - a - b - c);
      }
  }
  const Lengths& lengths() const { return best_; }

 private:
  int Sides(int l) const { return loops_.sides[size_t(l)]; }
  int Vertex(int l, int at) const { return first_[size_t(l)] + (at + 2 * Sides(l)) % Sides(l); }
  bool Free(int l, int a, int m, int b, int n, int c) const {
    return !filtered_ || IsFree(Vertex(l, a), Vertex(m, b), Vertex(n, c));
  }
  // From edge (a, b), by i steps forwards on loop l and j backwards on loop m.
  size_t Place(int l, int a, int m, int b, int i, int j) const {
    const int p = Sides(l), q = Sides(m);
    return size_t(((((a + 2 * p) % p) * q + (b + 2 * q) % q) * (p + 1) + i) * (q + 1) + j);
  }
  const Strip& ByShape(int l, int a, int m, int b, int i, int j) const {
    return shaped_[size_t(4 * l + m)][Place(l, a, m, b, i, j)];
  }
  const Lengths& Any(int l, int a, int m, int b, int i, int j) const {
    return any_[size_t(4 * l + m)][Place(l, a, m, b, i, j)];
  }

  void MeasureStrips(int l, int m) {
    const int p = Sides(l), q = Sides(m);
    auto& shaped = shaped_[size_t(4 * l + m)];
    auto& any = any_[size_t(4 * l + m)];
    shaped.resize(size_t(p * q * (p + 1) * (q + 1))), any.resize(shaped.size());
    for (int a = 0; a < p; ++a)
      for (int b = 0; b < q; ++b) {
        for (int i = 0; i <= p; ++i)
          for (int j = 0; j <= q; ++j) Extend(l, a, m, b, i, j);
        for (int i = 0; i <= p; ++i)
          for (int j = 0; j <= q; ++j) {
            // Not all steps of both loops, nor all of one in a row: an edge would come twice.
            Strip& strip = shaped[Place(l, a, m, b, i, j)];
            for (int s = 0; s < shapes; ++s) {
              if ((i == p && j == q) || (i == p && !SplitsX(s)) || (j == q && !SplitsY(s))) strip[size_t(s)].clear();
              for (double length : strip[size_t(s)]) Enter(length, wanted_, any[Place(l, a, m, b, i, j)]);
            }
          }
      }
  }
  void Extend(int l, int a, int m, int b, int i, int j) {
    auto& shaped = shaped_[size_t(4 * l + m)];
    Strip& strip = shaped[Place(l, a, m, b, i, j)];
    const double edge = loops_.Distance(Vertex(l, a + i), Vertex(m, b - j));
    if (i + j == 0) strip[nothing] = {edge};
    const bool by_x = i > 0 && Free(l, a + i - 1, l, a + i, m, b - j),
               by_y = j > 0 && Free(m, b - j, m, b - j + 1, l, a + i);
    for (size_t s = 0; s < shapes; ++s) {
      if (by_x)
        for (double length : shaped[Place(l, a, m, b, i - 1, j)][s]) Enter(length + edge, wanted_, strip[after_x[s]]);
      if (by_y)
        for (double length : shaped[Place(l, a, m, b, i, j - 1)][s]) Enter(length + edge, wanted_, strip[after_y[s]]);
    }
  }

  // All polygons have three strips. From the triangle ABC strips lead away between A and B, B and C, C and A; then
  // round D, backwards, from the triangle ABD past A, C and B.
  void Tetrahedra(int A, int B, int C, int D) {
    for (int a = 0; a < Sides(A); ++a)
      for (int b = 0; b < Sides(B); ++b)
        for (int c = 0; c < Sides(C); ++c)
          for (int i = 0; Free(A, a, B, b, C, c) && i <= Sides(A); ++i)
            for (int d = 0; d < Sides(D); ++d) RoundD(A, a, B, b, C, c, D, d, i);
  }
  void RoundD(int A, int a, int B, int b, int C, int c, int D, int d, int i) {
    const int p = Sides(A), q = Sides(B), r = Sides(C), s = Sides(D);
    const auto table = [s](int n) {
      return std::vector<std::vector<Lengths>>(size_t(n + 1), std::vector<Lengths>(size_t(s + 1)));
    };
    // By steps on C between C and A, or between B and C; on B between B and C; and steps on D so far.
    auto at_c = table(r), past_c = table(r), at_b = table(q);
    for (int e = 0; e <= s; ++e)
      for (int k = 0; i + k <= p; ++k)
        for (int l = 0; l <= r; ++l)
          if (Free(A, a - k, C, c + l, D, d - e))
            EnterSums(Any(A, a + i, D, d, p - i - k, e), Any(C, c, A, a, l, k), wanted_, at_c[size_t(l)][size_t(e)]);
    for (int e = 0; e <= s; ++e)
      for (int l = 0; l <= r; ++l)
        for (int m = 0; l + m <= r; ++m)
          for (int f = e; f <= s; ++f)
            EnterSums(at_c[size_t(l)][size_t(e)], Any(C, c + l, D, d - e, r - l - m, f - e), wanted_,
                      past_c[size_t(m)][size_t(f)]);
    for (int e = 0; e <= s; ++e)
      for (int m = 0; m <= r; ++m)
        for (int n = 0; n <= q; ++n)
          if (Free(C, c - m, B, b + n, D, d - e))
            EnterSums(past_c[size_t(m)][size_t(e)], Any(B, b, C, c, n, m), wanted_, at_b[size_t(n)][size_t(e)]);
    for (int n = 0; n <= q; ++n)
      for (int j = 0; n + j <= q; ++j) {
        if (!Free(B, b - j, A, a + i, D, d)) continue;
        Lengths past_b;
        for (int e = 0; e <= s; ++e)
          EnterSums(at_b[size_t(n)][size_t(e)], Any(B, b + n, D, d - e, q - n - j, s - e), wanted_, past_b);
        EnterSums(past_b, Any(A, a, B, b, i, j), wanted_, best_);
      }
  }

  // A and B have four strips: past C, a strip between them, past D, another strip.
  void Rows(int A, int B, int C, int D) {
    const int p = Sides(A), q = Sides(B);
    const auto round_c = Round(A, B, C), round_d = Round(A, B, D);
    for (int a = 0; a < p; ++a)
      for (int b = 0; b < q; ++b)
        for (int i = 0; i <= p; ++i)
          for (int j = 0; j <= q; ++j) {
            if (i + j == 0) continue;  // the strips on both sides of C would meet
            const Lengths& c = round_c[Place(A, a, B, b, i, j)];
            for (int i1 = 0; i + i1 <= p; ++i1)
              for (int j1 = 0; j + j1 <= q; ++j1)
                for (int k = 0; i + i1 + k <= p; ++k)
                  for (int l = 0; j + j1 + l <= q; ++l) {
                    if (k + l == 0) continue;
                    const int at_a = a + i + i1, at_b = b - j - j1;
                    EnterRow(c, round_d[Place(A, at_a, B, at_b, k, l)], ByShape(A, a + i, B, b - j, i1, j1),
                             ByShape(A, at_a + k, B, at_b - l, p - i - i1 - k, q - j - j1 - l), i == 0 && l == 0,
                             j == 0 && k == 0);
                  }
          }
  }
  // Where one polygon has no steps past C, and the other none past D, strips that turn there have an edge in common.
  void EnterRow(const Lengths& c, const Lengths& d, const Strip& one, const Strip& two, bool slit_a, bool slit_b) {
    if (c.empty() || d.empty()) return;
    for (int s = 0; s < shapes; ++s)
      for (int t = 0; t < shapes; ++t) {
        const Lengths &first = one[size_t(s)], &second = two[size_t(t)];
        if (first.empty() || second.empty() || (slit_a && YFirst(s) && XFirst(t)) || (slit_b && XFirst(s) && YFirst(t)))
          continue;
        if (best_.size() == wanted_ && c[0] + d[0] + first[0] + second[0] >= best_.back()) continue;
        Lengths ends, strips;
        EnterSums(c, d, wanted_, ends), EnterSums(first, second, wanted_, strips);
        EnterSums(ends, strips, wanted_, best_);
      }
  }
  // From an edge (a, b), past polygon C, to another.
  std::vector<Lengths> Round(int A, int B, int C) const {
    const int p = Sides(A), q = Sides(B), r = Sides(C);
    std::vector<Lengths> all(size_t(p * q * (p + 1) * (q + 1)));
    for (int a = 0; a < p; ++a)
      for (int b = 0; b < q; ++b)
        for (int c = 0; c < r; ++c)
          for (int i = 0; Free(A, a, B, b, C, c) && i <= p; ++i)
            for (int j = 0; j <= q; ++j)
              for (int v = 0; v <= r; ++v)
                if (Free(A, a + i, B, b - j, C, c - v))
                  EnterSums(Any(A, a, C, c, i, v), Any(C, c, B, b, r - v, j), wanted_, all[Place(A, a, B, b, i, j)]);
    return all;
  }

  const Loops& loops_;
  size_t wanted_;
  bool filtered_;
  std::array<int, 4> first_ = {};
  std::array<std::vector<Strip>, 16> shaped_;
  std::array<std::vector<Lengths>, 16> any_;
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
  ASSERT_FALSE(want.empty());
  ASSERT_EQ(found.lengths.size(), want.size());
  for (size_t i = 0; i < want.size(); ++i) ASSERT_NEAR(found.lengths[i], want[i], rounding * want[i]) << "number " << i;
}

TEST(ShortestFour, OfShortLoopsAsAllTriangles) {
  for (Positions positions : all_positions)
    for (unsigned seed = 1; seed <= 2; ++seed) ExpectAsOracle({3, 4, 3, 5}, positions, seed, 8, false);
}

TEST(ShortestFourLong, OfLongerLoopsAsAllTriangles) {
  for (Positions positions : all_positions) ExpectAsOracle({16, 3, 3, 3}, positions, 1, 6, false);
  for (Positions positions : all_positions) ExpectAsOracle({3, 4, 17, 3}, positions, 1, 6, false);
}

// Loops squeezed together: very many ways in which an edge would come twice are shorter than all handles.
TEST(ShortestFour, OfTinyLoopsAsAllTriangles) {
  for (const auto& sides : std::vector<std::vector<int>>{{3, 4, 9, 3}, {3, 4, 12, 3}, {4, 5, 3, 6}})
    ExpectAsOracle(sides, Positions::tiny, 2, 8, false);
}

// So many that every case of polygons in a row is among them, next to what it leaves out.
TEST(ShortestFourLong, ManyOfShortLoopsAsAllTriangles) {
  for (Positions positions : {Positions::random, Positions::tiny}) {
    ExpectAsOracle({3, 3, 3, 3}, positions, 3, 1000, false);
    ExpectAsOracle({3, 4, 3, 3}, positions, 4, 500, true);
  }
}

// The search ends within some seconds at most, in any kind of positions.
TEST(ShortestFour, EndSoon) {
  constexpr tpa::u64 work = tpa::u64{1} << 22;
  for (const auto& sides : std::vector<std::vector<int>>{{3, 4, 9, 3}, {3, 3, 3, 15}, {6, 6, 6, 6}, {10, 5, 4, 3}})
    for (Positions positions : all_positions) {
      SCOPED_TRACE(handle_support::Name(sides) + " positions " + std::to_string(int(positions)));
      const Loops loops = Make(sides, positions, 2);
      const Found found = Find(loops, 8, tpa::no_way, work);
      EXPECT_TRUE(found.complete);
      EXPECT_EQ(found.handles.size(), 8u);
      ExpectHandlesInOrder(found, loops);
    }
}

TEST(ShortestFour, HaveFreeFacesOnly) {
  for (Positions positions : {Positions::random, Positions::tied}) ExpectAsOracle({3, 16, 3, 3}, positions, 2, 6, true);
}

TEST(ShortestFourLong, OfUnequalLoopsAsAllTriangles) { ExpectAsOracle({6, 16, 3, 3}, Positions::random, 1, 3, false); }

TEST(ShortestFour, LongLoopsGiveHandlesInOrder) {
  for (const auto& sides : std::vector<std::vector<int>>{{20, 4, 3, 3}, {16, 5, 4, 3}, {18, 16, 3, 3}, {70, 3, 3, 3}}) {
    const Loops loops = Make(sides, Positions::random, 5);
    ExpectSixteenInOrder(Find(loops, 16, tpa::no_way, all_work), loops);
  }
}

// Other bases, another cut round the longest loop.
TEST(ShortestFour, DoNotDependOnNumbers) {
  const Loops loops = Make({4, 19, 3, 5}, Positions::random, 11);
  Loops renumbered;
  for (const int l : {2, 0, 3, 1}) {
    std::vector<Vec3> loop;
    for (int v = 0; v < loops.mu; ++v)
      if (loops.of[size_t(v)] == l) loop.push_back(loops.points[size_t(v)]);
    std::rotate(loop.begin(), loop.begin() + 1 + l, loop.end());
    renumbered.Add(loop);
  }
  const Found one = Find(loops, 12, tpa::no_way, all_work), other = Find(renumbered, 12, tpa::no_way, all_work);
  ASSERT_EQ(one.lengths.size(), other.lengths.size());
  for (size_t i = 0; i < one.lengths.size(); ++i)
    EXPECT_NEAR(one.lengths[i], other.lengths[i], rounding * one.lengths[i]);
}

TEST(ShortestFour, TellWhenTheWorkIsDone) {
  for (const auto& sides : std::vector<std::vector<int>>{{20, 20, 20, 20}, {200, 3, 4, 5}}) {
    const Loops loops = Make(sides, Positions::random, 1);
    for (const tpa::u64 work : {tpa::u64{0}, tpa::u64{20000}}) {
      const Found found = Find(loops, 16, tpa::no_way, work);
      EXPECT_FALSE(found.complete);
      ExpectHandlesInOrder(found, loops);
    }
  }
}

// With less room fewer handles are found, the first ones; with too little, none is looked for.
TEST(ShortestFour, FindAsManyAsThereIsRoomFor) {
  const Loops loops = Make({17, 4, 3, 3}, Positions::random, 4);
  const Found all = Find(loops, 8, tpa::no_way, all_work);
  tpa::ShortLoops input{loops.points.data(), {0, 17, 21, 24, 27}, {}};
  for (const tpa::u32 fit : {0u, 1u, 5u}) {
    const tpa::u64 bytes = fit > 0 ? tpa::four_scratch_bytes(input, fit) : tpa::four_scratch_bytes(input, 1) - 1;
    std::vector<double> room(bytes / sizeof(double) + 1);
    tpa::ShortestScratch scratch;
    ASSERT_EQ(tpa::lay_out_four(input, 8, reinterpret_cast<tpa::u8*>(room.data()), bytes, scratch), fit > 0);
    if (fit == 0) continue;
    bool complete = false;
    ASSERT_EQ(tpa::shortest_of_four(input, tpa::no_way, all_work, scratch, complete), fit);
    EXPECT_TRUE(complete);
    for (tpa::u32 n = 0; n < fit; ++n) EXPECT_EQ(scratch.found.best[n].length, all.lengths[n]);
  }
}

}  // namespace
