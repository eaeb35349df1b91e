// kd_tree: points by where they are, for searches among the near ones first. A balanced k-d tree (Bentley 1975) in
// an array of their numbers: the middle of a range divides it along one axis, the next ranges along the next axis.
#pragma once

#include "base/vec3.h"

namespace tpa {

struct PointTree {
  const Vec3* point = nullptr;
  u32* order = nullptr;  // of the numbers 0 .. count - 1
  u32 count = 0;
};

// O(count log^2 count); fills in the order, which has `count` elements.
void build(PointTree& t);

namespace point_tree_detail {
struct Visitor {
  void (*visit)(const void* caller, u32 number);
  const void* caller;
};
void search(const PointTree& t, const Vec3& p, const f64& squared_reach, const Visitor& visitor);
}  // namespace point_tree_detail

// visit(number) for each point no farther from p than the root of `squared_reach`, which the caller may make less on
// the way; roughly from near to far.
template <class Visit>
void for_each_near(const PointTree& t, const Vec3& p, const f64& squared_reach, const Visit& visit) {
  const auto call = [](const void* caller, u32 number) { (*static_cast<const Visit*>(caller))(number); };
  point_tree_detail::search(t, p, squared_reach, {call, &visit});
}

}  // namespace tpa
