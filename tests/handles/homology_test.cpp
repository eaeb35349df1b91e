// SPDX-License-Identifier: MIT
// Every stored generator of every key closes the caps to a sphere and is stored once: homology over the
// integers and links (criterion 4.1), faces, orientation, chords, and the orbits under rotations and
// exchanges.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "oracle/smith.h"
#include "support/handle_support.h"

namespace homology_test {
namespace {

using handle_support::Face;
using handle_support::Handle;
using handle_support::Name;
using handle_support::Sides;

// ---------------------------------------------------------------- the routine itself

smith::Matrix Sparse(const std::vector<std::vector<int64_t>>& dense) {
  smith::Matrix m;
  for (const auto& row : dense) {
    m.emplace_back();
    for (size_t j = 0; j < row.size(); ++j)
      if (row[j] != 0) m.back().push_back({static_cast<int>(j), row[j]});
  }
  return m;
}

TEST(Smith, FindsDivisorsOfKnownMatrices) {
  using Divisors = std::vector<int64_t>;
  EXPECT_EQ(smith::ElementaryDivisors(Sparse({{2, 0}, {0, 3}}), 2), (Divisors{1, 6}));
  EXPECT_EQ(smith::ElementaryDivisors(Sparse({{2, 4, 4}, {-6, 6, 12}, {10, -4, -16}}), 3), (Divisors{2, 6, 12}));
  EXPECT_EQ(smith::ElementaryDivisors(Sparse({{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}), 3), (Divisors{1, 3}));
  EXPECT_EQ(smith::ElementaryDivisors(Sparse({{0, 0}, {0, 0}}), 2), Divisors{});
  EXPECT_EQ(smith::ElementaryDivisors(Sparse({{4, 6}}), 2), Divisors{2});
  EXPECT_EQ(smith::ElementaryDivisors({}, 0), Divisors{});
}

// Operations on rows and columns do not change the divisors.
TEST(Smith, FindsDivisorsAgainAfterRandomOperations) {
  std::mt19937 random(1);
  const std::vector<int64_t> divisors = {1, 1, 1, 2, 2, 6, 30};
  for (int round = 0; round < 200; ++round) {
    std::vector<std::vector<int64_t>> m(10, std::vector<int64_t>(9));
    for (size_t i = 0; i < divisors.size(); ++i) m[i][i] = divisors[i];
    for (int i = 0; i < 20; ++i) {
      const size_t a = random() % 10, b = (a + 1 + random() % 9) % 10, c = random() % 9, d = (c + 1 + random() % 8) % 9;
      const int64_t sign = random() % 2 ? 1 : -1;
      for (size_t j = 0; j < 9; ++j) m[a][j] += sign * m[b][j];
      for (auto& row : m) row[c] -= sign * row[d];
    }
    ASSERT_EQ(smith::ElementaryDivisors(Sparse(m), 9), divisors);
  }
}

std::vector<Face> NearFaces(int n, bool flip) {
  // A square of n by n whose sides are glued, two of them the wrong way round if flip.
  const auto vertex = [&](int i, int j) {
    if (i == n && flip) j = 2 * n - j;
    return (i % n) * n + j % n;
  };
  std::vector<Face> faces;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      faces.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      faces.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  return faces;
}

TEST(Smith, TellsSurfacesApart) {
  const std::vector<Face> tetrahedra = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {0, 2, 3},
                                        {4, 5, 6}, {4, 7, 5}, {5, 7, 6}, {4, 6, 7}};
  EXPECT_EQ(smith::HomologyOf({tetrahedra.begin(), tetrahedra.begin() + 4}, 4), smith::sphere);
  EXPECT_EQ(smith::HomologyOf(tetrahedra, 8), (smith::Homology{{2, 0, 2}, {}}));
  EXPECT_EQ(smith::HomologyOf({tetrahedra.begin(), tetrahedra.begin() + 3}, 4), (smith::Homology{{1, 0, 0}, {}}));
  std::vector<Face> moebius, projective;
  for (int i = 0; i < 7; ++i) {
    moebius.push_back({i, (i + 1) % 7, (i + 3) % 7});
    moebius.push_back({i, (i + 2) % 7, (i + 3) % 7});
  }
  for (int i = 0; i < 5; ++i) {
    projective.push_back({5, i, (i + 1) % 5});
    projective.push_back({i, (i + 1) % 5, (i + 3) % 5});
  }
  EXPECT_EQ(smith::HomologyOf(moebius, 7), (smith::Homology{{1, 2, 1}, {}}));
  EXPECT_EQ(smith::HomologyOf(NearFaces(5, false), 25), (smith::Homology{{1, 2, 1}, {}}));
  EXPECT_EQ(smith::HomologyOf(projective, 6), (smith::Homology{{1, 0, 0}, {{{}, {2}}}}));
  EXPECT_EQ(smith::HomologyOf(NearFaces(5, true), 25), (smith::Homology{{1, 1, 0}, {{{}, {2}}}}));
}

// ---------------------------------------------------------------- every generator

// The handle's own faces take each edge of a polygon from a vertex to the next, once, and never back. Any other edge
// joins two polygons and is taken once each way.
std::string WhyNotHandle(const Handle& h, const Sides& sides) {
  const handle_support::Polygons p = handle_support::PolygonsOf(sides);
  const int mu = handle_support::Mu(sides);
  std::vector<char> taken(static_cast<size_t>(mu * mu));
  const auto at = [&](int a, int b) -> char& { return taken[static_cast<size_t>(a * mu + b)]; };
  for (const Face& f : h)
    for (size_t c = 0; c < 3; ++c) {
      if (f[c] < 0 || f[c] >= mu) return "a corner";
      if (at(f[c], f[(c + 1) % 3])++) return "an edge twice in one direction";
    }
  for (int a = 0; a < mu; ++a)
    for (int b = 0; b < mu; ++b) {
      const bool forward = p.next[size_t(a)] == b, backward = p.next[size_t(b)] == a;
      if (forward ? !at(a, b) : backward && at(a, b)) return "a polygon's edge the wrong way round";
      if (forward || backward) continue;
      if (at(a, b) != at(b, a)) return "an open edge";
      if (at(a, b) && p.of[size_t(a)] == p.of[size_t(b)]) return "an edge inside a polygon";
    }
  return "";
}

// Every link is one simple polygon: a walk round a vertex from face to face comes back after all its faces.
std::string WhyNotManifold(const Handle& capped, int vertices) {
  std::vector<int> after(static_cast<size_t>(vertices * vertices), -1), faces(static_cast<size_t>(vertices)),
      some(static_cast<size_t>(vertices));
  for (const Face& f : capped)
    for (size_t c = 0; c < 3; ++c) {
      int& next = after[static_cast<size_t>(f[c] * vertices + f[(c + 1) % 3])];
      if (next >= 0) return "a vertex twice in a link";
      next = f[(c + 2) % 3];
      ++faces[size_t(f[c])];
      some[size_t(f[c])] = next;
    }
  for (int v = 0; v < vertices; ++v) {
    int at = some[size_t(v)], steps = 0;
    do at = after[static_cast<size_t>(v * vertices + at)], ++steps;
    while (at >= 0 && at != some[size_t(v)]);
    if (at < 0 || steps != faces[size_t(v)] || steps < 3) return "a link that is not one simple polygon";
  }
  return "";
}

void CheckGenerator(const Handle& h, const Sides& sides) {
  const int k = static_cast<int>(sides.size()), mu = handle_support::Mu(sides);
  ASSERT_EQ(static_cast<int>(h.size()), mu + 2 * k - 4);
  ASSERT_EQ(WhyNotHandle(h, sides), "");
  ASSERT_FALSE(handle_support::HasChord(h, sides));
  const Handle capped = handle_support::WithCaps(h, sides);
  ASSERT_EQ(WhyNotManifold(capped, mu + k), "");
  ASSERT_TRUE(smith::HomologyOf(capped, mu + k) == smith::sphere);
}

// The handles that the library gives for one orbit are distinct and belong to it. A small orbit is complete; of a large
// orbit they are some, at steps that meet rotations and exchanges of all kinds.
void CheckExpansion(const tpa::HandleKey& key, const Sides& sides, tpa::u64 first, tpa::u64 size,
                    const std::vector<uint8_t>& code) {
  constexpr tpa::u64 small = 500, some = 7;
  std::set<Handle> orbit;
  const tpa::u64 step = size <= small ? 1 : (size - 1) / some;
  for (tpa::u64 i = 0; i < size; i += step) {
    const Handle h = handle_support::Get(key, first + i);
    ASSERT_TRUE(handle_support::SymmetryOf(h, sides).code == code) << "handle " << first + i;
    ASSERT_TRUE(orbit.insert(h).second) << "handle " << first + i << " comes twice";
  }
}

void CheckKey(const Sides& sides) {
  const tpa::HandleKey key = handle_support::Key(sides);
  const tpa::u32 generators = tpa::generator_count(key);
  EXPECT_EQ(tpa::handle_face_count(key), static_cast<tpa::u32>(handle_support::Mu(sides)) + 2 * key.k - 4);
  ASSERT_GE(generators, 1u) << Name(sides);
  std::set<std::vector<uint8_t>> codes;
  tpa::u64 handles = 0;
  for (tpa::u32 g = 0; g < generators; ++g) {
    SCOPED_TRACE(Name(sides) + " generator " + std::to_string(g));
    const Handle h = handle_support::GetGenerator(key, g);
    ASSERT_NO_FATAL_FAILURE(CheckGenerator(h, sides)) << handle_support::Print(h);
    const handle_support::Symmetry symmetry = handle_support::SymmetryOf(h, sides);
    ASSERT_EQ(tpa::generator_size(key, g) * symmetry.stabiliser, handle_support::GroupOrder(sides));
    ASSERT_TRUE(codes.insert(symmetry.code).second) << "is equivalent to one before";
    const tpa::u64 size = tpa::generator_size(key, g);
    ASSERT_NO_FATAL_FAILURE(CheckExpansion(key, sides, handles, size, symmetry.code));
    handles += size;
  }
  EXPECT_EQ(tpa::handle_count(key), handles) << Name(sides);
}

void CheckKeys(int k, size_t part, size_t parts) {
  for (const Sides& sides : handle_support::PortionOfKeys(k, part, parts)) CheckKey(sides);
}

TEST(Homology, Pairs) { CheckKeys(2, 0, 1); }
TEST(Homology, Triples) { CheckKeys(3, 0, 1); }
TEST(Homology, Quadruples1) { CheckKeys(4, 0, 4); }
TEST(Homology, Quadruples2) { CheckKeys(4, 1, 4); }
TEST(Homology, Quadruples3) { CheckKeys(4, 2, 4); }
TEST(Homology, Quadruples4) { CheckKeys(4, 3, 4); }

}  // namespace
}  // namespace homology_test
