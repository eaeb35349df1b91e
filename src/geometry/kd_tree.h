// SPDX-License-Identifier: MIT
// kd_tree: a balanced k-d tree of points (Bentley 1975), for searches that look at near points first. The tree is an
// array of the points' numbers: the middle of a range divides the range along an axis, and both parts are divided along
// the next axis.
#pragma once

#include "base/vec3.h"

namespace tpa {

struct KdTree {
  const Vec3* point = nullptr;
  u32* order = nullptr;  // of the numbers 0 .. count - 1
  u32 count = 0;
};

// Fills in the order, an array of `count` elements. O(count log^2 count).
void build(KdTree& t);

namespace point_tree_detail {
struct PointVisitor {
  void (*visit)(const void* caller, u32 number);
  const void* caller;
};
void search(const KdTree& t, const Vec3& p, const f64& squared_reach, const PointVisitor& visitor);
}  // namespace point_tree_detail

// visit(number) for each point no farther from p than the root of `squared_reach`, roughly from near to far. The
// visitor may reduce `squared_reach` on the way.
template <class Visit>
void for_each_near(const KdTree& t, const Vec3& p, const f64& squared_reach, const Visit& visit) {
  const auto call = [](const void* caller, u32 number) { (*static_cast<const Visit*>(caller))(number); };
  point_tree_detail::search(t, p, squared_reach, {call, &visit});
}

}  // namespace tpa
