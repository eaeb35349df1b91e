#include "coarsen.h"

#include "collapse.h"

namespace tpa {

namespace {

template <class Visit>
void for_each_cut(Regions& r, Visit visit) {
  for (const CutLoop& loop : r.loops)
    for (u32 i = 0; i < loop.count; ++i) visit(r.cuts[loop.first + i]);
}

// Is there a face at v without a marked corner?
bool has_whole_face(const Mesh& m, u32 v, const u8* vertex_mark) {
  bool whole = false;
  for_each_outgoing(m, v, [&](u32 h) { whole = whole || (vertex_mark[head(m, h)] == 0 && vertex_mark[apex(m, h)] == 0); });
  return whole;
}

// As many vertices of one outer vertex go together as it can have edges at most, ordinarily.
constexpr u32 most_together = 8;

// The outer vertex takes these cuts in. It lies in the mean of those that it has taken in before.
bool take_in(Edit& e, Grid& g, Span<Cut> cuts, u32& taken_in, u8* face_mark) {
  const Mesh& m = e.mesh;
  const u32 outside = cuts[0].outside;
  Vec3 mean = m.position[outside];
  Going gone[most_together];
  for (u32 i = 0; i < cuts.size; ++i) {
    const f64 n = taken_in + i;
    mean = into_exact_range(1 / (n + 1) * (n * mean + m.position[cuts[i].vertex]));
    gone[i] = {cuts[i].vertex, mean};
  }
  if (!collapse(e, g, {gone, cuts.size}, outside, m.vertex_origin[outside], no_way, Expected::bent, face_mark)) return false;
  for (Cut& cut : cuts) cut.vertex = none;
  taken_in += cuts.size;
  return true;
}

// Neighbours on a loop that end at the same outer vertex: at once where possible, since each has the same neighbourhood
// to be tested; else one by one.
void take_in_all(Edit& e, Grid& g, Span<Cut> cuts, u32& taken_in, u8* face_mark) {
  if (take_in(e, g, cuts, taken_in, face_mark) || cuts.size == 1) return;
  for (u32 i = 0; i < cuts.size; ++i) take_in(e, g, cuts.part(i, 1), taken_in, face_mark);
}

}  // namespace

void coarsen(Edit& e, Grid& g, Regions& r, u8* vertex_mark, u8* face_mark) {
  u32* taken_in = r.number;  // none: takes none in
  for_each_cut(r, [&](const Cut& c) { vertex_mark[c.vertex] = 1; });
  for_each_cut(r, [&](const Cut& c) { taken_in[c.outside] = has_whole_face(e.mesh, c.outside, vertex_mark) ? 0 : none; });
  for_each_cut(r, [&](const Cut& c) { vertex_mark[c.vertex] = 0; });
  for (const CutLoop& loop : r.loops)
    for (u32 first = 0, size = 0; first < loop.count; first += size) {
      const Span<Cut> cuts = r.cuts.span().part(loop.first + first, loop.count - first);
      const u32 outside = cuts[0].outside;
      for (size = 1; size < min_of(cuts.size, most_together) && cuts[size].outside == outside;) ++size;
      if (taken_in[outside] != none) take_in_all(e, g, cuts.part(0, size), taken_in[outside], face_mark);
    }
}

}  // namespace tpa
