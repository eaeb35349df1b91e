// SPDX-License-Identifier: MIT
#include "surgery/merge_close.h"

#include "edit/collapse.h"

namespace tpa {

namespace {

// Contracts the half-edge if it is short and one of its ends is new.
bool merge_ends(Edit& e, NearFaces& g, f64 reach, u32 h, MergeScratch& scratch, RegionChange& region) {
  const Mesh& m = e.mesh;
  const u32 u = tail(m, h), v = head(m, h);
  if (!(squared_length(m.position[u] - m.position[v]) < reach * reach) || (is_old(m, u) && is_old(m, v))) return false;
  const u32 goes = is_old(m, u) ? v : u, stays = is_old(m, u) ? u : v;
  RegionChange change = region;
  change.add_move(m, goes, m.position[goes], m.position[stays]);
  if (!contract_edge(e, g, goes, stays, scratch.face_mark)) return false;
  scratch.stretched.push(stays);
  region = change;
  return true;
}

}  // namespace

void merge_close(Edit& e, NearFaces& g, f64 reach, MergeScratch& scratch, RegionChange& region) {
  Stack<u32>& faces = scratch.faces;
  scratch.stretched.clear();
  for (bool again = true; again && !has_stopped(g.meter);) {
    again = false;
    for (u32 f : faces) {
      spend(g.meter, 1);
      if (has_stopped(g.meter)) break;
      for (u32 i = 0; i < 3 && face_lives(e.mesh, f); ++i)
        if (merge_ends(e, g, reach, 3 * f + i, scratch, region)) again = true;
    }
  }
  u32 kept = 0;
  for (u32 f : faces)
    if (face_lives(e.mesh, f)) faces[kept++] = f;
  faces.size = kept;
}

}  // namespace tpa
