// SPDX-License-Identifier: MIT
// exact: the library's exact predicates and its minimum triangulation, for meshes that the library does not take: open
// ones and soups. Alone in the tool, exact.cpp looks behind the public header.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace tool {

using Corners = std::array<uint32_t, 3>;

// +1 for d on the side that the normal (b - a) x (c - a) points to, 0 in the plane; p[3 v] ... are coordinates of v.
int side_of_plane(const double* p, uint32_t a, uint32_t b, uint32_t c, const double* d);

// Sign of the area of abc with the axis left out, counterclockwise positive.
int turn_without(int axis, const double* a, const double* b, const double* c);

// Do two triangles with different corners meet beyond common corners and edges? Touching counts. A triangle without
// area is the segment or point that it covers.
bool triangles_meet(const double* p, const Corners& f, const Corners& g);

// Does the point lie in the closed triangle?
bool triangle_holds(const double* p, const Corners& f, const double* point);

// Are the corners in one line?
bool has_no_area(const double* p, const Corners& f);

inline constexpr size_t longest_loop = 384;

// The triangulation of a loop of at most `longest_loop` corners with the shortest chords, of free triangles only, and
// without the chords `taken` (places in the loop). Triangles have places as corners, in the direction of the loop.
// Empty where there is none. O(n^3).
std::vector<Corners> shortest_triangulation(std::span<const std::array<double, 3>> loop,
                                            const std::vector<std::pair<uint32_t, uint32_t>>& taken,
                                            const std::function<bool(const Corners&)>& is_free);

}  // namespace tool
