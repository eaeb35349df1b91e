// SPDX-License-Identifier: MIT
// plates: one layer of boxes with holes between them, each tunnel and each bar of a known size.
#pragma once

#include <map>
#include <string>

#include "support/mesh_building.h"

namespace support {

// A box for each 'x' in a row of `cells`, between the planes x[i] and x[i + 1], y[j] and y[j + 1], 0 and `height`.
// Boxes that share an edge alone make no manifold.
inline Mesh Plate(const std::vector<std::string>& cells, const std::vector<double>& x, const std::vector<double>& y,
                  double height) {
  Mesh m;
  std::map<std::array<size_t, 3>, size_t> number;
  const auto at = [&](size_t i, size_t j, size_t k) {
    const auto [place, added] = number.emplace(std::array<size_t, 3>{i, j, k}, number.size());
    if (added) AddVertex(m, {x[i], y[j], k == 0 ? 0 : height});
    return place->second;
  };
  const auto solid = [&](size_t i, size_t j) { return j < cells.size() && i < cells[j].size() && cells[j][i] == 'x'; };
  for (size_t j = 0; j < cells.size(); ++j)
    for (size_t i = 0; i < cells[j].size(); ++i) {
      if (!solid(i, j)) continue;
      AddQuad(m, at(i, j, 1), at(i + 1, j, 1), at(i + 1, j + 1, 1), at(i, j + 1, 1));
      AddQuad(m, at(i, j, 0), at(i, j + 1, 0), at(i + 1, j + 1, 0), at(i + 1, j, 0));
      if (!solid(i - 1, j)) AddQuad(m, at(i, j, 0), at(i, j, 1), at(i, j + 1, 1), at(i, j + 1, 0));
      if (!solid(i + 1, j)) AddQuad(m, at(i + 1, j, 0), at(i + 1, j + 1, 0), at(i + 1, j + 1, 1), at(i + 1, j, 1));
      if (!solid(i, j - 1)) AddQuad(m, at(i, j, 0), at(i + 1, j, 0), at(i + 1, j, 1), at(i, j, 1));
      if (!solid(i, j + 1)) AddQuad(m, at(i, j + 1, 0), at(i, j + 1, 1), at(i + 1, j + 1, 1), at(i + 1, j + 1, 0));
    }
  return m;
}

// A square hole of side `hole` between bars of this width.
inline Mesh Frame(double hole, double bar, double height) {
  const std::vector<double> planes{0, bar, bar + hole, 2 * bar + hole};
  return Plate({"xxx", "x x", "xxx"}, planes, planes, height);
}

}  // namespace support
