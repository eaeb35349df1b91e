// cut_and_sew: carries the plan out on the mesh. Local refinement and removal (section 5, figure 6), then new faces
// across the holes. The near_faces follows every edit.
#pragma once

#include "cut/clusters.h"
#include "handles/words.h"
#include "mesh/journal.h"

namespace tpa {

// Cuts every edge of the kept loops, at the end that stays where it is drawn back to that, else in the middle of what
// is seen of it, joins the new vertices across their faces, and removes all vertices of the clusters with what hangs on
// them. The loops are then holes: cuts[i].vertex run round them, each once, and cuts[i].border is the half-edge of the
// rest between cuts[i + 1] and cuts[i]. False where vertices or faces run out.
bool cut(Edit& e, NearFaces& g, Clusters& r);

// Faces that are in mesh and near_faces but have no neighbours yet; `placed` collects their ids. Corners are places in
// `vertices`.
// False where faces run out; nothing is placed then.
bool place(Edit& e, NearFaces& g, Span<const u32> vertices, Span<const FaceCorners> faces, Stack<u32>& placed);
// Takes placed[from ..] out again.
void unplace(Edit& e, NearFaces& g, Stack<u32>& placed, u32 from);

// Sews placed faces to each other and to the borders of the holes. `table` has 6 * placed.size entries.
// borders[i] belongs to the edge from vertices[i] to the next vertex of its loop. O(faces) expected.
void sew(Edit& e, Span<const u32> placed, Span<const u32> borders, u32* table);

}  // namespace tpa
