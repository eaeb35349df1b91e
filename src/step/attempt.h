// attempt: what one try of a transaction knows (docs/architecture.md). A try that cannot connect a piece is rolled back
// as a whole; the next one cuts more widely there, or leaves it alone.
#pragma once

#include "cut/coarse_faces.h"
#include "step/context.h"
#include "surgery/close_holes.h"

namespace tpa {

enum class Mode : u8 {
  step,  // vertices move to their targets from a mesh free of contacts; afterwards it is free of contacts
  adapt  // the mesh may be tangled; contacts that cannot be resolved stay
};

// The marks of a vertex: three states side by side.
// In the next step, where it has a target: it is there already; it goes there; it is frozen and stays behind. tpa_move
// says target_reached.
inline constexpr u8 target_reached = 1, target_taken = 2, target_refused = 3, target_state = 3;
// In a step: keeps its old position.
inline constexpr u8 free_vertex = 0, frozen_vertex = 4, newly_frozen = 8, frozen_state = 12;
// What the next attempt does with it, if anything: as cut/clusters.h says.
inline constexpr u8 next_time_state = taken_along | left_coarse;

inline u8 state_of(const Workspace& w, u32 v, u8 state) { return w.marks[v] & state; }
inline void set_state(Workspace& w, u32 v, u8 state, u8 value) {
  w.marks[v] = static_cast<u8>((w.marks[v] & ~state) | value);
}

// A piece that nothing closes is tried again without halved faces, then cut out more widely where a hole was left, ring
// by ring; after this many attempts its loops are capped. Where that does not fit either, it is rolled back, or stays
// tangled (adapt).
inline constexpr u32 widening_attempts = 3;

// Faces of components that would vanish are halved so often before a pass: by then they are 16 times as many along the
// way of a contact, and 256 times over a surface. For the sake of single vertices (adapt) only to halve the edges:
// finer rims have more folds, and handles are harder to find.
inline constexpr u32 most_halvings = 8;
inline constexpr u32 most_careful_halvings = 2;
// For the sake of what is round a hub (step): then what is in contact of a face is a sixteenth of its length.
inline constexpr u32 most_bulk_halvings = 4;

// A pass of adapt that has to leave something tangled makes work for the next; as often as this.
inline constexpr u32 most_forced_passes = 8;

// Doubtful: what was not tested may be why something meets, or cannot be done.
enum class Outcome { clean, blocked, doubtful, limit };

struct Attempt {
  Workspace& w;
  u32 number;
  Mode mode;
  const Exec& exec;
  tpa_report& report;
  tpa_issue& issue;
  u64 events_lost = 0;
  u32 halvings = 0;
  u32 forced_passes = 0;
  u32 moved = 0, refused = 0;     // vertices that went to their targets, and that were to stay
  bool near_faces_stand = false;  // the near_faces holds the faces as they are, but for those that moved
  bool halved = false;
  bool tangled = false;      // adapt: some contacts are left
  bool changed = false;      // the mesh is not what it was but for positions
  bool parts_known = false;  // what became of components is in w.parts
  bool free_around = false;  // smoothing has found that the faces round the last events meet nothing
  bool spares_hubs = true;   // in all attempts: may faces be halved for that, in a step?
  bool trusts = false;       // a candidate was placed that was not tested
  bool has_doubts = false;   // in all attempts: then something met, or a piece could not be closed
  // In all attempts: some vertices had to be frozen, the first ones for what met here.
  bool blocked = false;
  Vec3 blocked_at = {};

  // A mesh that was free of contacts and has not moved still is.
  bool is_at_rest() const { return mode == Mode::step && moved == 0; }
  // What costs more for each vertex that moved than the same for all would for each vertex, is worth it for so few.
  bool moves_few() const { return 16 * u64{moved} < w.edit.mesh.vertex_count; }
  Care care() const {
    if (mode == Mode::step) return spares_hubs && halvings < most_bulk_halvings ? Care::bulk : Care::components;
    return halvings < most_careful_halvings ? Care::boundary : Care::components;
  }
  i32 winding_at_infinity() const { return w.context.config.region == TPA_REGION_OUTSIDE ? 1 : 0; }
  bool is_last_resort() const { return number >= widening_attempts; }
  // What meets in a step meets in places, and is joined by handles as in the paper; seams of a tangle may run round
  // tunnels.
  Genus genus() const { return mode == Mode::adapt ? Genus::any : Genus::zero; }
  Otherwise otherwise() const {
    if (as_in_the_paper()) return Otherwise::cut_less;
    if (!is_last_resort()) return Otherwise::give_up;
    return mode == Mode::adapt ? Otherwise::cap_anyhow : Otherwise::cap;
  }
  // Whether faces of a candidate meet something before smoothing does not matter: all of them are looked at afterwards,
  // when what was smoothed settles, or in detect_again() where it has corners that are hubs.
  Candidates candidates() const { return as_in_the_paper() && !has_doubts ? Candidates::trusted : Candidates::tested; }
  // A step does first as the paper does: all that meets is joined at once, and all vertices of faces in contact go. But
  // its cuts are drawn back, which leaves what the paper's refinement leaves once it has been taken back.
  // Else components that collide are united one after another, so that pieces have fewer loops, most of them two; and
  // what is seen of the faces may stay. Where a crease comes near another one, too much would go otherwise.
  bool as_in_the_paper() const { return mode == Mode::step && number == 0; }
};

inline void note_blocked(Attempt& a, const Vec3& where) {
  if (!a.blocked) a.blocked_at = where;
  a.blocked = true;
}

inline void add_event(Attempt& a, i32 type, u32 amount, u32 before, u32 after, const Vec3& where) {
  Stack<tpa_event>& events = a.w.pending_events;
  if (!events.push({type, amount, before, after, {where.x, where.y, where.z}})) ++a.events_lost;
}

// Fills an issue and returns its status.
inline tpa_status fail_limit(tpa_issue& issue, i32 limit, u64 needed, u64 available) {
  issue = {};
  issue.status = TPA_E_LIMIT;
  issue.limit = limit;
  issue.needed = needed;
  issue.available = available;
  return TPA_E_LIMIT;
}

}  // namespace tpa
