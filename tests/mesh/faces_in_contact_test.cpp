// SPDX-License-Identifier: MIT
// How far hulls lie from faces in contact, against the oracle's distances to the triangles that meet at the targets.
#include "mesh/faces_in_contact.h"

#include <algorithm>
#include <cmath>

#include "mesh/region_change.h"
#include "oracle/region_report.h"
#include "oracle/triangle_distance.h"
#include "support/open_island.h"

namespace faces_in_contact_test {
namespace {

using namespace support;

// Two balls that the step moves into each other.
struct Meeting {
  Mesh from = Together({Sphere({0, 0, 0}, 1, 4), Sphere({0.1, 0.2, 2.3}, 1, 4)});
  Mesh to = Together({Sphere({0, 0, 0}, 1, 4), Sphere({0.1, 0.2, 1.7}, 1, 4)});
  OpenIsland island{from, to};
  std::vector<TriangleCorners> contacts = TrianglesInContact(to);
};

double Nearest(const std::vector<TriangleCorners>& triangles, const Point& p) {
  double nearest = 1e300;
  for (const TriangleCorners& t : triangles) {
    const Point corner[3] = {t[0], t[1], t[2]};
    nearest = std::min(nearest, SquaredDistanceToTriangle(p, corner));
  }
  return std::sqrt(nearest);
}

tpa::Vec3 VecOf(const Point& p) { return {p[0], p[1], p[2]}; }

TEST(FacesInContact, AreThoseThatMeetAtTheTargets) {
  Meeting m;
  uint32_t count = 0;
  for (uint32_t f : m.island.t.met.faces) {
    const uint32_t* v = m.to.triangles.data() + 3 * f;
    const TriangleCorners t = {PositionOf(m.to, v[0]), PositionOf(m.to, v[1]), PositionOf(m.to, v[2])};
    EXPECT_EQ(std::count(m.contacts.begin(), m.contacts.end(), t), 1);
    ++count;
  }
  EXPECT_EQ(count, m.contacts.size());
  EXPECT_GT(count, 4u);
}

TEST(FacesInContact, AreNoFartherFromAHullThanTold) {
  Meeting m;
  tpa::FacesInContact& met = m.island.t.met;
  for (uint64_t seed = 1; seed <= 200; ++seed) {
    Random random(seed);
    Point corner[4];
    tpa::Vec3 hull[4];
    const Point place = RandomPoint(random, -2, 2);
    for (int i = 0; i < 4; ++i) hull[i] = VecOf(corner[i] = Sum(place, RandomPoint(random, -.3, .3)));
    const double told = met.reach_of(hull, 4, tpa::none, 0);
    double least = 0;
    for (int i = 0; i < 50; ++i) {
      double share[4], sum = 0;
      for (double& s : share) sum += s = Uniform(random, 0, 1);
      Point p{};
      for (int k = 0; k < 4; ++k) p = Sum(p, Scaled(share[k] / sum, corner[k]));
      least = std::max(least, Nearest(m.contacts, p));
    }
    for (const Point& p : corner) least = std::max(least, Nearest(m.contacts, p));
    EXPECT_GE(told, least * (1 - 1e-9)) << seed;
    // No farther from a triangle than its corner that is the nearest of all, and the hull's size.
    EXPECT_LE(told, least + .6 * std::sqrt(3.)) << seed;
    EXPECT_EQ(met.reach_of(hull, 4, tpa::none, told), told) << seed;
    EXPECT_EQ(met.reach_of(hull, 4, tpa::none, 2 * told), 2 * told) << seed;
    EXPECT_EQ(met.reach_of(hull, 4, *met.faces.begin(), .5 * told), told) << seed;
  }
}

TEST(FacesInContact, WithoutAnyNothingIsTold) {
  OpenIsland island(Sphere({0, 0, 0}, 1, 3));
  const tpa::Vec3 p{5, 5, 5};
  EXPECT_EQ(island.t.met.reach_of(&p, 1, tpa::none, .25), .25);
}

TEST(FacesInContact, NearAVertexAreOriginsOfItsFaces) {
  Meeting m;
  const tpa::FacesInContact& met = m.island.t.met;
  const tpa::Mesh& mesh = m.island.w.edit.mesh;
  for (uint32_t h = 0; h < 3 * mesh.face_count; ++h) {
    const uint32_t f = tpa::face_of(h), near = met.near(mesh.corner[h], f);
    if (met.contains(f)) {
      EXPECT_EQ(near, f);
      continue;
    }
    bool any = false;
    tpa::for_each_outgoing(mesh, mesh.corner[h], [&](uint32_t g) { any = any || met.contains(tpa::face_of(g)); });
    EXPECT_EQ(near != tpa::none, any);
    EXPECT_TRUE(near == tpa::none || met.contains(near));
  }
}

TEST(RegionChange, DepthIsTheRadiusOfABall) {
  for (double radius : {0x1p-100, 1e-9, .3, 1., 7., 0x1p100}) {
    const double depth = tpa::depth_of(8 * 3.14159265358979 * radius * radius * radius);
    EXPECT_GE(depth, radius * (1 - 1e-12));
    EXPECT_LE(depth, radius * (1 + 1e-5));
  }
  EXPECT_EQ(tpa::depth_of(0), 0);
}

// Of a body by which the region changes, hulls tell where it lies, and its volume how deep.
TEST(RegionChange, OfABodyReachesAsFarAsItsHullsAndItsDepth) {
  const double six_volumes = 8 * 3.14159265358979 * .25 * .25 * .25;  // a ball of radius .25
  for (double before : {0., .125, .25, .75, 1.125, 1.25, 1.5})
    for (double far : {0., .5, 1.}) {
      tpa::RegionChange change;
      change.reach = before;
      change.add_bounded(six_volumes, [&](double so_far) {
        EXPECT_LE(so_far, before);
        return std::max(so_far, far);
      });
      EXPECT_NEAR(change.reach, std::max(before, far + .25), 1e-5) << before << " " << far;
      if (before > far + .2501) {
        EXPECT_EQ(change.reach, before) << far;
      }
    }
}

// A new tip upon a face in contact goes sideways: the sweep reaches the far corners of its faces.
TEST(RegionChange, ReachesTheCornersOfFacesThatAMoveBends) {
  const Mesh box = Box({0, 0, 0}, {2, 2, 2}, 2);
  uint32_t middle = 0;
  for (uint32_t v = 0; v < VertexCount(box); ++v)
    if (PositionOf(box, v) == Point{1, 1, 2}) middle = v;
  OpenIsland island(box);
  const tpa::Mesh& m = island.w.edit.mesh;
  const uint32_t f = tpa::face_of(m.vertex_edge[middle]);
  island.t.met.faces.add(f);
  tpa::RegionChange change;
  change.met = &island.t.met;
  const tpa::Vec3 from = m.position[middle], to{1, 1, 2.125};
  tpa::set_position(island.w.edit, middle, to);
  change.add_move(m, middle, from, to);
  double far = 0;
  const uint32_t* v = box.triangles.data() + 3 * f;
  const Point t[3] = {PositionOf(box, v[0]), PositionOf(box, v[1]), PositionOf(box, v[2])};
  tpa::for_each_neighbour(
      m, middle, [&](uint32_t u) { far = std::max(far, std::sqrt(SquaredDistanceToTriangle(PositionOf(box, u), t))); });
  EXPECT_NEAR(change.reach, far, 1e-12);
  EXPECT_GE(far, 1);
  EXPECT_GT(change.gained, 0);
}

}  // namespace
}  // namespace faces_in_contact_test
