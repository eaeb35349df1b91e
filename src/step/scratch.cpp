#include "step/scratch.h"

#include "base/arena.h"

namespace tpa {

namespace {

enum class Count : u8 {
  vertices,
  triangles,
  listed_faces,
  contacts,
  cuts,
  corners,
  loops,
  fronts,
  components,
  parts,
  bytes_of_face_tree,
  bytes_of_search_tree,
  bytes_of_search,
  count
};

struct Rule {
  Stage stage;
  u8 element_bytes, units;
  Count count;
};

constexpr Rule rules[scratch_count] = {
#define TPA_SCRATCH_RULE(stage, name, type, units, measure) {Stage::stage, sizeof(type), units, Count::measure},
    TPA_SCRATCH(TPA_SCRATCH_RULE)
#undef TPA_SCRATCH_RULE
};

constexpr u32 stage_count = static_cast<u32>(Stage::count), count_count = static_cast<u32>(Count::count);

template <class... Stages>
constexpr u16 all(Stages... stages) {
  return static_cast<u16>((0u | ... | (1u << static_cast<u32>(stages))));
}

// The stages that a stage begins behind: before it.
constexpr u16 stages_before(Stage s) {
  switch (s) {
    case Stage::saved: return all(Stage::search_tree);
    case Stage::wanted: return all(Stage::saved);
    case Stage::clusters: return all(Stage::search_tree);
    case Stage::seams: return all(Stage::clusters);
    case Stage::fronts: return all(Stage::seams);
    case Stage::closing: return all(Stage::clusters);
    case Stage::search: return all(Stage::closing);
    case Stage::sewing: return all(Stage::closing);
    case Stage::drawn: return all(Stage::saved, Stage::search, Stage::sewing);
    case Stage::lists: return all(Stage::face_tree, Stage::saved, Stage::seams);
    case Stage::components_after: return all(Stage::search_tree);
    case Stage::parts: return all(Stage::search_tree);
    default: return 0;
  }
}

}  // namespace

u64 place_scratch(const Limits& l, u64* offset) {
  const u64 counts[count_count] = {l.vertices,
                                   l.triangles,
                                   u64{l.triangles} + 1,  // one more is written than is counted
                                   l.contacts,
                                   l.cuts,
                                   longest_piece(l.cuts),
                                   most_loops(l.cuts),
                                   most_fronts(l.vertices),
                                   l.components,
                                   most_parts(l.vertices),
                                   face_tree_bytes(l.vertices, l.triangles),
                                   search_tree_bytes(l.vertices, l.triangles),
                                   closing_scratch_bytes(longest_piece(l.cuts))};
  u64 end[stage_count], bytes = 0;
  for (u32 s = 0, i = 0; s < stage_count; ++s) {
    u64 at = 0;
    for (u32 before = 0; before < s; ++before)
      if ((stages_before(static_cast<Stage>(s)) >> before & 1) != 0) at = max_of(at, end[before]);
    for (; i < scratch_count && rules[i].stage == static_cast<Stage>(s); ++i) {
      if (offset != nullptr) offset[i] = at;
      const u64 size = counts[static_cast<u32>(rules[i].count)] * rules[i].units * rules[i].element_bytes;
      at = (at + size + arena_alignment - 1) / arena_alignment * arena_alignment;
    }
    end[s] = at;
    bytes = max_of(bytes, at);
  }
  return bytes;
}

}  // namespace tpa
