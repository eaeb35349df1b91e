#include "contact.h"

#include "order.h"
#include "predicates.h"

namespace tpa {

namespace {

// Stars with more triangles than this are not worth a proof.
constexpr u32 largest_proven_star = 32;

enum : u8 { star_unknown = 0, star_unfolded = 1, star_unproven = 2 };

// Vertices that two faces share: how many, and at which corner (index 0..2) the first one sits in each.
struct Sharing {
  u32 count = 0;
  u32 in_f = 0, in_g = 0;
};

inline Sharing sharing_of(const u32* f, const u32* g) {
  Sharing s;
  for (u32 i = 0; i < 3; ++i) {
    const u32 v = f[i];
    const bool shared = (v == g[0]) | (v == g[1]) | (v == g[2]);
    if (!shared) continue;
    if (s.count++ == 0) {
      s.in_f = i;
      s.in_g = v == g[0] ? 0 : v == g[1] ? 1 : 2;
    }
  }
  return s;
}

bool meet(const Mesh& m, const u32* f, const u32* g, const Sharing& s) {
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

// Two workers may prove the same star at once: both write the same byte.
bool star_proven(const Mesh& m, u8* star, u32 v) {
  if (star == nullptr) return false;
  u8 state = __atomic_load_n(star + v, __ATOMIC_RELAXED);
  if (state == star_unknown) {
    state = prove_star(m, v) ? star_unfolded : star_unproven;
    __atomic_store_n(star + v, state, __ATOMIC_RELAXED);
  }
  return state == star_unfolded;
}

struct Sink {
  Detection& out;
  u64 count = 0;
  // Order of arrival depends on the threads; the sort at the end removes it.
  void add(u32 f, u32 g) {
    const u64 at = __atomic_fetch_add(&count, u64{1}, __ATOMIC_RELAXED);
    if (at < out.pairs.capacity) out.pairs.data[at] = {min_of(f, g), max_of(f, g)};
  }
};

void detect_face(const Mesh& m, const Grid& grid, const DetectScope& scope, u32 f, Sink& sink) {
  const u32* cf = m.corner + 3 * f;
  // A pair of two active faces is met from both sides: the lower one reports it.
  const auto wanted = [&](u32 g) { return g > f || (g < f && scope.active != nullptr && scope.active[g] == 0); };
  find_near(grid, grid.entry[f].box, wanted, [&](u32 g) {
    const u32* cg = m.corner + 3 * g;
    const Sharing s = sharing_of(cf, cg);
    if ((s.count == 0 || !star_proven(m, scope.star, cf[s.in_f])) && meet(m, cf, cg, s)) sink.add(f, g);
    return false;
  });
}

}  // namespace

bool corners_meet(const Mesh& m, const u32* f, const u32* g) { return meet(m, f, g, sharing_of(f, g)); }

bool faces_meet(const Mesh& m, u32 f, u32 g) { return corners_meet(m, m.corner + 3 * f, m.corner + 3 * g); }

u32 find_meeting(const Mesh& m, const Grid& g, u32 f) {
  return find_near(
      g, g.entry[f].box, [&](u32 other) { return other != f; }, [&](u32 other) { return faces_meet(m, f, other); });
}

void detect(const Mesh& m, const Grid& g, const DetectScope& scope, const Exec& exec, Detection& out) {
  // 512 faces: some 100 microseconds of work, against the few that handing out a chunk costs.
  constexpr u32 chunk = 512;
  out.pairs.clear();
  Sink sink{out};
  const bool listed = scope.faces.data != nullptr;
  for_chunks(exec, listed ? scope.faces.size : m.face_count, chunk, [&](u32 first, u32 last) {
    for (u32 i = first; i < last; ++i) {
      const u32 f = listed ? scope.faces[i] : i;
      if (!face_lives(m, f) || (scope.active != nullptr && scope.active[f] == 0)) continue;
      detect_face(m, g, scope, f, sink);
    }
  });
  out.found = sink.count;
  out.pairs.size = static_cast<u32>(min_of(sink.count, u64{out.pairs.capacity}));
  sort_in_place(out.pairs.data, out.pairs.size);
}

namespace {

u32 find_root(const u32* root, u32 v) {
  while (root[v] != v) v = root[v];
  return v;
}

// Joins the vertices of one slot that mesh edges connect.
void gather_components(const Mesh& m, const VertexHash& h, u32 first) {
  for (u32 v = first; v != none; v = h.link[v]) h.root[v] = v;
  for (u32 v = first; v != none; v = h.link[v])
    for (u32 w = h.link[v]; w != none; w = h.link[w])
      if (find_root(h.root, v) != find_root(h.root, w) && find_edge(m, v, w) != none) {
        const u32 a = find_root(h.root, v), b = find_root(h.root, w);
        h.root[max_of(a, b)] = min_of(a, b);
      }
}

// A pair is found once for each pair of vertices that leads to it: collects them without repetition.
struct DistinctPairs {
  Stack<Contact>& pairs;
  u32 sorted = 0;     // pairs[0 .. sorted - 1] are sorted and distinct
  u64 left_out = 0;   // found when there was no room, perhaps more than once

  void tidy() {
    sort_in_place(pairs.data, pairs.size);
    sorted = 0;
    for (const Contact& c : pairs)
      if (sorted == 0 || pairs[sorted - 1] < c) pairs[sorted++] = c;
    pairs.size = sorted;
  }
  void add(u32 f, u32 g) {
    const Contact c{min_of(f, g), max_of(f, g)};
    if (pairs.size == pairs.capacity && sorted < pairs.size) tidy();
    if (pairs.push(c)) return;
    const u32 at = lower_bound(pairs.data, pairs.size, c);
    if (at == pairs.size || c < pairs[at]) ++left_out;
  }
};

void test_stars(const Mesh& m, u32 v, u32 w, DistinctPairs& found) {
  for_each_outgoing(m, v, [&](u32 hv) {
    for_each_outgoing(m, w, [&](u32 hw) {
      const u32 f = face_of(hv), g = face_of(hw);
      if (f != g && faces_meet(m, f, g)) found.add(f, g);
    });
  });
}

}  // namespace

void detect_by_vertices(const Mesh& m, const VertexHash& h, Detection& out) {
  out.pairs.clear();
  DistinctPairs found{out.pairs};
  for (u32 s = 0; s < h.slots; ++s) h.head[s] = none;
  for (u32 v = m.vertex_count; v-- > 0;) {
    const Vec3& p = m.position[v];
    const u32 s = hash_cell(floor_to_integer(p.x / h.cell), floor_to_integer(p.y / h.cell),
                            floor_to_integer(p.z / h.cell), h.slots);
    h.link[v] = h.head[s];
    h.head[s] = v;
  }
  for (u32 s = 0; s < h.slots; ++s) {
    const u32 first = h.head[s];
    if (first == none || h.link[first] == none) continue;
    gather_components(m, h, first);
    for (u32 v = first; v != none; v = h.link[v])
      for (u32 w = h.link[v]; w != none; w = h.link[w])
        if (find_root(h.root, v) != find_root(h.root, w)) test_stars(m, v, w, found);
  }
  found.tidy();
  out.found = out.pairs.size + found.left_out;
}

}  // namespace tpa
