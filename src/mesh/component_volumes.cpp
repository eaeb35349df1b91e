// SPDX-License-Identifier: MIT
#include "mesh/component_volumes.h"

#include "geometry/expansion.h"

namespace tpa {

namespace {

Component& component_at(const Components& c, u32 v) { return c.list.data[component_of(c, v)]; }

// The component of one vertex after another: consecutive vertices and faces mostly have the same one.
struct LastComponent {
  Components& components;
  u32 label = none;
  Component* component = nullptr;
  Component& at(u32 v) {
    if (components.label[v] != label) {
      label = components.label[v];
      component = &component_at(components, v);
    }
    return *component;
  }
};

// Sums volume_of_face(from, a, b, c) over the faces of each component, in their order. Additions are compensated
// (Neumaier 1974), so their errors do not add up. Sizes are lost. The point of view is a vertex of the component: far
// from the origin few digits would be left.
template <class PositionOf, class VolumeOfFace>
void sum_faces(const Mesh& m, Components& c, PositionOf at, VolumeOfFace volume_of_face) {
  for (Component& component : c.list) {
    component.volume = {};
    component.lost_in_sum = 0;
  }
  LastComponent last{c};
  for (u32 f = 0; f < m.face_count; ++f) {
    if (!face_lives(m, f)) continue;
    const u32* v = m.corner + 3 * f;
    Component& component = last.at(v[0]);
    const SignedVolume face = volume_of_face(at(component.id), at(v[0]), at(v[1]), at(v[2]));
    const ExactPair sum = two_sum(component.volume.sum, face.sum);
    component.volume.sum = sum.high;
    component.lost_in_sum += sum.low;
    component.volume.doubt += face.doubt;
  }
  for (Component& component : c.list) component.volume.sum += component.lost_in_sum;
}

// The doubt of each component becomes the number of its faces.
template <class PositionOf>
void sum_and_count(const Mesh& m, Components& c, PositionOf at) {
  sum_faces(m, c, at, [](const Vec3& from, const Vec3& p, const Vec3& q, const Vec3& r) {
    return SignedVolume{six_volumes_of(from, p, q, r), 1};
  });
}

template <class PositionOf>
void measure_sizes(const Mesh& m, Components& c, PositionOf at) {
  for (Component& component : c.list) component.size = 0;
  LastComponent last{c};
  for (u32 v = 0; v < m.vertex_count; ++v) {
    if (!vertex_lives(m, v)) continue;
    Component& component = last.at(v);
    component.size = max_of(component.size, 2 * size_of(at(v) - at(component.id)));
  }
}

// The doubt of a sum by measure_volumes(). With u half an ulp of 1, and n faces, each term is off by less than 16 u of
// the bound of all terms. Adding up the losses of additions is off by at most (n u)^2 of n such bounds, and the last
// addition by u of them. Twice the sum of all three.
f64 doubt_of_sum_over(const Component& component, f64 n) {
  const f64 size = component.size;
  return 0x1p-52 * (17 + n * n * 0x1p-53) * n * size * size * size;
}

// Is the sign of the sum certain, and would it be so to measure_volumes()? `faces`: at least those of the component.
bool is_sure(f64 sum, const Component& component, u32 faces) {
  return component.volume.doubt < unknown_volume &&
         abs_of(sum) > component.volume.doubt + doubt_of_sum_over(component, faces);
}

// Are both signs certain, and the same?
bool same_side(const SignedVolume& a, const SignedVolume& b) {
  return abs_of(a.sum) > a.doubt && abs_of(b.sum) > b.doubt && (a.sum > 0) == (b.sum > 0);
}

}  // namespace

// ---------------------------------------------------------------- measuring

namespace {

template <class PositionOf>
void measure_with_doubts(const Mesh& m, Components& c, PositionOf at) {
  sum_faces(m, c, at, [](const Vec3& from, const Vec3& p, const Vec3& q, const Vec3& r) {
    SignedVolume face;
    add(face, 1, from, p, q, r);
    return face;
  });
  // Adding up the losses of n additions rounds by less than (n 2^-53)^2 of all terms.
  const f64 n = m.face_count;
  for (Component& component : c.list) {
    component.volume.doubt *= 2 + n * n * 0x1p-57;
    component.size = DBL_MAX;
  }
}

}  // namespace

void measure_enclosed(const Mesh& m, Components& c) {
  measure_with_doubts(m, c, [&](u32 v) -> const Vec3& { return m.position[v]; });
}

void measure_before(const Edit& e, Components& c) {
  const auto then = [&](u32 v) -> const Vec3& { return old_position(e, v); };
  measure_with_doubts(e.mesh, c, then);
  measure_sizes(e.mesh, c, then);
}

void measure_volumes(const Edit& e, Components& c) {
  const Mesh& m = e.mesh;
  bool known = true;
  for (const Component& component : c.list) known = known && is_sure(component.volume.sum, component, m.face_count);
  const auto then = [&](u32 v) -> const Vec3& { return old_position(e, v); };
  const auto now = [&](u32 v) -> const Vec3& { return m.position[v]; };
  if (!known) {
    sum_and_count(m, c, then);
    measure_sizes(m, c, then);
  }
  for (Component& component : c.list) {
    component.sum_before = component.volume.sum;
    component.was_flat = !known && abs_of(component.sum_before) <= doubt_of_sum_over(component, component.volume.doubt);
  }
  sum_and_count(m, c, now);
  measure_sizes(m, c, now);
  for (Component& component : c.list) component.volume.doubt = doubt_of_sum_over(component, component.volume.doubt);
}

// ---------------------------------------------------------------- calls that fail

void keep_volumes(const Components& c, KnownVolume* known) {
  for (u32 i = 0; i < c.list.size; ++i) known[i] = {c.list[i].volume, c.list[i].size};
}

void take_back_volumes(Components& c, const KnownVolume* known) {
  for (u32 i = 0; i < c.list.size; ++i) {
    c.list[i].volume = known[i].volume;
    c.list[i].size = known[i].size;
  }
}

// ---------------------------------------------------------------- following edits

bool stays_outside_out(const Components& c, u32 v, const SignedVolume& change) {
  const SignedVolume& now = component_at(c, v).volume;
  SignedVolume then = now;
  add(then, change);
  return same_side(now, then);
}

void note_change(Components& c, u32 v, const SignedVolume& change) { add(component_at(c, v).volume, change); }

SignedVolume change_by_move(const Edit& e, u32 v) {
  const Journal& j = e.journal;
  return change_by_move(e.mesh, v, j.position, [&](u32 u) { return (u < j.vertex_count) & j.vertices.contains(u); });
}

void find_turned(const Mesh& m, const Moves& moves, Components& c, Stack<u32>& turned) {
  const u8* mark = moves.mark;
  for (u32 v : moves.vertices) {
    if (mark[v] == 0) continue;
    Component& component = component_at(c, v);
    if (!component.is_followed) {
      component.is_followed = true;
      component.sum_before = component.volume.sum;
    }
    add(component.volume, change_by_move(m, v, moves.before, [&](u32 u) { return mark[u] != 0; }));
  }
  const auto is_turned = [](const Component& component) {
    return !same_side({component.sum_before, component.volume.doubt}, component.volume);
  };
  bool any = false;
  for (const Component& component : c.list) any = any || (component.is_followed && is_turned(component));
  for (u32 v : moves.vertices)
    if (any && mark[v] != 0 && is_turned(component_at(c, v))) turned.push(v);
  for (Component& component : c.list) {
    if (!component.is_followed) continue;
    if (any) component.volume.sum = component.sum_before;
    component.is_followed = false;
  }
}

bool none_turned(const Edit& e, Components& c) {
  const Mesh& m = e.mesh;
  const Journal& j = e.journal;
  bool sure = true;
  f64 farthest = 0;
  for (u32 v : j.vertices)
    if (has_moved(e, v)) {
      Component& component = component_at(c, v);
      component.sum_before = component.volume.sum;
      sure = sure && is_sure(component.volume.sum, component, m.face_count);
      farthest = max_of(farthest, size_of(m.position[v] - j.position[v]));
    }
  if (!sure) return false;
  for (u32 v : j.vertices) {
    if (!has_moved(e, v)) continue;
    Component& component = component_at(c, v);
    add(component.volume, change_by_move(e, v));
    component.is_followed = true;
  }
  // Each component once.
  for (u32 v : j.vertices) {
    if (!has_moved(e, v)) continue;
    Component& component = component_at(c, v);
    if (!component.is_followed) continue;
    component.is_followed = false;
    component.size += 2 * farthest;
    sure = sure && (component.volume.sum > 0) == (component.sum_before > 0) &&
           is_sure(component.volume.sum, component, m.face_count) &&
           is_sure(component.sum_before, component, m.face_count);
  }
  // measure_volumes() takes known volumes for those at the start.
  for (u32 v : j.vertices)
    if (!sure && has_moved(e, v)) component_at(c, v).volume.sum = component_at(c, v).sum_before;
  return sure;
}

}  // namespace tpa
