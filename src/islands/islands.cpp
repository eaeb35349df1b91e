// SPDX-License-Identifier: MIT
#include "islands/islands.h"

#include "base/disjoint_sets.h"
#include "islands/allowance.h"
#include "islands/close_and_cut.h"
#include "islands/contacts.h"
#include "islands/handles_made.h"
#include "islands/hold_back.h"
#include "islands/hurry.h"
#include "islands/ledger.h"
#include "islands/paper_way.h"

namespace tpa {

namespace {

Claims& claims_of(Transaction& t) { return t.w.edit.journal.claims; }

// ---------------------------------------------------------------- division

// Elements in contact belong to their island before it edits them, so that other islands notice when they meet it.
void own_contacts(Transaction& t, u32 island) {
  Claims& claims = claims_of(t);
  const Island& here = t.islands[island];
  for (const IslandContact& c : t.contacts.span().part(here.first, here.count))
    for_both(c, [&](u32 f) {
      claims.face_owner[f] = island;
      for (u32 i = 0; i < 3; ++i) claims.vertex_owner[old_corners(t.w.edit, f)[i]] = island;
    });
}

// Sorts the contacts by island, and notes the run of each island.
void arrange_islands(Transaction& t) {
  sort_in_place(t.contacts.data, t.contacts.size, [](const IslandContact& x, const IslandContact& y) {
    return x.island != y.island ? x.island < y.island : Contact{x.a, x.b} < Contact{y.a, y.b};
  });
  for (Island& island : t.islands) island.count = 0;
  for (u32 i = 0; i < t.contacts.size; ++i) {
    Island& island = t.islands[t.contacts[i].island];
    if (island.count++ == 0) island.first = i;
  }
}

// Islands are numbered in the order of their lowest faces.
void divide_contacts(Transaction& t) {
  Workspace& w = t.w;
  const Mesh& m = w.edit.mesh;
  Clusters& r = w.clusters;
  gather_clusters(m, w.detection.pairs.span(), r);
  form_groups(m, w.detection.pairs.span(), r);
  t.islands.clear();
  t.contacts.clear();
  for (u32 i = 0; i < r.groups; ++i) t.islands.push({});
  for (const Contact& c : w.detection.pairs) t.contacts.push({c.a, c.b, number_of_group(m, r, c)});
  forget_clusters(r);
  arrange_islands(t);
  for (u32 i = 0; i < t.islands.size; ++i) own_contacts(t, i);
}

// ---------------------------------------------------------------- taking back

void clear_claims(Claims& claims) {
  claims.vertices.cut_off(0);
  claims.faces.cut_off(0);
}

// Takes all claimed elements back to the moved mesh. Vertices held back keep their owner.
void take_back(Transaction& t, const Slots& before) {
  Workspace& w = t.w;
  Claims& claims = claims_of(t);
  note_elements_in_use(w);
  forget_clusters(w.clusters);
  remove_new(w.near_faces, w.edit, claims.faces);
  take_back_claims(w.edit, before, w.clusters.cluster);
  const u32 old_vertices = w.edit.journal.vertex_count, old_faces = w.edit.journal.face_count;
  u64 units = 0;
  for (u32 v : claims.vertices) {
    if (!t.held_back.contains(v)) claims.vertex_owner[v] = none;
    if (v < old_vertices) w.edit.mesh.position[v] = moved_position(w, v);
  }
  for (u32 f : claims.faces) {
    claims.face_owner[f] = none;
    if (f < old_faces) insert(w.near_faces, w.edit.mesh, f);
  }
  for (u32 v : claims.vertices) {
    if (v >= old_vertices) continue;
    for_each_outgoing(w.edit.mesh, v, [&](u32 h) {
      insert(w.near_faces, w.edit.mesh, face_of(h));
      ++units;
    });
  }
  spend(t.meter(), units);
  clear_claims(claims);
}

// ---------------------------------------------------------------- an attempt

// The contacts of the island as the move and the vertices held back leave them.
void find_contacts(Transaction& t, u32 island) {
  Workspace& w = t.w;
  Relocation& r = w.relocation;
  const Island& here = t.islands[island];
  const Span<const IslandContact> contacts = t.contacts.span().part(here.first, here.count);
  bool any_held = false;
  for (u32 v : t.held_back) any_held = any_held || claims_of(t).vertex_owner[v] == island;
  if (!any_held) {
    w.detection.pairs.clear();
    for (const IslandContact& c : contacts) w.detection.pairs.push({c.a, c.b});
    w.detection.found = contacts.size;
  } else {
    clear_faces(r);
    for (const IslandContact& c : contacts) {
      add_face(r, c.a);
      add_face(r, c.b);
    }
    for (u32 v : t.held_back)
      if (claims_of(t).vertex_owner[v] == island) add_faces(w.edit.mesh, v, r);
    detect_listed(t.w, t.exec);
  }
  note_met(t);
}

Outcome resolve(Attempt& a) {
  if (const Outcome o = check_contacts(a); o != Outcome::clean) return o;
  if (a.w.detection.pairs.empty()) return Outcome::clean;
  if (a.t.hurries) return Outcome::blocked;
  switch (a.rule.strategy) {
    case Strategy::paper: return a.asks() ? close_and_cut(a) : go_papers_way(a);
    case Strategy::cut: return close_and_cut(a);
    default: return Outcome::blocked;
  }
}

// What is put back with a failed attempt besides the mesh: counts of the report, and events.
struct Told {
  tpa_report report;
  u32 events;
  u64 events_lost;
};
Told told_by(const Transaction& t) { return {t.report, t.w.pending_events.size, t.events_lost}; }
void tell_again(Transaction& t, const Told& told) {
  t.report = told.report;
  t.w.pending_events.size = told.events;
  t.events_lost = told.events_lost;
}

enum class Ending : u8 { done, met, failed, limit, stopped };

void begin_island(Transaction& t, u32 island) {
  Claims& claims = claims_of(t);
  clear_claims(claims);
  claims.owner = island;
  claims.met = none;
  Journal& j = t.w.edit.journal;
  t.slots = slots_of(t.w.edit.mesh);
  j.resting_vertex = t.slots.free_vertex;
  j.resting_face = t.slots.free_face;
  t.allowance = {};
  t.lost_handle = LostHandle::stops;
  t.has_doubts = false;
}

void end_island(Transaction& t) {
  const Mesh& m = t.w.edit.mesh;
  Journal& j = t.w.edit.journal;
  j.claims.owner = j.resting_vertex = j.resting_face = none;
  allow_slots(t.w.edit, m.vertex_capacity, m.face_capacity);
}

// After a failed attempt: the island is as it was, but for more vertices held back. False if none is left to hold back.
bool give_way(Attempt& a, u32 island, Outcome outcome) {
  Transaction& t = a.t;
  Island& here = t.islands[island];
  const bool holds = a.is_step() && a.rule.strategy != Strategy::paper;
  if (holds) {
    // Where elements have run out, the faces in contact are gone.
    if (outcome == Outcome::excess) a.w.detection.pairs.clear();
    choose_at_contacts(a);
  }
  take_back(t, t.slots);
  own_contacts(t, island);
  if (a.asks() || outcome == Outcome::loses) {
    t.lost_handle = a.asks() ? LostHandle::passes : LostHandle::asks;
    return true;
  }
  if (outcome == Outcome::doubtful) {
    t.has_doubts = true;
    return true;
  }
  const u32 last = last_attempt(t.mode);
  if (holds) {
    if (t.w.work_vertices.empty()) choose_at_faces(t, t.contacts.span().part(here.first, here.count));
    note_blocked(t, t.w.edit.mesh.position[t.w.work_vertices[0]]);
    const u32 held = hold_back(t, outcome == Outcome::excess ? whole_components : a.rule.rings);
    if (held == 0 && here.attempt == last) return false;
  }
  here.attempt = outcome == Outcome::excess ? last : min_of(here.attempt + 1, last);
  return true;
}

// Has the present island edited elements of one that is done? Then only both together can be taken back, and that one
// is the island met.
bool has_edited_done(Transaction& t) {
  Claims& claims = claims_of(t);
  const auto look = [&](u32 owner) {
    if (owner != none && owner != claims.owner && t.islands[owner].is_done) claims.met = owner;
  };
  for (u32 v : claims.vertices) look(claims.vertex_owner[v]);
  for (u32 f : claims.faces) look(claims.face_owner[f]);
  return t.islands[claims.met].is_done;
}

// The island is as it was, so that the call may go on without it.
Ending stop_island(Transaction& t, u32 island, const Told& told) {
  tell_again(t, told);
  take_back(t, t.slots);
  own_contacts(t, island);
  end_island(t);
  return Ending::stopped;
}

Ending settle(Transaction& t, u32 island) {
  Island& here = t.islands[island];
  begin_island(t, island);
  find_contacts(t, island);
  here.is_unfinished = t.hurries && !t.w.detection.pairs.empty();
  const Ledger ledger = open_ledger(t);
  for (;;) {
    const Told told = told_by(t);
    Attempt a(t, here.attempt, ledger);
    allow_elements(a);
    const bool gives_up = !t.is_step() && a.rule.strategy == Strategy::leave;
    const Outcome outcome = gives_up ? Outcome::clean : resolve(a);
    if (has_stopped(t.meter())) return stop_island(t, island, told);
    if (outcome == Outcome::limit) return Ending::limit;
    if (claims_of(t).met != none) {
      tell_again(t, told);
      if (has_edited_done(t)) return Ending::met;
      take_back(t, t.slots);
      own_contacts(t, island);
      return Ending::met;
    }
    if (outcome == Outcome::clean) {
      t.region.add(a.region);
      here.is_done = true;
      note_edited(t);
      if (t.is_step() && t.islands.size > 1) note_joins(t);
      return Ending::done;
    }
    tell_again(t, told);
    if (!give_way(a, island, outcome)) return Ending::failed;
    if (claims_of(t).met != none) return Ending::met;
    find_contacts(t, island);
  }
}

// ---------------------------------------------------------------- islands that meet

// Before the first island.
struct Start {
  Slots slots;
  Told told;
};

// All edits of all islands go back, to be done again; what is known of each island stays.
void begin_again(Transaction& t, const Start& start) {
  const Journal& j = t.w.edit.journal;
  Claims& claims = claims_of(t);
  for (u32 v : j.vertices)
    if (claims.vertex_owner[v] != none) claims.vertices.add(v);
  for (u32 f : j.faces)
    if (claims.face_owner[f] != none) claims.faces.add(f);
  take_back(t, start.slots);
  tell_again(t, start.told);
  t.region = {};
  forget_joins(t.w.before);
  for (u32 i = 0; i < t.islands.size; ++i) {
    t.islands[i].is_done = false;
    own_contacts(t, i);
  }
}

u32 island_of(const Transaction& t, u32 i) {
  while (t.islands.data[i].joined != none) i = t.islands.data[i].joined;
  return i;
}

// Makes one island of two, the lower. Its attempts go on from the later of both.
void join_islands(Transaction& t, u32 i, u32 k) {
  const u32 stays = min_of(i, k), goes = max_of(i, k);
  t.islands[stays].attempt = max_of(t.islands[stays].attempt, t.islands[goes].attempt);
  t.islands[goes].joined = stays;
  for (IslandContact& c : t.contacts)
    if (c.island == goes) c.island = stays;
  for (u32 v : t.held_back)
    if (claims_of(t).vertex_owner[v] == goes) claims_of(t).vertex_owner[v] = stays;
  arrange_islands(t);
  own_contacts(t, stays);
}

// Island i has edited an element of another one. If that one is done, both begin again.
void meet(Transaction& t, u32 i, const Start& start) {
  const u32 k = island_of(t, claims_of(t).met);
  claims_of(t).met = none;
  const bool was_done = t.islands[k].is_done;
  end_island(t);
  join_islands(t, i, k);
  if (was_done) begin_again(t, start);
}

// ---------------------------------------------------------------- the gate

// Lists and marks the faces that any island has edited or bent, and those that were in contact.
void list_edited(Transaction& t) {
  Workspace& w = t.w;
  const Edit& e = w.edit;
  const Mesh& m = e.mesh;
  const Claims& claims = claims_of(t);
  Relocation& r = w.relocation;
  clear_faces(r);
  for (u32 f : e.journal.faces)
    if (claims.face_owner[f] != none && f < m.face_count && face_lives(m, f)) add_face(r, f);
  for (u32 v : e.journal.vertices)
    if (claims.vertex_owner[v] != none && v < m.vertex_count && vertex_lives(m, v)) add_faces(m, v, r);
  for (const IslandContact& c : t.contacts)
    for_both(c, [&](u32 f) {
      if (face_lives(m, f)) add_face(r, f);
    });
}

// The island of a face, or of a corner.
u32 owner_of(const Transaction& t, u32 f) {
  const Claims& claims = t.w.edit.journal.claims;
  u32 owner = claims.face_owner[f];
  for (u32 i = 0; i < 3 && owner == none; ++i) owner = claims.vertex_owner[t.w.edit.mesh.corner[3 * f + i]];
  return owner == none ? none : island_of(t, owner);
}

// Do the results meet nothing? No operation on the way is believed. Islands whose results meet become one, and the next
// attempt of each island with a contact begins from the moved mesh.
bool pass_gate(Transaction& t, const Start& start) {
  list_edited(t);
  detect_listed(t.w, t.exec);
  if (t.w.detection.found == 0 || has_stopped(t.meter())) return true;
  bool any = false;
  for (const Contact& c : t.w.detection.pairs) {
    const u32 i = owner_of(t, c.a), k = owner_of(t, c.b);
    if (i == none && k == none) continue;
    const u32 lower = min_of(i, k);
    Island& island = t.islands[lower];
    if (!t.is_step() && island.attempt == last_attempt(t.mode)) continue;
    if (island.is_done) island.attempt = min_of(island.attempt + 1, last_attempt(t.mode));
    island.is_done = false;
    if (i != none && k != none && i != k) join_islands(t, i, k);
    any = true;
  }
  if (any) begin_again(t, start);
  return !any;
}

Outcome settle_all(Transaction& t, const Start& start) {
  for (u32 i = 0; i < t.islands.size;) {
    const Island& island = t.islands[i];
    if (island.is_done || island.joined != none) {
      ++i;
      continue;
    }
    switch (settle(t, i)) {
      case Ending::limit: return Outcome::limit;
      case Ending::stopped: return Outcome::stopped;
      case Ending::failed: return Outcome::blocked;
      case Ending::met:
        meet(t, i, start);
        i = 0;
        break;
      default: end_island(t);
    }
  }
  return Outcome::clean;
}

}  // namespace

Outcome settle_islands(Transaction& t) {
  if (t.w.detection.pairs.empty()) return Outcome::clean;
  know_components(t.w);
  t.changed = true;
  if (t.is_step()) know_volumes(t);
  forget_joins(t.w.before);
  divide_contacts(t);
  const Start start{slots_of(t.w.edit.mesh), told_by(t)};
  for (;;) {
    set_end_aside(t);
    const Outcome outcome = settle_all(t, start);
    if (outcome == Outcome::stopped && begin_to_hurry(t)) continue;
    if (outcome != Outcome::clean) return outcome;
    set_commit_aside(t);
    if (pass_gate(t, start)) break;
  }
  t.report.unfinished = count_unfinished(t);
  return has_stopped(t.meter()) ? Outcome::stopped : Outcome::clean;
}

void forget_islands(Transaction& t) {
  const Journal& j = t.w.edit.journal;
  Claims& claims = claims_of(t);
  for (u32 v : j.vertices) claims.vertex_owner[v] = none;
  for (u32 f : j.faces) claims.face_owner[f] = none;
  for (const IslandContact& c : t.contacts)
    for_both(c, [&](u32 f) {
      claims.face_owner[f] = none;
      for (u32 i = 0; i < 3; ++i) claims.vertex_owner[old_corners(t.w.edit, f)[i]] = none;
    });
  clear_claims(claims);
  claims.owner = claims.met = none;
  t.held_back.cut_off(0);
  t.met.clear();
  end_island(t);
}

}  // namespace tpa
