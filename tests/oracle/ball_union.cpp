// SPDX-License-Identifier: MIT
#include "oracle/ball_union.h"

#ifdef TOPOADAPT_HAVE_CGAL

#include <CGAL/Alpha_shape_3.h>
#include <CGAL/Alpha_shape_cell_base_3.h>
#include <CGAL/Alpha_shape_vertex_base_3.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <map>
#include <numeric>

namespace support {

namespace {

// Comparisons of squared radii are exact.
using Exact = CGAL::Tag_true;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Alpha_shape_vertex_base_3<Kernel, CGAL::Default, Exact>;
using CellBase = CGAL::Alpha_shape_cell_base_3<Kernel, CGAL::Default, Exact>;
using Cells = CGAL::Triangulation_data_structure_3<VertexBase, CellBase>;
using Delaunay = CGAL::Delaunay_triangulation_3<Kernel, Cells, CGAL::Fast_location>;
using AlphaShape = CGAL::Alpha_shape_3<Delaunay, Exact>;
using Squared = AlphaShape::FT;

struct Sets {
  std::vector<size_t> parent;
  size_t count;
  explicit Sets(size_t n) : parent(n), count(n) { std::iota(parent.begin(), parent.end(), size_t{0}); }
  size_t find(size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  }
  void join(size_t a, size_t b) {
    a = find(a), b = find(b);
    if (a == b) return;
    parent[a] = b;
    --count;
  }
};

// Four points far away guarantee a Delaunay triangulation of full dimension. The four stay components of their own:
// they would join the rest only at radii a thousand times as large.
constexpr double far = 1e4;
constexpr double guards[4][3] = {{far, far, far}, {far, -far, -far}, {-far, far, -far}, {-far, -far, far}};

// Of the alpha complex: all simplices that are not exterior.
Betti BettiAt(AlphaShape& shape, const Squared& alpha) {
  shape.set_alpha(alpha);
  const auto in = [](AlphaShape::Classification_type c) { return c != AlphaShape::EXTERIOR; };
  std::map<AlphaShape::Vertex_handle, size_t> vertex;
  for (auto v = shape.finite_vertices_begin(); v != shape.finite_vertices_end(); ++v) vertex.emplace(v, vertex.size());
  std::map<AlphaShape::Cell_handle, size_t> cell;
  for (auto c = shape.all_cells_begin(); c != shape.all_cells_end(); ++c) cell.emplace(c, cell.size());
  Sets bodies(vertex.size()), outside(cell.size());
  long euler = static_cast<long>(vertex.size());
  for (auto e = shape.finite_edges_begin(); e != shape.finite_edges_end(); ++e)
    if (in(shape.classify(*e))) {
      --euler;
      bodies.join(vertex.at(e->first->vertex(e->second)), vertex.at(e->first->vertex(e->third)));
    }
  for (auto f = shape.finite_facets_begin(); f != shape.finite_facets_end(); ++f) {
    if (in(shape.classify(*f)))
      ++euler;
    else
      outside.join(cell.at(f->first), cell.at(f->first->neighbor(f->second)));
  }
  // Infinite cells hang together through infinite facets, never part of the complex.
  size_t filled = 0;
  const auto infinite = shape.infinite_cell();
  for (auto c = shape.all_cells_begin(); c != shape.all_cells_end(); ++c) {
    if (shape.is_infinite(c)) {
      outside.join(cell.at(c), cell.at(infinite));
    } else if (in(shape.classify(c))) {
      --euler;
      ++filled;
    }
  }
  euler -= 4;
  const long components = static_cast<long>(bodies.count) - 4, voids = static_cast<long>(outside.count - filled) - 1;
  return {components, components + voids - euler, voids};
}

}  // namespace

bool KnowsUnions() { return true; }

std::optional<Betti> BettiOfUnion(const std::vector<tool::Point>& centers, double radius, double margin) {
  std::vector<Kernel::Point_3> points;
  for (const tool::Point& c : centers) points.emplace_back(c[0], c[1], c[2]);
  for (const auto& g : guards) points.emplace_back(g[0], g[1], g[2]);
  AlphaShape shape(points.begin(), points.end(), 0, AlphaShape::GENERAL);
  const auto square = [](double r) { return Squared(r * r); };
  const Betti betti = BettiAt(shape, square(radius));
  const Squared least = square(radius - margin), most = square(radius + margin);
  if (BettiAt(shape, least) != betti || BettiAt(shape, most) != betti) return std::nullopt;
  // The topology changes only at critical values.
  for (auto a = shape.alpha_lower_bound(least); a != shape.alpha_end() && *a <= most; ++a)
    if (BettiAt(shape, *a) != betti) return std::nullopt;
  return betti;
}

}  // namespace support

#else

namespace support {

bool KnowsUnions() { return false; }
std::optional<Betti> BettiOfUnion(const std::vector<tool::Point>&, double, double) { return std::nullopt; }

}  // namespace support

#endif
