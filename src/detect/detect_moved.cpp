#include "detect/detect_moved.h"

#include <string.h>

#include "base/sort.h"
#include "detect/cull_faces.h"
#include "geometry/slab_bitmaps.h"
#include "geometry/star.h"

namespace tpa {

namespace {

enum : u8 { star_unknown = 0, star_unfolded = 1, star_unproven = 2 };

bool prove_star(const Mesh& m, u32 v) {
  Points<star_room> room;
  Vec3* const link = room.data();
  u32 n = 0;
  bool small = true;
  for_each_neighbour(m, v, [&](u32 u) {
    if (n == star_is_unfolded_limit)
      small = false;
    else
      link[n++] = m.position[u];
  });
  return small && star_is_unfolded(m.position[v], link, n);
}

// Does what g does not share with the plane's face lie strictly on one side of it? False where there is no such thing,
// or where that is not certain.
bool lies_beside(const Mesh& m, const Plane& plane, const u32* g, u32 shared) {
  const CertainSides s = certain_sides(plane, m.position[g[0]], m.position[g[1]], m.position[g[2]]);
  return (((s.above | shared) == 7) | ((s.below | shared) == 7)) & (shared != 7);
}

// So many that are not proven are tried at once: they are near each other where they follow each other.
constexpr u32 words_of_part = TPA_SMALL ? 1 : 2, part_of_group = words_of_part * SlabSets::of_word;
static_assert(part_of_group <= most_unfolded);

// Which faces of a part have which corners, of those whose stars are proven: a bit for each face, by vertex, in an open
// hash. A face that shares one of these with another is apart from it.
struct ProvenCorners {
  static constexpr u32 bits = TPA_SMALL ? 8 : 9, places = 1u << bits;  // a part has fewer corners
  static_assert(3 * part_of_group < places);
  u32 vertex[places];
  u64 faces[places][words_of_part];

  // All corners are entered, then those of stars that are not proven lose their faces: whether a star has been looked
  // at is as good as random where a face meets it, and not among vertices.
  ProvenCorners(const Mesh& m, const DetectScope& scope, Span<const u32> some) {
    u16 taken[3 * part_of_group];
    u32 count = 0;
    memset(vertex, 0xFF, sizeof vertex);
    memset(faces, 0, sizeof faces);
    for (u32 i = 0; i < some.size; ++i)
      for (u32 k = 0; k < 3; ++k) {
        const u32 v = m.corner[3 * static_cast<size_t>(some[i]) + k], at = place_of(v);
        taken[count] = static_cast<u16>(at);
        count += vertex[at] != v ? 1u : 0u;
        vertex[at] = v;
        faces[at][i / SlabSets::of_word] |= u64{1} << i % SlabSets::of_word;
      }
    for (u32 j = 0; j < count; ++j) {
      const u32 at = taken[j];
      const u64 kept = star_proven(m, scope.star, vertex[at]) ? ~u64{0} : 0;
      for (u64& of : faces[at]) of &= kept;
    }
  }
  ProvenCorners(const ProvenCorners&) = delete;

  u32 place_of(u32 v) const {
    u32 at = static_cast<u32>(v * scattering >> (64 - bits));
    // Until one of the two is zero. Whether v is there is as good as random, and no branch of its own.
    while (min_of(vertex[at] ^ none, vertex[at] ^ v) != 0) at = (at + 1) % places;
    return at;
  }
  // For each word of sixty-four the faces of the part that share one with g.
  void note_beside(const u32* g, u64* apart) const {
    const u32 a = place_of(g[0]), b = place_of(g[1]), c = place_of(g[2]);
    for (u32 k = 0; k < words_of_part; ++k) apart[k] = faces[a][k] | faces[b][k] | faces[c][k];
  }
};

// Faces that are tried at once.
struct Tried {
  Span<const u32> faces;
  const ProvenCorners* proven = nullptr;  // of a part
  Box all = empty_box;
  f32 largest = 0;  // extent of one
  Box box[most_unfolded];

  Tried(const Mesh& m, Span<const u32> some) : faces(some) {
    for (u32 i = 0; i < some.size; ++i) {
      box[i] = face_box(m, some[i]);
      all = united(all, box[i]);
      largest = max_of(largest, extent_of(box[i]));
    }
  }
  Tried(const Tried&) = delete;
};
static_assert(most_unfolded <= SlabSets::most);

// Of an active face f. A pair of two active faces is met from both sides: the lower one reports it.
bool reports(u32 f, u32 g, bool g_is_active) { return !g_is_active | (f < g); }

// Which from face `first` on, of those that are tried, have boxes that meet a face near by: a bit for each.
struct Met {
  u64 boxes;
  u32 first, near;
};
struct MetList {
  static constexpr u32 most = 128;
  static_assert(most >= SlabSets::most / SlabSets::of_word);
  u32 count = 0;
  Met met[most];
};

// A face that is tried, and one near it.
enum Side : u32 { of_tried, of_near };
struct NearPair {
  u32 face[2];
};

// Moves the pairs that the plane of one of the faces does not certainly part to the front. How many there are. One
// behind the last is written.
#if defined(TPA_VECTORS)
// Two at a time: of the bits that tell something of three corners every other one is of the second pair.
u32 keep_unparted(const Mesh& m, Side plane, NearPair* pair, u32 count) {
  static constexpr u8 spread[8] = {0x00, 0x01, 0x04, 0x05, 0x10, 0x11, 0x14, 0x15};
  constexpr u32 first = 0x15, second = 0x2A;
  u32 kept = 0;
  if (count != 0) pair[count] = pair[0];
  for (u32 k = 0; k < count; k += 2) {
    const NearPair p = pair[k], q = pair[k + 1];
    const auto corners = [&](const NearPair& of, u32 side) {
      return m.corner + 3 * static_cast<size_t>(of.face[side]);
    };
    const u32 *a = corners(p, plane), *b = corners(q, plane), *v = corners(p, 1 - plane), *w = corners(q, 1 - plane);
    const auto at = [&](u32 i, u32 j) { return two_points(m.position[i], m.position[j]); };
    const TwoPlanes planes = planes_of(at(a[0], b[0]), at(a[1], b[1]), at(a[2], b[2]));
    const u32 shared = spread[shared_corners(v, a)] + 2u * spread[shared_corners(w, b)];
    u32 above = shared, below = shared;
    for (u32 i = 0; i < 3; ++i) {
      const Height<D2> h = heights_above(planes, at(v[i], w[i]));
      above |= bits_of_two(h.value > h.doubt) << 2 * i;
      below |= bits_of_two(h.value < -h.doubt) << 2 * i;
    }
    const auto parted = [&](u32 bits) {
      return (((above & bits) == bits) | ((below & bits) == bits)) & ((shared & bits) != bits);
    };
    pair[kept] = p;
    kept += parted(first) ? 0 : 1;
    pair[kept] = q;
    kept += (parted(second) | (k + 1 == count)) ? 0 : 1;
  }
  return kept;
}
#else
u32 keep_unparted(const Mesh& m, Side plane, NearPair* pair, u32 count) {
  u32 kept = 0;
  for (u32 k = 0; k < count; ++k) {
    const NearPair p = pair[k];
    const u32* of = m.corner + 3 * static_cast<size_t>(p.face[plane]);
    const u32* v = m.corner + 3 * static_cast<size_t>(p.face[1 - plane]);
    pair[kept] = p;
    kept += lies_beside(m, probe_of(m, of).plane, v, shared_corners(v, of)) ? 0 : 1;
  }
  return kept;
}
#endif

// What cuts out faces in contact goes round their vertices, from these vertices' edges on. Inlined by force, as `fetch`
// is.
[[gnu::always_inline]] inline void fetch_vertices(const Mesh& m, u32 f) {
  for (u32 i = 0; i < 3; ++i) fetch(m.vertex_edge + m.corner[3 * static_cast<size_t>(f) + i]);
}

// Tries what was noted. Without a branch before the last test, nor a loop that ends for each face near by: what they
// say is as good as random.
void try_met(const Mesh& m, const DetectScope& scope, const Tried& t, MetList& list, ContactSink& sink) {
  constexpr u32 most_pairs = 256;
  NearPair pair[most_pairs + 1];
  for (u32 i = 0; i < list.count;) {
    u32 pairs = 0;
    while (i < list.count && pairs < most_pairs) {
      Met& met = list.met[i];
      const u32 f = t.faces[met.first + static_cast<u32>(__builtin_ctzll(met.boxes))];
      pair[pairs] = {{f, met.near}};
      pairs += reports(f, met.near, scope.active[met.near] != 0) ? 1u : 0u;
      met.boxes &= met.boxes - 1;
      i += met.boxes == 0 ? 1u : 0u;
    }
    pairs = keep_unparted(m, of_near, pair, pairs);
    pairs = keep_unparted(m, of_tried, pair, pairs);
    for (u32 k = 0; k < pairs; ++k) {
      const u32* f = pair[k].face;
      fetch_vertices(m, f[of_near]);
      if (faces_meet(m, f[0], f[1])) sink.add(f[0], f[1]);
    }
  }
  list.count = 0;
}

// Notes what is tried that may meet a face near by.
void note_met(const Mesh& m, const Tried& t, const SlabSets& boxes, u32 g, MetList& list) {
  u64 met[SlabSets::most / SlabSets::of_word], apart[SlabSets::most / SlabSets::of_word] = {};
  boxes.meeting(face_box(m, g), met);
  if (t.proven != nullptr) t.proven->note_beside(m.corner + 3 * static_cast<size_t>(g), apart);
  for (u32 w = 0; w < boxes.words; ++w) {
    list.met[list.count] = {met[w] & ~apart[w], w * SlabSets::of_word, g};
    list.count += list.met[list.count].boxes != 0 ? 1u : 0u;
  }
}

void try_with(const Mesh& m, const DetectScope& scope, const Tried& t, Span<const u32> near, ContactSink& sink) {
  SlabSets::Word room[SlabSets::most / SlabSets::of_word];
  const SlabSets boxes({t.box, t.faces.size}, t.all, room);
  MetList list;
  for (u32 g : near) {
    if (list.count + boxes.words > MetList::most) try_met(m, scope, t, list, sink);
    note_met(m, t, boxes, g, list);
  }
  try_met(m, scope, t, list, sink);
}

// Faces near those that are tried. Where these are unfolded, S, as many aside, and another sheet as fine are asked
// about.
struct Around {
  static constexpr u32 most = 2048;
  u32 count = 0, asked = 0;
  u32 face[most];
};

// But for those that `u`, unless it is nullptr, proves them not to meet. False where more than so many have to be
// asked.
bool list_around(const Mesh& m, const NearFaces& near_faces, const Tried& t, const Unfolded* u, u32 most_asked,
                 Around& around) {
  const auto any = [](u32) { return true; };
  return none == find_near(near_faces, t.all, any, [&](u32 g) {
           if (around.asked++ == most_asked) return true;
           if (u == nullptr || !(u->has(g) || is_aside(m, *u, g))) {
             around.face[around.count++] = g;
             fetch(m.opposite + 3 * static_cast<size_t>(g));
           }
           return false;
         });
}

// Those that are unfolded need only be tried with what is not of their sheet.
bool try_unfolded(const Mesh& m, const NearFaces& near_faces, const DetectScope& scope, Span<const u32> some,
                  ContactSink& sink) {
  Unfolded u;
  if (!are_unfolded(m, some, u)) return false;
  const Tried t(m, some);
  Around around;
  if (!list_around(m, near_faces, t, &u, Around::most, around)) return false;
  try_with(m, scope, t, {around.face, around.count}, sink);
  return true;
}

// With all that is near. False where they do not lie side by side, or amid much smaller ones: a whole part is some
// eleven faces wide, with a few hundred near it where two sheets meet.
bool try_together(const Mesh& m, const NearFaces& near_faces, const DetectScope& scope, Span<const u32> some,
                  ContactSink& sink) {
  Tried t(m, some);
  Around around;
  const u32 most_near = 256 + 14 * some.size;
  static_assert(256 + 14 * part_of_group <= Around::most);
  if (extent_of(t.all) > 16 * t.largest || !list_around(m, near_faces, t, nullptr, most_near, around)) return false;
  const ProvenCorners proven(m, scope, some);
  t.proven = &proven;
  try_with(m, scope, t, {around.face, around.count}, sink);
  return true;
}

void try_alone(const Mesh& m, const NearFaces& near_faces, const DetectScope& scope, u32 f, ContactSink& sink) {
  const u32* corner = m.corner + 3 * static_cast<size_t>(f);
  const auto apart = [&](u32 g) {
    const u32 shared = shared_corners(corner, m.corner + 3 * static_cast<size_t>(g));
    for (u32 k = 0; k < 3; ++k)
      if ((shared >> k & 1) != 0 && star_proven(m, scope.star, corner[k])) return true;
    return false;
  };
  for_each_near(near_faces, face_box(m, f), [&](u32 g) {
    if (reports(f, g, scope.active[g] != 0) && !apart(g) && faces_meet(m, f, g)) sink.add(f, g);
  });
}

// Those that follow each other mostly lie side by side. Where some do not, so few are tried for the rest of a part.
void try_pairs(const Mesh& m, const NearFaces& near_faces, const DetectScope& scope, Span<const u32> faces,
               ContactSink& sink) {
  for (u32 first = 0, size = 0; first < faces.size; first += size) {
    size = min_of(first % part_of_group == 0 ? part_of_group : size, faces.size - first);
    while (size > 1 && !try_together(m, near_faces, scope, faces.part(first, size), sink)) size /= 2;
    if (size == 1) try_alone(m, near_faces, scope, faces[first], sink);
  }
}

// Where the surface bends too much for a whole group, it may not for so few of it.
void try_group(const Mesh& m, const NearFaces& near_faces, const DetectScope& scope, Span<const u32> faces,
               ContactSink& sink) {
  if (try_unfolded(m, near_faces, scope, faces, sink)) return;
  for (u32 first = 0; first < faces.size; first += part_of_group) {
    const Span<const u32> some = faces.part(first, min_of(part_of_group, faces.size - first));
    if (some.size == faces.size || !try_unfolded(m, near_faces, scope, some, sink))
      try_pairs(m, near_faces, scope, some, sink);
  }
}

// ---------------------------------------------------------------- groups

// Groups of active faces follow each other. Two that do have different marks.
enum : u8 { is_active = 1, first_mark = 2, second_mark = 3 };

// What is reached over edges from one face after another: the nearest first, so that groups are about as wide as long.
// Whether a face is new is as good as random: it is written behind the others first, and then counted or not.
void gather_groups(const Mesh& m, const DetectScope& scope, u32* group) {
  u32 count = 0;
  u8 mark = first_mark;
  const auto take = [&](u32 f, u32 end) {
    const bool taken = (scope.active[f] == is_active) & (count < end);
    scope.active[f] = static_cast<u8>(scope.active[f] + taken * (mark - is_active));
    group[count] = f;
    count += taken;
  };
  for (u32 f : scope.faces) {
    if (scope.active[f] != is_active) continue;
    const u32 end = count + most_unfolded;
    u32 next = count;
    take(f, end);
    for (; next < count && count < end; ++next)
      for (u32 h = 3 * group[next]; h < 3 * group[next] + 3; ++h)
        if (m.opposite[h] != none) take(face_of(m.opposite[h]), end);
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

bool corners_meet(const Mesh& m, const u32* f, const u32* g) {
  const Vec3* p = m.position;
  const u32 of_f = shared_corners(f, g), of_g = shared_corners(g, f);
  if (of_f == 0) return triangles_meet(triangle_of(m, f), triangle_of(m, g));
  if (of_f == 7) return true;
  // The only corner of each that is shared, or that is not.
  const bool one = (of_f & (of_f - 1)) == 0;
  const u32 i = static_cast<u32>(__builtin_ctz(one ? of_f : 7 ^ of_f));
  const u32 j = static_cast<u32>(__builtin_ctz(one ? of_g : 7 ^ of_g));
  const Vec3 &a = p[f[i]], &a1 = p[f[(i + 1) % 3]], &a2 = p[f[(i + 2) % 3]];
  return one ? triangles_meet_beyond_vertex(a, a1, a2, p[g[(j + 1) % 3]], p[g[(j + 2) % 3]])
             : triangles_meet_beyond_edge(a1, a2, a, p[g[j]]);
}

bool meets(const Mesh& m, const Probe& f, const u32* g) {
  return !lies_beside(m, f.plane, g, shared_corners(g, f.v)) &&
         !lies_beside(m, probe_of(m, g).plane, f.v, shared_corners(f.v, g)) && corners_meet(m, f.v, g);
}

void ContactSink::finish() {
  out.found = u64{high} << 32 | low;
  out.pairs.size = static_cast<u32>(min_of(out.found, u64{out.pairs.capacity}));
  sort_in_place(out.pairs.data, out.pairs.size);
}

namespace {

// The groups that begin in first .. last - 1.
void try_groups(const Mesh& m, const NearFaces& g, const DetectScope& scope, Span<const u32> faces, u32 first, u32 last,
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

void detect(const Mesh& m, const NearFaces& g, const DetectScope& scope, const Exec& exec, Detection& out) {
  // Some 100 microseconds of work, against the few that handing out a chunk costs.
  constexpr u32 chunk = 1024;
  out.pairs.clear();
  ContactSink sink{out};
  const bool grouped = scope.room.size > scope.faces.size;
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
