// SPDX-License-Identifier: MIT
#include "tool/segment/mask_surface.h"

#include <algorithm>
#include <array>
#include <unordered_map>
#include <utility>

#include "tool/topology.h"

namespace tool {

namespace {

using Place = std::array<int, 3>;  // a voxel, from -1 to its grid's size

struct Builder {
  const Volume& grid;
  const std::vector<uint8_t>& mask;
  TriangleMesh mesh;                               // in voxels
  std::unordered_map<uint64_t, uint32_t> middles;  // vertices by edges

  bool is_inside(const Place& p) const {
    const int size[3] = {grid.nx, grid.ny, grid.nz};
    for (size_t k = 0; k < 3; ++k)
      if (p[k] < 0 || p[k] >= size[k]) return false;
    return mask[grid.index(p[0], p[1], p[2])] != 0;
  }

  // Of an edge whose ends differ by 0 or 1 along each axis.
  uint32_t middle(Place a, Place b) {
    if (b < a) std::swap(a, b);
    uint64_t key = 0;
    const int size[3] = {grid.nx, grid.ny, grid.nz};
    for (size_t k = 3; k-- > 0;) key = key * static_cast<uint64_t>(size[k] + 2) + static_cast<uint64_t>(a[k] + 1);
    for (size_t k = 0; k < 3; ++k) key = 2 * key + static_cast<uint64_t>(b[k] - a[k]);
    const auto [known, is_new] = middles.try_emplace(key, static_cast<uint32_t>(mesh.positions.size() / 3));
    if (is_new)
      for (size_t k = 0; k < 3; ++k) mesh.positions.push_back(0.5 * (a[k] + b[k]));
    return known->second;
  }

  // Seen from `out` anticlockwise, as far as that lies on the outside.
  void add(uint32_t a, uint32_t b, uint32_t c, const Point& out) {
    const auto at = [&](uint32_t v) {
      return Point{mesh.positions[3 * size_t{v}], mesh.positions[3 * size_t{v} + 1], mesh.positions[3 * size_t{v} + 2]};
    };
    const bool turned = dot(cross(at(b) - at(a), at(c) - at(a)), out) < 0;
    for (const uint32_t v : {a, turned ? c : b, turned ? b : c}) mesh.triangles.push_back(v);
  }

  void march(const std::array<Place, 4>& corners) {
    std::vector<Place> in, out;
    Point outwards{};
    for (const Place& p : corners) {
      (is_inside(p) ? in : out).push_back(p);
    }
    if (in.empty() || out.empty()) return;
    for (size_t k = 0; k < 3; ++k) {
      for (const Place& p : out) outwards[k] += double(p[k]) / static_cast<double>(out.size());
      for (const Place& p : in) outwards[k] -= double(p[k]) / static_cast<double>(in.size());
    }
    if (in.size() == 2) {
      const uint32_t ac = middle(in[0], out[0]), ad = middle(in[0], out[1]);
      const uint32_t bd = middle(in[1], out[1]), bc = middle(in[1], out[0]);
      add(ac, ad, bd, outwards);
      add(ac, bd, bc, outwards);
      return;
    }
    const bool single_in = in.size() == 1;
    const Place& apex = single_in ? in[0] : out[0];
    const std::vector<Place>& others = single_in ? out : in;
    add(middle(apex, others[0]), middle(apex, others[1]), middle(apex, others[2]), outwards);
  }

  // The cube from `p` upwards.
  void march_cube(const Place& p) {
    bool any = false, all = true;
    for (int corner = 0; corner < 8; ++corner) {
      const bool inside = is_inside({p[0] + (corner & 1), p[1] + (corner >> 1 & 1), p[2] + (corner >> 2)});
      any = any || inside;
      all = all && inside;
    }
    if (!any || all) return;
    constexpr size_t orders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    for (const auto& order : orders) {
      std::array<Place, 4> corners{p, p, p, p};
      for (size_t k = 0; k < 3; ++k)
        for (size_t c = k + 1; c < 4; ++c) ++corners[c][order[k]];
      march(corners);
    }
  }
};

}  // namespace

TriangleMesh mask_surface(const Volume& grid, const std::vector<uint8_t>& mask) {
  Builder b{grid, mask, {}, {}};
  for (int k = -1; k < grid.nz; ++k)
    for (int j = -1; j < grid.ny; ++j)
      for (int i = -1; i < grid.nx; ++i) b.march_cube({i, j, k});
  for (size_t v = 0; v < b.mesh.positions.size(); v += 3) {
    double* p = &b.mesh.positions[v];
    const Point at = grid.to_world({p[0], p[1], p[2]});
    std::copy(at.begin(), at.end(), p);
  }
  if (determinant(grid.to_world) < 0) turn_round(b.mesh);
  return std::move(b.mesh);
}

}  // namespace tool
