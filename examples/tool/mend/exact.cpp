// SPDX-License-Identifier: MIT
#include "tool/mend/exact.h"

#include "geometry/predicates.h"
#include "triangulate/minimum_triangulation.h"

namespace tool {

namespace {

tpa::Vec3 point_at(const double* p) { return {p[0], p[1], p[2]}; }
tpa::Vec3 point_of(const double* p, uint32_t v) { return point_at(p + 3 * size_t{v}); }

bool ask(void* caller, const tpa::FaceCorners& face) {
  return (*static_cast<const std::function<bool(const Corners&)>*>(caller))({face.v[0], face.v[1], face.v[2]});
}

}  // namespace

int side_of_plane(const double* p, uint32_t a, uint32_t b, uint32_t c, const double* d) {
  const tpa::Vec3 at[3] = {point_of(p, a), point_of(p, b), point_of(p, c)};
  return tpa::orient3d(at[0], at[1], at[2], point_at(d));
}

int turn_without(int axis, const double* a, const double* b, const double* c) {
  return tpa::flat_orient(axis, point_at(a), point_at(b), point_at(c));
}

bool triangles_meet(const double* p, const Corners& f, const Corners& g) {
  tpa::Vec3 at[2][3];
  uint32_t shared = 0, last_f = 0, last_g = 0, of_f = 0, of_g = 0;
  for (uint32_t i = 0; i < 3; ++i) at[0][i] = point_of(p, f[i]), at[1][i] = point_of(p, g[i]);
  for (uint32_t i = 0; i < 3; ++i)
    for (uint32_t j = 0; j < 3; ++j)
      if (f[i] == g[j]) ++shared, last_f = i, last_g = j, of_f |= 1u << i, of_g |= 1u << j;
  if (shared == 0) return tpa::triangles_meet(tpa::Triangle(at[0]), tpa::Triangle(at[1]));
  if (shared == 3) return true;
  const auto corner = [&](int which, uint32_t i) -> const tpa::Vec3& { return at[which][i % 3]; };
  if (shared == 1)
    return tpa::triangles_meet_beyond_vertex(corner(0, last_f), corner(0, last_f + 1), corner(0, last_f + 2),
                                             corner(1, last_g + 1), corner(1, last_g + 2));
  // The corner of each that is not shared.
  const uint32_t i = of_f == 3 ? 2 : of_f == 5 ? 1 : 0, j = of_g == 3 ? 2 : of_g == 5 ? 1 : 0;
  return tpa::triangles_meet_beyond_edge(corner(0, i + 1), corner(0, i + 2), corner(0, i), corner(1, j));
}

bool triangle_holds(const double* p, const Corners& f, const double* point) {
  const tpa::Vec3 at[3] = {point_of(p, f[0]), point_of(p, f[1]), point_of(p, f[2])}, q = point_at(point);
  return tpa::triangles_meet(tpa::Triangle(at), tpa::Triangle(q, q, q));
}

bool has_no_area(const double* p, const Corners& f) {
  for (int axis = 0; axis < 3; ++axis)
    if (turn_without(axis, p + 3 * size_t{f[0]}, p + 3 * size_t{f[1]}, p + 3 * size_t{f[2]}) != 0) return false;
  return true;
}

std::vector<Corners> shortest_triangulation(std::span<const std::array<double, 3>> loop,
                                            const std::vector<std::pair<uint32_t, uint32_t>>& taken,
                                            const std::function<bool(const Corners&)>& is_free) {
  const size_t n = loop.size();
  if (n < 3 || n > longest_loop) return {};
  std::vector<tpa::Vec3> points(n);
  std::vector<uint32_t> places(n);
  for (uint32_t i = 0; i < n; ++i) points[i] = point_at(loop[i].data()), places[i] = i;
  std::vector<std::array<uint32_t, 2>> pairs;
  pairs.reserve(taken.size());
  for (const auto& [a, b] : taken) pairs.push_back({a, b});
  tpa::DiscNotes notes;
  tpa::Carver measured;
  tpa::carve(measured, n, notes);
  std::vector<double> room(measured.bytes / sizeof(double) + 1);
  tpa::Carver carver{reinterpret_cast<tpa::u8*>(room.data())};
  tpa::carve(carver, n, notes);
  tpa::Disc disc;
  disc.points = points.data();
  disc.vertex = places.data();
  disc.n = static_cast<uint32_t>(n);
  disc.taken = reinterpret_cast<const uint32_t(*)[2]>(pairs.data());
  disc.taken_count = static_cast<uint32_t>(pairs.size());
  disc.filter = {ask, const_cast<std::function<bool(const Corners&)>*>(&is_free)};
  disc.notes = &notes;
  std::vector<double> scratch(tpa::filtered_disc_scratch_bytes(n) / sizeof(double) + 1);
  std::vector<tpa::FaceCorners> faces(n - 2);
  if (!tpa::best_disc(disc, reinterpret_cast<tpa::u8*>(scratch.data()), faces.data())) return {};
  std::vector<Corners> triangles;
  triangles.reserve(faces.size());
  for (const tpa::FaceCorners& face : faces) triangles.push_back({face.v[0], face.v[1], face.v[2]});
  return triangles;
}

}  // namespace tool
