// SPDX-License-Identifier: MIT
#include "triangulate/minimum_triangulation.h"

#include "base/open_hash.h"
#include "base/simd.h"
#include "base/sort.h"

namespace tpa {

namespace {

// Least costs of the sub-polygons i .. j, in the upper triangle. The place of the best split is not stored but found
// again on demand.
struct Costs {
  f64* cost;
  u32 n;
  f64* row(u32 i) const { return cost + i * (2 * n - i - 3) / 2; }  // i .. j is at j - 1
  f64& operator()(u32 i, u32 j) const { return row(i)[j - 1]; }
};

// Cost of the chord from corner i to corner j, or no_way. The closing side of the polygon is no chord.
f64 chord_cost(const Disc& d, u32 i, u32 j) {
  if (j - i == 1 || (i == 0 && j + 1 == d.n)) return 0;
  const u32 a = d.vertex[i], b = d.vertex[j];
  if (a == b || (d.loop_of != nullptr && d.loop_of[a] == d.loop_of[b])) return no_way;
  for (u32 t = 0; t < d.taken_count; ++t)
    if ((d.taken[t][0] == a && d.taken[t][1] == b) || (d.taken[t][0] == b && d.taken[t][1] == a)) return no_way;
  return length(d.points[a] - d.points[b]);
}

// Answers about faces, by the number of i < k < j among all such triples.
struct KnownFaces {
  const Disc& d;
  OpenHash table;  // slots hold 2 place + 1 for free faces, 2 place for others; empty without a filter
  u32 known = 0;
};
u64 place_of(u32 i, u32 k, u32 j) { return u64{j} * (j - 1) * (j - 2) / 6 + u64{k} * (k - 1) / 2 + i; }

// A full memory ends all questions.
bool is_full(const KnownFaces& f) { return f.known > f.table.size / 4 * 3; }

u32& table_slot(const KnownFaces& known, u64 place) {
  const u32 number = static_cast<u32>(place);
  return known.table.find(scattered(number), [number](u32 answer) { return answer / 2 == number; });
}

bool ask_about(KnownFaces& f, u32 i, u32 k, u32 j) {
  const u32* v = f.d.vertex;
  const u64 place = place_of(i, k, j);
  u32& slot = table_slot(f, place);
  if (slot == none) {
    slot = static_cast<u32>(2 * place) + (f.d.filter.ask(f.d.filter.caller, {{v[i], v[k], v[j]}}) ? 1 : 0);
    ++f.known;
  }
  return slot % 2 == 1;
}
// Unknown faces count as free.
bool may_take(const KnownFaces& f, u32 i, u32 k, u32 j) {
  if (f.table.size == 0) return true;
  const u32 slot = table_slot(f, place_of(i, k, j));
  return slot == none || slot % 2 == 1;
}

// The best face at the side from i to j, the first of several; k is i where there is none.
struct Split {
  u32 k;
  f64 cost;  // of both parts and of the face
};
Split best_split(const Costs& t, const KnownFaces& known, u32 i, u32 j) {
  Split best{i, no_way};
  // Costs of i .. k stand in a row; costs of k .. j stand n - k - 2 places apart.
  const f64 *to_k = &t(i, i + 1), *from_k = &t(i + 1, j);
  spend(known.d.meter, 1 + (j - i) / 16);
  for (u32 k = i + 1; k < j; ++k, ++to_k, from_k += t.n - k - 1) {
    const f64 cost = *to_k + *from_k;
    if (cost < best.cost && may_take(known, i, k, j)) best = {k, cost};
  }
  return best;
}

f64 with_chord(f64 cost, f64 chord) { return cost < no_way && chord < no_way ? cost + chord : no_way; }

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

// Fills the sub-polygons i .. j, all faces taken for free. Once the cost of i .. k is known, longer sub-polygons from i
// may be split at k.
void fill_row(const Costs& t, const Disc& d, u32 i) {
  const u32 n = t.n;
  spend(d.meter, (n - i - 1) * (1 + u64{n - i} / 64));
  f64* const row = t.row(i);
  for (u32 j = i + 1; j < n; ++j) row[j - 1] = no_way;
  for (u32 first = i + 1; first < n; first += 4) {
    const u32 end = min_of(first + 4, n);
    for (u32 k = first; k < end; ++k) {
      row[k - 1] = k == i + 1 ? 0 : with_chord(row[k - 1], chord_cost(d, i, k));
      const f64* const on_k = t.row(k);
      for (u32 j = k + 1; j < end; ++j) row[j - 1] = min_of(row[j - 1], row[k - 1] + on_k[j - 1]);
    }
    if (end == n) continue;
    const f64* const to = row + (first - 1);
    const f64* const on[4] = {&t(first, end), &t(first + 1, end), &t(first + 2, end), &t(first + 3, end)};
    take_four(to, on, n - end, row + (end - 1));
  }
}

void fill(const Costs& t, const Disc& d) {
  for (u32 i = t.n - 1; i-- > 0 && !has_stopped(d.meter);) fill_row(t, d, i);
}

bool has_triangulation(const Costs& t) { return t(0, t.n - 1) < no_way; }

void push_side(SplitSides& sides, u32 from, u32 to, u32 beyond) {
  if (to - from >= 2)
    sides.at[sides.size++] = {static_cast<u16>(from), static_cast<u16>(to), static_cast<u16>(beyond), false};
}

// Calls accept(i, k, j) for the faces of the best triangulation, and notes its sides. A face that is refused must be
// known as taken afterwards; the next best face at the same side follows. Returns whether no side is stale.
template <class Accept>
bool walk_faces(const Costs& t, const KnownFaces& known, Accept accept) {
  bool settled = true;
  SplitSides &ahead = known.d.notes->ahead, &sides = known.d.notes->sides;
  ahead.size = 0;
  push_side(ahead, 0, t.n - 1, 0);
  for (sides.size = 0; ahead.size > 0; ++sides.size) {
    SplitSide& side = sides.at[sides.size] = ahead.at[--ahead.size];
    Split best;
    do {
      best = best_split(t, known, side.from, side.to);
    } while (best.k != side.from && !accept(side.from, best.k, side.to));
    const f64 chord = chord_cost(known.d, side.from, side.to);
    side.stale = with_chord(best.cost, chord) != t(side.from, side.to);
    settled = settled && !side.stale;
    if (best.k == side.from) continue;
    push_side(ahead, best.k, side.to, sides.size);
    push_side(ahead, side.from, best.k, sides.size);
  }
  return settled;
}

// ---------------------------------------------------------------- faces that must be free

// Brings the costs of the sides of the best triangulation up to date, inner sides before the sides beyond them.
void update_costs(const Costs& t, const KnownFaces& known) {
  SplitSides& sides = known.d.notes->sides;
  for (u32 n = sides.size; n-- > 0;) {
    const SplitSide& side = sides.at[n];
    if (!side.stale) continue;
    f64& cost = t(side.from, side.to);
    const f64 now = with_chord(best_split(t, known, side.from, side.to).cost, chord_cost(known.d, side.from, side.to));
    if (now != cost) sides.at[side.beyond].stale = true;
    cost = now;
  }
}

// Rounds of a search, eleven times as many as the tests have taken: 5 922, for 150 corners with a fifth of all faces
// taken. The scenes take 590 at most.
constexpr u32 most_rounds = 1 << 16;

// Asks about the best triangulation by the answers so far, again and again, and brings up to date only its own sides;
// all other triangulations cost at least as much as the table says (AO*: Martelli and Montanari 1973). So the last is
// the triangulation that questions about all faces would give. False where the memory is full before, or after too many
// rounds.
bool settle_best(const Costs& t, KnownFaces& known) {
  for (u32 round = 0; round < most_rounds; ++round) {
    if (!has_triangulation(t) || is_full(known) || has_stopped(known.d.meter)) return false;
    bool all_free = true;
    bool settled = walk_faces(t, known, [](u32, u32, u32) { return true; });
    if (settled)
      settled = walk_faces(t, known, [&](u32 i, u32 k, u32 j) {
        const bool free = is_full(known) || ask_about(known, i, k, j);
        all_free = all_free && free;
        return free;
      });
    if (settled && all_free) return !is_full(known);
    update_costs(t, known);
  }
  return false;
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

bool best_disc(const Disc& disc, u8* scratch, FaceCorners* out) {
  const Costs t{reinterpret_cast<f64*>(scratch), disc.n};
  KnownFaces known{disc, {}, 0};
  fill(t, disc);
  if (disc.filter.ask != nullptr) {
    known.table = {reinterpret_cast<u32*>(scratch + disc_scratch_bytes(disc.n)), disc_table_slots};
    known.table.clear();
    if (!settle_best(t, known)) return false;
  }
  if (has_stopped(disc.meter) || !has_triangulation(t)) return false;
  u32 count = 0;
  walk_faces(t, known, [&](u32 i, u32 k, u32 j) {
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

bool cut_open_handle(const LoopsToCutOpen& loops, u32 variant, u32* corners, u8* scratch, FaceCorners* out) {
  const u32 n = loops.first[loops.count] + 2 * (loops.count - 1);
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
  const Disc disc{loops.points, corners,      n,           loops.loop_of, tree.edge,
                  tree.size,    loops.filter, loops.notes, loops.meter};
  return best_disc(disc, scratch, out);
}

}  // namespace tpa
