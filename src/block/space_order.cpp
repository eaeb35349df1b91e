// SPDX-License-Identifier: MIT
#include "block/space_order.h"

#include <string.h>

#include "block/shadow_mesh.h"
#include "geometry/box.h"
#include "geometry/morton.h"
#include "mesh/journal.h"

namespace tpa {

namespace {

constexpr u32 axis_bits = 21;  // along each axis, as many as a word holds
constexpr u32 digit_bits = 9, digits = 3 * axis_bits / digit_bits;
static_assert(digits * digit_bits == 3 * axis_bits);

struct Item {
  u64 place;
  u32 vertex;
};
static_assert(sizeof(Item) <= sizeof(Vec3));

u64 cell_along(f64 x, f64 low, f64 cells_in_unit) {
  constexpr u64 last = (u64{1} << axis_bits) - 1;
  return min_of(last, static_cast<u64>((x - low) * cells_in_unit));
}

// The vertices with their cells in a cube round the mesh.
void note_places(const Mesh& m, Item* items) {
  Vec3 low = m.position[0], high = low;
  for (u32 v = 1; v < m.vertex_count; ++v)
    for (int k = 0; k < 3; ++k) {
      low[k] = min_of(low[k], m.position[v][k]);
      high[k] = max_of(high[k], m.position[v][k]);
    }
  const f64 side = max_of(high.x - low.x, max_of(high.y - low.y, high.z - low.z));
  const f64 cells_in_unit = side > 0 ? static_cast<f64>(u64{1} << axis_bits) / side : 0;
  for (u32 v = 0; v < m.vertex_count; ++v) {
    const Vec3& p = m.position[v];
    u64 place = 0;
    for (int k = 0; k < 3; ++k) place |= spread_bits(cell_along(p[k], low[k], cells_in_unit)) << k;
    items[v] = {place, v};
  }
}

// A counting sort by one digit of the places, equal digits in the old order.
void sort_by_digit(const Item* from, Item* to, u32 n, u32 digit) {
  u32 first[1u << digit_bits] = {};
  const auto digit_of = [&](const Item& item) {
    return static_cast<u32>(item.place >> digit_bits * digit) & ((1u << digit_bits) - 1);
  };
  for (u32 i = 0; i < n; ++i) ++first[digit_of(from[i])];
  u32 before = 0;
  for (u32& count : first) {
    const u32 here = count;
    count = before;
    before += here;
  }
  for (u32 i = 0; i < n; ++i) to[first[digit_of(from[i])]++] = from[i];
}

// The old numbers in the new order, and the new number of each old vertex; room to sort the faces. In the memory of
// targets.
struct Order {
  u32 *vertex, *new_vertex, *end;
  u32* face;  // behind the corners of the shadow mesh
};
static_assert(sizeof(Vec3) >= 3 * sizeof(u32) && sizeof(OldFace) >= 4 * sizeof(u32));

Order open_order(const Context& c) {
  u32* const words = table_data<u32>(c, table_target);
  const size_t vertices = c.limits.vertices;
  return {words, words + vertices, words + 2 * vertices,
          table_data<u32>(c, table_journal_face) + 3 * size_t{c.limits.triangles}};
}

// An odd number of passes: the last one leaves the items beside the memory of the order.
void order_vertices(const Context& c, const Mesh& m, const Order& order) {
  Item* from = table_data<Item>(c, table_target);
  Item* to = table_data<Item>(c, table_journal_position);
  static_assert(digits % 2 == 1);
  note_places(m, from);
  for (u32 digit = 0; digit < digits; ++digit) {
    sort_by_digit(from, to, m.vertex_count, digit);
    swap_values(from, to);
  }
  for (u32 i = 0; i < m.vertex_count; ++i) order.vertex[i] = from[i].vertex;
  for (u32 i = 0; i < m.vertex_count; ++i) order.new_vertex[order.vertex[i]] = i;
}

u32 first_corner(const Order& order, const u32* v) {
  return min_of(order.new_vertex[v[0]], min_of(order.new_vertex[v[1]], order.new_vertex[v[2]]));
}

// By the least corner, equal ones in the old order.
void order_faces(const Mesh& m, const Order& order) {
  for (u32 v = 0; v < m.vertex_count; ++v) order.end[v] = 0;
  for (u32 f = 0; f < m.face_count; ++f) ++order.end[first_corner(order, m.corner + 3 * size_t{f})];
  u32 before = 0;
  for (u32 v = 0; v < m.vertex_count; ++v) {
    const u32 here = order.end[v];
    order.end[v] = before;
    before += here;
  }
  for (u32 f = 0; f < m.face_count; ++f) order.face[order.end[first_corner(order, m.corner + 3 * size_t{f})]++] = f;
}

void fill_shadow_mesh(const Mesh& m, const Order& order, const Mesh& shadow) {
  for (u32 v = 0; v < m.vertex_count; ++v) shadow.position[v] = m.position[order.vertex[v]];
  for (u32 f = 0; f < m.face_count; ++f)
    for (u32 i = 0; i < 3; ++i)
      shadow.corner[3 * size_t{f} + i] = order.new_vertex[m.corner[3 * size_t{order.face[f]} + i]];
}

// Places in the arrays that hold something else now.
void note_moved_slots(const Context& c, const Mesh& before, const Mesh& after) {
  BitSet vertices = open_changed_vertices(c), faces = open_changed_faces(c);
  vertices.clear();
  faces.clear();
  for (u32 v = 0; v < after.vertex_count; ++v)
    if (!have_same_bits(before.position[v], after.position[v])) vertices.add(v);
  for (u32 f = 0; f < after.face_count; ++f)
    if (memcmp(before.corner + 3 * size_t{f}, after.corner + 3 * size_t{f}, 3 * sizeof(u32)) != 0) faces.add(f);
}

// After the mesh is adopted with maps that are the identity.
void publish_order(Workspace& w, const Order& order) {
  const Mesh& m = w.edit.mesh;
  for (u32 v = 0; v < m.vertex_count; ++v) {
    m.vertex_origin[v].parents[0] = order.vertex[v];
    w.old_to_new[v] = order.new_vertex[v];
  }
  for (u32 f = 0; f < m.face_count; ++f) m.face_origin[f] = order.face[f];
  note_mapped(w.edit, w.old_to_new);
  for (u32 v = 0; v < m.vertex_count; ++v) {
    Component& part = w.before.list[component_of(w.before, v)];
    part.before = min_of(part.before, order.vertex[v]);
  }
  note_ancestors(w);
}

}  // namespace

void order_by_space(Context& c) {
  forget_targets(c);
  const Mesh m = open(c).edit.mesh;
  if (m.vertex_count == 0) return adopt_shadow_mesh(c, m, 0);
  const bool known_clean = c.known_clean;
  const Order order = open_order(c);
  order_vertices(c, m, order);
  order_faces(m, order);
  Mesh shadow = open_shadow_mesh(c, m.vertex_count, m.face_count);
  fill_shadow_mesh(m, order, shadow);
  check_shadow_mesh(c, shadow);  // without defects, as the mesh is
  note_moved_slots(c, m, shadow);
  adopt_shadow_mesh(c, shadow, label_shadow_mesh(c, shadow));
  c.all_changed = false;
  c.known_clean = known_clean;
  Workspace w = open(c);
  publish_order(w, order);
}

}  // namespace tpa
