// SPDX-License-Identifier: MIT
#include "block/way_back.h"

#include <string.h>

#include "block/marks.h"

namespace tpa {

namespace {

// The tables, and their elements in use.
#define TPA_KEPT(X)                           \
  X(position, Vec3, 1, vertices)              \
  X(vertex_edge, u32, 1, vertices)            \
  X(vertex_origin, VertexOrigin, 1, vertices) \
  X(corner, u32, 3, faces)                    \
  X(opposite, u32, 3, faces)                  \
  X(face_origin, u32, 1, faces)               \
  X(old_to_new, u32, 1, old_vertices)         \
  X(target, Vec3, 1, vertices)                \
  X(targets, u32, 1, vertex_words)            \
  X(rolled_back, u32, 1, vertex_words)        \
  X(changed_vertices, u32, 1, vertex_words)   \
  X(changed_faces, u32, 1, face_words)        \
  X(events, tpa_event, 1, events)             \
  X(component_before, u32, 1, ancestors)

struct KeptCounts {
  u64 vertices, faces, old_vertices, vertex_words, face_words, events, ancestors;
};

KeptCounts most_kept(const Limits& l) {
  return {l.vertices, l.triangles, l.vertices, bit_set_words(l.vertices), bit_set_words(l.triangles),
          l.events,   l.components};
}

KeptCounts counts_of(const Context& c) {
  return {c.vertex_count,
          c.face_count,
          c.old_vertex_count,
          bit_set_words(c.limits.vertices),
          bit_set_words(c.limits.triangles),
          c.event_count,
          c.ancestor_count};
}

struct KeptTables {
  Context* context;
#define TPA_KEPT_POINTER(name, type, units, count) type* name;
  TPA_KEPT(TPA_KEPT_POINTER)
#undef TPA_KEPT_POINTER
  u64 bytes;
};

KeptTables place_kept(const Limits& l, u8* memory) {
  const KeptCounts most = most_kept(l);
  Carver carver{memory};
  KeptTables kept;
  carver.take(kept.context, 1);
#define TPA_KEPT_TAKE(name, type, units, count) carver.take(kept.name, units* most.count);
  TPA_KEPT(TPA_KEPT_TAKE)
#undef TPA_KEPT_TAKE
  kept.bytes = carver.bytes;
  return kept;
}

KeptTables kept_in(const Context& c) { return place_kept(c.limits, table_data<u8>(c, table_kept)); }

void copy_bytes(void* to, const void* from, u64 bytes) { memcpy(to, from, static_cast<size_t>(bytes)); }

}  // namespace

u64 bytes_kept(const Limits& l) { return place_kept(l, nullptr).bytes; }

void keep_state(Context& c) {
  const KeptTables kept = kept_in(c);
  const KeptCounts count = counts_of(c);
  *kept.context = c;
#define TPA_KEPT_KEEP(name, type, units, n) \
  copy_bytes(kept.name, table_data<type>(c, table_##name), units * sizeof(type) * count.n);
  TPA_KEPT(TPA_KEPT_KEEP)
#undef TPA_KEPT_KEEP
}

void take_back_all(Context& c) {
  forget_targets(c);
  const KeptTables kept = kept_in(c);
  u64 peak[measure_count];
  memcpy(peak, c.peak, sizeof peak);
  c = *kept.context;
  memcpy(c.peak, peak, sizeof peak);
  const KeptCounts count = counts_of(c);
#define TPA_KEPT_PUT(name, type, units, n) \
  copy_bytes(table_data<type>(c, table_##name), kept.name, units * sizeof(type) * count.n);
  TPA_KEPT(TPA_KEPT_PUT)
#undef TPA_KEPT_PUT
  // Commits only add unsettled faces: the sets hold at least what they held before.
  c.near_faces_stand = c.components_known = false;
  c.measured_faces = 0;
  Workspace w = open(c);
  w.edit.journal.vertices.clear();
  w.edit.journal.faces.clear();
  note_mapped(w.edit, w.old_to_new);
  for (u32 v : w.targets) w.marks[v] = target_reached;
  close(w);
}

const Context& kept_context(const Context& c) { return *kept_in(c).context; }
const Vec3* kept_positions(const Context& c) { return kept_in(c).position; }
const u32* kept_corners(const Context& c) { return kept_in(c).corner; }
const Vec3* kept_targets(const Context& c) { return kept_in(c).target; }
BitSet kept_vertices_with_target(const Context& c) { return open_bit_set(kept_in(c).targets, c.limits.vertices); }

}  // namespace tpa
