// SPDX-License-Identifier: MIT
// component_volumes: the volumes of components, measured and followed through edits, so that no component turns inside
// out unnoticed (section 2). A thin body whose vertices move far may pass through itself as a whole, free of contacts
// before and after. So every edit without a later judgement asks here first.
#pragma once

#include "mesh/components.h"
#include "mesh/journal.h"

namespace tpa {

// ---------------------------------------------------------------- measuring

// Measures all components with a doubt for each face. Volumes of earlier steps are not used: their errors depend on the
// history of the mesh, and so would every refusal. Sizes are unknown afterwards. O(V).
void measure_enclosed(const Mesh& m, Components& c);

// The same at the positions before the transaction. Pre: no face has changed since.
void measure_before(const Edit& e, Components& c);

// Volumes measured so at the first question. A call that edits nothing asks nothing.
struct VolumesOnDemand {
  Components& components;
  bool measured = false;
};
inline Components& measured(VolumesOnDemand& volumes, const Mesh& m) {
  if (!volumes.measured) measure_enclosed(m, volumes.components);
  volumes.measured = true;
  return volumes.components;
}

// Measures all components, now and at the start of the transaction, with one doubt for the whole sum. For the start,
// known volumes serve if all signs are certain. O(V).
void measure_volumes(const Edit& e, Components& c);

// ---------------------------------------------------------------- calls that fail

// Volumes and sizes at the start of a call. A call that fails has measured moved positions, and puts these back.
struct KnownVolume {
  SignedVolume volume;
  f64 size;
};
void keep_volumes(const Components& c, KnownVolume* known);
void take_back_volumes(Components& c, const KnownVolume* known);

// ---------------------------------------------------------------- following edits

// After such a change of volume, has the component of v certainly the same sign as now? Pre: measured.
bool stays_outside_out(const Components& c, u32 v, const SignedVolume& change);
void note_change(Components& c, u32 v, const SignedVolume& change);

// The change of a volume as v moves, from its position at the start of the transaction. Vertices move one after
// another, in order of number. A new vertex in an old slot counts as moved from there.
SignedVolume change_by_move(const Edit& e, u32 v);

// Vertices with a mark have moved together, each from before[v] to the position in the mesh.
struct Moves {
  Span<const u32> vertices;
  const u8* mark;
  const Vec3* before;
};
// Pre: `turned` is empty. Collects the moved vertices of components that may be inside out now, or else notes the
// changes of the volumes. O(faces round the moved vertices + components).
void find_turned(const Mesh& m, const Moves& moves, Components& c, Stack<u32>& turned);

// For a transaction with moves only: brings the volumes up to date, and proves that measure_volumes() would find the
// same signs now and before. False proves nothing. O(faces round the moved vertices).
bool none_turned(const Edit& e, Components& c);

}  // namespace tpa
