// The handle database against oracles that share no code with it: an advancing front that lists all
// consistent handles, homology over the integers, and the handles printed in the paper.
#include "handles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <vector>

namespace {

using Face = std::array<int, 3>;
using Handle =
    std::vector<Face>;  // each face starting at its least corner, faces sorted: equal sets compare equal

std::vector<int> SidesOf(const tpa::HandleKey& key) { return {key.sides, key.sides + key.k}; }
int Mu(const std::vector<int>& sides) { return std::accumulate(sides.begin(), sides.end(), 0); }

tpa::HandleKey Key(const std::vector<int>& sides) {
  tpa::HandleKey key;
  key.k = static_cast<tpa::u32>(sides.size());
  for (size_t i = 0; i < sides.size(); ++i) key.sides[i] = static_cast<tpa::u32>(sides[i]);
  return key;
}

std::string Name(const std::vector<int>& sides) {
  std::string s = "(";
  for (int side : sides) s += std::to_string(side) + " ";
  s.back() = ')';
  return s;
}

Face Normal(Face f) {
  std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
  return f;
}

Handle Normal(Handle h) {
  for (Face& f : h) f = Normal(f);
  std::sort(h.begin(), h.end());
  return h;
}

Handle FromLibrary(const std::vector<tpa::HandleFace>& faces) {
  Handle h;
  for (const tpa::HandleFace& f : faces)
    h.push_back({static_cast<int>(f.v[0]), static_cast<int>(f.v[1]), static_cast<int>(f.v[2])});
  return Normal(h);
}

Handle Get(const tpa::HandleKey& key, tpa::u64 index) {
  std::vector<tpa::HandleFace> faces(tpa::handle_face_count(key));
  EXPECT_TRUE(tpa::handle_get(key, index, {faces.data(), static_cast<tpa::u32>(faces.size())}));
  return FromLibrary(faces);
}

Handle GetGenerator(const tpa::HandleKey& key, tpa::u32 g) {
  std::vector<tpa::HandleFace> faces(tpa::handle_face_count(key));
  EXPECT_TRUE(tpa::generator_get(key, g, {faces.data(), static_cast<tpa::u32>(faces.size())}));
  return FromLibrary(faces);
}

std::string Print(const Handle& h) {
  std::string s;
  for (const Face& f : h) {
    s += "(" + std::to_string(f[0] + 1) + "," + std::to_string(f[1] + 1) + "," + std::to_string(f[2] + 1) +
         ") ";
  }
  return s;
}

struct Polygons {
  std::vector<int> next, of;
};
Polygons PolygonsOf(const std::vector<int>& sides) {
  Polygons p;
  int first = 0;
  for (size_t i = 0; i < sides.size(); ++i) {
    for (int v = 0; v < sides[i]; ++v) {
      p.next.push_back(first + (v + 1) % sides[i]);
      p.of.push_back(static_cast<int>(i));
    }
    first += sides[i];
  }
  return p;
}

int SumOfSquares(const Handle& h, int mu) {
  std::vector<int> d(static_cast<size_t>(mu));
  for (const Face& f : h)
    for (int v : f) ++d[static_cast<size_t>(v)];
  return std::inner_product(d.begin(), d.end(), d.begin(), 0);
}

// Criterion 4.1 without homology: with a cap on every polygon, all links are one simple polygon, the surface
// is connected and its Euler number is 2. Empty when it holds.
std::string WhyNotSphere(const Handle& handle, const std::vector<int>& sides) {
  const int mu = Mu(sides), k = static_cast<int>(sides.size());
  if (static_cast<int>(handle.size()) != mu + 2 * k - 4) return "number of faces";
  const Polygons p = PolygonsOf(sides);
  Handle all = handle;
  for (int v = 0; v < mu; ++v) all.push_back({p.next[size_t(v)], v, mu + p.of[size_t(v)]});
  std::vector<std::map<int, int>> link(size_t(mu + k));
  std::set<std::pair<int, int>> edges;
  for (const Face& f : all)
    for (int c = 0; c < 3; ++c) {
      const int a = f[size_t(c)], b = f[size_t((c + 1) % 3)], d = f[size_t((c + 2) % 3)];
      if (a < 0 || a >= mu + k || a == b) return "a corner";
      if (!link[size_t(a)].emplace(b, d).second) return "an edge twice in one direction";
      edges.insert({std::min(a, b), std::max(a, b)});
    }
  for (const auto& l : link) {
    if (l.size() < 3) return "a vertex with two faces";
    int at = l.begin()->first;
    size_t steps = 0;
    do {
      const auto it = l.find(at);
      if (it == l.end()) return "an open link";
      at = it->second, ++steps;
    } while (at != l.begin()->first && steps <= l.size());
    if (steps != l.size()) return "a link of several polygons";
  }
  std::vector<int> seen(size_t(mu + k)), stack{0};
  seen[0] = 1;
  while (!stack.empty()) {
    const int v = stack.back();
    stack.pop_back();
    for (const auto& [w, unused] : link[size_t(v)])
      if (!seen[size_t(w)]++) stack.push_back(w);
  }
  if (std::count(seen.begin(), seen.end(), 0) > 0) return "several components";
  if (mu + k - static_cast<int>(edges.size()) + static_cast<int>(all.size()) != 2) return "Euler number";
  return "";
}

bool HasChord(const Handle& h, const std::vector<int>& sides) {
  const Polygons p = PolygonsOf(sides);
  for (const Face& f : h)
    for (size_t c = 0; c < 3; ++c) {
      const int a = f[c], b = f[(c + 1) % 3];
      if (p.of[size_t(a)] == p.of[size_t(b)] && p.next[size_t(a)] != b && p.next[size_t(b)] != a) return true;
    }
  return false;
}

// Lists all consistent handles whose sum of squares is at most `limit`: the least directed edge that still
// lacks its face gets every possible one. Chords are allowed. Branches are cut only where the faces already
// there cost too much: vertices have 3 (mu + 2k - 4) corners in all, so the sum of squares is 9 mu + 42 (k -
// 2) plus twice the sum of (d - 3)(d - 4) / 2.
struct AdvancingFront {
  std::vector<int> sides;
  int limit;
  Polygons p;
  int mu, faces_wanted, allowance;
  std::vector<std::vector<char>> used;
  std::vector<int> d, missing;  // faces at a vertex; directed edges at it that lack theirs
  Handle faces;
  std::set<Handle> found;
  long steps = 0;

  AdvancingFront(std::vector<int> s, int l)
      : sides(std::move(s)), limit(l), p(PolygonsOf(sides)), mu(Mu(sides)) {
    const int k = static_cast<int>(sides.size());
    faces_wanted = mu + 2 * k - 4;
    allowance = (limit - 9 * mu - 42 * (k - 2)) / 2;
    used.assign(size_t(mu), std::vector<char>(size_t(mu)));
    d.assign(size_t(mu), 0);
    missing.assign(size_t(mu), 2);
  }
  bool PolygonEdge(int a, int b) const { return p.next[size_t(a)] == b; }
  // The face of a directed edge is still missing: the edge is a polygon's, or its twin has been used.
  bool Missing(int a, int b) const {
    if (used[size_t(a)][size_t(b)] || PolygonEdge(b, a)) return false;
    return PolygonEdge(a, b) || used[size_t(b)][size_t(a)];
  }
  bool Allowed(int a, int b) const { return !used[size_t(a)][size_t(b)] && !PolygonEdge(b, a); }
  bool Closed(int v) const { return missing[size_t(v)] == 0; }
  void CountMissing(int a, int b, int sign) {
    const int edges = (Missing(a, b) ? 1 : 0) + (Missing(b, a) ? 1 : 0);
    missing[size_t(a)] += sign * edges;
    missing[size_t(b)] += sign * edges;
  }
  int Cost() const {
    int cost = 0;
    for (int v = 0; v < mu; ++v) {
      const int e = d[size_t(v)] - 3;
      if (e > 1 || Closed(v)) cost += e * (e - 1) / 2;
    }
    return cost;
  }
  void Run() {
    ++steps;
    if (static_cast<int>(faces.size()) > faces_wanted || Cost() > allowance) return;
    for (int a = 0; a < mu; ++a)
      for (int b = 0; b < mu; ++b) {
        if (a == b || !Missing(a, b)) continue;
        for (int c = 0; c < mu; ++c) {
          if (c == a || c == b || !Allowed(b, c) || !Allowed(c, a)) continue;
          Put({a, b, c}, 1);
          Run();
          Put({a, b, c}, -1);
        }
        return;
      }
    if (WhyNotSphere(faces, sides).empty() && SumOfSquares(faces, mu) <= limit) found.insert(Normal(faces));
  }
  void Put(Face f, int sign) {
    for (size_t c = 0; c < 3; ++c) {
      const int a = f[c], b = f[(c + 1) % 3];
      CountMissing(a, b, -1);
      used[size_t(a)][size_t(b)] = sign > 0;
      CountMissing(a, b, 1);
      d[size_t(a)] += sign;
    }
    if (sign > 0)
      faces.push_back(f);
    else
      faces.pop_back();
  }
};

std::set<Handle> Expand(const tpa::HandleKey& key) {
  std::set<Handle> all;
  const tpa::u64 count = tpa::handle_count(key);
  for (tpa::u64 i = 0; i < count; ++i) all.insert(Get(key, i));
  EXPECT_EQ(all.size(), count) << Name(SidesOf(key));
  return all;
}

// All keys of k sorted sides from 3 on with a given largest sum or side.
std::vector<std::vector<int>> Keys(int k, int largest_sum, int largest_side) {
  std::vector<std::vector<int>> keys;
  std::vector<int> sides(size_t(k), 3);
  for (;;) {
    if (Mu(sides) <= largest_sum) keys.push_back(sides);
    size_t i = size_t(k);
    while (i > 0 && sides[i - 1] == (i == 1 ? largest_side : sides[i - 2])) --i;
    if (i == 0) return keys;
    ++sides[i - 1];
    std::fill(sides.begin() + static_cast<long>(i), sides.end(), 3);
  }
}

TEST(Handles, CountsAreThoseOfTheDesign) {
  const std::vector<std::pair<std::vector<int>, tpa::u64>> known = {
      {{3, 3}, 3},      {{4, 3}, 12},     {{4, 4}, 4},         {{5, 4}, 20},
      {{3, 3, 3}, 54},  {{4, 3, 3}, 72},  {{4, 4, 4}, 128},    {{5, 3, 3}, 450},
      {{5, 4, 3}, 120}, {{5, 5, 5}, 250}, {{3, 3, 3, 3}, 324},
  };
  for (const auto& [sides, count] : known) {
    EXPECT_EQ(tpa::handle_count(Key(sides)), count) << Name(sides);
    EXPECT_TRUE(tpa::key_is_complete(Key(sides))) << Name(sides);
    EXPECT_EQ(Expand(Key(sides)).size(), count) << Name(sides);
  }
}

TEST(Handles, ThePaperPrintsTwoOfThem) {
  // Section 4.2; faces with their corners sorted, so orientation is compared after sorting as well.
  const Handle printed = {{1, 2, 11},  {1, 5, 12}, {1, 11, 12}, {2, 3, 8},  {2, 8, 10},
                          {2, 10, 11}, {3, 4, 7},  {3, 7, 8},   {4, 5, 6},  {4, 6, 7},
                          {5, 6, 9},   {5, 9, 12}, {8, 9, 10},  {9, 10, 12}};
  const Handle twin = {{5, 1, 11}, {5, 4, 12}, {5, 11, 12}, {1, 2, 8}, {1, 8, 10}, {1, 10, 11}, {2, 3, 7},
                       {2, 7, 8},  {3, 4, 6},  {3, 6, 7},   {4, 6, 9}, {4, 9, 12}, {8, 9, 10},  {9, 10, 12}};
  const auto unoriented = [](Handle h, int base) {
    for (Face& f : h) {
      for (int& v : f) v -= base;
      std::sort(f.begin(), f.end());
    }
    std::sort(h.begin(), h.end());
    return h;
  };
  std::set<Handle> stored;
  for (const Handle& h : Expand(Key({5, 4, 3}))) stored.insert(unoriented(h, 0));
  EXPECT_EQ(stored.size(), 120u);
  EXPECT_TRUE(stored.count(unoriented(printed, 1)));
  EXPECT_TRUE(stored.count(unoriented(twin, 1)));
}

TEST(Handles, AreExactlyTheMinimalOnesOfAllConsistentHandles) {
  std::vector<std::vector<int>> keys = Keys(2, 9, 6);
  for (const auto& key : Keys(3, 9, 3)) keys.push_back(key);
  for (const std::vector<int>& key : std::vector<std::vector<int>>{
           {4, 3, 3}, {5, 3, 3}, {4, 4, 3}, {5, 4, 3}, {4, 4, 4}, {3, 3, 3, 3}, {3, 5}, {3, 4, 5}})
    keys.push_back(key);
  for (const auto& sides : keys) {
    const tpa::HandleKey key = Key(sides);
    const std::set<Handle> stored = Expand(key);
    AdvancingFront front(sides, SumOfSquares(*stored.begin(), Mu(sides)));
    front.Run();
    // At least as many as the smallest sum, and none smaller: those without chords are the stored ones.
    std::set<Handle> minimal;
    int least = front.limit;
    for (const Handle& h : front.found) least = std::min(least, SumOfSquares(h, Mu(sides)));
    EXPECT_EQ(least, front.limit) << Name(sides);
    for (const Handle& h : front.found)
      if (!HasChord(h, sides)) minimal.insert(h);
    EXPECT_EQ(minimal.size(), front.found.size()) << Name(sides) << " has minimal handles with chords";
    EXPECT_EQ(stored == minimal, true)
        << Name(sides) << ": stored " << stored.size() << ", minimal " << minimal.size();
  }
}

TEST(Handles, EveryGeneratorOfEveryKeyMakesASphere) {
  for (int k = 2; k <= 4; ++k) {
    const auto keys = Keys(k, 60, 15);
    EXPECT_EQ(keys.size(), k == 2 ? 91u : k == 3 ? 455u : 1820u);
    for (const auto& sides : keys) {
      const tpa::HandleKey key = Key(sides);
      const tpa::u32 generators = tpa::generator_count(key);
      ASSERT_GE(generators, 1u);
      std::set<Handle> distinct;
      int least = 0;
      for (tpa::u32 g = 0; g < generators; ++g) {
        const Handle h = GetGenerator(key, g);
        ASSERT_EQ(WhyNotSphere(h, sides), "") << Name(sides) << " generator " << g << ": " << Print(h);
        ASSERT_FALSE(HasChord(h, sides)) << Name(sides) << " generator " << g << ": " << Print(h);
        const int sum = SumOfSquares(h, Mu(sides));
        if (g == 0) least = sum;
        if (tpa::key_is_complete(key)) {
          ASSERT_EQ(sum, least) << Name(sides) << " generator " << g;
        }
        distinct.insert(h);
      }
      EXPECT_EQ(distinct.size(), generators) << Name(sides);
    }
  }
}

// Ranks and elementary divisors of an integer matrix by elimination (Smith normal form).
std::vector<long> Smith(std::vector<std::vector<long>> m) {
  std::vector<long> divisors;
  const size_t rows = m.size(), columns = rows ? m[0].size() : 0;
  for (size_t t = 0; t < std::min(rows, columns); ++t) {
    for (;;) {
      size_t r = t, c = t;
      long best = 0;
      for (size_t i = t; i < rows; ++i)
        for (size_t j = t; j < columns; ++j)
          if (m[i][j] != 0 && (best == 0 || std::labs(m[i][j]) < best))
            best = std::labs(m[i][j]), r = i, c = j;
      if (best == 0) return divisors;
      std::swap(m[t], m[r]);
      for (auto& row : m) std::swap(row[t], row[c]);
      bool clean = true;
      for (size_t i = t + 1; i < rows; ++i) {
        const long by = m[i][t] / m[t][t];
        if (by != 0)
          for (size_t j = t; j < columns; ++j) m[i][j] -= by * m[t][j];
        clean = clean && m[i][t] == 0;
      }
      for (size_t j = t + 1; j < columns; ++j) {
        const long by = m[t][j] / m[t][t];
        if (by != 0)
          for (size_t i = t; i < rows; ++i) m[i][j] -= by * m[i][t];
        clean = clean && m[t][j] == 0;
      }
      if (clean) break;
    }
    divisors.push_back(std::labs(m[t][t]));
  }
  return divisors;
}

// H0 = Z, H1 = 0, H2 = Z, no torsion, by the boundary matrices of the capped handle.
void ExpectHomologyOfSphere(const Handle& handle, const std::vector<int>& sides) {
  const int mu = Mu(sides), k = static_cast<int>(sides.size());
  const Polygons p = PolygonsOf(sides);
  Handle all = handle;
  for (int v = 0; v < mu; ++v) all.push_back({p.next[size_t(v)], v, mu + p.of[size_t(v)]});
  std::map<std::pair<int, int>, size_t> edges;
  for (const Face& f : all)
    for (size_t c = 0; c < 3; ++c) edges.emplace(std::minmax(f[c], f[(c + 1) % 3]), edges.size());
  std::vector<std::vector<long>> d1(size_t(mu + k), std::vector<long>(edges.size())), d2(edges.size());
  for (const auto& [edge, index] : edges)
    d1[size_t(edge.first)][index] = -1, d1[size_t(edge.second)][index] = 1;
  for (auto& row : d2) row.resize(all.size());
  for (size_t f = 0; f < all.size(); ++f)
    for (size_t c = 0; c < 3; ++c) {
      const int a = all[f][c], b = all[f][(c + 1) % 3];
      d2[edges.at(std::minmax(a, b))][f] = a < b ? 1 : -1;
    }
  const std::vector<long> s1 = Smith(d1), s2 = Smith(d2);
  EXPECT_EQ(s1.size(), size_t(mu + k - 1)) << "H0";
  EXPECT_EQ(edges.size() - s1.size() - s2.size(), 0u) << "rank of H1";
  EXPECT_EQ(all.size() - s2.size(), 1u) << "H2";
  for (long divisor : s1) EXPECT_EQ(divisor, 1) << "torsion";
  for (long divisor : s2) EXPECT_EQ(divisor, 1) << "torsion";
}

TEST(Handles, HomologyIsThatOfASphere) {
  for (int k = 2; k <= 4; ++k)
    for (const auto& sides : Keys(k, k == 4 ? 16 : 18, 15)) {
      const tpa::HandleKey key = Key(sides);
      for (tpa::u32 g = 0; g < tpa::generator_count(key); ++g) {
        SCOPED_TRACE(Name(sides) + " generator " + std::to_string(g));
        ExpectHomologyOfSphere(GetGenerator(key, g), sides);
      }
    }
}

// The orbit under all rotations and exchanges, by applying them to faces.
std::set<Handle> Orbit(const Handle& h, const std::vector<int>& sides) {
  std::vector<int> first(sides.size());
  for (size_t i = 1; i < sides.size(); ++i) first[i] = first[i - 1] + sides[i - 1];
  const Polygons p = PolygonsOf(sides);
  std::set<Handle> orbit{h};
  std::vector<Handle> stack{h};
  const auto visit = [&](const std::vector<int>& image) {
    return [&, image](Handle g) {
      for (Face& f : g)
        for (int& v : f) v = image[size_t(v)];
      g = Normal(g);
      if (orbit.insert(g).second) stack.push_back(g);
    };
  };
  while (!stack.empty()) {
    const Handle g = stack.back();
    stack.pop_back();
    for (size_t i = 0; i < sides.size(); ++i) {
      std::vector<int> image(size_t(Mu(sides)));
      std::iota(image.begin(), image.end(), 0);
      for (int v = 0; v < sides[i]; ++v) image[size_t(first[i] + v)] = p.next[size_t(first[i] + v)];
      visit(image)(g);
      for (size_t j = i + 1; j < sides.size(); ++j) {
        if (sides[i] != sides[j]) continue;
        std::iota(image.begin(), image.end(), 0);
        for (int v = 0; v < sides[i]; ++v)
          image[size_t(first[i] + v)] = first[j] + v, image[size_t(first[j] + v)] = first[i] + v;
        visit(image)(g);
      }
    }
  }
  return orbit;
}

TEST(Handles, OrbitsAreThoseOfRotationsAndExchanges) {
  for (int k = 2; k <= 4; ++k)
    for (const auto& sides : Keys(k, k == 4 ? 14 : 13, 10)) {
      const tpa::HandleKey key = Key(sides);
      std::set<Handle> all;
      for (tpa::u32 g = 0; g < tpa::generator_count(key); ++g) {
        const std::set<Handle> orbit = Orbit(GetGenerator(key, g), sides);
        EXPECT_EQ(orbit.size(), tpa::generator_size(key, g)) << Name(sides) << " generator " << g;
        for (const Handle& h : orbit) EXPECT_TRUE(all.insert(h).second) << Name(sides) << " orbits overlap";
      }
      EXPECT_TRUE(all == Expand(key)) << Name(sides);
    }
}

TEST(Handles, SidesComeInAnyOrder) {
  for (const std::vector<int>& sides :
       std::vector<std::vector<int>>{{3, 5}, {3, 4, 5}, {3, 5, 4}, {4, 3, 3, 5}}) {
    const tpa::HandleKey key = Key(sides);
    std::vector<int> sorted = sides;
    std::sort(sorted.rbegin(), sorted.rend());
    EXPECT_EQ(tpa::handle_count(key), tpa::handle_count(Key(sorted)));
    for (const Handle& h : Expand(key)) ASSERT_EQ(WhyNotSphere(h, sides), "") << Name(sides) << Print(h);
  }
}

TEST(Handles, LongPolygonsGetABalancedOne) {
  for (const std::vector<int>& sides : std::vector<std::vector<int>>{{16, 3},
                                                                     {100, 77},
                                                                     {65535, 3},
                                                                     {65535, 65535},
                                                                     {16, 16, 16},
                                                                     {3, 16, 3},
                                                                     {200, 100, 99},
                                                                     {1000, 3, 3},
                                                                     {65535, 400, 300},
                                                                     {16, 16, 16, 16},
                                                                     {16, 3, 3, 3},
                                                                     {300, 200, 100, 50},
                                                                     {40, 3, 40, 3},
                                                                     {999, 3, 4, 5},
                                                                     {17, 4, 4, 3},
                                                                     {5000, 4999, 4000, 3}}) {
    const tpa::HandleKey key = Key(sides);
    ASSERT_EQ(tpa::generator_count(key), 1u);
    EXPECT_EQ(WhyNotSphere(GetGenerator(key, 0), sides), "") << Name(sides);
    EXPECT_EQ(WhyNotSphere(Get(key, tpa::handle_count(key) - 1), sides), "") << Name(sides);
  }
}

TEST(Handles, RefusesWhatItDoesNotHave) {
  EXPECT_FALSE(tpa::key_is_valid(Key({5, 2})));
  EXPECT_FALSE(tpa::key_is_valid(Key({65536, 3})));
  const tpa::HandleKey key = Key({5, 4, 3});
  std::vector<tpa::HandleFace> faces(14);
  EXPECT_FALSE(tpa::handle_get(key, 120, {faces.data(), 14}));
  EXPECT_FALSE(tpa::handle_get(key, 0, {faces.data(), 13}));
  EXPECT_FALSE(tpa::generator_get(key, 2, {faces.data(), 14}));
}

}  // namespace
