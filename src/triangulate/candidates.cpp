// SPDX-License-Identifier: MIT
// candidates: the sources of triangulations and their order (paper section 5, steps 5 to 7; docs/handles.md).
#include "triangulate/candidates.h"

#include "base/arena.h"
#include "handles/handle_table.h"

namespace tpa {

namespace {

constexpr u32 longest_filtered_strip = 96;  // in vertices; longer strips are sought among all faces

// What a search may use depends on nothing but its vertices: a disc has two corners more for each loop. The room of a
// disc also holds most_candidates strips in order between any two loops of so many vertices.
u64 corners_of_disc(u64 vertices, u64 loops) { return min_of<u64>(vertices + 2 * loops, longest_disc); }
u64 room_bytes(u64 vertices, u64 loops) {
  return max_of<u64>(filtered_disc_scratch_bytes(corners_of_disc(vertices, loops)), sizeof(ChoiceScratch));
}

u64 carve(CandidateSearch& search, u8* base, u64 vertices, u64 loops) {
  Carver carver{base, element_alignment};
  carver.take(search.points, vertices);
  carver.take(search.loop_of, vertices);
  carver.take(search.first, loops + 1);
  carver.take(search.numbers, vertices);
  carver.take(search.seen, most_candidates);
  carver.take(search.ranked, most_candidates);
  carver.take(search.corners, vertices + 2 * loops);
  carve(carver, corners_of_disc(vertices, loops), search.disc_notes);
  carver.take(search.room, room_bytes(vertices, loops));
  return carver.bytes;
}

// Hash of a set of faces: independent of their order, and of the corner with which a face begins.
u64 digest(Span<const FaceCorners> faces) {
  u64 sum = 0;
  for (const FaceCorners& face : faces) {
    const u32(&v)[3] = face.v;
    const u32 least = v[0] < v[1] ? (v[0] < v[2] ? 0 : 2) : (v[1] < v[2] ? 1 : 2);
    u64 hash = v[least] + 1;
    for (u32 c = 1; c < 3; ++c) {
      hash = (hash ^ (hash >> 31)) * scattering + v[(least + c) % 3] + 1;
    }
    hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9u;
    hash = (hash ^ (hash >> 27)) * 0x94d049bb133111ebu;
    sum += hash ^ (hash >> 31);
  }
  return sum;
}

bool is_new(const CandidateSearch& search, u64 hash) {
  for (u32 i = 0; i < search.given; ++i)
    if (search.seen[i] == hash) return false;
  return true;
}

StripLoops pair_of_loops(const CandidateSearch& search) {
  const u32 split = search.first[1];
  return {search.points, {search.numbers, split}, {search.numbers + split, search.vertices - split}};
}
HandleKey key_of(const CandidateSearch& search) {
  HandleKey key;
  key.k = search.loops.size;
  for (u32 i = 0; i < key.k; ++i) key.sides[i] = search.loops[i].count;
  return key;
}

// ---------------------------------------------------------------- one loop: caps (section 5, nested objects)

// The shortest cap.
bool draw_cap(CandidateSearch& search, FaceCorners* out) {
  const u32 n = search.vertices;
  if (search.drawn > 0) return false;
  const Disc disc{search.points,      search.numbers,      n, nullptr, nullptr, 0, search.options.filter,
                  &search.disc_notes, search.options.meter};
  return best_disc(disc, search.room, out);
}

// ---------------------------------------------------------------- handles of the database (step 5)

// Candidates for the first source; a fourth is kept for the sources behind.
constexpr u32 stored_share(u32 candidates) { return candidates - candidates / 4; }

SortedKey rank_stored(CandidateSearch& search) {
  const SortedKey key = sorted_key(key_of(search));
  if (search.ranked_count > 0) return key;
  const Vec3* points[max_handle_polygons] = {};
  for (u32 i = 0; i < key.k; ++i) points[i] = search.points + search.first[key.order[i]];
  search.ranked_count =
      rank_handles(key, points, *reinterpret_cast<ChoiceScratch*>(search.room),
                   {search.ranked, stored_share(search.options.max_candidates)}, search.options.meter);
  return key;
}

bool draw_stored(CandidateSearch& search, FaceCorners* out) {
  const SortedKey key = rank_stored(search);
  if (search.drawn >= search.ranked_count) return false;
  write_ranked(key, search.ranked[search.drawn], search.first, out);
  return true;
}

// ---------------------------------------------------------------- two loops beyond the database: strips

FaceFilter strip_filter(const CandidateSearch& search) {
  return search.vertices <= longest_filtered_strip ? search.options.filter : FaceFilter{};
}

// All strips, in order of length. A search for more strips begins again at the shortest, since strips of equal length
// may change places at the end of the earlier search.
bool draw_ordered(CandidateSearch& search, FaceCorners* out) {
  constexpr u32 few = 1, times = 8;
  const StripLoops pair = pair_of_loops(search);
  const u32 drawn = search.drawn;
  if (drawn == search.strips.best.count) {
    const u32 wanted = drawn == 0 ? few : min_of(times * drawn, most_candidates);
    if (drawn < search.strips.best.at.size ||
        !lay_out_strip_order(pair.x.size, pair.y.size, wanted, search.room, search.room_size, search.strips))
      return false;
    search.strips.meter = search.options.meter;
    find_strips(pair, strip_filter(search), search.strips);
    if (search.strips.best.count <= drawn) return false;
    search.drawn = 0;
  }
  write_strip(pair, search.strips, search.drawn, out);
  return true;
}

// ---------------------------------------------------------------- more loops beyond the database

// Handles through a tree of short edges. Some variants of the tree have no consistent handle.
bool draw_cut_open(CandidateSearch& search, FaceCorners* out) {
  const LoopsToCutOpen loops{search.points,         search.loop_of,     search.first,        search.loops.size,
                             search.options.filter, &search.disc_notes, search.options.meter};
  for (; search.drawn < loops.count; ++search.drawn)
    if (cut_open_handle(loops, search.drawn, search.corners, search.room, out)) return true;
  return false;
}

// ---------------------------------------------------------------- the order of the sources

void list_sources(CandidateSearch& search) {
  const auto add = [&search](CandidateSource source) { search.sources[search.source_count++] = source; };
  const u32 k = search.loops.size;
  if (k == 1) return add(draw_cap);
  const bool stored = k <= max_handle_polygons && is_tabled(sorted_key(key_of(search)));
  if (stored) add(draw_stored);
  add(k == 2 ? draw_ordered : draw_cut_open);
}

}  // namespace

u64 candidate_scratch_bytes(u64 vertices, u64 loops) {
  CandidateSearch search;
  return carve(search, nullptr, vertices, loops);
}

u32 candidate_face_count(Span<const Loop> loops) {
  u32 vertices = 0;
  for (const Loop& loop : loops) vertices += loop.count;
  return loops.size == 1 ? vertices - 2 : vertices + 2 * loops.size - 4;
}

bool begin(CandidateSearch& search, Span<const Loop> loops, Span<u8> scratch, const CandidateOptions& options) {
  u64 vertices = 0;
  for (const Loop& loop : loops) {
    if (loop.count < shortest_polygon) return false;
    vertices += loop.count;
  }
  search = {};
  if (!has_candidates(vertices, loops.size)) return false;
  if (candidate_scratch_bytes(vertices, loops.size) > scratch.size) return false;
  carve(search, scratch.data, vertices, loops.size);
  search.room_size = room_bytes(vertices, loops.size);
  search.loops = loops;
  search.options = options;
  search.options.max_candidates = min_of(options.max_candidates, most_candidates);
  for (u32 l = 0; l < loops.size; ++l) {
    search.first[l] = search.vertices;
    for (u32 i = 0; i < loops[l].count; ++i) {
      const u32 v = search.vertices++;
      search.points[v] = loops[l].points[i];
      search.loop_of[v] = l;
      search.numbers[v] = v;
    }
  }
  search.first[loops.size] = search.vertices;
  list_sources(search);
  return true;
}

bool next(CandidateSearch& search, Span<FaceCorners> out, u32& count) {
  const u32 faces = candidate_face_count(search.loops);
  if (out.size < faces) return false;
  while (search.given < search.options.max_candidates && search.source < search.source_count) {
    spend(search.options.meter, 2 * u64{faces} + search.given / 8);
    if (has_stopped(search.options.meter)) return false;
    if (!search.sources[search.source](search, out.data)) {
      ++search.source;
      search.drawn = 0;
      continue;
    }
    ++search.drawn;
    if (has_stopped(search.options.meter)) return false;
    const u64 hash = digest({out.data, faces});
    if (!is_new(search, hash)) continue;
    search.seen[search.given++] = hash;
    count = faces;
    return true;
  }
  return false;
}

}  // namespace tpa
