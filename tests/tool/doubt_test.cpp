// SPDX-License-Identifier: MIT
// Contacts in doubt: tips of an arch meet in grey values near the threshold, on arches small and large.
#include "tool/segment/doubt.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tool/segment/mask_surface.h"
#include "tool/topology.h"
#include "tool/workers.h"

namespace doubt_test {
namespace {

constexpr double depth = 10, middle = 8;

// Of the bar. A body so large that closing the gap changes little of it.
constexpr int thick = 12;

// Two posts on a bar, `height` voxels high, and a beam with a gap of a voxel in the middle.
tool::TriangleMesh OpenArch(tool::Volume& grid, int height) {
  grid.nx = 17, grid.ny = 5, grid.nz = height + thick + 3;
  grid.values.assign(static_cast<size_t>(grid.nx * grid.ny * grid.nz), static_cast<float>(100 + depth));
  std::vector<uint8_t> mask(grid.voxels(), 0);
  for (int k = 1; k < grid.nz - 1; ++k)
    for (int i = 1; i < 16; ++i) {
      const bool is_bar = k <= thick, is_beam = k > thick + height, is_post = std::abs(i - 8) > (height + 1) / 2;
      mask[grid.index(i, 2, k)] = is_bar || is_post || (is_beam && i != 8) ? 1 : 0;
    }
  return tool::mask_surface(grid, mask);
}

struct Trial {
  double noise = 20;
  int height = 1;
  double away = 0;  // of the grey values, from the threshold
};

// Moves the tips through each other, and asks. Receives how many vertices stay where they are then.
bool IsHeld(const Trial& trial, size_t& stayed) {
  tool::Volume grid;
  const tool::TriangleMesh arch = OpenArch(grid, trial.height);
  const tool::BalloonOptions options;
  const tool::EdgeField edges;
  tool::Surface surface;
  tool::BalloonResult result;
  const tool::Workers workers(1);
  tool::Forces forces{grid, {}, 1, {100 - trial.away, true}};
  forces.noise = trial.noise;
  tool::Balloon b{options, edges, surface, result, forces, workers, {}, {}, {}, {}};
  const tool::Status started = surface.start(tool::balloon_config(), arch);
  EXPECT_TRUE(started.ok) << started.message;
  if (!started) return false;
  tool::adopt(b);
  b.particles.assign(b.x.size() / 3, {});
  std::vector<uint32_t> moved;
  std::vector<double> targets;
  for (uint32_t v = 0; 3 * size_t{v} < b.x.size(); ++v) {
    double* p = &b.x[3 * size_t{v}];
    if (p[2] < thick + 0.9 + trial.height || std::fabs(p[0] - middle) > 0.75) continue;
    p[0] -= std::copysign(0.75, p[0] - middle);
    moved.push_back(v);
    targets.insert(targets.end(), p, p + 3);
  }
  tpa_move_input move{};
  move.struct_size = sizeof move;
  move.count = static_cast<uint32_t>(moved.size());
  move.position_type = TPA_FLOAT64;
  move.positions = targets.data();
  move.vertices = moved.data();
  const tool::Status stepped = surface.run([&](tpa_context* c, tpa_issue* issue) {
    const tpa_status s = tpa_move(c, &move, issue);
    return s != TPA_OK ? s : tpa_step(c, nullptr, nullptr, issue);
  });
  EXPECT_TRUE(stepped.ok) << stepped.message;
  EXPECT_EQ(tool::parts_of(surface.copy())[0].genus, 1);
  const bool held = tool::hold_doubtful_contacts(b);
  stayed = 0;
  for (const uint32_t v : moved)
    if (b.particles[v].gain == 0 && b.x[3 * size_t{v}] == b.mesh.positions[3 * size_t{v}]) ++stayed;
  return held;
}

TEST(Doubt, IsWhereNoiseMayHaveMadeATunnel) {
  size_t stayed = 0;
  EXPECT_TRUE(IsHeld({}, stayed));
  EXPECT_GT(stayed, 4u);
  EXPECT_FALSE(IsHeld({0, 1, 0}, stayed)) << "an image without noise";
  EXPECT_FALSE(IsHeld({20, 1, 60}, stayed)) << "grey values beyond noise";
  EXPECT_FALSE(IsHeld({20, 9, 0}, stayed)) << "a tunnel wider than noise makes";
  EXPECT_EQ(stayed, 0u);
}

}  // namespace
}  // namespace doubt_test
