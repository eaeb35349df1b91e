// SPDX-License-Identifier: MIT
#include "triangulate/minimum_triangulation.h"

#include "base/open_hash.h"
#include "base/simd.h"
#include "base/sort.h"

namespace tpa {

namespace {

// How badly shaped the triangle is: the cosine of its largest angle, from -1 (flat) to 1/2, mapped to 1 .. 0 and
// squared.
f64 shape_cost(const Vec3& a, const Vec3& b, const Vec3& c) {
  const f64 p = squared_length(b - c), q = squared_length(c - a), r = squared_length(a - b);
  const f64 longest = max_of(p, max_of(q, r));
  const f64 others = p + q + r - longest;
  const f64 product = p == longest ? q * r : q == longest ? p * r : p * q;
  if (product <= 0) return 4;
  const f64 cosine = (others - longest) / (2 * square_root(product));
  const f64 cost = (0.5 - cosine) / 1.5;
  return cost * cost;
}

// Least costs of the sub-polygons i .. j, in the upper triangle. The place of the best split is not stored but found
// again on demand.
struct Costs {
  f64* cost;
  u32 n;
  f64* row(u32 i) const { return cost + i * (2 * n - i - 3) / 2; }  // i .. j is at j - 1
  f64& operator()(u32 i, u32 j) const { return row(i)[j - 1]; }
};

// Cost of the chord from corner i to corner j, or no_way. The closing side of the polygon is no chord.
f64 chord_cost(const Disc& d, DiscWeight weight, u32 i, u32 j) {
  if (j - i == 1 || (i == 0 && j + 1 == d.n)) return 0;
  const u32 a = d.vertex[i], b = d.vertex[j];
  if (a == b || (d.loop_of != nullptr && d.loop_of[a] == d.loop_of[b])) return no_way;
  for (u32 t = 0; t < d.taken_count; ++t)
    if ((d.taken[t][0] == a && d.taken[t][1] == b) || (d.taken[t][0] == b && d.taken[t][1] == a)) return no_way;
  return weight == DiscWeight::length ? length(d.points[a] - d.points[b]) : 0;
}

f64 face_cost(const Disc& d, DiscWeight weight, u32 i, u32 k, u32 j) {
  return corner_cost(weight, d.points[d.vertex[i]], d.points[d.vertex[k]], d.points[d.vertex[j]]);
}

// Answers about faces, by the number of i < k < j among all such triples: in `memory`, or in `table` for long discs.
struct KnownFaces {
  const Disc& d;
  FaceMemory memory;
  OpenHash table;  // slots hold 2 place + 1 for free faces, 2 place for others
  u32 in_table = 0;
  Stack<u32> taken;   // keys of faces that are not free; sorted up to those of the last round
  bool asks = false;  // about unknown faces; otherwise unknown faces count as free
};
u64 place_of(u32 i, u32 k, u32 j) { return corner_triples(j) + u64{k} * (k - 1) / 2 + i; }

// The faces of sub-polygon i .. j have neighbouring keys, ordered by i, then by j.
constexpr u32 corner_bits = 9;
static_assert(longest_disc <= 1 << corner_bits);
constexpr u32 key_of(u32 i, u32 j, u32 k) { return (i << corner_bits | j) << corner_bits | k; }
constexpr u32 cell_of(u32 key) { return key >> corner_bits; }

// A full memory ends all questions.
bool is_full(const KnownFaces& known) {
  return known.taken.size == known.taken.capacity ||
         (known.table.size > 0 && known.in_table > known.table.size / 4 * 3);
}

u32& table_slot(const KnownFaces& known, u64 place) {
  const u32 number = static_cast<u32>(place);
  return known.table.find(scattered(number), [number](u32 answer) { return answer / 2 == number; });
}

bool ask_about(KnownFaces& known, u32 i, u32 k, u32 j) {
  const u32* v = known.d.vertex;
  const u64 place = place_of(i, k, j);
  const FaceCorners face{{v[i], v[k], v[j]}};
  if (known.table.size == 0) return is_free(known.d.filter, known.memory, place, face);
  u32& slot = table_slot(known, place);
  if (slot == none) {
    slot = static_cast<u32>(2 * place) + (known.d.filter.ask(known.d.filter.caller, face) ? 1 : 0);
    ++known.in_table;
  }
  return slot % 2 == 1;
}
bool may_take(KnownFaces& known, u32 i, u32 k, u32 j) {
  if (known.d.filter.ask == nullptr) return true;
  if (known.table.size == 0)
    return (!known.asks && !is_known(known.memory, place_of(i, k, j))) || ask_about(known, i, k, j);
  const u32 slot = table_slot(known, place_of(i, k, j));
  return slot == none || slot % 2 == 1;
}

// The best face at the side from i to j, the first of several; k is i where there is none.
struct Split {
  u32 k;
  f64 cost;  // of both parts and of the face
};
Split best_split(DiscWeight weight, const Costs& t, KnownFaces& known, u32 i, u32 j) {
  Split best{i, no_way};
  // Costs of i .. k stand in a row; costs of k .. j stand n - k - 2 places apart.
  const f64 *to_k = &t(i, i + 1), *from_k = &t(i + 1, j);
  if (weight == DiscWeight::length) spend(known.d.meter, 1 + (j - i) / 16);
  for (u32 k = i + 1; k < j; ++k, ++to_k, from_k += t.n - k - 1) {
    f64 cost = *to_k + *from_k;
    if (!(cost < best.cost)) continue;
    if (weight != DiscWeight::length) cost += face_cost(known.d, weight, i, k, j);
    if (cost < best.cost && may_take(known, i, k, j)) best = {k, cost};
  }
  return best;
}

f64 with_chord(f64 cost, f64 chord) { return cost < no_way && chord < no_way ? cost + chord : no_way; }

// Units of work to fill `count` sub-polygons from one corner, of at most so many corners, one by one; several are
// filled at once by length.
constexpr u64 corners_for_unit = 4;
u64 of_row(const Disc& d, u32 corners, u32 count) {
  return u64{count} * (2 + d.taken_count + corners / corners_for_unit);
}

// Fills the sub-polygons i .. j, j >= from, one by one.
void fill_row(DiscWeight weight, const Costs& t, KnownFaces& known, u32 i, u32 from) {
  spend(known.d.meter, of_row(known.d, t.n - i, t.n - from));
  for (u32 j = from; j < t.n; ++j) {
    const f64 chord = chord_cost(known.d, weight, i, j);
    t(i, j) = j == i + 1 ? 0 : chord < no_way ? with_chord(best_split(weight, t, known, i, j).cost, chord) : no_way;
  }
}

// cost[j] becomes the least of what it is and of the ways over four neighbouring corners.
void take_four(const f64* to, const f64* const (&on)[4], u32 count, f64* cost) {
  const D2 a = all2(to[0]), b = all2(to[1]), c = all2(to[2]), d = all2(to[3]);
  u32 j = 0;
  for (; j + 2 <= count; j += 2) {
    const D2 ab = min2(a + load2(on[0] + j), b + load2(on[1] + j));
    const D2 cd = min2(c + load2(on[2] + j), d + load2(on[3] + j));
    store2(cost + j, min2(load2(cost + j), min2(ab, cd)));
  }
  for (; j < count; ++j)
    for (u32 k = 0; k < 4; ++k) cost[j] = min_of(cost[j], to[k] + on[k][j]);
}

// The same by length alone, in registers; sub-polygons with a face that is taken are filled again alone. Once the cost
// of i .. k is known, longer sub-polygons from i may be split at k.
void fill_row_by_length(const Costs& t, KnownFaces& known, u32 i, u32 from) {
  const u32 n = t.n;
  spend(known.d.meter, (n - from) * (1 + u64{n - i} / 64));
  f64* const row = t.row(i);
  for (u32 j = from; j < n; ++j) row[j - 1] = no_way;
  const u32* taken = known.taken.begin();
  for (u32 last = known.taken.size; last > 0;) {
    const u32 half = last / 2;
    const bool before = taken[half] < key_of(i, from, 0);
    taken += before ? half + 1 : 0;
    last = before ? last - half - 1 : half;
  }
  const auto finish = [&](u32 j) {
    const u32 cell = cell_of(key_of(i, j, 0));
    const bool again = taken != known.taken.end() && cell_of(*taken) == cell;
    while (taken != known.taken.end() && cell_of(*taken) == cell) ++taken;
    const f64 cost = again ? best_split(DiscWeight::length, t, known, i, j).cost : row[j - 1];
    row[j - 1] = j == i + 1 ? 0 : with_chord(cost, chord_cost(known.d, DiscWeight::length, i, j));
  };
  for (u32 first = i + 1; first < n; first += 4) {
    const u32 end = min_of(first + 4, n);
    for (u32 k = first; k < end; ++k) {
      if (k >= from) finish(k);
      const f64* const on_k = t.row(k);
      for (u32 j = max_of(k + 1, from); j < end; ++j) row[j - 1] = min_of(row[j - 1], row[k - 1] + on_k[j - 1]);
    }
    const u32 j = max_of(end, from);
    if (j >= n) continue;
    const f64* const to = row + (first - 1);
    const f64* const on[4] = {&t(first, j), &t(first + 1, j), &t(first + 2, j), &t(first + 3, j)};
    take_four(to, on, n - j, row + (j - 1));
  }
}

// Fills the sub-polygons i .. j: all, or those with j >= stale_from[i].
void fill(DiscWeight weight, const Costs& t, KnownFaces& known, const u32* stale_from) {
  for (u32 i = t.n - 1; i-- > 0 && !has_stopped(known.d.meter);) {
    const u32 from = stale_from == nullptr ? i + 1 : max_of(i + 1, stale_from[i]);
    if (weight == DiscWeight::length && !known.asks)
      fill_row_by_length(t, known, i, from);
    else
      fill_row(weight, t, known, i, from);
  }
}

bool has_triangulation(const Costs& t) { return t(0, t.n - 1) < no_way; }

void push_side(SplitSides& sides, u32 from, u32 to, u32 beyond) {
  if (to - from >= 2)
    sides.at[sides.size++] = {static_cast<u16>(from), static_cast<u16>(to), static_cast<u16>(beyond), false};
}

// Calls accept(i, k, j) for the faces of the best triangulation, and notes its sides. A face that is refused must be
// known as taken afterwards; the next best face at the same side follows. Returns whether no side is stale.
template <class Accept>
bool walk_faces(DiscWeight weight, const Costs& t, KnownFaces& known, Accept accept) {
  bool settled = true;
  SplitSides &ahead = known.d.notes->ahead, &sides = known.d.notes->sides;
  ahead.size = 0;
  push_side(ahead, 0, t.n - 1, 0);
  for (sides.size = 0; ahead.size > 0; ++sides.size) {
    SplitSide& side = sides.at[sides.size] = ahead.at[--ahead.size];
    Split best;
    do {
      best = best_split(weight, t, known, side.from, side.to);
    } while (best.k != side.from && !accept(side.from, best.k, side.to));
    const f64 chord = chord_cost(known.d, weight, side.from, side.to);
    side.stale = with_chord(best.cost, chord) != t(side.from, side.to);
    settled = settled && !side.stale;
    if (best.k == side.from) continue;
    push_side(ahead, best.k, side.to, sides.size);
    push_side(ahead, side.from, best.k, sides.size);
  }
  return settled;
}

// ---------------------------------------------------------------- faces that must be free

// So many rounds, or as many as take the time of these for 192 corners, ask about the best triangulation by the answers
// so far. Then all faces that can be in it are asked about, if there is room to remember the answers.
constexpr u32 most_rounds = 64;
constexpr u64 corners_for_most_rounds = 192;
constexpr u32 rounds_for(u64 n) {
  const u64 most = most_rounds * corners_for_most_rounds * corners_for_most_rounds * corners_for_most_rounds;
  return static_cast<u32>(min_of<u64>(most_rounds, most / (n * n * n)));
}
static_assert(rounds_for(longest_disc) == 8);

// Brings the costs of the sides of the best triangulation up to date, inner sides before the sides beyond them.
void update_costs(DiscWeight weight, const Costs& t, KnownFaces& known) {
  SplitSides& sides = known.d.notes->sides;
  for (u32 n = sides.size; n-- > 0;) {
    const SplitSide& side = sides.at[n];
    if (!side.stale) continue;
    f64& cost = t(side.from, side.to);
    const f64 now = with_chord(best_split(weight, t, known, side.from, side.to).cost,
                               chord_cost(known.d, weight, side.from, side.to));
    if (now != cost) sides.at[side.beyond].stale = true;
    cost = now;
  }
}

// Asks about the best triangulation by the answers so far, again and again, and brings up to date only its own sides;
// all other triangulations cost at least as much as the table says (AO*: Martelli and Montanari 1973). False where that
// takes long; stale_from then tells the sub-polygons with a face that turned out to be taken.
bool settle_best(DiscWeight weight, const Costs& t, KnownFaces& known, u32* stale_from) {
  constexpr u32 most_times = 8;  // more questions would cost more than another filling of the table
  for (u32 i = 0; i < t.n; ++i) stale_from[i] = t.n;
  for (u32 time = 0; time < most_times && !is_full(known) && !has_stopped(known.d.meter); ++time) {
    bool asked = true;  // about all accepted faces
    const bool settled = walk_faces(weight, t, known, [&](u32 i, u32 k, u32 j) {
      if (is_full(known)) {
        asked = false;
        return true;
      }
      if (ask_about(known, i, k, j)) return true;
      stale_from[i] = min_of(stale_from[i], j);
      known.taken.push(key_of(i, j, k));
      return false;
    });
    if (settled && asked) return true;
    update_costs(weight, t, known);
    if (!has_triangulation(t)) return true;
  }
  for (u32 i = t.n - 1; i-- > 0;) stale_from[i] = min_of(stale_from[i], stale_from[i + 1]);
  return false;
}

// Unknown faces count as free, until the best triangulation has free faces only. This is the triangulation that
// questions about all faces would give: all others cost at least as much as they are taken to cost.
void fill_with_free_faces(DiscWeight weight, const Costs& t, KnownFaces& known) {
  u32* stale_from = known.d.notes->stale_from;
  for (u32 i = 0; i < t.n; ++i) stale_from[i] = 0;
  forget(known.memory);
  if (known.table.size > 0) known.table.clear();
  for (u32 round = 0; round < rounds_for(t.n) && !is_full(known); ++round) {
    fill(weight, t, known, stale_from);
    if (has_stopped(known.d.meter) || !has_triangulation(t) || settle_best(weight, t, known, stale_from)) return;
    sort_in_place(known.taken.data, known.taken.size);
  }
  if (known.table.size > 0) {
    t(0, t.n - 1) = no_way;
    return;
  }
  known.asks = true;
  fill(weight, t, known, nullptr);
}

void lay_out_known_faces(u8* scratch, u32 n, KnownFaces& known) {
  Carver carver{scratch + disc_scratch_bytes(n), element_alignment};
  carver.take(known.taken, most_taken_faces);
  if (n <= longest_remembered_disc) {
    lay_out_face_memory(carver, corner_triples(n), known.memory);
  } else {
    known.table.size = disc_table_slots;
    carver.take(known.table.slot, disc_table_slots);
  }
}

// Does any directed edge appear twice? `keys` has room for 3 * count.
bool repeats_an_edge(const FaceCorners* faces, u32 count, u64* keys) {
  for (u32 f = 0; f < count; ++f)
    for (u32 i = 0; i < 3; ++i) keys[3 * f + i] = static_cast<u64>(faces[f].v[i]) << 32 | faces[f].v[(i + 1) % 3];
  sort_in_place(keys, 3 * count);
  for (u32 i = 1; i < 3 * count; ++i)
    if (keys[i - 1] == keys[i]) return true;
  return false;
}

}  // namespace

f64 corner_cost(DiscWeight weight, const Vec3& a, const Vec3& b, const Vec3& c) {
  return weight == DiscWeight::area ? length(area_normal(a, b, c)) : shape_cost(a, b, c);
}

u32 longest_disc_within(u64 bytes) {
  u32 n = longest_disc;
  while (n > 3 && disc_scratch_bytes(n) > bytes) --n;
  return disc_scratch_bytes(n) <= bytes ? n : 0;
}

bool best_disc(const Disc& disc, DiscWeight weight, u8* scratch, FaceCorners* out) {
  const Costs t{reinterpret_cast<f64*>(scratch), disc.n};
  KnownFaces known{disc, {}, {}, 0, {}};
  if (disc.filter.ask == nullptr) {
    fill(weight, t, known, nullptr);
  } else {
    lay_out_known_faces(scratch, disc.n, known);
    fill_with_free_faces(weight, t, known);
  }
  if (has_stopped(disc.meter) || !has_triangulation(t)) return false;
  u32 count = 0;
  walk_faces(weight, t, known, [&](u32 i, u32 k, u32 j) {
    out[count++] = {{disc.vertex[i], disc.vertex[k], disc.vertex[j]}};
    return true;
  });
  if (disc.loop_of == nullptr) return true;
  // The list of edges takes the place of the table, unless the table is smaller: up to seven corners.
  u64 few[3 * 8];
  u64* keys = disc.n <= 8 ? few : reinterpret_cast<u64*>(scratch);
  return !repeats_an_edge(out, disc.n - 2, keys);
}

namespace {

struct LoopTree {
  u32 edge[most_cut_loops][2];  // vertices
  u32 size = 0;
};

// Prim's tree over the loops, by shortest edges, without the pair of loops (banned_a, banned_b). Ties by vertex ids.
bool grow_tree(const LoopsToCutOpen& l, u32 banned_a, u32 banned_b, LoopTree& tree) {
  bool in[most_cut_loops] = {true};
  tree.size = 0;
  const u64 pairs_of_vertices = u64{l.first[l.count]} * l.first[l.count];
  while (tree.size + 1 < l.count) {
    spend(l.meter, pairs_of_vertices / 4);
    if (has_stopped(l.meter)) return false;
    f64 best = no_way;
    u32 from = none, to = none;
    for (u32 i = 0; i < l.count; ++i) {
      if (!in[i]) continue;
      for (u32 k = 0; k < l.count; ++k) {
        if (in[k] || (i == banned_a && k == banned_b) || (i == banned_b && k == banned_a)) continue;
        for (u32 v = l.first[i]; v < l.first[i + 1]; ++v)
          for (u32 w = l.first[k]; w < l.first[k + 1]; ++w) {
            const f64 d = squared_length(l.points[v] - l.points[w]);
            if (d < best) {
              best = d;
              from = v;
              to = w;
            }
          }
      }
    }
    if (from == none) return false;
    in[l.loop_of[to]] = true;
    tree.edge[tree.size][0] = from;
    tree.edge[tree.size][1] = to;
    ++tree.size;
  }
  return true;
}

// Walks round the loops and both sides of the tree. Leaves the vertices in corners[] and the place of each in the walk
// in next[]; both have room for vertices + 2 (loops - 1).
u32 walk_round(const LoopsToCutOpen& l, const LoopTree& tree, u32* corners, u32* next) {
  const u32 vertices = l.first[l.count];
  u32 n = vertices;
  for (u32 c = 0; c < vertices; ++c) {
    corners[c] = c;
    next[c] = c + 1 == l.first[l.loop_of[c] + 1] ? l.first[l.loop_of[c]] : c + 1;
  }
  for (u32 t = 0; t < tree.size; ++t) {
    const u32 a = tree.edge[t][0], b = tree.edge[t][1];
    u32 before_b = b;
    while (next[before_b] != b) before_b = next[before_b];
    const u32 a_again = n++, b_again = n++;
    corners[a_again] = a;
    corners[b_again] = b;
    next[a_again] = next[a];
    next[a] = b;
    next[before_b] = b_again;
    next[b_again] = a_again;
  }
  // From links to places in the walk.
  u32 c = 0;
  for (u32 i = 0; i < n; ++i) {
    const u32 following = next[c];
    next[c] = i;
    c = following;
  }
  return n;
}

}  // namespace

bool cut_open_handle(const LoopsToCutOpen& loops, u32 variant, u32* corners, u8* scratch, u64 scratch_bytes,
                     FaceCorners* out) {
  const u32 n = loops.first[loops.count] + 2 * (loops.count - 1);
  if (loops.count < 2 || loops.count > most_cut_loops || n > longest_disc_within(scratch_bytes)) return false;
  LoopTree tree;
  if (!grow_tree(loops, none, none, tree)) return false;
  if (variant > 0) {
    if (variant > tree.size) return false;
    const u32 a = loops.loop_of[tree.edge[variant - 1][0]], b = loops.loop_of[tree.edge[variant - 1][1]];
    if (!grow_tree(loops, a, b, tree)) return false;
  }
  u32 *vertex_at = loops.notes->vertex_at, *place = loops.notes->place;
  walk_round(loops, tree, vertex_at, place);
  for (u32 c = 0; c < n; ++c) corners[place[c]] = vertex_at[c];
  const bool filtered = filtered_disc_scratch_bytes(n) <= scratch_bytes;
  const Disc disc{
      loops.points, corners,    n, loops.loop_of, tree.edge, tree.size, filtered ? loops.filter : FaceFilter{},
      loops.notes,  loops.meter};
  return best_disc(disc, DiscWeight::length, scratch, out);
}

}  // namespace tpa
