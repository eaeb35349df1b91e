// SPDX-License-Identifier: MIT
// The volume of the region is kept in parts from commit to commit, and has the bits of a context that knows no part:
// one restored before the call. It is the volume that the oracle measures.
#include <gtest/gtest.h>

#include "support/field_shapes.h"
#include "support/state_support.h"
#include "support/support.h"

namespace region_volume_test {
namespace {

using namespace support;

std::unique_ptr<Arena> TwinOf(const tpa_config& config, const tpa_context* context) {
  const Bytes bytes = SavedFrom(context);
  auto twin = std::make_unique<Arena>(config);
  EXPECT_EQ(tpa_restore(**twin, bytes.data(), bytes.size(), nullptr), TPA_OK);
  return twin;
}

tpa_report StepOf(tpa_context* context) {
  auto report = Sized<tpa_report>();
  EXPECT_EQ(tpa_step(context, nullptr, &report, nullptr), TPA_OK);
  return report;
}

// Pushes a place of the surface, far enough to join bodies at times; sometimes the first vertex alone, or all.
void Push(tpa_context* context, Random& random) {
  const Mesh m = MeshOf(context);
  const uint64_t kind = random() % 8;
  const uint32_t middle = kind == 0 ? 0 : static_cast<uint32_t>(random() % VertexCount(m));
  const Point place = PositionOf(m, middle), way = RandomPoint(random, -.5, .5);
  const double reach = kind == 0 ? 1e-9 : kind == 1 ? 100 : Uniform(random, .05, .4);
  const Mesh to = Mapped(m, [&](Point p) {
    const double share = std::max(0., 1 - Distance(p, place) / reach);
    for (size_t k = 0; k < 3; ++k) p[k] += (kind == 0 ? .01 : share) * (Distance(p, place) < reach ? way[k] : 0);
    return p;
  });
  EXPECT_EQ(MoveAll(context, to.positions), TPA_OK);
}

void CommitOtherwise(tpa_context* context, Random& random) {
  if (random() % 2 == 0) {
    auto options = Sized<tpa_remesh_options>();
    options.iterations = 2;
    options.target_length = Uniform(random, .8, 1.2) * MeanEdgeOf(MeshOf(context));
    EXPECT_EQ(tpa_remesh(context, &options, nullptr, nullptr, nullptr), TPA_OK);
  } else {
    auto all = Sized<tpa_smooth_options>();
    all.iterations = 2;
    EXPECT_EQ(tpa_smooth(context, &all, nullptr, nullptr, nullptr), TPA_OK);
  }
}

TEST(RegionVolume, IsThatOfARestoredContext) {
  uint32_t events = 0;
  for (uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Mesh m = Together({Sphere({0, 0, 0}, 1, 20), Sphere({2.02, 0, 0}, 1, 12), Sphere({9, 0, 0}, 2, 24)});
    tpa_config config = ConfigFor(m);
    config.max_vertices = 4 * VertexCount(m);
    const Arena arena(config, m);
    for (int step = 0; step < 12; ++step) {
      if (random() % 4 == 0) CommitOtherwise(*arena, random);
      Push(*arena, random);
      const auto twin = TwinOf(config, *arena);
      const tpa_report report = StepOf(*arena), of_twin = StepOf(**twin);
      EXPECT_EQ(report.region_after, of_twin.region_after) << step;
      EXPECT_EQ(report.region_before, of_twin.region_before) << step;
      const double volume = TopologyOf(MeshOf(*arena)).Volume();
      EXPECT_NEAR(report.region_after, volume, 1e-9 * volume) << step;
      events += report.groups;
    }
  }
  EXPECT_GT(events, 5u);
}

}  // namespace
}  // namespace region_volume_test
