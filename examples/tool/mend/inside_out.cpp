// SPDX-License-Identifier: MIT
#include "tool/mend/inside_out.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "tool/mend/triangle_tree.h"
#include "tool/scenes/points.h"

namespace tool {

namespace {

// Winding numbers of parts about places, by a ray along x. The ray counts as a little up in y and, less, in z, so that
// it meets no edge; signs are exact.
class Windings {
 public:
  Windings(const TriangleMesh& mesh, const std::vector<uint32_t>& part_of)
      : mesh_(mesh), part_of_(part_of), tree_(mesh.positions, mesh.triangles) {
    constexpr double far_above_rounding = 1e-11;  // of the largest coordinate
    for (const double x : mesh.positions) reach_ = std::max(reach_, far_above_rounding * std::fabs(x));
  }

  // Calls visit(triangle) for the triangles of other parts that meet a triangle.
  template <class Visit>
  void for_each_crossing(uint32_t f, Visit visit) const {
    const auto corners = [&](uint32_t t) {
      const uint32_t* v = &mesh_.triangles[3 * size_t{t}];
      return Corners{v[0], v[1], v[2]};
    };
    tree_.for_each(tree_.box(f), [&](uint32_t g) {
      if (part_of_[g] != part_of_[f] && triangles_meet(mesh_.positions.data(), corners(f), corners(g))) visit(g);
      return true;
    });
  }

  // Does the place lie so near a triangle of another part that rounding, here or in the
  // file, may decide its side?
  bool is_near(const Point& p, uint32_t but) const {
    const Box3 box = {p - Point{reach_, reach_, reach_}, p + Point{reach_, reach_, reach_}};
    bool near = false;
    tree_.for_each(box, [&](uint32_t f) {
      if (part_of_[f] == but) return true;
      Point a[3];
      for (size_t i = 0; i < 3; ++i) {
        const double* q = at(mesh_.triangles[3 * size_t{f} + i]);
        a[i] = {q[0], q[1], q[2]};
      }
      const Point normal = cross(a[1] - a[0], a[2] - a[0]);
      near = !(std::fabs(dot(normal, p - a[0])) > reach_ * length(normal));
      return !near;
    });
    return near;
  }

  // Of all parts but one, those that are not 0. False if the place lies on one of them.
  bool about(const double* p, uint32_t but, std::map<uint32_t, int>& windings) const {
    windings.clear();
    bool on_surface = false;
    const double far = std::numeric_limits<double>::infinity();
    tree_.for_each({{p[0], p[1], p[2]}, {far, p[1], p[2]}}, [&](uint32_t f) {
      if (part_of_[f] == but) return true;
      const uint32_t* v = &mesh_.triangles[3 * size_t{f}];
      const Corners corners = {v[0], v[1], v[2]};
      on_surface = tree_.box(f).low[0] <= p[0] && triangle_holds(mesh_.positions.data(), corners, p);
      if (!on_surface) windings[part_of_[f]] += crossing(corners, p);
      return !on_surface;
    });
    std::erase_if(windings, [](const auto& w) { return w.second == 0; });
    return !on_surface;
  }

 private:
  const double* at(uint32_t v) const { return &mesh_.positions[3 * size_t{v}]; }

  // Does the ray leave through the triangle (+1), or enter (-1)?
  int crossing(const Corners& f, const double* p) const {
    int covers = 0;
    for (size_t i = 0; i < 3; ++i) {
      const double *low = at(f[i]), *high = at(f[(i + 1) % 3]);
      const bool up = low[2] <= p[2];
      if (up == (high[2] <= p[2])) continue;
      if (!up) std::swap(low, high);
      if (turn_without(0, low, high, p) > 0) covers += up ? 1 : -1;
    }
    if (covers == 0) return 0;
    return side_of_plane(mesh_.positions.data(), f[0], f[1], f[2], p) * covers < 0 ? covers : 0;
  }

  const TriangleMesh& mesh_;
  const std::vector<uint32_t>& part_of_;
  TriangleTree tree_;
  double reach_ = 0;
};

int sign_of(const Part& part) {
  if (part.volume < -part.volume_doubt) return -1;
  return part.volume > part.volume_doubt ? 1 : 0;
}

Point corner_of(const TriangleMesh& mesh, uint32_t f, size_t i) {
  const double* p = &mesh.positions[3 * size_t{mesh.triangles[3 * size_t{f} + i % 3]}];
  return {p[0], p[1], p[2]};
}

// Places of triangle f on both sides of the line in which triangle g crosses f, near the ends of their common segment.
// What lies round a surface changes along such lines only.
void add_places_beside(const TriangleMesh& mesh, uint32_t f, uint32_t g, std::vector<Point>& places) {
  constexpr double aside = 1e-4;  // of an edge
  Point a[3], b[3];
  for (size_t i = 0; i < 3; ++i) a[i] = corner_of(mesh, f, i), b[i] = corner_of(mesh, g, i);
  const Point of_f = cross(a[1] - a[0], a[2] - a[0]), of_g = cross(b[1] - b[0], b[2] - b[0]);
  const auto share_at = [](const Point& normal, const Point& base, const Point& p, const Point& q) {
    const double at_p = dot(normal, p - base), at_q = dot(normal, q - base);
    return at_p * at_q < 0 ? at_p / (at_p - at_q) : -1;
  };
  for (size_t i = 0; i < 3; ++i) {
    const Point &p = a[i], &q = a[(i + 1) % 3];
    const double share = share_at(of_g, b[0], p, q);
    if (share < 0) continue;
    for (const double side : {-aside, aside}) places.push_back(p + std::clamp(share + side, 0.0, 1.0) * (q - p));
  }
  const Point across = cross(of_f, cross(of_g, of_f));
  const double size = std::max({length(a[1] - a[0]), length(a[2] - a[1]), length(a[0] - a[2])});
  const auto lies_in_f = [&](const Point& x) {
    for (size_t i = 0; i < 3; ++i)
      if (dot(cross(a[(i + 1) % 3] - a[i], x - a[i]), of_f) < 0) return false;
    return true;
  };
  for (size_t i = 0; i < 3; ++i) {
    const Point &p = b[i], &q = b[(i + 1) % 3];
    const double share = share_at(of_f, a[0], p, q);
    if (share < 0 || !(length(across) > 0)) continue;
    for (const double side : {-aside, aside}) {
      const Point place = p + share * (q - p) + side * size / length(across) * across;
      if (lies_in_f(place)) places.push_back(place);
    }
  }
}

// Places on a part: its corners, the middles of its triangles, and both sides of lines in which other parts cross it.
// Calls visit(position) until false.
template <class Visit>
void for_each_place(const TriangleMesh& mesh, const Windings& windings, const std::vector<uint32_t>& triangles,
                    uint32_t part, Visit visit) {
  for (const uint32_t f : triangles)
    for (size_t i = 0; i < 3; ++i)
      if (const Point p = corner_of(mesh, f, i); !windings.is_near(p, part) && !visit(p)) return;
  std::vector<Point> places;
  for (const uint32_t f : triangles) {
    places = {1.0 / 3 * (corner_of(mesh, f, 0) + corner_of(mesh, f, 1) + corner_of(mesh, f, 2))};
    windings.for_each_crossing(f, [&](uint32_t g) { add_places_beside(mesh, f, g, places); });
    for (const Point& place : places)
      if (!windings.is_near(place, part) && !visit(place)) return;
  }
}

std::vector<std::vector<uint32_t>> triangles_by_part(const std::vector<uint32_t>& part_of, size_t parts) {
  std::vector<std::vector<uint32_t>> triangles(parts);
  for (uint32_t f = 0; f < part_of.size(); ++f) triangles[part_of[f]].push_back(f);
  return triangles;
}

// What lies round a part.
struct Surroundings {
  bool has_outside = false;          // a place with winding number 0 or less about all other parts
  std::vector<uint32_t> containers;  // parts with a winding number about every place
};

// Places on other parts tell nothing. Ends once both answers are known.
Surroundings look_round(const TriangleMesh& mesh, const Windings& windings, const std::vector<uint32_t>& triangles,
                        uint32_t part) {
  Surroundings s;
  bool is_first = true;
  std::map<uint32_t, int> about;
  for_each_place(mesh, windings, triangles, part, [&](const Point& p) {
    if (!windings.about(p.data(), part, about)) return true;
    int sum = 0;
    for (const auto& [other, winding] : about) sum += winding;
    s.has_outside = s.has_outside || sum <= 0;
    if (is_first)
      for (const auto& [other, winding] : about) s.containers.push_back(other);
    is_first = false;
    std::erase_if(s.containers, [&](uint32_t other) { return about.count(other) == 0; });
    return !(s.has_outside && s.containers.empty());
  });
  return s;
}

}  // namespace

InsideOut find_inside_out(const TriangleMesh& mesh) {
  InsideOut found;
  std::vector<uint32_t> part_of;
  const std::vector<Part> parts = parts_of(mesh, part_of);
  if (std::none_of(parts.begin(), parts.end(), [](const Part& p) { return sign_of(p) < 0; })) return found;
  const std::vector<std::vector<uint32_t>> triangles = triangles_by_part(part_of, parts.size());
  const Windings windings(mesh, part_of);
  bool is_any_outward = false;
  for (uint32_t i = 0; i < parts.size(); ++i) {
    const int sign = sign_of(parts[i]);
    if (sign == 0 || (sign > 0 && is_any_outward)) continue;
    const Surroundings s = look_round(mesh, windings, triangles[i], i);
    if (sign < 0 && s.has_outside) {
      found.turned.push_back({i, parts[i]});
      found.left_out -= parts[i].volume;
    }
    is_any_outward = is_any_outward || (sign > 0 && s.containers.empty());
  }
  found.is_all = !is_any_outward && !found.turned.empty();
  return found;
}

size_t turn_parts(TriangleMesh& mesh, const InsideOut& found) {
  std::vector<uint32_t> part_of;
  const std::vector<Part> parts = parts_of(mesh, part_of);
  const std::vector<std::vector<uint32_t>> triangles = triangles_by_part(part_of, parts.size());
  const Windings windings(mesh, part_of);
  std::vector<uint8_t> is_named(parts.size());
  for (const TurnedPart& t : found.turned) is_named[t.component] = 1;
  std::vector<uint8_t> turn = is_named;
  for (uint32_t i = 0; i < parts.size(); ++i) {
    if (is_named[i] != 0) continue;
    const std::vector<uint32_t> round = look_round(mesh, windings, triangles[i], i).containers;
    const bool in_named = std::any_of(round.begin(), round.end(), [&](uint32_t other) { return is_named[other] != 0; });
    // An odd depth is that of a void.
    const int wanted = round.size() % 2 == 1 ? -1 : 1;
    if (in_named && sign_of(parts[i]) == -wanted) turn[i] = 1;
  }
  for (uint32_t f = 0; f < part_of.size(); ++f)
    if (turn[part_of[f]] != 0) std::swap(mesh.triangles[3 * size_t{f} + 1], mesh.triangles[3 * size_t{f} + 2]);
  return static_cast<size_t>(std::count(turn.begin(), turn.end(), 1));
}

}  // namespace tool
