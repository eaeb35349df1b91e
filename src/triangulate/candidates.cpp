// candidates: the order in which triangulations are proposed (paper section 5, steps 5 to 7; docs/handles.md).
#include "triangulate/candidates.h"

#include "handles/handle_table.h"
#include "triangulate/ear_clipping.h"

namespace tpa {

namespace {

constexpr u32 flip_sweeps = 32;
constexpr u32 zipper_starts = 8;
constexpr u32 improved_handles = 4;
// Enough for strips in order between two loops of 141 vertices.
constexpr u64 least_room = 169 << 10;
static_assert(filtered_disc_scratch_bytes(longest_remembered_disc) <= least_room);

// Strips with more vertices are sought without asking whether faces are free.
constexpr u32 longest_filtered_strip = 96;

// Linear in the vertices for discs too: 80 bytes for each, up to the longest disc.
constexpr u64 room_bytes(u64 vertices) {
  return max_of(max_of<u64>(clip_scratch_bytes(vertices), min_of(80 * vertices, disc_scratch_bytes(longest_disc))),
                max_of<u64>(least_room, sizeof(ChoiceScratch)));
}

u64 carve(CandidateSearch& search, u8* base, u64 vertices, u64 loops) {
  Carver carver{base, element_alignment};
  carver.take(search.points, vertices);
  carver.take(search.loop_of, vertices);
  carver.take(search.first, loops + 1);
  carver.take(search.numbers, vertices);
  carver.take(search.seen, most_candidates);
  carver.take(search.ranked, most_candidates);
  carver.take(search.start_length, vertices);
  const u64 table = weave_table_size(vertices, loops), faces = weave_faces(vertices, loops);
  carver.take(search.weave.edges, static_cast<u32>(table));
  carver.take(search.weave.twin, static_cast<u32>(3 * faces));
  carver.take(search.weave.strip, static_cast<u32>(weave_strip_bytes(vertices)));
  carver.take(search.corners, vertices + 2 * loops);
  carver.take(search.room, room_bytes(vertices));
  return carver.bytes;
}

// Independent of the order of faces and of the corner that a face begins with.
u64 digest(Span<const CandidateFace> faces) {
  u64 sum = 0;
  for (const CandidateFace& face : faces) {
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

WeaveLoops weave_of(const CandidateSearch& search) {
  return {search.points, search.loop_of, search.first, search.numbers, search.loops.size};
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

// Each source below writes its candidate number search.drawn, or returns false when it has no more.

FaceFilter strip_filter(const CandidateSearch& search) {
  return search.vertices <= longest_filtered_strip ? search.options.filter : FaceFilter{};
}

// Is the next cap the best of all? The others are made ear by ear.
bool caps_best(const CandidateSearch& search) {
  return search.drawn < 3 && search.vertices <= longest_disc_within(search.room_size);
}

// The answers to all questions about a cap take their place beside the search.
FaceFilter cap_filter(const CandidateSearch& search) {
  return filtered_disc_scratch_bytes(search.vertices) <= search.room_size ? search.options.filter : FaceFilter{};
}

bool draw_cap(CandidateSearch& search, CandidateFace* out) {
  constexpr DiscWeight weights[3] = {DiscWeight::length, DiscWeight::area, DiscWeight::angle};
  const u32 n = search.vertices;
  if (search.drawn >= 6) return false;
  const DiscWeight weight = weights[search.drawn % 3];
  if (caps_best(search)) {
    const Disc disc{search.points, search.numbers, n, nullptr, nullptr, 0, cap_filter(search)};
    if (best_disc(disc, weight, search.room, out)) return true;
    if (n <= longest_remembered_disc) return false;  // then there is none
  }
  clip_cap(search.points, n, weight, search.room, out);
  return true;
}

// Of the candidates asked for, how many may come from the first source before others get their turn.
constexpr u32 stored_share(u32 candidates) { return candidates - candidates / 4; }

SortedKey rank_stored(CandidateSearch& search) {
  const SortedKey key = sorted_key(key_of(search));
  if (search.ranked_count > 0) return key;
  const Vec3* points[max_handle_polygons] = {};
  for (u32 i = 0; i < key.k; ++i) points[i] = search.points + search.first[key.order[i]];
  search.ranked_count = rank_handles(key, points, *reinterpret_cast<ChoiceScratch*>(search.room),
                                     {search.ranked, stored_share(search.options.max_candidates)});
  return key;
}

bool draw_stored(CandidateSearch& search, CandidateFace* out) {
  const SortedKey key = rank_stored(search);
  if (search.drawn >= search.ranked_count) return false;
  write_ranked(key, search.ranked[search.drawn], search.first, out);
  return true;
}

// Handles through a tree of short edges; a variant that the rules forbid is passed over.
bool draw_cut_open(CandidateSearch& search, CandidateFace* out) {
  const CutLoops loops{search.points, search.loop_of, search.first, search.loops.size, search.options.filter};
  for (; search.drawn < loops.count; ++search.drawn)
    if (cut_open_handle(loops, search.drawn, search.corners, search.room, search.room_size, out)) return true;
  return false;
}

// The best of the database, shortened by flips.
bool draw_improved(CandidateSearch& search, CandidateFace* out) {
  if (search.drawn >= improved_handles || !draw_stored(search, out)) return false;
  shorten_by_flips(weave_of(search), flip_sweeps, search.weave, {out, candidate_face_count(search.loops)});
  return true;
}

// All strips, in order of length: a few first, and when these have been drawn, more, from the first one on, lest one be
// lost among others of equal length.
bool draw_ordered(CandidateSearch& search, CandidateFace* out) {
  constexpr u32 few = 1, times = 8;
  const StripLoops pair = pair_of_loops(search);
  const u32 drawn = search.drawn;
  if (drawn == search.strips.count) {
    const u32 wanted = drawn == 0 ? few : min_of(times * drawn, most_candidates);
    if (drawn < search.strips.best.size ||
        !lay_out_strip_order(pair.x.size, pair.y.size, wanted, search.room, search.room_size, search.strips))
      return false;
    find_strips(pair, strip_filter(search), search.strips);
    if (search.strips.count <= drawn) return false;
    search.drawn = 0;
  }
  write_strip(pair, search.strips, search.drawn, out);
  return true;
}

// The shortest strips through each edge at the first vertex, in order of length.
bool draw_strip(CandidateSearch& search, CandidateFace* out) {
  const StripLoops pair = pair_of_loops(search);
  const u32 starts = pair.y.size;
  if (search.given >= stored_share(search.options.max_candidates)) return false;
  if (search.drawn == 0) {
    f64* scratch = reinterpret_cast<f64*>(search.room);
    const u64 most = min_of<u64>(none, search.room_size / sizeof(f64));
    shortest_strip_lengths(pair, 0, starts, {scratch, static_cast<u32>(most)}, search.start_length);
  }
  u32 best = none;
  for (u32 s = 0; s < starts; ++s)
    if (search.start_length[s] >= 0 && (best == none || search.start_length[s] < search.start_length[best])) best = s;
  if (best == none) return false;
  shortest_strip_from(pair, best, search.weave.strip.data, out);
  search.start_length[best] = -1;  // used
  return true;
}

bool draw_zipper(const CandidateSearch& search, CandidateFace* out) {
  if (search.drawn >= 2 * zipper_starts) return false;
  const StripLoops pair = pair_of_loops(search);
  u32 i = static_cast<u32>(u64{pair.x.size} * (search.drawn % zipper_starts) / zipper_starts), j = 0;
  if (search.drawn % zipper_starts == 0)
    nearest_pair(pair, i, j);
  else
    j = nearest_on_y(pair, i);
  zip_strip(pair, i, j, out);
  if (search.drawn < zipper_starts)
    shorten_by_flips(weave_of(search), flip_sweeps, search.weave, {out, search.vertices});
  return true;
}

bool draw_woven(const CandidateSearch& search, CandidateFace* out) {
  const u32 k = search.loops.size;
  if (search.drawn >= 2 * k) return false;
  const u32 count = weave_loops(weave_of(search), search.drawn % k, search.weave, out);
  if (search.drawn < k) shorten_by_flips(weave_of(search), flip_sweeps, search.weave, {out, count});
  return true;
}

enum class Source : u8 { cap, stored, improved, cut_open, ordered, strip, zipper, woven, nothing };

// Where there is no room for a table of lengths, there may be for one of steps, and so for the shortest strips through
// each edge.
Source longer_strips(const CandidateSearch& search) {
  const u32 p = search.loops[0].count, q = search.loops[1].count;
  if (u64{p} * q > exact_strip_work / q) return Source::zipper;
  StripOrder order;
  if (lay_out_strip_order(p, q, 1, search.room, search.room_size, order)) return Source::ordered;
  return strip_scratch_bytes(p, q) <= search.weave.strip.size ? Source::strip : Source::zipper;
}

// What stage number search.stage draws from.
Source source_of(const CandidateSearch& search) {
  const u32 k = search.loops.size, stage = search.stage;
  if (k == 1) return stage == 0 ? Source::cap : Source::nothing;
  const bool tabled = k <= max_handle_polygons && is_tabled(sorted_key(key_of(search)));
  if (k == 2) {
    if (stage > 1) return Source::nothing;
    if (tabled) return stage == 0 ? Source::stored : Source::ordered;
    return stage == 0 ? longer_strips(search) : Source::cut_open;
  }
  constexpr Source sources[] = {Source::stored, Source::improved, Source::cut_open, Source::woven, Source::nothing};
  return sources[min_of<u32>(tabled ? stage : stage + 2, 4)];
}

bool draw(CandidateSearch& search, Source source, CandidateFace* out) {
  switch (source) {
    case Source::cap: return draw_cap(search, out);
    case Source::stored: return draw_stored(search, out);
    case Source::improved: return draw_improved(search, out);
    case Source::ordered: return draw_ordered(search, out);
    case Source::strip: return draw_strip(search, out);
    case Source::zipper: return draw_zipper(search, out);
    case Source::cut_open: return draw_cut_open(search, out);
    case Source::woven: return draw_woven(search, out);
    case Source::nothing: break;
  }
  return false;
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
  if (loops.empty() || vertices > none / 16) return false;
  if (candidate_scratch_bytes(vertices, loops.size) > scratch.size) return false;
  carve(search, scratch.data, vertices, loops.size);
  search.room_size = scratch.size - static_cast<u64>(search.room - scratch.data);
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
  return true;
}

bool next(CandidateSearch& search, Span<CandidateFace> out, u32& count) {
  const u32 faces = candidate_face_count(search.loops);
  if (out.size < faces) return false;
  while (search.given < search.options.max_candidates) {
    const Source source = source_of(search);
    if (source == Source::nothing) return false;
    if (!draw(search, source, out.data)) {
      ++search.stage;
      search.drawn = 0;
      continue;
    }
    ++search.drawn;
    const u64 hash = digest({out.data, faces});
    if (!is_new(search, hash)) continue;
    search.seen[search.given++] = hash;
    count = faces;
    return true;
  }
  return false;
}

}  // namespace tpa
