// SPDX-License-Identifier: MIT
// Meshes tangled from the start (P2); resolve_test.cpp has families of them.
#include "support/share.h"
#include "support/support.h"

namespace adapt_test {
namespace {

using namespace support;

// With room for as many contacts as noise makes.
tpa_config ConfigForTangle(const Mesh& m) {
  tpa_config config = DefaultConfig(16 * VertexCount(m) + 1024);
  config.max_contacts = 1 << 14;
  return config;
}

tpa_report Adapt(tpa_context* context, uint64_t seed) {
  auto report = Sized<tpa_report>();
  tpa_issue issue;
  EXPECT_EQ(tpa_adapt(context, nullptr, &report, &issue), TPA_OK) << "seed " << seed << ": " << Text(issue);
  return report;
}

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
    Arena arena(ConfigForTangle(m), m);
    const tpa_report report = Adapt(*arena, seed);
    const Mesh after = MeshOf(*arena);
    EXPECT_EQ(TopologyOf(after).defect, "") << "seed " << seed;
    EXPECT_EQ(report.unresolved, AllMeetingPairs(after).size())
        << "seed " << seed << "; " << Written(after, "adapt-left-seed-" + std::to_string(seed));
  }
}

// The most components possible: two triangles each, back to back, bounding nothing.
TEST(Adapt, TrianglesBackToBackAreComponentsAndGo) {
  const Mesh tetrahedron{{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}};
  std::vector<Mesh> parts;
  const uint32_t flat = 100;
  for (uint32_t i = 0; i < flat; ++i) {
    const double x = 3.0 * i;
    parts.push_back({{x, 0, 0, x + 1, 0, 0, x, 1, 0}, {0, 1, 2, 0, 2, 1}});
  }
  parts.insert(parts.begin() + flat / 2, Translated(tetrahedron, {0, 0, 5}));
  const Mesh m = Together(parts);
  tpa_config config = ConfigFor(m);
  config.max_vertices = VertexCount(m);
  config.max_events = flat + 1;
  Arena arena(config, m);
  auto validation = Sized<tpa_validation>();
  ASSERT_EQ(tpa_validate(*arena, nullptr, &validation, nullptr), TPA_OK);
  EXPECT_EQ(validation.components, flat + 1);
  EXPECT_EQ(validation.euler, 2 * (flat + 1));
  EXPECT_EQ(validation.self_intersections, flat);
  auto report = Sized<tpa_report>();
  tpa_issue issue;
  ASSERT_EQ(tpa_adapt(*arena, nullptr, &report, &issue), TPA_OK) << Text(issue);
  EXPECT_EQ(VertexCount(MeshOf(*arena)), 4u);
  EXPECT_EQ(TopologyOf(MeshOf(*arena)).Genera(), std::vector<int64_t>{0});
  EXPECT_EQ(report.unresolved, 0u);
  uint32_t deaths = 0;
  for (const tpa_event& e : EventsOf(*arena)) deaths += e.type == TPA_EVENT_DEATH ? 1u : 0u;
  EXPECT_EQ(deaths, flat);
}

// Nothing is left then, and calls go on.
TEST(Adapt, TrianglesBackToBackAloneLeaveNothing) {
  std::vector<Mesh> parts;
  for (const double x : {0., 3., 6.}) parts.push_back({{x, 0, 0, x + 1, 0, 0, x, 1, 0}, {0, 1, 2, 0, 2, 1}});
  const Mesh m = Together(parts);
  Arena arena(ConfigFor(m), m);
  auto report = Sized<tpa_report>();
  ASSERT_EQ(tpa_adapt(*arena, nullptr, &report, nullptr), TPA_OK);
  EXPECT_EQ(report.vertices, 0u);
  EXPECT_EQ(report.triangles, 0u);
  auto remesh = Sized<tpa_remesh_options>();
  remesh.iterations = 1;
  remesh.target_length = 1;
  EXPECT_EQ(tpa_remesh(*arena, &remesh, nullptr, nullptr, nullptr), TPA_OK);
  EXPECT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_OK);
  EXPECT_EQ(tpa_adapt(*arena, nullptr, nullptr, nullptr), TPA_OK);
  ASSERT_EQ(Load(*arena, Sphere({0, 0, 0}, 1, 3)), TPA_OK);
  EXPECT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_OK);
}

TEST(Adapt, TrianglesBackToBackAmongOthersGo) {
  for (uint64_t seed = 1; seed <= Share(300u); ++seed) {
    Random random(seed);
    std::vector<Mesh> parts;
    const size_t flat = 1 + random() % 40;
    for (size_t i = 0; i < flat; ++i) {
      const Point middle = RandomPoint(random, -1, 1);
      Mesh part{{}, {0, 1, 2, 0, 2, 1}};
      for (int v = 0; v < 3; ++v) {
        const Point p = RandomPoint(random, -0.7, 0.7);
        for (size_t k = 0; k < 3; ++k) part.positions.push_back(middle[k] + p[k]);
      }
      parts.push_back(part);
    }
    const Mesh one = Sphere(RandomPoint(random, -0.4, 0.4), 0.8, 4),
               two = Sphere(RandomPoint(random, -0.4, 0.4), 0.6, 5);
    parts.push_back(one);
    parts.push_back(two);
    const Mesh m = Together(parts);
    Arena arena(ConfigForTangle(m), m);
    const tpa_report report = Adapt(*arena, seed);
    EXPECT_EQ(report.unresolved, 0u) << "seed " << seed;
    // The topology is as without the flat components.
    const Mesh others = Together({one, two});
    Arena without(ConfigFor(others), others);
    ASSERT_EQ(tpa_adapt(*without, nullptr, nullptr, nullptr), TPA_OK) << "seed " << seed;
    const Mesh after = MeshOf(*arena);
    const Topology t = TopologyOf(after), expected = TopologyOf(MeshOf(*without));
    EXPECT_EQ(t.defect, "") << Written(after, "adapt-flat-seed-" + std::to_string(seed));
    EXPECT_EQ(t.Genera(), expected.Genera()) << Written(after, "adapt-flat-seed-" + std::to_string(seed));
  }
}

}  // namespace
}  // namespace adapt_test
