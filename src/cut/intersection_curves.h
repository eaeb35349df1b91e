// intersection_curves: where two sheets of the surface cross, the boundary of the region passes from the one to the
// other, along a seam. Which loops does the boundary connect, across all sheets and seams of a contact group? Section 2
// calls this "analysing the positions of the vertices"; a tube pushed through a thin plate is to be joined to it on
// both sides, and not all four loops at once.
//
// A sheet is what hangs together of the clusters along edges that nothing pierces. A piercing is a point where an edge
// of one sheet passes through a face of another: along the edge the winding number changes by one there. The piece of
// the edge with winding number 0 on its outer side is part of the boundary, and so are the piercings at its ends.
// Sheets and piercings of the boundary that touch each other are of one piece.
#pragma once

#include "cut/neck.h"

namespace tpa {

struct Piercing {
  f64 along;  // place on the edge, 0 at its tail; rounded, since it only orders the piercings of one edge
  u32 edge;   // the lower one of the two half-edges
  u32 face;
  u32 parent;  // in the union-find of pieces
  i8 turn;     // +1 where the edge, from its tail, enters the solid of the face; -1 where it leaves it
  bool kept;   // part of the boundary
};

// Stands for a winding number that no ray told.
inline constexpr i8 unknown_winding = 127;

struct SeamScratch {
  u32* sheet = nullptr;       // per vertex: parent in the union-find of sheets
  u32* piece = nullptr;       // per vertex: parent in the union-find of pieces
  i8* winding = nullptr;      // per vertex: on the outer side of its sheet, or unknown_winding
  Stack<Piercing> piercings;  // as many as contacts
  u32* crossing = nullptr;    // one for each two faces that cross, in an open hash: twice as many as contacts
  NeckScratch neck;
};

// After form_groups(): orders the loops of each group by the piece that they bound, and fills r.pieces. The loops of
// one cluster that no other takes part with come apart where what they run round is pinched: a neck is cut, a hole is
// filled (nested objects and pinched necks, section 5). They stay together where there are only folds. Expected O(size
// of the clusters + contacts log contacts), and part_legs() for each such cluster with several loops.
void find_pieces(const Mesh& m, const NearFaces& g, i32 winding_at_infinity, Span<const Contact> contacts, Clusters& r,
                 SeamScratch& s);

// After find_pieces(): does an edge of one of the faces pass through the other?
bool faces_cross(const Mesh& m, const SeamScratch& s, u32 f, u32 g);

}  // namespace tpa
