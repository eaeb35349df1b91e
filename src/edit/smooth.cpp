// SPDX-License-Identifier: MIT
#include "edit/smooth.h"

#include "detect/detect_moved.h"

namespace tpa {

namespace {

// ---------------------------------------------------------------- detecting

void detect_collected(const Mesh& m, NearFaces& near, const Exec& exec, Relocation& r) {
  reenter(near, m, r.faces.span());
  detect_around(m, near, exec, r);
}

void detect_anew(const Mesh& m, NearFaces& near, FaceTree& tree, const Exec& exec, Relocation& r) {
  detect_complete(m, tree, r.face_mark, r.star, r.rooms, exec, *r.detection);
  watch(near, m, tree);
  clear_marks(r);
}

// ---------------------------------------------------------------- putting back

// Corners of faces in contact go back, by their marks: which pairs are listed depends on max_contacts.
void put_back_touching(Edit& e, Span<const u32> vertices, Relocation& r) {
  r.vertices.clear();
  if (r.detection->found == 0) return;
  for (u32 v : vertices) {
    if (r.vertex_mark[v] != CornerMarks::touching) continue;
    r.vertex_mark[v] = 0;
    set_position(e, v, r.saved[v]);
    r.vertices.push(v);
  }
}

// The vertices of components that may be inside out.
void put_back_turned(Edit& e, Span<const u32> vertices, Relocation& r, Components& measured) {
  find_turned(e.mesh, {vertices, r.vertex_mark, r.saved}, measured, r.vertices);
  for (u32 v : r.vertices) {
    r.vertex_mark[v] = 0;
    set_position(e, v, r.saved[v]);
  }
}

// Corners of faces in contact are marked.
void watch_contacts(const Mesh& m, Span<const u32> vertices, Relocation& r) {
  for (u32 v : vertices) r.vertex_mark[v] = CornerMarks::watched;
  r.detection->marks = {m.corner, r.vertex_mark};
}

void detect_where_moved(const Mesh& m, NearFaces& near, FaceTree* tree, const Exec& exec, Relocation& r) {
  if (tree != nullptr && are_many(m, r.faces.size, r.hub_pairs))
    detect_anew(m, near, *tree, exec, r);
  else
    detect_collected(m, near, exec, r);
}

// After tentative moves, with the faces collected. Ends: every round puts at least one vertex back for good, or is the
// last.
u32 put_back_until_free(Edit& e, NearFaces& near, FaceTree* tree, Span<const u32> vertices, const Exec& exec,
                        Relocation& r, Components* measured) {
  u32 kept = vertices.size;
  watch_contacts(e.mesh, vertices, r);
  detect_where_moved(e.mesh, near, tree, exec, r);
  while (!has_stopped(exec.meter)) {
    put_back_touching(e, vertices, r);
    if (r.vertices.size == 0 && measured != nullptr) put_back_turned(e, vertices, r, *measured);
    kept -= r.vertices.size;
    if (r.vertices.size == 0) break;
    collect_faces(e.mesh, r.vertices.span(), r);
    detect_where_moved(e.mesh, near, tree, exec, r);
  }
  for (u32 v : vertices) r.vertex_mark[v] = 0;
  r.detection->marks = {};
  return kept;
}

}  // namespace

void collect_faces(const Mesh& m, Span<const u32> vertices, Relocation& r) {
  clear_faces(r);
  for (u32 v : vertices) add_faces(m, v, r);
}

void detect_around(const Mesh& m, const NearFaces& near, const Exec& exec, Relocation& r) {
  const Span<u32> room{r.faces.end(), r.faces.capacity - r.faces.size};
  detect(m, near, {r.face_mark, r.faces.span(), room, r.star, r.rooms}, exec, *r.detection);
  for (u32 f : r.faces) {
    r.face_mark[f] = 0;
    for (u32 i = 0; i < 3; ++i) r.star[m.corner[3 * f + i]] = 0;
  }
}

u32 settle_many(Edit& e, NearFaces& near, FaceTree& tree, Span<const u32> vertices, const Exec& exec, Relocation& r,
                Components* measured) {
  collect_faces(e.mesh, vertices, r);
  return put_back_until_free(e, near, &tree, vertices, exec, r, measured);
}

void put_all_back(Edit& e, NearFaces& near, Span<const u32> vertices, Relocation& r) {
  for (u32 v : vertices) set_position(e, v, r.saved[v]);
  collect_faces(e.mesh, vertices, r);
  clear_marks(r);
  reenter(near, e.mesh, r.faces.span());
}

// ---------------------------------------------------------------- Taubin's smoothing

void save(const Mesh& m, Span<const u32> vertices, Relocation& r) {
  for (u32 v : vertices) r.saved[v] = m.position[v];
}

namespace {

Vec3 mean_of_neighbours(const Mesh& m, u32 v) {
  Vec3 sum;
  u32 n = 0;
  for_each_neighbour(m, v, [&](u32 u) {
    sum = sum + m.position[u];
    ++n;
  });
  return 1.0 / n * sum;
}

void move_towards_neighbours(Edit& e, Span<const u32> vertices, f64 factor, const Exec& exec, Relocation& r) {
  const Mesh& m = e.mesh;
  for_chunks(exec, vertices.size, 1024, [&](u32 first, u32 last) {
    for (u32 i = first; i < last; ++i) {
      const Vec3 p = m.position[vertices[i]];
      r.wanted[i] = into_exact_range(p + factor * (mean_of_neighbours(m, vertices[i]) - p));
    }
  });
  for (u32 i = 0; i < vertices.size; ++i) set_position(e, vertices[i], r.wanted[i]);
}

}  // namespace

u32 make_rounds(Edit& e, Span<const u32> vertices, u32 faces, u32 iterations, TaubinFactors factors, const Exec& exec,
                Relocation& r) {
  u32 rounds = 0;
  for (; rounds < iterations && !has_stopped(exec.meter); ++rounds) {
    move_towards_neighbours(e, vertices, factors.lambda, exec, r);
    move_towards_neighbours(e, vertices, factors.mu, exec, r);
    spend(exec.meter, 2 * u64{faces});
  }
  return rounds;
}

u32 smooth(Edit& e, NearFaces& near, Span<const u32> vertices, u32 iterations, TaubinFactors factors, const Exec& exec,
           Relocation& r, Components* measured) {
  collect_faces(e.mesh, vertices, r);
  make_rounds(e, vertices, r.faces.size, iterations, factors, exec, r);
  return put_back_until_free(e, near, nullptr, vertices, exec, r, measured);
}

}  // namespace tpa
