#include "disc.h"

#include "order.h"

namespace tpa {

namespace {

// How badly shaped the triangle is: the cosine of its largest angle, from -1 (flat) to 1/2, mapped to 0 .. 1.
f64 shape_cost(Vec3 a, Vec3 b, Vec3 c) {
  const f64 p = squared_length(b - c), q = squared_length(c - a), r = squared_length(a - b);
  const f64 longest = max_of(p, max_of(q, r));
  const f64 others = p + q + r - longest;
  const f64 product = p == longest ? q * r : q == longest ? p * r : p * q;
  if (product <= 0) return 4;
  const f64 cosine = (others - longest) / (2 * square_root(product));
  const f64 cost = (0.5 - cosine) / 1.5;
  return cost * cost;
}

// Least costs and splits of the sub-polygons i .. j, in the upper triangle.
struct Table {
  f64* cost;
  u16* split;
  u32 n;
  u32 at(u32 i, u32 j) const { return i * (2 * n - i - 1) / 2 + (j - i - 1); }
};

Table table_in(u8* scratch, u32 n) {
  f64* cost = reinterpret_cast<f64*>(scratch);
  return {cost, reinterpret_cast<u16*>(cost + u64{n} * (n - 1) / 2), n};
}

// What the chord from corner i to corner j costs, or no_way. The side that closes the polygon is no chord.
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

// What is known of the faces, by the places of i < k < j among all such triples: in `memory`, or in `table` for long
// discs.
struct KnownFaces {
  const Disc& d;
  FaceMemory memory;
  FaceTable table;
  bool asks = false;  // about faces that nobody has asked about yet; else they are taken to be free
};
u64 place_of(u32 i, u32 k, u32 j) { return corner_triples(j) + u64{k} * (k - 1) / 2 + i; }

// Of a table that is full nobody asks any more.
bool is_full(const KnownFaces& known) { return known.table.used > known.table.size / 4 * 3; }

bool ask_about(KnownFaces& known, u32 i, u32 k, u32 j) {
  const u32* v = known.d.vertex;
  const u64 place = place_of(i, k, j);
  const HandleFace face{{v[i], v[k], v[j]}};
  if (known.table.size == 0) return is_free(known.d.filter, known.memory, place, face);
  u32& slot = slot_of(known.table, static_cast<u32>(place));
  if (slot == none) {
    if (is_full(known)) return false;
    slot = static_cast<u32>(2 * place) + (known.d.filter.ask(known.d.filter.caller, face) ? 1 : 0);
    ++known.table.used;
  }
  return slot % 2 == 1;
}
bool may_take(KnownFaces& known, u32 i, u32 k, u32 j) {
  if (known.d.filter.ask == nullptr) return true;
  if (known.table.size == 0)
    return (!known.asks && !is_known(known.memory, place_of(i, k, j))) || ask_about(known, i, k, j);
  const u32 slot = slot_of(known.table, static_cast<u32>(place_of(i, k, j)));
  return slot == none || slot % 2 == 1;
}

// Least costs of the sub-polygons i .. j, of all or of those with j >= stale_from[i].
void fill(const Disc& d, DiscWeight weight, const Table& t, KnownFaces& known, const u32* stale_from) {
  for (u32 span = 1; span < d.n; ++span)
    for (u32 i = 0; i + span < d.n; ++i) {
      const u32 j = i + span;
      if (stale_from != nullptr && j < stale_from[i]) continue;
      const f64 chord = chord_cost(d, weight, i, j);
      f64 best = span == 1 ? 0 : no_way;
      u32 best_k = i;
      // The costs of i .. k stand in a row; those of k .. j n - k - 2 places apart.
      const f64 *to_k = t.cost + t.at(i, i + 1), *from_k = t.cost + t.at(i + 1, j);
      for (u32 k = i + 1; chord < no_way && k < j; ++k, ++to_k, from_k += d.n - k - 1) {
        f64 cost = *to_k + *from_k;
        if (!(cost < best)) continue;
        if (weight != DiscWeight::length) cost += face_cost(d, weight, i, k, j);
        if (cost < best && may_take(known, i, k, j)) {
          best = cost;
          best_k = k;
        }
      }
      t.cost[t.at(i, j)] = best < no_way ? best + chord : no_way;
      t.split[t.at(i, j)] = static_cast<u16>(best_k);
    }
}

bool has_triangulation(const Table& t) { return t.cost[t.at(0, t.n - 1)] < no_way; }

// Calls visit(i, k, j) for the faces of the best triangulation.
template <class Visit>
void for_each_face(const Table& t, Visit visit) {
  struct Side {
    u16 from, to;
  } stack[longest_disc];
  u32 depth = 0;
  stack[depth++] = {0, static_cast<u16>(t.n - 1)};
  while (depth > 0) {
    const Side s = stack[--depth];
    if (s.to - s.from < 2) continue;
    const u16 k = t.split[t.at(s.from, s.to)];
    visit(s.from, k, s.to);
    stack[depth++] = {k, s.to};
    stack[depth++] = {s.from, k};
  }
}

// ---------------------------------------------------------------- faces that must be free

// As often the best triangulation by what is known is asked about, or as often as takes the time of that for so many
// corners; then everything that can be in it is, if there is room to remember.
constexpr u32 most_rounds = 64;
constexpr u64 corners_for_most_rounds = 192;
constexpr u32 rounds_for(u64 n) {
  const u64 most = most_rounds * corners_for_most_rounds * corners_for_most_rounds * corners_for_most_rounds;
  return static_cast<u32>(min_of<u64>(most_rounds, most / (n * n * n)));
}
static_assert(rounds_for(longest_disc) == 8);

// Faces that nobody has asked about yet are taken to be free, until the best triangulation has none but free ones. It
// is the one that asking about every face would find: the others cost at least what they are taken to cost.
void fill_with_free_faces(const Disc& d, DiscWeight weight, const Table& t, KnownFaces& known) {
  u32 stale_from[longest_disc] = {};
  forget(known.memory);
  forget(known.table);
  for (u32 round = 0; round < rounds_for(d.n) && !is_full(known); ++round) {
    fill(d, weight, t, known, stale_from);
    if (!has_triangulation(t)) return;
    // Sub-polygons that contain a face which turned out to be taken.
    for (u32 i = 0; i < d.n; ++i) stale_from[i] = d.n;
    for_each_face(t, [&](u32 i, u32 k, u32 j) {
      if (!ask_about(known, i, k, j)) stale_from[i] = min_of(stale_from[i], j);
    });
    for (u32 i = d.n - 1; i-- > 0;) stale_from[i] = min_of(stale_from[i], stale_from[i + 1]);
    if (stale_from[0] == d.n) return;
  }
  if (known.table.size > 0) {
    t.cost[t.at(0, d.n - 1)] = no_way;
    return;
  }
  known.asks = true;
  fill(d, weight, t, known, nullptr);
}

void lay_out_known_faces(u8* scratch, u32 n, KnownFaces& known) {
  Room room{scratch + disc_scratch_bytes(n)};
  if (n <= longest_remembered_disc)
    lay_out_face_memory(room, corner_triples(n), known.memory);
  else
    known.table = {room.take<u32>(disc_table_slots), disc_table_slots, 0};
}

// Does any directed edge appear twice? `keys` has room for 3 * count.
bool repeats_an_edge(const HandleFace* faces, u32 count, u64* keys) {
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

bool best_disc(const Disc& disc, DiscWeight weight, u8* scratch, HandleFace* out) {
  const Table t = table_in(scratch, disc.n);
  KnownFaces known{disc, {}, {}};
  if (disc.filter.ask == nullptr) {
    fill(disc, weight, t, known, nullptr);
  } else {
    lay_out_known_faces(scratch, disc.n, known);
    fill_with_free_faces(disc, weight, t, known);
  }
  if (!has_triangulation(t)) return false;
  u32 count = 0;
  for_each_face(t, [&](u32 i, u32 k, u32 j) { out[count++] = {{disc.vertex[i], disc.vertex[k], disc.vertex[j]}}; });
  if (disc.loop_of == nullptr) return true;
  // The table is done with; up to seven corners it is smaller than the list of edges.
  u64 few[3 * 8];
  u64* keys = disc.n <= 8 ? few : reinterpret_cast<u64*>(scratch);
  return !repeats_an_edge(out, disc.n - 2, keys);
}

namespace {

struct Tree {
  u32 edge[most_cut_loops][2];  // vertices
  u32 size = 0;
};

// Prim's tree over the loops, by shortest edges, without the pair of loops (banned_a, banned_b). Ties by vertex ids.
bool grow_tree(const CutLoops& l, u32 banned_a, u32 banned_b, Tree& tree) {
  bool in[most_cut_loops] = {true};
  tree.size = 0;
  while (tree.size + 1 < l.count) {
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

// Walks round the loops and both sides of the tree: into corners[0 .. n-1]. `next` is scratch for as many.
u32 walk_round(const CutLoops& l, const Tree& tree, u32* corners, u32* next) {
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
  // The order of the walk, then its vertices in that order.
  u32 c = 0;
  for (u32 i = 0; i < n; ++i) {
    const u32 following = next[c];
    next[c] = i;
    c = following;
  }
  return n;
}

}  // namespace

bool cut_open_handle(const CutLoops& loops, u32 variant, u32* corners, u8* scratch, u64 scratch_bytes,
                     HandleFace* out) {
  const u32 n = loops.first[loops.count] + 2 * (loops.count - 1);
  if (loops.count < 2 || loops.count > most_cut_loops || n > longest_disc_within(scratch_bytes)) return false;
  Tree tree;
  if (!grow_tree(loops, none, none, tree)) return false;
  if (variant > 0) {
    if (variant > tree.size) return false;
    const u32 a = loops.loop_of[tree.edge[variant - 1][0]], b = loops.loop_of[tree.edge[variant - 1][1]];
    if (!grow_tree(loops, a, b, tree)) return false;
  }
  u32 vertex_at[longest_disc], place[longest_disc];
  walk_round(loops, tree, vertex_at, place);
  for (u32 c = 0; c < n; ++c) corners[place[c]] = vertex_at[c];
  const bool filtered = filtered_disc_scratch_bytes(n) <= scratch_bytes;
  const Disc disc{loops.points, corners, n, loops.loop_of, tree.edge, tree.size, filtered ? loops.filter : FaceFilter{}};
  return best_disc(disc, DiscWeight::length, scratch, out);
}

}  // namespace tpa
