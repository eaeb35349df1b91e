// SPDX-License-Identifier: MIT
#include "results/true_origins.h"

#include "block/marks.h"

namespace tpa {

namespace {

struct Fit {
  VertexOrigin origin;
  f64 off;     // squared distance of the vertex from the place that the origin tells
  f64 length;  // squared distance of the parents
};

// The mesh, and where old vertices were before the first change.
struct OldPlaces {
  const Workspace& w;
  const Vec3* place;  // nullptr: after the move of this transaction

  const Mesh& mesh() const { return w.edit.mesh; }
  const Vec3& of(u32 v) const { return place != nullptr ? place[v] : moved_position(w, v); }
};

// The nearest point to p between two old vertices.
Fit fit_between(const OldPlaces& old, u32 a, u32 b, const Vec3& p) {
  const Vec3 &from = old.of(a), &to = old.of(b);
  const f64 whole = squared_length(to - from);
  const f64 share = whole > 0 ? min_of(1.0, max_of(0.0, dot(p - from, to - from) / whole)) : 0;
  const f32 weight = static_cast<f32>(1 - share);
  const Vec3 there = f64{weight} * from + (1 - f64{weight}) * to;
  return {{{a, b}, weight}, squared_length(p - there), whole};
}

Fit fit_to(const OldPlaces& old, const VertexOrigin& o, const Vec3& p) {
  return fit_between(old, o.parents[0], o.parents[1] == none ? o.parents[0] : o.parents[1], p);
}

f64 longest_edge_at(const Mesh& m, u32 v) {
  f64 longest = 0;
  for_each_neighbour(m, v, [&](u32 u) { longest = max_of(longest, squared_length(m.position[u] - m.position[v])); });
  return longest;
}

bool is_within(f64 bound, const Fit& fit, f64 longest) {
  return fit.off <= bound * bound * max_of(fit.length, longest);
}
bool is_true(const Fit& fit, f64 longest) { return is_within(origin_bound, fit, longest); }

// The nearest of the neighbours' origins, or `nearest`. Untrue origins say nothing.
Fit nearest_of_neighbours(const OldPlaces& old, u32 v, f64 longest, Fit nearest) {
  const Mesh& m = old.mesh();
  for_each_neighbour(m, v, [&](u32 u) {
    if (is_untrue(m.vertex_origin[u])) return;
    const Fit fit = fit_to(old, m.vertex_origin[u], m.position[v]);
    if (is_true(fit, longest) && (!is_true(nearest, longest) || fit.off < nearest.off)) nearest = fit;
  });
  return nearest;
}

void find_true_origin(const OldPlaces& old, u32 v) {
  constexpr f64 good = origin_bound / 2;
  const Mesh& m = old.mesh();
  Fit fit = fit_to(old, m.vertex_origin[v], m.position[v]);
  if (!is_within(good, fit, 0)) {
    const f64 longest = longest_edge_at(m, v);
    if (!is_within(good, fit, longest)) fit = nearest_of_neighbours(old, v, longest, fit);
    if (!is_true(fit, longest)) fit.origin = untrue_origin(fit.origin.parents[fit.origin.weight >= 0.5f ? 0 : 1]);
  }
  m.vertex_origin[v] = fit.origin;
}

}  // namespace

void find_true_origins(Workspace& w) {
  const Mesh& m = w.edit.mesh;
  for (u32 v : w.edit.journal.vertices)
    if (v < m.vertex_count && vertex_lives(m, v) && !is_old(m, v)) find_true_origin({w, nullptr}, v);
}

void find_true_origins_from(Workspace& w, const Vec3* place) {
  const Mesh& m = w.edit.mesh;
  for (u32 v = 0; v < m.vertex_count; ++v)
    if (!is_old(m, v)) find_true_origin({w, place}, v);
}

}  // namespace tpa
