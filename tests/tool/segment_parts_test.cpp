// SPDX-License-Identifier: MIT
// Parts of the segmentation, each against an oracle of its own: the object, its border and thickness, the voxels that a
// mesh encloses, edges cut in half.
#include <algorithm>
#include <cmath>

#include "support/mesh_on_failure.h"
#include "support/support.h"
#include "tool/segment/balloon.h"
#include "tool/segment/border.h"
#include "tool/segment/filling.h"
#include "tool/segment/outlook.h"
#include "tool/segment/thickness.h"
#include "tool/topology.h"

namespace segment_parts_test {
namespace {

using namespace support;
using tool::operator-;
using tool::Volume;

// Grey values from a function of the voxel.
template <class Grey>
Volume VolumeOf(int nx, int ny, int nz, Grey grey) {
  Volume v;
  v.nx = nx, v.ny = ny, v.nz = nz;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) v.values.push_back(static_cast<float>(grey(i, j, k)));
  return v;
}

const tool::Threshold bright{100, true};

tool::Object ObjectAt(const Volume& v, const tool::Point& seed) {
  tool::Object object;
  const tool::Status found = tool::find_object(v, bright, {seed}, object);
  EXPECT_TRUE(found.ok) << found.message;
  return object;
}

// The solid angle of the mesh at a point over 4 pi: 1 inside, 0 outside (Van Oosterom & Strackee 1983).
double SolidAngle(const Mesh& m, const tool::Point& p) {
  double sum = 0;
  for (size_t t = 0; t < m.triangles.size(); t += 3) {
    tool::Point a[3];
    double size[3];
    for (size_t c = 0; c < 3; ++c) {
      const double* at = &m.positions[3 * size_t{m.triangles[t + c]}];
      a[c] = tool::Point{at[0], at[1], at[2]} - p;
      size[c] = tool::length(a[c]);
    }
    const double below = size[0] * size[1] * size[2] + tool::dot(a[0], a[1]) * size[2] +
                         tool::dot(a[1], a[2]) * size[0] + tool::dot(a[2], a[0]) * size[1];
    sum += 2 * std::atan2(tool::dot(a[0], tool::cross(a[1], a[2])), below);
  }
  return sum / (4 * tool::pi);
}

// Two bars of which the second is a neighbour, connected across an edge only.
double TwoBars(int i, int j, int) { return (i < 6) == (j < 6) ? 200 : 0; }

TEST(Object, IsConnectedAcrossFacesAlone) {
  const Volume v = VolumeOf(12, 12, 4, TwoBars);
  const tool::Object object = ObjectAt(v, {2, 2, 1});
  EXPECT_EQ(object.voxels, 6u * 6 * 4);
  for (int j = 0; j < 12; ++j)
    for (int i = 0; i < 12; ++i) EXPECT_EQ(object.mask[v.index(i, j, 3)], i < 6 && j < 6 ? 1 : 0);
}

TEST(Border, MeasuresContrastNoiseAndArea) {
  Volume v = VolumeOf(20, 20, 20, [](int i, int, int) { return i < 10 ? 180 : 20; });
  v.to_world.axes[0] = {2, 0, 0};
  v.to_world.axes[1] = {0, 0, 3};
  v.to_world.axes[2] = {0, -1, 0};
  const tool::Border plain = tool::measure_border(v, ObjectAt(v, v.to_world({3, 3, 3})));
  EXPECT_EQ(plain.faces, 400u);
  EXPECT_DOUBLE_EQ(plain.area, 400 * 3);
  EXPECT_DOUBLE_EQ(plain.contrast, 160);
  EXPECT_DOUBLE_EQ(plain.noise, 0);
  EXPECT_DOUBLE_EQ(tool::force_width(plain), 2.5);
  std::mt19937_64 random(7);
  std::normal_distribution<float> normal(0, 12);
  for (float& grey : v.values) grey += normal(random);
  const tool::Border noisy = tool::measure_border(v, ObjectAt(v, v.to_world({3, 3, 3})));
  EXPECT_NEAR(noisy.noise, 12, 1);
  EXPECT_NEAR(noisy.contrast, 160, 3);
  EXPECT_DOUBLE_EQ(tool::force_width(noisy), noisy.noise / 4);
}

TEST(Thickness, EdgesAreShorterInThinParts) {
  // A block with a tube of radius 2 out of it, in voxels of half a millimetre.
  Volume v = VolumeOf(60, 24, 24, [](int i, int j, int k) {
    const double away = std::hypot(j - 11.5, k - 11.5);
    return i < 24 ? (away < 11 ? 200 : 0) : (away <= 2.2 ? 200 : 0);
  });
  for (size_t k = 0; k < 3; ++k) v.to_world.axes[k][k] = 0.5;
  const tool::EdgeField field = tool::measure_edges(v, ObjectAt(v, {4, 5.5, 5.5}), 0.1, 0.85);
  EXPECT_EQ(field.part_at({5, 5.75, 5.75}), 1) << "within the block";
  // The tube's radius is one millimetre and a bit.
  for (double x = 16; x < 27; x += 1) EXPECT_NEAR(0.85 * field.part_at({x, 5.75, 5.75}), 0.4, 0.12) << x;
  EXPECT_EQ(tool::measure_edges(v, ObjectAt(v, {4, 5.5, 5.5}), 0.85, 0.85).part_at({20, 5.75, 5.75}), 1);
}

// Lengths that differ from voxel to voxel are graded; voxels that were not chosen keep theirs.
TEST(Thickness, ShortenedEdgesAreGraded) {
  Volume v = VolumeOf(30, 9, 9, [](int, int, int) { return 200; });
  v.to_world.axes[0] = {0.5, 0, 0};
  tool::EdgeField field = tool::measure_edges(v, ObjectAt(v, {1, 4, 4}), 1.7, 1.7);
  std::vector<uint8_t> chosen(v.voxels());
  chosen[v.index(0, 4, 4)] = 1;
  const tool::Object object = ObjectAt(v, {1, 4, 4});
  EXPECT_GT(tool::shorten_edges(v, object, chosen, 0.2, 1.7, field), 4u);
  EXPECT_EQ(tool::shorten_edges(v, object, std::vector<uint8_t>(v.voxels()), 0.2, 1.7, field), 0u);
  EXPECT_GT(tool::shorten_edges(v, object, chosen, 0.2, 1.7, field), 4u);
  EXPECT_NEAR(1.7 * field.part_at({0, 4, 4}), 1.7 / 4, 0.01);
  EXPECT_TRUE(field.is_shortened_at({0, 4, 4}));
  EXPECT_FALSE(field.is_shortened_at({14, 4, 4}));
  EXPECT_EQ(field.part_at({14, 4, 4}), 1);
  for (int k = 0; k < v.nz; ++k)
    for (int j = 0; j < v.ny; ++j)
      for (int i = 0; i < v.nx; ++i) {
        const double here = field.parts[v.index(i, j, k)];
        const double left = i > 0 ? field.parts[v.index(i - 1, j, k)] : here;
        const double front = j > 0 ? field.parts[v.index(i, j - 1, k)] : here;
        const double below = k > 0 ? field.parts[v.index(i, j, k - 1)] : here;
        EXPECT_LE(1.7 / 255 * std::fabs(here - left), 0.25 + 0.01);
        EXPECT_LE(1.7 / 255 * std::fabs(here - front), 0.5 + 0.01);
        EXPECT_LE(1.7 / 255 * std::fabs(here - below), 0.5 + 0.01);
      }
}

TEST(Filling, CountsAsSolidAnglesDo) {
  // A mirrored, oblique map, and a mesh of two parts and a void, wound outwards in millimetres.
  Volume v = VolumeOf(24, 20, 16, [](int i, int j, int k) { return std::hypot(i - 11, j - 9, k - 8) < 6.5 ? 200 : 0; });
  v.to_world.axes[0] = {-0.7, 0.1, 0};
  v.to_world.axes[1] = {0.1, 0.8, 0.05};
  v.to_world.axes[2] = {0, -0.05, 1.1};
  v.to_world.origin = {40, -7, 3};
  ASSERT_LT(tool::determinant(v.to_world), 0);
  const tool::Point middle = v.to_world({11, 9, 8});
  Mesh hollow = Sphere({0, 0, 0}, 1.1, 5);
  for (size_t t = 0; t < hollow.triangles.size(); t += 3) std::swap(hollow.triangles[t + 1], hollow.triangles[t + 2]);
  Mesh m = Together({Sphere({0, 0, 0}, 4.2, 7), hollow, Sphere({8, 0, 0}, 1.5, 4)});
  for (size_t p = 0; p < m.positions.size(); ++p) m.positions[p] += middle[p % 3] + 0.01;
  const MeshOnFailure judged("filled", m);
  const tool::Object object = ObjectAt(v, middle);
  uint64_t inside = 0, beyond = 0;
  for (int k = 0; k < v.nz; ++k)
    for (int j = 0; j < v.ny; ++j)
      for (int i = 0; i < v.nx; ++i) {
        if (SolidAngle(m, v.to_world({double(i), double(j), double(k)})) < 0.5) continue;
        ++(object.mask[v.index(i, j, k)] != 0 ? inside : beyond);
      }
  const tool::Filling filling = tool::compare(v, bright, object, m, 0);
  EXPECT_EQ(filling.object, object.voxels);
  EXPECT_EQ(filling.inside, inside);
  EXPECT_EQ(filling.beyond, beyond);
  EXPECT_GT(beyond, 0u);
  EXPECT_EQ(filling.foreign, 0u);
  uint64_t left_out = 0;
  for (const tool::Piece& piece : filling.left_out) {
    left_out += piece.voxels;
    EXPECT_EQ(piece.world, v.to_world({double(piece.voxel.i), double(piece.voxel.j), double(piece.voxel.k)}));
  }
  if (filling.left_out.size() < tool::most_pieces) {
    EXPECT_EQ(left_out, object.voxels - inside);
  }
}

TEST(Filling, NamesNeighboursAndWhatIsLeftOut) {
  const Volume v = VolumeOf(12, 12, 4, TwoBars);
  const tool::Object object = ObjectAt(v, {2, 2, 1});
  Mesh m = Sphere({6, 6, 1.5}, 1.9, 4);
  const tool::Filling filling = tool::compare(v, bright, object, m, 0);
  ASSERT_EQ(filling.neighbours.size(), 1u);
  EXPECT_EQ(filling.neighbours[0].voxels, filling.foreign);
  EXPECT_GE(filling.neighbours[0].voxel.i, 6);
  EXPECT_GE(filling.neighbours[0].voxel.j, 6);
  ASSERT_EQ(filling.left_out.size(), 1u);
  EXPECT_EQ(filling.left_out[0].voxels, filling.object - filling.inside);
  EXPECT_LT(filling.share(), 0.5);
}

// The distances of centres from a sphere are known, and its mesh is fine.
TEST(Filling, VoxelsWithinReachOfTheMeshAreNear) {
  Volume v = VolumeOf(26, 26, 26, [](int i, int j, int k) { return std::hypot(i - 12, j - 12, k - 12) < 9 ? 200 : 0; });
  v.to_world.axes[0] = {0.5, 0, 0};
  v.to_world.axes[1] = {0.2, 0, 1};
  v.to_world.axes[2] = {0, 0.8, 0};
  const tool::Point middle = v.to_world({12.13, 12.07, 11.91});
  Mesh m = Sphere({0, 0, 0}, 3.3, 40);
  for (size_t p = 0; p < m.positions.size(); ++p) m.positions[p] += middle[p % 3];
  const tool::Object object = ObjectAt(v, middle);
  for (const double reach : {0.0, 0.3, 0.7}) {
    double near = 0, inside = 0, undecided = 0;
    for (int k = 0; k < v.nz; ++k)
      for (int j = 0; j < v.ny; ++j)
        for (int i = 0; i < v.nx; ++i) {
          if (object.mask[v.index(i, j, k)] == 0) continue;
          const double away = tool::length(v.to_world({double(i), double(j), double(k)}) - middle) - 3.3;
          const double margin = 0.002;  // the mesh lies so near to the sphere
          undecided += std::min(std::fabs(away), std::fabs(away - reach)) < margin ? 1 : 0;
          inside += away < 0 ? 1 : 0;
          near += away > 0 && away < reach ? 1 : 0;
        }
    const tool::Filling filling = tool::compare(v, bright, object, m, reach);
    EXPECT_LT(undecided, 20);
    EXPECT_NEAR(static_cast<double>(filling.inside), inside, undecided);
    EXPECT_NEAR(static_cast<double>(filling.near), near, undecided) << reach;
    const std::vector<float> away = tool::distances_left_out(v, object, m, reach);
    uint64_t beyond = 0;
    for (int k = 0; k < v.nz; ++k)
      for (int j = 0; j < v.ny; ++j)
        for (int i = 0; i < v.nx; ++i) {
          const float told = away[v.index(i, j, k)];
          beyond += std::isinf(told) ? 1u : 0u;
          const double true_distance = tool::length(v.to_world({double(i), double(j), double(k)}) - middle) - 3.3;
          if (std::isfinite(told) && told > 0) {
            EXPECT_NEAR(static_cast<double>(told), true_distance, 0.002);
          }
        }
    EXPECT_EQ(beyond, object.voxels - filling.inside - filling.near);
  }
}

// The same for voxels inside that are not of the object: a half of the sphere is empty.
TEST(Filling, VoxelsWithinReachInsideAreTheRim) {
  const Volume v = VolumeOf(26, 26, 26, [](int i, int, int) { return i > 12 ? 200 : 0; });
  Mesh m = Sphere({0, 0, 0}, 7.7, 40);
  const tool::Point middle = {12.13, 12.07, 11.91};
  for (size_t p = 0; p < m.positions.size(); ++p) m.positions[p] += middle[p % 3];
  for (const double reach : {0.0, 0.4, 1.5}) {
    double rim = 0, beyond = 0, undecided = 0;
    for (int k = 0; k < 26; ++k)
      for (int j = 0; j < 26; ++j)
        for (int i = 0; i <= 12; ++i) {
          const double depth = 7.7 - tool::length(tool::Point{double(i), double(j), double(k)} - middle);
          undecided += std::min(std::fabs(depth), std::fabs(depth - reach)) < 0.005 ? 1 : 0;
          rim += depth > 0 && depth < reach ? 1 : 0;
          beyond += depth > 0 && depth >= reach ? 1 : 0;
        }
    const tool::Filling filling = tool::compare(v, bright, ObjectAt(v, {15, 12, 12}), m, reach);
    EXPECT_LT(undecided, 20);
    EXPECT_NEAR(static_cast<double>(filling.rim), rim, undecided) << reach;
    EXPECT_NEAR(static_cast<double>(filling.beyond), beyond, undecided) << reach;
    ASSERT_EQ(filling.leaks.size(), 1u);
    EXPECT_EQ(filling.leaks[0].voxels, filling.beyond);
    EXPECT_LT(filling.leaks[0].voxel.i, 12);
  }
}

// A shell three voxels thick asks for short edges everywhere. The front goes round it with long ones.
TEST(Stretch, FewVerticesLeadTheFront) {
  const Volume v = VolumeOf(33, 33, 33, [](int i, int j, int k) {
    return std::clamp(100 + 60 * (1.5 - std::fabs(std::hypot(i - 16, j - 16, k - 16) - 12)), 0.0, 200.0);
  });
  const tool::Object object = ObjectAt(v, {16, 16, 4});
  const tool::EdgeField edges = tool::measure_edges(v, object, 0.4 * 1.7, 1.7);
  tool::BalloonOptions options;
  options.seeds = {{16, 16, 4}};
  options.radius = 1;
  options.threshold = bright;
  options.width = 1;
  options.noise = 0;
  double work = 0;
  tool::BalloonWatch watch;
  watch.progress = [&](uint64_t, uint32_t vertices, double, double) { work += vertices; };
  tool::Surface surface;
  tool::BalloonResult result;
  const tool::Status done = tool::inflate(v, edges, options, watch, {}, surface, result, nullptr);
  ASSERT_TRUE(done.ok) << done.message;
  const Mesh m = surface.copy();
  const MeshOnFailure judged("shell", m);
  EXPECT_EQ(result.ended, tool::Ended::at_rest);
  // Two spheres, outside and inside, with the edges that the shell asks for.
  EXPECT_EQ(TopologyOf(m).components.size(), 2u);
  const auto cube = [](double r) { return 4.0 / 3 * tool::pi * r * r * r; };
  EXPECT_NEAR(TopologyOf(m).Volume(), cube(13.5) - cube(10.5), 0.03 * cube(13.5));
  EXPECT_NEAR(result.volume, TopologyOf(m).Volume(), 1);
  const double vertices = static_cast<double>(m.positions.size() / 3);
  EXPECT_GT(vertices, 4 * tool::pi * (13.5 * 13.5 + 10.5 * 10.5) / 0.9);
  EXPECT_LT(work, 0.4 * static_cast<double>(result.iterations) * vertices);
}

TEST(Outlook, FollowsTheSpeedOfLate) {
  tool::Outlook outlook;
  EXPECT_FALSE(outlook.seconds_left());
  // Half in ten seconds, and a tenth in the next ten.
  for (int second = 0; second <= 20; ++second) {
    outlook.note(second, second <= 10 ? 0.05 * second : 0.4 + 0.01 * second);
    if (second > 1 && second <= 10) {
      ASSERT_TRUE(outlook.seconds_left());
      EXPECT_NEAR(*outlook.seconds_left(), 20 - second, 1e-9);
    }
  }
  ASSERT_TRUE(outlook.seconds_left());
  EXPECT_NEAR(*outlook.seconds_left(), 40, 1e-9);
  EXPECT_EQ(tool::text_of_progress(7, 100, 0.6, 0.25, 39.2),
            "iteration 7, 100 vertices, 60 % filled, 25 % at rest, full in 40 s at this speed");
  EXPECT_EQ(tool::text_of_progress(7, 100, 0.99, 1, 0.5),
            "iteration 7, 100 vertices, 99 % filled, 100 % at rest, settling");
  for (int second = 21; second < 90; ++second) outlook.note(second, 0.6);
  EXPECT_FALSE(outlook.seconds_left());
}

// In a field that changes from voxel to voxel, sweeps over all edges cut and merge the same edges for ever.
TEST(Rest, ComesAsRemeshingLeavesAloneWhatRests) {
  const Volume v = VolumeOf(17, 17, 17, [](int i, int j, int k) {
    return std::clamp(100 - 30 * (std::hypot(i - 8, j - 8, k - 8) - 5.0), 0.0, 200.0);
  });
  const tool::Object object = ObjectAt(v, {8, 8, 8});
  tool::EdgeField edges = tool::measure_edges(v, object, 1.7, 1.7);
  edges.least = 0.2;
  edges.parts.resize(v.voxels());
  for (int k = 0; k < v.nz; ++k)
    for (int j = 0; j < v.ny; ++j)
      for (int i = 0; i < v.nx; ++i) {
        const size_t id = v.index(i, j, k);
        edges.parts[id] = object.mask[id] == 0 ? 0 : (i / 3 + j / 3 + k / 3) % 2 == 0 ? 51 : 255;
      }
  tool::BalloonOptions options;
  options.seeds = {{8, 8, 8}};
  options.threshold = bright;
  options.width = 0.5;
  options.noise = 0;
  options.most_iterations = 1000;
  tool::Surface surface;
  tool::BalloonResult result;
  const tool::Status done = tool::inflate(v, edges, options, {}, {}, surface, result, nullptr);
  ASSERT_TRUE(done.ok) << done.message;
  const Mesh m = surface.copy();
  const MeshOnFailure judged("swinging", m);
  EXPECT_EQ(result.ended, tool::Ended::at_rest);
  EXPECT_LT(result.iterations, 150u);
  EXPECT_NEAR(TopologyOf(m).Volume(), 4.0 / 3 * tool::pi * 125, 0.05 * 4.0 / 3 * tool::pi * 125);
}

TEST(Parts, VolumesKeepTheirDigitsFarFromTheOrigin) {
  Mesh m = Sphere({0, 0, 0}, 1, 6);
  const double there = tool::parts_of(m)[0].volume;
  EXPECT_NEAR(there, TopologyOf(m).Volume(), 1e-12);
  // A shift that rounds places to 2^-22.
  for (double& x : m.positions) x = (x + 0x1p30) - 0x1p30;
  const double rounded = tool::parts_of(m)[0].volume;
  for (double& x : m.positions) x += 0x1p30;
  EXPECT_EQ(tool::parts_of(m)[0].volume, rounded);
}

}  // namespace
}  // namespace segment_parts_test
