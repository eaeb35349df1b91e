// SPDX-License-Identifier: MIT
// scratch: the table used in turn by the stages of a call, and the arrays of each stage in it. A stage may read the
// arrays of stages placed before it in memory, and no others.
#pragma once

#include "arrangement/arrangement.h"
#include "cut/clusters.h"
#include "cut/short_loops.h"
#include "detect/detect_all.h"
#include "mesh/component_changes.h"
#include "mesh/winding_samples.h"
#include "surgery/close_holes.h"

namespace tpa {

// The limits of a config with the defaults filled in.
struct Limits {
  u32 vertices = 0, triangles = 0, contacts = 0, cuts = 0, events = 0, components = 0, pieces = 0, substeps = 0;
};

enum class Stage : u8 {
  loading,
  face_tree,    // of complete detection
  search_tree,  // the part of the face tree needed by searches
  vertex_hash,  // between passes
  clusters,     // while clusters exist
  // Notes on clusters, from here to `areas`: at most one stage is alive.
  groups,
  snaps,
  merges,
  areas,             // while clusters are measured
  snapped,           // cuts: known before loops are closed, still needed after positions have been saved
  tunnels,           // while tunnels are closed: loops are searched, cut and capped meanwhile
  saved,             // positions before smoothing
  wanted,            // positions of the next round of smoothing
  short_loops,       // while short loops are searched
  closing,           // of loops
  search,            // for handles and caps
  sewing,            // of handles and caps
  arrangement,       // of an exact cut
  tasks,             // of detection
  lists,             // of faces and vertices to test, also during complete detection; not
                     // while loops are closed, or cuts snapped or smoothed
  components_after,  // labelled anew in the middle of a transaction
  parts,
  region,  // while the region's change is measured
  count
};

// One line for each array, stage by stage: stage, name, element type, elements for each unit of the measure, measure.
#define TPA_SCRATCH(X)                                     \
  X(loading, loaded_opposite, u32, 3, triangles)           \
  X(loading, sorted_edges, u32, 3, triangles)              \
  X(face_tree, face_tree, u8, 1, bytes_of_face_tree)       \
  X(search_tree, search_tree, u8, 1, bytes_of_search_tree) \
  X(vertex_hash, vertex_head, u32, 2, vertices)            \
  X(vertex_hash, vertex_slot, u32, 1, vertices)            \
  X(vertex_hash, vertex_link, u32, 1, vertices)            \
  X(vertex_hash, vertex_order, u32, 1, vertices)           \
  X(vertex_hash, marked_slots, u32, 1, vertices)           \
  X(vertex_hash, lower_neighbour, u8, 1, vertices)         \
  X(clusters, members, u32, 1, vertices)                   \
  X(clusters, loops, CutLoop, 1, loops)                    \
  X(clusters, pieces, Piece, 1, loops)                     \
  X(groups, group, u32, 1, vertices)                       \
  X(groups, group_number, u32, 1, vertices)                \
  X(snaps, stretches, u32, 1, vertices)                    \
  X(merges, taken_in, u32, 1, vertices)                    \
  X(areas, cluster_area, f64, 1, vertices)                 \
  X(snapped, snapped_middle, Vec3, 1, cuts)                \
  X(tunnels, tunnels, HeapEntry, 1, vertices)              \
  X(saved, saved_position, Vec3, 1, vertices)              \
  X(wanted, wanted_position, Vec3, 2, cuts)                \
  X(short_loops, way_near, f64, 1, vertices)               \
  X(short_loops, towards_near, u32, 1, vertices)           \
  X(short_loops, heap_near, HeapEntry, 1, heap_entries)    \
  X(closing, placed_faces, u32, 2, corners)                \
  X(closing, loop_vertices, u32, 1, corners)               \
  X(closing, loop_borders, u32, 1, corners)                \
  X(closing, loop_points, Vec3, 1, corners)                \
  X(closing, polygons, Loop, 1, polygons)                  \
  X(search, search, u8, 1, bytes_of_search)                \
  X(sewing, sew_table, u32, 12, corners)                   \
  X(arrangement, arrangement, u8, 1, bytes_of_arrangement) \
  X(tasks, task_room, u8, 1, bytes_of_tasks)               \
  X(lists, face_list, u32, 1, listed_faces)                \
  X(lists, vertex_list, u32, 1, vertices)                  \
  X(components_after, label_after, u32, 1, vertices)       \
  X(components_after, after_list, Component, 1, parts)     \
  X(components_after, after_node, u32, 1, parts)           \
  X(parts, following, u32, 1, vertices)                    \
  X(parts, part_list, Part, 1, parts)                      \
  X(parts, families, Family, 1, components)                \
  X(parts, touched_components, u32, 1, components)         \
  X(parts, part_change, i32, 1, components)                \
  X(parts, part_open, u32, 1, components)                  \
  X(parts, family_place, u32, 1, components)               \
  X(parts, next_after, u32, 1, components)                 \
  X(region, winding_then, i32, 1, samples)                 \
  X(region, winding_now, i32, 1, samples)

enum ScratchId : u32 {
#define TPA_SCRATCH_ID(stage, name, type, units, measure) scratch_##name,
  TPA_SCRATCH(TPA_SCRATCH_ID)
#undef TPA_SCRATCH_ID
      scratch_count
};

// Returns the bytes of the table, and writes the offset of each array from its start, unless `offset` is nullptr.
u64 place_scratch(const Limits& l, u64* offset);

// Most components, or parts of components, in the middle of a transaction: two triangles may lie back to back.
inline u32 most_parts(u32 vertices) { return vertices / 3 + 1; }
// A loop cuts three edges at least.
inline u32 most_loops(u32 cuts) { return cuts / 3 + 1; }
inline u32 corners_of_piece(u32 cuts) { return min_of(cuts, longest_piece); }
inline u32 polygons_in_piece(u32 cuts) { return min_of(most_loops(cuts), most_loops_joined); }

// The arrays by their names.
struct Scratch {
  u8* memory;
  const u64* offset;  // place_scratch()

#define TPA_SCRATCH_ARRAY(stage, name, type, units, measure) \
  type* name() const { return reinterpret_cast<type*>(memory + offset[scratch_##name]); }
  TPA_SCRATCH(TPA_SCRATCH_ARRAY)
#undef TPA_SCRATCH_ARRAY
};

}  // namespace tpa
