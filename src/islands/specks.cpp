// SPDX-License-Identifier: MIT
#include "islands/specks.h"

#include "islands/rules.h"
#include "islands/small_components.h"
#include "mesh/component_changes.h"

namespace tpa {

CutSizes sizes_of_contacts(const Workspace& w) {
  const Mesh& m = w.edit.mesh;
  CutSizes sum;
  const auto add = [&](u32 f) {
    f64 shortest = no_way, longest = 0;
    for (u32 h = 3 * f; h < 3 * f + 3; ++h) {
      const f64 squared = squared_length(m.position[head(m, h)] - m.position[tail(m, h)]);
      shortest = min_of(shortest, squared);
      longest = max_of(longest, squared);
    }
    sum.spacing += square_root(shortest);
    sum.longest += square_root(longest);
    sum.triangle += square_root(length(face_normal(m, f)));
  };
  for (const Contact& c : w.detection.pairs) {
    add(c.a);
    add(c.b);
  }
  const f64 count = max_of(1.0, 2 * static_cast<f64>(w.detection.pairs.size));
  return {sum.spacing / count, sum.triangle / count, sum.longest / count};
}

namespace {

struct Speck {
  f64 six_volumes = 0, area = 0;
};

Speck measure_speck(const Mesh& m, Span<const u32> vertices) {
  const Vec3& from = m.position[vertices[0]];
  Speck speck;
  for_each_face_of(m, vertices, [&](u32 h) {
    const Vec3 &a = m.position[tail(m, h)], &b = m.position[head(m, h)], &c = m.position[apex(m, h)];
    speck.six_volumes += six_volumes_of(from, a, b, c);
    speck.area += 0.5 * length(face_normal(m, face_of(h)));
  });
  return speck;
}

// How far a component lies from the faces in contact, if farther than known.
f64 reach_of_speck(FacesInContact& met, const Mesh& m, Span<const u32> vertices, f64 far) {
  for_each_face_of(m, vertices, [&](u32 h) {
    const Vec3 corner[] = {m.position[tail(m, h)], m.position[head(m, h)], m.position[apex(m, h)]};
    far = met.reach_of(corner, 3, met.near(tail(m, h), face_of(h)), far);
  });
  return far;
}

// Components that a step has made or changed are leftovers of the seam and no objects, if they are smaller than the
// triangles in contact, or voids thinner than these. But bodies that the paper's way frees are droplets from both sides
// of a pinched neck.
bool is_small_speck(const Attempt& a, const Speck& speck, const CutSizes& sizes) {
  const f64 six_volumes = abs_of(speck.six_volumes), cube = 6 * sizes.spacing * sizes.spacing * sizes.spacing;
  return speck.six_volumes < 0 ? six_volumes < max_of(cube, sizes.triangle * speck.area)
                               : six_volumes < cube && !a.as_in_the_paper();
}

bool lives_changed(const Edit& e, u32 f) { return f < e.mesh.face_count && face_lives(e.mesh, f) && is_changed(e, f); }

}  // namespace

void drop_specks(Attempt& a, const CutSizes& sizes) {
  Workspace& w = a.w;
  Edit& e = w.edit;
  Stack<u32>& found = w.work_vertices;
  u8* mark = w.relocation.vertex_mark;
  found.clear();
  for (u32 f : e.journal.claims.faces) {
    if (has_stopped(a.meter())) break;
    if (!lives_changed(e, f) || mark[e.mesh.corner[3 * f]] == found_before) continue;
    const u32 begin = found.size;
    if (!collect_small_component(w, e.mesh.corner[3 * f], most_of_speck)) continue;
    const Span<const u32> component = found.span().part(begin, found.size - begin);
    const Speck speck = measure_speck(e.mesh, component);
    if (!is_small_speck(a, speck, sizes)) continue;
    if (abs_of(speck.six_volumes) > a.left_in_ledger()) continue;
    a.region.add_volume(-speck.six_volumes);
    a.region.add_bounded(abs_of(speck.six_volumes),
                         [&](f64 so_far) { return reach_of_speck(a.t.met, e.mesh, component, so_far); });
    remove_component(e, w.near_faces, component);
    for (u32 v : component) mark[v] = 0;
    found.size = begin;
  }
  for (u32 v : found) mark[v] = 0;
}

}  // namespace tpa
