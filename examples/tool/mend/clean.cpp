// SPDX-License-Identifier: MIT
#include "tool/mend/clean.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tool/mend/doubles.h"
#include "tool/mend/facing.h"
#include "tool/mend/fans.h"
#include "tool/mend/near.h"
#include "tool/topology.h"

namespace tool {

namespace {

// The library takes coordinates up to this magnitude.
constexpr double largest_coordinate = 0x1p100;

Status check_coordinates(const std::string& path, const PolygonMesh& mesh) {
  for (const uint32_t v : mesh.corners)
    for (size_t axis = 0; axis < 3; ++axis) {
      const double x = mesh.positions[3 * size_t{v} + axis];
      if (std::fabs(x) <= largest_coordinate) continue;
      const std::string which =
          mesh.is_soup ? text_of("facet ", v / 3, ", corner ", v % 3) : text_of("vertex ", v + mesh.first_vertex);
      return failure(path, ": ", which, ": coordinate ", "xyz"[axis], " is ", x,
                     std::isfinite(x) ? ", beyond 2^100 (1.27e30)" : ", not a number in range");
    }
  return success();
}

// 1 for the vertices of parts whose sides do not come in twos.
std::vector<uint8_t> vertices_of_open_parts(const PolygonMesh& mesh) {
  const size_t vertices = mesh.positions.size() / 3;
  std::vector<uint32_t> up(vertices);
  std::iota(up.begin(), up.end(), 0u);
  const auto find = [&](uint32_t v) {
    while (up[v] != v) v = up[v] = up[up[v]];
    return v;
  };
  std::vector<uint64_t> edges;
  for (size_t i = 0; i < mesh.polygons(); ++i) {
    const std::span<const uint32_t> p = mesh.polygon(i);
    for (size_t k = 0; k < p.size(); ++k) {
      const auto [low, high] = std::minmax(p[k], p[(k + 1) % p.size()]);
      edges.push_back(uint64_t{low} << 32 | high);
      up[find(high)] = find(low);
    }
  }
  std::sort(edges.begin(), edges.end());
  std::vector<uint8_t> is_open(vertices);
  for (size_t i = 0, end = 0; i < edges.size(); i = end) {
    while (end < edges.size() && edges[end] == edges[i]) ++end;
    if (end - i != 2) is_open[find(static_cast<uint32_t>(edges[i]))] = 1;
  }
  std::vector<uint8_t> result(vertices);
  for (uint32_t v = 0; v < vertices; ++v) result[v] = is_open[find(v)];
  return result;
}

// A vertex joins the first one before within the length that joined no other. Returns how many did.
size_t weld_near(PolygonMesh& mesh, double length) {
  if (!(length > 0)) return 0;
  const size_t vertices = mesh.positions.size() / 3;
  std::vector<uint8_t> used(vertices);
  for (const uint32_t v : mesh.corners) used[v] = 1;
  std::vector<uint32_t> first(vertices);
  NearGrid grid(mesh.positions, length);
  size_t joined = 0;
  for (uint32_t v = 0; v < vertices; ++v) {
    first[v] = v;
    if (used[v] == 0) continue;
    const double* p = &mesh.positions[3 * size_t{v}];
    grid.for_each_near(p, [&](uint32_t w) {
      const double* q = &mesh.positions[3 * size_t{w}];
      if (std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) <= length) first[v] = std::min(first[v], w);
      return true;
    });
    if (first[v] == v)
      grid.add(v);
    else
      ++joined;
  }
  for (uint32_t& v : mesh.corners) v = first[v];
  return joined;
}

// Corners equal to the one before go, and so do polygons of fewer than three corners. `source` receives the number of
// the first triangle of each polygon left.
size_t drop_repeated_corners(PolygonMesh& mesh, std::vector<uint32_t>& source) {
  PolygonMesh kept;
  uint32_t number = 0;
  size_t dropped = 0;
  for (size_t i = 0; i < mesh.polygons(); ++i) {
    const std::span<const uint32_t> p = mesh.polygon(i);
    const size_t begin = kept.corners.size();
    for (const uint32_t v : p)
      if (kept.corners.size() == begin || kept.corners.back() != v) kept.corners.push_back(v);
    while (kept.corners.size() > begin + 1 && kept.corners.back() == kept.corners[begin]) kept.corners.pop_back();
    if (kept.corners.size() - begin < 3) {
      kept.corners.resize(begin);
      ++dropped;
    } else {
      kept.ends.push_back(kept.corners.size());
      for (uint32_t k = 2; k < kept.corners.size() - begin; ++k) source.push_back(number + k - 2);
    }
    number += static_cast<uint32_t>(p.size() - 2);
  }
  mesh.corners = std::move(kept.corners);
  mesh.ends = std::move(kept.ends);
  return dropped;
}

// A cut of a polygon that passes a vertex twice may have them.
size_t drop_repeated_triangles(TriangleMesh& mesh, std::vector<uint32_t>& source) {
  size_t left = 0;
  for (size_t f = 0; f < source.size(); ++f) {
    const uint32_t* v = &mesh.triangles[3 * f];
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;
    std::copy_n(v, 3, &mesh.triangles[3 * left]);
    source[left++] = source[f];
  }
  const size_t dropped = source.size() - left;
  source.resize(left);
  mesh.triangles.resize(3 * left);
  return dropped;
}

// Vertices that welding has left over are not the file's fault.
size_t drop_unused(CleanMesh& c, const std::vector<uint8_t>& had_corner) {
  std::vector<uint32_t> id(c.mesh.positions.size() / 3, UINT32_MAX);
  for (const uint32_t v : c.mesh.triangles) id[v] = 0;
  uint32_t next = 0;
  size_t unused = 0;
  for (size_t v = 0; v < id.size(); ++v) {
    if (id[v] == UINT32_MAX) {
      unused += v < had_corner.size() && had_corner[v] == 0 ? 1u : 0u;
      continue;
    }
    std::copy_n(&c.mesh.positions[3 * v], 3, &c.mesh.positions[3 * size_t{next}]);
    c.vertex_source[next] = c.vertex_source[v];
    id[v] = next++;
  }
  c.mesh.positions.resize(3 * size_t{next});
  c.vertex_source.resize(next);
  for (uint32_t& v : c.mesh.triangles) v = id[v];
  for (Rim& rim : c.rims)
    for (uint32_t& v : rim) v = id[v];
  return unused;
}

// Parts fans after holes have been filled: a cover may connect what touched in its corners.
void fill_and_part(CleanMesh& c, uint64_t most_edges) {
  TriangleMesh mesh = c.mesh;
  Parted parted = part_fans(mesh);
  c.rims = rims_of(c.mesh, mesh, parted);
  if (most_edges > 0 && !c.rims.empty()) {
    const Filled filled = fill_holes(c.mesh, c.rims, most_edges);
    c.cleaning.filled = filled.holes;
    c.cleaning.added = filled.triangles;
    c.cleaning.blocked = filled.blocked;
    c.source.resize(c.mesh.triangles.size() / 3, UINT32_MAX);
    mesh = c.mesh;
    parted = part_fans(mesh);
  }
  c.cleaning.parted = parted.edges;
  c.cleaning.copied = parted.copied.size();
  for (const uint32_t v : parted.copied) c.vertex_source.push_back(v);
  for (const uint32_t f : parted.divided) c.source.push_back(c.source[f]);
  c.against = parted.against;
  std::swap(c.mesh, mesh);
  if (!parted.copied.empty()) c.joined = std::move(mesh);
}

}  // namespace

bool Cleaning::is_nothing() const {
  return tiny + welded + joined + repeated + unused + doubled + turned + parted + copied + filled == 0;
}

Status clean(const std::string& path, PolygonMesh&& polygons, const CleanOptions& options, CleanMesh& c) {
  c = CleanMesh();
  c.first_vertex = polygons.first_vertex;
  c.has_numbers = !polygons.is_soup;
  if (Status s = check_coordinates(path, polygons); !s) return s;
  std::vector<uint8_t> had_corner(polygons.positions.size() / 3);
  for (const uint32_t v : polygons.corners) had_corner[v] = 1;
  TriangleMesh places;
  places.positions = std::move(polygons.positions);
  c.cleaning.tiny = clear_tiny_coordinates(places);
  polygons.positions = std::move(places.positions);
  c.cleaning.welded =
      weld_equal(polygons, polygons.is_soup ? std::vector<uint8_t>() : vertices_of_open_parts(polygons));
  c.cleaning.joined = weld_near(polygons, options.weld);
  c.cleaning.repeated = drop_repeated_corners(polygons, c.source);
  c.cleaning.doubled = drop_doubles(polygons, c.source);
  c.mesh.triangles = cut_polygons(polygons);
  c.mesh.positions = std::move(polygons.positions);
  c.cleaning.repeated += drop_repeated_triangles(c.mesh, c.source);
  c.vertex_source.resize(c.mesh.positions.size() / 3);
  std::iota(c.vertex_source.begin(), c.vertex_source.end(), 0u);
  c.cleaning.turned = turn_facets(c.mesh);
  fill_and_part(c, options.fill);
  c.cleaning.unused = drop_unused(c, had_corner);
  return success();
}

}  // namespace tool
