// SPDX-License-Identifier: MIT
#include "tool/io/polygon_mesh.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include <unordered_set>

#include "tool/io/polygon.h"

namespace tool {

namespace {

using PositionBits = std::array<uint64_t, 3>;

struct HashPosition {
  size_t operator()(const PositionBits& bits) const {
    uint64_t hash = 0;
    for (const uint64_t word : bits) {
      hash = (hash ^ word) * 0x9E3779B97F4A7C15u;
      hash ^= hash >> 32;
    }
    return static_cast<size_t>(hash);
  }
};

uint64_t edge_of(uint32_t a, uint32_t b) { return uint64_t{std::min(a, b)} << 32 | std::max(a, b); }

using Edges = std::unordered_set<uint64_t>;

std::vector<double> places_of(const PolygonMesh& mesh, std::span<const uint32_t> polygon) {
  std::vector<double> places;
  for (const uint32_t v : polygon)
    places.insert(places.end(), &mesh.positions[3 * size_t{v}], &mesh.positions[3 * size_t{v}] + 3);
  return places;
}

// The diagonals of a cut: sides of its triangles that are no sides of the polygon.
template <class Visit>
void for_each_diagonal(std::span<const uint32_t> cut, size_t n, Visit visit) {
  for (size_t i = 0; i < cut.size(); ++i) {
    const uint32_t a = cut[i], b = cut[i % 3 == 2 ? i - 2 : i + 1];
    if (a < b && b - a > 1 && b - a + 1 != n) visit(a, b);
  }
}

// The order in which polygons choose: dented ones before others, small ones first.
std::vector<size_t> order_of_choice(const PolygonMesh& mesh) {
  std::vector<std::pair<size_t, size_t>> keyed;
  for (size_t i = 0; i < mesh.polygons(); ++i) {
    const size_t n = mesh.polygon(i).size();
    if (n > 3)
      keyed.emplace_back(2 * n + (is_convex(places_of(mesh, mesh.polygon(i))) ? 2 * mesh.corners.size() : 0), i);
  }
  std::sort(keyed.begin(), keyed.end());
  std::vector<size_t> order;
  order.reserve(keyed.size());
  for (const auto& [key, i] : keyed) order.push_back(i);
  return order;
}

void cut_polygon(const PolygonMesh& mesh, size_t i, Edges& edges, std::vector<uint32_t>& cut) {
  const std::span<const uint32_t> polygon = mesh.polygon(i);
  const std::vector<double> places = places_of(mesh, polygon);
  const size_t n = polygon.size();
  triangulate(places, cut);
  bool taken = false;
  const auto edge = [&](uint32_t a, uint32_t b) { return edge_of(polygon[a], polygon[b]); };
  for_each_diagonal(cut, n, [&](uint32_t a, uint32_t b) { taken = taken || edges.count(edge(a, b)) != 0; });
  if (taken)
    triangulate_around(
        places, [&](uint32_t a, uint32_t b) { return edges.count(edge(a, b)) != 0; }, cut);
  for_each_diagonal(cut, n, [&](uint32_t a, uint32_t b) { edges.insert(edge(a, b)); });
}

}  // namespace

std::vector<uint32_t> cut_polygons(const PolygonMesh& mesh) {
  const std::vector<size_t> order = order_of_choice(mesh);
  std::vector<std::vector<uint32_t>> cuts(mesh.polygons());
  Edges edges;
  if (!order.empty())
    for (size_t i = 0; i < mesh.polygons(); ++i) {
      const std::span<const uint32_t> p = mesh.polygon(i);
      for (size_t k = 0; k < p.size(); ++k) edges.insert(edge_of(p[k], p[(k + 1) % p.size()]));
    }
  for (const size_t i : order) cut_polygon(mesh, i, edges, cuts[i]);
  std::vector<uint32_t> triangles;
  for (size_t i = 0; i < mesh.polygons(); ++i) {
    const std::span<const uint32_t> p = mesh.polygon(i);
    if (p.size() == 3) triangles.insert(triangles.end(), p.begin(), p.end());
    for (const uint32_t corner : cuts[i]) triangles.push_back(p[corner]);
  }
  return triangles;
}

Status add_polygon(const std::string& place, const std::vector<int64_t>& corners, PolygonMesh& mesh) {
  const int64_t vertices = static_cast<int64_t>(mesh.positions.size() / 3);
  if (corners.size() < 3) return failure(place, " has ", corners.size(), " corners");
  const size_t begin = mesh.corners.size();
  for (const int64_t corner : corners) {
    if (!(corner >= 0 && corner < vertices && corner < int64_t{UINT32_MAX}))
      return failure(place, ": index ", corner + mesh.first_vertex, " is out of range for ", vertices, " vertices");
    const auto vertex = static_cast<uint32_t>(corner);
    if (corners.size() == 3 || mesh.corners.size() == begin || mesh.corners.back() != vertex)
      mesh.corners.push_back(vertex);
  }
  while (mesh.corners.size() > begin + 3 && mesh.corners[begin] == mesh.corners.back()) mesh.corners.pop_back();
  // A polygon of one or two different corners stays a triangle with a corner twice.
  while (mesh.corners.size() < begin + 3) mesh.corners.push_back(mesh.corners.back());
  mesh.ends.push_back(mesh.corners.size());
  return success();
}

Status add_polygons(const std::string& place, const std::vector<double>& corners, const std::vector<double>& ends,
                    PolygonMesh& mesh) {
  const size_t count = ends.empty() ? corners.size() / 3 : ends.size();
  std::vector<int64_t> polygon;
  size_t at = 0;
  for (size_t i = 0; i < count; ++i) {
    const std::string name = text_of(place, ": polygon ", i);
    const double end = ends.empty() ? 3.0 * static_cast<double>(i + 1) : ends[i];
    if (!(end >= static_cast<double>(at) && end <= static_cast<double>(corners.size())))
      return failure(name, " ends at corner ", end, " of ", corners.size());
    polygon.clear();
    // Beyond 2^53 a number is no vertex of any mesh, nor is a number that is not whole.
    for (; static_cast<double>(at) < end; ++at)
      polygon.push_back(std::fabs(corners[at]) < 0x1p53 && corners[at] == std::floor(corners[at])
                            ? static_cast<int64_t>(corners[at])
                            : -1);
    if (Status status = add_polygon(name, polygon, mesh); !status) return status;
  }
  return success();
}

size_t weld_equal(PolygonMesh& mesh, const std::vector<uint8_t>& may_join) {
  const size_t vertices = mesh.positions.size() / 3;
  std::vector<uint8_t> used(vertices);
  for (const uint32_t v : mesh.corners) used[v] = 1;
  std::vector<uint32_t> first(vertices);
  std::iota(first.begin(), first.end(), 0u);
  std::unordered_map<PositionBits, uint32_t, HashPosition> known;
  size_t welded = 0;
  for (uint32_t v = 0; v < vertices; ++v) {
    if (used[v] == 0 || (!may_join.empty() && may_join[v] == 0)) continue;
    PositionBits bits;
    for (size_t axis = 0; axis < 3; ++axis)
      bits[axis] = std::bit_cast<uint64_t>(mesh.positions[3 * size_t{v} + axis] + 0.0);  // -0 is 0
    first[v] = known.try_emplace(bits, v).first->second;
    welded += first[v] != v ? 1u : 0u;
  }
  if (welded > 0)
    for (uint32_t& v : mesh.corners) v = first[v];
  return welded;
}

size_t drop_unused_vertices(PolygonMesh& mesh) {
  const size_t vertices = mesh.positions.size() / 3;
  std::vector<uint32_t> id(vertices, UINT32_MAX);
  for (const uint32_t v : mesh.corners) id[v] = 0;
  uint32_t next = 0;
  for (size_t v = 0; v < vertices; ++v) {
    if (id[v] == UINT32_MAX) continue;
    std::copy_n(&mesh.positions[3 * v], 3, &mesh.positions[3 * size_t{next}]);
    id[v] = next++;
  }
  mesh.positions.resize(3 * size_t{next});
  for (uint32_t& v : mesh.corners) v = id[v];
  return vertices - next;
}

}  // namespace tool
