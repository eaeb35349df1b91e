// SPDX-License-Identifier: MIT
#include "step/region_check.h"

#include "mesh/component_changes.h"

namespace tpa {

namespace {

// Where an old vertex was after the move, before the first change.
Vec3 moved_position(const Workspace& w, u32 v) {
  return state_of(w, v, target_state) == target_taken ? w.target[v] : old_position(w.edit, v);
}

bool lives_unchanged(const Edit& e, u32 f) {
  return f < e.journal.face_count && f < e.mesh.face_count && face_lives(e.mesh, f) && !is_changed(e, f);
}

}  // namespace

f64 six_volumes(const Mesh& m) {
  const Vec3 from = m.position[0];
  f64 sum = 0;
  for (u32 f = 0; f < m.face_count; ++f)
    if (face_lives(m, f))
      sum +=
          six_volumes_of(from, corner_position(m, 3 * f), corner_position(m, 3 * f + 1), corner_position(m, 3 * f + 2));
  return abs_of(sum);
}

f64 six_volumes_changed(const Workspace& w, f64& reach) {
  const Edit& e = w.edit;
  const Mesh& m = e.mesh;
  const Journal& j = e.journal;
  f64 volume = 0, longest_gone = 0, longest_made = 0;
  Vec3 from;
  bool seen = false;
  const auto eye = [&](const Vec3& p) -> const Vec3& {
    if (!seen) from = p;
    seen = true;
    return from;
  };
  const auto longest_edge = [](const Vec3& a, const Vec3& b, const Vec3& c) {
    return square_root(max_of(squared_length(b - a), max_of(squared_length(c - b), squared_length(a - c))));
  };
  const auto now = [&](const u32* c) {
    return six_volumes_of(eye(m.position[c[0]]), m.position[c[0]], m.position[c[1]], m.position[c[2]]);
  };
  const auto then = [&](const u32* c, bool went) {
    const Vec3 p = moved_position(w, c[0]), q = moved_position(w, c[1]), s = moved_position(w, c[2]);
    if (went) longest_gone = max_of(longest_gone, longest_edge(p, q, s));
    return six_volumes_of(eye(p), p, q, s);
  };
  for (u32 f : j.faces) {
    if (!is_changed(e, f)) continue;
    if (f < j.face_count) volume -= then(j.face[f].corner, true);
    if (f >= m.face_count || !face_lives(m, f)) continue;
    volume += now(m.corner + 3 * static_cast<size_t>(f));
    longest_made = max_of(longest_made, longest_edge(corner_position(m, 3 * f), corner_position(m, 3 * f + 1),
                                                     corner_position(m, 3 * f + 2)));
  }
  // Faces with vertices that have moved since, each at its lowest such vertex.
  const auto has_left = [&](u32 v) { return j.vertices.contains(v) && !(moved_position(w, v) == m.position[v]); };
  for (u32 v : j.vertices) {
    if (v >= m.vertex_count || !vertex_lives(m, v) || v >= j.vertex_count || !is_old(m, v) || !has_left(v)) continue;
    for_each_outgoing(m, v, [&](u32 h) {
      const u32* c = m.corner + 3 * static_cast<size_t>(face_of(h));
      if (!lives_unchanged(e, face_of(h))) return;
      for (u32 i = 0; i < 3; ++i)
        if (c[i] < v && has_left(c[i])) return;
      volume += now(c) - then(c, false);
    });
  }
  reach = longest_made + 1.5 * longest_gone;
  return volume;
}

}  // namespace tpa
