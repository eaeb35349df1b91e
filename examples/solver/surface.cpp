// SPDX-License-Identifier: MIT
#include "surface.h"

#include <stdexcept>

namespace solver {

namespace {

void check(tpa_status status, const tpa_issue& issue) {
  if (status == TPA_OK) return;
  char line[200];
  tpa_issue_text(&issue, line, sizeof line);
  throw std::runtime_error(line);
}

template <class Struct>
Struct make() {
  Struct s{};
  s.struct_size = sizeof s;
  return s;
}

tpa_mesh_view view_of(const tpa_context* context) {
  tpa_mesh_view view = make<tpa_mesh_view>();
  tpa_view(context, &view);
  return view;
}

}  // namespace

Surface::Surface(const Points& points, const Triangles& triangles, uint32_t most_vertices) {
  tpa_issue issue{};
  tpa_config config;
  tpa_arena_size size;
  tpa_config_init(&config, sizeof config);
  config.max_vertices = most_vertices;
  check(tpa_arena_query(&config, &size, &issue), issue);
  block_.reset(new unsigned char[size.bytes + size.alignment]);
  void* start = block_.get();
  size_t room = size.bytes + size.alignment;
  std::align(size.alignment, size.bytes, start, room);
  check(tpa_init(start, size.bytes, &config, &context_, &issue), issue);
  tpa_mesh_input mesh = make<tpa_mesh_input>();
  mesh.vertex_count = static_cast<uint32_t>(points.rows());
  mesh.triangle_count = static_cast<uint32_t>(triangles.rows());
  mesh.position_type = TPA_FLOAT64;
  mesh.index_type = TPA_UINT32;
  mesh.positions = points.data();
  mesh.triangles = triangles.data();
  check(tpa_load(context_, &mesh, &issue), issue);
}

Eigen::Map<const Points> Surface::points() const {
  const tpa_mesh_view view = view_of(context_);
  return {view.positions, static_cast<Eigen::Index>(view.vertex_count), 3};
}

Eigen::Map<const Triangles> Surface::triangles() const {
  const tpa_mesh_view view = view_of(context_);
  return {view.triangles, static_cast<Eigen::Index>(view.triangle_count), 3};
}

tpa_report Surface::step(const Points& targets) {
  tpa_issue issue{};
  tpa_move_input move = make<tpa_move_input>();
  tpa_report report = make<tpa_report>();
  move.count = static_cast<uint32_t>(targets.rows());
  move.position_type = TPA_FLOAT64;
  move.positions = targets.data();
  check(tpa_move(context_, &move, &issue), issue);
  check(tpa_step(context_, nullptr, &report, &issue), issue);
  return report;
}

void Surface::remesh(double edge_length) {
  tpa_issue issue{};
  tpa_remesh_options options = make<tpa_remesh_options>();
  options.iterations = 1;
  options.target_length = edge_length;
  options.relaxation = 0.5;
  check(tpa_remesh(context_, &options, nullptr, nullptr, &issue), issue);
}

tpa_vertex_map_view Surface::map() const {
  tpa_vertex_map_view map = make<tpa_vertex_map_view>();
  tpa_vertex_map(context_, &map);
  return map;
}

std::vector<tpa_component> Surface::components(std::vector<uint32_t>& labels) const {
  tpa_issue issue{};
  uint32_t count = 0;
  tpa_components(context_, nullptr, 0, nullptr, &count, nullptr);
  std::vector<tpa_component> components(count);
  labels.resize(view_of(context_).vertex_count);
  check(tpa_components(context_, components.data(), count, labels.data(), &count, &issue), issue);
  return components;
}

tpa_validation Surface::validate() {
  tpa_issue issue{};
  tpa_validation validation = make<tpa_validation>();
  check(tpa_validate(context_, nullptr, &validation, &issue), issue);
  return validation;
}

}  // namespace solver
