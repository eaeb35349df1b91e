// SPDX-License-Identifier: MIT
#include "tool/segment/filling.h"

#include <algorithm>
#include <cmath>

namespace tool {

namespace {

// A triangle over a row of voxels along x.
struct Crossing {
  uint64_t row;  // j + ny * k
  double at;     // x
  int turn;      // of the winding number on the way up
};

// Twice the area of (a, b, p) in the plane of j and k, with the same magnitude for (b, a, p), and never zero: a row
// through an edge lies on one side of the edge, whichever of its triangles asks.
struct Side {
  double area;
  bool left;
};

Side side_of(const Point& a, const Point& b, double y, double z) {
  const bool turned = b < a;
  const Point &p = turned ? b : a, &q = turned ? a : b;
  const double area = (q[1] - p[1]) * (z - p[2]) - (q[2] - p[2]) * (y - p[1]);
  return {turned ? -area : area, (area >= 0) != turned};
}

void cross_rows(const Volume& volume, const Point (&p)[3], std::vector<Crossing>& crossings) {
  const auto first = [](double least) { return std::max(0.0, std::ceil(least)); };
  const auto last = [](double most, int size) { return std::min(size - 1.0, std::floor(most)); };
  const auto [low_y, high_y] = std::minmax({p[0][1], p[1][1], p[2][1]});
  const auto [low_z, high_z] = std::minmax({p[0][2], p[1][2], p[2][2]});
  for (double z = first(low_z); z <= last(high_z, volume.nz); ++z)
    for (double y = first(low_y); y <= last(high_y, volume.ny); ++y) {
      const Side s[3] = {side_of(p[1], p[2], y, z), side_of(p[2], p[0], y, z), side_of(p[0], p[1], y, z)};
      if (s[0].left != s[1].left || s[1].left != s[2].left) continue;
      const double sum = s[0].area + s[1].area + s[2].area;
      const double x = sum != 0 ? (s[0].area * p[0][0] + s[1].area * p[1][0] + s[2].area * p[2][0]) / sum : p[0][0];
      const uint64_t row = static_cast<uint64_t>(z) * static_cast<uint64_t>(volume.ny) + static_cast<uint64_t>(y);
      crossings.push_back({row, x, s[0].left ? -1 : 1});
    }
}

std::vector<Crossing> crossings_of(const Volume& volume, const TriangleMesh& mesh) {
  const Affine to_index = inverse(volume.to_world);
  const int mirrored = determinant(volume.to_world) < 0 ? -1 : 1;
  std::vector<Crossing> crossings;
  for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
    Point p[3];
    for (size_t c = 0; c < 3; ++c) {
      const double* at = &mesh.positions[3 * size_t{mesh.triangles[t + c]}];
      p[c] = to_index({at[0], at[1], at[2]});
    }
    cross_rows(volume, p, crossings);
  }
  for (Crossing& c : crossings) c.turn *= mirrored;
  std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
    if (a.row != b.row) return a.row < b.row;
    return a.at != b.at ? a.at < b.at : a.turn < b.turn;
  });
  return crossings;
}

constexpr uint8_t of_object = 1, enclosed = 2, is_close = 4;

// The nearest point of a triangle by the regions of its plane (Ericson 2005, 5.1.5), as distance from p.
double distance_to_triangle(const Point& p, const Point (&t)[3]) {
  const Point ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0], bp = p - t[1], cp = p - t[2];
  const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp),
               d6 = dot(ac, cp);
  if (d1 <= 0 && d2 <= 0) return length(ap);
  if (d3 >= 0 && d4 <= d3) return length(bp);
  if (d6 >= 0 && d5 <= d6) return length(cp);
  const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return length(ap - d1 / (d1 - d3) * ab);
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return length(ap - d2 / (d2 - d6) * ac);
  if (va <= 0 && d4 >= d3 && d5 >= d6) return length(bp - (d4 - d3) / (d4 - d3 + d5 - d6) * (t[2] - t[1]));
  const double sum = va + vb + vc;
  return length(ap - vb / sum * ab - vc / sum * ac);
}

// Calls take(id, away) for each voxel with wants(id) whose centre is `away` from a triangle, in mm, at most `reach`.
template <class Wants, class Take>
void for_each_voxel_near(const Volume& volume, const TriangleMesh& mesh, double reach, Wants wants, Take take) {
  const Affine to_index = inverse(volume.to_world);
  const int size[3] = {volume.nx, volume.ny, volume.nz};
  for (size_t t = 0; reach > 0 && t < mesh.triangles.size(); t += 3) {
    Point p[3], at[3];
    for (size_t c = 0; c < 3; ++c) {
      std::copy_n(&mesh.positions[3 * size_t{mesh.triangles[t + c]}], 3, p[c].begin());
      at[c] = to_index(p[c]);
    }
    int low[3], high[3];
    for (size_t k = 0; k < 3; ++k) {
      // The k-th index grows fastest along the gradient of the map.
      const double wide = reach * length({to_index.axes[0][k], to_index.axes[1][k], to_index.axes[2][k]});
      const auto [least, most] = std::minmax({at[0][k], at[1][k], at[2][k]});
      low[k] = static_cast<int>(std::clamp(std::ceil(least - wide), 0.0, double(size[k])));
      high[k] = static_cast<int>(std::clamp(std::floor(most + wide), -1.0, double(size[k] - 1)));
    }
    for (int k = low[2]; k <= high[2]; ++k)
      for (int j = low[1]; j <= high[1]; ++j)
        for (int i = low[0]; i <= high[0]; ++i) {
          const size_t id = volume.index(i, j, k);
          if (!wants(id)) continue;
          const double away = distance_to_triangle(volume.to_world({double(i), double(j), double(k)}), p);
          if (away <= reach) take(id, away);
        }
  }
}

// Marks the voxels near the mesh that are left out, or enclosed and not of the object.
void mark_close(const Volume& volume, const TriangleMesh& mesh, double reach, std::vector<uint8_t>& mask) {
  for_each_voxel_near(
      volume, mesh, reach, [&](size_t id) { return mask[id] == of_object || mask[id] == enclosed; },
      [&](size_t id, double) { mask[id] |= is_close; });
}

// Adds `enclosed` to the voxels inside the mesh.
void mark_enclosed(const Volume& volume, const std::vector<Crossing>& crossings, std::vector<uint8_t>& mask) {
  int winding = 0;
  for (size_t c = 0; c < crossings.size(); ++c) {
    if (c == 0 || crossings[c].row != crossings[c - 1].row) winding = 0;
    winding += crossings[c].turn;
    if (winding < 1 || c + 1 == crossings.size() || crossings[c + 1].row != crossings[c].row) continue;
    const int first = static_cast<int>(std::clamp(std::ceil(crossings[c].at), 0.0, static_cast<double>(volume.nx)));
    const int end = static_cast<int>(std::clamp(std::ceil(crossings[c + 1].at), 0.0, static_cast<double>(volume.nx)));
    uint8_t* row = mask.data() + crossings[c].row * static_cast<uint64_t>(volume.nx);
    for (int i = first; i < end; ++i) row[i] |= enclosed;
  }
}

Piece piece_of(const Volume& volume, const std::vector<Index>& voxels) {
  Point middle{};
  for (const Index& v : voxels) middle = middle + Point{double(v.i), double(v.j), double(v.k)};
  middle = 1.0 / static_cast<double>(voxels.size()) * middle;
  Piece piece{voxels.size(), voxels[0], {}};
  double least = 1e300;
  for (const Index& v : voxels) {
    const double away = std::hypot(v.i - middle[0], v.j - middle[1], v.k - middle[2]);
    if (away < least) {
      least = away;
      piece.voxel = v;
    }
  }
  piece.world = volume.in_file(volume.to_world({double(piece.voxel.i), double(piece.voxel.j), double(piece.voxel.k)}));
  return piece;
}

// The connected pieces of the voxels with is_of(id, flags), which are marked as visited by flags 0xFF.
template <class IsOf>
std::vector<Piece> largest_pieces(const Volume& volume, std::vector<uint8_t>& mask, IsOf is_of) {
  std::vector<Piece> pieces;
  for (int k = 0; k < volume.nz; ++k)
    for (int j = 0; j < volume.ny; ++j)
      for (int i = 0; i < volume.nx; ++i) {
        const size_t id = volume.index(i, j, k);
        if (!is_of(id, mask[id])) continue;
        std::vector<Index> voxels;
        flood(volume, {i, j, k}, [&](const Index& v) {
          const size_t at = volume.index(v.i, v.j, v.k);
          const bool taken = is_of(at, mask[at]);
          if (taken) {
            mask[at] = 0xFF;
            voxels.push_back(v);
          }
          return taken;
        });
        pieces.push_back(piece_of(volume, voxels));
      }
  std::stable_sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.voxels > b.voxels; });
  if (pieces.size() > most_pieces) pieces.resize(most_pieces);
  return pieces;
}

}  // namespace

std::vector<uint8_t> enclosed_voxels(const Volume& volume, const TriangleMesh& mesh) {
  std::vector<uint8_t> mask(volume.voxels(), 0);
  mark_enclosed(volume, crossings_of(volume, mesh), mask);
  for (uint8_t& flags : mask) flags = flags == enclosed ? 1 : 0;
  return mask;
}

double reach_of_edges(const Volume& volume, double edge_length) {
  constexpr double least_share = 0.25;
  return std::max(least_share * mean_side(volume), reach_of_edge * edge_length);
}

std::vector<float> distances_left_out(const Volume& volume, const Object& object, const TriangleMesh& mesh,
                                      double reach) {
  // A centre on the surface is away from it, if by nothing.
  constexpr float least = 1e-30f;
  std::vector<uint8_t> mask = object.mask;
  mark_enclosed(volume, crossings_of(volume, mesh), mask);
  std::vector<float> distances(mask.size());
  for (size_t id = 0; id < mask.size(); ++id) distances[id] = mask[id] == of_object ? INFINITY : 0;
  for_each_voxel_near(
      volume, mesh, reach, [&](size_t id) { return distances[id] != 0; },
      [&](size_t id, double away) {
        distances[id] = std::min(distances[id], std::max(least, static_cast<float>(away)));
      });
  return distances;
}

Filling compare(const Volume& volume, const Threshold& threshold, const Object& object, const TriangleMesh& mesh,
                double reach) {
  std::vector<uint8_t> mask = object.mask;
  mark_enclosed(volume, crossings_of(volume, mesh), mask);
  mark_close(volume, mesh, reach, mask);
  const auto is_foreign = [&](size_t id, uint8_t flags) {
    return (flags & (enclosed | of_object)) == enclosed && threshold.depth(static_cast<double>(volume.values[id])) > 0;
  };
  Filling filling;
  filling.object = object.voxels;
  for (size_t id = 0; id < mask.size(); ++id) {
    filling.inside += mask[id] == (of_object | enclosed) ? 1u : 0u;
    filling.near += mask[id] == (of_object | is_close) ? 1u : 0u;
    filling.rim += mask[id] == (enclosed | is_close) ? 1u : 0u;
    filling.beyond += mask[id] == enclosed ? 1u : 0u;
    filling.foreign += is_foreign(id, mask[id]) ? 1u : 0u;
  }
  filling.left_out = largest_pieces(volume, mask, [](size_t, uint8_t flags) { return flags == of_object; });
  filling.neighbours = largest_pieces(volume, mask, is_foreign);
  filling.leaks = largest_pieces(volume, mask, [](size_t, uint8_t flags) { return flags == enclosed; });
  return filling;
}

}  // namespace tool
