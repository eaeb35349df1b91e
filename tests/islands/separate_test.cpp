// SPDX-License-Identifier: MIT
// Surfaces that lie upon each other but for rounding: grids against powers of two written down by hand, moves against
// normals of the test, contacts against all pairs.
#include "islands/separate.h"

#include <cmath>
#include <set>

#include "islands/rules.h"
#include "support/open_island.h"

namespace separate_test {
namespace {

using namespace support;

// ---------------------------------------------------------------- the grid

void ExpectSeparation(const tpa::Separation& s, double flat, double grid) {
  EXPECT_EQ(s.flat, flat);
  EXPECT_EQ(s.grid, grid);
  EXPECT_EQ(s.outward, 16 * grid);
  EXPECT_EQ(s.reach, 64 * grid);
}

// Coordinates up to a power of two round by 2^-53 of it; the first grid is 2^17 times as coarse.
TEST(Grid, IsAPartOfTheLargestCoordinate) {
  for (int e : {-60, -20, 0, 20, 60}) {
    const double power = std::ldexp(1, e);
    for (double largest : {.5000001, .75, 1.}) {
      const tpa::Scale scale{largest * power, power};
      ExpectSeparation(tpa::separation_of(scale, 0), 0x1p-47 * power, 0x1p-36 * power);
    }
    ExpectSeparation(tpa::separation_of({1.0000001 * power, 2 * power}, 0), 0x1p-46 * power, 0x1p-35 * power);
  }
}

TEST(Grid, IsFourTimesAsCoarseInEachPass) {
  for (uint32_t pass = 0; pass < 8; ++pass)
    ExpectSeparation(tpa::separation_of({1, 1}, pass), 0x1p-47, std::ldexp(0x1p-36, 2 * static_cast<int>(pass)));
}

// Merging reaches three hundredths of the shortest edge.
TEST(Grid, IsAtMostAShareOfTheShortestEdge) {
  EXPECT_EQ(tpa::grid_share, 0.03 / 64);
  const double edge = 0x1p-36 / (0.03 / 64);
  ExpectSeparation(tpa::separation_of({1, edge * (1 + 1e-12)}, 0), 0x1p-47, 0x1p-36);
  ExpectSeparation(tpa::separation_of({1, edge * (1 - 1e-12)}, 0), 0x1p-47, 0x1p-37);
  for (double shortest : {1e-4, 1e-6, 1e-8, 1e-10}) {
    const tpa::Separation s = tpa::separation_of({1, shortest}, 5);
    EXPECT_LE(s.reach, .03 * shortest);
    EXPECT_GT(s.reach, .03 * shortest / 2 * (shortest < 1e-4 ? 1 : 0));
  }
}

TEST(Grid, IsNoFinerThanTheCoordinates) {
  for (double shortest : {1e-15, 1e-300}) ExpectSeparation(tpa::separation_of({1, shortest}, 0), 0x1p-53, 0x1p-53);
}

// ---------------------------------------------------------------- lengths

TEST(ScaleOfContacts, IsThatOfTheFacesInContact) {
  const Mesh lower = Box({0, 0, 0}, {3, 1, 1}, 2), upper = Box({1, .25, .5}, {2, .75, 2}, 1);
  for (double far : {0., 1e9})
    for (const Mesh& idle : {Sphere({0, 0, 50}, 1, 3), Sphere({0, 0, 5}, .001, 2), Sphere({-1e12, 0, 0}, 1e9, 2)}) {
      const Mesh m = Translated(Together({lower, upper, idle}), {0, far, 0});
      const OpenIsland island(m, m, tpa::Mode::adapt);
      double largest = 0, shortest = 1e300;
      for (const auto& [f, g] : AllMeetingPairs(m))
        for (uint32_t face : {f, g})
          for (size_t i = 0; i < 3; ++i) {
            const Point p = PositionOf(m, m.triangles[3 * face + i]),
                        q = PositionOf(m, m.triangles[3 * face + (i + 1) % 3]);
            for (double x : p) largest = std::max(largest, std::abs(x));
            shortest = std::min(shortest, Distance(p, q));
          }
      const tpa::Scale scale = tpa::scale_of_contacts(island.w);
      EXPECT_EQ(scale.largest, largest);
      EXPECT_NEAR(scale.shortest, shortest, 1e-12 * shortest);
    }
}

// ---------------------------------------------------------------- faces upon each other

// Two boxes, the upper one turned a little about an edge: their common face is nearly one plane.
Mesh Tilted(double by) {
  const Mesh upper = Mapped(Box({0, 0, 1}, {1, 1, 2}, 1), [&](const Point& p) {
    return Point{p[0], p[1], p[2] + (p[0] - .5) * by};
  });
  return Together({Box({0, 0, 0}, {1, 1, 1}, 1), upper});
}

std::set<uint32_t> NearlyFlat(const Mesh& m, double flat) {
  OpenIsland island(m, m, tpa::Mode::adapt);
  tpa::find_nearly_flat(island.w, {flat, 0, 0, 0});
  const tpa::Span<const uint32_t> faces = island.w.relocation.faces.span();
  for (uint32_t f = 0; f < TriangleCount(m); ++f) EXPECT_EQ(island.w.relocation.face_mark[f], 0);
  return {faces.begin(), faces.end()};
}

// Whether a face lies in the plane z = 1, but for the tilt.
bool IsInTheMiddle(const Mesh& m, uint32_t f) {
  for (size_t i = 0; i < 3; ++i)
    if (std::abs(PositionOf(m, m.triangles[3 * f + i])[2] - 1) > .1) return false;
  return true;
}

TEST(NearlyFlat, AreFacesInContactWithinTheDistance) {
  for (double by : {0x1p-10, 0x1p-30, 0x1p-40}) {
    const Mesh m = Tilted(by);
    // Tilted by as much on each side, the corners are half of it from the plane.
    const std::set<uint32_t> found = NearlyFlat(m, .5 * by * (1 + 1e-2));
    EXPECT_EQ(found.size(), 4u);
    for (uint32_t f : found) EXPECT_TRUE(IsInTheMiddle(m, f));
    EXPECT_TRUE(NearlyFlat(m, .5 * by * (1 - 1e-1)).empty());
  }
}

TEST(NearlyFlat, AreNoFacesInOnePlane) { EXPECT_TRUE(NearlyFlat(Tilted(0), 1e-3).empty()); }

TEST(NearlyFlat, AreNoFacesThatCrossSteeply) {
  const Mesh m = Together({Box({0, 0, 0}, {1, 1, 1}, 1), Box({.5, .25, .5}, {2, .75, 2}, 1)});
  EXPECT_TRUE(NearlyFlat(m, 1e-3).empty());
}

// ---------------------------------------------------------------- moves

TEST(Separated, VerticesMoveOutwardAndToTheGridAndNoOthers) {
  const double by = 0x1p-10;
  for (double far : {0., 512.}) {
    const Mesh m = Translated(Together({Tilted(by), Sphere({0, 0, 9}, 1, 3)}), {far, 0, 0});
    const tpa::Separation s{by, 0x1p-8, 16 * 0x1p-8, 64 * 0x1p-8};
    OpenIsland island(m, m, tpa::Mode::adapt);
    tpa::Attempt a = island.Attempt(0, 1);
    tpa::find_nearly_flat(island.w, s);
    std::set<uint32_t> moved;
    for (uint32_t f : island.w.relocation.faces)
      for (size_t i = 0; i < 3; ++i) moved.insert(m.triangles[3 * f + i]);
    ASSERT_EQ(moved.size(), 8u);
    tpa::separate(a, s);
    const Mesh now = island.Now();
    double reach = 0;
    for (uint32_t v = 0; v < VertexCount(m); ++v) {
      const Point p = PositionOf(m, v), q = PositionOf(now, v);
      if (moved.count(v) == 0) {
        EXPECT_EQ(p, q);
        continue;
      }
      Point outward{};
      for (size_t h = 0; h < m.triangles.size(); ++h) {
        if (m.triangles[h] != v) continue;
        const Point b = PositionOf(m, m.triangles[h / 3 * 3 + (h + 1) % 3]),
                    c = PositionOf(m, m.triangles[h / 3 * 3 + (h + 2) % 3]);
        outward = Sum(outward, Cross(Difference(b, p), Difference(c, p)));
      }
      const Point wanted = Sum(p, Scaled(16 * 0x1p-8, Unit(outward)));
      for (size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(q[i], wanted[i], 0x1p-9 * (1 + 1e-6));
        EXPECT_EQ(q[i], std::round(q[i] * 0x1p8) * 0x1p-8);
      }
      reach = std::max(reach, Distance(p, q));
    }
    // Beside faces in contact sides bend, up to their far corners.
    EXPECT_GT(a.region.reach, reach);
    EXPECT_LT(a.region.reach, std::sqrt(3.) + reach);
    // Outward moves only add.
    EXPECT_GT(a.region.gained, 10 * a.region.lost);
    Pairs found;
    for (const tpa::Contact& c : island.w.detection.pairs) found.emplace_back(c.a, c.b);
    EXPECT_EQ(found, AllMeetingPairs(now));
    EXPECT_FALSE(found.empty());
  }
}

}  // namespace
}  // namespace separate_test
