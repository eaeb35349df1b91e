// SPDX-License-Identifier: MIT
// triangle_tree: a tree of boxes over the triangles of any soup.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tool/mend/exact.h"

namespace tool {

struct Box3 {
  std::array<double, 3> low, high;
};

inline bool boxes_meet(const Box3& a, const Box3& b) {
  for (size_t i = 0; i < 3; ++i)
    if (a.low[i] > b.high[i] || b.low[i] > a.high[i]) return false;
  return true;
}

Box3 box_of(const std::vector<double>& positions, const Corners& triangle);

class TriangleTree {
 public:
  // Both stay with the caller. O(n log n).
  TriangleTree(const std::vector<double>& positions, const std::vector<uint32_t>& triangles);

  // Calls visit(triangle) for each triangle whose box meets the box, in no certain order; false ends the search.
  template <class Visit>
  void for_each(const Box3& box, Visit visit) const {
    std::vector<uint32_t> ahead;
    if (!nodes_.empty()) ahead.push_back(0);
    while (!ahead.empty()) {
      const Node& node = nodes_[ahead.back()];
      ahead.pop_back();
      if (!boxes_meet(node.box, box)) continue;
      if (node.count == 0) {
        ahead.insert(ahead.end(), {node.first, node.first + 1});
        continue;
      }
      for (uint32_t i = 0; i < node.count; ++i)
        if (boxes_meet(boxes_[order_[node.first + i]], box) && !visit(order_[node.first + i])) return;
    }
  }

  const Box3& box(uint32_t triangle) const { return boxes_[triangle]; }

 private:
  struct Node {
    Box3 box;
    uint32_t first = 0, count = 0;  // children first and first + 1 without a count, else places in order_
  };

  std::vector<Box3> boxes_;      // of each triangle
  std::vector<uint32_t> order_;  // triangles, leaf by leaf
  std::vector<Node> nodes_;
};

}  // namespace tool
