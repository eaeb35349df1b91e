// SPDX-License-Identifier: MIT
// smooth: moving vertices without touching anything. Taubin's smoothing (section 5, last paragraph), and settling after
// any tentative move: vertices whose faces meet something go back.
#pragma once

#include "detect/detect_all.h"
#include "detect/near_faces.h"
#include "mesh/component_volumes.h"
#include "mesh/journal.h"

namespace tpa {

// Scratch for tentative moves.
struct Relocation {
  Vec3* saved = nullptr;      // per vertex: its position before the tentative move
  Vec3* wanted = nullptr;     // per listed vertex: its next position, while neighbours still look at the old one
  u8* vertex_mark = nullptr;  // per vertex; zero between calls
  u8* face_mark = nullptr;    // per face; zero between calls
  u8* star = nullptr;         // per vertex: proofs for detect(); zero between calls
  TaskRooms rooms;            // of detection
  Stack<u32> faces;           // room for all of the mesh, and memory for one more
  u64 hub_pairs = 0;          // of faces at hubs among `faces`, as far as they cost time
  Stack<u32> vertices;        // room for all of the mesh
  Detection* detection = nullptr;
};

// Before a tentative move: saves the positions of the vertices.
void save(const Mesh& m, Span<const u32> vertices, Relocation& r);

// After a tentative move of `vertices` from their saved positions. Pre: with these the mesh was free of contacts, or
// somebody looks at its contacts later. Enters the faces anew, and puts back every moved vertex with a face in contact,
// until no contact is left. If `measured` is given, components with known volumes, it also puts back all vertices of
// components that may be inside out. Returns how many vertices kept their new position. If many faces have changed,
// arranges all of them anew in `tree`, which `near` watches from then on; r.saved must not lie in the memory of the
// tree. If the meter stops, contacts may be left. O(V).
u32 settle_many(Edit& e, NearFaces& near, FaceTree& tree, Span<const u32> vertices, const Exec& exec, Relocation& r,
                Components* measured);

// After a stop in settle_many(): puts all vertices back, so that no contact is left, and enters their faces again.
void put_all_back(Edit& e, NearFaces& near, Span<const u32> vertices, Relocation& r);

inline void clear_faces(Relocation& r) {
  r.faces.clear();
  r.hub_pairs = 0;
}
// Adds a face to r.faces, unless it is marked, and marks it. Writes first and counts then, without a branch.
inline void add_face(Relocation& r, u32 f) {
  r.faces.data[r.faces.size] = f;
  r.faces.size += r.face_mark[f] == 0 ? 1u : 0u;
  r.face_mark[f] = 1;
}
inline void clear_marks(Relocation& r) {
  for (u32 f : r.faces) r.face_mark[f] = 0;
}
// Adds the faces round a vertex. Boxes of many faces round a hub meet.
inline void add_faces(const Mesh& m, u32 v, Relocation& r) {
  constexpr u64 most_of_no_hub = 64, pairs_for_face = 32;  // pairs tested in the time of complete detection for a face
  u64 count = 0;
  for_each_outgoing(m, v, [&](u32 h) {
    add_face(r, face_of(h));
    ++count;
  });
  if (count > most_of_no_hub) r.hub_pairs += count * count / pairs_for_face;
}
// Complete detection takes a third to an eighth of the time for each face, but looks at all faces of the mesh.
inline bool are_many(const Mesh& m, u32 faces, u64 hub_pairs) { return 8 * u64{faces} + hub_pairs > m.face_count; }
// An estimate of the units to detect the contacts of so many faces: measured 3 to 12 for each, or 2.5 to 5 for each
// face of the mesh in complete detection, less in large meshes (docs/realtime.md).
inline u64 units_to_detect(const Mesh& m, u64 faces) {
  return 1024 + (8 * faces > m.face_count ? 2048 + 5 * u64{m.face_count} : 16 * faces);
}
// Makes r.faces the faces round `vertices`.
void collect_faces(const Mesh& m, Span<const u32> vertices, Relocation& r);

// The number of these faces; leaves no marks.
inline u32 count_faces(const Mesh& m, Span<const u32> vertices, Relocation& r) {
  collect_faces(m, vertices, r);
  clear_marks(r);
  return r.faces.size;
}

// Writes all contacts of r.faces (each once, marked in r.face_mark) to r.detection. Clears the marks.
void detect_around(const Mesh& m, const NearFaces& near, const Exec& exec, Relocation& r);

struct TaubinFactors {
  f64 lambda, mu;  // Taubin 1995: 0 < lambda < -mu
};

// `iterations` rounds of lambda and mu over the vertices (each once), with so many faces round them, with umbrella
// weights; fewer if the meter stops. Returns the number of rounds made.
u32 make_rounds(Edit& e, Span<const u32> vertices, u32 faces, u32 iterations, TaubinFactors factors, const Exec& exec,
                Relocation& r);

// After save(), and whatever else moved the vertices since: rounds, then settles as settle_many() does, but arranges
// nothing anew. Expected O(faces round the vertices), but O(n^2) in the faces round a hub.
u32 smooth(Edit& e, NearFaces& near, Span<const u32> vertices, u32 iterations, TaubinFactors factors, const Exec& exec,
           Relocation& r, Components* measured);

}  // namespace tpa
