// SPDX-License-Identifier: MIT
// star: a proof that the triangles at a vertex do not meet beyond shared corners and edges (paper section 3). The star
// of a vertex p is the fan of triangles (p, link[i], link[i + 1 mod n]).
#pragma once

#include "base/vec3.h"

namespace tpa {

// Cheap proof that no two triangles of p's fan meet except in shared corners and edges: seen along the sum of the fan's
// normals, all triangles turn the same way and go round p once. False means "not proven". Never proven for n < 3 or
// n > 32. Writes behind the n corners: `link` has room for star_room in all.
inline constexpr u32 star_is_unfolded_limit = 32, star_room = star_is_unfolded_limit + 1;
bool star_is_unfolded(const Vec3& p, Vec3* link, u32 n);

// The same for a fan of any size, spoke by spoke, in two rounds. A spoke is a neighbour's position less p, rounded.
struct FanNormal {  // first round
  Vec3 sum;
  f64 reach = 0;  // largest coordinate of a spoke

  void add(const Vec3& spoke, const Vec3& next);
};
class FanTurns {  // second round, with the same spokes
 public:
  explicit FanTurns(const FanNormal& normal);
  void add(const Vec3& spoke, const Vec3& next);
  bool unfolded() const { return all_up_ && changes_ == 2; }
  // Does a triangle certainly turn the same way, by less than half a round? Pre: spokes within the reach.
  bool turns_up(const Vec3& spoke, const Vec3& next) const { return dot(sum_, cross(spoke, next)) > bound_; }
  bool is_behind(const Vec3& spoke) const { return spoke[from_] * sum_[to_] < spoke[to_] * sum_[from_]; }

 private:
  Vec3 sum_;
  f64 bound_;
  int from_, to_;    // the axes that the normal leans to most
  u32 changes_ = 0;  // between both sides of a plane through the normal
  bool all_up_ = true;
};

}  // namespace tpa
