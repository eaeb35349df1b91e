// smooth: moving vertices without touching anything. Taubin's smoothing (section 5, last paragraph), and the settling
// of any tentative move: what would meet something goes back.
#pragma once

#include "detect/detect_all.h"
#include "detect/near_faces.h"
#include "mesh/enclosed.h"
#include "mesh/journal.h"

namespace tpa {

// Scratch for tentative moves.
struct Relocation {
  Vec3* saved = nullptr;      // per vertex: where it was before the tentative move
  Vec3* wanted = nullptr;     // per vertex in hand: next position, while all still look at the old ones
  u8* vertex_mark = nullptr;  // per vertex; zero between calls
  u8* face_mark = nullptr;    // per face; zero between calls
  u8* star = nullptr;         // per vertex: proofs for detect(); zero between calls
  Stack<u32> faces;           // as many as the mesh can have, with memory for one more
  Stack<u32> vertices;        // as many as the mesh can have
  Detection* detection = nullptr;
};

// The vertices have been moved from saved[v] to where they are; the mesh with the saved positions was free of contacts,
// or what met there is left to later. Brings the near_faces up to date and puts back every moved vertex whose faces
// meet something, until none is left; and where `enclosed` is given, components that were measured, all vertices of one
// that may have been turned inside out. Returns how many kept their new position. O(faces round the vertices) expected.
u32 settle(Edit& e, NearFaces& g, Span<const u32> vertices, const Exec& exec, Relocation& r, Components* enclosed);

// The same for any part of the mesh: where many faces have changed, all are arranged anew in `clusters`, whose tree the
// near_faces watches from there on. r.saved must not lie in their memory. O(V).
u32 settle_many(Edit& e, NearFaces& g, FaceTree& clusters, Span<const u32> vertices, const Exec& exec, Relocation& r,
                Components* enclosed);

// Collects a face into r.faces, once, and marks it. Without a branch, so that one more is written than is counted.
inline void add_face(Relocation& r, u32 f) {
  r.faces.data[r.faces.size] = f;
  r.faces.size += r.face_mark[f] == 0 ? 1 : 0;
  r.face_mark[f] = 1;
}
// The faces round `vertices`, instead of those that are there.
void collect_faces(const Mesh& m, Span<const u32> vertices, Relocation& r);

// Contacts of r.faces (each once, marked in r.face_mark) with everything, into r.detection. Clears the marks.
void detect_around(const Mesh& m, const NearFaces& g, const Exec& exec, Relocation& r);

struct TaubinFactors {
  f64 lambda, mu;  // Taubin 1995: 0 < lambda < -mu
};

// Before a tentative move: notes in r.saved where the vertices are.
void save(const Mesh& m, Span<const u32> vertices, Relocation& r);

// After save(), and what else has moved the vertices since: `iterations` rounds of lambda and mu over them (each once),
// then settle(). Umbrella weights.
u32 smooth(Edit& e, NearFaces& g, Span<const u32> vertices, u32 iterations, TaubinFactors factors, const Exec& exec,
           Relocation& r, Components* enclosed);

}  // namespace tpa
