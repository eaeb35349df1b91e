#include "edit/smooth.h"

#include "detect/detect_moved.h"

namespace tpa {

namespace {

enum : u8 { moved = 1 };

void detect_collected(const Mesh& m, NearFaces& g, const Exec& exec, Relocation& r) {
  reenter(g, m, r.faces.span());
  detect_around(m, g, exec, r);
}

// Complete detection takes a third to an eighth of what detection of few faces does for each: a third where these are
// proven in groups, less where they bend too much. But it looks at all.
bool are_many(const Mesh& m, const Relocation& r) { return 8 * u64{r.faces.size} > m.face_count; }

void detect_anew(const Mesh& m, NearFaces& g, FaceTree& clusters, const Exec& exec, Relocation& r) {
  detect_complete(m, clusters, r.face_mark, r.star, exec, *r.detection);
  watch(g, m, clusters);
  for (u32 f : r.faces) r.face_mark[f] = 0;
}

// Puts back the moved corners of the faces in contact; they are left in r.vertices.
void put_back(Edit& e, Relocation& r) {
  r.vertices.clear();
  const auto undo = [&](u32 f) {
    for (u32 i = 0; i < 3; ++i) {
      const u32 v = e.mesh.corner[3 * f + i];
      if (r.vertex_mark[v] != moved) continue;
      r.vertex_mark[v] = 0;
      set_position(e, v, r.saved[v]);
      r.vertices.push(v);
    }
  };
  for (const Contact& c : r.detection->pairs) {
    undo(c.a);
    undo(c.b);
  }
}

// Those of components that may have been turned inside out.
void put_back_turned(Edit& e, Span<const u32> vertices, Relocation& r, Components& enclosed) {
  find_turned(e.mesh, {vertices, r.vertex_mark, r.saved}, enclosed, r.vertices);
  for (u32 v : r.vertices) {
    r.vertex_mark[v] = 0;
    set_position(e, v, r.saved[v]);
  }
}

void put_back_all(Edit& e, Span<const u32> vertices, Relocation& r) {
  r.vertices.clear();
  for (u32 v : vertices) {
    if (r.vertex_mark[v] != moved) continue;
    r.vertex_mark[v] = 0;
    set_position(e, v, r.saved[v]);
    r.vertices.push(v);
  }
}

}  // namespace

void collect_faces(const Mesh& m, Span<const u32> vertices, Relocation& r) {
  r.faces.clear();
  for (u32 v : vertices) for_each_outgoing(m, v, [&](u32 h) { add_face(r, face_of(h)); });
}

void detect_around(const Mesh& m, const NearFaces& g, const Exec& exec, Relocation& r) {
  const Span<u32> room{r.faces.end(), r.faces.capacity - r.faces.size};
  detect(m, g, {r.face_mark, r.faces.span(), room, r.star}, exec, *r.detection);
  for (u32 f : r.faces) {
    r.face_mark[f] = 0;
    for (u32 i = 0; i < 3; ++i) r.star[m.corner[3 * f + i]] = 0;
  }
}

namespace {

// After the first detection. Ends: every round puts at least one vertex back for good, or is the last.
u32 put_back_what_may_not_stay(Edit& e, NearFaces& g, Span<const u32> vertices, const Exec& exec, Relocation& r,
                               Components* enclosed) {
  u32 kept = vertices.size;
  for (u32 v : vertices) r.vertex_mark[v] = moved;
  for (;;) {
    // More contacts than fit arrive in no fixed order, so none of them may decide.
    if (r.detection->found > r.detection->pairs.size)
      put_back_all(e, vertices, r);
    else
      put_back(e, r);
    if (r.vertices.size == 0 && enclosed != nullptr) put_back_turned(e, vertices, r, *enclosed);
    kept -= r.vertices.size;
    if (r.vertices.size == 0) break;
    collect_faces(e.mesh, r.vertices.span(), r);
    detect_collected(e.mesh, g, exec, r);
  }
  for (u32 v : vertices) r.vertex_mark[v] = 0;
  return kept;
}

}  // namespace

u32 settle(Edit& e, NearFaces& g, Span<const u32> vertices, const Exec& exec, Relocation& r, Components* enclosed) {
  collect_faces(e.mesh, vertices, r);
  detect_collected(e.mesh, g, exec, r);
  return put_back_what_may_not_stay(e, g, vertices, exec, r, enclosed);
}

u32 settle_many(Edit& e, NearFaces& g, FaceTree& clusters, Span<const u32> vertices, const Exec& exec, Relocation& r,
                Components* enclosed) {
  collect_faces(e.mesh, vertices, r);
  if (are_many(e.mesh, r))
    detect_anew(e.mesh, g, clusters, exec, r);
  else
    detect_collected(e.mesh, g, exec, r);
  return put_back_what_may_not_stay(e, g, vertices, exec, r, enclosed);
}

void save(const Mesh& m, Span<const u32> vertices, Relocation& r) {
  for (u32 v : vertices) r.saved[v] = m.position[v];
}

u32 smooth(Edit& e, NearFaces& g, Span<const u32> vertices, u32 iterations, TaubinFactors factors, const Exec& exec,
           Relocation& r, Components* enclosed) {
  Mesh& m = e.mesh;
  const auto pass = [&](f64 factor) {
    for_chunks(exec, vertices.size, 1024, [&](u32 first, u32 last) {
      for (u32 i = first; i < last; ++i) {
        const u32 v = vertices[i];
        Vec3 sum;
        u32 n = 0;
        for_each_neighbour(m, v, [&](u32 u) {
          sum = sum + m.position[u];
          ++n;
        });
        const Vec3 p = m.position[v];
        r.wanted[i] = into_exact_range(p + factor * (1.0 / n * sum - p));
      }
    });
    for (u32 i = 0; i < vertices.size; ++i) set_position(e, vertices[i], r.wanted[i]);
  };
  for (u32 i = 0; i < iterations; ++i) {
    pass(factors.lambda);
    pass(factors.mu);
  }
  return settle(e, g, vertices, exec, r, enclosed);
}

}  // namespace tpa
