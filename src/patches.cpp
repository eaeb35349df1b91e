#include "patches.h"

#include <string.h>

namespace tpa {

namespace {

struct Search {
  const Mesh& m;
  Patches& p;
  u32* patch_of;
  u32 made = 0;      // faces in patches
  u32 seed_patch = 0, seed_place = 0;  // all before have no neighbour that is in no patch
  u32 lowest = 0;    // all faces before are in patches
  bool slender = false;  // there are slender faces
};

u32 neighbour(const Search& s, u32 face, u32 side) { return face_of(s.m.opposite[3 * face + side]); }

// Takes the neighbours of a face into the patch. Whether they are new is as good as random, so nothing branches on it.
// What the search will read of them is fetched meanwhile.
void look_from(Search& s, u32 face, u32 patch) {
  u32 made = s.made;
#pragma GCC unroll 3
  for (u32 i = 0; i < 3; ++i) {
    const u32 g = neighbour(s, face, i), known = s.patch_of[g];
    const bool fresh = known == none;
    s.p.face[made] = g;
    made += fresh ? 1 : 0;
    s.patch_of[g] = fresh ? patch : known;
    __builtin_prefetch(s.m.opposite + 3 * static_cast<size_t>(g));
  }
  s.made = made;
}

// A face in no patch beside the earliest patches: what is left between patches is taken before it is cut up.
u32 next_seed(Search& s) {
  const Patches& p = s.p;
  for (; s.seed_patch < p.count; ++s.seed_patch) {
    s.seed_place = max_of(s.seed_place, p.first[s.seed_patch] + p.looked[s.seed_patch]);
    for (; s.seed_place < p.first[s.seed_patch + 1]; ++s.seed_place)
      for (u32 i = 0; i < 3; ++i)
        if (const u32 g = neighbour(s, p.face[s.seed_place], i); s.patch_of[g] == none) return g;
  }
  while (s.patch_of[s.lowest] != none) ++s.lowest;
  return s.lowest;
}

// Squares of a face's edges.
struct Sides {
  f64 square[3] = {};
  f64 longest() const { return max_of(square[0], max_of(square[1], square[2])); }
  f64 shortest() const { return min_of(square[0], min_of(square[1], square[2])); }
};
Sides sides_of(const Mesh& m, u32 face) {
  const Vec3 &a = corner_position(m, 3 * face), &b = corner_position(m, 3 * face + 1),
             &c = corner_position(m, 3 * face + 2);
  Sides sides;
  sides.square[0] = squared_length(b - a), sides.square[1] = squared_length(c - b), sides.square[2] = squared_length(a - c);
  return sides;
}

// Faces whose edges differ less are equilateral enough for a search that counts all steps alike.
constexpr f64 slender = 2.5 * 2.5;
// A patch of slender faces is about as long as wide where its search crosses short edges once either way, for ratios of
// the edges to this one; where it crosses none, for higher ones.
constexpr f64 very_slender = 6 * 6;

u32 grow_round(Search& s, u32 first, u32 full, u32 patch) {
  u32 at = first;
  for (; at < s.made && s.made < full; ++at) look_from(s, s.p.face[at], patch);
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
    const Sides sides = sides_of(s.m, f);
    bool all = true;
    for (u32 i = 0; i < 3; ++i) {
      const u32 g = neighbour(s, f, i);
      if (s.patch_of[g] != none) continue;
      const bool is_short = sides.square[i] * slender < sides.longest();
      if (is_short && before == most_short) {
        all = false;
        continue;
      }
      crossed[s.made - first] = static_cast<u8>(before + (is_short ? 1 : 0));
      s.patch_of[g] = patch;
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

// Is there a slender one among some faces, as many as there will be patches or fewer? If not, no seed is looked at:
// what lies far apart in memory takes longer to fetch than a patch to grow.
bool any_slender(const Mesh& m) {
  for (u32 f = 0; f < m.face_count; f += 64)
    if (face_lives(m, f) && is_slender(sides_of(m, f))) return true;
  return false;
}

void grow(Search& s, u32 seed, u32 patch) {
  const u32 first = s.made, full = first + most_in_patch - 2;
  s.patch_of[seed] = patch;
  s.p.face[s.made++] = seed;
  u32 looked;
  if (const Sides sides = s.slender ? sides_of(s.m, seed) : Sides{}; !is_slender(sides))
    looked = grow_round(s, first, full, patch);
  else
    looked = grow_slender(s, first, full, patch, sides.longest() > very_slender * sides.shortest() ? 0 : 1);
  s.p.looked[patch] = static_cast<u8>(looked);
}

void join_neighbour(Search& s, u32 patch) {
  Patches& p = s.p;
  for (u32 at = p.first[patch]; at < s.made; ++at)
    for (u32 i = 0; i < 3; ++i) {
      const u32 other = s.patch_of[neighbour(s, p.face[at], i)];
      if ((other == patch) | (other == none)) continue;
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

}  // namespace

void lay_out_patches(Carver& carver, u64 faces, Patches& p) {
  carver.take(p.face, faces + 1);
  carver.take(p.first, faces + 1);
  carver.take(p.leader, faces);
  carver.take(p.following, faces);
  carver.take(p.size, faces);
  carver.take(p.looked, faces + 1);
}

void find_patches(const Mesh& m, Patches& p, u32* patch_of) {
  memset(patch_of, 0xFF, m.face_count * sizeof *patch_of);
  u32 living = m.face_count;
  // No search reaches a hole in the numbering, nor begins there.
  for (u32 f = m.free_face; f != none; f = m.corner[3 * f + 1], --living) patch_of[f] = 0;
  Search s{m, p, patch_of};
  s.slender = any_slender(m);
  p.count = 0;
  while (s.made < living) {
    const u32 patch = p.count, seed = next_seed(s);
    p.first[patch] = s.made;
    grow(s, seed, patch);
    p.first[patch + 1] = s.made;
    p.leader[patch] = patch;
    p.following[patch] = none;
    p.size[patch] = static_cast<u8>(s.made - p.first[patch]);
    ++p.count;
    // Beside the first patch of a component that is smaller there is nothing to join.
    if (p.size[patch] < fewest_in_patch) join_neighbour(s, patch);
  }
}

}  // namespace tpa
