// SPDX-License-Identifier: MIT
#include "islands/allowance.h"

namespace tpa {

namespace {

// The paper's way gives way to the exact cut, and the exact cut to no change.
Outcome given_up(const Attempt& a) { return a.as_in_the_paper() ? Outcome::blocked : Outcome::excess; }

ElementAllowance& allowance_of_way(Attempt& a) { return a.as_in_the_paper() ? a.t.allowance.paper : a.t.allowance.cut; }

Outcome out_of(Attempt& a, i32 limit, Measure what, u64 allowed, u64 available) {
  if (allowed > available) {
    fail_limit(a.t.issue, limit, allowed, available);
    return Outcome::limit;
  }
  note_peak(a.w.context, what, allowed);
  return given_up(a);
}

}  // namespace

Outcome check_amount(Attempt& a, i32 limit, u64 wanted, u64 allowed, u64 available) {
  if (wanted > allowed) return given_up(a);
  note_peak(a.w.context, static_cast<Measure>(limit), wanted);
  if (wanted <= available) return Outcome::clean;
  fail_limit(a.t.issue, limit, allowed == not_known ? wanted : allowed, available);
  return Outcome::limit;
}

void allow_elements(Attempt& a) {
  const ElementAllowance& allowed = allowance_of_way(a);
  allow_slots(a.w.edit, allowed.vertices, allowed.triangles);
}

void note_elements(Attempt& a, u64 vertices, u64 triangles) {
  ElementAllowance& allowed = allowance_of_way(a);
  const auto slots = [&](u64 old, u64 first) {
    return a.as_in_the_paper() ? slots_for_paper(old, first) : slots_for_cut(old, first, a.t.mode);
  };
  if (allowed.vertices == not_known) allowed.vertices = slots(a.t.slots.vertices, vertices);
  if (allowed.triangles == not_known) allowed.triangles = slots(a.t.slots.faces, triangles);
  allow_elements(a);
}

Outcome out_of_vertices(Attempt& a) {
  return out_of(a, TPA_LIMIT_VERTICES, Measure::vertices, allowance_of_way(a).vertices, a.w.context.limits.vertices);
}

Outcome out_of_triangles(Attempt& a) {
  return out_of(a, TPA_LIMIT_TRIANGLES, Measure::triangles, allowance_of_way(a).triangles,
                a.w.context.limits.triangles);
}

Outcome out_of_pieces(Attempt& a, u64 enough) {
  return out_of(a, TPA_LIMIT_PIECES, Measure::pieces, enough, a.w.context.limits.pieces);
}

}  // namespace tpa
