// SPDX-License-Identifier: MIT
// remesh: split, collapse, flip and relax towards a target edge length (Botsch & Kobbelt 2004). The paper names
// remeshing as future work (section 7); an inflating balloon needs it. Every operation is checked beforehand, so the
// mesh is free of contacts at any moment.
#pragma once

#include "edit/edge_aims.h"
#include "edit/smooth.h"
#include "edit/unsettled.h"

namespace tpa {

struct RemeshOptions {
  u32 iterations;
  EdgeAims aims;
  f64 relaxation;
  bool new_aims;  // other lengths than in the sweep that left the unsettled faces: all faces are looked at for length
  // Lengths differ from vertex to vertex, so nothing is known of them afterwards, and only these vertices are chosen:
  // of all faces, those round them are enough.
  bool only_part = false;
  Span<const u32> part = {};
};

struct RemeshResult {
  u32 splits = 0, collapses = 0, flips = 0;
  u64 relaxed = 0;  // vertices, anew in each sweep
  bool out_of_vertices = false, out_of_faces = false;
  u64 wanted = 0;      // slots of these that are enough for the same call
  u32 unfinished = 0;  // sweeps not made or not ended, as the meter stopped
};

// The slots that a call may use in later sweeps, from those in use after the splits of the first sweep. An evener mesh
// mostly needs less; further edges stay long.
constexpr u64 remesh_allowed(u64 first) { return first + first / 2 + 64; }

// Pre: the mesh is free of contacts, its faces are entered in `near`, its components are known. Only edges between
// chosen vertices are changed, new vertices are chosen, and only chosen vertices move. Volumes are followed, so no
// component is turned inside out; the smallest vertices of components may be gone afterwards. Stops early at a limit,
// and when the meter stops; a call that keeps what is done sets units aside to detect the contacts of all edited faces.
// `touched` is scratch for as many vertices as the mesh can have. `unsettled` tells faces before and after, in slots;
// at a limit it tells nothing.
RemeshResult remesh(Edit& e, NearFaces& near, FaceTree& tree, Components& components, Unsettled& unsettled,
                    const RemeshOptions& options, u8* chosen, const Exec& exec, Relocation& r, Stack<u32>& touched);

}  // namespace tpa
