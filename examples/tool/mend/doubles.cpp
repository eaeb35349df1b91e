// SPDX-License-Identifier: MIT
#include "tool/mend/doubles.h"

#include <algorithm>
#include <unordered_map>

namespace tool {

namespace {

// The corners from the least on, in the direction of its lesser neighbour.
std::vector<uint32_t> corners_in_order(std::span<const uint32_t> polygon) {
  std::vector<uint32_t> corners(polygon.begin(), polygon.end());
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  if (corners[1] > corners.back()) std::reverse(corners.begin() + 1, corners.end());
  return corners;
}

// Polygons with the same corners, of all that have company.
std::vector<std::vector<uint32_t>> find_doubles(const PolygonMesh& mesh) {
  struct Keyed {
    uint64_t hash;
    uint32_t polygon;
    bool operator<(const Keyed& o) const { return hash != o.hash ? hash < o.hash : polygon < o.polygon; }
  };
  std::vector<Keyed> keyed(mesh.polygons());
  for (uint32_t i = 0; i < keyed.size(); ++i) {
    keyed[i] = {0, i};
    for (const uint32_t v : corners_in_order(mesh.polygon(i))) {
      keyed[i].hash = (keyed[i].hash ^ v) * 0x9E3779B97F4A7C15u;
      keyed[i].hash ^= keyed[i].hash >> 32;
    }
  }
  std::sort(keyed.begin(), keyed.end());
  std::vector<std::vector<uint32_t>> doubles;
  for (size_t i = 0, end = 0; i < keyed.size(); i = end) {
    std::vector<uint32_t> set;
    for (; end < keyed.size() && keyed[end].hash == keyed[i].hash; ++end)
      if (end == i || corners_in_order(mesh.polygon(keyed[end].polygon)) == corners_in_order(mesh.polygon(set[0])))
        set.push_back(keyed[end].polygon);
    if (set.size() > 1) doubles.push_back(std::move(set));
  }
  return doubles;
}

// Polygons at an edge: how many, and how many more of them run up than down.
struct Balance {
  int count = 0, up = 0;
  bool is_kept() const { return count % 2 == 0 && up == 0; }
};

class Doubles {
 public:
  explicit Doubles(const PolygonMesh& mesh) : mesh_(mesh), sets_(find_doubles(mesh)) {
    for (uint32_t s = 0; s < sets_.size(); ++s)
      for_each_side(sets_[s][0], [&](uint64_t edge, int) {
        balance_[edge] = {};
        sets_at_.emplace(edge, s);
      });
    for (uint32_t i = 0; i < mesh.polygons() && !sets_.empty(); ++i)
      for_each_side(i, [&](uint64_t edge, int up) {
        const auto at = balance_.find(edge);
        if (at == balance_.end()) return;
        ++at->second.count;
        at->second.up += up;
      });
  }

  // Marks the polygons that go. Returns how many.
  size_t mark(std::vector<uint8_t>& goes) const {
    size_t marked = 0;
    std::vector<uint8_t> seen(sets_.size());
    for (uint32_t s = 0; s < sets_.size(); ++s) {
      if (seen[s] != 0) continue;
      const std::vector<uint32_t> patch = patch_from(s, seen);
      if (!closes_by_one(patch)) continue;
      for (const uint32_t set : patch) marked += mark_all_but_one(sets_[set], goes);
    }
    return marked;
  }

 private:
  // Calls visit(edge, +1 or -1 for its direction) for the sides of a polygon.
  template <class Visit>
  void for_each_side(uint32_t polygon, Visit visit) const {
    const std::span<const uint32_t> p = mesh_.polygon(polygon);
    for (size_t k = 0; k < p.size(); ++k) {
      const uint32_t a = p[k], b = p[(k + 1) % p.size()];
      visit(uint64_t{std::min(a, b)} << 32 | std::max(a, b), a < b ? 1 : -1);
    }
  }

  std::vector<uint32_t> patch_from(uint32_t first, std::vector<uint8_t>& seen) const {
    std::vector<uint32_t> patch = {first};
    seen[first] = 1;
    for (size_t at = 0; at < patch.size(); ++at)
      for_each_side(sets_[patch[at]][0], [&](uint64_t edge, int) {
        const auto [from, to] = sets_at_.equal_range(edge);
        for (auto other = from; other != to; ++other)
          if (seen[other->second] == 0) seen[other->second] = 1, patch.push_back(other->second);
      });
    return patch;
  }

  bool closes_by_one(const std::vector<uint32_t>& patch) const {
    std::unordered_map<uint64_t, int> gone;
    for (const uint32_t s : patch)
      for_each_side(sets_[s][0], [&](uint64_t edge, int) { gone[edge] += static_cast<int>(sets_[s].size()) - 1; });
    bool was_kept = true;
    for (const auto& [edge, count] : gone) {
      const Balance& before = balance_.at(edge);
      if ((before.count - count) % 2 != 0) return false;
      was_kept = was_kept && before.is_kept();
    }
    return !was_kept;
  }

  size_t mark_all_but_one(const std::vector<uint32_t>& set, std::vector<uint8_t>& goes) const {
    const uint32_t kept = *std::max_element(
        set.begin(), set.end(), [&](uint32_t f, uint32_t g) { return agreement_of(f, set) < agreement_of(g, set); });
    for (const uint32_t f : set) goes[f] = f == kept ? 0 : 1;
    return set.size() - 1;
  }

  // Polygons outside the set that run against this one at its edges, less those that run along.
  int agreement_of(uint32_t polygon, const std::vector<uint32_t>& set) const {
    std::unordered_map<uint64_t, int> of_set;
    for (const uint32_t f : set) for_each_side(f, [&](uint64_t edge, int up) { of_set[edge] += up; });
    int agreement = 0;
    for_each_side(polygon, [&](uint64_t edge, int up) { agreement -= up * (balance_.at(edge).up - of_set.at(edge)); });
    return agreement;
  }

  const PolygonMesh& mesh_;
  std::vector<std::vector<uint32_t>> sets_;
  std::unordered_map<uint64_t, Balance> balance_;        // of edges of doubles
  std::unordered_multimap<uint64_t, uint32_t> sets_at_;  // by edge
};

}  // namespace

size_t drop_doubles(PolygonMesh& mesh, std::vector<uint32_t>& source) {
  std::vector<uint8_t> goes(mesh.polygons());
  const size_t marked = Doubles(mesh).mark(goes);
  if (marked == 0) return 0;
  PolygonMesh kept;
  std::vector<uint32_t> kept_source;
  for (size_t i = 0, triangle = 0; i < goes.size(); ++i) {
    const std::span<const uint32_t> p = mesh.polygon(i);
    const auto from = source.begin() + static_cast<std::ptrdiff_t>(triangle);
    triangle += p.size() - 2;
    if (goes[i] != 0) continue;
    kept.corners.insert(kept.corners.end(), p.begin(), p.end());
    kept.ends.push_back(kept.corners.size());
    kept_source.insert(kept_source.end(), from, from + static_cast<std::ptrdiff_t>(p.size() - 2));
  }
  mesh.corners = std::move(kept.corners);
  mesh.ends = std::move(kept.ends);
  source = std::move(kept_source);
  return marked;
}

}  // namespace tool
