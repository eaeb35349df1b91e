// SPDX-License-Identifier: MIT
// handle_oracle: counts and lists handles of least sum of squares on its own, without the library.
//
// Shrink the polygons of a handle without chords to points: a triangulation of the sphere with k vertices and no loops
// is left, the plan. Edges of the plan are the strips, triangles the inner triangles. A vertex of degree two comes out
// with both its triangles, and k = 4 with all degrees three is the tetrahedron. So k = 3 has two triangles back to
// back. k = 4 has the tetrahedron and its mirror image, or two triangles back to back with one edge doubled and a
// fourth vertex put in between: two polygons with two strips between them and one of the others on either side.
//
// A strip is a word of steps along two polygons. Let e(d) = (d - 3)(d - 4) / 2 for a vertex with d faces. Since the sum
// of d is given, the excess, the sum of e(d) over the vertices, is as good as the sum of squares. In a strip, a run of
// n equal steps has n faces at one vertex of the opposite polygon and leaves n - 1 vertices on its own polygon with two
// faces: together n (n - 1) / 2. The first and the last run cost n - 1; their opposite vertices are corners of inner
// triangles and shared with other strips. So the excess is the sum over the middles of the strips and over the corners.
// Strips are put in one by one, and every corner keeps only its number of edges so far.
//
// If no edge comes twice, the handle is consistent, since no link has a vertex twice then. Edges of different pairs of
// polygons differ. So edges can only repeat in single strips that go round a whole polygon, and in double strips that
// touch.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "oracle/handle_lists.h"

namespace handle_oracle {

using handle_lists::Handle;
using handle_lists::Sides;

constexpr int max_excess = 90;  // of the corners' fields of four bits

// A strip between places x and y of the plan, from one inner triangle to another. It follows the polygon at x in its
// own direction, and the polygon at y against it. Corners are numbered 4 * place + triangle; place 3 has no triangle 3.
struct PlanStrip {
  int x, y, from, to;
  int Corner(int place, bool end) const { return 4 * place + (end ? to : from); }
};
struct Plan {
  std::vector<int> polygons;  // by place
  bool row;                   // places 0 and 1 have two strips between them: strips 4 and 5
  std::vector<PlanStrip> strips;
};
// The plans of k named polygons. A handle without chords belongs to exactly one of them.
std::vector<Plan> PlansOf(int k);

// Steps along x and y in each strip of a plan.
using Lengths = std::vector<std::array<int, 2>>;
int Unevenness(const Lengths& lengths);

// All labelled handles with these lengths have the same shape up to rotations; shapes[e] of them have excess e.
struct Family {
  const Plan* plan;
  Lengths lengths;
  std::vector<uint64_t> shapes;
};

// All families of k >= 3 polygons with handles of excess up to the budget.
std::vector<Family> FamiliesUpTo(const std::vector<Plan>& plans, const Sides& sides, int budget);
// Labelled handles of two polygons by excess, up to the budget.
std::vector<uint64_t> PairsUpTo(const Sides& sides, int budget);

// One labelled handle for each shape of the family with excess up to the budget.
void ListShapes(const Family& family, const Sides& sides, int budget, const std::function<void(const Handle&)>& visit);

// The least excess, and how many labelled handles have it.
struct Minimum {
  int excess = -1;
  uint64_t handles = 0, shapes = 0;
  std::vector<Family> families;  // those that attain it; none for pairs
};
Minimum MinimumOf(const std::vector<Plan>& plans, const Sides& sides);
int SumOfSquares(const Sides& sides, int excess);
uint64_t Rotations(const Sides& sides);

}  // namespace handle_oracle
