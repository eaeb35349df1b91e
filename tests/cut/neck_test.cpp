// SPDX-License-Identifier: MIT
// Loops of a ring that stay connected. The shape is a core with petals round it; the ring is the surface round the
// core, with a loop for each petal. Some petals are pinched within the ring: their loops are alone, all others stay
// together.
#include "cut/neck.h"

#include <cmath>
#include <map>
#include <set>

#include "support/library_mesh.h"
#include "support/point.h"
#include "support/support.h"

namespace {

using namespace support;

// 0 up to `from`, 1 beyond `to`.
double Ramp(double x, double from, double to) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// Directions of petals: in a plane, or along the axes. Turned a little, lest symmetry hide a fault.
std::vector<Point> Petals(int count) {
  std::vector<Point> petals;
  if (count == 6) {
    for (int axis = 0; axis < 3; ++axis)
      for (double side : {-1.0, 1.0}) {
        Point p{};
        p[static_cast<size_t>(axis)] = side;
        petals.push_back(p);
      }
  } else {
    for (int i = 0; i < count; ++i) petals.push_back({std::cos(2 * pi * i / count), std::sin(2 * pi * i / count), 0});
  }
  for (Point& p : petals) {
    const double c = std::cos(0.3), s = std::sin(0.3);
    p = {c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]};
    p = {p[0], c * p[1] - s * p[2], s * p[1] + c * p[2]};
  }
  return petals;
}

// A core of radius .2 with petals as far out as 1.2.
Mesh Flower(const std::vector<Point>& petals) {
  return Mapped(Sphere({0, 0, 0}, 1, 24), [&](const Point& u) {
    double r = 0.2;
    for (const Point& p : petals) r += std::exp(-(1 - Dot(u, p)) / 0.08);
    return Scaled(r, u);
  });
}

// The feet of some petals are drawn together to their axes, and through them.
Point Pinched(const Point& p, const std::vector<Point>& petals, const std::set<size_t>& pinched) {
  for (const size_t i : pinched) {
    const double along = Dot(p, petals[i]);
    if (along < 0.7 * Length(p)) continue;
    const double keep = 1 - 1.5 * Ramp(along, 0.3, 0.42) * (1 - Ramp(along, 0.46, 0.58));
    Point q;
    for (size_t k = 0; k < 3; ++k) q[k] = along * petals[i][k] + keep * (p[k] - along * petals[i][k]);
    return q;
  }
  return p;
}

// Afterwards the straight way from petal to petal leaves the body.
Point Bent(const Point& p) { return {p[0], p[1], p[2] - 1.5 * (p[0] * p[0] + p[1] * p[1])}; }

// Petals of one axis as far out as their loops are bent to gutters: half of their faces look to the middle of the loop.
Point Folded(const Point& p, const Point& axis) {
  const Point side = Unit(Cross(axis, {0, 0, 1})), top = Unit(Cross(side, axis));
  const double along = Dot(p, axis), across = Dot(p, side);
  const double fold = Ramp(std::fabs(along), 0.5, 0.62);
  const double up = (1 - 0.8 * fold) * Dot(p, top) + 12 * fold * across * across;
  return Sum(Scaled(along, axis), Sum(Scaled(across, side), Scaled(up, top)));
}

struct Ring : LibraryMesh {
  NearFacesWithMemory near_faces;
  tpa::Clusters clusters;
  tpa::NeckScratch scratch;

  Ring(const Mesh& mesh, const std::vector<uint32_t>& members)
      : LibraryMesh(mesh),
        near_faces(VertexCount(mesh), m.face_count),
        vertices_(VertexCount(mesh)),
        clusters_(vertices_, tpa::none),
        members_(members),
        cuts_(3 * m.face_count),
        loops_(m.face_count),
        walked_(m.face_count),
        fronts_(vertices_, 1),
        ring_(vertices_),
        levels_(vertices_),
        skeleton_(vertices_) {
    near_faces.Arrange(m);
    for (uint32_t v : members_) clusters_[v] = members_[0];
    clusters.cluster = clusters_.data();
    clusters.walked = walked_.data();
    clusters.members = {members_.data(), static_cast<uint32_t>(members_.size()),
                        static_cast<uint32_t>(members_.size())};
    clusters.cuts = {cuts_.data(), static_cast<uint32_t>(cuts_.size()), 0};
    clusters.loops = {loops_.data(), static_cast<uint32_t>(loops_.size()), 0};
    scratch = {fronts_.data(), levels_.data(), {ring_.data(), vertices_}, {skeleton_.data(), vertices_}};
    uint64_t cuts = 0;
    EXPECT_TRUE(tpa::find_loops(m, clusters, cuts));
  }

 private:
  uint32_t vertices_;
  std::vector<uint32_t> clusters_, members_;
  std::vector<tpa::Cut> cuts_;
  std::vector<tpa::CutLoop> loops_;
  std::vector<uint8_t> walked_;
  std::vector<uint32_t> fronts_, ring_;
  std::vector<uint8_t> levels_;
  std::vector<tpa::Front> skeleton_;
};

struct Case {
  int petals;
  bool bent, hollow;
  bool folded = false;
};

class Neck : public testing::TestWithParam<Case> {};

// The petals with loops on one leg, by the legs of part_legs().
std::set<std::set<size_t>> LegsOf(const Case& c, const std::set<size_t>& pinched) {
  const std::vector<Point> petals = Petals(c.petals);
  const Mesh flower = Flower(petals);
  Mesh m = Mapped(flower, [&](const Point& p) {
    const Point q = Pinched(p, petals, pinched);
    return c.bent ? Bent(q) : c.folded ? Folded(q, petals[0]) : q;
  });
  if (c.hollow)
    for (size_t f = 0; f < m.triangles.size(); f += 3) std::swap(m.triangles[f + 1], m.triangles[f + 2]);
  std::vector<uint32_t> members;
  for (uint32_t v = 0; v < VertexCount(flower); ++v)
    if (Length(PositionOf(flower, v)) < 0.7) members.push_back(v);
  Ring ring(m, members);
  EXPECT_EQ(ring.clusters.loops.size, petals.size());
  for (tpa::CutLoop& loop : ring.clusters.loops) loop.piece = 12345;
  tpa::part_legs(ring.m, ring.near_faces.g, c.hollow ? 1 : 0, ring.clusters, ring.clusters.loops.span(), ring.scratch);
  std::map<uint32_t, std::set<size_t>> legs;
  for (const tpa::CutLoop& loop : ring.clusters.loops) {
    const Point p = PositionOf(flower, ring.m.corner[ring.clusters.cuts[loop.first].half_edge]);
    size_t own = 0;
    for (size_t i = 0; i < petals.size(); ++i)
      if (Dot(p, petals[i]) > Dot(p, petals[own])) own = i;
    legs[loop.piece].insert(own);
  }
  std::set<std::set<size_t>> out;
  for (const auto& [name, leg] : legs) out.insert(leg);
  return out;
}

TEST_P(Neck, LoopsOfPinchedPetalsAreAlone) {
  const auto count = static_cast<size_t>(GetParam().petals);
  for (size_t mask = 0; mask < size_t{1} << count; ++mask) {
    std::set<size_t> pinched, others;
    std::set<std::set<size_t>> expected;
    for (size_t i = 0; i < count; ++i) (mask >> i & 1 ? pinched : others).insert(i);
    for (const size_t i : pinched) expected.insert({i});
    if (!others.empty()) expected.insert(others);
    EXPECT_EQ(LegsOf(GetParam(), pinched), expected) << "pinched: " << testing::PrintToString(pinched);
  }
}

TEST(Neck, LoopsThatDoNotTellWhatTheyRunRoundStayTogether) {
  const std::set<std::set<size_t>> together{{0, 1}};
  for (const bool hollow : {false, true})
    for (const std::set<size_t>& pinched : std::vector<std::set<size_t>>{{}, {0}, {1}, {0, 1}})
      EXPECT_EQ(LegsOf({2, false, hollow, true}, pinched), together) << "pinched: " << testing::PrintToString(pinched);
}

INSTANTIATE_TEST_SUITE_P(Petals, Neck,
                         testing::Values(Case{2, false, false}, Case{2, true, false}, Case{2, false, true},
                                         Case{3, false, false}, Case{3, true, false}, Case{3, true, true},
                                         Case{4, true, false}, Case{6, false, false}));

}  // namespace
