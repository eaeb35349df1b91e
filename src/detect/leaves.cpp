#include "detect/leaves.h"

#include "base/simd.h"

namespace tpa {

namespace {

// The search of one zone. In patch_of its faces have numbers from `start` to start + most: those of patches, or the
// last one of these, which no patch gets, where a face is free. Other zones may be searched at the same time. Each
// notes patches of its own faces only, so what is read of others is never taken for one of this zone.
struct Search {
  const Mesh& m;
  const f32* point;
  Patches& p;
  u32* patch_of;
  u32 start, most;             // patches
  bool slender, bent;          // there are slender faces; most bend
  u32 count = 0;               // patches
  u32 made;                    // place behind the faces in patches
  u32 seed_patch, seed_place;  // all before have no neighbour that is free
  u32 lowest = 0;              // all faces of the zone before are in patches
  u32 free() const { return start + most; }
};

u32 neighbour(const Search& s, u32 face, u32 side) { return face_of(s.m.opposite[3 * face + side]); }
u32 patch_at(const Search& s, u32 face) { return __atomic_load_n(s.patch_of + face, __ATOMIC_RELAXED); }
bool is_free(const Search& s, u32 face) { return patch_at(s, face) == s.free(); }
void note_patch(u32* patch_of, u32 patch) { __atomic_store_n(patch_of, patch, __ATOMIC_RELAXED); }

// A face in no patch beside the earliest patches: what is left between patches is taken before it is cut up.
u32 next_seed(Search& s) {
  const Patches& p = s.p;
  for (; s.seed_patch < s.start + s.count; ++s.seed_patch) {
    const u32 last = p.first[s.seed_patch + 1];
    for (u32 at = max_of(s.seed_place, p.first[s.seed_patch] + p.looked[s.seed_patch]); at < last; ++at)
      for (u32 i = 0; i < 3; ++i)
        if (const u32 g = neighbour(s, p.face[at], i); is_free(s, g)) {
          s.seed_place = at;
          return g;
        }
  }
  while (!is_free(s, s.lowest)) ++s.lowest;
  return s.lowest;
}

// Squares of a face's edges.
struct Sides {
  f32 square[3] = {};
  f32 longest() const { return max_of(square[0], max_of(square[1], square[2])); }
  f32 shortest() const { return min_of(square[0], min_of(square[1], square[2])); }
};
Sides sides_of(const Mesh& m, const f32* point, u32 face) {
  const u32* v = m.corner + 3 * static_cast<size_t>(face);
  F4 p[3];
  for (u32 i = 0; i < 3; ++i) p[i] = load4(point + 3 * static_cast<size_t>(v[i]));
  F4 x = p[1] - p[0], y = p[2] - p[1], z = p[0] - p[2], rest{};
  x *= x, y *= y, z *= z;
  transpose(x, y, z, rest);
  const F4 square = x + y + z;
  return {{square[0], square[1], square[2]}};
}

// Faces whose edges differ less are equilateral enough for a search that counts all steps alike.
constexpr f32 slender = 2.5f * 2.5f;
// A patch of slender faces is about as long as wide where its search crosses short edges once either way, for ratios of
// the edges to this one; where it crosses none, for higher ones.
constexpr f32 very_slender = 6 * 6;

// A face, and those beside it.
struct Row {
  u32 face, beside[3];
};
inline Row row_of(const Search& s, u32 face) {
  return {face, {neighbour(s, face, 0), neighbour(s, face, 1), neighbour(s, face, 2)}};
}

// Whether neighbours are new is as good as random, so nothing branches on it: where one is not, the face gets its own
// patch once more. What the search will read of them is fetched meanwhile, and the row of the next face is read before
// anything is written: a processor that knew not yet where to would not read on.
u32 grow_round(Search& s, u32 first, u32 full, u32 patch) {
  u32 *const face = s.p.face, *const patch_of = s.patch_of;
  const u32 free = s.free();
  u32 at = first, made = s.made;
  Row row = row_of(s, face[at]);
  for (;;) {
    const bool known = ++at < made;
    const Row next = known ? row_of(s, face[at]) : row;
    for (u32 i = 0; i < 3; ++i) {
      const u32 f = row.face, g = row.beside[i], fresh = patch_at(s, g) == free ? 1 : 0;
      face[made] = g;
      made += fresh;
      note_patch(patch_of + (f ^ ((f ^ g) & (0 - fresh))), patch);
      fetch(s.m.opposite + 3 * static_cast<size_t>(g));
    }
    if (at >= made || made >= full) break;
    row = known ? next : row_of(s, face[at]);
  }
  s.made = made;
  return at - first;
}

// Crosses no more than so many short edges from the seed. Faces that are left with others beyond them come last.
u32 grow_slender(Search& s, u32 first, u32 full, u32 patch, u8 most_short) {
  u8 crossed[most_in_patch];
  u32* face = s.p.face;
  u32 looked = first;
  crossed[0] = 0;
  for (u32 at = first; at < s.made && s.made < full; ++at) {
    const u32 f = face[at];
    const u8 before = crossed[at - first];
    const Sides sides = sides_of(s.m, s.point, f);
    bool all = true;
    for (u32 i = 0; i < 3; ++i) {
      const u32 g = neighbour(s, f, i);
      if (!is_free(s, g)) continue;
      const bool is_short = sides.square[i] * slender < sides.longest();
      if (is_short && before == most_short) {
        all = false;
        continue;
      }
      crossed[s.made - first] = static_cast<u8>(before + (is_short ? 1 : 0));
      note_patch(s.patch_of + g, patch);
      face[s.made++] = g;
    }
    if (!all) continue;
    crossed[at - first] = crossed[looked - first];
    face[at] = face[looked];
    face[looked++] = f;
  }
  return looked - first;
}

bool is_slender(const Sides& sides) { return sides.longest() > slender * sides.shortest(); }

// A patch of forty reaches four faces far: by twenty degrees there, as on a tube with forty edges round it. Noise does
// not add up on the way, which ends at a hole in the numbering.
constexpr f64 flat = 0.94;
bool bends(const Mesh& m, u32 face) {
  u32 h = 3 * face;
  for (u32 k = 0; k < 4; ++k) {
    h = k % 2 == 0 ? next_edge(m.opposite[h]) : previous_edge(m.opposite[h]);
    if (!face_lives(m, face_of(h))) return false;
  }
  const Vec3 a = face_normal(m, face), b = face_normal(m, face_of(h));
  return !(dot(a, b) > 0) || dot(a, b) * dot(a, b) < flat * flat * squared_length(a) * squared_length(b);
}

// What the surface is like, as some of its faces tell. Is one slender, of as many as there will be patches or fewer? If
// not, no seed is looked at: what lies far apart in memory takes longer to fetch than a patch to grow. Do half of
// every fourth of them bend?
struct Kind {
  bool slender, bent;
};
constexpr u32 kind_chunk = 1u << 14;
Kind kind_of(const Mesh& m, const f32* point, const Exec& exec) {
  u32 slender_chunks = 0, looked = 0, bent = 0;
  for_chunks(exec, m.face_count, kind_chunk, [&](u32 first, u32 last) {
    u32 any_slender = 0, mine = 0, mine_bent = 0;
    for (u32 f = first; f < last; f += 64) {
      if (!face_lives(m, f)) continue;
      if (any_slender == 0) any_slender = is_slender(sides_of(m, point, f)) ? 1 : 0;
      if (f % 256 != 0) continue;
      ++mine;
      mine_bent += bends(m, f) ? 1 : 0;
    }
    __atomic_fetch_add(&slender_chunks, any_slender, __ATOMIC_RELAXED);
    __atomic_fetch_add(&looked, mine, __ATOMIC_RELAXED);
    __atomic_fetch_add(&bent, mine_bent, __ATOMIC_RELAXED);
  });
  return {slender_chunks != 0, 2 * bent > looked};
}

// Returns how many of the faces were looked at before there were enough.
u32 grow(Search& s, u32 seed, u32 patch) {
  const u32 most = s.bent ? most_in_bent_patch : most_in_patch;
  const u32 first = s.made, full = first + most - 2;
  note_patch(s.patch_of + seed, patch);
  s.p.face[s.made++] = seed;
  const Sides sides = s.slender ? sides_of(s.m, s.point, seed) : Sides{};
  if (!is_slender(sides)) return grow_round(s, first, full, patch);
  return grow_slender(s, first, full, patch, sides.longest() > very_slender * sides.shortest() ? 0 : 1);
}

// Joins a neighbour among the patches from s.start on, s.count of them.
void join_neighbour(const Search& s, u32 patch) {
  Patches& p = s.p;
  for (u32 at = p.first[patch]; at < p.first[patch + 1]; ++at)
    for (u32 i = 0; i < 3; ++i) {
      const u32 other = patch_at(s, neighbour(s, p.face[at], i));
      if (other == patch || other - s.start >= s.count) continue;
      const u32 leader = p.leader[other];
      const u32 size = u32{p.size[leader]} + p.size[patch];
      if (size > most_in_joined_patches) continue;
      p.leader[patch] = leader;
      p.following[patch] = p.following[leader];
      p.following[leader] = patch;
      p.size[leader] = static_cast<u8>(size);
      return;
    }
}

// Reads in order what the search of a range of faces reads in its own, so that it is near by then: one word of every
// line of 64 bytes; and of points, where seeds are measured.
void read_ahead(const Search& s, u32 first, u32 last) {
  const auto read = [](const volatile auto* word) { static_cast<void>(*word); };
  for (u32 f = first; f < last; f += 5) read(s.m.opposite + 3 * static_cast<size_t>(f));
  for (u32 f = first; f < last; f += 16) read(s.patch_of + f);
  if (!s.slender) return;
  for (u32 f = first; f < last; f += 5)
    if (face_lives(s.m, f)) read(s.point + 3 * static_cast<size_t>(s.m.corner[3 * static_cast<size_t>(f)]));
}

void search_zone(Search& s, u32 last_place) {
  Patches& p = s.p;
  while (s.made < last_place) {
    const u32 patch = s.start + s.count, seed = next_seed(s);
    p.first[patch] = s.made;
    p.looked[patch] = static_cast<u8>(grow(s, seed, patch));
    // Further pieces, where what is left could not be done with the numbers that are left.
    const u32 numbers = s.most - s.count - 1;
    while (s.made - p.first[patch] < fewest_in_patch && s.made < last_place &&
           numbers <= (last_place - s.made) / fewest_in_patch)
      grow(s, next_seed(s), patch);
    p.first[patch + 1] = s.made;
    p.leader[patch] = patch;
    p.following[patch] = none;
    p.size[patch] = static_cast<u8>(s.made - p.first[patch]);
    ++s.count;
    // Beside the first patch of a component that is smaller there is nothing to join.
    if (p.size[patch] < fewest_in_patch) join_neighbour(s, patch);
  }
}

// What zones cut off may be beside a patch of another zone only.
void join_across_zones(const Mesh& m, Patches& p, u32* patch_of) {
  const u32 all = p.start[p.zones - 1] + p.count[p.zones - 1];
  const Search s{m, nullptr, p, patch_of, 0, all, false, false, all, 0, 0, 0};
  for_each_patch(p, [&](u32 i) {
    if (p.leader[i] == i && p.size[i] < fewest_in_patch && p.following[i] == none) join_neighbour(s, i);
  });
}

// ---------------------------------------------------------------- zones

// What is cut at borders of zones should not matter beside what is within.
constexpr u32 fewest_in_zone = 1u << 15;
constexpr u32 samples = 1024;

// Do numbers tell which faces are near each other? If not, most neighbours are in other ranges of numbers.
bool is_coherent(const Mesh& m, u32 width) {
  u32 looked = 0, crossing = 0;
  for (u32 f = 0; f < m.face_count; f += m.face_count / samples) {
    if (!face_lives(m, f)) continue;
    for (u32 i = 0; i < 3; ++i, ++looked) crossing += face_of(m.opposite[3 * f + i]) / width != f / width ? 1 : 0;
  }
  return crossing * 8 <= looked;
}

// Zones are ranges of numbers.
void cut_by_number(const Mesh& m, u32 width, const Exec& exec, u32* patch_of, u32* count) {
  for_chunks(exec, m.face_count, width, [&](u32 first, u32 last) {
    const u32 zone = first / width;
    const u32 free = zone * (most_patches_in_zone(width) + 1) + most_patches_in_zone(last - first);
    for (u32 f = first; f < last; ++f) patch_of[f] = free;
    count[zone] = last - first;
  });
}

// A zone for each cell of a coarse near_faces, such that zones have about as many faces each. In the order of the
// curve.
constexpr u32 cell_bits = 3, cells = 1u << 3 * cell_bits;
struct CellZones {
  u8 zone[cells];
};
u32 cell_of(const Mesh& m, const f32* point, u32 f) {
  const f32* p = point + 3 * static_cast<size_t>(m.corner[3 * static_cast<size_t>(f)]);
  constexpr f32 scale = static_cast<f32>(1u << (cell_bits - 1)) * (1 - 0x1p-20f);
  const auto cell = [&](f32 x) { return static_cast<u32>(static_cast<i32>((x + 1) * scale)); };
  return cell(p[0]) | cell(p[1]) << cell_bits | cell(p[2]) << 2 * cell_bits;
}
u32 cell_on_curve(u32 place) {
  u32 cell = 0;
  for (u32 bit = 0; bit < 3 * cell_bits; ++bit) cell |= (place >> bit & 1) << (bit % 3 * cell_bits + bit / 3);
  return cell;
}
void share_cells(const Mesh& m, const f32* point, u32 zones, CellZones& cell_zones) {
  u32 count[cells] = {}, all = 0, before = 0;
  for (u32 f = 0; f < m.face_count; f += m.face_count / samples)
    if (face_lives(m, f)) ++count[cell_of(m, point, f)], ++all;
  for (u32 place = 0; place < cells; ++place) {
    const u32 cell = cell_on_curve(place);
    cell_zones.zone[cell] = static_cast<u8>(min_of(zones - 1, before * zones / max_of(all, 1u)));
    before += count[cell];
  }
}

void cut_by_place(const Mesh& m, const f32* point, u32 zones, const Exec& exec, u32* patch_of, u32* count) {
  CellZones cell_zones;
  share_cells(m, point, zones, cell_zones);
  for_chunks(exec, m.face_count, fewest_in_zone, [&](u32 first, u32 last) {
    u32 mine[most_zones] = {};
    for (u32 f = first; f < last; ++f) {
      const u32 z = face_lives(m, f) ? cell_zones.zone[cell_of(m, point, f)] : 0;
      ++mine[z];
      patch_of[f] = z;
    }
    for (u32 z = 0; z < zones; ++z) __atomic_fetch_add(count + z, mine[z], __ATOMIC_RELAXED);
  });
  u32 free[most_zones], end = 0;
  for (u32 z = 0; z < zones; ++z) free[z] = (end += most_patches_in_zone(count[z])) + z;
  for_chunks(exec, m.face_count, fewest_in_zone, [&](u32 first, u32 last) {
    for (u32 f = first; f < last; ++f) patch_of[f] = free[patch_of[f]];
  });
}

}  // namespace

void lay_out_patches(Carver& carver, u64 faces, Patches& p) {
  carver.take(p.face, faces + most_zones);  // in each, one more is written than is counted
  const u64 patches = most_patches(faces);
  carver.take(p.first, patches);
  carver.take(p.leader, patches);
  carver.take(p.following, patches);
  carver.take(p.size, patches);
  carver.take(p.looked, patches);
}

void find_patches(const Mesh& m, const f32* point, const Exec& exec, Patches& p, u32* patch_of) {
  u32 zones = 1;
  while (zones < most_zones && m.face_count / (2 * zones) >= fewest_in_zone) zones *= 2;
  const u32 width = m.face_count / zones + 1;
  u32 faces[most_zones] = {};
  const bool coherent = zones == 1 || is_coherent(m, width);
  if (coherent)
    cut_by_number(m, width, exec, patch_of, faces);
  else
    cut_by_place(m, point, zones, exec, patch_of, faces);
  p.zones = zones;
  u32 place[most_zones], living[most_zones];
  for (u32 z = 0, patches = 0, places = 0; z < zones; ++z) {
    p.start[z] = patches, place[z] = places, living[z] = faces[z];
    patches += most_patches_in_zone(faces[z]) + 1, places += faces[z] + 1;
  }
  // No search reaches a hole in the numbering, nor begins there.
  for (u32 f = m.free_face; f != none; f = m.corner[3 * f + 1]) {
    u32 z = 0;
    while (patch_of[f] != p.start[z] + most_patches_in_zone(faces[z])) ++z;
    --living[z];
    patch_of[f] = none;
  }
  const Kind kind = kind_of(m, point, exec);
  for_chunks(exec, zones, 1, [&](u32 z, u32) {
    const u32 start = p.start[z], from = place[z];
    Search s{m,         point, p,    patch_of, start, most_patches_in_zone(faces[z]), kind.slender,
             kind.bent, 0,     from, start,    from,  coherent ? z * width : 0};
    if (!TPA_SMALL && coherent) read_ahead(s, z * width, z * width + faces[z]);
    search_zone(s, from + living[z]);
    p.count[z] = s.count;
  });
  if (zones > 1) join_across_zones(m, p, patch_of);
}

}  // namespace tpa
