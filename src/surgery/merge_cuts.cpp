#include "surgery/merge_cuts.h"

#include "edit/collapse.h"

namespace tpa {

namespace {

template <class Visit>
void for_each_cut(Clusters& r, Visit visit) {
  for (const CutLoop& loop : r.loops)
    for (u32 i = 0; i < loop.count; ++i)
      if (!is_drawn(r.cuts[loop.first + i])) visit(r.cuts[loop.first + i]);
}

// Is there a face at v without a marked corner?
bool has_whole_face(const Mesh& m, u32 v, const u8* vertex_mark) {
  bool whole = false;
  for_each_outgoing(m, v,
                    [&](u32 h) { whole = whole || (vertex_mark[head(m, h)] == 0 && vertex_mark[apex(m, h)] == 0); });
  return whole;
}

// The end of the cut edge that stayed takes the new vertex in. It lies in the mean of those that it has taken in.
void take_in(Edit& e, NearFaces& g, Cut& cut, u32& taken_in, u8* face_mark) {
  const Mesh& m = e.mesh;
  const f64 n = taken_in;
  const Vec3 mean = into_exact_range(1 / (n + 1) * (n * m.position[cut.outside] + m.position[cut.vertex]));
  if (!collapse(e, g, cut.vertex, cut.outside, mean, m.vertex_origin[cut.outside], no_way, Expected::bent, face_mark))
    return;
  cut.vertex = none;
  ++taken_in;
}

}  // namespace

void coarsen(Edit& e, NearFaces& g, Clusters& r, u8* vertex_mark, u8* face_mark) {
  u32* taken_in = r.taken_in;  // none: takes none in
  for_each_cut(r, [&](const Cut& c) { vertex_mark[c.vertex] = 1; });
  for_each_cut(r,
               [&](const Cut& c) { taken_in[c.outside] = has_whole_face(e.mesh, c.outside, vertex_mark) ? 0 : none; });
  for_each_cut(r, [&](const Cut& c) { vertex_mark[c.vertex] = 0; });
  for_each_cut(r, [&](Cut& c) {
    if (taken_in[c.outside] != none) take_in(e, g, c, taken_in[c.outside], face_mark);
  });
}

}  // namespace tpa
