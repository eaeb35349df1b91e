// SPDX-License-Identifier: MIT
#include "tool/segment/voxel_topology.h"

#include <algorithm>
#include <numeric>

namespace tool {

namespace {

// Voxels `first` to `last` of a row along i.
struct Run {
  int first, last;
  size_t piece;
};
using Row = std::vector<Run>;

class Pieces {
 public:
  explicit Pieces(size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), size_t{0}); }
  size_t add() {
    parent_.push_back(parent_.size());
    return parent_.back();
  }
  void join(size_t a, size_t b) { parent_[root(a)] = root(b); }
  uint64_t count() const {
    uint64_t roots = 0;
    for (size_t i = 0; i < parent_.size(); ++i) roots += parent_[i] == i ? 1u : 0u;
    return roots;
  }

 private:
  size_t root(size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  std::vector<size_t> parent_;
};

Row runs_of(const uint8_t* row, int size, bool of_set, Pieces& pieces) {
  Row runs;
  for (int i = 0; i < size; ++i) {
    if ((row[i] != 0) != of_set) continue;
    if (runs.empty() || runs.back().last + 1 < i) runs.push_back({i, i, pieces.add()});
    runs.back().last = i;
  }
  return runs;
}

// Joins runs of two rows with voxels at most `apart` from each other along i.
void join_rows(const Row& a, const Row& b, int apart, Pieces& pieces) {
  for (size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    if (a[i].first <= b[j].last + apart && b[j].first <= a[i].last + apart) pieces.join(a[i].piece, b[j].piece);
    if (a[i].last < b[j].last)
      ++i;
    else
      ++j;
  }
}

// Connected parts of the set, across faces, or of all other voxels and the space round the grid, across corners.
uint64_t count_pieces(const Volume& grid, const std::vector<uint8_t>& mask, bool of_set) {
  Pieces pieces(of_set ? 0 : 1);
  std::vector<Row> before, slice(static_cast<size_t>(grid.ny));
  for (int k = 0; k < grid.nz; ++k) {
    slice.swap(before);
    slice.resize(before.size());
    for (int j = 0; j < grid.ny; ++j) {
      Row& row = slice[static_cast<size_t>(j)];
      row = runs_of(&mask[grid.index(0, j, k)], grid.nx, of_set, pieces);
      const bool at_rim = j == 0 || j + 1 == grid.ny || k == 0 || k + 1 == grid.nz;
      for (const Run& run : row)
        if (!of_set && (at_rim || run.first == 0 || run.last + 1 == grid.nx)) pieces.join(run.piece, 0);
      const int apart = of_set ? 0 : 1;
      if (j > 0) join_rows(row, slice[static_cast<size_t>(j - 1)], apart, pieces);
      for (int beside = -apart; k > 0 && beside <= apart; ++beside)
        if (j + beside >= 0 && j + beside < grid.ny)
          join_rows(row, before[static_cast<size_t>(j + beside)], apart, pieces);
    }
  }
  return pieces.count();
}

// Of the complex with a vertex for each voxel, an edge for two across a face, a square for four round an edge of the
// grid, a cube for eight round a corner.
int64_t euler_number(const Volume& grid, const std::vector<uint8_t>& mask) {
  int64_t sum = 0;
  for (int k = 0; k < grid.nz; ++k)
    for (int j = 0; j < grid.ny; ++j)
      for (int i = 0; i < grid.nx; ++i) {
        const auto has = [&](int x, int y, int z) {
          return i + x < grid.nx && j + y < grid.ny && k + z < grid.nz && mask[grid.index(i + x, j + y, k + z)] != 0;
        };
        if (!has(0, 0, 0)) continue;
        const bool x = has(1, 0, 0), y = has(0, 1, 0), z = has(0, 0, 1);
        const bool xy = x && y && has(1, 1, 0), xz = x && z && has(1, 0, 1), yz = y && z && has(0, 1, 1);
        sum += 1 - x - y - z + xy + xz + yz - (xy && xz && yz && has(1, 1, 1));
      }
  return sum;
}

}  // namespace

// Each piece but the space round the grid has one surface towards the pieces round it. The border of a body has twice
// the body's Euler number, which is 2 - 2 genus for each surface.
VoxelTopology topology_of(const Volume& grid, const std::vector<uint8_t>& mask) {
  VoxelTopology t;
  t.voxels = static_cast<uint64_t>(std::count_if(mask.begin(), mask.end(), [](uint8_t of_set) { return of_set != 0; }));
  t.surfaces = count_pieces(grid, mask, true) + count_pieces(grid, mask, false) - 1;
  t.genus = static_cast<int64_t>(t.surfaces) - euler_number(grid, mask);
  return t;
}

bool NoiseRange::is_sure() const {
  const auto is_same = [&](const VoxelTopology& t) { return t.genus == object.genus && t.surfaces == object.surfaces; };
  return is_same(surest) && is_same(uncertain);
}

NoiseRange topology_within_noise(const Volume& volume, const Threshold& threshold, const Object& object, double noise) {
  NoiseRange range;
  range.shift = deviations_near * noise;
  range.object = range.surest = range.uncertain = topology_of(volume, object.mask);
  if (noise <= 0) return range;
  std::vector<uint8_t> surest(object.mask), uncertain(object.mask);
  for (int k = 0; k < volume.nz; ++k)
    for (int j = 0; j < volume.ny; ++j)
      for (int i = 0; i < volume.nx; ++i) {
        const size_t id = volume.index(i, j, k);
        const double depth = threshold.depth(static_cast<double>(volume.values[id]));
        if (object.mask[id] != 0) {
          surest[id] = depth > range.shift ? 1 : 0;
          continue;
        }
        bool is_beside = false;
        for_each_face_neighbour(volume, {i, j, k}, [&](const Index& v) {
          is_beside = is_beside || object.mask[volume.index(v.i, v.j, v.k)] != 0;
        });
        uncertain[id] = is_beside && depth > -range.shift ? 1 : 0;
      }
  range.surest = topology_of(volume, surest);
  range.uncertain = topology_of(volume, uncertain);
  return range;
}

}  // namespace tool
