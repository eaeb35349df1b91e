// detect_moved: the narrow phase of section 3. Which pairs of faces meet anywhere but in the vertex or edge that they
// share? Candidates come from the near faces; the answers are exact.
#pragma once

#include "base/parallel.h"
#include "detect/near_faces.h"
#include "geometry/predicates.h"

namespace tpa {

struct Contact {
  u32 a, b;  // faces, a < b
  friend constexpr bool operator<(Contact p, Contact q) { return p.key() < q.key(); }
  constexpr u64 key() const { return u64{a} << 32 | b; }
};

// Which corners of f are vertices of g: a bit for each. Without a branch: what faces share that are near each other is
// as good as random.
inline u32 shared_corners(const u32* f, const u32* g) {
#if defined(TPA_VECTORS)
  const auto all = [](u32 v) { return I4{} + static_cast<i32>(v); };
  const I4 of_f = {static_cast<i32>(f[0]), static_cast<i32>(f[1]), static_cast<i32>(f[2]), 0};
  return bits_of((of_f == all(g[0])) | (of_f == all(g[1])) | (of_f == all(g[2]))) & 7;
#else
  u32 shared = 0;
  for (u32 i = 0; i < 3; ++i) shared |= u32{f[i] == g[0] || f[i] == g[1] || f[i] == g[2]} << i;
  return shared;
#endif
}

// Do two triangles, given by three different vertices each, meet beyond what they share? They need not be faces yet.
// Exact; touching counts.
bool corners_meet(const Mesh& m, const u32* f, const u32* g);
inline bool faces_meet(const Mesh& m, u32 f, u32 g) { return corners_meet(m, m.corner + 3 * f, m.corner + 3 * g); }

// A triangle that is tested against others.
struct Probe {
  const u32* v;
  Plane plane;
};
inline Probe probe_of(const Mesh& m, const u32* v) {
  return {v, plane_of(m.position[v[0]], m.position[v[1]], m.position[v[2]])};
}
// corners_meet(), but mostly one of the planes tells.
bool meets(const Mesh& m, const Probe& f, const u32* g);

// Do no two faces round v meet but in what they share? Proven once, and noted in star, which has an entry for each
// vertex, zero at first. Several threads may use the same notes. False proves nothing.
bool star_proven(const Mesh& m, u8* star, u32 v);

struct Detection {
  Stack<Contact> pairs;  // sorted; only the first `capacity` in no particular order when there are more
  u64 found = 0;         // how many there are
};

// Collects pairs from several threads. Their order of arrival depends on the threads: finish() sorts them.
struct ContactSink {
  Detection& out;
  // How many: in two words, since not every machine adds to 64 bits at once (Cortex-M). Where the lower one runs over,
  // pairs are overwritten, none of which decides anything then.
  u32 low = 0, high = 0;
  void add(u32 f, u32 g) {
    const u32 at = __atomic_fetch_add(&low, u32{1}, __ATOMIC_RELAXED);
    if (at == none) __atomic_fetch_add(&high, u32{1}, __ATOMIC_RELAXED);
    if (at < out.pairs.capacity) out.pairs.data[at] = {min_of(f, g), max_of(f, g)};
  }
  void finish();
};

// What detection may take for granted, and where it keeps notes.
struct DetectScope {
  u8* active;             // per face: 1 where the face is new or has moved, or else 0; pairs of two faces that are not
                          // active are known not to meet. Afterwards not 0 where it was not
  Span<const u32> faces;  // exactly the active faces, each once: as many and one are written to `room` at most
  Span<u32> room;         // for as many and one; where it is less, they are not proven in groups
  u8* star;               // per vertex, zeroed by the caller: whether its star is proven unfolded
};

// All contacts in the scope, among the faces of the near faces. Expected O(faces in scope + pairs).
void detect(const Mesh& m, const NearFaces& g, const DetectScope& scope, const Exec& exec, Detection& out);

}  // namespace tpa
