// SPDX-License-Identifier: MIT
#include "detect/leaves.h"

#include "base/simd.h"

namespace tpa {

namespace {

// GCC 12 keeps vectors in registers only across loops that it unrolls first. Loops marked for that take 6 % off
// complete detection (docs/notes/detection.md).

// The search of a zone. Entries of bud_of for its faces lie in start .. start + most: numbers of buds, or the last
// number, of no bud, while a face is free. Zones may be searched at the same time. A search writes entries of its own
// zone only, and never takes an entry of another zone for its own.
struct ZoneSearch {
  const Mesh& m;
  const f32* point;
  Buds& b;
  u32* bud_of;
  u32 start, most;                     // buds
  bool slender = false, bent = false;  // there are slender faces; most faces bend
  u32 count = 0;                       // buds
  u32 made = 0;                        // place behind the faces in buds
  u32 seed_bud = 0, seed_place = 0;    // no face is free beside any place before
  u32 lowest = 0;                      // all faces of the zone before are in buds
  u32 free() const { return start + most; }
};

u32 neighbour(const ZoneSearch& s, u32 face, u32 side) { return face_of(s.m.opposite[3 * face + side]); }
u32 bud_at(const ZoneSearch& s, u32 face) { return __atomic_load_n(s.bud_of + face, __ATOMIC_RELAXED); }
bool is_free(const ZoneSearch& s, u32 face) { return bud_at(s, face) == s.free(); }
void note_bud(u32* bud_of, u32 bud) { __atomic_store_n(bud_of, bud, __ATOMIC_RELAXED); }

// A free face beside the earliest bud possible, to fill gaps between buds before they are cut up.
u32 next_seed(ZoneSearch& s) {
  const Buds& b = s.b;
  for (; s.seed_bud < s.start + s.count; ++s.seed_bud) {
    const u32 last = b.first[s.seed_bud + 1];
    for (u32 at = max_of(s.seed_place, b.first[s.seed_bud] + b.looked[s.seed_bud]); at < last; ++at)
      for (u32 i = 0; i < 3; ++i)
        if (const u32 g = neighbour(s, b.face[at], i); is_free(s, g)) {
          s.seed_place = at;
          return g;
        }
  }
  while (!is_free(s, s.lowest)) ++s.lowest;
  return s.lowest;
}

struct SquaredEdges {
  f32 square[3] = {};
  f32 longest() const { return max_of(square[0], max_of(square[1], square[2])); }
  f32 shortest() const { return min_of(square[0], min_of(square[1], square[2])); }
};
SquaredEdges squared_edges_of(const Mesh& m, const f32* point, u32 face) {
  const u32* v = m.corner + 3 * static_cast<size_t>(face);
  F4 p[3];
#pragma GCC unroll 3
  for (u32 i = 0; i < 3; ++i) p[i] = load4(point + 3 * static_cast<size_t>(v[i]));
  F4 x = p[1] - p[0], y = p[2] - p[1], z = p[0] - p[2], rest{};
  x *= x, y *= y, z *= z;
  transpose(x, y, z, rest);
  const F4 square = x + y + z;
  return {{square[0], square[1], square[2]}};
}

// Ratios of the longest edge to the shortest, squared. Below the first ratio a search may cross all edges alike, and
// buds are about as long as wide. For the same shape, it may cross short edges once between both ratios, and never
// beyond the second.
constexpr f32 slender = 2.5f * 2.5f, very_slender = 6 * 6;

struct Row {
  u32 face, beside[3];
};
inline Row row_of(const ZoneSearch& s, u32 face) {
  return {face, {neighbour(s, face, 0), neighbour(s, face, 1), neighbour(s, face, 2)}};
}

// Grows a bud in rounds. Returns how many faces at its start have no free face beside them.
// No branch depends on whether a neighbour is new, since no processor could predict it: without a new neighbour, the
// face gets its own bud again. The next row is read before entries are written, since loads wait for a store to an
// unknown address (docs/notes/detection.md).
u32 grow_round(ZoneSearch& s, u32 first, u32 full, u32 bud) {
  u32 *const face = s.b.face, *const bud_of = s.bud_of;
  const u32 free = s.free();
  u32 at = first, made = s.made;
  Row row = row_of(s, face[at]);
  for (;;) {
    const bool known = ++at < made;
    const Row next = known ? row_of(s, face[at]) : row;
#pragma GCC unroll 3
    for (u32 i = 0; i < 3; ++i) {
      const u32 f = row.face, g = row.beside[i], fresh = bud_at(s, g) == free ? 1 : 0;
      face[made] = g;
      made += fresh;
      note_bud(bud_of + (f ^ ((f ^ g) & (0 - fresh))), bud);
      fetch(s.m.opposite + 3 * static_cast<size_t>(g));
    }
    if (at >= made || made >= full) break;
    row = known ? next : row_of(s, face[at]);
  }
  s.made = made;
  return at - first;
}

// Grows a bud over at most `most_short` short edges from the seed to any face. Returns the same as grow_round(): faces
// with a free face beyond a short edge move to the end.
u32 grow_slender(ZoneSearch& s, u32 first, u32 full, u32 bud, u8 most_short) {
  u8 crossed[most_in_bud];
  u32* face = s.b.face;
  u32 looked = first;
  crossed[0] = 0;
  for (u32 at = first; at < s.made && s.made < full; ++at) {
    const u32 f = face[at];
    const u8 before = crossed[at - first];
    const SquaredEdges edges = squared_edges_of(s.m, s.point, f);
    bool all = true;
    for (u32 i = 0; i < 3; ++i) {
      const u32 g = neighbour(s, f, i);
      if (!is_free(s, g)) continue;
      const bool is_short = edges.square[i] * slender < edges.longest();
      if (is_short && before == most_short) {
        all = false;
        continue;
      }
      crossed[s.made - first] = static_cast<u8>(before + (is_short ? 1 : 0));
      note_bud(s.bud_of + g, bud);
      face[s.made++] = g;
    }
    if (!all) continue;
    crossed[at - first] = crossed[looked - first];
    face[at] = face[looked];
    face[looked++] = f;
  }
  return looked - first;
}

bool is_slender(const SquaredEdges& edges) { return edges.longest() > slender * edges.shortest(); }

// Cosine of twenty degrees, by which a tube with forty edges round it turns within four faces: the reach of a bud of
// forty.
constexpr f64 bend_cosine = 0.94;
// Compares the normals of faces four steps apart: noise does not add up on the way. The way ends at holes in the
// numbering.
bool bends(const Mesh& m, u32 face) {
  u32 h = 3 * face;
  for (u32 k = 0; k < 4; ++k) {
    h = k % 2 == 0 ? next_edge(m.opposite[h]) : previous_edge(m.opposite[h]);
    if (!face_lives(m, face_of(h))) return false;
  }
  const Vec3 a = face_normal(m, face), b = face_normal(m, face_of(h));
  return !(dot(a, b) > 0) || dot(a, b) * dot(a, b) < bend_cosine * bend_cosine * squared_length(a) * squared_length(b);
}

// Shape of the surface, judged by samples. Slender: at least one of every 64th face is; if none, seeds need not be
// measured, nor their points read, far apart in memory. Bent: more than half of every 256th face bend.
struct SurfaceShape {
  bool slender, bent;
};
constexpr u32 sample_chunk = 1u << 14;
SurfaceShape shape_of(const Mesh& m, const f32* point, const Exec& exec) {
  u32 slender_chunks = 0, looked = 0, bent = 0;
  for_chunks(exec, m.face_count, sample_chunk, [&](u32 first, u32 last) {
    u32 any_slender = 0, mine = 0, mine_bent = 0;
    for (u32 f = first; f < last; f += 64) {
      if (!face_lives(m, f)) continue;
      if (any_slender == 0) any_slender = is_slender(squared_edges_of(m, point, f)) ? 1 : 0;
      if (f % 256 != 0) continue;
      ++mine;
      mine_bent += bends(m, f) ? 1u : 0u;
    }
    __atomic_fetch_add(&slender_chunks, any_slender, __ATOMIC_RELAXED);
    __atomic_fetch_add(&looked, mine, __ATOMIC_RELAXED);
    __atomic_fetch_add(&bent, mine_bent, __ATOMIC_RELAXED);
  });
  return {slender_chunks != 0, 2 * bent > looked};
}

// Grows a bud, or a further piece of a bud, from the seed. Returns how many faces at the start of the piece have no
// free face beside them.
u32 grow(ZoneSearch& s, u32 seed, u32 bud) {
  const u32 most = s.bent ? most_in_bent_bud : most_in_bud;
  const u32 first = s.made, full = first + most - 2;
  note_bud(s.bud_of + seed, bud);
  s.b.face[s.made++] = seed;
  const SquaredEdges edges = s.slender ? squared_edges_of(s.m, s.point, seed) : SquaredEdges{};
  if (!is_slender(edges)) return grow_round(s, first, full, bud);
  return grow_slender(s, first, full, bud, edges.longest() > very_slender * edges.shortest() ? 0 : 1);
}

// Joins a bud to an adjacent bud with room, of the s.count buds from s.start on.
void join_adjacent(const ZoneSearch& s, u32 bud) {
  Buds& b = s.b;
  for (u32 at = b.first[bud]; at < b.first[bud + 1]; ++at)
    for (u32 i = 0; i < 3; ++i) {
      const u32 other = bud_at(s, neighbour(s, b.face[at], i));
      if (other == bud || other - s.start >= s.count) continue;
      const u32 leader = b.leader[other];
      const u32 size = u32{b.size[leader]} + b.size[bud];
      if (size > most_in_joined_buds) continue;
      b.leader[bud] = leader;
      b.following[bud] = b.following[leader];
      b.following[leader] = bud;
      b.size[leader] = static_cast<u8>(size);
      return;
    }
}

// Reads the rows of a range of faces into the cache in order, a word of each 64 bytes. The search then reads them in
// its own order. Points are read only if seeds are measured.
void read_ahead(const ZoneSearch& s, u32 first, u32 last) {
  const auto read = [](const volatile auto* word) { static_cast<void>(*word); };
  for (u32 f = first; f < last; f += 5) read(s.m.opposite + 3 * static_cast<size_t>(f));
  for (u32 f = first; f < last; f += 16) read(s.bud_of + f);
  if (!s.slender) return;
  for (u32 f = first; f < last; f += 5)
    if (face_lives(s.m, f)) read(s.point + 3 * static_cast<size_t>(s.m.corner[3 * static_cast<size_t>(f)]));
}

void search_zone(ZoneSearch& s, u32 last_place) {
  Buds& b = s.b;
  while (s.made < last_place) {
    const u32 bud = s.start + s.count, seed = next_seed(s);
    b.first[bud] = s.made;
    b.looked[bud] = static_cast<u8>(grow(s, seed, bud));
    // A small bud takes further pieces if too few numbers are left for the faces left.
    const u32 numbers = s.most - s.count - 1;
    while (s.made - b.first[bud] < fewest_in_bud && s.made < last_place &&
           numbers <= (last_place - s.made) / fewest_in_bud)
      grow(s, next_seed(s), bud);
    b.first[bud + 1] = s.made;
    b.leader[bud] = bud;
    b.following[bud] = none;
    b.size[bud] = static_cast<u8>(s.made - b.first[bud]);
    ++s.count;
    if (b.size[bud] < fewest_in_bud) join_adjacent(s, bud);
  }
}

// Small buds beside a border of zones may be adjacent to buds of another zone only.
void join_across_zones(const Mesh& m, Buds& b, u32* bud_of) {
  const u32 all = b.start[b.zones - 1] + b.count[b.zones - 1];
  const ZoneSearch s{.m = m, .point = nullptr, .b = b, .bud_of = bud_of, .start = 0, .most = all, .count = all};
  for_each_bud(b, [&](u32 i) {
    if (b.leader[i] == i && b.size[i] < fewest_in_bud && b.following[i] == none) join_adjacent(s, i);
  });
}

// ---------------------------------------------------------------- zones

// Faces: enough for the buds cut by the border of a zone to be few beside those within.
constexpr u32 fewest_in_zone = 1u << 15;
constexpr u32 shape_samples = 1024;

// Do the numbers of adjacent faces mostly lie in one range? At most an eighth of the sampled edges may cross.
bool is_coherent(const Mesh& m, u32 width) {
  u32 looked = 0, crossing = 0;
  for (u32 f = 0; f < m.face_count; f += m.face_count / shape_samples) {
    if (!face_lives(m, f)) continue;
    for (u32 i = 0; i < 3; ++i, ++looked) crossing += face_of(m.opposite[3 * f + i]) / width != f / width ? 1u : 0u;
  }
  return crossing * 8 <= looked;
}

// Zones are ranges of `width` numbers. `count`: faces of each.
void cut_by_number(const Mesh& m, u32 width, const Exec& exec, u32* bud_of, u32* count) {
  for_chunks(exec, m.face_count, width, [&](u32 first, u32 last) {
    const u32 zone = first / width;
    const u32 free = zone * (most_buds_in_zone(width) + 1) + most_buds_in_zone(last - first);
    for (u32 f = first; f < last; ++f) bud_of[f] = free;
    count[zone] = last - first;
  });
}

// The cube -1 .. 1 in 8 x 8 x 8 cells, dealt out to zones of about as many faces each in the order of a space-filling
// curve (Morton 1966).
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
  for (u32 f = 0; f < m.face_count; f += m.face_count / shape_samples)
    if (face_lives(m, f)) ++count[cell_of(m, point, f)], ++all;
  for (u32 place = 0; place < cells; ++place) {
    const u32 cell = cell_on_curve(place);
    cell_zones.zone[cell] = static_cast<u8>(min_of(zones - 1, before * zones / max_of(all, 1u)));
    before += count[cell];
  }
}

// Zones are parts of space. `count`: faces of each, zero before.
void cut_by_place(const Mesh& m, const f32* point, u32 zones, const Exec& exec, u32* bud_of, u32* count) {
  CellZones cell_zones;
  share_cells(m, point, zones, cell_zones);
  for_chunks(exec, m.face_count, fewest_in_zone, [&](u32 first, u32 last) {
    u32 mine[most_zones] = {};
    for (u32 f = first; f < last; ++f) {
      const u32 z = face_lives(m, f) ? cell_zones.zone[cell_of(m, point, f)] : 0;
      ++mine[z];
      bud_of[f] = z;
    }
    for (u32 z = 0; z < zones; ++z) __atomic_fetch_add(count + z, mine[z], __ATOMIC_RELAXED);
  });
  u32 free[most_zones], end = 0;
  for (u32 z = 0; z < zones; ++z) free[z] = (end += most_buds_in_zone(count[z])) + z;
  for_chunks(exec, m.face_count, fewest_in_zone, [&](u32 first, u32 last) {
    for (u32 f = first; f < last; ++f) bud_of[f] = free[bud_of[f]];
  });
}

// Takes holes in the numbering out of their zones: no search reaches or begins at a hole. `living`: faces of each zone.
void take_out_holes(const Mesh& m, const Buds& b, const u32* faces, u32* bud_of, u32* living) {
  for (u32 f = m.free_face; f != none; f = m.corner[3 * f + 1]) {
    u32 z = 0;
    while (bud_of[f] != b.start[z] + most_buds_in_zone(faces[z])) ++z;
    --living[z];
    bud_of[f] = none;
  }
}

}  // namespace

void lay_out_buds(Carver& carver, u64 faces, Buds& b) {
  carver.take(b.face, faces + most_zones);  // a search writes one more than its zone has
  const u64 buds = most_buds(faces);
  carver.take(b.first, buds);
  carver.take(b.leader, buds);
  carver.take(b.following, buds);
  carver.take(b.size, buds);
  carver.take(b.looked, buds);
}

void grow_buds(const Mesh& m, const f32* point, const Exec& exec, Buds& b, u32* bud_of) {
  u32 zones = 1;
  while (zones < most_zones && m.face_count / (2 * zones) >= fewest_in_zone) zones *= 2;
  const u32 width = m.face_count / zones + 1;
  u32 faces[most_zones] = {};
  const bool coherent = zones == 1 || is_coherent(m, width);
  if (coherent)
    cut_by_number(m, width, exec, bud_of, faces);
  else
    cut_by_place(m, point, zones, exec, bud_of, faces);
  b.zones = zones;
  u32 place[most_zones], living[most_zones];
  for (u32 z = 0, buds = 0, places = 0; z < zones; ++z) {
    b.start[z] = buds, place[z] = places, living[z] = faces[z];
    buds += most_buds_in_zone(faces[z]) + 1, places += faces[z] + 1;
  }
  take_out_holes(m, b, faces, bud_of, living);
  const SurfaceShape shape = shape_of(m, point, exec);
  for_chunks(exec, zones, 1, [&](u32 z, u32) {
    const u32 start = b.start[z], from = place[z];
    ZoneSearch s{.m = m,
                 .point = point,
                 .b = b,
                 .bud_of = bud_of,
                 .start = start,
                 .most = most_buds_in_zone(faces[z]),
                 .slender = shape.slender,
                 .bent = shape.bent,
                 .made = from,
                 .seed_bud = start,
                 .seed_place = from,
                 .lowest = coherent ? z * width : 0};
    if (!TPA_SMALL && coherent) read_ahead(s, z * width, z * width + faces[z]);
    search_zone(s, from + living[z]);
    b.count[z] = s.count;
  });
  if (zones > 1) join_across_zones(m, b, bud_of);
}

}  // namespace tpa
