// new_faces: faces that do not exist yet. Whoever rebuilds a part of the mesh asks about the faces that it would have
// before it makes them, so that the mesh is free of contacts at any moment.
#pragma once

#include "detect/cull_new_faces.h"
#include "detect/detect_moved.h"

namespace tpa {

// Largest star that an operation may touch or make; keeps the stack bounded. Ordinary valences are 5 to 7.
inline constexpr u32 largest_star = 48;

// Is the angle between two normals less than 60 degrees?
bool turns_little(const Vec3& before, const Vec3& after);

// What the surface is like where an operation takes place: which proof is worth trying.
enum class Expected : u8 {
  flat,  // as seen from somewhere, over an area as large as the operation's: detect/cull_new_faces.h
  bent   // as round an event, where that fails
};

// Do up to largest_star trial faces meet neither each other nor anything in the near faces but faces marked as going,
// or anything where `going` is nullptr? They are taken to lie close together, so one search serves all. Pre: where the
// surface is expected to be flat, `going` is given, and the mesh with the trial faces in place of those that go is
// closed.
bool trials_are_free(const Mesh& m, const NearFaces& g, const u8* going, const Trial* trials, u32 n, Expected expected);

}  // namespace tpa
