// candidates: the order in which triangulations are proposed (paper section 5, steps 5 to 7; design 4.4).
#include "candidates.h"

#include "cap.h"
#include "handle_table.h"

namespace tpa {

namespace {

constexpr u32 flip_sweeps = 32;
constexpr u32 zipper_starts = 8;
constexpr u32 improved_handles = 4;
constexpr u32 most_shorts = 64;
// Where the shortest come first, up to .3 seconds: enough for three polygons of 15 vertices and for four of five. After
// the stored ones, up to 15 milliseconds: enough for most triples.
constexpr u64 first_choice_work = u64{1} << 20, second_choice_work = u64{1} << 16;

// Scratch is measured and handed out by the same routine, so that the two cannot disagree.
struct Carver {
  u8* base;
  u64 used = 0;
  template <class T>
  T* take(u64 count) {
    T* at = base == nullptr ? nullptr : reinterpret_cast<T*>(base + used);
    used += (count * sizeof(T) + 7) / 8 * 8;
    return at;
  }
};

// Linear in the vertices for discs too: 80 bytes for each, up to the longest disc.
constexpr u64 room_bytes(u64 vertices) {
  return max_of(max_of<u64>(clip_scratch_bytes(vertices), min_of(80 * vertices, disc_scratch_bytes(longest_disc))),
                max_of<u64>(sizeof(ShortestScratch), max_of<u64>(sizeof(ChoiceScratch), sizeof(StripOrderScratch))));
}

u64 carve(CandidateSearch& search, u8* base, u64 vertices, u64 loops) {
  Carver carver{base};
  search.points = carver.take<Vec3>(vertices);
  search.loop_of = carver.take<u32>(vertices);
  search.first = carver.take<u32>(loops + 1);
  search.numbers = carver.take<u32>(vertices);
  search.seen = carver.take<u64>(most_candidates);
  search.ranked = carver.take<RankedHandle>(most_candidates);
  search.shorts = carver.take<ShortHandle>(most_shorts);
  search.start_length = carver.take<f64>(vertices);
  const u64 table = weave_table_size(vertices, loops), faces = weave_faces(vertices, loops);
  search.weave.edges = {carver.take<WeaveEdge>(table), static_cast<u32>(table)};
  search.weave.twin = {carver.take<u32>(3 * faces), static_cast<u32>(3 * faces)};
  search.weave.strip = {carver.take<u8>(weave_strip_bytes(vertices)),
                        static_cast<u32>(weave_strip_bytes(vertices))};
  search.corners = carver.take<u32>(vertices + 2 * loops);
  search.room = carver.take<u8>(room_bytes(vertices));
  return carver.used;
}

// Independent of the order of faces and of the corner that a face begins with.
u64 digest(Span<const CandidateFace> faces) {
  u64 sum = 0;
  for (const CandidateFace& face : faces) {
    const u32(&v)[3] = face.v;
    const u32 least = v[0] < v[1] ? (v[0] < v[2] ? 0 : 2) : (v[1] < v[2] ? 1 : 2);
    u64 hash = v[least] + 1;
    for (u32 c = 1; c < 3; ++c) {
      hash = (hash ^ (hash >> 31)) * 0x9e3779b97f4a7c15u + v[(least + c) % 3] + 1;
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

FaceFilter filter_for(const CandidateSearch& search, u32 corners) {
  return corners <= longest_filtered_disc ? search.options.filter : FaceFilter{};
}

bool draw_cap(const CandidateSearch& search, CandidateFace* out) {
  constexpr DiscWeight weights[3] = {DiscWeight::length, DiscWeight::area, DiscWeight::angle};
  const u32 n = search.vertices;
  if (search.drawn >= 6) return false;
  const DiscWeight weight = weights[search.drawn % 3];
  if (search.drawn < 3 && n <= longest_disc_within(search.room_size))
    return best_disc({search.points, search.numbers, n, nullptr, nullptr, 0, filter_for(search, n)}, weight,
                     search.room, out);
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

// The shortest handles of all between three or four loops. As many stored ones are an upper bound for their lengths, if
// faces need not be free; else a guess that saves most of the work, and if it was too low, the search is done again.
// Where the work is done before the search has ended, what it has found has to do.
void find_shortest(CandidateSearch& search) {
  const CandidateOptions& options = search.options;
  rank_stored(search);
  const u32 wanted =
      min_of(most_shorts, options.shortest_first ? stored_share(options.max_candidates) : (options.max_candidates + 15) / 16);
  const u64 work = options.shortest_first ? first_choice_work : second_choice_work;
  ShortLoops loops{search.points, search.loops.size, {}, options.filter};
  for (u32 l = 0; l <= search.loops.size; ++l) loops.first[l] = search.first[l];
  ShortestScratch& scratch = *reinterpret_cast<ShortestScratch*>(search.room);
  const f64 stored = search.ranked[min_of(wanted, search.ranked_count) - 1].length;
  bool complete = false;
  search.short_count = shortest_handles(loops, stored, work, scratch, {search.shorts, wanted}, complete);
  if (complete && search.short_count < wanted)
    search.short_count = shortest_handles(loops, no_way, work, scratch, {search.shorts, wanted}, complete);
}

bool draw_shortest(CandidateSearch& search, CandidateFace* out) {
  if (search.drawn == 0) find_shortest(search);
  if (search.drawn >= search.short_count) return false;
  const u32 faces = candidate_face_count(search.loops);
  for (u32 f = 0; f < faces; ++f)
    for (u32 c = 0; c < 3; ++c) out[f].v[c] = search.shorts[search.drawn].face[f][c];
  return true;
}

// The best of the database, shortened by flips: less alike than the shortest of all.
bool draw_improved(CandidateSearch& search, CandidateFace* out) {
  if (search.drawn >= improved_handles || !draw_stored(search, out)) return false;
  shorten_by_flips(weave_of(search), flip_sweeps, search.weave, {out, candidate_face_count(search.loops)});
  return true;
}

// All strips between short loops, in order of length.
bool draw_ordered(const CandidateSearch& search, CandidateFace* out) {
  StripOrderScratch& order = *reinterpret_cast<StripOrderScratch*>(search.room);
  if (search.drawn == 0) begin_strip_order(pair_of_loops(search), search.options.filter, order);
  return next_strip(pair_of_loops(search), order, out);
}

// The shortest strips through each edge at the first vertex, in order of length.
bool draw_strip(CandidateSearch& search, CandidateFace* out) {
  const StripLoops pair = pair_of_loops(search);
  const u32 starts = pair.y.size;
  if (search.given >= stored_share(search.options.max_candidates)) return false;
  if (search.drawn == 0)
    for (u32 s = 0; s < starts; ++s)
      search.start_length[s] = shortest_strip_length(pair, s, search.weave.strip.data);
  u32 best = none;
  for (u32 s = 0; s < starts; ++s)
    if (search.start_length[s] >= 0 && (best == none || search.start_length[s] < search.start_length[best]))
      best = s;
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

// Handles through a tree of short edges; a variant that the rules forbid is passed over.
bool draw_cut_open(CandidateSearch& search, CandidateFace* out) {
  const CutLoops loops{search.points, search.loop_of, search.first, search.loops.size, search.options.filter};
  for (; search.drawn < loops.count; ++search.drawn)
    if (cut_open_handle(loops, search.drawn, search.corners, search.room, search.room_size, out)) return true;
  return false;
}

enum class Source : u8 { cut_open, cap, stored, shortest, improved, ordered, strip, zipper, woven, nothing };

bool strips_fit(const CandidateSearch& search) {
  const u64 p = search.loops[0].count, q = search.loops[1].count;
  return strip_scratch_bytes(p, q) <= search.weave.strip.size && p * q * q <= exact_strip_work;
}

// What stage number search.stage draws from.
Source source_of(const CandidateSearch& search) {
  const u32 k = search.loops.size, stage = search.stage;
  if (k == 1) return stage == 0 ? Source::cap : Source::nothing;
  const bool tabled = k <= max_handle_polygons && is_tabled(sorted_key(key_of(search)));
  if (tabled && stage < 2) {
    const bool stored = stage == (search.options.shortest_first ? 1u : 0u);
    if (stored) return Source::stored;
    return k == 2 ? Source::ordered : Source::shortest;
  }
  if (k == 2) {
    if (tabled || stage > 1) return Source::nothing;
    return stage == 1 ? Source::cut_open : strips_fit(search) ? Source::strip : Source::zipper;
  }
  constexpr Source others[] = {Source::improved, Source::cut_open, Source::woven, Source::nothing};
  return others[min_of<u32>(tabled ? stage - 2 : stage + 1, 3)];
}

bool draw(CandidateSearch& search, Source source, CandidateFace* out) {
  switch (source) {
    case Source::cap:
      return draw_cap(search, out);
    case Source::stored:
      return draw_stored(search, out);
    case Source::shortest:
      return draw_shortest(search, out);
    case Source::improved:
      return draw_improved(search, out);
    case Source::ordered:
      return draw_ordered(search, out);
    case Source::strip:
      return draw_strip(search, out);
    case Source::zipper:
      return draw_zipper(search, out);
    case Source::cut_open:
      return draw_cut_open(search, out);
    case Source::woven:
      return draw_woven(search, out);
    case Source::nothing:
      break;
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

bool begin(CandidateSearch& search, Span<const Loop> loops, Span<u8> scratch,
           const CandidateOptions& options) {
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
