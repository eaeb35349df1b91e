// SPDX-License-Identifier: MIT
// remesh: split, collapse, flip and relax towards a target edge length (Botsch & Kobbelt 2004). The paper names
// remeshing as future work (section 7); an inflating balloon needs it. Every operation is checked beforehand, so the
// mesh is free of contacts at any moment.
#pragma once

#include "edit/smooth.h"

namespace tpa {

struct RemeshOptions {
  u32 iterations;
  f64 split_length, collapse_length;
  f64 relaxation;
};

struct RemeshResult {
  u32 splits = 0, collapses = 0, flips = 0, relaxed = 0;
  bool out_of_vertices = false, out_of_faces = false;
  u64 wanted = 0;  // slots of these that are enough for the same call
};

// The slots that a call may use in later sweeps, from those in use after the splits of the first sweep. An evener mesh
// mostly needs less; further edges stay long.
constexpr u64 remesh_allowed(u64 first) { return first + first / 2 + 64; }

// Pre: the mesh is free of contacts, its faces are entered in `near`, and its components are measured. Volumes are
// followed, so no component is turned inside out; the smallest vertices of components may be gone afterwards. Stops
// early at a limit, and when the meter stops. `touched` is scratch for as many vertices as the mesh can have.
RemeshResult remesh(Edit& e, NearFaces& near, FaceTree& tree, Components& measured, const RemeshOptions& options,
                    const Exec& exec, Relocation& r, Stack<u32>& touched);

}  // namespace tpa
