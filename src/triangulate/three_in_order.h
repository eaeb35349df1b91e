// three_in_order: the handles of least total edge length between three polygons, in order (docs/handles.md).
//
// For each base (triangulate/three_bounds.h), the first inner triangle is chosen where the lower bound of all handles
// with both is short enough; then the two strips that go round C from there are measured exactly, with all that the
// second triangle can be; then the strips themselves are followed, step by step, as far as they can be among the best.
// This is done with a low limit first, which is raised until enough handles have been found below it.
#pragma once

#include "triangulate/three_strips.h"

namespace tpa {

// Bytes of scratch for loops of so many vertices, the longest and all together; aligned for f64.
u64 three_scratch_bytes(u32 longest, u32 vertices);

// Fills `best` with the shortest handles in order of length, ties in the order of the search; returns their number.
// Handles longer than `limit` are not looked for. `complete` tells whether the search came to its end before `work` was
// done (a unit takes about .05 microseconds): else what it found are handles, but there may be shorter ones. Where the
// work would not suffice for the bounds, the search does not begin.
// Pre: three loops of at least three vertices, most_three_vertices together, `best` not empty.
u32 shortest_of_three(const ThreeLoops& loops, f64 limit, u64 work, u8* scratch, Span<ThreeHandle> best,
                      bool& complete);

}  // namespace tpa
