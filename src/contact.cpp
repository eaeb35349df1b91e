#include "contact.h"

#include "order.h"

namespace tpa {

namespace {

// Stars with more triangles than this are not worth a proof.
constexpr u32 largest_proven_star = 32;

enum : u8 { star_unknown = 0, star_unfolded = 1, star_unproven = 2 };

bool prove_star(const Mesh& m, u32 v) {
  Vec3 link[largest_proven_star];
  u32 n = 0;
  bool small = true;
  for_each_outgoing(m, v, [&](u32 h) {
    if (n == largest_proven_star)
      small = false;
    else
      link[n++] = m.position[head(m, h)];
  });
  return small && star_is_unfolded(m.position[v], link, n);
}

// Does what g does not share with f lie strictly on one side of f's plane? False where there is no such thing, or where
// that is not certain.
bool lies_beside(const Mesh& m, const Probe& f, const u32* g) {
  int side = 0;
  for (u32 i = 0; i < 3; ++i) {
    if ((g[i] == f.v[0]) | (g[i] == f.v[1]) | (g[i] == f.v[2])) continue;
    const int sign = filtered_side(f.plane, m.position[g[i]]);
    if (sign == 0 || sign == 2 || sign + side == 0) return false;
    side = sign;
  }
  return side != 0;
}

// So many follow each other in detect(): those of a vertex or two are near each other.
constexpr u32 most_together = 32;
void detect_faces(const Mesh& m, const Grid& grid, const DetectScope& scope, Span<const u32> faces, ContactSink& sink) {
  Box box[most_together];
  u32 proven[most_together][3];  // corners whose stars are
  for (u32 i = 0; i < faces.size; ++i) {
    box[i] = face_box(m, faces[i]);
    const u32* corner = m.corner + 3 * faces[i];
    for (u32 k = 0; k < 3; ++k) proven[i][k] = star_proven(m, scope.star, corner[k]) ? corner[k] : none;
  }
  for_each_near_each(grid, {box, faces.size}, [&](u32 i, u32 g) {
    const u32 f = faces[i];
    // A pair of two active faces is met from both sides: the lower one reports it.
    if (!(g > f || (g < f && scope.active[g] == 0))) return;
    const u32 *cf = m.corner + 3 * f, *cg = m.corner + 3 * g;
    bool apart = false;
    for (const u32 v : proven[i]) apart |= (v == cg[0]) | (v == cg[1]) | (v == cg[2]);
    if (!apart && corners_meet(m, cf, cg)) sink.add(f, g);
  });
}

}  // namespace

// Two workers may prove the same star at once: both write the same byte.
bool star_proven(const Mesh& m, u8* star, u32 v) {
  u8 state = __atomic_load_n(star + v, __ATOMIC_RELAXED);
  if (state == star_unknown) {
    state = prove_star(m, v) ? star_unfolded : star_unproven;
    __atomic_store_n(star + v, state, __ATOMIC_RELAXED);
  }
  return state == star_unfolded;
}

bool corners_meet(const Mesh& m, const u32* f, const u32* g, const Sharing& s) {
  const Vec3* p = m.position;
  const auto at = [](const u32* c, u32 i) { return c[i % 3]; };
  switch (s.count) {
    case 0: {
      const Vec3 a[3] = {p[f[0]], p[f[1]], p[f[2]]}, b[3] = {p[g[0]], p[g[1]], p[g[2]]};
      return triangles_meet(a, b);
    }
    case 1:
      return triangles_meet_beyond_vertex(p[f[s.in_f]], p[at(f, s.in_f + 1)], p[at(f, s.in_f + 2)],
                                          p[at(g, s.in_g + 1)], p[at(g, s.in_g + 2)]);
    case 2: {
      u32 of = 0, og = 0;  // the corners that are not shared
      for (u32 i = 0; i < 3; ++i) {
        if (f[i] != g[0] && f[i] != g[1] && f[i] != g[2]) of = i;
        if (g[i] != f[0] && g[i] != f[1] && g[i] != f[2]) og = i;
      }
      return triangles_meet_beyond_edge(p[at(f, of + 1)], p[at(f, of + 2)], p[f[of]], p[g[og]]);
    }
    default: return true;
  }
}

bool meets(const Mesh& m, const Probe& f, const u32* g) {
  return !lies_beside(m, f, g) && !lies_beside(m, probe_of(m, g), f.v) && corners_meet(m, f.v, g);
}

void ContactSink::finish() {
  out.found = u64{high} << 32 | low;
  out.pairs.size = static_cast<u32>(min_of(out.found, u64{out.pairs.capacity}));
  sort_in_place(out.pairs.data, out.pairs.size);
}

u32 find_meeting(const Mesh& m, const Grid& g, u32 f) {
  const Probe probe = probe_of(m, m.corner + 3 * f);
  const auto wanted = [&](u32 other) { return other != f; };
  return find_near(g, face_box(m, f), wanted, [&](u32 other) { return meets(m, probe, m.corner + 3 * other); });
}

void detect(const Mesh& m, const Grid& g, const DetectScope& scope, const Exec& exec, Detection& out) {
  // 512 faces: some 100 microseconds of work, against the few that handing out a chunk costs.
  constexpr u32 chunk = 512;
  out.pairs.clear();
  ContactSink sink{out};
  for_chunks(exec, scope.faces.size, chunk, [&](u32 first, u32 last) {
    for (u32 i = first; i < last; i += most_together)
      detect_faces(m, g, scope, {scope.faces.data + i, min_of(most_together, last - i)}, sink);
  });
  sink.finish();
}

}  // namespace tpa
