// Candidates against oracles that share no code with them: a check of every promise of a handle, all
// triangulations of small loops, all strips between small pairs, all stored handles of small keys.
#include "candidates.h"
#include "elementary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <string>
#include <vector>

namespace {

using tpa::Vec3;
using Loops = std::vector<std::vector<Vec3>>;
using Faces = std::vector<tpa::CandidateFace>;

size_t Mu(const Loops& loops) {
  size_t mu = 0;
  for (const auto& loop : loops) mu += loop.size();
  return mu;
}

// Half the sum over all face edges: polygon edges count a half, which is the same for all candidates.
double Length(const Loops& loops, const Faces& faces) {
  std::vector<Vec3> points;
  for (const auto& loop : loops) points.insert(points.end(), loop.begin(), loop.end());
  double sum = 0;
  for (const auto& f : faces)
    for (int c = 0; c < 3; ++c) {
      const Vec3 e = points[f.v[c]] - points[f.v[(c + 1) % 3]];
      sum += 0.5 * std::sqrt(e.x * e.x + e.y * e.y + e.z * e.z);
    }
  return sum;
}

// Empty when the faces are a consistent handle or cap.
std::string WhyNotConsistent(const Loops& loops, const Faces& faces) {
  const size_t mu = Mu(loops), k = loops.size();
  if (faces.size() != (k == 1 ? mu - 2 : mu + 2 * k - 4)) return "number of faces";
  std::vector<size_t> next, of;
  for (size_t l = 0, first = 0; l < k; first += loops[l++].size())
    for (size_t v = 0; v < loops[l].size(); ++v)
      next.push_back(first + (v + 1) % loops[l].size()), of.push_back(l);
  std::vector<std::map<size_t, size_t>> star(mu);  // star[a][b] = c for the face a b c
  for (const auto& f : faces)
    for (int c = 0; c < 3; ++c) {
      const size_t a = f.v[c], b = f.v[(c + 1) % 3], d = f.v[(c + 2) % 3];
      if (a >= mu || a == b) return "a corner";
      if (!star[a].emplace(b, d).second) return "an edge twice in one direction";
    }
  size_t inner = 0;
  for (size_t a = 0; a < mu; ++a) {
    if (!star[a].count(next[a])) return "a loop's edge is missing";
    for (const auto& [b, unused] : star[a]) {
      if (next[a] == b) continue;
      if (next[b] == a) return "a loop's edge is traversed backwards";
      if (!star[b].count(a)) return "an inner edge has one face";
      if (k > 1 && of[a] == of[b]) return "an edge inside a loop";
      ++inner;
    }
    size_t at = next[a], steps = 0;
    for (auto it = star[a].find(at); it != star[a].end() && steps <= star[a].size(); it = star[a].find(at))
      at = it->second, ++steps;
    if (steps != star[a].size() || next[at] != a) return "a star that is not one fan";
  }
  std::vector<char> seen(mu);
  std::vector<size_t> stack{0};
  seen[0] = 1;
  size_t reached = 0;
  while (!stack.empty()) {
    const size_t v = stack.back();
    stack.pop_back();
    ++reached;
    for (const auto& [b, c] : star[v])
      for (size_t w : {b, c})
        if (!seen[w]) seen[w] = 1, stack.push_back(w);
  }
  if (reached != mu) return "several components";
  // Caps add k vertices, mu edges and mu faces.
  if (mu + k + faces.size() + mu != 2 + (mu + inner / 2 + mu)) return "Euler number";
  return "";
}

struct Search {
  Loops points;
  std::vector<tpa::Loop> loops;
  std::vector<tpa::u64> scratch;
  tpa::CandidateSearch search;

  explicit Search(Loops p, tpa::CandidateOptions options = {}) : points(std::move(p)) {
    for (const auto& loop : points) loops.push_back({loop.data(), static_cast<tpa::u32>(loop.size())});
    const tpa::u64 bytes = tpa::candidate_scratch_bytes(Mu(points), points.size());
    scratch.resize(bytes / 8 + 1);
    EXPECT_TRUE(tpa::begin(search, {loops.data(), static_cast<tpa::u32>(loops.size())},
                           {reinterpret_cast<tpa::u8*>(scratch.data()), static_cast<tpa::u32>(bytes)},
                           options));
  }
  bool Next(Faces& faces) {
    faces.resize(tpa::candidate_face_count(search.loops));
    tpa::u32 count = 0;
    const bool more = tpa::next(search, {faces.data(), static_cast<tpa::u32>(faces.size())}, count);
    EXPECT_TRUE(!more || count == faces.size());
    return more;
  }
};

enum class Positions { random, tied, symmetric };

struct Maker {
  std::mt19937 engine;
  explicit Maker(unsigned seed) : engine(seed) {}
  double Unit() { return static_cast<double>(engine()) / 4294967296.0; }
  // Loops about the corners of a regular polygon; ties by coordinates on a coarse grid, or exact symmetry.
  Loops Make(const std::vector<int>& sides, Positions positions) {
    Loops loops;
    const double k = static_cast<double>(sides.size());
    for (size_t l = 0; l < sides.size(); ++l) {
      std::vector<Vec3> loop;
      const double at = 6.283185307179586 * static_cast<double>(l) / k;
      for (int v = 0; v < sides[l]; ++v) {
        const double t = 6.283185307179586 * v / sides[l];
        Vec3 p{3 * tool::cosine(at) + tool::cosine(t), 3 * tool::sine(at) - tool::sine(t), 0};
        if (positions == Positions::random) p = p + Vec3{Unit(), Unit(), Unit()};
        if (positions == Positions::tied)
          p = {std::round(p.x + Unit()), std::round(p.y + Unit()), std::round(Unit())};
        if (positions == Positions::symmetric && sides.size() == 2)
          p = {tool::cosine(t), l == 0 ? tool::sine(t) : -tool::sine(t), l == 0 ? 0.0 : 1.0};
        loop.push_back(p);
      }
      loops.push_back(loop);
    }
    return loops;
  }
};
constexpr Positions all_positions[] = {Positions::random, Positions::tied, Positions::symmetric};

TEST(Candidates, AreAllConsistentAndDifferent) {
  for (unsigned seed = 1; seed <= 150; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Maker maker(seed);
    std::vector<int> sides(1 + maker.engine() % 6);
    for (int& side : sides) side = 3 + static_cast<int>(maker.engine() % (seed % 10 == 0 ? 40 : 13));
    tpa::CandidateOptions options;
    options.shortest_first = seed % 2 == 0;
    Search search(maker.Make(sides, all_positions[seed % 3]), options);
    Faces faces;
    std::vector<std::vector<std::vector<tpa::u32>>> seen;
    while (search.Next(faces)) {
      ASSERT_EQ(WhyNotConsistent(search.points, faces), "") << "candidate " << seen.size();
      std::vector<std::vector<tpa::u32>> set;
      for (const auto& f : faces) {
        std::vector<tpa::u32> v(f.v, f.v + 3);
        std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
        set.push_back(v);
      }
      std::sort(set.begin(), set.end());
      EXPECT_EQ(std::count(seen.begin(), seen.end(), set), 0);
      seen.push_back(set);
    }
    EXPECT_GE(seen.size(), 1u);
    EXPECT_LE(seen.size(), 64u);
  }
}

TEST(Candidates, ManyAndLongLoops) {
  const std::vector<std::vector<int>> cases = {{500},
                                               {65},
                                               {200, 200},
                                               {1000, 3},
                                               {3, 700},
                                               {90, 80},
                                               {200, 100, 3},
                                               {16, 16, 16, 16},
                                               {3, 3, 3, 3, 3},
                                               std::vector<int>(12, 200),
                                               std::vector<int>(12, 5),
                                               {4000, 3000, 20}};
  for (const auto& sides : cases) {
    SCOPED_TRACE(std::to_string(sides.size()) + " loops, the first of " + std::to_string(sides[0]));
    for (Positions positions : all_positions) {
      Maker maker(7);
      tpa::CandidateOptions options;
      options.max_candidates = 12;
      Search search(maker.Make(sides, positions), options);
      Faces faces;
      int count = 0;
      for (; search.Next(faces); ++count) ASSERT_EQ(WhyNotConsistent(search.points, faces), "") << count;
      EXPECT_GE(count, 1);
    }
  }
}

// The least total chord length over all triangulations of vertices i .. j of a loop.
double LeastChords(const std::vector<Vec3>& p, size_t i, size_t j) {
  if (j - i < 2) return 0;
  double best = std::numeric_limits<double>::infinity();
  for (size_t k = i + 1; k < j; ++k) {
    double sum = LeastChords(p, i, k) + LeastChords(p, k, j);
    if (k - i > 1) sum += tpa::length(p[i] - p[k]);
    if (j - k > 1) sum += tpa::length(p[k] - p[j]);
    best = std::min(best, sum);
  }
  return best;
}

// Some faces that may not be used; every fifth or so.
bool IsFree(void*, const tpa::HandleFace& f) {
  const unsigned sum = (f.v[0] + 1) * (f.v[1] + 1) * (f.v[2] + 1) + f.v[0] + f.v[1] + f.v[2];
  return (sum * 2654435761u >> 16) % 5 != 0;
}
bool AreFree(const Faces& faces) {
  return std::all_of(faces.begin(), faces.end(), [](const tpa::CandidateFace& f) { return IsFree(nullptr, f); });
}

// A share of the faces is not free; counts how often it is asked.
struct Hindrance {
  unsigned percent;
  size_t asked = 0;
};
bool IsFreeOf(const Hindrance& h, size_t a, size_t b, size_t c) {
  const uint64_t sum = (a + 1) * (b + 1) * (c + 1) * 31 + a + b + c;
  return (sum * 0x9e3779b97f4a7c15u >> 33) % 100 >= h.percent;
}
bool AskHindrance(void* caller, const tpa::HandleFace& f) {
  Hindrance& h = *static_cast<Hindrance*>(caller);
  ++h.asked;
  return IsFreeOf(h, f.v[0], f.v[1], f.v[2]);
}

// The least total chord length over all triangulations of a loop that have free faces only; endless without any.
double LeastFreeChords(const std::vector<Vec3>& p, const Hindrance& h) {
  const size_t n = p.size();
  std::vector<std::vector<double>> least(n, std::vector<double>(n, 0));
  for (size_t span = 2; span < n; ++span)
    for (size_t i = 0; i + span < n; ++i) {
      const size_t j = i + span;
      least[i][j] = std::numeric_limits<double>::infinity();
      for (size_t k = i + 1; k < j; ++k)
        if (IsFreeOf(h, i, k, j)) least[i][j] = std::min(least[i][j], least[i][k] + least[k][j]);
      if (span + 1 < n) least[i][j] += tpa::length(p[i] - p[j]);
    }
  return least[0][n - 1];
}

// Is the first cap of a loop of n vertices the shortest one of free faces? False where there is none of free faces.
bool ExpectShortestOfFree(int n, unsigned percent, unsigned seed) {
  SCOPED_TRACE(std::to_string(n) + " vertices, " + std::to_string(percent) + " %, seed " + std::to_string(seed));
  Hindrance h{percent};
  tpa::CandidateOptions options;
  options.filter = {AskHindrance, &h};
  Search search(Maker(seed).Make({n}, all_positions[seed % 3]), options);
  const double want = LeastFreeChords(search.points[0], h);
  Faces faces;
  const bool found = search.Next(faces);
  if (want == std::numeric_limits<double>::infinity()) return false;  // caps that need not be free follow
  EXPECT_TRUE(found);
  EXPECT_EQ(WhyNotConsistent(search.points, faces), "");
  for (const auto& f : faces) EXPECT_TRUE(IsFreeOf(h, f.v[0], f.v[1], f.v[2]));
  double loop = 0;
  const auto& p = search.points[0];
  for (size_t v = 0; v < p.size(); ++v) loop += 0.5 * tpa::length(p[v] - p[(v + 1) % p.size()]);
  EXPECT_NEAR(Length(search.points, faces) - loop, want, 1e-9 * want + 1e-9);
  if (percent == 0) { EXPECT_EQ(h.asked, p.size() - 2); }
  return true;
}

// Few hindrances are found by asking about the best; many make it ask about everything.
TEST(Candidates, TheFirstCapIsTheShortestOfFreeFaces) {
  int some = 0, none = 0;
  for (int n : {5, 8, 12, 30, 60})
    for (unsigned percent : {0u, 10u, 40u, 70u, 90u})
      for (unsigned seed = 1; seed <= 6; ++seed) ++(ExpectShortestOfFree(n, percent, seed) ? some : none);
  EXPECT_GT(some, 60);
  EXPECT_GT(none, 5);
}

// So is that of a loop too long to remember all faces of, where not too many are hindered.
TEST(Candidates, TheFirstCapOfALongLoopIsTheShortestOfFreeFaces) {
  for (int n : {97, 120, 150})
    for (unsigned percent : {0u, 5u, 20u})
      for (unsigned seed = 1; seed <= 3; ++seed) EXPECT_TRUE(ExpectShortestOfFree(n, percent, seed));
}

// Where the table is full before a cap of free faces is found, others follow.
TEST(Candidates, ALongLoopIsClosedWhateverIsHindered) {
  Hindrance h{95};
  tpa::CandidateOptions options;
  options.filter = {AskHindrance, &h};
  Search search(Maker(1).Make({150}, Positions::random), options);
  Faces faces;
  ASSERT_TRUE(search.Next(faces));
  EXPECT_EQ(WhyNotConsistent(search.points, faces), "");
  EXPECT_LE(h.asked, 3u * 3 * (1 << 13) / 4 + 3 * 150);
}

// What is left of all strips when those with a face that is not free go.
TEST(Candidates, StripsHaveFreeFacesOnly) {
  for (unsigned seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    tpa::CandidateOptions options;
    options.shortest_first = true;
    options.max_candidates = 200;
    const Loops points = Maker(seed).Make({4, 3}, all_positions[seed % 3]);
    Search all(points, options);
    options.filter.ask = IsFree;
    Search some(points, options);
    std::vector<double> want;
    for (Faces faces; all.Next(faces);)
      if (AreFree(faces)) want.push_back(Length(points, faces));
    std::sort(want.begin(), want.end());
    Faces faces;
    ASSERT_GE(want.size(), 1u);
    for (size_t i = 0; i < want.size(); ++i) {
      ASSERT_TRUE(some.Next(faces)) << i << " of " << want.size();
      EXPECT_TRUE(AreFree(faces)) << i;
      EXPECT_NEAR(Length(points, faces), want[i], 1e-9) << i;
    }
  }
}

TEST(Candidates, LongHandlesAndCapsHaveFreeFacesWhereTheyCan) {
  int free = 0, all = 0;
  for (const auto& sides : std::vector<std::vector<int>>{{20}, {17, 16, 20}, {5, 4, 5, 6, 5}})
    for (unsigned seed = 1; seed <= 10; ++seed) {
      tpa::CandidateOptions options;
      options.filter.ask = IsFree;
      Search search(Maker(seed).Make(sides, Positions::random), options);
      Faces faces;
      ASSERT_TRUE(search.Next(faces));
      EXPECT_EQ(WhyNotConsistent(search.points, faces), "");
      free += AreFree(faces), ++all;
    }
  EXPECT_GE(free, all - 5);  // a tree may leave none that is free, or none without an edge twice
}

TEST(Candidates, SayWhetherAllFacesAreFree) {
  const std::vector<std::vector<int>> keys = {{9}, {100}, {5, 4}, {20, 17}, {60, 50}, {4, 4, 4}, {17, 16, 20}, {5, 5, 5, 5},
                                              {17, 3, 3, 3}, {5, 4, 5, 6, 5}, {30, 30, 30, 5, 5}};
  int said = 0, given = 0;
  for (const auto& sides : keys)
    for (unsigned seed = 1; seed <= 4; ++seed) {
      SCOPED_TRACE(std::to_string(sides.size()) + " loops, the first of " + std::to_string(sides[0]));
      tpa::CandidateOptions options;
      options.filter.ask = IsFree;
      Search search(Maker(seed).Make(sides, all_positions[seed % 3]), options);
      for (Faces faces; search.Next(faces); ++given) {
        EXPECT_TRUE(!search.search.faces_free || AreFree(faces)) << "number " << search.search.given;
        said += search.search.faces_free;
      }
    }
  EXPECT_GT(said, 100);
  EXPECT_GT(given - said, 100);
}

TEST(Candidates, TheFirstCapIsTheShortest) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    Maker maker(seed);
    const int n = 3 + static_cast<int>(seed % 8);
    Search search(maker.Make({n}, all_positions[seed % 3]));
    Faces faces;
    ASSERT_TRUE(search.Next(faces));
    double loop = 0;
    const auto& p = search.points[0];
    for (size_t v = 0; v < p.size(); ++v) loop += 0.5 * tpa::length(p[v] - p[(v + 1) % p.size()]);
    EXPECT_NEAR(Length(search.points, faces) - loop, LeastChords(p, 0, p.size() - 1), 1e-9)
        << "seed " << seed;
  }
}

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

double LoopEdges(const Loops& loops) {
  double sum = 0;
  for (const auto& loop : loops)
    for (size_t v = 0; v < loop.size(); ++v) sum += 0.5 * tpa::length(loop[v] - loop[(v + 1) % loop.size()]);
  return sum;
}

TEST(Candidates, StripsComeInOrderOfLength) {
  for (unsigned seed = 1; seed <= 90; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Maker maker(seed);
    const int p = 3 + static_cast<int>(maker.engine() % 4), q = 3 + static_cast<int>(maker.engine() % 4);
    tpa::CandidateOptions options;
    options.shortest_first = true;
    options.max_candidates = 200;
    Search search(maker.Make({p, q}, all_positions[seed % 3]), options);
    std::vector<double> lengths;
    EveryStrip(search.points, [&lengths](double length) { lengths.push_back(length); });
    std::sort(lengths.begin(), lengths.end());
    Faces faces;
    const double edges = LoopEdges(search.points);
    for (size_t i = 0; i < std::min<size_t>(lengths.size(), 200); ++i) {
      ASSERT_TRUE(search.Next(faces)) << i;
      ASSERT_EQ(WhyNotConsistent(search.points, faces), "") << i;
      ASSERT_NEAR(Length(search.points, faces) - edges, lengths[i], 1e-9) << i;
    }
  }
}

// The `wanted` least lengths of strips, by a table of its own for each start: for every edge and every kind of path
// there, as many lengths.
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
          for (int kind = 0; kind < kinds; ++kind) merge(row[j * kinds + size_t(kind)], edge, here[kind == in_y ? after_y : kind]);
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
        if (percent == 0 && sides[0] == 30) { EXPECT_LT(h.asked, size_t(sides[0] * sides[1])); }
      }
}

// And the table agrees with a list of all strips.
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

// The shortest way of those whose last step is on the first loop, as in strips.
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

// Bounds lie below, for some starts not far, and lengths of neighbouring starts are those of each start by itself.
TEST(Candidates, StripsAreBoundedAndMeasuredFromEachStart) {
  int near = 0;
  for (const auto& sides : std::vector<std::vector<int>>{{3, 3}, {3, 8}, {9, 4}, {16, 17}, {40, 33}})
    for (unsigned seed = 1; seed <= 9; ++seed) {
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
        const double alone = tpa::shortest_strip_length(loops, start, reinterpret_cast<tpa::u8*>(scratch.data()));
        EXPECT_EQ(together[start], alone);
      }
    }
  EXPECT_GT(near, 50);
}

TEST(Candidates, TheFirstLongStripIsTheShortest) {
  const std::vector<std::vector<int>> keys = {{17, 16}, {16, 30}, {60, 41}, {41, 60}, {200, 3}, {200, 200}};
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

TEST(Candidates, StoredHandlesComeInOrderOfLength) {
  const std::vector<std::vector<int>> keys = {{3, 3},       {4, 3},       {5, 4},       {3, 7},
                                              {3, 3, 3},    {3, 5, 4},    {5, 3, 3},    {6, 4, 4},
                                              {3, 3, 3, 3}, {4, 3, 3, 4}, {4, 3, 3, 3}, {5, 4, 4, 3}};
  unsigned seed = 0;
  for (const auto& sides : keys)
    for (Positions positions : all_positions) {
      SCOPED_TRACE("seed " + std::to_string(++seed) + ", " + std::to_string(sides.size()) + " loops");
      Maker maker(seed);
      Search search(maker.Make(sides, positions));
      tpa::HandleKey key;
      key.k = static_cast<tpa::u32>(sides.size());
      for (size_t i = 0; i < sides.size(); ++i) key.sides[i] = static_cast<tpa::u32>(sides[i]);
      std::vector<double> lengths;
      Faces faces(tpa::handle_face_count(key));
      for (tpa::u64 i = 0; i < tpa::handle_count(key); ++i) {
        ASSERT_TRUE(tpa::handle_get(key, i, {faces.data(), static_cast<tpa::u32>(faces.size())}));
        lengths.push_back(Length(search.points, faces));
      }
      std::sort(lengths.begin(), lengths.end());
      const size_t stored = std::min<size_t>(lengths.size(), 48);
      for (size_t i = 0; i < stored; ++i) {
        ASSERT_TRUE(search.Next(faces));
        EXPECT_NEAR(Length(search.points, faces), lengths[i], 1e-9) << "candidate " << i;
      }
    }
}

// With the shortest first, candidates come in order of length, from one that no stored handle beats.
TEST(Candidates, TheShortestComeFirstWhereAsked) {
  for (const auto& sides : std::vector<std::vector<int>>{
           {4, 5}, {3, 6, 5}, {15, 9, 12}, {4, 3, 5, 4}, {16, 9, 12}, {20, 3, 17}, {16, 3, 3, 3}, {4, 3, 18, 3}})
    for (Positions positions : all_positions) {
      SCOPED_TRACE(std::to_string(sides.size()) + " loops");
      Maker maker(5);
      const Loops points = maker.Make(sides, positions);
      tpa::CandidateOptions options;
      Search stored(points, options);
      options.shortest_first = true;
      Search shortest(points, options);
      Faces faces;
      ASSERT_TRUE(stored.Next(faces));
      const double most = Length(points, faces);
      double last = 0;
      for (int i = 0; i < 16; ++i) {
        ASSERT_TRUE(shortest.Next(faces));
        const double length = Length(points, faces);
        if (i == 0) {
          EXPECT_LE(length, most * (1 + 1e-12));
        }
        EXPECT_GE(length, last * (1 - 1e-12));
        last = length;
      }
    }
}

bool AnyFace(void*, const tpa::HandleFace&) { return true; }

// The scratch suffices for as many of the shortest as may be wanted, of four loops as of three.
TEST(Candidates, HaveRoomForTheShortest) {
  const std::pair<int, tpa::u32> most[] = {{15, 64}, {16, 4}};
  for (const auto& [sides, wanted] : most) {
    const Search search(Maker(1).Make({sides, sides, sides, sides}, Positions::random));
    tpa::ShortLoops loops;
    loops.filter.ask = AnyFace;
    for (tpa::u32 l = 0; l <= 4; ++l) loops.first[l] = l * static_cast<tpa::u32>(sides);
    EXPECT_LE(tpa::four_scratch_bytes(loops, wanted), search.search.room_size) << sides;
  }
}

TEST(Candidates, RefusesWhatCannotBe) {
  Maker maker(1);
  const Loops points = maker.Make({3, 4}, Positions::random);
  std::vector<tpa::Loop> loops = {{points[0].data(), 3}, {points[1].data(), 4}};
  std::vector<tpa::u64> scratch(tpa::candidate_scratch_bytes(7, 2) / 8);
  const tpa::Span<tpa::u8> room{reinterpret_cast<tpa::u8*>(scratch.data()),
                                static_cast<tpa::u32>(8 * scratch.size())};
  tpa::CandidateSearch search;
  EXPECT_TRUE(tpa::begin(search, {loops.data(), 2}, room, {}));
  EXPECT_FALSE(tpa::begin(search, {loops.data(), 0}, room, {}));
  EXPECT_FALSE(tpa::begin(search, {loops.data(), 2}, room.part(0, room.size - 8), {}));
  loops[0].count = 2;
  EXPECT_FALSE(tpa::begin(search, {loops.data(), 2}, room, {}));
}

}  // namespace
