// SPDX-License-Identifier: MIT
#include "arrangement/exact_cut.h"

#include "arrangement/divide.h"
#include "arrangement/edges.h"
#include "arrangement/regions.h"
#include "arrangement/traces.h"

namespace tpa {

namespace {

// Is the wedge of space behind the half-edge, counter-clockwise round its edge, behind the piece?
bool region_follows(const Arrangement& a, u32 h) { return !runs_upward(a, h); }

// The next half-edge of a kept piece in the ring, h itself if there is no other.
u32 next_kept(const Arrangement& a, u32 h) {
  u32 g = a.around[h], steps = 1;
  for (; g != h && !is_kept(a.pieces[face_of(g)]); ++steps) g = a.around[g];
  spend(meter_of(a), steps);
  return g;
}

void pair_edges(Arrangement& a) {
  a.shared.clear();
  for (u32 h = 0; h < 3 * a.pieces.size; ++h) a.mate[h] = none;
  for (u32 h = 0; h < 3 * a.pieces.size && !has_stopped(a); ++h) {
    if (!is_kept(a.pieces[face_of(h)]) || !region_follows(a, h)) continue;
    const u32 g = next_kept(a, h);
    if (g == h || region_follows(a, g)) continue;
    a.mate[h] = g;
    a.mate[g] = h;
    if (next_kept(a, g) != h) a.shared.push(h);
  }
}

// Joins the rim of the divided faces to the faces beyond.
bool find_borders(Arrangement& a, const u8* face_mark) {
  const Mesh& m = *a.mesh;
  a.borders.clear();
  for (u32 f : a.faces)
    for (u32 h = 3 * f; h < 3 * f + 3; ++h) {
      const u32 beyond = m.opposite[h];
      if (face_mark[face_of(beyond)] != 0) continue;
      const u32 p = add_vertex_point(a.points, tail(m, h)), q = add_vertex_point(a.points, head(m, h));
      const u32 inner = find_edge(a, p, q);
      if (inner == none || point_at_tail(a, inner) != p || a.around[inner] != inner) return false;
      a.mate[inner] = border_tag | a.borders.size;
      if (!a.borders.push(beyond)) return false;
    }
  return true;
}

bool all_paired(const Arrangement& a) {
  for (u32 h = 0; h < 3 * a.pieces.size; ++h)
    if (is_kept(a.pieces[face_of(h)]) && a.mate[h] == none) return false;
  return true;
}

CutOutcome divide_and_choose(Arrangement& a, Span<const Contact> contacts, const u8* face_mark, const NearFaces& g,
                             i32 winding_at_infinity) {
  a.traced = find_traces(a, contacts);
  if (!a.traced || !divide_facets(a)) return a.map.contradiction ? CutOutcome::contradiction : CutOutcome::room;
  if (!link_edges(a) || !find_windings(a, g, winding_at_infinity)) return CutOutcome::contradiction;
  pair_edges(a);
  return find_borders(a, face_mark) && all_paired(a) ? CutOutcome::success : CutOutcome::contradiction;
}

}  // namespace

CutOutcome cut_exactly(Arrangement& a, Span<const Contact> contacts, const u8* face_mark, const NearFaces& g,
                       i32 winding_at_infinity) {
  const CutOutcome outcome = divide_and_choose(a, contacts, face_mark, g, winding_at_infinity);
  return has_stopped(a) ? CutOutcome::stopped : outcome;
}

}  // namespace tpa
