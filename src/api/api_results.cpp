// SPDX-License-Identifier: MIT
// The results of the last commit, and the components of the mesh.
#include "api/api.h"
#include "results/carry.h"
#include "results/changes.h"
#include "results/component_list.h"

namespace tpa {

namespace {

static_assert(sizeof(VertexOrigin) == sizeof(tpa_vertex_origin));

// Nothing is written where there is no room for a range.
void list_changes(const Context& c, const BitSet& set, u32 count, u32 gap, Stack<tpa_range> room, u32& ranges,
                  u32& changed) {
  ranges = 0;
  changed = c.all_changed ? count : count_members(set);
  if (room.capacity == 0 || changed == 0) return;
  if (c.all_changed)
    room.data[ranges++] = {0, count};
  else
    ranges = list_ranges(set, gap, room.data, room.capacity);
}

template <class Number>
tpa_status check_carry(const IssueSlot& slot, const Context* c, const AttributeRows<Number>& rows) {
  if (c == nullptr) return slot.issue.status;
  if (rows.before == nullptr || rows.after == nullptr || rows.width == 0) return TPA_E_ARGUMENT;
  return c->loaded ? TPA_OK : TPA_E_STATE;
}

template <class Number>
tpa_status carry_checked(const tpa_context* context, const AttributeRows<Number>& rows) {
  IssueSlot slot(nullptr);
  const Context* c = slot.context(context);
  const tpa_status status = check_carry(slot, c, rows);
  if (status == TPA_OK) carry_vertices(*c, rows);
  return status;
}

}  // namespace

}  // namespace tpa

using namespace tpa;

extern "C" {

tpa_status tpa_events(const tpa_context* context, const tpa_event** events, uint32_t* count) {
  const Context* c = context_of(context);
  if (c == nullptr) return TPA_E_CONTEXT;
  if (events == nullptr || count == nullptr) return TPA_E_ARGUMENT;
  *events = table_data<tpa_event>(*c, table_events);
  *count = c->event_count;
  return TPA_OK;
}

tpa_status tpa_rolled_back(const tpa_context* context, const uint32_t** vertices, uint32_t* count) {
  const Context* c = context_of(context);
  if (c == nullptr) return TPA_E_CONTEXT;
  if (vertices == nullptr || count == nullptr) return TPA_E_ARGUMENT;
  *vertices = rolled_back_list(*c);
  *count = c->rolled_back_count;
  return TPA_OK;
}

tpa_status tpa_vertex_map(const tpa_context* context, tpa_vertex_map_view* map) {
  const Context* c = context_of(context);
  if (c == nullptr) return TPA_E_CONTEXT;
  if (check_struct(map)) return TPA_E_ARGUMENT;
  if (!c->loaded) return TPA_E_STATE;
  write_struct({0, c->old_vertex_count, c->vertex_count, 0, table_data<u32>(*c, table_old_to_new),
                table_data<tpa_vertex_origin>(*c, table_vertex_origin)},
               map);
  return TPA_OK;
}

tpa_status tpa_triangle_map(const tpa_context* context, tpa_triangle_map_view* map) {
  const Context* c = context_of(context);
  if (c == nullptr) return TPA_E_CONTEXT;
  if (check_struct(map)) return TPA_E_ARGUMENT;
  if (!c->loaded) return TPA_E_STATE;
  write_struct({0, c->old_face_count, c->face_count, 0, table_data<u32>(*c, table_face_origin)}, map);
  return TPA_OK;
}

tpa_status tpa_components(const tpa_context* context, tpa_component* components, uint32_t capacity, uint32_t* labels,
                          uint32_t* count, tpa_issue* issue) {
  IssueSlot slot(issue);
  const Context* c = slot.context(context);
  if (c == nullptr) return slot.issue.status;
  if (components == nullptr && capacity > 0) return slot.argument(2, Subject::components, Rule::not_null);
  if (count == nullptr) return slot.argument(5, Subject::count, Rule::not_null);
  if (!c->loaded) return slot.fail(TPA_E_STATE);
  *count = c->component_count;
  if (components != nullptr && capacity < c->component_count)
    return slot.capacity(3, Subject::components_capacity, Rule::capacity, TPA_LIMIT_COMPONENTS, c->component_count,
                         capacity);
  const Components known = open_components(*c);
  if (components != nullptr) list_components(*c, known, components);
  for (u32 v = 0; labels != nullptr && v < c->vertex_count; ++v) labels[v] = place_of(known, v);
  return TPA_OK;
}

tpa_status tpa_changes(const tpa_context* context, tpa_change_list* changes, tpa_issue* issue) {
  IssueSlot slot(issue);
  const Context* c = slot.context(context);
  if (c == nullptr) return slot.issue.status;
  tpa_change_list list;
  if (!slot.read(2, changes, list)) return slot.issue.status;
  if (list.vertices == nullptr && list.vertex_capacity > 0)
    return slot.argument(2, Subject::changes_vertices, Rule::not_null);
  if (list.triangles == nullptr && list.triangle_capacity > 0)
    return slot.argument(2, Subject::changes_triangles, Rule::not_null);
  if (!c->loaded) return slot.fail(TPA_E_STATE);
  list.old_vertex_count = c->old_vertex_count;
  list.old_triangle_count = c->old_face_count;
  list.vertex_count = c->vertex_count;
  list.triangle_count = c->face_count;
  list_changes(*c, open_changed_vertices(*c), c->vertex_count, list.gap, {list.vertices, list.vertex_capacity, 0},
               list.vertex_ranges, list.changed_vertices);
  list_changes(*c, open_changed_faces(*c), c->face_count, list.gap, {list.triangles, list.triangle_capacity, 0},
               list.triangle_ranges, list.changed_triangles);
  write_struct(list, changes);
  return TPA_OK;
}

tpa_status tpa_carry_vertices(const tpa_context* context, const float* before, uint32_t width, float* after) {
  return carry_checked(context, Attributes{before, after, width});
}

tpa_status tpa_carry_vertices_f64(const tpa_context* context, const double* before, uint32_t width, double* after) {
  return carry_checked(context, AttributeRows<f64>{before, after, width});
}

tpa_status tpa_carry_triangles(const tpa_context* context, const float* before, uint32_t width, float* after) {
  IssueSlot slot(nullptr);
  const Context* c = slot.context(context);
  const Attributes rows{before, after, width};
  const tpa_status status = check_carry(slot, c, rows);
  if (status == TPA_OK) carry_triangles(*c, rows);
  return status;
}

}  // extern "C"
