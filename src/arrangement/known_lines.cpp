// SPDX-License-Identifier: MIT
#include "arrangement/known_lines.h"

namespace tpa {

namespace {

struct OriginPlanes {
  PlaneRef plane[5];
  u32 count;

  void add_faces_at(const Mesh& m, u32 edge) {
    plane[count++] = plane_of_face(face_of(edge));
    plane[count++] = plane_of_face(face_of(m.opposite[edge]));
  }
};
// Of a vertex none are listed: its faces may be many.
OriginPlanes planes_of(const Mesh& m, const ArrangementPoint& p) {
  const auto plane = [&](u32 i) { return PlaneRef{p.id[i], p.axis[i]}; };
  if (p.kind == PointKind::plane_crossing) return {{plane(0), plane(1), plane(2)}, 3};
  OriginPlanes out{};
  if (p.kind != PointKind::edge_crossing) return out;
  out.plane[out.count++] = plane(1);
  out.add_faces_at(m, p.id[0]);
  if (p.id[2] != none) out.add_faces_at(m, p.id[2]);
  return out;
}

bool is_corner(const Mesh& m, u32 f, u32 v) {
  const u32* c = m.corner + 3 * static_cast<size_t>(f);
  return c[0] == v || c[1] == v || c[2] == v;
}

bool comes_from_edge(const Mesh& m, const ArrangementPoint& p, u32 half_edge) {
  if (p.kind == PointKind::vertex) return p.id[0] == tail(m, half_edge) || p.id[0] == head(m, half_edge);
  return p.kind == PointKind::edge_crossing && (p.id[0] == half_edge || p.id[2] == half_edge);
}

bool cross_for_certain(const Mesh& m, PlaneRef p, PlaneRef q) {
  const NormalOf<Vec3> a = rounded_normal(m, p), b = rounded_normal(m, q);
  for (u32 axis = 0; axis < 3; ++axis)
    if (const int sign = filtered_cross(axis, a, b); sign == 1 || sign == -1) return true;
  return false;
}

}  // namespace

bool comes_from_plane(const Mesh& m, const ArrangementPoint& p, PlaneRef plane) {
  if (p.kind == PointKind::vertex) return plane.axis == of_face && is_corner(m, plane.id, p.id[0]);
  const OriginPlanes planes = planes_of(m, p);
  for (u32 i = 0; i < planes.count; ++i)
    if (planes.plane[i] == plane) return true;
  return false;
}

bool come_from_line(const Mesh& m, const ArrangementPoint& p, const ArrangementPoint& q, const ArrangementPoint& r) {
  const ArrangementPoint& made = p.kind != PointKind::vertex ? p : q.kind != PointKind::vertex ? q : r;
  const auto come_from = [&](u32 edge) {
    return comes_from_edge(m, p, edge) && comes_from_edge(m, q, edge) && comes_from_edge(m, r, edge);
  };
  if (made.kind == PointKind::edge_crossing && (come_from(made.id[0]) || (made.id[2] != none && come_from(made.id[2]))))
    return true;
  const OriginPlanes planes = planes_of(m, made);
  PlaneRef common[5];
  u32 count = 0;
  for (u32 i = 0; i < planes.count; ++i) {
    const PlaneRef plane = planes.plane[i];
    if (!comes_from_plane(m, p, plane) || !comes_from_plane(m, q, plane) || !comes_from_plane(m, r, plane)) continue;
    for (u32 k = 0; k < count; ++k)
      if (cross_for_certain(m, common[k], plane)) return true;
    common[count++] = plane;
  }
  return false;
}

}  // namespace tpa
