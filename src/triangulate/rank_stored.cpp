// SPDX-License-Identifier: MIT
// rank_stored: the shortest stored handles (paper section 5, steps 5 and 7).
#include "triangulate/rank_stored.h"

#include <string.h>

#include "base/simd.h"
#include "triangulate/best_list.h"

namespace tpa {

namespace {

constexpr u32 most_sides = ChoiceScratch::side;

// Pairs of sorted polygons a < b are numbered (0,1) (0,2) (0,3) (1,2) (1,3) (2,3).
constexpr u32 pair_of(u32 a, u32 b) { return a == 0 ? b - 1 : a + b; }

void measure_distances(const SortedKey& key, const Vec3* const (&points)[max_handle_polygons], ChoiceScratch& scratch) {
  for (u32 a = 0; a < key.k; ++a)
    for (u32 b = a + 1; b < key.k; ++b) {
      auto& distance = scratch.distance[pair_of(a, b)];
      const u32 m = key.sides[a], n = key.sides[b];
      // Round and round, so that eight columns follow each other from any rotation.
      for (u32 i = 0; i < m; ++i) {
        for (u32 j = 0; j < n; ++j) distance[i][j] = length(points[a][i] - points[b][j]);
        for (u32 j = n; j < 2 * most_sides; ++j) distance[i][j] = distance[i][j - n];
        memcpy(distance[i + m], distance[i], sizeof distance[i]);
      }
    }
}

// The edges of a handle between two polygons: places of their lengths in the distances, without any rotation.
struct PairEdges {
  static constexpr u32 most = 70;  // at most 64 steps, and one more edge for each strip
  u32 count = 0;
  u16 at[most];
};

void add_strip(const SortedKey& key, const WordHandle& handle, const StripStarts& starts, u32 s, u32 first_bit,
               PairEdges* pairs) {
  const Plan& plan = plan_of(key.k, handle.plan);
  const u32 x = plan.x[s], y = plan.y[s], steps = u32{handle.x_steps[s]} + handle.y_steps[s];
  PairEdges& pair = pairs[x < y ? pair_of(x, y) : pair_of(y, x)];
  u32 i = starts.at[x][s] % key.sides[x], j = (starts.at[y][s] + handle.y_steps[s]) % key.sides[y];
  // The last edge of a closed strip is its first.
  const u32 edges = key.k == 2 ? steps : steps + 1;
  for (u32 t = 0; t < edges; ++t) {
    pair.at[pair.count++] = static_cast<u16>(x < y ? 2 * most_sides * i + j : 2 * most_sides * j + i);
    if ((handle.steps >> (first_bit + t)) & 1)
      i = i + 1 == key.sides[x] ? 0 : i + 1;
    else
      j = j == 0 ? key.sides[y] - 1 : j - 1;
  }
}

// Sums for all rotations of both polygons, of the second polygon eight at a time in registers.
void sum_up(const PairEdges& edges, u32 rows, u32 columns, const f64* distance, f64 (*sums)[most_sides + 1]) {
  for (u32 r = 0; r < rows; ++r)
    for (u32 c = 0; c < columns; c += 8) {
      D2 a = all2(0), b = a, d = a, e = a;
      for (u32 t = 0; t < edges.count; ++t) {
        const f64* from = distance + 2 * most_sides * r + c + edges.at[t];
        a += load2(from), b += load2(from + 2), d += load2(from + 4), e += load2(from + 6);
      }
      f64* to = sums[r] + c;
      store2(to, a), store2(to + 2, b), store2(to + 4, d), store2(to + 6, e);
    }
}

void fill_matrices(const SortedKey& key, const WordHandle& handle, ChoiceScratch& scratch) {
  u32 x_steps[6] = {}, y_steps[6] = {};
  for (u32 s = 0; s < 6; ++s) x_steps[s] = handle.x_steps[s], y_steps[s] = handle.y_steps[s];
  const Plan& plan = plan_of(key.k, handle.plan);
  const StripStarts starts = strip_starts(plan, x_steps, y_steps);
  PairEdges edges[ChoiceScratch::pairs];
  for (u32 s = 0, bit = 0; s < plan.strips; ++s) {
    add_strip(key, handle, starts, s, bit, edges);
    bit += x_steps[s] + y_steps[s];
  }
  for (u32 a = 0; a < key.k; ++a)
    for (u32 b = a + 1; b < key.k; ++b)
      sum_up(edges[pair_of(a, b)], key.sides[a], key.sides[b], scratch.distance[pair_of(a, b)][0],
             scratch.matrix[pair_of(a, b)]);
}

void rank_two(const SortedKey& key, const ChoiceScratch& scratch, u32 range, RankedHandle handle,
              BestList<RankedHandle>& best) {
  for (u32 b = 0; b < key.sides[1]; ++b)
    for (u32 a = 0; a < range; ++a) {
      handle.length = scratch.matrix[0][a][b];
      if (!best.takes(handle.length)) continue;
      handle.rotation[0] = static_cast<u8>(a), handle.rotation[1] = static_cast<u8>(b);
      best.enter(handle);
    }
}

void rank_three(const SortedKey& key, const ChoiceScratch& scratch, RankedHandle handle, BestList<RankedHandle>& best) {
  const auto& m = scratch.matrix;
  for (u32 a = 0; a < key.sides[0]; ++a)
    for (u32 b = 0; b < key.sides[1]; ++b)
      for (u32 c = 0; c < key.sides[2]; ++c) {
        handle.length = m[0][a][b] + (m[1][a][c] + m[3][b][c]);
        if (!best.takes(handle.length)) continue;
        handle.rotation[0] = static_cast<u8>(a), handle.rotation[1] = static_cast<u8>(b);
        handle.rotation[2] = static_cast<u8>(c);
        best.enter(handle);
      }
}

// With two rotations fixed, the third and the fourth polygon meet in one matrix only. Its smallest entry and the best
// rotation of each alone bound the sum from below, and few pairs need the full search.
void rank_four(const SortedKey& key, const ChoiceScratch& scratch, RankedHandle handle, BestList<RankedHandle>& best) {
  const auto& m = scratch.matrix;
  f64 least = m[5][0][0];
  for (u32 c = 0; c < key.sides[2]; ++c)
    for (u32 d = 0; d < key.sides[3]; ++d) least = min_of(least, m[5][c][d]);
  for (u32 a = 0; a < key.sides[0]; ++a)
    for (u32 b = 0; b < key.sides[1]; ++b) {
      f64 third[most_sides], fourth[most_sides];
      for (u32 c = 0; c < key.sides[2]; ++c) third[c] = m[0][a][b] + (m[1][a][c] + m[3][b][c]);
      for (u32 d = 0; d < key.sides[3]; ++d) fourth[d] = m[2][a][d] + m[4][b][d];
      f64 least_fourth = fourth[0];
      for (u32 d = 1; d < key.sides[3]; ++d) least_fourth = min_of(least_fourth, fourth[d]);
      for (u32 c = 0; c < key.sides[2]; ++c) {
        if (!best.takes(third[c] + (least_fourth + least))) continue;
        for (u32 d = 0; d < key.sides[3]; ++d) {
          handle.length = third[c] + (fourth[d] + m[5][c][d]);
          if (!best.takes(handle.length)) continue;
          handle.rotation[0] = static_cast<u8>(a), handle.rotation[1] = static_cast<u8>(b);
          handle.rotation[2] = static_cast<u8>(c), handle.rotation[3] = static_cast<u8>(d);
          best.enter(handle);
        }
      }
    }
}

// Units of work.
u64 work_of_image(const SortedKey& key) {
  u64 sides = 0, rotations = 1;
  for (u32 i = 0; i < key.k; ++i) sides += key.sides[i];
  for (u32 i = 0; i < min_of(key.k, 3u); ++i) rotations *= key.sides[i];
  return sides + rotations / 8;
}

}  // namespace

u32 rank_handles(const SortedKey& key, const Vec3* const (&points)[max_handle_polygons], ChoiceScratch& scratch,
                 Span<RankedHandle> out, Meter* meter) {
  BestList<RankedHandle> best{out, 0};
  if (out.empty()) return 0;
  measure_distances(key, points, scratch);
  const u32 generators = tabled_generator_count(key);
  for (u32 g = 0; g < generators; ++g) {
    WordHandle images[24];
    const u32 count = exchange_images(key, tabled_generator(key, g), images);
    for (u32 e = 0; e < count; ++e) {
      spend(meter, work_of_image(key));
      if (has_stopped(meter)) return 0;
      RankedHandle handle;
      handle.generator = static_cast<u8>(g), handle.image = static_cast<u8>(e);
      fill_matrices(key, images[e], scratch);
      if (key.k == 2)
        rank_two(key, scratch, distinct_rotations(key, g), handle, best);
      else if (key.k == 3)
        rank_three(key, scratch, handle, best);
      else
        rank_four(key, scratch, handle, best);
    }
  }
  return best.count;
}

void write_ranked(const SortedKey& key, const RankedHandle& handle, const u32* first, FaceCorners* out) {
  WordHandle images[24];
  exchange_images(key, tabled_generator(key, handle.generator), images);
  Placement at;
  for (u32 i = 0; i < key.k; ++i)
    at.sides[i] = key.sides[i], at.first[i] = first[key.order[i]], at.rotation[i] = handle.rotation[i];
  write_faces(key.k, images[handle.image], at, out);
}

}  // namespace tpa
