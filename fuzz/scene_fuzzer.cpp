// SPDX-License-Identifier: MIT
// One fuzzing target for the whole library. Bytes become a few crumpled, overlapping spheres, which are untangled and
// then moved about; the promises of the header are checked after each call, the region among them. For libFuzzer, and
// for replay.cpp.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "bytes.h"
#include "crumpled_spheres.h"
#include "region_judge.h"
#include "target.h"
#include "tool/surface.h"
#include "topoadapt.h"

namespace {

// Over all inputs.
uint64_t loaded_scenes = 0, untangled_scenes = 0, judged_points = 0;

using fuzz::Bytes, fuzz::Demand;

// Of the input at hand: its size, and the regions that judges could have looked at.
uint64_t input_size = 0, regions = 0;

// Self-intersections of the mesh, always a closed oriented 2-manifold; max_contacts if there are more.
uint64_t crossings(tpa_context* context) {
  tpa_validation v{};
  v.struct_size = sizeof v;
  tpa_issue issue;
  const tpa_status status = tpa_validate(context, nullptr, &v, &issue);
  Demand(status == TPA_OK || (status == TPA_E_LIMIT && issue.limit == TPA_LIMIT_CONTACTS),
         "a closed oriented 2-manifold, always");
  return v.self_intersections;
}

struct Snapshot {
  tool::TriangleMesh mesh;
  explicit Snapshot(const tpa_context* context) {
    tpa_mesh_view view{};
    view.struct_size = sizeof view;
    Demand(tpa_view(context, &view) == TPA_OK, "a mesh to view");
    mesh.positions.assign(view.positions, view.positions + 3 * size_t{view.vertex_count});
    mesh.triangles.assign(view.triangles, view.triangles + 3 * size_t{view.triangle_count});
  }
  bool operator==(const Snapshot& o) const {
    return mesh.positions == o.mesh.positions && mesh.triangles == o.mesh.triangles;
  }
};

// Vertices that the last step left at their old places go back.
void roll_back(const tpa_context* context, const Snapshot& before, tool::TriangleMesh& moved) {
  const uint32_t* kept = nullptr;
  uint32_t count = 0;
  tpa_vertex_map_view map{};
  map.struct_size = sizeof map;
  Demand(tpa_rolled_back(context, &kept, &count) == TPA_OK && tpa_vertex_map(context, &map) == TPA_OK, "maps to view");
  for (uint32_t i = 0; i < count; ++i) {
    const tpa_vertex_origin& origin = map.origins[kept[i]];
    if (origin.parents[1] != TPA_NONE) continue;
    for (size_t c = 3 * size_t{origin.parents[0]}; c < 3 * size_t{origin.parents[0]} + 3; ++c)
      moved.positions[c] = before.mesh.positions[c];
  }
}

void demand_region(const tool::TriangleMesh& aimed, const tool::TriangleMesh& moved, const tpa_context* context,
                   const tpa_report& report, const char* call) {
  if (!fuzz::IsJudged(regions++, input_size)) return;
  const std::string fault = fuzz::RegionFault(aimed, moved, Snapshot(context).mesh, report, judged_points);
  if (!fault.empty()) std::fprintf(stderr, "%s: %s\n", call, fault.c_str());
  Demand(fault.empty(), "the region of winding number 1 or more");
}

void move_about(tpa_context* context, Bytes& in) {
  const Snapshot before(context);
  tool::TriangleMesh moved = before.mesh;
  std::vector<double>& targets = moved.positions;
  fuzz::MoveAbout(in, targets);
  tpa_move_input move{};
  move.struct_size = sizeof move;
  move.count = static_cast<uint32_t>(targets.size() / 3);
  move.position_type = TPA_FLOAT64;
  move.positions = targets.data();
  tpa_issue issue;
  Demand(tpa_move(context, &move, &issue) == TPA_OK, "finite targets are taken");
  tpa_report report{};
  report.struct_size = sizeof report;
  const tpa_status status = tpa_step(context, nullptr, &report, &issue);
  if (status == TPA_OK) {
    Demand(crossings(context) == 0, "no self-intersection after a step");
    const tool::TriangleMesh aimed = moved;
    roll_back(context, before, moved);
    demand_region(aimed, moved, context, report, "tpa_step");
  } else {
    Demand(status == TPA_E_LIMIT && Snapshot(context) == before, "a failed step changes nothing");
  }
}

// Untangles the loaded mesh. True if a mesh without self-intersections is left to move about.
bool untangle(tpa_context* context, uint64_t max_contacts) {
  const Snapshot before(context);
  tpa_report report{};
  report.struct_size = sizeof report;
  tpa_issue issue;
  if (const tpa_status status = tpa_adapt(context, nullptr, &report, &issue); status != TPA_OK) {
    Demand(status == TPA_E_LIMIT && Snapshot(context) == before, "a failed tpa_adapt changes nothing");
    return false;
  }
  const uint64_t left = crossings(context);
  Demand(left == report.unresolved || report.unresolved > max_contacts, "what is left is counted");
  if (left == 0)
    demand_region(before.mesh, before.mesh, context, report, "tpa_adapt");
  else
    Demand(Snapshot(context) == before, "a tangle that is left is left alone");
  return left == 0 && report.vertices >= 4;
}

}  // namespace

std::string fuzz::Tally() {
  return tool::text_of(loaded_scenes, " scenes loaded, ", untangled_scenes, " untangled and moved about, ",
                       judged_points, " points judged");
}

bool fuzz::ReachedEnough(uint64_t inputs) {
  return 10 * untangled_scenes >= 6 * inputs && judged_points >= 10 * inputs;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  Bytes in{data, size};
  input_size = size, regions = 0;
  const tpa_config config = fuzz::CrumpledConfig(in);
  tpa_arena_size arena;
  tpa_issue issue;
  Demand(tpa_arena_query(&config, &arena, &issue) == TPA_OK, "a valid config has a size");
  void* block = std::malloc(arena.bytes);
  tpa_context* context = nullptr;
  Demand(tpa_init(block, arena.bytes, &config, &context, &issue) == TPA_OK, "a block of that size is enough");
  const tool::TriangleMesh scene = fuzz::CrumpledSpheres(in);
  const tpa_mesh_input mesh = tool::input_of(scene);
  if (tpa_load(context, &mesh, &issue) == TPA_OK) {
    ++loaded_scenes;
    if (untangle(context, config.max_contacts)) {
      ++untangled_scenes;
      for (int step = 0; step < 3; ++step) move_about(context, in);
    }
  }
  std::free(block);
  return 0;
}
