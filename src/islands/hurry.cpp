// SPDX-License-Identifier: MIT
#include "islands/hurry.h"

namespace tpa {

namespace {

// Faces round the vertices that are held back with a contact, on the average of islands of a few to a hundred contacts,
// which try one to four rings.
constexpr u64 faces_of_contact = 24;

}  // namespace

void set_commit_aside(Transaction& t) { set_aside(t.meter(), t.units_to_end()); }

void set_end_aside(Transaction& t) {
  if (t.hurries) return set_commit_aside(t);
  // Holding back enters and detects faces round the contacts, and the gate detects these and all edited ones again.
  const Mesh& m = t.w.edit.mesh;
  const u64 held = faces_of_contact * t.contacts.size;
  set_aside(t.meter(), t.units_to_end() + units_to_detect(m, held) + units_to_detect(m, held + t.edited_faces));
}

void note_edited(Transaction& t) {
  if (!keeps_done(t.meter())) return;
  for ([[maybe_unused]] u32 f : t.w.edit.journal.claims.faces) ++t.edited_faces;
  set_end_aside(t);
}

bool begin_to_hurry(Transaction& t) {
  if (!keeps_done(t.meter()) || t.hurries || t.meter()->stop != Stop::budget) return false;
  t.hurries = true;
  set_commit_aside(t);
  return !has_stopped(t.meter());
}

u32 count_unfinished(const Transaction& t) {
  u32 count = 0;
  for (const Island& island : t.islands) count += island.is_unfinished && island.joined == none ? 1u : 0u;
  return count;
}

}  // namespace tpa
