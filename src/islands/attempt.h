// SPDX-License-Identifier: MIT
// attempt: a transaction makes the moved mesh clean, that is free of contacts, island by island; each island takes
// attempt after attempt (docs/architecture.md). A failed attempt is taken back alone. After the paper's way comes the
// exact cut; where even that leaves contacts, vertices of the island are held back, in a growing zone.
#pragma once

#include "block/issue.h"
#include "block/marks.h"
#include "mesh/region_change.h"
#include "surgery/close_holes.h"

namespace tpa {

enum class Mode : u8 {
  step,  // vertices move to their targets from a mesh free of contacts, to a mesh free of contacts
  adapt  // the given mesh may be tangled; stubborn contacts stay
};

enum class Extent : u8 {
  whole,  // a call
  part    // a sub-step: its events follow those of the sub-steps before, without events of components
};

enum class Strategy : u8 {
  // As in the paper: every vertex of a face in contact goes, and handles and caps close the loops. Blocked where a
  // contact is not small (cut/small_contact.h), or the region would change too much (islands/ledger.h). Only the cuts
  // differ: if the loops stay simple, cuts run along vertices outside, without local refinement (cut/snap_cuts.h).
  paper,
  // The exact cut (docs/exact-cut.md).
  cut,
  // Nothing is resolved: in a step whole components are held back, in tpa_adapt the contacts stay.
  leave
};

inline constexpr u32 whole_components = none;
struct AttemptRule {
  Strategy strategy;
  u32 rings;  // of neighbours, or whole components, held back with the vertices in contact if the attempt fails
};
inline constexpr AttemptRule step_attempts[] = {{Strategy::paper, 0},
                                                {Strategy::cut, 1},
                                                {Strategy::cut, 2},
                                                {Strategy::cut, 4},
                                                {Strategy::cut, 8},
                                                {Strategy::cut, 16},
                                                {Strategy::cut, 32},
                                                {Strategy::cut, 64},
                                                {Strategy::cut, whole_components},
                                                {Strategy::leave, whole_components}};
inline constexpr AttemptRule adapt_attempts[] = {{Strategy::cut, 0}, {Strategy::leave, 0}};
inline constexpr AttemptRule rule_of(Mode mode, u32 number) {
  return mode == Mode::step ? step_attempts[number] : adapt_attempts[number];
}
inline constexpr u32 last_attempt(Mode mode) {
  return static_cast<u32>(mode == Mode::step ? sizeof step_attempts : sizeof adapt_attempts) / sizeof(AttemptRule) - 1;
}

// Loses: the paper's way would close a handle or tunnel. Blocked: a piece stays open, or contacts stay. Doubtful:
// an untested candidate may be the cause of a contact or of an open piece. Excess: the exact cut wants more than the
// island may use. Limit: a limit of the config is reached, and the issue is filled in. Stopped: the meter has stopped.
enum class Outcome : u8 { clean, loses, blocked, doubtful, excess, limit, stopped };

// Where the paper's way would close a handle or tunnel, an exact cut tells whether the region does: the cut stays
// if it makes and closes none, else the paper's way may close it (docs/exact-cut.md).
enum class LostHandle : u8 { stops, asks, passes };

// ---------------------------------------------------------------- what an island may use (islands/allowance.h)

inline constexpr u64 not_known = UINT64_MAX;

// Slots of the mesh.
struct ElementAllowance {
  u64 vertices = not_known, triangles = not_known;
};
struct Allowance {
  u64 contacts = not_known;  // of a detection
  u64 cuts = not_known;      // of a pass in the paper's way
  u64 pieces = not_known;    // of an exact cut
  ElementAllowance paper, cut;
};

// From the first wants of an island. Passes of an attempt want hardly more than its first; the exact cuts of further
// attempts of a step, with other vertices held back, want up to five times as much.
constexpr u64 contacts_allowed(u64 first) { return 4 * first + 64; }
constexpr u64 cuts_allowed(u64 first) { return 2 * first + 64; }
constexpr u64 pieces_allowed(u64 first, Mode mode) { return (mode == Mode::step ? 4 : 2) * first + 64; }
// `old`: the slots in use before the island.
constexpr u64 slots_for_paper(u64 old, u64 first) { return old + 2 * (first - old) + 64; }
constexpr u64 slots_for_cut(u64 old, u64 first, Mode mode) {
  return old + (mode == Mode::step ? 8 : 2) * (first - old) + 64;
}

// Are so few vertices moved that work for each of them costs less than one pass over the mesh? Decides cost only.
inline bool few_of(u64 vertices, const Mesh& m) { return 16 * vertices < m.vertex_count; }

// State of a call.
struct Transaction {
  Workspace& w;
  Mode mode;
  Extent extent;
  const Exec& exec;
  tpa_report& report;
  tpa_issue& issue;
  Stack<Island> islands;
  Stack<IslandContact> contacts;  // sorted by island
  BitSet held_back;               // vertices that the present island holds back
  FacesInContact met;             // at the beginning of the present attempt
  RegionChange region;            // of the islands done
  u32 moved = 0, refused = 0;     // vertices moved to their targets; vertices left behind
  u64 events_lost = 0;            // events beyond the capacity
  u64 edited_faces = 0;           // by the islands done
  u64 units_of_detection = 0;     // spent by the first one
  Slots slots = {};               // of the mesh before the present island
  Allowance allowance = {};       // of the present island
  bool has_doubts = false;        // in the present island a trusted candidate failed: test all candidates
  bool changed = false;           // faces or vertices have been made or removed
  bool parts_known = false;       // w.parts tells the fate of the components
  bool hurries = false;           // the budget has ended: islands that are not done are held back, or left
  // Of the present island.
  LostHandle lost_handle = LostHandle::stops;
  // Has an island met a place without a solution? The first such place is `blocked_at`.
  bool blocked = false;
  Vec3 blocked_at = {};

  Transaction(Workspace& of_call, Mode m, Extent x, const Exec& e, tpa_report& r, tpa_issue& i)
      : w(of_call),
        mode(m),
        extent(x),
        exec(e),
        report(r),
        issue(i),
        islands{table_data<Island>(w.context, table_islands), w.context.limits.contacts, 0},
        contacts{table_data<IslandContact>(w.context, table_island_contacts), w.context.limits.contacts, 0},
        held_back(open_bit_set(table_data<u32>(w.context, table_held_back), w.context.limits.vertices)),
        met{moved_mesh(w), open_bit_set(table_data<u32>(w.context, table_in_contact), w.context.limits.triangles),
            e.meter} {}
  Transaction(const Transaction&) = delete;

  Meter* meter() const { return exec.meter; }
  u64 units_of_commit() const {
    const Mesh& m = w.edit.mesh;
    const u64 of_moves = 1 + (moves_few() ? 8 * u64{moved} : m.vertex_count);
    return of_moves + (changed && !parts_known ? m.face_count : 0);
  }
  // With those behind the last sub-step (step/advance.h), and with a last detection in tpa_adapt.
  u64 units_to_end() const {
    const Mesh& m = w.edit.mesh;
    return units_of_commit() + (extent == Extent::part ? u64{m.vertex_count} + m.face_count : 0) +
           (is_step() ? 0 : units_of_detection);
  }
  bool is_step() const { return mode == Mode::step; }
  // A mesh free of contacts stays so without a move.
  bool is_at_rest() const { return is_step() && moved == 0; }
  bool moves_few() const { return few_of(moved, w.edit.mesh); }
  i32 winding_at_infinity() const { return w.context.config.region == TPA_REGION_OUTSIDE ? 1 : 0; }
};

// What an island may take from the region and put into it (islands/ledger.h), six times a volume.
struct Ledger {
  f64 bound = 0;
};

struct Attempt {
  Transaction& t;
  Workspace& w;
  const AttemptRule rule;
  Ledger ledger;
  RegionChange region;
  bool free_around = false;  // the faces round the last events meet nothing, as smoothing found
  bool trusts = false;       // an untested candidate has been placed

  Attempt(Transaction& transaction, u32 number, const Ledger& of_island)
      : t(transaction), w(transaction.w), rule(rule_of(transaction.mode, number)), ledger(of_island) {
    region.met = &t.met;
    region.reach = t.region.reach;  // the report tells the greatest, so searches for it go on from there
  }
  Attempt(const Attempt&) = delete;

  Meter* meter() const { return t.exec.meter; }
  bool is_step() const { return t.is_step(); }
  bool asks() const { return rule.strategy == Strategy::paper && t.lost_handle == LostHandle::asks; }
  bool as_in_the_paper() const { return rule.strategy == Strategy::paper && !asks(); }
  i32 winding_at_infinity() const { return t.winding_at_infinity(); }

  // A trusted candidate may meet something before smoothing. Afterwards smoothing, and detect_again() at hubs, test all
  // of its faces.
  Candidates candidates() const { return !t.has_doubts ? Candidates::trusted : Candidates::tested; }
  f64 left_in_ledger() const { return ledger.bound - region.volume(); }
  // A change is never taken back, so nothing that follows saves the attempt.
  bool is_overdrawn() const { return is_step() && left_in_ledger() < 0; }
};

inline void note_blocked(Transaction& t, const Vec3& where) {
  if (!t.blocked) t.blocked_at = where;
  t.blocked = true;
}

inline void add_event(Transaction& t, i32 type, u32 amount, u32 before, u32 after, const Vec3& where) {
  Stack<tpa_event>& events = t.w.pending_events;
  if (!events.push({type, amount, before, after, {where.x, where.y, where.z}})) ++t.events_lost;
}

}  // namespace tpa
