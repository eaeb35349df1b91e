// SPDX-License-Identifier: MIT
// attempt: a transaction tries to make the moved mesh clean, that is free of contacts, attempt by attempt
// (docs/architecture.md). A failed attempt is rolled back as a whole. After the paper's way comes the exact cut; where
// even that leaves contacts, vertices stay at their old places, in a growing zone.
#pragma once

#include "mesh/region_change.h"
#include "step/context.h"
#include "step/issue.h"
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

// ---------------------------------------------------------------- marks of vertices

// The mark of a vertex holds two states side by side. First the target: already reached; taken by this attempt; or
// refused, since the vertex is frozen. Vertices without a target have 0. set_target() writes target_reached, and
// each attempt overwrites it.
inline constexpr u8 target_reached = 1, target_taken = 2, target_refused = 3, target_state = 3;
// Second: a frozen vertex keeps its old position for the rest of the step. A newly frozen vertex has neighbours still
// to be frozen (grow_frozen()).
inline constexpr u8 free_vertex = 0, frozen_vertex = 4, newly_frozen = 8, frozen_state = 12;

inline u8 state_of(const Workspace& w, u32 v, u8 state) { return w.marks[v] & state; }
inline void set_state(Workspace& w, u32 v, u8 state, u8 value) {
  w.marks[v] = static_cast<u8>((w.marks[v] & ~state) | value);
}

// Where an old vertex was after the move, before the first change of an attempt: at its target, unless it stayed
// behind.
inline const Vec3& moved_position(const Workspace& w, u32 v) {
  return state_of(w, v, target_state) == target_taken ? w.target[v] : old_position(w.edit, v);
}

inline void set_target(Workspace& w, u32 v, const Vec3& p) {
  w.target[v] = p;
  w.context.target_count += w.targets.add(v) ? 1u : 0u;
  w.marks[v] = target_reached;
}

// ---------------------------------------------------------------- the attempts of a transaction

enum class Strategy : u8 {
  // As in the paper: every vertex of a face in contact goes, and handles and caps close the loops. Blocked where a
  // contact is not small (cut/small_contact.h), or the region would change too much (step/region_check.h). Only the
  // cuts differ: if the loops stay simple, cuts run along vertices outside, without local refinement (cut/snap_cuts.h).
  paper,
  // The exact cut (docs/exact-cut.md).
  cut,
  // Nothing is resolved: in a step all vertices are frozen, in tpa_adapt all contacts stay.
  leave
};

inline constexpr u32 whole_mesh = none;
struct AttemptRule {
  Strategy strategy;
  u32 frozen_rings;  // rings of neighbours, or whole_mesh, that freeze with the vertices frozen by the attempt
};
inline constexpr AttemptRule step_attempts[] = {
    {Strategy::paper, 1}, {Strategy::cut, 1},  {Strategy::cut, 2},  {Strategy::cut, 4},          {Strategy::cut, 8},
    {Strategy::cut, 16},  {Strategy::cut, 32}, {Strategy::cut, 64}, {Strategy::cut, whole_mesh}, {Strategy::leave, 0}};
inline constexpr AttemptRule adapt_attempts[] = {{Strategy::cut, 0}, {Strategy::leave, 0}};
inline constexpr AttemptRule rule_of(Mode mode, u32 number) {
  return mode == Mode::step ? step_attempts[number] : adapt_attempts[number];
}
inline constexpr u32 last_attempt(Mode mode) {
  return static_cast<u32>(mode == Mode::step ? sizeof step_attempts : sizeof adapt_attempts) / sizeof(AttemptRule) - 1;
}

// Blocked: a piece stays open, or contacts stay. Doubtful: an untested candidate may be the cause of a contact or of an
// open piece. Excess: the exact cut wants more than the call may use. Limit: a limit of the config is reached, and the
// issue is filled in. Stopped: the meter has stopped.
enum class Outcome : u8 { clean, blocked, doubtful, excess, limit, stopped };

// ---------------------------------------------------------------- what a call may use (step/allowance.h)

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

// From the first wants of a call. Passes of an attempt want hardly more than its first; the exact cuts of further
// attempts of a step, with other vertices frozen, want up to five times as much.
constexpr u64 contacts_allowed(u64 first) { return 4 * first + 64; }
constexpr u64 cuts_allowed(u64 first) { return 2 * first + 64; }
constexpr u64 pieces_allowed(u64 first, Mode mode) { return (mode == Mode::step ? 4 : 2) * first + 64; }
// `old`: the slots in use before the call.
constexpr u64 slots_for_paper(u64 old, u64 first) { return old + 2 * (first - old) + 64; }
constexpr u64 slots_for_cut(u64 old, u64 first, Mode mode) {
  return old + (mode == Mode::step ? 8 : 2) * (first - old) + 64;
}

// State that outlasts the attempts of a call.
struct Transaction {
  Workspace& w;
  Mode mode;
  Extent extent;
  const Exec& exec;
  tpa_report& report;
  tpa_issue& issue;
  bool near_faces_stand = false;  // up to date, except for moved faces
  bool has_doubts = false;        // an untested candidate led to a doubtful outcome: test all candidates
  bool by_hash = false;           // passes find contacts by the vertex hash, and at last by complete detection
  // Has an attempt met a place without a solution? The first such place is `blocked_at`.
  bool blocked = false;
  Vec3 blocked_at = {};
  Allowance allowance = {};
};

struct Attempt {
  Transaction& t;
  Workspace& w;
  const u32 number;
  const AttemptRule rule;
  u64 events_lost = 0;  // events beyond the capacity
  RegionChange region;
  f64 room = 0;                    // the paper's way: for changes of the region (cut/small_contact.h)
  u32 moved = 0, refused = 0;      // vertices moved to their targets; vertices left behind
  f64 six_volumes_of_bodies = -1;  // at the end of the attempt; negative: not measured
  bool changed = false;            // faces or vertices have been made or removed
  bool parts_known = false;        // w.parts tells the fate of the components
  bool free_around = false;        // the faces round the last events meet nothing, as smoothing found
  bool trusts = false;             // an untested candidate has been placed
  bool hashed = false;             // a pass had the contacts of the vertex hash
  bool partial = false;            // so has this pass: complete detection has not been asked yet

  Attempt(Transaction& transaction, u32 of_number)
      : t(transaction), w(transaction.w), number(of_number), rule(rule_of(transaction.mode, of_number)) {}
  Attempt(const Attempt&) = delete;

  Meter* meter() const { return t.exec.meter; }
  bool is_step() const { return t.mode == Mode::step; }
  bool is_first() const { return number == 0; }
  bool as_in_the_paper() const { return rule.strategy == Strategy::paper; }

  // A mesh free of contacts stays so without a move.
  bool is_at_rest() const { return is_step() && moved == 0; }
  // Do so few vertices move that work for each of them costs less than one pass over the mesh?
  bool moves_few() const { return 16 * u64{moved} < w.edit.mesh.vertex_count; }
  i32 winding_at_infinity() const { return w.context.config.region == TPA_REGION_OUTSIDE ? 1 : 0; }

  // A trusted candidate may meet something before smoothing. Afterwards smoothing, and detect_again() at hubs, test all
  // of its faces.
  Candidates candidates() const { return !t.has_doubts ? Candidates::trusted : Candidates::tested; }
};

inline void note_blocked(Attempt& a, const Vec3& where) {
  if (!a.t.blocked) a.t.blocked_at = where;
  a.t.blocked = true;
}

inline void add_event(Attempt& a, i32 type, u32 amount, u32 before, u32 after, const Vec3& where) {
  Stack<tpa_event>& events = a.w.pending_events;
  if (!events.push({type, amount, before, after, {where.x, where.y, where.z}})) ++a.events_lost;
}

}  // namespace tpa
