// advancing_front: closing loops face by face, each of which meets nothing when it is placed. Where loops are long or
// many, whole handles in order of length that meet nothing are too rare to be come upon.
#pragma once

#include "triangulate/candidates.h"

namespace tpa {

u64 zip_scratch_bytes(u64 vertices);

struct FacePlacer {
  // Places a face if it meets nothing that is there, and says whether it did.
  bool (*place)(void* caller, const FaceCorners& face);
  // Takes one away again, by its number among those that are placed; the last one then has its number.
  void (*take_back)(void* caller, u32 number);
  void* caller;
};

// How many handles what closes loops may have itself.
enum class Genus : u8 {
  zero,  // none: with a cap on each loop it is a sphere, as the handles of section 4 are
  any
};

// Which loops close first?
enum class Along : u8 {
  others,  // loops that run along each other
  all      // and one that runs along itself: so it does in the creases of a sheet that folds onto itself
};

// Several loops are first joined to one polygon by single faces over a loop's edge and a vertex of another loop,
// shortest first. Then faces over an edge of a polygon and another of its vertices, shortest first, part it into
// smaller ones, until all are closed: first those that lie on its open side between different loops, or, with
// Along::all, between parts of one that are near each other but not along it. So loops close wherever they run along
// each other, before the wider places where several meet. Where two polygons that hang together go round along each
// other, as they do where a tunnel is to be left between two bodies, a ring of faces joins them, if any genus will do
// and it has less area than two discs. Where no face is free, those round what is left are taken back, and others
// tried. Corners as in FaceCorners. The points of the loops lie one after another in one array. False where some hole
// is left; faces have been placed then all the same, and `open`, of as many elements as there are vertices, has those
// of the holes, each once; none where the loops could not be joined. As a rule O(vertices log vertices) and O(vertices)
// questions, and so again for what is open after each opening, of which there are at most 63; O(vertices^2) at most for
// each.
bool zip(Span<const Loop> loops, Span<u8> scratch, Genus genus, Along along, const FacePlacer& placer,
         Stack<u32>& open);

}  // namespace tpa
