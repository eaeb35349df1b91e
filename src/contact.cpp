#include "contact.h"

#include <float.h>

#include "order.h"
#include "unfolded.h"

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

// A pair of two active faces is met from both sides: the lower one reports it.
bool reports(const DetectScope& scope, u32 f, u32 g) { return g > f || (g < f && scope.active[g] == 0); }

// Faces near some, their boxes side by side, and one round each row of them.
struct Around {
  // Enough for some that are unfolded and another sheet as fine as theirs.
  static constexpr u32 most = 2 * most_unfolded, row = 8;
  // So many are asked about: those of S, as many aside, and others. Where there are more, fewer at once cost less.
  static constexpr u32 most_asked = 2 * Unfolded::most + most;
  u32 count = 0, asked = 0;
  u32 face[most];
  f32 low[3][most], high[3][most], row_low[3][most / row], row_high[3][most / row];

  Around() {
    for (u32 k = 0; k < 3; ++k) empty(row_low[k], row_high[k], most / row);
  }
  Around(const Around&) = delete;

  static void empty(f32* low_at, f32* high_at, u32 n) {
    for (u32 i = 0; i < n; ++i) low_at[i] = FLT_MAX, high_at[i] = -FLT_MAX;
  }
  void add(u32 f, const Box& box) {
    const u32 at = count / row;
    for (u32 k = 0; k < 3; ++k) {
      // A row is looked at as a whole.
      if (count % row == 0) empty(low[k] + count, high[k] + count, row);
      low[k][count] = box.low[k], high[k][count] = box.high[k];
      row_low[k][at] = min_of(row_low[k][at], box.low[k]), row_high[k][at] = max_of(row_high[k][at], box.high[k]);
    }
    face[count++] = f;
  }
};

// But for those that `u`, unless it is nullptr, proves them not to meet. False where there are too many.
bool list_around(const Mesh& m, const Grid& grid, Span<const u32> some, const Unfolded* u, Around& around) {
  Box all = face_box(m, some[0]);
  for (u32 f : some) all = united(all, face_box(m, f));
  const auto any = [](u32) { return true; };
  return none == find_near(grid, all, any, [&](u32 g) {
    if (around.asked++ == Around::most_asked) return true;
    if (u != nullptr && (u->has(g) || is_aside(m, *u, g))) return false;
    if (around.count == Around::most) return true;
    around.add(g, face_box(m, g));
    return false;
  });
}

// A face, and what else is near it. Those that share a corner with it whose star is proven are apart.
struct Trier {
  const Mesh& m;
  const DetectScope& scope;
  ContactSink& sink;
  u32 f;
  u32 proven[3];

  void try_with(u32 g) const {
    const u32* corner = m.corner + 3 * static_cast<size_t>(g);
    bool apart = false;
    for (const u32 v : proven) apart |= (v == corner[0]) | (v == corner[1]) | (v == corner[2]);
    if (!apart && faces_meet(m, f, g)) sink.add(f, g);
  }
};
// Without stars none is proven.
Trier trier(const Mesh& m, const DetectScope& scope, u32 f, u8* star, ContactSink& sink) {
  Trier t{m, scope, sink, f, {none, none, none}};
  const u32* corner = m.corner + 3 * static_cast<size_t>(f);
  for (u32 k = 0; k < 3 && star != nullptr; ++k)
    if (star_proven(m, star, corner[k])) t.proven[k] = corner[k];
  return t;
}

void try_around(const Trier& t, const Around& around) {
  const ConstBoxLanes boxes{{around.low[0], around.low[1], around.low[2]},
                            {around.high[0], around.high[1], around.high[2]}},
                      rows{{around.row_low[0], around.row_low[1], around.row_low[2]},
                           {around.row_high[0], around.row_high[1], around.row_high[2]}};
  const BroadBox box = broad(flat(face_box(t.m, t.f)));
  u32 near[Around::most + 1], count = 0;
  for (u32 first = 0; first * Around::row < around.count; first += 4)
    for (u32 met = bits_of(lanes_meeting(rows, first, box)); met != 0; met &= met - 1) {
      const u32 at = (first + static_cast<u32>(__builtin_ctz(met))) * Around::row;
      u32 rest = 0;
TPA_UNROLL(2)
      for (u32 i = 0; i < Around::row; i += 4) rest |= bits_of(lanes_meeting(boxes, at + i, box)) << i;
      for (; rest != 0; rest &= rest - 1) {
        near[count] = around.face[at + static_cast<u32>(__builtin_ctz(rest))];
        count += reports(t.scope, t.f, near[count]) ? 1 : 0;
      }
    }
  // Apart from that, so that what it wants stays in registers.
  for (u32 i = 0; i < count; ++i) t.try_with(near[i]);
}

// Those that are unfolded need only be tried with what is not of their sheet, which shares no corner with them.
bool try_unfolded(const Mesh& m, const Grid& grid, const DetectScope& scope, Span<const u32> some, ContactSink& sink) {
  Unfolded u;
  Around around;
  if (!are_unfolded(m, some, u) || !list_around(m, grid, some, &u, around)) return false;
  if (around.count > 0)
    for (u32 f : some) try_around(trier(m, scope, f, nullptr, sink), around);
  return true;
}

// With all that is near. False where that is too much for several at once.
bool try_together(const Mesh& m, const Grid& grid, const DetectScope& scope, Span<const u32> some, ContactSink& sink) {
  Around around;
  const bool listed = list_around(m, grid, some, nullptr, around);
  if (!listed && some.size > 1) return false;
  for (u32 f : some) {
    const Trier t = trier(m, scope, f, scope.star, sink);
    if (listed)
      try_around(t, around);
    else
      for_each_near(grid, face_box(m, f), [&](u32 g) {
        if (reports(scope, f, g)) t.try_with(g);
      });
  }
  return true;
}

// So many are tried at once: they are near each other where they follow each other.
constexpr u32 part_of_group = 64;

void try_pairs(const Mesh& m, const Grid& grid, const DetectScope& scope, Span<const u32> faces, ContactSink& sink) {
  for (u32 first = 0, size = part_of_group; first < faces.size; first += size, size = min_of(2 * size, part_of_group)) {
    size = min_of(size, faces.size - first);
    while (!try_together(m, grid, scope, faces.part(first, size), sink)) size /= 2;
  }
}

// Where the surface bends too much for a whole group, it may not for so few of it.
void try_group(const Mesh& m, const Grid& grid, const DetectScope& scope, Span<const u32> faces, ContactSink& sink) {
  if (try_unfolded(m, grid, scope, faces, sink)) return;
  for (u32 first = 0; first < faces.size; first += part_of_group) {
    const Span<const u32> some = faces.part(first, min_of(part_of_group, faces.size - first));
    if (some.size == faces.size || !try_unfolded(m, grid, scope, some, sink)) try_pairs(m, grid, scope, some, sink);
  }
}

// ---------------------------------------------------------------- groups

// Groups of active faces follow each other. Two that do have different marks.
enum : u8 { is_active = 1, first_mark = 2, second_mark = 3 };

// What is reached over edges from one face after another: the nearest first, so that groups are about as wide as long.
void gather_groups(const Mesh& m, const DetectScope& scope, u32* group) {
  u32 count = 0;
  u8 mark = first_mark;
  const auto take = [&](u32 f) {
    if (scope.active[f] != is_active) return;
    scope.active[f] = mark;
    group[count++] = f;
  };
  for (u32 f : scope.faces) {
    if (scope.active[f] != is_active) continue;
    const u32 end = count + most_unfolded;
    u32 next = count;
    take(f);
    for (; next < count && count < end; ++next)
      for (u32 h = 3 * group[next]; h < 3 * group[next] + 3 && count < end; ++h)
        if (m.opposite[h] != none) take(face_of(m.opposite[h]));
    mark = mark == first_mark ? second_mark : first_mark;
  }
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

namespace {

// The groups that begin in first .. last - 1.
void try_groups(const Mesh& m, const Grid& g, const DetectScope& scope, Span<const u32> faces, u32 first, u32 last,
                ContactSink& sink) {
  const auto begins_group = [&](u32 i) { return i == 0 || scope.active[faces[i]] != scope.active[faces[i - 1]]; };
  while (first < last && !begins_group(first)) ++first;
  while (first < last) {
    u32 end = first + 1;
    while (end < faces.size && !begins_group(end)) ++end;
    try_group(m, g, scope, faces.part(first, end - first), sink);
    first = end;
  }
}

}  // namespace

void detect(const Mesh& m, const Grid& g, const DetectScope& scope, const Exec& exec, Detection& out) {
  // Some 100 microseconds of work, against the few that handing out a chunk costs.
  constexpr u32 chunk = 1024;
  out.pairs.clear();
  ContactSink sink{out};
  const bool grouped = scope.room.size >= scope.faces.size;
  if (grouped) gather_groups(m, scope, scope.room.data);
  for_chunks(exec, scope.faces.size, chunk, [&](u32 first, u32 last) {
    if (grouped)
      try_groups(m, g, scope, {scope.room.data, scope.faces.size}, first, last, sink);
    else
      try_pairs(m, g, scope, scope.faces.part(first, last - first), sink);
  });
  sink.finish();
}

}  // namespace tpa
