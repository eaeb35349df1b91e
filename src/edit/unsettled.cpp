// SPDX-License-Identifier: MIT
#include "edit/unsettled.h"

#include <string.h>

#include "detect/new_faces.h"
#include "edit/edge_aims.h"

namespace tpa {

namespace {

void unsettle(Unsettled& u, u32 f) {
  u.lengths.add(f);
  u.flips.add(f);
}

void copy(const BitSet& from, BitSet& to) { memcpy(to.level[0], from.level[0], from.words * sizeof(u32)); }

// Collapses at a hub have too many faces, whatever else changes there. Without this bound a hub would cost its valence
// for each change.
static_assert(faces_of_no_hub >= 2 * largest_star);

void unsettle_faces_of(Unsettled& u, const Mesh& m, u32 v) {
  if (is_hub(m, v)) return;
  for_each_outgoing(m, v, [&](u32 h) { unsettle(u, face_of(h)); });
}

// The faces at v, and those across from v.
void unsettle_within(Unsettled& u, const Mesh& m, u32 v) {
  for_each_outgoing(m, v, [&](u32 h) {
    unsettle(u, face_of(h));
    unsettle(u, face_of(m.opposite[next_edge(h)]));
  });
}

// Each vertex once: vertices near each other have most neighbours in common.
void unsettle_collected(Unsettled& u, const Mesh& m) {
  for (u32 v : u.vertices) unsettle_faces_of(u, m, v);
  u.vertices.cut_off(0);
}

}  // namespace

void note_changed(Unsettled& u, const BitSet& vertices, const BitSet& faces) {
  for (u32 v : vertices) u.vertices.add(v);
  for (u32 f : faces) u.faces.add(f);
}

void keep(Unsettled& u) {
  copy(u.lengths, u.lengths_before);
  copy(u.flips, u.flips_before);
}
void take_back(Unsettled& u) {
  copy(u.lengths_before, u.lengths);
  copy(u.flips_before, u.flips);
}

void unsettle_all(Unsettled& u, const Mesh& m) {
  u.vertices.cut_off(0);
  u.faces.cut_off(0);
  for (u32 f = 0; f < m.face_count; ++f) unsettle(u, f);
}

void unsettle_part(Unsettled& u, const Mesh& m, Span<const u32> vertices) {
  u.lengths.cut_off(0);
  for (u32 v : vertices) for_each_outgoing(m, v, [&](u32 h) { u.lengths.add(face_of(h)); });
}

void set_flips_aside(Unsettled& u, const Mesh& m, Span<const u32> part) {
  u.flips.cut_off(0);
  for (u32 v : part)
    for_each_outgoing(m, v, [&](u32 h) {
      if (u.flips_before.contains(face_of(h))) u.flips.add(face_of(h));
    });
}
void take_flips_up(Unsettled& u, const Mesh& m, const u8* chosen) {
  for (u32 f : u.flips_before) {
    const u32* v = m.corner + 3 * static_cast<size_t>(f);
    if (face_lives(m, f) && (chosen[v[0]] | chosen[v[1]] | chosen[v[2]]) == 0) u.flips.add(f);
  }
}

void unsettle_round(Unsettled& u, const Mesh& m, u32 f) {
  unsettle(u, f);
  for (u32 h = 3 * f; h < 3 * f + 3; ++h) {
    unsettle(u, face_of(m.opposite[h]));
    unsettle_faces_of(u, m, m.corner[h]);
  }
}

void unsettle_star(Unsettled& u, const Mesh& m, u32 v) {
  unsettle_within(u, m, v);
  for_each_neighbour(m, v, [&](u32 b) { unsettle_faces_of(u, m, b); });
}

void unsettle_stars(Unsettled& u, const Mesh& m, Span<const u32> vertices) {
  for (u32 v : vertices) {
    unsettle_within(u, m, v);
    for_each_neighbour(m, v, [&](u32 b) { u.vertices.add(b); });
  }
  unsettle_collected(u, m);
}

void spread(Unsettled& u, const Mesh& m, Stack<u32>& list) {
  u.faces.cut_off(m.face_count);
  u.lengths.cut_off(m.face_count);
  u.flips.cut_off(m.face_count);
  u.vertices.cut_off(m.vertex_count);
  for (u32 v : u.vertices) for_each_outgoing(m, v, [&](u32 h) { u.faces.add(face_of(h)); });
  u.vertices.cut_off(0);
  list.clear();
  for (u32 f : u.faces) list.push(f);
  u.faces.cut_off(0);
  // Most faces near many changes are near several.
  if (list.size > m.face_count / 4) return unsettle_all(u, m);
  for (u32 f : list) {
    unsettle(u, f);
    for (u32 h = 3 * f; h < 3 * f + 3; ++h) {
      unsettle(u, face_of(m.opposite[h]));
      u.vertices.add(m.corner[h]);
    }
  }
  unsettle_collected(u, m);
}

}  // namespace tpa
