// Meshes that are tangled when they are loaded (P2); resolve_test.cpp has families of them.
#include "share.h"
#include "support.h"

namespace {

using namespace support;

TEST(Adapt, TangledSpheresBecomeTheirUnion) {
  for (uint64_t seed = 1; seed <= Share(40u); ++seed) {
    Random random(seed);
    const Mesh m = Together({Sphere({0, 0, 0}, 1, 6), Sphere(RandomPoint(random, -0.6, 0.6), 0.9, 6)});
    if (AllMeetingPairs(m).empty()) continue;
    Arena arena(ConfigFor(m), m);
    auto report = Sized<tpa_report>();
    ASSERT_EQ(tpa_adapt(*arena, nullptr, &report, nullptr), TPA_OK);
    const Mesh after = MeshOf(*arena);
    const Topology t = TopologyOf(after);
    EXPECT_EQ(t.defect, "") << "seed " << seed;
    EXPECT_EQ(report.unresolved, AllMeetingPairs(after).size()) << "seed " << seed;
    EXPECT_EQ(report.unresolved, 0u) << "seed " << seed;
    EXPECT_EQ(t.Genera(), (std::vector<int64_t>{0})) << Written(after, "adapt-seed-" + std::to_string(seed));
  }
}

TEST(Adapt, WhateverIsLeftIsCountedAndTheMeshIsAManifold) {
  for (uint64_t seed = 1; seed <= Share(60u); ++seed) {
    Random random(seed);
    Mesh m = Together({Sphere({0, 0, 0}, 1, 4), Torus({0.8, 0, 0}, 0.9, 0.4, 12, 6)});
    const double noise = Uniform(random, 0, 0.5);
    for (double& x : m.positions) x += Uniform(random, -noise, noise);
    tpa_config config = ConfigFor(m);
    config.max_contacts = 1 << 14;
    Arena arena(config, m);
    auto report = Sized<tpa_report>();
    tpa_issue issue;
    ASSERT_EQ(tpa_adapt(*arena, nullptr, &report, &issue), TPA_OK) << "seed " << seed << ": " << Text(issue);
    const Mesh after = MeshOf(*arena);
    EXPECT_EQ(TopologyOf(after).defect, "") << "seed " << seed;
    EXPECT_EQ(report.unresolved, AllMeetingPairs(after).size())
        << "seed " << seed << "; " << Written(after, "adapt-left-seed-" + std::to_string(seed));
  }
}

}  // namespace
