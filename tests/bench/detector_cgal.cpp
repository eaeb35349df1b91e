// SPDX-License-Identifier: MIT
// CGAL's sweep of boxes with its exact predicates, triangles that share a vertex or an edge treated as the library
// documents it. The boxes and the list of pairs are made within the time, the points before it.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

#include "detectors.h"

namespace bench {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;

struct Soup {
  std::vector<Point> points;
  const uint32_t* corners;
};

bool MeetBeyondEdge(const Point& u, const Point& v, const Point& a, const Point& b) {
  return CGAL::coplanar(u, v, a, b) && CGAL::coplanar_orientation(u, v, a, b) == CGAL::POSITIVE;
}

bool Meet(const Soup& s, uint32_t f, uint32_t g) {
  const uint32_t *a = s.corners + 3 * f, *b = s.corners + 3 * g;
  const auto at = [&](const uint32_t* c, int i) -> const Point& { return s.points[c[i % 3]]; };
  const auto triangle = [&](const uint32_t* c) { return Kernel::Triangle_3(at(c, 0), at(c, 1), at(c, 2)); };
  int shared = 0, in_a[3], in_b[3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (a[i] == b[j]) in_a[shared] = i, in_b[shared++] = j;
  if (shared == 0) return CGAL::do_intersect(triangle(a), triangle(b));
  if (shared == 1)
    return CGAL::do_intersect(Kernel::Segment_3(at(a, in_a[0] + 1), at(a, in_a[0] + 2)), triangle(b)) ||
           CGAL::do_intersect(Kernel::Segment_3(at(b, in_b[0] + 1), at(b, in_b[0] + 2)), triangle(a));
  if (shared == 2)
    return MeetBeyondEdge(at(a, in_a[0]), at(a, in_a[1]), at(a, 3 - in_a[0] - in_a[1]), at(b, 3 - in_b[0] - in_b[1]));
  return true;
}

void Find(const Soup& s, uint32_t faces, Pairs& out) {
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, uint32_t>;
  std::vector<Box> boxes;
  boxes.reserve(faces);
  for (uint32_t f = 0; f < faces; ++f) {
    const uint32_t* c = s.corners + 3 * f;
    boxes.emplace_back(s.points[c[0]].bbox() + s.points[c[1]].bbox() + s.points[c[2]].bbox(), f);
  }
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
    if (Meet(s, a.info(), b.info())) out.push_back(std::minmax(a.info(), b.info()));
  });
  std::sort(out.begin(), out.end());
}

}  // namespace

Measured DetectWithCgal(const Mesh& mesh, int repeats) {
  Soup soup{{}, mesh.triangles.data()};
  for (size_t i = 0; i < mesh.positions.size(); i += 3)
    soup.points.emplace_back(mesh.positions[i], mesh.positions[i + 1], mesh.positions[i + 2]);
  Measured out;
  out.seconds = BestTime(
      repeats, [&] { out.pairs.clear(); }, [&] { Find(soup, TriangleCount(mesh), out.pairs); });
  return out;
}

}  // namespace bench
