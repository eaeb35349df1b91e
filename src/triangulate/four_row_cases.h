// four_row_cases: cases of four polygons in a row in which no edge can occur twice (docs/handles.md).
//
// In a row A and B have two strips between them, the middle and the tail (triangulate/four_base.h), and an edge could
// be part of both. It would be a slit: A alone lies on its one side with D, and B alone with C, or the other way round.
// Say the former. Then C has no steps facing A, and D none facing B; the middle takes steps on B only, then steps on A
// only; the tail steps on A only, then steps on B only. So where C has steps facing both, nothing is asked; else the
// middle has some other turn; or D has steps facing the polygon in question; or it has none, and the tail has some
// other turn. Every handle is in one case, and the shortest in each is known without following any.
#pragma once

#include "triangulate/four_base.h"

namespace tpa {

// Which of A and B faces C. A slit needs C to face one of them only.
enum class FacingC : u8 { either, both, only_b, only_a };
enum class MiddleTurns : u8 { free, slit, other };

struct RowCase {
  FacingC c = FacingC::either;
  MiddleTurns middle = MiddleTurns::free;
  StripRule tail = StripRule::any;
  u8 track = 0;  // A or B, and its steps that face D
  TrackSteps steps = TrackSteps::free;
};

// Less is asked than of any case, and slits are not kept out: a lower bound for all of them.
inline constexpr RowCase any_row{};

// A strip's rule is read from the base: the tail's path is read in reverse, x being B's.
inline constexpr RowCase row_cases[] = {
    {FacingC::both},
    {FacingC::only_b, MiddleTurns::other},
    {FacingC::only_b, MiddleTurns::slit, StripRule::any, 1, TrackSteps::some},
    {FacingC::only_b, MiddleTurns::slit, StripRule::y_before, 1, TrackSteps::zero},
    {FacingC::only_a, MiddleTurns::other},
    {FacingC::only_a, MiddleTurns::slit, StripRule::any, 0, TrackSteps::some},
    {FacingC::only_a, MiddleTurns::slit, StripRule::x_before, 0, TrackSteps::zero},
};

// The rules for a middle, and a tail, that end after so many steps.
StripRule middle_rule(const RowCase& row, const StripPaths& middle, u32 i, u32 j);
StripRule tail_rule(const RowCase& row, const StripPaths& tail, u32 i, u32 j);

// Sets the middle and the walk for a case. Pre: the base has been measured.
void link_row(const ShortLoops& loops, const ShortBase& base, const RowCase& row, BaseScratch& scratch);

}  // namespace tpa
