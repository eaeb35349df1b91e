// SPDX-License-Identifier: MIT
#include "support/support.h"

#include <cstdlib>

namespace support {

tpa_config DefaultConfig(uint32_t max_vertices) {
  tpa_config config;
  EXPECT_EQ(tpa_config_init(&config, sizeof config), TPA_OK);
  config.max_vertices = max_vertices;
  return config;
}

tpa_config ConfigFor(const Mesh& m) { return DefaultConfig(3 * VertexCount(m) + 64); }

void Arena::Free::operator()(char* p) const { std::free(p); }

namespace {

Mesh CopyOf(const tpa_mesh_view& view) {
  return {{view.positions, view.positions + 3 * size_t{view.vertex_count}},
          {view.triangles, view.triangles + 3 * size_t{view.triangle_count}}};
}

// The mesh of a context; empty without a loaded mesh.
Mesh PresentMesh(const tpa_context* context) {
  auto view = Sized<tpa_mesh_view>();
  return tpa_view(context, &view) == TPA_OK ? CopyOf(view) : Mesh{};
}

}  // namespace

Arena::Arena(const tpa_config& config) : now_("now", [this] { return PresentMesh(context_); }) {
  tpa_issue issue;
  EXPECT_EQ(tpa_arena_query(&config, &size_, &issue), TPA_OK) << Text(issue);
  block_.reset(static_cast<char*>(std::aligned_alloc(size_.alignment, size_.bytes)));
  EXPECT_EQ(tpa_init(block_.get(), size_.bytes, &config, &context_, &issue), TPA_OK) << Text(issue);
}

Arena::Arena(const tpa_config& config, const Mesh& mesh) : Arena(config) {
  loaded_.emplace("loaded", mesh);
  tpa_issue issue;
  EXPECT_EQ(Load(context_, mesh, &issue), TPA_OK) << Text(issue);
}

tpa_mesh_input InputOf(const Mesh& mesh) {
  auto input = Sized<tpa_mesh_input>();
  input.vertex_count = VertexCount(mesh);
  input.triangle_count = TriangleCount(mesh);
  input.position_type = TPA_FLOAT64;
  input.index_type = TPA_UINT32;
  input.positions = mesh.positions.data();
  input.triangles = mesh.triangles.data();
  return input;
}

tpa_status Load(tpa_context* context, const Mesh& mesh, tpa_issue* issue) {
  const tpa_mesh_input input = InputOf(mesh);
  return tpa_load(context, &input, issue);
}

tpa_status MoveAll(tpa_context* context, const std::vector<double>& targets, tpa_issue* issue) {
  auto move = Sized<tpa_move_input>();
  move.count = static_cast<uint32_t>(targets.size() / 3);
  move.position_type = TPA_FLOAT64;
  move.positions = targets.data();
  return tpa_move(context, &move, issue);
}

tpa_status MoveSome(tpa_context* context, const std::vector<uint32_t>& vertices, const std::vector<double>& targets) {
  auto move = Sized<tpa_move_input>();
  move.count = static_cast<uint32_t>(vertices.size());
  move.position_type = TPA_FLOAT64;
  move.positions = targets.data();
  move.vertices = vertices.data();
  return tpa_move(context, &move, nullptr);
}

Mesh MeshOf(const tpa_context* context) {
  auto view = Sized<tpa_mesh_view>();
  EXPECT_EQ(tpa_view(context, &view), TPA_OK);
  return CopyOf(view);
}

std::vector<tpa_event> EventsOf(const tpa_context* context) {
  const tpa_event* events = nullptr;
  uint32_t count = 0;
  EXPECT_EQ(tpa_events(context, &events, &count), TPA_OK);
  return {events, events + count};
}

namespace {

tpa_vertex_map_view VertexMap(const tpa_context* context) {
  auto map = Sized<tpa_vertex_map_view>();
  EXPECT_EQ(tpa_vertex_map(context, &map), TPA_OK);
  return map;
}

}  // namespace

std::vector<tpa_vertex_origin> VertexOriginsOf(const tpa_context* context) {
  const tpa_vertex_map_view map = VertexMap(context);
  return {map.origins, map.origins + map.new_count};
}

std::vector<uint32_t> OldToNewOf(const tpa_context* context) {
  const tpa_vertex_map_view map = VertexMap(context);
  return {map.old_to_new, map.old_to_new + map.old_count};
}

std::vector<uint32_t> TriangleOriginsOf(const tpa_context* context) {
  auto map = Sized<tpa_triangle_map_view>();
  EXPECT_EQ(tpa_triangle_map(context, &map), TPA_OK);
  return {map.origins, map.origins + map.new_count};
}

Pairs PairsOf(const tpa_contacts& contacts) {
  Pairs pairs;
  for (uint32_t i = 0; i < contacts.count; ++i) pairs.emplace_back(contacts.pairs[i].a, contacts.pairs[i].b);
  return pairs;
}

std::string Text(const tpa_issue& issue) {
  char text[256];
  tpa_issue_text(&issue, text, sizeof text);
  return text;
}

Observed Observe(const tpa_context* context) {
  Observed out;
  const auto add = [&](const void* data, size_t bytes) { out.bytes.append(static_cast<const char*>(data), bytes); };
  auto view = Sized<tpa_mesh_view>();
  if (tpa_view(context, &view) == TPA_OK) {
    add(&view.vertex_count, sizeof view.vertex_count);
    add(&view.triangle_count, sizeof view.triangle_count);
    add(&view.epoch, sizeof view.epoch);
    add(view.positions, 3 * sizeof(double) * view.vertex_count);
    add(view.triangles, 3 * sizeof(uint32_t) * view.triangle_count);
    add(view.opposites, 3 * sizeof(uint32_t) * view.triangle_count);
    const tpa_vertex_map_view vertices = VertexMap(context);
    add(&vertices.old_count, sizeof vertices.old_count);
    add(vertices.old_to_new, sizeof(uint32_t) * vertices.old_count);
    add(vertices.origins, sizeof(tpa_vertex_origin) * vertices.new_count);
    auto triangles = Sized<tpa_triangle_map_view>();
    EXPECT_EQ(tpa_triangle_map(context, &triangles), TPA_OK);
    add(&triangles.old_count, sizeof triangles.old_count);
    add(triangles.origins, sizeof(uint32_t) * triangles.new_count);
    uint32_t components = 0;
    EXPECT_EQ(tpa_components(context, nullptr, 0, nullptr, &components, nullptr), TPA_OK);
    std::vector<tpa_component> list(components);
    std::vector<uint32_t> labels(view.vertex_count);
    EXPECT_EQ(tpa_components(context, list.data(), components, labels.data(), &components, nullptr), TPA_OK);
    add(list.data(), sizeof(tpa_component) * list.size());
    add(labels.data(), sizeof(uint32_t) * labels.size());
  }
  const tpa_event* events = nullptr;
  const uint32_t* rolled_back = nullptr;
  uint32_t count = 0;
  EXPECT_EQ(tpa_events(context, &events, &count), TPA_OK);
  add(&count, sizeof count);
  add(events, sizeof(tpa_event) * count);
  EXPECT_EQ(tpa_rolled_back(context, &rolled_back, &count), TPA_OK);
  add(&count, sizeof count);
  add(rolled_back, sizeof(uint32_t) * count);
  return out;
}

}  // namespace support
