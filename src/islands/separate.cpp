// SPDX-License-Identifier: MIT
#include "islands/separate.h"

#include "geometry/predicates.h"
#include "islands/rules.h"

namespace tpa {

namespace {

f64 power_of_two_above(f64 x) {
  f64 power = smallest_magnitude;
  while (power < x) power *= 2;
  return power;
}

// Are all corners of g within `flat` of the plane of f, and some corner off the plane?
bool is_nearly_flat_on(const Mesh& m, u32 f, u32 g, f64 flat) {
  const Vec3 normal = face_normal(m, f);
  const f64 size = length(normal);
  bool in_plane = true;
  const Plane plane = plane_of(corner_position(m, 3 * f), corner_position(m, 3 * f + 1), corner_position(m, 3 * f + 2));
  for (u32 h = 3 * g; h < 3 * g + 3; ++h) {
    if (abs_of(dot(normal, corner_position(m, h) - *plane.a)) > flat * size) return false;
    in_plane = in_plane && side_of(plane, corner_position(m, h)) == 0;
  }
  return !in_plane;
}

// The sum of the faces' normals, weighted by area, before any vertex moves.
Vec3 direction_outward(const Workspace& w, u32 v) {
  const Mesh& m = w.edit.mesh;
  Vec3 sum;
  for_each_outgoing(m, v, [&](u32 h) {
    const Vec3* at[3];
    for (u32 i = 0; i < 3; ++i) {
      const u32 u = m.corner[3 * face_of(h) + i];
      at[i] = w.relocation.vertex_mark[u] != 0 ? w.relocation.saved + u : m.position + u;
    }
    sum = sum + area_normal(*at[0], *at[1], *at[2]);
  });
  const f64 size = length(sum);
  return (size > 0 ? 1 / size : 0) * sum;
}

}  // namespace

Scale scale_of_contacts(const Workspace& w) {
  const Mesh& m = w.edit.mesh;
  Scale scale;
  const auto add = [&](u32 f) {
    for (u32 h = 3 * f; h < 3 * f + 3; ++h) {
      const Vec3 &p = corner_position(m, h), &q = corner_position(m, next_edge(h));
      scale.largest = max_of(scale.largest, max_of(abs_of(p.x), max_of(abs_of(p.y), abs_of(p.z))));
      if (!(p == q)) scale.shortest = min_of(scale.shortest, length(q - p));
    }
  };
  for (const Contact& c : w.detection.pairs) for_both(c, add);
  return scale;
}

// The first grid is 2^17 times as coarse as the rounding of the largest coordinate, so surfaces that cross at a slope
// of grid spacings have seams known to 2^-17 of a face. Each pass takes a grid four times as coarse. Where coordinates
// are large beside the edges, the grid stays a part of the edges, and never finer than the coordinates themselves.
Separation separation_of(const Scale& scale, u32 pass) {
  const f64 unit = 0x1p-53 * power_of_two_above(scale.largest);
  const f64 wanted = 0x1p17 * unit * static_cast<f64>(u64{1} << 2 * pass);
  f64 grid = wanted;
  while (grid > max_of(unit, grid_share * scale.shortest)) grid /= 2;
  return {min_of(0x1p6 * unit, grid), grid, 16 * grid, 64 * grid};
}

void find_nearly_flat(Workspace& w, const Separation& s) {
  Relocation& r = w.relocation;
  const Mesh& m = w.edit.mesh;
  clear_faces(r);
  spend(w.near_faces.meter, 2 * u64{w.detection.pairs.size});
  for (const Contact& c : w.detection.pairs) {
    if (!is_nearly_flat_on(m, c.a, c.b, s.flat) && !is_nearly_flat_on(m, c.b, c.a, s.flat)) continue;
    add_face(r, c.a);
    add_face(r, c.b);
  }
  clear_marks(r);
}

void separate(Attempt& a, const Separation& s) {
  Workspace& w = a.w;
  Relocation& r = w.relocation;
  const Mesh& m = w.edit.mesh;
  w.work_vertices.clear();
  spend(a.meter(), 16 * u64{r.faces.size});
  for (u32 f : r.faces)
    for (u32 h = 3 * f; h < 3 * f + 3; ++h) {
      const u32 v = m.corner[h];
      if (r.vertex_mark[v] != 0) continue;
      r.vertex_mark[v] = 1;
      r.saved[v] = m.position[v];
      w.work_vertices.push(v);
    }
  const auto snapped = [&](f64 x) { return s.grid * static_cast<f64>(floor_to_integer(x / s.grid + 0.5)); };
  for (u32 v : w.work_vertices) {
    const Vec3 p = r.saved[v] + s.outward * direction_outward(w, v);
    set_position(w.edit, v, into_exact_range({snapped(p.x), snapped(p.y), snapped(p.z)}));
  }
  for (u32 v : w.work_vertices) r.vertex_mark[v] = 0;
  for (u32 v : w.work_vertices) a.region.add_move(m, v, r.saved[v], m.position[v]);
  collect_faces(m, w.work_vertices.span(), r);
  for (const Contact& c : w.detection.pairs) {
    add_face(r, c.a);
    add_face(r, c.b);
  }
  for (u32 f : r.faces) insert(w.near_faces, m, f);
  detect_around(m, w.near_faces, a.t.exec, r);
}

}  // namespace tpa
