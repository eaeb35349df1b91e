// SPDX-License-Identifier: MIT
#include "surgery/sew_pieces.h"

#include "edit/bisect.h"
#include "surgery/point_origins.h"

namespace tpa {

namespace {

enum : u8 { stays, in_contact, swallowed };

// ---------------------------------------------------------------- faces that go

bool is_border(u32 mate) { return mate != none && (mate & border_tag) != 0; }

// The face beyond the rim at a half-edge of a piece.
u32 face_beyond(const Arrangement& a, u32 h) { return face_of(a.borders[a.mate[h] & ~border_tag]); }

}  // namespace

bool find_swallowed_faces(const Mesh& m, const Arrangement& a, SewingScratch& scratch) {
  Stack<u32>& faces = scratch.faces;
  const auto reach = [&](u32 f) {
    if (scratch.face_mark[f] != stays) return;
    scratch.face_mark[f] = swallowed;
    faces.push(f);
  };
  u32 begin = faces.size;
  for (u32 h = 0; h < 3 * a.pieces.size; ++h)
    if (is_border(a.mate[h]) && !is_kept(a.pieces[face_of(h)])) reach(face_beyond(a, h));
  for (; begin < faces.size; ++begin)
    for (u32 h = 3 * faces[begin]; h < 3 * faces[begin] + 3; ++h) reach(face_of(m.opposite[h]));
  bool sound = true;
  for (u32 h = 0; h < 3 * a.pieces.size; ++h)
    sound = sound &&
            !(is_border(a.mate[h]) && is_kept(a.pieces[face_of(h)]) && scratch.face_mark[face_beyond(a, h)] != stays);
  if (!sound)
    for (u32 f : faces) scratch.face_mark[f] = stays;
  return sound;
}

namespace {

// ---------------------------------------------------------------- faces and fans

// Faces go at once, their vertices only if no fan claims them (vertex_edge is none until then).
void remove_faces(Edit& e, NearFaces& g, SewingScratch& scratch) {
  scratch.vertices.clear();
  for (u32 f : scratch.faces) {
    for (u32 h = 3 * f; h < 3 * f + 3; ++h) {
      const u32 v = tail(e.mesh, h);
      if (e.mesh.vertex_edge[v] == none) continue;
      set_vertex_edge(e, v, none);
      scratch.vertices.push(v);
    }
    remove(g, f);
    delete_face(e, f);
    scratch.face_mark[f] = stays;
  }
}

// A corner of a new face holds its point, with this tag, until its fan has a vertex, or is counted as one without.
constexpr u32 point_tag = 1u << 31, counted = 0;

// Makes the kept pieces faces, linked to each other and across the rim. face_of_piece has an entry for each piece.
// Returns the number of pieces without a face for want of room.
u32 make_faces(Edit& e, Arrangement& a, Stack<u32>& faces, u32* face_of_piece) {
  u32 missing = 0;
  faces.clear();
  for (u32 i = 0; i < a.pieces.size; ++i) {
    const CutPiece& piece = a.pieces[i];
    if (!is_kept(piece)) continue;
    const u32 f = new_face(e, point_tag | piece.p[0], point_tag | piece.p[1], point_tag | piece.p[2], piece.face);
    missing += f == none ? 1u : 0u;
    if (missing > 0) continue;
    face_of_piece[i] = f;
    faces.push(f);
  }
  if (missing > 0) return missing;
  for (u32 h = 0; h < 3 * a.pieces.size; ++h) {
    if (!is_kept(a.pieces[face_of(h)])) continue;
    const u32 mate = a.mate[h], here = 3 * face_of_piece[face_of(h)] + index_in_face(h);
    if (is_border(mate))
      link(e, here, a.borders[mate & ~border_tag]);
    else if (mate > h)
      link(e, here, 3 * face_of_piece[face_of(mate)] + index_in_face(mate));
  }
  return 0;
}

// The vertex of a further fan round a point; the point's own for the first. None if vertices have run out.
u32 vertex_for_fan(Edit& e, Arrangement& a, u32 point, Stack<u32>& apart) {
  const ArrangementPoint& p = a.points.list[point];
  u32& first = a.vertex[point];
  if (first == none && p.kind == PointKind::vertex) return first = p.id[0];
  const u32 v = new_vertex(e, p.at, a.origins[point]);
  if (v == none) return none;
  if (first == none) return first = v;
  if (a.place[point] == none) apart.push(first);
  a.place[point] = 1;
  apart.push(v);
  return v;
}

// Walks round each corner of the new faces, and gives the fan there a vertex. Returns the number of fans without a
// vertex for want of room.
u32 give_vertices(Edit& e, Arrangement& a, SewingScratch& scratch) {
  u32 missing = 0;
  scratch.apart.clear();
  for (u32 i = 0; i < a.points.list.size; ++i) a.place[i] = a.vertex[i] = none;
  for (u32 f : scratch.faces)
    for (u32 h = 3 * f; h < 3 * f + 3; ++h) {
      if ((e.mesh.corner[h] & point_tag) == 0) continue;
      const u32 v = vertex_for_fan(e, a, e.mesh.corner[h] & ~point_tag, scratch.apart);
      missing += v == none ? 1u : 0u;
      if (v != none) set_vertex_edge(e, v, h);
      for_each_outgoing_from(e.mesh, h, [&](u32 g) {
        if (e.mesh.corner[g] != v) set_corner(e, g, v == none ? counted : v);
      });
    }
  for (u32 v : scratch.vertices)
    if (e.mesh.vertex_edge[v] == none) {
      delete_vertex(e, v);
      ++scratch.removed;
    }
  return missing;
}

// Shared edges whose middles find no hole among the vertices.
u32 shared_without_holes(const Edit& e, const Arrangement& a) {
  u32 count = a.shared.size;
  for (u32 v = e.mesh.free_vertex; count > 0 && v != e.journal.resting_vertex; v = e.mesh.vertex_origin[v].parents[0])
    --count;
  return count;
}

SewOutcome out_of(SewOutcome what, u64 wanted, SewingScratch& scratch) {
  scratch.wanted = wanted;
  return what;
}

// Where the region touches itself along an edge, each copy of the edge gets a vertex in its middle: otherwise two
// copies with the same ends would be one edge of four faces.
SewOutcome divide_shared_edges(Edit& e, NearFaces& g, const Arrangement& a, const u32* face_of_piece,
                               SewingScratch& scratch) {
  for (u32 i = 0; i < a.shared.size; ++i) {
    const u32 h = a.shared[i], left = a.shared.size - i;
    const u32 edge = 3 * face_of_piece[face_of(h)] + index_in_face(h);
    const u32 u = tail(e.mesh, edge), v = head(e.mesh, edge);
    const Vec3 middle = into_exact_range(midpoint(e.mesh.position[u], e.mesh.position[v]));
    const u32 x = new_vertex(e, middle, blend_origins(e.mesh, u, v, 0.5));
    if (x == none) return out_of(SewOutcome::vertices, u64{e.mesh.vertex_count} + left, scratch);
    if (!split_edge(e, g, edge, x)) return out_of(SewOutcome::triangles, e.mesh.face_count + 2 * u64{left}, scratch);
    scratch.apart.push(x);
  }
  return SewOutcome::success;
}

}  // namespace

SewOutcome sew_pieces(Edit& e, NearFaces& g, Arrangement& a, SewingScratch& scratch) {
  spend(g.meter, 8 * u64{a.pieces.size} + 4 * u64{scratch.faces.size});
  note_point_origins(e.mesh, a);
  for (CutPiece& piece : a.pieces) piece.face = e.mesh.face_origin[piece.face];
  remove_faces(e, g, scratch);
  if (const u32 missing = make_faces(e, a, scratch.faces, a.queue.data); missing > 0)
    return out_of(SewOutcome::triangles, u64{e.mesh.face_count} + missing + 2 * u64{a.shared.size}, scratch);
  if (const u32 missing = give_vertices(e, a, scratch); missing > 0)
    return out_of(SewOutcome::vertices, u64{e.mesh.vertex_count} + missing + shared_without_holes(e, a), scratch);
  return divide_shared_edges(e, g, a, a.queue.data, scratch);
}

namespace {

// The share of its shortest edge by which a vertex moves at most.
constexpr f64 parting = 0x1p-10;

// The mean of the directions to the neighbours, of length 0 for a flat fan, and the shortest edge.
struct Fan {
  Vec3 inward;
  f64 shortest;
};
Fan fan_of(const Mesh& m, u32 v) {
  Fan fan{{}, no_way};
  u32 count = 0;
  for_each_neighbour(m, v, [&](u32 u) {
    const Vec3 way = m.position[u] - m.position[v];
    const f64 far = length(way);
    if (far == 0) return;
    fan.inward = fan.inward + (1 / far) * way;
    fan.shortest = min_of(fan.shortest, far);
    ++count;
  });
  fan.inward = (count > 0 ? 1.0 / count : 0) * fan.inward;
  return fan;
}

}  // namespace

void part_touching(Edit& e, Span<const u32> apart, RegionChange& region) {
  for (u32 v : apart) {
    if (!vertex_lives(e.mesh, v)) continue;
    const Fan fan = fan_of(e.mesh, v);
    if (fan.shortest == no_way) continue;
    const Vec3 from = e.mesh.position[v];
    set_position(e, v, into_exact_range(from + parting * fan.shortest * fan.inward));
    region.add_move(e.mesh, v, from, e.mesh.position[v]);
  }
}

}  // namespace tpa
