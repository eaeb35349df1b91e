// SPDX-License-Identifier: MIT
// Strips against all strips between small pairs of loops, and against tables of the least lengths for longer loops.
#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "support/candidates_support.h"
#include "support/share.h"
#include "tool/scenes/elementary.h"

namespace strip_candidates_test {
namespace {

using namespace candidates_support;
using support::Least;
using support::Share;

// Every strip between two loops: start at edge (0, l), any order of steps, unless all steps on one loop come
// in a row.
void EveryStrip(const Loops& loops, const std::function<void(double)>& visit) {
  const size_t p = loops[0].size(), q = loops[1].size();
  for (size_t l = 0; l < q; ++l)
    for (unsigned word = 0; word < 1u << (p + q); ++word) {
      if (static_cast<size_t>(__builtin_popcount(word)) != p || !(word >> (p + q - 1))) continue;
      size_t changes = 0;
      for (size_t t = 0; t < p + q; ++t) changes += ((word >> t) & 1) != ((word >> ((t + 1) % (p + q))) & 1);
      if (changes == 2) continue;
      double sum = 0;
      size_t i = 0, j = l;
      for (size_t t = 0; t < p + q; ++t) {
        sum += tpa::length(loops[0][i] - loops[1][j]);
        if ((word >> t) & 1)
          i = (i + 1) % p;
        else
          j = (j + q - 1) % q;
      }
      visit(sum);
    }
}

// The library's shortest strips between two loops, `wanted` at most.
struct StripsInOrder {
  Loops points;
  std::vector<Vec3> joined;
  std::vector<tpa::u32> numbers;
  std::vector<double> scratch = std::vector<double>(1 << 14);
  tpa::StripOrder order;

  StripsInOrder(const Loops& p, tpa::u32 wanted, const tpa::FaceFilter& filter = {}) : points(p), joined(p[0]) {
    joined.insert(joined.end(), p[1].begin(), p[1].end());
    numbers.resize(joined.size());
    std::iota(numbers.begin(), numbers.end(), 0u);
    const tpa::StripLoops pair = Pair();
    EXPECT_TRUE(tpa::lay_out_strip_order(pair.x.size, pair.y.size, wanted, reinterpret_cast<tpa::u8*>(scratch.data()),
                                         8 * scratch.size(), order));
    tpa::find_strips(pair, filter, order);
  }
  tpa::StripLoops Pair() const {
    const tpa::u32 p = static_cast<tpa::u32>(points[0].size()), q = static_cast<tpa::u32>(points[1].size());
    return {joined.data(), {numbers.data(), p}, {numbers.data() + p, q}};
  }
  Faces Get(tpa::u32 number) const {
    Faces faces(joined.size());
    tpa::write_strip(Pair(), order, number, faces.data());
    return faces;
  }
};

TEST(Candidates, StripsComeInOrderOfLength) {
  for (unsigned seed = 1; seed <= Share(90u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Maker maker(seed);
    const int p = 3 + static_cast<int>(maker.engine() % 4), q = 3 + static_cast<int>(maker.engine() % 4);
    const StripsInOrder found(maker.Make({p, q}, all_positions[seed % 3]), 200);
    std::vector<double> lengths;
    EveryStrip(found.points, [&lengths](double length) { lengths.push_back(length); });
    std::sort(lengths.begin(), lengths.end());
    const double edges = LoopEdges(found.points);
    ASSERT_EQ(found.order.best.count, std::min<size_t>(lengths.size(), 200));
    for (tpa::u32 i = 0; i < found.order.best.count; ++i) {
      const Faces faces = found.Get(i);
      ASSERT_EQ(WhyNotConsistent(found.points, faces), "") << i;
      ASSERT_NEAR(Length(found.points, faces) - edges, lengths[i], 1e-9) << i;
    }
  }
}

// The `wanted` least lengths of strips, by one table for each start: the least lengths for every edge and every kind of
// path.
std::vector<double> ShortestStrips(const Loops& loops, size_t wanted, const Hindrance& h = {0}) {
  enum { no_y, in_y, after_y, split, kinds };  // no step on y yet; all in this column; all in one before; in several
  const size_t p = loops[0].size(), q = loops[1].size();
  std::vector<double> all;
  const auto merge = [wanted](const std::vector<double>& from, double edge, std::vector<double>& to) {
    for (double length : from) to.insert(std::upper_bound(to.begin(), to.end(), length + edge), length + edge);
    if (to.size() > wanted) to.resize(wanted);
  };
  for (size_t start = 0; start < q; ++start) {
    std::vector<std::vector<double>> row((q + 1) * kinds);
    for (size_t i = 0; i <= p; ++i)
      for (size_t j = 0; j <= q; ++j) {
        const double edge = tpa::length(loops[0][i % p] - loops[1][(start + q - j % q) % q]);
        std::vector<double> here[kinds];
        if (i + j == 0) here[no_y] = {0};
        // Vertices of the second loop are numbered after those of the first.
        const size_t y = p + (start + q - j % q) % q, x = i % p;
        if (i > 0 && (i < p || j == q) && IsFreeOf(h, i - 1, x, y))
          for (int kind = 0; kind < kinds; ++kind)
            merge(row[j * kinds + size_t(kind)], edge, here[kind == in_y ? after_y : kind]);
        if (j > 0 && i < p && IsFreeOf(h, y, y + 1 == p + q ? p : y + 1, x))
          for (int kind = 0; kind < kinds; ++kind)
            merge(row[(j - 1) * kinds + size_t(kind)], edge, here[kind == no_y || kind == in_y ? in_y : split]);
        for (int kind = 0; kind < kinds; ++kind) row[j * kinds + size_t(kind)] = here[kind];
      }
    merge(row[q * kinds + split], 0, all);
  }
  return all;
}

TEST(Candidates, LongerStripsComeInOrderOfLength) {
  const std::vector<std::vector<int>> keys = {{16, 3}, {3, 17}, {17, 4}, {5, 20}, {16, 16}, {30, 25}, {60, 40}};
  for (const auto& sides : keys)
    for (Positions positions : all_positions) {
      SCOPED_TRACE(std::to_string(sides[0]) + " and " + std::to_string(sides[1]) + ", positions " +
                   std::to_string(int(positions)));
      tpa::CandidateOptions options;
      options.max_candidates = 40;
      Search search(Maker(unsigned(sides[0])).Make(sides, positions), options);
      const std::vector<double> want = ShortestStrips(search.points, 40);
      const double edges = LoopEdges(search.points);
      Faces faces;
      for (size_t i = 0; i < want.size(); ++i) {
        ASSERT_TRUE(search.Next(faces)) << i;
        ASSERT_EQ(WhyNotConsistent(search.points, faces), "") << i;
        ASSERT_NEAR(Length(search.points, faces) - edges, want[i], 1e-9 * want[i]) << i;
      }
    }
}

TEST(Candidates, LongerStripsOfFreeFacesComeInOrderOfLength) {
  const std::vector<std::vector<int>> keys = {{16, 3}, {17, 5}, {16, 16}, {30, 25}};
  for (const auto& sides : keys)
    for (unsigned percent : {0u, 3u, 6u, 10u})
      for (Positions positions : all_positions) {
        SCOPED_TRACE(std::to_string(sides[0]) + " and " + std::to_string(sides[1]) + ", " + std::to_string(percent) +
                     " %, positions " + std::to_string(int(positions)));
        Hindrance h{percent};
        tpa::CandidateOptions options;
        options.max_candidates = 8;
        options.filter = {AskHindrance, &h};
        Search search(Maker(unsigned(sides[0])).Make(sides, positions), options);
        const std::vector<double> want = ShortestStrips(search.points, 8, h);
        ASSERT_FALSE(want.empty());
        const double edges = LoopEdges(search.points);
        Faces faces;
        for (size_t i = 0; i < want.size(); ++i) {
          ASSERT_TRUE(search.Next(faces)) << i;
          ASSERT_EQ(WhyNotConsistent(search.points, faces), "") << i;
          for (const auto& f : faces) ASSERT_TRUE(IsFreeOf(h, f.v[0], f.v[1], f.v[2])) << i;
          ASSERT_NEAR(Length(search.points, faces) - edges, want[i], 1e-9 * want[i]) << i;
        }
        // In search of the best few it does not ask about everything.
        if (percent == 0 && sides[0] == 30) {
          EXPECT_LT(h.asked, size_t(sides[0] * sides[1]));
        }
      }
}

// The table agrees with a list of all strips.
TEST(Candidates, StripsInOrderByTwoComputations) {
  for (Positions positions : all_positions) {
    const Loops points = Maker(3).Make({9, 4}, positions);
    std::vector<double> all;
    EveryStrip(points, [&all](double length) { all.push_back(length); });
    std::sort(all.begin(), all.end());
    const std::vector<double> want = ShortestStrips(points, 30);
    ASSERT_EQ(want.size(), 30u);
    for (size_t i = 0; i < 30; ++i) EXPECT_NEAR(want[i], all[i], 1e-9);
  }
}

// The shortest way round two loops that starts at edge (0, start), whatever the order of its steps.
double ShortestWayRound(const Loops& loops, size_t start) {
  const size_t p = loops[0].size(), q = loops[1].size();
  std::vector<double> row(q + 1);
  for (size_t i = 0; i <= p; ++i)
    for (size_t j = 0; j <= q; ++j) {
      const double edge = tpa::length(loops[0][i % p] - loops[1][(start + q - j % q) % q]);
      double before = i + j == 0 ? -edge : std::numeric_limits<double>::infinity();  // the first edge is the last one
      if (i > 0) before = std::min(before, row[j]);
      if (j > 0) before = std::min(before, row[j - 1]);
      row[j] = before + edge;
    }
  return row[q];
}

// The shortest way whose last step is on the first loop, as in strips.
double ShortestWayEndingOnX(const Loops& loops, size_t start) {
  const size_t p = loops[0].size(), q = loops[1].size();
  std::vector<double> row(q + 1);
  for (size_t i = 0; i < p; ++i)
    for (size_t j = 0; j <= q; ++j) {
      double before = i + j == 0 ? 0 : std::numeric_limits<double>::infinity();
      if (i > 0) before = std::min(before, row[j]);
      if (j > 0) before = std::min(before, row[j - 1]);
      row[j] = before + (i + j == 0 ? 0 : tpa::length(loops[0][i] - loops[1][(start + q - j % q) % q]));
    }
  return row[q] + tpa::length(loops[0][0] - loops[1][start]);
}

// Bounds lie below the lengths, for some starts not far below. Lengths of all starts together equal the lengths of two
// neighbours by themselves.
TEST(Candidates, StripsAreBoundedAndMeasuredFromEachStart) {
  int near = 0;
  for (const auto& sides : std::vector<std::vector<int>>{{3, 3}, {3, 8}, {9, 4}, {16, 17}, {40, 33}})
    for (unsigned seed = 1; seed <= Share(9u); ++seed) {
      const Loops points = Maker(seed).Make(sides, all_positions[seed % 3]);
      const tpa::u32 p = static_cast<tpa::u32>(sides[0]), q = static_cast<tpa::u32>(sides[1]);
      SCOPED_TRACE(std::to_string(p) + " and " + std::to_string(q) + ", seed " + std::to_string(seed));
      std::vector<Vec3> all = points[0];
      all.insert(all.end(), points[1].begin(), points[1].end());
      std::vector<tpa::u32> numbers(p + q);
      std::iota(numbers.begin(), numbers.end(), 0u);
      const tpa::StripLoops loops{all.data(), {numbers.data(), p}, {numbers.data() + p, q}};
      std::vector<double> scratch(4 * (q + 1) + p * q + p), bound(q), together(q);
      tpa::bound_strip_lengths(loops, scratch.data(), bound.data());
      tpa::shortest_strip_lengths(loops, 0, q, {scratch.data(), 6 * (q + 1)}, together.data());
      for (tpa::u32 start = 0; start < q; ++start) {
        const double way = ShortestWayEndingOnX(points, start);
        EXPECT_LE(bound[start], way);
        near += bound[start] > 0.9 * way;
        EXPECT_GE(together[start], way * (1 - 1e-12));
        double alone[2];
        const tpa::u32 first = start - start % 2, end = std::min(first + 2, q);
        tpa::shortest_strip_lengths(loops, first, end, {scratch.data(), 4 * (q + 1)}, alone);
        EXPECT_EQ(together[start], alone[start % 2]);
      }
    }
  EXPECT_GT(near, Least(50));
}

TEST(Candidates, TheFirstLongStripIsTheShortest) {
  const std::vector<std::vector<int>> keys = {{17, 16}, {16, 30}, {60, 41}, {41, 60}, {200, 3}, {190, 190}};
  for (const auto& sides : keys) {
    SCOPED_TRACE(std::to_string(sides[0]) + " and " + std::to_string(sides[1]));
    Maker maker(static_cast<unsigned>(sides[0]));
    // Two wobbly rings one above the other: far apart beside each other, the shortest way would take all steps of a
    // loop in a row, which no handle does.
    Loops rings(2);
    for (size_t l = 0; l < 2; ++l)
      for (int v = 0; v < sides[l]; ++v) {
        const double t = (l == 0 ? 6.283185307179586 : -6.283185307179586) * v / sides[l];
        rings[l].push_back({tool::cosine(t) + 0.1 * maker.Unit(), tool::sine(t) + 0.1 * maker.Unit(), 0.3 * double(l)});
      }
    Search search(rings);
    double least = std::numeric_limits<double>::infinity();
    for (size_t start = 0; start < search.points[1].size(); ++start)
      least = std::min(least, ShortestWayRound(search.points, start));
    Faces faces;
    ASSERT_TRUE(search.Next(faces));
    EXPECT_NEAR(Length(search.points, faces) - LoopEdges(search.points), least, 1e-9 * least);
  }
}

// Strips of free faces are exactly the strips left after all others with a hindered face go.
TEST(Candidates, StripsHaveFreeFacesOnly) {
  for (unsigned seed = 1; seed <= Share(30u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Loops points = Maker(seed).Make({4, 3}, all_positions[seed % 3]);
    const StripsInOrder all(points, 200), some(points, 200, {IsFree, nullptr});
    std::vector<double> want;
    for (tpa::u32 i = 0; i < all.order.best.count; ++i)
      if (const Faces faces = all.Get(i); AreFree(faces)) want.push_back(Length(points, faces));
    ASSERT_GE(want.size(), 1u);
    ASSERT_EQ(some.order.best.count, want.size());
    for (tpa::u32 i = 0; i < some.order.best.count; ++i) {
      const Faces faces = some.Get(i);
      EXPECT_TRUE(AreFree(faces)) << i;
      EXPECT_NEAR(Length(points, faces), want[i], 1e-9) << i;
    }
  }
}

}  // namespace
}  // namespace strip_candidates_test
