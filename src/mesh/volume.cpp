#include "mesh/volume.h"

#include "geometry/expansion.h"

namespace tpa {

namespace {

// What a face adds to six volumes, seen from a point.
f64 six_volumes_of(const Vec3& from, const Vec3& a, const Vec3& b, const Vec3& c) {
  return dot(a - from, cross(b - from, c - from));
}

// Of what measure_volumes() tells of it. With u half an ulp of 1, each of n terms is off by less than 16 u of the bound
// of all; adding up what additions lost, by (n u)^2 of n such bounds at most; and the last addition by u of these.
// Twice that.
f64 doubt_anew(const Component& part, u32 faces) {
  const f64 n = faces;
  return 0x1p-52 * (17 + n * n * 0x1p-53) * n * part.size * part.size * part.size;
}

bool is_sure(f64 six_volumes, const Component& part, u32 faces) {
  return part.volume_doubt < unknown_volume && abs_of(six_volumes) > part.volume_doubt + doubt_anew(part, faces);
}

// Does the journal have where the vertex was? One that has taken over the slot of another counts as come from there.
bool is_saved(const Edit& e, u32 v) { return (v < e.journal.vertex_count) & e.journal.vertices.contains(v); }

// Of a vertex that moved.
SixVolumes change_by_move(const Edit& e, u32 v) {
  return change_by_move(e.mesh, v, e.journal.position, [&](u32 u) { return is_saved(e, u); });
}

// The component of one vertex after another: vertices and faces of a component mostly follow each other.
struct Whole {
  Components& components;
  u32 label = none;
  Component* part = nullptr;
  Component& of(u32 v) {
    if (components.label[v] != label) {
      label = components.label[v];
      part = &components.list[component_of(components, v)];
    }
    return *part;
  }
};

// Six volumes of all components, as they are or were before: sums whose errors do not add up (Neumaier 1974). What
// additions lose is kept where doubts will be. No doubt of each face, as measure_enclosed() has it: this is for
// every step in which most vertices move.
void sum_up(const Edit& e, bool before, Components& components) {
  const Mesh& m = e.mesh;
  const auto at = [&](u32 v) -> const Vec3& { return before ? old_position(e, v) : m.position[v]; };
  for (Component& part : components.list) part.six_volumes = part.volume_doubt = 0;
  Whole whole{components};
  for (u32 f = 0; f < m.face_count; ++f) {
    if (!face_lives(m, f)) continue;
    const u32* c = m.corner + 3 * f;
    Component& part = whole.of(c[0]);
    // Seen from one of its vertices: far from the origin little would be left of the digits.
    const ExactPair sum = two_sum(part.six_volumes, six_volumes_of(at(part.id), at(c[0]), at(c[1]), at(c[2])));
    part.six_volumes = sum.high;
    part.volume_doubt += sum.low;
  }
  for (Component& part : components.list) part.six_volumes += part.volume_doubt;
}

}  // namespace

void measure_volumes(const Edit& e, Components& components) {
  const Mesh& m = e.mesh;
  bool known = true;
  for (const Component& part : components.list) known = known && is_sure(part.six_volumes, part, m.face_count);
  if (!known) sum_up(e, true, components);
  for (Component& part : components.list) {
    part.six_volumes_before = part.six_volumes;
    part.size = 0;
  }
  sum_up(e, false, components);
  Whole whole{components};
  for (u32 v = 0; v < m.vertex_count; ++v) {
    if (!vertex_lives(m, v)) continue;
    Component& part = whole.of(v);
    part.size = max_of(part.size, 2 * size_of(m.position[v] - m.position[part.id]));
  }
  for (Component& part : components.list) part.volume_doubt = doubt_anew(part, m.face_count);
}

bool none_turned(const Edit& e, Components& c) {
  const Mesh& m = e.mesh;
  const Journal& j = e.journal;
  const auto part_of = [&](u32 v) -> Component& { return c.list[component_of(c, v)]; };
  bool sure = true;
  f64 farthest = 0;
  for (u32 v : j.vertices)
    if (has_moved(e, v)) {
      Component& part = part_of(v);
      part.six_volumes_before = part.six_volumes;
      sure = sure && is_sure(part.six_volumes, part, m.face_count);
      farthest = max_of(farthest, size_of(m.position[v] - j.position[v]));
    }
  if (!sure) return false;
  for (u32 v : j.vertices) {
    if (!has_moved(e, v)) continue;
    Component& part = part_of(v);
    note(part, change_by_move(e, v));
    part.family = 0;
  }
  // Each component once.
  for (u32 v : j.vertices) {
    if (!has_moved(e, v)) continue;
    Component& part = part_of(v);
    if (part.family == none) continue;
    part.family = none;
    part.size += 2 * farthest;
    sure = sure && (part.six_volumes > 0) == (part.six_volumes_before > 0) &&
           is_sure(part.six_volumes, part, m.face_count) && is_sure(part.six_volumes_before, part, m.face_count);
  }
  // Else the one who measures would take them for the volumes before.
  for (u32 v : j.vertices)
    if (!sure && has_moved(e, v)) part_of(v).six_volumes = part_of(v).six_volumes_before;
  return sure;
}

namespace {

struct PartVolumes {
  const Edit& e;
  Components& before;
  Parts& p;

  // Of the family of a component before; none where nothing but positions changed.
  Family* family_of(u32 component) const {
    u32 i = component;
    if (before.list[i].family == none) return nullptr;
    while (before.list[i].family != i) i = before.list[i].family;
    return &p.families[p.open[i]];
  }
  Family* family_of_vertex(u32 v) const { return family_of(component_of(before, e.mesh.vertex_origin[v].parents[0])); }
};

// Where a family is seen from: a vertex before. Closed surfaces enclose the same from wherever they are seen.
const Vec3& eye_of(const Edit& e, const Family& f) { return old_position(e, f.before); }

void add_face(Family& f, const Vec3& from, f64 sign, const Vec3& a, const Vec3& b, const Vec3& c) {
  SixVolumes sum{f.six_volumes, f.volume_doubt};
  add(sum, sign, from, a, b, c);
  f.six_volumes = sum.sum, f.volume_doubt = sum.doubt;
}

// What families enclosed before, and how far their vertices were from each other. What is not known stays so, whatever
// is added.
void add_components(PartVolumes& q) {
  for (u32 i : q.p.touched) {
    const Component& part = q.before.list[i];
    Family& f = *q.family_of(i);
    f.six_volumes += part.six_volumes;
    f.volume_doubt += part.volume_doubt + 0x1p-52 * abs_of(f.six_volumes);
    f.size += part.size + size_of(old_position(q.e, part.id) - eye_of(q.e, f));
  }
}

// First changed faces, new ones with vertices where these were: of the other faces nothing has changed so far. Then
// these vertices move, one after another.
void add_changes(PartVolumes& q) {
  const Edit& e = q.e;
  const Mesh& m = e.mesh;
  const Journal& j = e.journal;
  const auto before = [&](u32 v) -> const Vec3& { return v < j.vertex_count ? old_position(e, v) : m.position[v]; };
  for (u32 f : j.faces) {
    if (!is_changed(e, f)) continue;
    if (f < j.face_count) {
      const u32* c = j.face[f].corner;
      Family& family = *q.family_of(component_of(q.before, c[0]));
      add_face(family, eye_of(e, family), -1, old_position(e, c[0]), old_position(e, c[1]), old_position(e, c[2]));
    }
    if (f < m.face_count && face_lives(m, f)) {
      const u32* c = m.corner + 3 * f;
      Family& family = *q.family_of_vertex(c[0]);
      add_face(family, eye_of(e, family), 1, before(c[0]), before(c[1]), before(c[2]));
    }
  }
  f64 farthest = 0;  // from where a vertex was, or its parent
  for (u32 v : j.vertices) {
    if (v >= m.vertex_count || !vertex_lives(m, v)) continue;
    farthest = max_of(farthest, size_of(m.position[v] - old_position(e, m.vertex_origin[v].parents[0])));
    if (!is_saved(e, v) || !has_moved(e, v)) continue;
    if (Family* family = q.family_of_vertex(v)) {
      const SixVolumes change = change_by_move(e, v);
      family->six_volumes += change.sum;
      family->volume_doubt += change.doubt + 0x1p-52 * abs_of(family->six_volumes);
    }
  }
  for (Family& f : q.p.families) f.size += 2 * farthest;
}

// All of it is known.
void measure_whole(PartVolumes& q, Part& part, Family& f) {
  const Mesh& m = q.e.mesh;
  const Vec3& from = m.position[part.done];
  SixVolumes all;
  part.size = 0;
  for_each_vertex(q.p, part, [&](u32 v) {
    part.size = max_of(part.size, 2 * size_of(m.position[v] - from));
    for_each_outgoing(m, v, [&](u32 h) {
      const u32 a = head(m, h), b = apex(m, h);
      if (a < v || b < v) return;
      add(all, 1, from, m.position[v], m.position[a], m.position[b]);
    });
  });
  part.six_volumes = all.sum, part.volume_doubt = all.doubt;
  f.six_volumes -= part.six_volumes;
  f.volume_doubt += part.volume_doubt + 0x1p-52 * abs_of(f.six_volumes);
}

}  // namespace

void measure_parts(const Edit& e, Components& before, Parts& p) {
  PartVolumes q{e, before, p};
  add_components(q);
  add_changes(q);
  for (Part& part : p.list)
    if (is_root(p, part) && part.whole) measure_whole(q, part, p.families[part.family]);
  for (const Family& f : p.families) {
    if (f.open_part == none) continue;
    Part& part = p.list[f.open_part];
    part.six_volumes = f.six_volumes;
    part.volume_doubt = f.volume_doubt < unknown_volume ? f.volume_doubt : unknown_volume;
    part.size = f.size;
  }
}

}  // namespace tpa
