#include "smooth.h"

namespace tpa {

namespace {

enum : u8 { moved = 1 };

// Collects the faces round `vertices`, each once, into r.faces, marked; and re-enters them in the grid.
void regrid(const Mesh& m, Grid& g, Span<const u32> vertices, Relocation& r) {
  r.faces.clear();
  for (u32 v : vertices)
    for_each_outgoing(m, v, [&](u32 h) {
      const u32 f = face_of(h);
      if (r.face_mark[f] != 0) return;
      r.face_mark[f] = 1;
      r.faces.push(f);
      remove(g, f);
      insert(g, m, f);
    });
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

void detect_around(const Mesh& m, const Grid& g, const Exec& exec, Relocation& r) {
  detect(m, g, {r.face_mark, r.faces.span(), r.star}, exec, *r.detection);
  for (u32 f : r.faces) {
    r.face_mark[f] = 0;
    for (u32 i = 0; i < 3; ++i) r.star[m.corner[3 * f + i]] = 0;
  }
}

u32 settle(Edit& e, Grid& g, Span<const u32> vertices, const Exec& exec, Relocation& r) {
  u32 kept = vertices.size;
  for (u32 v : vertices) r.vertex_mark[v] = moved;
  Span<const u32> changed = vertices;
  // Ends: every round puts at least one vertex back for good, or is the last.
  do {
    regrid(e.mesh, g, changed, r);
    detect_around(e.mesh, g, exec, r);
    // More contacts than fit arrive in no fixed order, so none of them may decide.
    if (r.detection->found > r.detection->pairs.size)
      put_back_all(e, vertices, r);
    else
      put_back(e, r);
    kept -= r.vertices.size;
    changed = r.vertices.span();
  } while (!changed.empty());
  for (u32 v : vertices) r.vertex_mark[v] = 0;
  return kept;
}

u32 smooth(Edit& e, Grid& g, Span<const u32> vertices, u32 iterations, TaubinFactors factors, const Exec& exec,
           Relocation& r) {
  Mesh& m = e.mesh;
  for (u32 v : vertices) r.saved[v] = m.position[v];
  const auto pass = [&](f64 factor) {
    for_chunks(exec, vertices.size, 1024, [&](u32 first, u32 last) {
      for (u32 i = first; i < last; ++i) {
        const u32 v = vertices[i];
        Vec3 sum;
        u32 n = 0;
        for_each_outgoing(m, v, [&](u32 h) {
          sum = sum + m.position[head(m, h)];
          ++n;
        });
        const Vec3 p = m.position[v];
        r.wanted[v] = into_exact_range(p + factor * (1.0 / n * sum - p));
      }
    });
    for (u32 v : vertices) set_position(e, v, r.wanted[v]);
  };
  for (u32 i = 0; i < iterations; ++i) {
    pass(factors.lambda);
    pass(factors.mu);
  }
  return settle(e, g, vertices, exec, r);
}

}  // namespace tpa
