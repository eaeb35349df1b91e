// SPDX-License-Identifier: MIT
// Failing steps and adaptations: the issue says why, and all state stays as before (P1).
#include <functional>

#include "oracle/commit_oracle.h"
#include "support/step_scenes.h"
#include "support/support.h"
#include "support/tangles.h"

namespace failure_test {
namespace {

using namespace support;

TEST(Failure, AStepOnATangledMeshNamesAPair) {
  const Mesh m = Together({Sphere({0, 0, 0}, 1, 5), Sphere({1, 0.1, 0.2}, 1, 5)});
  Arena arena(ConfigFor(m), m);
  const Observed before = Observe(*arena);
  tpa_issue issue;
  const auto expect = [&](tpa_status status) {
    EXPECT_EQ(status, TPA_E_TANGLED);
    EXPECT_EQ(issue.status, TPA_E_TANGLED);
    EXPECT_TRUE(TrianglesMeet(m, static_cast<uint32_t>(issue.element), static_cast<uint32_t>(issue.other)));
    EXPECT_TRUE(Observe(*arena) == before);
  };
  expect(tpa_step(*arena, nullptr, nullptr, &issue));
  auto remesh = Sized<tpa_remesh_options>();
  remesh.iterations = 1;
  remesh.target_length = 0.5;
  expect(tpa_remesh(*arena, &remesh, nullptr, nullptr, &issue));
  auto smooth = Sized<tpa_smooth_options>();
  smooth.iterations = 1;
  expect(tpa_smooth(*arena, &smooth, nullptr, nullptr, &issue));
}

// A mesh for a step, or without targets for adapt.
struct Call {
  Mesh mesh;
  std::vector<double> targets;
};

// Balls over a plate. Once in touch, ball and plate have three edges between their rims: cuts drawn back on both sides
// would be neighbours, so new vertices are needed.
Call BallsOntoPlate() {
  const Mesh plate = Box({-1, -1, -.2}, {1, 1, 0}, 8);
  Call c{Together({plate, Sphere({-.45, 0, .35}, .3, 4), Sphere({.45, .1, .35}, .3, 4)}), {}};
  c.targets = c.mesh.positions;
  for (size_t i = plate.positions.size() + 2; i < c.targets.size(); i += 3) c.targets[i] -= 0.15;
  return c;
}

// Forces later attempts: only they put more triangles in than they take out.
Call CrumpledSphere() {
  Call c{Sphere({0, 0, 0}, 1, 5), {}};
  Random random(21);
  c.targets = ShakenTargets(c.mesh, .3, random);
  return c;
}

Call ThreeSpheresThatMeet() {
  return {Together({Sphere({0, 0, 0}, 1, 4), Sphere({1.7, 0.1, 0.2}, 1, 4), Sphere({0.9, 2.0, 0.1}, 1, 4)}), {}};
}

using SetLimit = std::function<void(tpa_config&, uint32_t)>;

// Raises one limit from `least` until the call succeeds. Until then every failure names the limit, and leaves all state
// as before; in the end the result is the result under ample limits.
void ExhaustLimit(int32_t limit, uint32_t least, const SetLimit& set, const Call& call) {
  const Mesh& m = call.mesh;
  const bool adapt = call.targets.empty();
  const auto run = [&](tpa_context* context, tpa_issue* issue) {
    if (adapt) return tpa_adapt(context, nullptr, nullptr, issue);
    return tpa_step(context, nullptr, nullptr, issue);
  };
  const auto prepare = [&](Arena& arena) {
    ASSERT_EQ(Load(*arena, m), TPA_OK);
    if (!adapt) {
      ASSERT_EQ(MoveAll(*arena, call.targets), TPA_OK);
    }
  };
  tpa_config config = ConfigFor(m);
  Arena ample(config);
  prepare(ample);
  tpa_issue issue;
  ASSERT_EQ(run(*ample, &issue), TPA_OK) << Text(issue);
  const Observed expected = Observe(*ample);
  int failures = 0;
  for (uint32_t n = least; n < least + 2000; ++n) {
    config = ConfigFor(m);
    set(config, n);
    Arena arena(config);
    prepare(arena);
    if (testing::Test::HasFatalFailure()) return;
    const Observed before = Observe(*arena);
    const tpa_status status = run(*arena, &issue);
    if (status == TPA_OK) {
      EXPECT_TRUE(Observe(*arena) == expected) << "limit " << limit << " at " << n << " succeeds otherwise";
      EXPECT_GT(failures, 0) << "limit " << limit << " was never met";
      return;
    }
    ++failures;
    ASSERT_EQ(status, TPA_E_LIMIT) << Text(issue);
    ASSERT_EQ(issue.limit, limit) << Text(issue);
    EXPECT_EQ(issue.available, n) << Text(issue);
    EXPECT_GT(issue.needed, n) << Text(issue);
    ASSERT_TRUE(Observe(*arena) == before) << "limit " << limit << " at " << n;
    // Targets are kept: the same call fails the same way.
    tpa_issue again;
    EXPECT_EQ(run(*arena, &again), status);
    EXPECT_EQ(again.needed, issue.needed);
    ASSERT_TRUE(Observe(*arena) == before) << "limit " << limit << " at " << n;
  }
  FAIL() << "limit " << limit << " of " << least + 2000 << " is still too low";
}

class Exhausting : public testing::TestWithParam<bool> {
 protected:
  static Call Called() { return GetParam() ? ThreeSpheresThatMeet() : BallsOntoPlate(); }
};

TEST_P(Exhausting, Contacts) {
  ExhaustLimit(
      TPA_LIMIT_CONTACTS, 1, [](tpa_config& c, uint32_t n) { c.max_contacts = n; }, Called());
}
// The paper's way of a step cuts edges; tpa_adapt divides faces.
TEST_P(Exhausting, CutEdgesOrPieces) {
  if (GetParam())
    ExhaustLimit(
        TPA_LIMIT_PIECES, 1, [](tpa_config& c, uint32_t n) { c.max_pieces = n; }, Called());
  else
    ExhaustLimit(
        TPA_LIMIT_CUT, 3, [](tpa_config& c, uint32_t n) { c.max_cut_edges = n; }, Called());
}
TEST_P(Exhausting, Vertices) {
  ExhaustLimit(
      TPA_LIMIT_VERTICES, VertexCount(Called().mesh),
      [](tpa_config& c, uint32_t n) {
        const tpa_config ample = c;
        c.max_vertices = n;
        // The other limits stay ample.
        c.max_triangles = 2 * ample.max_vertices + 1024;
        c.max_contacts = ample.max_vertices / 2 + 1024;
        c.max_cut_edges = ample.max_vertices / 4 + 1024;
        c.max_events = ample.max_vertices / 128 + 256;
      },
      Called());
}
TEST_P(Exhausting, Triangles) {
  const Call call = GetParam() ? ThreeSpheresThatMeet() : CrumpledSphere();
  ExhaustLimit(
      TPA_LIMIT_TRIANGLES, TriangleCount(call.mesh), [](tpa_config& c, uint32_t n) { c.max_triangles = n; }, call);
}

TEST_P(Exhausting, Events) {
  ExhaustLimit(
      TPA_LIMIT_EVENTS, 1, [](tpa_config& c, uint32_t n) { c.max_events = n; }, Called());
}

// A neck whose sides have passed each other comes in two. In a step it is so thin and short that the caps are little of
// the body.
Call TurnedNeck() {
  std::vector<Point> points;
  std::vector<double> radii;
  for (int i = -10; i <= 10; ++i) {
    points.push_back({(std::abs(i) > 5 ? 0.25 : 0.05) * i, 0.01, 0.02});
    radii.push_back(std::abs(i) > 5 ? 0.7 : 0.05 + 0.01 * std::abs(i));
  }
  Call c{Tube(points, radii, 12, {0.1, 0.2, 1}), {}};
  c.targets = c.mesh.positions;
  for (size_t i = 0; i < c.targets.size(); i += 3)
    if (c.targets[i] == 0) c.targets[i + 1] *= -0.5, c.targets[i + 2] *= -0.5;
  return c;
}

TEST_P(Exhausting, Components) {
  const Call call = GetParam() ? Call{MakeTangle(TangleFamily("inverted-waists"), 1).mesh, {}} : TurnedNeck();
  ExhaustLimit(
      TPA_LIMIT_COMPONENTS, 1, [](tpa_config& c, uint32_t n) { c.max_components = n; }, call);
}

INSTANTIATE_TEST_SUITE_P(StepAndAdapt, Exhausting, testing::Bool(),
                         [](const auto& given) { return given.param ? "adapt" : "step"; });

TEST(Failure, TargetsSurviveAndCanBeCorrected) {
  const Mesh m = Together({Sphere({0, 0, 0}, 1, 5), Sphere({2.3, 0.1, 0}, 1, 5)});
  tpa_config config = ConfigFor(m);
  config.max_contacts = 1;
  Arena arena(config, m);
  std::vector<double> targets = m.positions;
  for (size_t i = 0; i < targets.size(); i += 3) targets[i] += i < targets.size() / 2 ? 0.2 : -0.2;
  ASSERT_EQ(MoveAll(*arena, targets), TPA_OK);
  ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_E_LIMIT);
  // The first sphere goes back to its place; the targets of the second sphere still stand.
  auto move = Sized<tpa_move_input>();
  move.count = VertexCount(m) / 2;
  move.position_type = TPA_FLOAT64;
  move.positions = m.positions.data();
  ASSERT_EQ(tpa_move(*arena, &move, nullptr), TPA_OK);
  ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_OK);
  const Mesh after = MeshOf(*arena);
  for (size_t i = m.positions.size() / 2; i < m.positions.size(); i += 3)
    EXPECT_EQ(after.positions[i], m.positions[i] - 0.2);
}

// Noise so large that vertices stay behind, as in Step.WhatIsRolledBackSaysWhere.
TEST(Failure, TheListOfVerticesLeftBehindOutlastsCallsThatFail) {
  Random random(1);
  const Mesh m = Sphere({0, 0, 0}, 1, 6);
  tpa_config config = DefaultConfig(16 * VertexCount(m));
  config.max_contacts = 1 << 13;
  config.max_cut_edges = 1 << 14;
  config.max_passes = 1;
  Arena arena(config, m);
  ASSERT_EQ(MoveAll(*arena, CoincidingTargets(m, random)), TPA_OK);
  auto report = Sized<tpa_report>();
  ASSERT_EQ(tpa_step(*arena, nullptr, &report, nullptr), TPA_OK);
  const uint32_t* vertices = nullptr;
  uint32_t count = 0;
  ASSERT_EQ(tpa_rolled_back(*arena, &vertices, &count), TPA_OK);
  ASSERT_GT(count, 1u);
  EXPECT_EQ(count, report.rolled_back_vertices);
  const Mesh stepped = MeshOf(*arena);
  const std::vector<double> longest = LongestEdges(m);
  const std::vector<tpa_vertex_origin> origins = VertexOriginsOf(*arena);
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t v = vertices[i];
    ASSERT_LT(v, origins.size());
    EXPECT_TRUE(i == 0 || vertices[i - 1] < v);
    ASSERT_EQ(origins[v].parents[1], TPA_NONE);
    // Cuts part surfaces that touch by 2^-10 of an edge.
    EXPECT_LE(Distance(PositionOf(stepped, v), PositionOf(m, origins[v].parents[0])),
              0x1p-9 * longest[origins[v].parents[0]]);
  }
  const Observed before = Observe(*arena);
  const auto expect_as_before = [&](const char* after) { EXPECT_TRUE(Observe(*arena) == before) << after; };

  auto validation = Sized<tpa_validation>();
  ASSERT_EQ(tpa_validate(*arena, nullptr, &validation, nullptr), TPA_OK);
  expect_as_before("tpa_validate");
  ASSERT_EQ(Load(*arena, Sphere({0, 0, 0}, 1, 30)), TPA_E_LIMIT);
  expect_as_before("tpa_load");
  auto remesh = Sized<tpa_remesh_options>();
  remesh.iterations = 1;
  remesh.target_length = 1e-3;
  tpa_issue issue;
  ASSERT_EQ(tpa_remesh(*arena, &remesh, nullptr, nullptr, &issue), TPA_E_LIMIT);
  expect_as_before("tpa_remesh");
  std::vector<double> targets = MeshOf(*arena).positions;
  for (double& x : targets) x = Uniform(random, -1, 1);
  ASSERT_EQ(MoveAll(*arena, targets), TPA_OK);
  ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, &issue), TPA_E_LIMIT) << Text(issue);
  expect_as_before("tpa_step");
}

// A ring is lowered onto another, tilted: they meet along an arc whose rims are longer than a handle's may be.
Call RingsAlongAnArc() {
  const Mesh ring = Torus({0, 0, 0}, 1, .06, 400, 16);
  const Mesh above = Mapped(ring, [](const Point& p) { return Point{p[0], p[1], p[2] + .1205 + .004 * (p[0] + 1)}; });
  Call c{Together({ring, above}), {}};
  c.targets = c.mesh.positions;
  for (size_t i = ring.positions.size() + 2; i < c.targets.size(); i += 3) c.targets[i] -= 0.003;
  return c;
}

// Such a contact is cut exactly, whatever the limits.
TEST(Failure, RimsTooLongForCandidatesAreNoLimit) {
  const Call call = RingsAlongAnArc();
  tpa_config config = ConfigFor(call.mesh);
  std::string expected;
  for (uint32_t cuts : {1u << 16, 1u << 13, 2048u}) {
    config.max_cut_edges = cuts;
    Arena arena(config, call.mesh);
    ASSERT_EQ(MoveAll(*arena, call.targets), TPA_OK);
    auto report = Sized<tpa_report>();
    tpa_issue issue;
    ASSERT_EQ(tpa_step(*arena, nullptr, &report, &issue), TPA_OK) << Text(issue);
    EXPECT_EQ(report.rolled_back_vertices, 0u);
    EXPECT_EQ(report.caps + report.handles[0], 0u);
    EXPECT_GT(report.contacts, 1000u);
    const std::string bytes = Observe(*arena).bytes;
    if (expected.empty()) expected = bytes;
    EXPECT_TRUE(bytes == expected) << cuts;
  }
}

}  // namespace
}  // namespace failure_test
