// remesh: split, collapse, flip and relax towards a target edge length (Botsch & Kobbelt 2004). The paper names this
// as future work (section 7); an inflating balloon needs it. Every operation is checked before it is done, so that the
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
};

// The mesh must be free of contacts and entered in the near_faces, and its components known and measured. These are
// followed, so that none is turned inside out; of their smallest vertices some may be gone afterwards. Stops early
// where a limit is met. `touched` is scratch for as many vertices as the mesh can have.
RemeshResult remesh(Edit& e, NearFaces& g, FaceTree& clusters, Components& enclosed, const RemeshOptions& options,
                    const Exec& exec, Relocation& r, Stack<u32>& touched);

}  // namespace tpa
