// SPDX-License-Identifier: MIT
#include "oracle/commit_oracle.h"

#include <cmath>
#include <map>
#include <numeric>
#include <ostream>

namespace support {

namespace {

uint32_t HeadOf(const Mesh& m, size_t h) { return m.triangles[h % 3 == 2 ? h - 2 : h + 1]; }

}  // namespace

// ---------------------------------------------------------------- components

Labels LabelsOf(const Mesh& m) {
  Labels l;
  l.of.resize(VertexCount(m));
  l.euler.resize(VertexCount(m));
  std::iota(l.of.begin(), l.of.end(), 0u);
  const auto find = [&](uint32_t v) {
    while (l.of[v] != v) v = l.of[v] = l.of[l.of[v]];
    return v;
  };
  for (size_t h = 0; h < m.triangles.size(); ++h) {
    const uint32_t a = find(m.triangles[h]), b = find(HeadOf(m, h));
    l.of[std::max(a, b)] = std::min(a, b);
  }
  for (uint32_t v = 0; v < VertexCount(m); ++v) l.euler[l.of[v] = find(v)] += 2;
  for (size_t h = 0; h < m.triangles.size(); h += 3) --l.euler[l.of[m.triangles[h]]];
  return l;
}

void PrintTo(const ComponentEvent& e, std::ostream* out) {
  *out << "type " << e.type << " amount " << e.amount << " before " << e.before << " after " << e.after;
}

std::vector<ComponentEvent> ComponentEventsAmong(const tpa_event* events, uint32_t count) {
  std::vector<ComponentEvent> of_components;
  for (uint32_t i = 0; i < count; ++i) {
    const tpa_event& e = events[i];
    if (e.type >= TPA_EVENT_MERGE) of_components.push_back({e.type, e.amount, e.before, e.after});
  }
  return of_components;
}

std::vector<ComponentEvent> ExpectedComponentEvents(const Mesh& before, const Mesh& after,
                                                    const tpa_vertex_origin* origins) {
  const Labels old = LabelsOf(before), now = LabelsOf(after);
  // Old components with a common descendant form a family, named by the smallest.
  std::vector<uint32_t> family(VertexCount(before)), relative(VertexCount(after), TPA_NONE);
  std::vector<uint32_t> smallest(VertexCount(after), TPA_NONE);  // of the components before with vertices in common
  std::iota(family.begin(), family.end(), 0u);
  const auto find = [&](uint32_t i) {
    while (family[i] != i) i = family[i];
    return i;
  };
  for (uint32_t v = 0; v < VertexCount(after); ++v) {
    uint32_t& known = relative[now.of[v]];
    const uint32_t parent = find(old.of[origins[v].parents[0]]);
    if (known == TPA_NONE) known = parent;
    smallest[now.of[v]] = std::min(smallest[now.of[v]], old.of[origins[v].parents[0]]);
    const uint32_t other = find(known);
    family[std::max(parent, other)] = std::min(parent, other);
  }
  std::vector<ComponentEvent> events;
  for (uint32_t name = 0; name < VertexCount(before); ++name) {
    if (old.of[name] != name || find(name) != name) continue;
    uint32_t count_before = 0, count_after = 0, first_after = TPA_NONE;
    int64_t genus = 0;
    for (uint32_t v = 0; v < VertexCount(before); ++v)
      if (old.of[v] == v && find(v) == name) ++count_before, genus -= 1 - old.euler[v] / 4;
    for (uint32_t v = 0; v < VertexCount(after); ++v)
      if (now.of[v] == v && find(relative[v]) == name) {
        if (count_after++ == 0) first_after = v;
        genus += 1 - now.euler[v] / 4;
      }
    const auto say = [&](int32_t type, int64_t amount) {
      events.push_back({type, static_cast<uint32_t>(amount), name, first_after});
    };
    if (count_after == 0) {
      say(TPA_EVENT_DEATH, count_before);
      continue;
    }
    if (count_before > 1) say(TPA_EVENT_MERGE, count_before);
    for (uint32_t v = 0; v < VertexCount(after) && count_after > 1; ++v)
      if (now.of[v] == v && find(relative[v]) == name) events.push_back({TPA_EVENT_SPLIT, count_after, smallest[v], v});
    if (genus > 0) say(TPA_EVENT_GENUS_UP, genus);
    if (genus < 0) say(TPA_EVENT_GENUS_DOWN, -genus);
  }
  return events;
}

// ---------------------------------------------------------------- changes

std::vector<std::pair<uint32_t, uint32_t>> Joined(const std::vector<uint32_t>& ids, uint32_t gap) {
  std::vector<std::pair<uint32_t, uint32_t>> ranges;
  for (uint32_t id : ids)
    if (!ranges.empty() && id - ranges.back().second - 1 <= gap)
      ranges.back().second = id;
    else
      ranges.emplace_back(id, id);
  return ranges;
}

// ---------------------------------------------------------------- maps

std::vector<std::set<uint32_t>> NeighboursOfTriangles(const Mesh& m) {
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> edges;
  for (size_t h = 0; h < m.triangles.size(); ++h) edges[{m.triangles[h], HeadOf(m, h)}] = static_cast<uint32_t>(h / 3);
  std::vector<std::set<uint32_t>> near(TriangleCount(m));
  for (size_t h = 0; h < m.triangles.size(); ++h) near[h / 3].insert(edges.at({HeadOf(m, h), m.triangles[h]}));
  return near;
}

std::vector<uint32_t> RowSources(const std::vector<bool>& has_origin, const std::vector<std::set<uint32_t>>& near) {
  constexpr uint32_t none = TPA_NONE;
  std::vector<uint32_t> distance(near.size(), none), source(near.size(), none), queue;
  for (uint32_t i = 0; i < near.size(); ++i)
    if (has_origin[i]) distance[i] = 0, source[i] = i, queue.push_back(i);
  for (size_t at = 0; at < queue.size(); ++at)
    for (uint32_t k : near[queue[at]])
      if (distance[k] == none) distance[k] = distance[queue[at]] + 1, queue.push_back(k);
  for (uint32_t i : queue) {
    if (distance[i] == 0) continue;
    for (uint32_t k : near[i])
      if (source[i] == none && distance[k] + 1 == distance[i]) source[i] = source[k];
  }
  return source;
}

std::vector<double> LongestEdges(const Mesh& m) {
  std::vector<double> longest(VertexCount(m), 0);
  for (size_t h = 0; h < m.triangles.size(); ++h) {
    const uint32_t a = m.triangles[h], b = HeadOf(m, h);
    const double far = Distance(PositionOf(m, a), PositionOf(m, b));
    longest[a] = std::max(longest[a], far), longest[b] = std::max(longest[b], far);
  }
  return longest;
}

namespace {

// The distance of p from the nearest point between a and b.
double DistanceFromBetween(const Point& a, const Point& b, const Point& p) {
  const Point way = Sum(b, Scaled(-1, a)), to = Sum(p, Scaled(-1, a));
  const double whole = way[0] * way[0] + way[1] * way[1] + way[2] * way[2];
  const double along = way[0] * to[0] + way[1] * to[1] + way[2] * to[2];
  const double share = whole > 0 ? std::clamp(along / whole, 0., 1.) : 0;
  return Distance(Sum(a, Scaled(share, way)), p);
}

}  // namespace

double OffOrigin(const Point& a, const Point& b, double weight, const Point& p, double longest_edge) {
  const double apart = Distance(a, b), off = Distance(Sum(Scaled(weight, a), Scaled(1 - weight, b)), p);
  return off <= DistanceFromBetween(a, b, p) + 1e-6 * apart ? off / std::max(longest_edge, apart) : HUGE_VAL;
}

}  // namespace support
