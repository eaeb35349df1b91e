// SPDX-License-Identifier: MIT
#include "step/swallowed.h"

#include "cut/swallowed_components.h"

namespace tpa {

namespace {

// Cheap proofs that every component bounds something. Their cost grows with the moved or changed part; from a certain
// share of the mesh on, judging all components costs as much.
bool is_seen_clean(Transaction& t) {
  Workspace& w = t.w;
  if (t.changed)
    return t.parts_known = none_swallowed(w.edit, w.near_faces, t.winding_at_infinity(), w.before, w.parts);
  return t.moves_few() && none_turned(w.edit, w.before);
}

// A component in contact has no side of its own, so those of islands without a solution stay (tpa_adapt).
void keep_unresolved(const Transaction& t, Components& parts) {
  const Mesh& m = t.w.edit.mesh;
  for (const Island& island : t.islands) {
    if (island.attempt != last_attempt(t.mode)) continue;
    for (const IslandContact& c : t.contacts.span().part(island.first, island.count))
      for_both(c, [&](u32 f) {
        if (face_lives(m, f)) parts.list[component_of(parts, m.corner[3 * f])].verdict = Verdict::stays;
      });
  }
}

u32 find_swallowed(const Transaction& t, Components& parts) {
  return find_swallowed(t.w.edit.mesh, t.w.near_faces, t.winding_at_infinity(), parts);
}

// Removes the marked components.
void drop_marked(Transaction& t, Components& parts, u32 marked) {
  if (marked == 0) return;
  Workspace& w = t.w;
  t.changed = true;
  const u32 vertices = remove_swallowed(w.edit, w.near_faces, parts);
  t.report.removed_patches += marked;
  add_event(t, TPA_EVENT_REMOVAL, vertices, TPA_NONE, TPA_NONE, {});
}

// Voids whose bodies are gone.
void drop_voids(Transaction& t, Components& parts) {
  Workspace& w = t.w;
  if (choose_voids(w.edit.mesh, parts) && find_swallowed(t, parts) > 0)
    drop_marked(t, parts, keep_wanted_voids(w.edit, t.meter(), w.before, parts));
}

}  // namespace

void drop_back_to_back(Transaction& t) {
  if (t.w.context.known_clean) return;
  know_components(t.w);
  const u32 count = remove_back_to_back(t.w.edit);
  if (count == 0) return;
  t.changed = true;
  t.report.removed_patches += count;
  add_event(t, TPA_EVENT_REMOVAL, 3 * count, TPA_NONE, TPA_NONE, {});
}

void drop_swallowed(Transaction& t) {
  Workspace& w = t.w;
  const Mesh& m = w.edit.mesh;
  if (!t.changed) know_components(w);
  if (t.is_step() && is_seen_clean(t)) return;
  const JudgeWhat what = !t.is_step() ? JudgeWhat::all : t.changed ? JudgeWhat::changed : JudgeWhat::moved;
  spend(t.meter(), t.changed ? 2 * u64{m.face_count} : m.face_count / 2);
  if (has_stopped(t.meter())) return;
  Components& parts = t.changed ? w.after : w.before;
  if (t.changed) find_components(m, w.after, w.work_vertices.data);
  const bool any = choose_judged(w.edit, what, parts);
  if (any && !t.is_step()) keep_unresolved(t, parts);
  if (any) drop_marked(t, parts, find_swallowed(t, parts));
  if (t.is_step() && t.changed) drop_voids(t, parts);
  if (t.changed)
    for (Component& part : w.before.list) part.volume.doubt = unknown_volume;
}

}  // namespace tpa
