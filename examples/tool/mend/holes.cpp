// SPDX-License-Identifier: MIT
#include "tool/mend/holes.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <unordered_map>

#include "tool/mend/edges.h"
#include "tool/mend/near.h"
#include "tool/mend/triangle_tree.h"
#include "tool/scenes/points.h"

namespace tool {

namespace {

// A mesh that grows, with a tree over the triangles of some time ago.
class Obstacles {
 public:
  explicit Obstacles(TriangleMesh& mesh) : mesh_(mesh) { plant(); }

  bool meets(const Corners& f) const {
    const Box3 box = box_of(mesh_.positions, f);
    bool met = false;
    const auto ask = [&](uint32_t g) {
      const uint32_t* v = &mesh_.triangles[3 * size_t{g}];
      met = triangles_meet(mesh_.positions.data(), f, {v[0], v[1], v[2]});
      return !met;
    };
    tree_->for_each(box, ask);
    for (auto g = static_cast<uint32_t>(planted_); !met && 3 * size_t{g} < mesh_.triangles.size(); ++g) ask(g);
    return met;
  }

  void add(const std::vector<Corners>& cover) {
    for (const Corners& f : cover) mesh_.triangles.insert(mesh_.triangles.end(), f.begin(), f.end());
    constexpr size_t few = 256;
    if (mesh_.triangles.size() / 3 - planted_ > few) plant();
  }

 private:
  void plant() {
    tree_ = std::make_unique<TriangleTree>(mesh_.positions, mesh_.triangles);
    planted_ = mesh_.triangles.size() / 3;
  }

  TriangleMesh& mesh_;
  std::unique_ptr<TriangleTree> tree_;
  size_t planted_ = 0;
};

// Edges of the mesh between vertices of the rim that do not follow each other, as places in the rim.
std::vector<std::pair<uint32_t, uint32_t>> chords_taken(const Rim& rim,
                                                        const std::unordered_multimap<uint32_t, uint32_t>& neighbours) {
  std::unordered_map<uint32_t, uint32_t> place;
  for (uint32_t i = 0; i < rim.size(); ++i) place[rim[i]] = i;
  std::vector<std::pair<uint32_t, uint32_t>> taken;
  for (uint32_t i = 0; i < rim.size(); ++i) {
    const auto [first, last] = neighbours.equal_range(rim[i]);
    for (auto at = first; at != last; ++at) {
      const auto found = place.find(at->second);
      if (found == place.end() || found->second < i + 2 || found->second - i + 1 == rim.size()) continue;
      taken.emplace_back(i, found->second);
    }
  }
  return taken;
}

// Do all corners lie in a line, up to the rounding of coordinates? So a vertex on the edge of a neighbour leaves a
// hole.
bool is_slit(const std::vector<std::array<double, 3>>& loop) {
  constexpr double thin = 1e-6;  // of the length: seven digits of a float
  const auto point = [&](size_t i) { return Point{loop[i][0], loop[i][1], loop[i][2]}; };
  const auto farthest_from = [&](size_t from) {
    size_t best = from;
    for (size_t i = 0; i < loop.size(); ++i)
      if (length(point(i) - point(from)) > length(point(best) - point(from))) best = i;
    return best;
  };
  const size_t begin = farthest_from(0), end = farthest_from(begin);
  const Point way = point(end) - point(begin);
  for (size_t i = 0; i < loop.size(); ++i)
    if (!(length(cross(way, point(i) - point(begin))) <= thin * dot(way, way))) return false;
  return true;
}

std::vector<Corners> cover_of(const TriangleMesh& mesh, const Obstacles& obstacles, const Rim& rim,
                              const std::unordered_multimap<uint32_t, uint32_t>& neighbours) {
  std::vector<std::array<double, 3>> loop;
  for (const uint32_t v : rim) {
    const double* p = &mesh.positions[3 * size_t{v}];
    loop.push_back({p[0], p[1], p[2]});
  }
  const bool slit = is_slit(loop);
  const auto in_mesh = [&](const Corners& f) { return Corners{rim[f[0]], rim[f[1]], rim[f[2]]}; };
  std::vector<Corners> cover = shortest_triangulation(loop, chords_taken(rim, neighbours), [&](const Corners& f) {
    const Corners g = in_mesh(f);
    return slit || (!has_no_area(mesh.positions.data(), g) && !obstacles.meets(g));
  });
  for (Corners& f : cover) f = in_mesh(f);
  if (slit) return cover;
  for (size_t i = 0; i < cover.size(); ++i)
    for (size_t j = 0; j < i; ++j)
      if (triangles_meet(mesh.positions.data(), cover[i], cover[j])) return {};
  return cover;
}

// A rim that passes a vertex again is that of two holes with a common corner.
void add_simple_rims(const Rim& rim, std::vector<Rim>& rims) {
  std::unordered_map<uint32_t, size_t> place;
  Rim way;
  for (const uint32_t v : rim) {
    if (const auto [at, is_new] = place.try_emplace(v, way.size()); !is_new) {
      const auto begin = way.begin() + static_cast<std::ptrdiff_t>(at->second);
      rims.emplace_back(begin, way.end());
      std::for_each(begin + 1, way.end(), [&](uint32_t w) { place.erase(w); });
      way.erase(begin + 1, way.end());
      continue;
    }
    way.push_back(v);
  }
  if (!way.empty()) rims.push_back(std::move(way));
}

}  // namespace

std::vector<Rim> rims_of(const TriangleMesh& mesh, const TriangleMesh& parted, const Parted& result) {
  // The rim's side at its end; each open fan has one.
  std::unordered_map<uint32_t, uint32_t> side_to;
  for (const uint32_t side : result.open) side_to[head(parted, side)] = side;
  const auto vertices = static_cast<uint32_t>(mesh.positions.size() / 3);
  std::vector<Rim> rims;
  for (const uint32_t first : result.open) {
    Rim rim;
    uint32_t side = first;
    for (auto at = side_to.find(head(parted, side)); at != side_to.end(); at = side_to.find(tail(parted, side))) {
      side = at->second;
      const uint32_t v = head(parted, side);
      rim.push_back(v < vertices ? v : result.copied[v - vertices]);
      side_to.erase(at);
    }
    add_simple_rims(rim, rims);
  }
  return rims;
}

Filled fill_holes(TriangleMesh& mesh, std::vector<Rim>& rims, uint64_t most_edges) {
  Filled filled;
  std::vector<Rim> left;
  std::unordered_multimap<uint32_t, uint32_t> neighbours;
  std::vector<uint8_t> is_on_rim(mesh.positions.size() / 3);
  for (const Rim& rim : rims)
    for (const uint32_t v : rim) is_on_rim[v] = 1;
  const auto know = [&](const Corners& f) {
    for (size_t i = 0; i < 3; ++i)
      for (size_t j = 0; j < 3; ++j)
        if (i != j && is_on_rim[f[i]] != 0 && is_on_rim[f[j]] != 0) neighbours.emplace(f[i], f[j]);
  };
  for (size_t f = 0; f < mesh.triangles.size(); f += 3)
    know({mesh.triangles[f], mesh.triangles[f + 1], mesh.triangles[f + 2]});
  Obstacles obstacles(mesh);
  for (Rim& rim : rims) {
    std::vector<Corners> cover;
    const bool is_short = rim.size() >= 3 && rim.size() <= std::min<uint64_t>(most_edges, longest_loop);
    if (is_short) cover = cover_of(mesh, obstacles, rim, neighbours);
    if (cover.empty()) {
      filled.blocked += is_short ? 1u : 0u;
      left.push_back(std::move(rim));
      continue;
    }
    ++filled.holes;
    filled.triangles += cover.size();
    obstacles.add(cover);
    for (const Corners& f : cover) know(f);
  }
  rims = std::move(left);
  return filled;
}

std::vector<NearPair> near_pairs(const TriangleMesh& mesh, const std::vector<Rim>& rims) {
  const auto at = [&](uint32_t v) { return &mesh.positions[3 * size_t{v}]; };
  const auto distance = [&](uint32_t v, uint32_t w) {
    return std::hypot(at(v)[0] - at(w)[0], at(v)[1] - at(w)[1], at(v)[2] - at(w)[2]);
  };
  double length = 0;
  std::vector<uint32_t> vertices;
  std::unordered_multimap<uint32_t, uint32_t> beside;
  for (const Rim& rim : rims)
    for (size_t i = 0; i < rim.size(); ++i) {
      const uint32_t v = rim[i], w = rim[(i + 1) % rim.size()];
      length += distance(v, w);
      vertices.push_back(v);
      beside.emplace(v, w);
      beside.emplace(w, v);
    }
  constexpr double near = 0.01;  // of the mean edge
  const double reach = near * length / static_cast<double>(std::max<size_t>(1, vertices.size()));
  std::vector<NearPair> pairs;
  if (!(reach > 0)) return pairs;
  NearGrid grid(mesh.positions, reach);
  for (const uint32_t v : vertices) {
    NearPair best = {v, v, reach};
    grid.for_each_near(at(v), [&](uint32_t w) {
      const auto [first, last] = beside.equal_range(v);
      const bool joined = std::any_of(first, last, [&](const auto& b) { return b.second == w; });
      const double d = distance(v, w);
      if (!joined && d > 0 && d <= best.distance) best = {v, w, d};
      return true;
    });
    if (best.other != v) pairs.push_back(best);
    grid.add(v);
  }
  return pairs;
}

}  // namespace tool
