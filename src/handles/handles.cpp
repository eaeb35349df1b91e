// SPDX-License-Identifier: MIT
// handles: looking up the database (paper section 4.2).
#include "handles/handles.h"

#include "handles/handle_table.h"

namespace tpa {

namespace {

Placement placement(const HandleKey& key, const SortedKey& sorted) {
  Placement at;
  u32 first[max_handle_polygons] = {};
  for (u32 i = 1; i < key.k; ++i) first[i] = first[i - 1] + key.sides[i - 1];
  for (u32 i = 0; i < key.k; ++i) at.sides[i] = sorted.sides[i], at.first[i] = first[sorted.order[i]];
  return at;
}

// Rotations of a generator with different results. For k > 2 these are all, since inner triangles tell vertices apart;
// a closed strip may repeat itself.
struct Rotations {
  u32 range[max_handle_polygons] = {1, 1, 1, 1};
  u64 count = 1;
};
Rotations rotations(const SortedKey& key, u32 repeats) {
  Rotations r;
  for (u32 i = 0; i < key.k; ++i) {
    r.range[i] = i == 0 ? key.sides[0] / repeats : key.sides[i];
    r.count *= r.range[i];
  }
  return r;
}
u32 repeats_of(const SortedKey& key, u32 g) {
  if (key.k != 2) return 1;
  return key.sides[1] / necklace_period(handle_row(2, key.sides).code[g], key.sides[1]);
}

u32 exchange_count(const SortedKey& key, u32 g) {
  WordHandle images[24];
  return exchange_images(key, tabled_generator(key, g), images);
}

void set_rotation(Placement& at, const Rotations& r, u32 k, u64 index) {
  for (u32 i = 0; i < k; ++i) {
    at.rotation[i] = static_cast<u32>(index % r.range[i]);
    index /= r.range[i];
  }
}

}  // namespace

u32 handle_face_count(const HandleKey& key) {
  u32 faces = 2 * key.k - 4;
  for (u32 i = 0; i < key.k; ++i) faces += key.sides[i];
  return faces;
}

SortedKey sorted_key(const HandleKey& key) {
  SortedKey sorted;
  sorted.k = key.k;
  for (u32 i = 0; i < key.k; ++i) {
    u32 at = i;
    for (; at > 0 && sorted.sides[at - 1] < key.sides[i]; --at)
      sorted.sides[at] = sorted.sides[at - 1], sorted.order[at] = sorted.order[at - 1];
    sorted.sides[at] = key.sides[i], sorted.order[at] = i;
  }
  return sorted;
}

bool is_tabled(const SortedKey& key) { return key.k <= most_tabled_polygons && key.sides[0] <= longest_tabled_polygon; }

WordHandle tabled_generator(const SortedKey& key, u32 g) {
  if (const WordRow* words = unequal_row(key.k, key.sides)) return unpack(words->word[g]);
  const u16 code = handle_row(key.k, key.sides).code[g];
  if (key.k == 2) return word_of_necklace(key.sides, code);
  return to_words(key.k, alternating_of(key.k, key.sides, code));
}

u32 exchange_images(const SortedKey& key, const WordHandle& generator, WordHandle (&images)[24]) {
  u32 count = 0;
  images[count++] = generator;
  if (key.k == 2) return count;  // exchanging equal polygons of a closed strip is a rotation
  for (u32 i = 1; i < permutation_count(key.k); ++i) {
    if (!permits(key.k, key.sides, i)) continue;
    images[count] = exchanged(key.k, generator, i);
    bool fresh = true;
    for (u32 t = 0; t < count && fresh; ++t) fresh = compare(images[t], images[count]) != 0;
    if (fresh) ++count;
  }
  return count;
}

u32 tabled_generator_count(const SortedKey& key) {
  const WordRow* words = unequal_row(key.k, key.sides);
  return words != nullptr ? words->count : handle_row(key.k, key.sides).count;
}

u32 distinct_rotations(const SortedKey& key, u32 g) { return key.sides[0] / repeats_of(key, g); }

u32 generator_count(const HandleKey& key) {
  const SortedKey sorted = sorted_key(key);
  return is_tabled(sorted) ? tabled_generator_count(sorted) : 0;
}

bool key_is_complete(const HandleKey& key) {
  const SortedKey sorted = sorted_key(key);
  if (!is_tabled(sorted)) return false;
  const WordRow* words = unequal_row(sorted.k, sorted.sides);
  return words != nullptr ? words->complete : handle_row(sorted.k, sorted.sides).complete;
}

u64 generator_size(const HandleKey& key, u32 g) {
  const SortedKey sorted = sorted_key(key);
  return rotations(sorted, repeats_of(sorted, g)).count * exchange_count(sorted, g);
}

u64 handle_count(const HandleKey& key) {
  u64 count = 0;
  for (u32 g = 0; g < generator_count(key); ++g) count += generator_size(key, g);
  return count;
}

bool generator_get(const HandleKey& key, u32 g, Span<FaceCorners> out) {
  if (g >= generator_count(key) || out.size < handle_face_count(key)) return false;
  const SortedKey sorted = sorted_key(key);
  const Placement at = placement(key, sorted);
  write_faces(key.k, tabled_generator(sorted, g), at, out.data);
  return true;
}

bool handle_get(const HandleKey& key, u64 index, Span<FaceCorners> out) {
  if (out.size < handle_face_count(key)) return false;
  const SortedKey sorted = sorted_key(key);
  const u32 generators = generator_count(key);
  for (u32 g = 0; g < generators; ++g) {
    const Rotations r = rotations(sorted, repeats_of(sorted, g));
    const u64 size = r.count * exchange_count(sorted, g);
    if (index >= size) {
      index -= size;
      continue;
    }
    Placement at = placement(key, sorted);
    set_rotation(at, r, key.k, index % r.count);
    WordHandle images[24];
    exchange_images(sorted, tabled_generator(sorted, g), images);
    write_faces(key.k, images[index / r.count], at, out.data);
    return true;
  }
  return false;
}

}  // namespace tpa
