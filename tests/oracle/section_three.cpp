// SPDX-License-Identifier: MIT
#include "oracle/section_three.h"

#include <array>
#include <cmath>
#include <map>
#include <set>

namespace support {

Pairs PairsBySectionThree(const Mesh& m, double l, const std::function<bool(uint32_t, uint32_t)>& meet) {
  std::map<std::array<double, 3>, std::vector<uint32_t>> table;
  for (uint32_t v = 0; v < VertexCount(m); ++v) {
    const Point p = PositionOf(m, v);
    table[{std::floor(p[0] / l), std::floor(p[1] / l), std::floor(p[2] / l)}].push_back(v);
  }
  std::map<uint32_t, std::set<uint32_t>> neighbours, triangles;
  for (uint32_t f = 0; f < TriangleCount(m); ++f)
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t a = m.triangles[3 * f + i], b = m.triangles[3 * f + (i + 1) % 3];
      neighbours[a].insert(b);
      neighbours[b].insert(a);
      triangles[a].insert(f);
    }
  std::set<std::pair<uint32_t, uint32_t>> pairs;
  for (const auto& [unused, slot] : table) {
    std::map<uint32_t, uint32_t> component;
    for (uint32_t seed : slot) {
      if (component.count(seed) != 0) continue;
      std::vector<uint32_t> queue = {seed};
      component[seed] = seed;
      while (!queue.empty()) {
        const uint32_t v = queue.back();
        queue.pop_back();
        for (uint32_t w : slot)
          if (component.count(w) == 0 && neighbours[v].count(w) != 0) {
            component[w] = seed;
            queue.push_back(w);
          }
      }
    }
    for (uint32_t v : slot)
      for (uint32_t w : slot)
        if (component[v] != component[w])
          for (uint32_t f : triangles[v])
            for (uint32_t g : triangles[w])
              if (f < g && meet(f, g)) pairs.emplace(f, g);
  }
  return {pairs.begin(), pairs.end()};
}

}  // namespace support
