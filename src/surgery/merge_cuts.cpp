// SPDX-License-Identifier: MIT
#include "surgery/merge_cuts.h"

#include "edit/collapse.h"

namespace tpa {

namespace {

// In Clusters::taken_in: the vertex stays as it is.
constexpr u32 takes_none = none;

// Calls visit(cut) for the cuts with a new vertex.
template <class Visit>
void for_each_new(Clusters& r, Visit visit) {
  for (const CutLoop& loop : r.loops)
    for (u32 i = 0; i < loop.count; ++i)
      if (Cut& cut = r.cuts[loop.first + i]; !is_snapped(cut)) visit(cut);
}

// Is there a face at v without a marked corner?
bool has_whole_face(const Mesh& m, u32 v, const u8* vertex_mark) {
  bool whole = false;
  for_each_outgoing(m, v,
                    [&](u32 h) { whole = whole || (vertex_mark[head(m, h)] == 0 && vertex_mark[apex(m, h)] == 0); });
  return whole;
}

// Moves the end outside to the mean of the new vertices taken in so far; its old position does not count.
void take_in(Edit& e, NearFaces& g, Cut& cut, u32& taken_in, u8* face_mark) {
  const Mesh& m = e.mesh;
  const f64 n = taken_in;
  const Vec3 mean = into_exact_range(1 / (n + 1) * (n * m.position[cut.outside] + m.position[cut.vertex]));
  if (!collapse(e, g, cut.vertex, cut.outside, mean, m.vertex_origin[cut.outside], Expected::bent, face_mark)) return;
  cut.vertex = none;
  ++taken_in;
}

}  // namespace

void merge_cuts(Edit& e, NearFaces& g, Clusters& r, u8* vertex_mark, u8* face_mark) {
  spend(g.meter, 12 * u64{r.cuts.size});
  u32* taken_in = r.taken_in;
  for_each_new(r, [&](const Cut& c) { vertex_mark[c.vertex] = 1; });
  u32 known = none;  // cuts with the same end outside follow each other
  for_each_new(r, [&](const Cut& c) {
    if (c.outside != known) taken_in[c.outside] = has_whole_face(e.mesh, c.outside, vertex_mark) ? 0 : takes_none;
    known = c.outside;
  });
  for_each_new(r, [&](const Cut& c) { vertex_mark[c.vertex] = 0; });
  for_each_new(r, [&](Cut& c) {
    if (taken_in[c.outside] != takes_none) take_in(e, g, c, taken_in[c.outside], face_mark);
  });
}

}  // namespace tpa
