// SPDX-License-Identifier: MIT
#include "tool/mend/triangle_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace tool {

namespace {

constexpr uint32_t most_in_leaf = 8;

Box3 no_box() {
  constexpr double far = std::numeric_limits<double>::infinity();
  return {{far, far, far}, {-far, -far, -far}};
}

void widen(Box3& box, const Box3& by) {
  for (size_t i = 0; i < 3; ++i) {
    box.low[i] = std::min(box.low[i], by.low[i]);
    box.high[i] = std::max(box.high[i], by.high[i]);
  }
}

size_t longest_axis(const Box3& box) {
  size_t axis = 0;
  for (size_t i = 1; i < 3; ++i)
    if (box.high[i] - box.low[i] > box.high[axis] - box.low[axis]) axis = i;
  return axis;
}

}  // namespace

Box3 box_of(const std::vector<double>& positions, const Corners& triangle) {
  Box3 box = no_box();
  for (const uint32_t v : triangle) {
    const double* p = &positions[3 * size_t{v}];
    widen(box, {{p[0], p[1], p[2]}, {p[0], p[1], p[2]}});
  }
  return box;
}

TriangleTree::TriangleTree(const std::vector<double>& positions, const std::vector<uint32_t>& triangles) {
  const auto count = static_cast<uint32_t>(triangles.size() / 3);
  if (count == 0) return;
  for (size_t f = 0; f < triangles.size(); f += 3)
    boxes_.push_back(box_of(positions, {triangles[f], triangles[f + 1], triangles[f + 2]}));
  order_.resize(count);
  std::iota(order_.begin(), order_.end(), 0u);
  nodes_.push_back({no_box(), 0, count});
  for (size_t at = 0; at < nodes_.size(); ++at) {
    Node node = nodes_[at];
    for (uint32_t i = 0; i < node.count; ++i) widen(node.box, boxes_[order_[node.first + i]]);
    nodes_[at].box = node.box;
    if (node.count <= most_in_leaf) continue;
    const size_t axis = longest_axis(node.box);
    const auto begin = order_.begin() + node.first;
    const uint32_t half = node.count / 2;
    std::nth_element(begin, begin + half, begin + node.count, [&](uint32_t a, uint32_t b) {
      const double x = boxes_[a].low[axis] + boxes_[a].high[axis], y = boxes_[b].low[axis] + boxes_[b].high[axis];
      return x != y ? x < y : a < b;
    });
    nodes_[at].first = static_cast<uint32_t>(nodes_.size());
    nodes_[at].count = 0;
    nodes_.push_back({no_box(), node.first, half});
    nodes_.push_back({no_box(), node.first + half, node.count - half});
  }
}

}  // namespace tool
