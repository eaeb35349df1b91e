#include "plan.h"

namespace tpa {

namespace {

struct Closing {
  Edit& e;
  Grid& g;
  const Regions& r;
  const CandidateOptions& options;
  PlanScratch& s;
  u32 used = 0;  // vertices of loops treated so far, in s.vertices, s.borders, s.points
  GroupOutcome out;
};

// Do the placed faces from `from` on meet nothing?
bool placed_are_free(const Closing& p, u32 from) {
  for (u32 i = from; i < p.s.placed.size; ++i)
    if (find_meeting(p.e.mesh, p.g, p.s.placed[i]) != none) return false;
  return true;
}

// Would this face of a candidate meet the mesh? Out of faces, it is not known.
struct FaceAsked {
  Closing& closing;
  Span<const u32> vertices;
};
bool face_is_free(void* caller, const HandleFace& face) {
  const auto& [p, vertices] = *static_cast<FaceAsked*>(caller);
  const u32 from = p.s.placed.size;
  const bool is_free = !place(p.e, p.g, vertices, {&face, 1}, p.s.placed) || placed_are_free(p, from);
  unplace(p.e, p.g, p.s.placed, from);
  return is_free;
}

// Finds and places the first candidate across the loops that meets nothing.
bool join_loops(Closing& p, Span<const CutLoop> loops) {
  constexpr u32 most_loops = 256;  // 4 KiB of stack
  if (loops.size > most_loops) return false;
  Loop polygons[most_loops];
  const u32 base = p.used;
  u32 n = base;
  for (u32 i = 0; i < loops.size; ++i) {
    polygons[i] = {p.s.points.data + n, loops[i].count};
    for (u32 k = 0; k < loops[i].count; ++k, ++n) {
      const Cut& c = p.r.cuts[loops[i].first + k];
      p.s.vertices[n] = c.vertex;
      p.s.borders[n] = c.border;
      p.s.points[n] = p.e.mesh.position[c.vertex];
    }
  }
  const Span<const u32> vertices = p.s.vertices.part(base, n - base);
  CandidateSearch search;
  FaceAsked asked{p, vertices};
  CandidateOptions options = p.options;
  options.filter = {face_is_free, &asked};
  if (!begin(search, {polygons, loops.size}, p.s.search, options)) return false;
  u32 faces = 0;
  while (next(search, p.s.faces, faces)) {
    const u32 from = p.s.placed.size;
    if (!place(p.e, p.g, vertices, {p.s.faces.data, faces}, p.s.placed)) {
      p.out.out_of_faces = true;
      return false;
    }
    if (placed_are_free(p, from)) {
      p.used = n;
      return true;
    }
    unplace(p.e, p.g, p.s.placed, from);
  }
  return false;
}

void start_over(Closing& p) {
  unplace(p.e, p.g, p.s.placed, 0);
  p.used = 0;
  p.out.joined = p.out.capped = 0;
}

bool cap_each(Closing& p, Span<const CutLoop> loops) {
  for (const CutLoop& loop : loops) {
    if (!join_loops(p, {&loop, 1})) return false;
    ++p.out.capped;
  }
  return true;
}

// Nested objects and pinched necks: a cluster that meets itself and still has several loops comes apart there.
bool comes_apart(const Group& group) { return group.clusters == 1 || (group.touches_itself && group.loops > group.clusters); }

// Clusters with several loops are capped, the others joined; the others come to the front of `loops` for that.
bool split_and_join(Closing& p, Span<CutLoop> loops) {
  u32 single = 0, first = 0;
  // Loops are ordered by cluster: [first, end) are those of one.
  for (u32 end = 1; end <= loops.size; ++end) {
    if (end < loops.size && loops[end].cluster == loops[first].cluster) continue;
    if (end - first > 1) {
      if (!cap_each(p, {loops.data + first, end - first})) return false;
    } else {
      swap_values(loops[single++], loops[first]);
    }
    first = end;
  }
  if (single == 1) return cap_each(p, {loops.data, 1});
  if (single == 0) return true;
  p.out.joined = single;
  return join_loops(p, {loops.data, single});
}

bool connect_loops(Closing& p, const Group& group, Span<CutLoop> loops) {
  if (loops.empty()) return true;  // nothing is left of the component
  if (comes_apart(group)) return split_and_join(p, loops);
  p.out.joined = loops.size;
  return join_loops(p, loops);
}

}  // namespace

u64 plan_scratch_bytes(u32 cuts) { return candidate_scratch_bytes(cuts, cuts / 3 + 1); }

GroupOutcome connect_group(Edit& e, Grid& g, const Regions& r, const Group& group,
                           const CandidateOptions& options, PlanScratch& s) {
  Closing p{e, g, r, options, s, 0, {}};
  s.placed.clear();
  const Span<CutLoop> loops = r.loops.span().part(group.first_loop, group.loops);
  p.out.done = connect_loops(p, group, loops);
  if (!p.out.done && !p.out.out_of_faces) {
    start_over(p);
    p.out.done = cap_each(p, loops);
  }
  if (!p.out.done) {
    start_over(p);
    return p.out;
  }
  sew(e, s.placed.span(), s.borders.part(0, p.used), s.keys, s.edges);
  return p.out;
}

}  // namespace tpa
