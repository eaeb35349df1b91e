// SPDX-License-Identifier: MIT
// commit_oracle: what a commit did, told from the meshes before and after and from the maps alone.
#pragma once

#include <cstring>
#include <iosfwd>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "support/sample_meshes.h"
#include "topoadapt.h"

namespace support {

// ---------------------------------------------------------------- components

struct Labels {
  std::vector<uint32_t> of;    // per vertex: smallest vertex of the component
  std::vector<int64_t> euler;  // per vertex, if smallest of a component: twice the Euler number
};
Labels LabelsOf(const Mesh& m);

// An event of components.
struct ComponentEvent {
  int32_t type;
  uint32_t amount, before, after;
  bool operator==(const ComponentEvent& e) const {
    return std::tie(type, amount, before, after) == std::tie(e.type, e.amount, e.before, e.after);
  }
};
void PrintTo(const ComponentEvent& e, std::ostream* out);
std::vector<ComponentEvent> ComponentEventsAmong(const tpa_event* events, uint32_t count);
std::vector<ComponentEvent> ExpectedComponentEvents(const Mesh& before, const Mesh& after,
                                                    const tpa_vertex_origin* origins);

// ---------------------------------------------------------------- changes

// The ids with other bits than before, or that were not there, three numbers each.
template <class Number>
std::vector<uint32_t> Differing(const std::vector<Number>& before, const std::vector<Number>& after) {
  std::vector<uint32_t> ids;
  for (size_t i = 0; i < after.size(); i += 3)
    if (i >= before.size() || std::memcmp(&before[i], &after[i], 3 * sizeof(Number)) != 0)
      ids.push_back(static_cast<uint32_t>(i / 3));
  return ids;
}
// First and last of ranges of the ids, across gaps of at most `gap`.
std::vector<std::pair<uint32_t, uint32_t>> Joined(const std::vector<uint32_t>& ids, uint32_t gap);

// ---------------------------------------------------------------- maps

std::vector<std::set<uint32_t>> NeighboursOfTriangles(const Mesh& m);
// The triangle whose row each triangle takes: itself, or along ever nearer neighbours, the lowest of them each time;
// TPA_NONE in a component without an origin.
std::vector<uint32_t> RowSources(const std::vector<bool>& has_origin, const std::vector<std::set<uint32_t>>& near);

std::vector<double> LongestEdges(const Mesh& m);
// How far p lies from its origin between a and b, in lengths of the bound: the longest edge at p, or the distance of a
// and b if that is longer. Infinite unless the weight is that of the nearest point.
double OffOrigin(const Point& a, const Point& b, double weight, const Point& p, double longest_edge);

}  // namespace support
