// neck: a ring of the surface that meets itself runs round a neck of the body, or round a hole through it. Section 5
// cuts a neck and fills a hole where "opposite" walls meet; where a crease round a neck only folds over, the neck must
// stay. The winding number along the axis tells.
#pragma once

#include "region.h"

namespace tpa {

// Of the two loops that bound a ring: does the axis, from the middle of one of them to the middle of both, leave what
// is in the loop there? That is the body where the surface by the loop faces away from the loop's own axis, and space
// where it faces inward. Loops whose middle lies on the wrong side already say nothing. Of more loops there is no axis:
// the way from one leg to another leaves a body that is whole. O(cuts + faces near the axis, and as much for each of
// these that the axis crosses).
bool is_pinched(const Mesh& m, const Grid& g, i32 winding_at_infinity, const Regions& r, Span<const CutLoop> loops);

}  // namespace tpa
