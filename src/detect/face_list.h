// face_list: some faces, numbered in the order in which they were added, and found by face in an open hash.
#pragma once

#include <string.h>

#include "base/base.h"

namespace tpa {

struct FaceListShape {
  u32 count = 0, places = 0;  // places: a power of two, more than the count; soon found where twice as many
};
struct FaceList : FaceListShape {
  u32* face = nullptr;   // by number
  u32* place = nullptr;  // open addressing: number, or none
  u32 capacity = 0;      // as many faces; twice as many places
};

// Where the search for a face ends: at its number, or at an empty place. Knuth's multiplicative hashing (The Art of
// Computer Programming, 6.4): 2^32 over the golden ratio.
inline u32& place_of(const FaceList& list, u32 f) {
  u32 at = static_cast<u32>(u64{f * 2654435769u} * list.places >> 32);
  while (list.place[at] != none && list.face[list.place[at]] != f) at = (at + 1) & (list.places - 1);
  return list.place[at];
}
inline u32 number_of(const FaceList& list, u32 f) { return place_of(list, f); }

// Pre: there is room, and the face is not there yet.
inline u32 add(FaceList& list, u32 f) {
  list.face[list.count] = f;
  return place_of(list, f) = list.count++;
}

inline void set_places(FaceList& list, u32 places) {
  list.places = places;
  memset(list.place, 0xFF, static_cast<size_t>(places) * sizeof(u32));
  for (u32 i = 0; i < list.count; ++i) place_of(list, list.face[i]) = i;
}

}  // namespace tpa
