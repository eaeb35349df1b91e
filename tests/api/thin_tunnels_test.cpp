// SPDX-License-Identifier: MIT
// True tunnels and handles far thinner than the edges, there before the step, outlast contacts beside them (P3).
// Tunnels of the exact cut close.
// `uneven_figures` counts more seeds.
#include "support/thin_tunnels.h"

#include "support/field_shapes.h"
#include "support/mixed_seed.h"
#include "support/resolve_trial.h"
#include "support/share.h"
#include "support/step_noise.h"
#include "support/tangle_shapes.h"

namespace thin_tunnels_test {
namespace {

using namespace support;

class ThinTunnels : public testing::TestWithParam<TunnelFamily> {};
class ThinTunnelsLong : public ThinTunnels {};

void PlaySeeds(const TunnelFamily& family, uint64_t from, uint64_t to) {
  uint64_t met = 0;
  for (uint64_t seed = from; seed <= to; ++seed) {
    const TunnelTrial t = PlayTunnel(family, seed);
    const std::string name = family.name + "-" + std::to_string(seed);
    const MeshOnFailure before(name + "-before", t.trial.before), moved(name + "-moved", t.trial.moved),
        result(name + "-result", t.trial.result);
    met += t.met ? 1 : 0;
    EXPECT_EQ(t.trial.outcome, Outcome::right) << name << ": " << t.trial.reason;
    EXPECT_FALSE(t.is_closed) << name << ", " << t.thickness << " edges thin: " << t.reason;
  }
  EXPECT_GT(met, 0u);
}

TEST_P(ThinTunnels, StayOpen) { PlaySeeds(GetParam(), 1, Share(5u)); }
TEST_P(ThinTunnelsLong, StayOpen) { PlaySeeds(GetParam(), 101, 150); }

std::string NameOf(const testing::TestParamInfo<TunnelFamily>& info) {
  std::string name = info.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

// The region of a crumpled ball is a sponge. Merges of its many new vertices leave a part of the ledger for tunnels.
TEST(CrumpledBall, EndsWithoutTunnels) {
  for (uint64_t seed = 1; seed <= Share(6u); ++seed) {
    Random random(MixedSeed("crumpled ball", seed));
    const Mesh ball = Sphere({}, 1, WholeIn(random, 8, 14));
    const Arena arena(GenerousConfig(ball), ball);
    const double by = Uniform(random, 0.5, 2.5) * MeanEdgeOf(ball);
    std::vector<double> targets = ball.positions;
    for (double& x : targets) x += by * Uniform(random, -1, 1);
    const Step step = TakeStep(*arena, targets);
    EXPECT_EQ(step.status, TPA_OK) << seed;
    EXPECT_GT(step.report.contacts, 0u) << seed;
    EXPECT_EQ(TopologyOf(step.result).Genus(), 0) << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Contacts, ThinTunnels, testing::ValuesIn(TunnelFamilies()), NameOf);
INSTANTIATE_TEST_SUITE_P(Contacts, ThinTunnelsLong, testing::ValuesIn(TunnelFamilies()), NameOf);

}  // namespace
}  // namespace thin_tunnels_test
