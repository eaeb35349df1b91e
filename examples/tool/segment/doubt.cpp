// SPDX-License-Identifier: MIT
#include "tool/segment/doubt.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tool {

namespace {

// The surface round a contact within so many sides of a voxel.
constexpr double reach_in_voxels = 3;
// The triangles that meet have their vertices within so many edge lengths.
constexpr double contact_in_edges = 1.5;

// A contact and the vertices round it.
struct Contact {
  Point place;
  std::vector<uint32_t> around;  // within reach, ascending
  std::vector<uint32_t> at;      // of these, those of the triangles that meet
};

Contact contact_at(const Balloon& b, const Point& place) {
  Contact contact{place, {}, {}};
  const double reach = reach_in_voxels * b.forces.voxel;
  const double near = std::min(reach, contact_in_edges * b.forces.edge_length * part_at(b, place));
  for (uint32_t v = 0; v < b.particles.size(); ++v) {
    const double away = length(point_at(&b.mesh.positions[3 * size_t{v}]) - place);
    if (away <= reach) contact.around.push_back(v);
    if (away <= near) contact.at.push_back(v);
  }
  return contact;
}

// Whether paths along edges within reach connect all vertices at the contact.
bool hangs_together(const Balloon& b, const Contact& contact) {
  std::vector<uint32_t> group(contact.around.size());
  std::iota(group.begin(), group.end(), 0u);
  const auto slot = [&](uint32_t v) {
    const auto at = std::lower_bound(contact.around.begin(), contact.around.end(), v);
    return at != contact.around.end() && *at == v ? static_cast<size_t>(at - contact.around.begin()) : group.size();
  };
  const auto root = [&](size_t i) {
    while (group[i] != i) i = group[i] = group[group[i]];
    return i;
  };
  const std::vector<uint32_t>& corners = b.mesh.triangles;
  for (size_t h = 0; h < corners.size(); ++h) {
    const size_t from = slot(corners[h]), to = slot(corners[h % 3 == 2 ? h - 2 : h + 1]);
    if (from < group.size() && to < group.size()) group[root(from)] = static_cast<uint32_t>(root(to));
  }
  return std::all_of(contact.at.begin(), contact.at.end(),
                     [&](uint32_t v) { return root(slot(v)) == root(slot(contact.at.front())); });
}

// Whether noise may account for the grey value.
bool is_near_threshold(const Forces& forces, const Point& place) {
  const Point p = forces.to_index(place);
  return std::fabs(forces.threshold.depth(forces.volume.sample(p[0], p[1], p[2]))) < deviations_near * forces.noise;
}

bool anchor(Balloon& b, uint32_t v) {
  const double* before = &b.mesh.positions[3 * size_t{v}];
  double* now = &b.x[3 * size_t{v}];
  const bool moves = !std::equal(before, before + 3, now);
  std::copy(before, before + 3, now);
  b.particles[v].gain = 0;
  return moves;
}

}  // namespace

bool hold_doubtful_contacts(Balloon& b) {
  const tpa_event* events = nullptr;
  uint32_t count = 0;
  if (b.forces.noise <= 0 || tpa_events(b.surface.context(), &events, &count) != TPA_OK) return false;
  const bool is_up =
      std::any_of(events, events + count, [](const tpa_event& e) { return e.type == TPA_EVENT_GENUS_UP; });
  bool held = false;
  for (uint32_t i = 0; is_up && i < count; ++i) {
    const Point place = point_at(events[i].position);
    if (events[i].type != TPA_EVENT_HANDLE || !is_near_threshold(b.forces, place)) continue;
    const Contact contact = contact_at(b, place);
    if (contact.at.empty() || !hangs_together(b, contact)) continue;
    for (const uint32_t v : contact.at) held = anchor(b, v) || held;
  }
  return held;
}

}  // namespace tool
