// SPDX-License-Identifier: MIT
// The mesh in and out.
#include <string.h>

#include "api/api.h"
#include "block/shadow_mesh.h"
#include "block/space_order.h"
#include "mesh/validate.h"

namespace tpa {

namespace {

u32 scalar_bytes(u32 type) {
  return type == TPA_FLOAT64 ? 8 : type == TPA_FLOAT32 || type == TPA_UINT32 ? 4 : type == TPA_UINT16 ? 2 : 0;
}
bool is_float(u32 type) { return type == TPA_FLOAT32 || type == TPA_FLOAT64; }
bool is_index(u32 type) { return type == TPA_UINT16 || type == TPA_UINT32; }

// A caller's array of triples. Stride 0 means tight.
struct Triples {
  u32 type, stride;
  u64 step() const { return stride != 0 ? stride : 3 * u64{scalar_bytes(type)}; }
  bool sound() const { return stride == 0 || stride >= 3 * scalar_bytes(type); }
};

Vec3 read_position(const void* data, Triples t, u64 i) {
  const char* from = static_cast<const char*>(data) + i * t.step();
  f64 out[3];
  if (t.type == TPA_FLOAT64) {
    memcpy(out, from, sizeof out);
  } else {
    f32 in[3];
    memcpy(in, from, sizeof in);
    for (int k = 0; k < 3; ++k) out[k] = static_cast<f64>(in[k]);
  }
  return {out[0], out[1], out[2]};
}

void read_triangle(const void* data, Triples t, u64 i, u32* out) {
  const char* from = static_cast<const char*>(data) + i * t.step();
  if (t.type == TPA_UINT32) {
    memcpy(out, from, 3 * sizeof(u32));
    return;
  }
  u16 in[3];
  memcpy(in, from, sizeof in);
  for (int k = 0; k < 3; ++k) out[k] = in[k];
}

void write_position(void* data, Triples t, u64 i, const Vec3& p) {
  char* to = static_cast<char*>(data) + i * t.step();
  const f64 in[3] = {p.x, p.y, p.z};
  if (t.type == TPA_FLOAT64) {
    memcpy(to, in, sizeof in);
    return;
  }
  const f32 out[3] = {static_cast<f32>(p.x), static_cast<f32>(p.y), static_cast<f32>(p.z)};
  memcpy(to, out, sizeof out);
}

void write_triangle(void* data, Triples t, u64 i, const u32* corners) {
  char* to = static_cast<char*>(data) + i * t.step();
  if (t.type == TPA_UINT32) {
    memcpy(to, corners, 3 * sizeof(u32));
    return;
  }
  const u16 out[3] = {static_cast<u16>(corners[0]), static_cast<u16>(corners[1]), static_cast<u16>(corners[2])};
  memcpy(to, out, sizeof out);
}

tpa_status check_positions_of_mesh(Triples positions, IssueSlot& slot) {
  if (!is_float(positions.type)) return slot.argument(2, Subject::mesh_position_type, Rule::float_type);
  return positions.sound() ? tpa_status{TPA_OK} : slot.argument(2, Subject::mesh_position_stride, Rule::stride);
}
tpa_status check_triangles_of_mesh(Triples triangles, IssueSlot& slot) {
  if (!is_index(triangles.type)) return slot.argument(2, Subject::mesh_index_type, Rule::index_type);
  return triangles.sound() ? tpa_status{TPA_OK} : slot.argument(2, Subject::mesh_triangle_stride, Rule::stride);
}

tpa_status check_counts(const Context& c, const tpa_mesh_input& in, IssueSlot& slot) {
  if (in.vertex_count > c.limits.vertices)
    return fail_limit(slot.issue, TPA_LIMIT_VERTICES, in.vertex_count, c.limits.vertices);
  if (in.triangle_count > c.limits.triangles)
    return fail_limit(slot.issue, TPA_LIMIT_TRIANGLES, in.triangle_count, c.limits.triangles);
  return TPA_OK;
}

}  // namespace

}  // namespace tpa

using namespace tpa;

extern "C" {

tpa_status tpa_load(tpa_context* context, const tpa_mesh_input* mesh, tpa_issue* issue) {
  IssueSlot slot(issue);
  Context* c = slot.context(context);
  if (c == nullptr) return slot.issue.status;
  tpa_mesh_input in;
  if (!slot.read(2, mesh, in)) return slot.issue.status;
  if (in.positions == nullptr) return slot.argument(2, Subject::mesh_positions, Rule::not_null);
  if (in.triangles == nullptr) return slot.argument(2, Subject::mesh_triangles, Rule::not_null);
  if (in.vertex_count < 4) return slot.argument(2, Subject::mesh_vertex_count, Rule::four_or_more);
  if (in.triangle_count < 4) return slot.argument(2, Subject::mesh_triangle_count, Rule::four_or_more);
  const Triples positions{in.position_type, in.position_stride};
  const Triples triangles{in.index_type, in.triangle_stride};
  if (check_positions_of_mesh(positions, slot) != TPA_OK || check_triangles_of_mesh(triangles, slot) != TPA_OK)
    return slot.issue.status;
  if (const tpa_status s = check_counts(*c, in, slot); s != TPA_OK) return s;

  Mesh m = open_shadow_mesh(*c, in.vertex_count, in.triangle_count);
  for (u32 v = 0; v < m.vertex_count; ++v) m.position[v] = read_position(in.positions, positions, v);
  for (u32 f = 0; f < m.face_count; ++f) read_triangle(in.triangles, triangles, f, m.corner + 3 * f);
  if (const Defect d = check_shadow_mesh(*c, m); d.kind != 0) {
    drop_shadow_mesh(*c);
    return slot.mesh(d, m.vertex_count);
  }
  const u32 components = label_shadow_mesh(*c, m);
  if (components > c->limits.components) {
    drop_shadow_mesh(*c);
    return fail_limit(slot.issue, TPA_LIMIT_COMPONENTS, components, c->limits.components);
  }
  adopt_shadow_mesh(*c, m, components);
  return TPA_OK;
}

tpa_status tpa_reorder(tpa_context* context, tpa_issue* issue) {
  IssueSlot slot(issue);
  Context* c = slot.context(context);
  if (c == nullptr) return slot.issue.status;
  if (!c->loaded) return slot.fail(TPA_E_STATE);
  order_by_space(*c);
  return TPA_OK;
}

tpa_status tpa_view(const tpa_context* context, tpa_mesh_view* view) {
  const Context* c = context_of(context);
  if (c == nullptr) return TPA_E_CONTEXT;
  if (check_struct(view)) return TPA_E_ARGUMENT;
  if (!c->loaded) return TPA_E_STATE;
  write_struct({0, c->vertex_count, c->face_count, 0, c->epoch, table_data<double>(*c, table_position),
                table_data<u32>(*c, table_corner), table_data<u32>(*c, table_opposite)},
               view);
  return TPA_OK;
}

tpa_status tpa_export(const tpa_context* context, tpa_mesh_output* mesh, tpa_issue* issue) {
  IssueSlot slot(issue);
  const Context* c = slot.context(context);
  if (c == nullptr) return slot.issue.status;
  tpa_mesh_output out;
  if (!slot.read(2, mesh, out)) return slot.issue.status;
  if (!c->loaded) return slot.fail(TPA_E_STATE);
  mesh->vertex_count = c->vertex_count;
  mesh->triangle_count = c->face_count;
  const Triples positions{out.position_type, out.position_stride};
  const Triples triangles{out.index_type, out.triangle_stride};
  if (out.positions != nullptr) {
    if (const tpa_status s = check_positions_of_mesh(positions, slot); s != TPA_OK) return s;
    if (out.vertex_capacity < c->vertex_count)
      return slot.capacity(2, Subject::mesh_vertex_capacity, Rule::capacity, TPA_LIMIT_VERTICES, c->vertex_count,
                           out.vertex_capacity);
  }
  if (out.triangles != nullptr) {
    if (const tpa_status s = check_triangles_of_mesh(triangles, slot); s != TPA_OK) return s;
    if (out.triangle_capacity < c->face_count)
      return slot.capacity(2, Subject::mesh_triangle_capacity, Rule::capacity, TPA_LIMIT_TRIANGLES, c->face_count,
                           out.triangle_capacity);
    if (triangles.type == TPA_UINT16 && c->vertex_count > 65536)
      return slot.capacity(2, Subject::mesh_index_type, Rule::short_index, TPA_LIMIT_VERTICES, c->vertex_count, 65536);
  }
  const Vec3* p = table_data<Vec3>(*c, table_position);
  const u32* corner = table_data<u32>(*c, table_corner);
  if (out.positions != nullptr)
    for (u32 v = 0; v < c->vertex_count; ++v) write_position(out.positions, positions, v, p[v]);
  if (out.triangles != nullptr)
    for (u32 f = 0; f < c->face_count; ++f) write_triangle(out.triangles, triangles, f, corner + 3 * f);
  return TPA_OK;
}

tpa_status tpa_validate(tpa_context* context, const tpa_exec* exec, tpa_validation* validation, tpa_issue* issue) {
  IssueSlot slot(issue);
  Context* c = slot.context(context);
  if (c == nullptr) return slot.issue.status;
  Exec threads;
  if (!read_exec(exec, 2, slot, threads) || !slot.writable(3, validation)) return slot.issue.status;
  if (!c->loaded) return slot.fail(TPA_E_STATE);
  Workspace w = open(*c);
  Mesh m = open_shadow_mesh(*c, c->vertex_count, c->face_count);
  m.position = w.edit.mesh.position;
  m.corner = w.edit.mesh.corner;
  if (const Defect d = check_shadow_mesh(*c, m); d.kind != 0) {
    drop_shadow_mesh(*c);
    return slot.mesh(d, m.vertex_count);
  }
  const Measures all = measure(m, w.before, w.work_vertices.data);
  c->components_known = true;
  close(w);
  detect_all(w, threads);
  if (!end_within_budget(threads.meter)) return fail_stopped(slot.issue, slot.meter);
  note_peak(*c, Measure::contacts, w.detection.found);
  c->known_clean = w.detection.found == 0;
  write_struct({0, all.components, w.detection.found, all.euler, all.genus, all.volume, all.area}, validation);
  if (w.detection.found > w.detection.pairs.capacity)
    return fail_limit(slot.issue, TPA_LIMIT_CONTACTS, w.detection.found, w.detection.pairs.capacity);
  return TPA_OK;
}

tpa_status tpa_move(tpa_context* context, const tpa_move_input* move, tpa_issue* issue) {
  IssueSlot slot(issue);
  Context* c = slot.context(context);
  if (c == nullptr) return slot.issue.status;
  tpa_move_input in;
  if (!slot.read(2, move, in)) return slot.issue.status;
  if (in.positions == nullptr && in.count > 0) return slot.argument(2, Subject::move_positions, Rule::not_null);
  const Triples positions{in.position_type, in.position_stride};
  if (!is_float(positions.type)) return slot.argument(2, Subject::move_position_type, Rule::float_type);
  if (!positions.sound()) return slot.argument(2, Subject::move_position_stride, Rule::stride);
  if (!c->loaded) return slot.fail(TPA_E_STATE);
  const auto id = [&](u32 i) { return in.vertices != nullptr ? in.vertices[i] : i; };
  for (u32 i = 0; i < in.count; ++i) {
    if (id(i) >= c->vertex_count) return slot.listed({defect_index_range, i, id(i)}, c->vertex_count);
    const Vec3 p = read_position(in.positions, positions, i);
    if (in_exact_range(p.x) && in_exact_range(p.y) && in_exact_range(p.z)) continue;
    return slot.listed({check_positions(&p, 1).kind, id(i), i}, c->vertex_count);
  }
  Workspace w = open(*c);
  for (u32 i = 0; i < in.count; ++i) set_target(w, id(i), read_position(in.positions, positions, i));
  return TPA_OK;
}

}  // extern "C"
