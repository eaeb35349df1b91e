// SPDX-License-Identifier: MIT
// separate: surfaces that lie upon each other but for rounding move apart before they are cut (Milenkovic & Sacks 2018:
// separate features first, then round). Exact seams of such surfaces would follow nothing but rounding errors.
#pragma once

#include "islands/attempt.h"

namespace tpa {

// Of faces in contact: the largest coordinate, and the shortest edge.
struct Scale {
  f64 largest = 0, shortest = no_way;
};
// O(contacts).
Scale scale_of_contacts(const Workspace& w);

// Room between surfaces, from the rounding of coordinates and the shortest edge: `flat` is the distance within which
// two faces in contact lie upon each other; `grid` the spacing to which vertices are moved, `outward` the way by which
// they move first; new vertices closer than `reach` merge.
struct Separation {
  f64 flat, grid, outward, reach;
};
// For the first cut (pass 0), and wider for each pass that finds contacts again. The scale is that of the contacts
// before the first cut: afterwards edges of the seams may be as short as rounding.
Separation separation_of(const Scale& scale, u32 pass);

// Lists in w.relocation.faces, unmarked, the faces of contacts that lie upon each other, without being in one plane.
// O(contacts).
void find_nearly_flat(Workspace& w, const Separation& s);

// Moves the vertices of w.relocation.faces outward, so that parts which touch join, then to the grid, so that surfaces
// which cross do so clearly. Detects the contacts of all
// faces in contact before or moved.
void separate(Attempt& a, const Separation& s);

}  // namespace tpa
