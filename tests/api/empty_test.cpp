// SPDX-License-Identifier: MIT
// A context without a mesh, and a mesh without triangles: the answer of every function of the interface.
#include <vector>

#include "support/support.h"

namespace empty_test {
namespace {

using namespace support;

// The statuses of all functions that take a context, by name. A caller's arrays of zero elements serve as results.
struct Answer {
  const char* function;
  tpa_status status;
};

std::vector<Answer> Readings(const tpa_context* c) {
  tpa_issue issue;
  auto view = Sized<tpa_mesh_view>();
  auto out = Sized<tpa_mesh_output>();
  out.position_type = TPA_FLOAT64, out.index_type = TPA_UINT32;
  auto vertices = Sized<tpa_vertex_map_view>();
  auto triangles = Sized<tpa_triangle_map_view>();
  auto changes = Sized<tpa_change_list>();
  uint32_t count = 0;
  const float before = 0;
  const double before_f64 = 0;
  float after = 0;
  double after_f64 = 0;
  std::vector<Answer> answers{
      {"tpa_view", tpa_view(c, &view)},
      {"tpa_export", tpa_export(c, &out, &issue)},
      {"tpa_components", tpa_components(c, nullptr, 0, nullptr, &count, &issue)},
      {"tpa_vertex_map", tpa_vertex_map(c, &vertices)},
      {"tpa_triangle_map", tpa_triangle_map(c, &triangles)},
      {"tpa_changes", tpa_changes(c, &changes, &issue)},
      {"tpa_carry_vertices", tpa_carry_vertices(c, &before, 1, &after)},
      {"tpa_carry_vertices_f64", tpa_carry_vertices_f64(c, &before_f64, 1, &after_f64)},
      {"tpa_carry_triangles", tpa_carry_triangles(c, &before, 1, &after)},
  };
  EXPECT_EQ(view.vertex_count + view.triangle_count + out.vertex_count + out.triangle_count + count, 0u);
  EXPECT_EQ(after, 0);
  EXPECT_EQ(after_f64, 0);
  return answers;
}

std::vector<Answer> Workings(tpa_context* c) {
  tpa_issue issue;
  auto move = Sized<tpa_move_input>();
  move.position_type = TPA_FLOAT64;
  const double nowhere = 0;
  move.positions = &nowhere;
  auto contacts = Sized<tpa_contacts>();
  auto validation = Sized<tpa_validation>();
  auto report = Sized<tpa_report>();
  auto lengths = Sized<tpa_remesh_options>();
  lengths.iterations = 1, lengths.target_length = 1;
  auto rounds = Sized<tpa_smooth_options>();
  return {
      {"tpa_move", tpa_move(c, &move, &issue)},
      {"tpa_detect", tpa_detect(c, nullptr, &contacts, &issue)},
      {"tpa_validate", tpa_validate(c, nullptr, &validation, &issue)},
      {"tpa_step", tpa_step(c, nullptr, &report, &issue)},
      {"tpa_advance", tpa_advance(c, 1, nullptr, &report, &issue)},
      {"tpa_adapt", tpa_adapt(c, nullptr, &report, &issue)},
      {"tpa_remesh", tpa_remesh(c, &lengths, nullptr, &report, &issue)},
      {"tpa_smooth", tpa_smooth(c, &rounds, nullptr, &report, &issue)},
      {"tpa_reorder", tpa_reorder(c, &issue)},
  };
}

void ExpectAll(const std::vector<Answer>& answers, tpa_status status) {
  for (const Answer& a : answers) EXPECT_EQ(a.status, status) << a.function;
}

// Functions that need no mesh succeed, and find nothing.
void ExpectNothing(tpa_context* c) {
  const tpa_event* events = nullptr;
  const uint32_t* vertices = nullptr;
  uint32_t count = 1;
  EXPECT_EQ(tpa_events(c, &events, &count), TPA_OK);
  EXPECT_EQ(count, 0u);
  count = 1;
  EXPECT_EQ(tpa_rolled_back(c, &vertices, &count), TPA_OK);
  EXPECT_EQ(count, 0u);
  count = 1;
  EXPECT_EQ(tpa_targets(c, nullptr, nullptr, 0, &count), TPA_OK);
  EXPECT_EQ(count, 0u);
  EXPECT_EQ(tpa_drop_targets(c), TPA_OK);
  auto config = Sized<tpa_config>();
  EXPECT_EQ(tpa_config_of(c, &config), TPA_OK);
  EXPECT_EQ(tpa_memory_stats(c, nullptr, 0, &count), TPA_OK);
  EXPECT_GT(count, 0u);
}

std::vector<char> Saved(const tpa_context* c) {
  size_t size = 0;
  tpa_issue issue;
  std::vector<char> data(4096);
  EXPECT_EQ(tpa_save(c, data.data(), data.size(), &size, &issue), TPA_OK);
  data.resize(size);
  return data;
}

uint64_t DigestOf(const tpa_context* c) {
  uint64_t digest = 0;
  EXPECT_EQ(tpa_digest(c, &digest), TPA_OK);
  return digest;
}

tpa_status StatusOfView(const tpa_context* c) {
  auto view = Sized<tpa_mesh_view>();
  return tpa_view(c, &view);
}

// Restored into another context, and carried into a larger block, the state gives the same answers.
void ExpectSameElsewhere(const tpa_context* c) {
  const std::vector<char> saved = Saved(c);
  const Arena other(DefaultConfig(50), Sphere({0, 0, 0}, 1, 1));
  tpa_issue issue;
  ASSERT_EQ(tpa_restore(*other, saved.data(), saved.size(), &issue), TPA_OK) << Text(issue);
  EXPECT_EQ(DigestOf(*other), DigestOf(c));
  EXPECT_EQ(StatusOfView(*other), StatusOfView(c));

  const Arena larger(DefaultConfig(400));
  const tpa_config config = DefaultConfig(400);
  tpa_context* grown = nullptr;
  ASSERT_EQ(tpa_grow(c, larger.block(), larger.size().bytes, &config, &grown, &issue), TPA_OK) << Text(issue);
  EXPECT_EQ(DigestOf(grown), DigestOf(c));
  EXPECT_EQ(StatusOfView(grown), StatusOfView(c));
}

// A single body turned inside out by its targets.
tpa_status Kill(const Arena& arena, const Mesh& body) {
  std::vector<double> targets = body.positions;
  for (double& x : targets) x = -x;
  EXPECT_EQ(MoveAll(*arena, targets), TPA_OK);
  return tpa_step(*arena, nullptr, nullptr, nullptr);
}

TEST(WithoutMesh, WorkAndReadingsAreRefused) {
  const Arena arena(DefaultConfig(100));
  ExpectNothing(*arena);
  ExpectAll(Readings(*arena), TPA_E_STATE);
  ExpectAll(Workings(*arena), TPA_E_STATE);
  ExpectNothing(*arena);
  ExpectSameElsewhere(*arena);
}

TEST(WithoutMesh, ResetLeavesWhatInitMakes) {
  const Arena fresh(DefaultConfig(100));
  const Arena arena(DefaultConfig(100), Sphere({0, 0, 0}, 1, 1));
  EXPECT_EQ(tpa_reset(*arena), TPA_OK);
  ExpectNothing(*arena);
  ExpectAll(Readings(*arena), TPA_E_STATE);
  ExpectAll(Workings(*arena), TPA_E_STATE);
  EXPECT_EQ(Saved(*fresh).size(), Saved(*arena).size());
}

TEST(EmptyMesh, LastDeathIsTold) {
  const Mesh body = Sphere({0, 0, 0}, 1, 1);
  const Arena arena(DefaultConfig(100), body);
  ASSERT_EQ(Kill(arena, body), TPA_OK);
  const std::vector<tpa_event> events = EventsOf(*arena);
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events.back().type, TPA_EVENT_DEATH);
  const std::vector<uint32_t> map = OldToNewOf(*arena);
  EXPECT_EQ(map, std::vector<uint32_t>(body.positions.size() / 3, TPA_NONE));
  ExpectAll(Readings(*arena), TPA_OK);
  ExpectSameElsewhere(*arena);
}

TEST(EmptyMesh, EachCallSucceedsAndDoesNothing) {
  const Mesh body = Sphere({0, 0, 0}, 1, 1);
  const Arena arena(DefaultConfig(100), body);
  ASSERT_EQ(Kill(arena, body), TPA_OK);
  ExpectAll(Workings(*arena), TPA_OK);
  ExpectAll(Readings(*arena), TPA_OK);
  ExpectNothing(*arena);
  ExpectSameElsewhere(*arena);
  const double target[3] = {};
  EXPECT_EQ(MoveSome(*arena, {0}, {target, target + 3}), TPA_E_MESH);  // no vertex has this id
  EXPECT_EQ(Load(*arena, body), TPA_OK);
  EXPECT_EQ(MeshOf(*arena).triangles.size(), body.triangles.size());
}

TEST(EmptyMesh, CannotBeLoaded) {
  const Mesh body = Sphere({0, 0, 0}, 1, 1);
  const Arena arena(DefaultConfig(100), body);
  const uint64_t before = DigestOf(*arena);
  tpa_mesh_input input = InputOf(body);
  tpa_issue issue;
  input.triangle_count = 0;
  EXPECT_EQ(tpa_load(*arena, &input, &issue), TPA_E_ARGUMENT);
  EXPECT_EQ(issue.argument, 2);
  input.vertex_count = 0;
  EXPECT_EQ(tpa_load(*arena, &input, &issue), TPA_E_ARGUMENT);
  EXPECT_EQ(issue.argument, 2);
  EXPECT_EQ(DigestOf(*arena), before);
}

}  // namespace
}  // namespace empty_test
