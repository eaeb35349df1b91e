// SPDX-License-Identifier: MIT
// saved_state: the state of a context as a stream of bytes, equal on every processor and for every set of limits.
// Numbers are little-endian and unaligned: a header, the arrays below in order, the hash of all bytes before. The state
// is all that decides the results of later calls, and nothing that the mesh tells by itself: opposites, components and
// the face tree are found again.
#pragma once

#include "base/hash64.h"
#include "block/context.h"

namespace tpa {

// One line for each number of elements: name, field of Context, measure that limits it.
#define TPA_SAVED_COUNTS(X)                   \
  X(vertices, vertex_count, vertices)         \
  X(faces, face_count, triangles)             \
  X(old_vertices, old_vertex_count, vertices) \
  X(old_faces, old_face_count, fixed)         \
  X(targets, target_count, vertices)          \
  X(rolled_back, rolled_back_count, vertices) \
  X(events, event_count, events)              \
  X(ancestors, ancestor_count, components)

// One line for each array: name of the table, numbers of 32 bits in an element, then numbers of 64 bits, count. Tables
// begin with the elements saved.
#define TPA_SAVED_TABLES(X)         \
  X(position, 0, 3, vertices)       \
  X(vertex_edge, 1, 0, vertices)    \
  X(vertex_origin, 3, 0, vertices)  \
  X(corner, 3, 0, faces)            \
  X(face_origin, 1, 0, faces)       \
  X(old_to_new, 1, 0, old_vertices) \
  X(events, 4, 3, events)           \
  X(component_before, 1, 0, ancestors)

// Sets of vertices, as ascending lists, and the elements of tables at the members.
#define TPA_SAVED_SETS(X)   \
  X(targets, 1, 0, targets) \
  X(target, 0, 3, targets)  \
  X(rolled_back, 1, 0, rolled_back)

// Fields of tpa_config that decide results.
#define TPA_SAVED_CONFIG(X) \
  X(detect_mode)            \
  X(cell_size)              \
  X(region)                 \
  X(max_passes)             \
  X(max_candidates)         \
  X(smooth_iterations)      \
  X(smooth_lambda)          \
  X(smooth_mu)

enum SavedCount : u32 {
#define TPA_SAVED_COUNT(name, field, measure) count_of_##name,
  TPA_SAVED_COUNTS(TPA_SAVED_COUNT)
#undef TPA_SAVED_COUNT
      saved_counts
};

enum SavedArray : u32 {
#define TPA_SAVED_ARRAY(name, words, wides, count) saved_##name,
  TPA_SAVED_TABLES(TPA_SAVED_ARRAY) saved_tables,
  first_saved_set = saved_tables - 1,
  TPA_SAVED_SETS(TPA_SAVED_ARRAY)
#undef TPA_SAVED_ARRAY
      saved_arrays
};

struct SavedArrayInfo {
  TableId table;
  u8 words, wides;  // numbers of 32 and of 64 bits in an element
  SavedCount count;
  u64 element_bytes() const { return 4 * u64{words} + 8 * u64{wides}; }
};
const SavedArrayInfo& saved_array_info(u32 array);

struct SavedHeader {
  u64 magic;
  u32 version;
  u32 count[saved_counts];
  u32 loaded;  // 1: a mesh is loaded; all of its bodies may be gone
  u64 bytes;   // of the whole stream
  u64 epoch;
  tpa_config config;  // the fields of TPA_SAVED_CONFIG only
};

// "TPASTATE" in bytes, and the newest version of the format.
inline constexpr u64 saved_magic = 0x4554415453415054u;
inline constexpr u32 saved_version = 1;

// Calls visit(number) for all numbers of the header in order, to read, write or measure them.
template <class Header, class Visit>
void for_each_number(Header& h, Visit visit) {
  visit(h.magic);
  visit(h.version);
  for (auto& count : h.count) visit(count);
  visit(h.loaded);
  visit(h.bytes);
  visit(h.epoch);
#define TPA_SAVED_FIELD(name) visit(h.config.name);
  TPA_SAVED_CONFIG(TPA_SAVED_FIELD)
#undef TPA_SAVED_FIELD
}

// Returns the bytes of a state with these counts, and writes the offset of each array, unless `offset` is nullptr.
u64 place_saved_state(const u32* count, u64* offset);
inline constexpr u64 saved_hash_bytes = 8;

// The elements of each count in use by a context.
void count_elements(const Context& c, u32* count);
// False, with the issue filled in, unless so many elements are within the limits.
bool elements_fit(const u32* count, const Limits& limits, tpa_issue& issue);

// After the tables have got these elements: counts, epoch, and all that follows from them. Targets and vertices left
// behind come next, one by one. The face tree and the longest edge are unknown.
void adopt_counts(Context& c, const u32* count, u64 epoch, bool loaded);

u64 bytes_of_state(const Context& c);
// Writes the state to to[0 .. bytes_of_state() - 1], unless `to` is nullptr, and returns its hash.
u64 write_state(const Context& c, u8* to);

}  // namespace tpa
