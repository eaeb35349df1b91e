// SPDX-License-Identifier: MIT
#include "block/scratch.h"

#include "base/arena.h"

namespace tpa {

namespace {

enum class ScratchUnit : u8 {
  vertices,
  triangles,
  listed_faces,
  contacts,
  cuts,
  corners,
  loops,
  polygons,
  components,
  parts,
  samples,
  heap_entries,
  bytes_of_face_tree,
  bytes_of_search_tree,
  bytes_of_search,
  bytes_of_arrangement,
  bytes_of_tasks,
  count
};

struct ScratchRule {
  Stage stage;
  u8 element_bytes, units;
  ScratchUnit count;
};

constexpr ScratchRule scratch_rules[scratch_count] = {
#define TPA_SCRATCH_RULE(stage, name, type, units, measure) {Stage::stage, sizeof(type), units, ScratchUnit::measure},
    TPA_SCRATCH(TPA_SCRATCH_RULE)
#undef TPA_SCRATCH_RULE
};

constexpr u32 stage_count = static_cast<u32>(Stage::count), count_count = static_cast<u32>(ScratchUnit::count);

template <class... Stages>
constexpr u32 all(Stages... stages) {
  return (0u | ... | (1u << static_cast<u32>(stages)));
}

// Clusters and all notes on them.
constexpr u32 noted_clusters = all(Stage::clusters, Stage::groups, Stage::snaps, Stage::merges, Stage::areas);

// The stages placed before a stage in memory: the stage begins behind all of them.
constexpr u32 stages_before(Stage s) {
  switch (s) {
    case Stage::vertex_hash: return all(Stage::search_tree);
    case Stage::clusters: return all(Stage::search_tree);
    case Stage::groups:
    case Stage::snaps:
    case Stage::merges:
    case Stage::areas: return all(Stage::clusters);
    case Stage::snapped: return noted_clusters;
    case Stage::tunnels: return all(Stage::snapped);
    case Stage::saved: return all(Stage::snapped);
    case Stage::wanted: return all(Stage::saved);
    case Stage::short_loops: return all(Stage::tunnels);
    case Stage::closing: return all(Stage::tunnels);
    case Stage::search: return all(Stage::closing);
    case Stage::sewing: return all(Stage::closing);
    case Stage::lists: return all(Stage::tasks, Stage::arrangement, Stage::short_loops);
    case Stage::tasks: return all(Stage::vertex_hash, Stage::face_tree, Stage::wanted);
    case Stage::arrangement: return all(Stage::search_tree);
    case Stage::components_after: return all(Stage::search_tree);
    case Stage::parts: return all(Stage::search_tree);
    case Stage::region: return all(Stage::search_tree);
    default: return 0;
  }
}

}  // namespace

u64 place_scratch(const Limits& l, u64* offset) {
  const u64 counts[count_count] = {l.vertices,
                                   l.triangles,
                                   u64{l.triangles} + 1,  // an append writes before it counts
                                   l.contacts,
                                   l.cuts,
                                   corners_of_piece(l.cuts),
                                   most_loops(l.cuts),
                                   polygons_in_piece(l.cuts),
                                   l.components,
                                   most_parts(l.vertices),
                                   SampleGrid::most_points,
                                   most_heap_entries,
                                   face_tree_bytes(l.vertices, l.triangles),
                                   search_tree_bytes(l.vertices, l.triangles),
                                   closing_scratch_bytes(corners_of_piece(l.cuts)),
                                   arrangement_bytes(l.pieces),
                                   task_rooms(l.triangles) * TaskRooms::bytes};
  u64 end[stage_count], bytes = 0;
  for (u32 s = 0, i = 0; s < stage_count; ++s) {
    u64 at = 0;
    for (u32 before = 0; before < s; ++before)
      if ((stages_before(static_cast<Stage>(s)) >> before & 1) != 0) at = max_of(at, end[before]);
    for (; i < scratch_count && scratch_rules[i].stage == static_cast<Stage>(s); ++i) {
      if (offset != nullptr) offset[i] = at;
      const u64 size =
          counts[static_cast<u32>(scratch_rules[i].count)] * scratch_rules[i].units * scratch_rules[i].element_bytes;
      at = (at + size + arena_alignment - 1) / arena_alignment * arena_alignment;
    }
    end[s] = at;
    bytes = max_of(bytes, at);
  }
  return bytes;
}

}  // namespace tpa
