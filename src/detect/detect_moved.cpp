// SPDX-License-Identifier: MIT
#include "detect/detect_moved.h"

#include "base/open_hash.h"
#include "detect/cull_faces.h"
#include "detect/face_pair.h"
#include "geometry/slab_bitmaps.h"

// The way of an active face:
//   group     A group is up to 256 connected faces. A proof shows that they meet nothing of the surface round them
//             (detect/cull_faces.h); only other faces near by remain to be tested. If the surface bends too much for a
//             proof, parts of the group are tried.
//   together  A part without proof is tested against all faces near it, found by one search. Pairs with a common
//             corner whose star is proven unfolded are left out.
//   alone     A face amid much smaller faces, or far from the rest of its part, searches by itself.

namespace tpa {

namespace {

constexpr u32 words_of_part = TPA_SMALL ? 1 : 2, most_in_group = most_unfolded,
              most_in_part = words_of_part * SlabBitmaps::of_word;
static_assert(most_in_part <= most_in_group && most_in_group <= SlabBitmaps::most);

// Faces of a group or of a part, with their boxes.
struct BoxedFaces {
  Span<const u32> faces;
  Box all = empty_box;
  f32 largest = 0;  // extent of a box
  Box box[most_in_group];

  BoxedFaces(const Mesh& m, Span<const u32> some) : faces(some) {
    for (u32 i = 0; i < some.size; ++i) {
      box[i] = face_box(m, some[i]);
      all = united(all, box[i]);
      largest = max_of(largest, extent_of(box[i]));
    }
  }
  BoxedFaces(const BoxedFaces&) = delete;
};

// The corners of a part with proven stars, each with the set of its faces in the part: bit i for face i. A face with
// such a corner does not meet the faces of the set. Corners without proof have the empty set.
struct ProvenCorners {
  static constexpr u32 most = 3 * most_in_part, slots = TPA_SMALL ? 256 : 512;
  static_assert(most < slots);
  u32 count = 0;
  u32 vertex[most];
  u64 faces[most][words_of_part];

  ProvenCorners(const Mesh& m, u8* star, Span<const u32> part) {
    numbers_.clear();
    for (u32 i = 0; i < part.size; ++i)
      for (u32 k = 0; k < 3; ++k)
        faces[enter(face_corners(m, part[i])[k])][i / SlabBitmaps::of_word] |= u64{1} << i % SlabBitmaps::of_word;
    for (u32 at = 0; at < count; ++at)
      if (!star_proven(m, star, vertex[at])) clear(at);
  }
  ProvenCorners(const ProvenCorners&) = delete;

  // Takes the faces with a proven corner in common with g out of a set of faces of the part.
  void leave_out(const u32* g, u64* set) const {
    for (u32 k = 0; k < 3; ++k) {
      const u32 at = number_of(g[k]);
      if (at == none) continue;
      for (u32 w = 0; w < words_of_part; ++w) set[w] &= ~faces[at][w];
    }
  }

 private:
  u32 slot_[slots];
  OpenHash numbers_{slot_, slots};

  u32& number_of(u32 v) const {
    return numbers_.find(scattered(v), [&](u32 at) { return vertex[at] == v; });
  }
  void clear(u32 at) {
    for (u64& set : faces[at]) set = 0;
  }
  u32 enter(u32 v) {
    u32& at = number_of(v);
    if (at != none) return at;
    vertex[count] = v;
    clear(count);
    return at = count++;
  }
};

// A pair of active faces is found from both sides; the face with the lower number reports the pair.
bool reports(u32 f, u32 g, bool g_is_active) { return !g_is_active | (f < g); }

// A tested face and a face near it.
enum Side : u32 { of_tested, of_near };
struct NearPair {
  u32 face[2];
};

// Keeps the pairs in front that the plane of one face, `plane`, does not certainly part; returns their number. Without
// a branch, since answers are random.
u32 keep_unparted(const Mesh& m, Side plane, NearPair* pair, u32 count) {
  u32 kept = 0;
  for (u32 k = 0; k < count; ++k) {
    const NearPair p = pair[k];
    const Probe probe = probe_of(m, face_corners(m, p.face[plane]));
    pair[kept] = p;
    kept += lies_beside(m, probe, face_corners(m, p.face[1 - plane])) ? 0u : 1u;
  }
  return kept;
}

// Tested faces whose boxes meet the box of one face near them: bit i of the set for face `first` + i.
struct MetFaces {
  u64 set;
  u32 first, near;
};
struct MetList {
  static constexpr u32 most = 128;
  static_assert(most >= SlabBitmaps::most / SlabBitmaps::of_word);
  u32 count = 0;
  MetFaces met[most + 1];  // an entry is written before it is counted, as are pairs below
};

// Tests all pairs of the list, and empties it. One loop runs over the bits of all entries: the number of bits in an
// entry is random, so the end of an inner loop would be mispredicted.
void test_listed(const Mesh& m, const DetectScope& scope, Span<const u32> tested, MetList& list, ContactSink& sink) {
  constexpr u32 most_pairs = 256;
  NearPair pair[most_pairs + 1];
  for (u32 i = 0; i < list.count;) {
    u32 pairs = 0;
    while (i < list.count && pairs < most_pairs) {
      MetFaces& met = list.met[i];
      const u32 f = tested[met.first + static_cast<u32>(__builtin_ctzll(met.set))];
      pair[pairs] = {{f, met.near}};
      pairs += reports(f, met.near, scope.active[met.near] != 0) ? 1u : 0u;
      met.set &= met.set - 1;
      i += met.set == 0 ? 1u : 0u;
    }
    pairs = keep_unparted(m, of_near, pair, pairs);
    pairs = keep_unparted(m, of_tested, pair, pairs);
    for (u32 k = 0; k < pairs; ++k)
      if (faces_meet(m, pair[k].face[0], pair[k].face[1])) sink.add(pair[k].face[0], pair[k].face[1]);
  }
  list.count = 0;
}

// Tests some faces against all faces near them. `proven` may be nullptr.
void test_pairs(const Mesh& m, const DetectScope& scope, const BoxedFaces& some, Span<const u32> near,
                const ProvenCorners* proven, ContactSink& sink) {
  SlabBitmaps::Word room[SlabBitmaps::most / SlabBitmaps::of_word];
  const SlabBitmaps boxes({some.box, some.faces.size}, some.all, room);
  MetList list;
  for (u32 g : near) {
    if (list.count + boxes.words > MetList::most) test_listed(m, scope, some.faces, list, sink);
    u64 met[SlabBitmaps::most / SlabBitmaps::of_word] = {};
    boxes.meeting(face_box(m, g), met);
    if (proven != nullptr) proven->leave_out(face_corners(m, g), met);
    for (u32 w = 0; w < boxes.words; ++w) {
      list.met[list.count] = {met[w], w * SlabBitmaps::of_word, g};
      list.count += met[w] != 0 ? 1u : 0u;
    }
  }
  test_listed(m, scope, some.faces, list, sink);
}

struct ListedFaces {
  static constexpr u32 most = 2048;
  u32 count = 0;
  u32 face[most];
};

// Lists the faces near a box, without faces that the proof `u` rules out; `u` may be nullptr. False if more than `most`
// faces lie near.
bool list_near(const Mesh& m, const NearFaces& near_faces, const Box& box, const Unfolded* u, u32 most,
               ListedFaces& list) {
  u32 asked = 0;
  const auto any = [](u32) { return true; };
  return none == find_near(near_faces, box, any, [&](u32 g) {
           if (asked++ == most) return true;
           const bool is_proven = u != nullptr && (u->has(g) || is_aside(m, *u, g));
           if (!is_proven) list.face[list.count++] = g;
           return false;
         });
}

// ---------------------------------------------------------------- group

// False without a proof, or if too many faces lie near.
bool try_unfolded(const Mesh& m, const NearFaces& near_faces, const DetectScope& scope, Span<const u32> some,
                  ContactSink& sink) {
  Unfolded u;
  if (!are_unfolded(m, some, u)) return false;
  const BoxedFaces boxed(m, some);
  ListedFaces near;
  if (!list_near(m, near_faces, boxed.all, &u, ListedFaces::most, near)) return false;
  test_pairs(m, scope, boxed, {near.face, near.count}, nullptr, sink);
  return true;
}

// ---------------------------------------------------------------- together

// False if the faces do not lie side by side, or lie amid much smaller faces. The limits leave room for a whole part,
// about eleven faces wide, with several hundred faces near it where two layers of the surface meet.
bool try_together(const Mesh& m, const NearFaces& near_faces, const DetectScope& scope, Span<const u32> some,
                  ContactSink& sink) {
  const BoxedFaces boxed(m, some);
  if (extent_of(boxed.all) > 16 * boxed.largest) return false;
  const u32 most_near = 256 + 14 * some.size;
  static_assert(256 + 14 * most_in_part <= ListedFaces::most);
  ListedFaces near;
  if (!list_near(m, near_faces, boxed.all, nullptr, most_near, near)) return false;
  const ProvenCorners proven(m, scope.star, some);
  test_pairs(m, scope, boxed, {near.face, near.count}, &proven, sink);
  return true;
}

// ---------------------------------------------------------------- alone

void test_alone(const Mesh& m, const NearFaces& near_faces, const DetectScope& scope, u32 f, ContactSink& sink) {
  const u32* corner = face_corners(m, f);
  const auto share_proven_corner = [&](u32 g) {
    const u32 shared = shared_corners(corner, face_corners(m, g));
    for (u32 k = 0; k < 3; ++k)
      if ((shared >> k & 1) != 0 && star_proven(m, scope.star, corner[k])) return true;
    return false;
  };
  for_each_near(near_faces, face_box(m, f), [&](u32 g) {
    if (reports(f, g, scope.active[g] != 0) && !share_proven_corner(g) && faces_meet(m, f, g)) sink.add(f, g);
  });
}

// ---------------------------------------------------------------- from group to alone

// Tests faces without a proof. If try_together() fails for a part, halves of the part are tried, down to single faces;
// the rest of the part goes on in halves of the size that succeeded.
void test_parts(const Mesh& m, const NearFaces& near_faces, const DetectScope& scope, Span<const u32> faces,
                ContactSink& sink) {
  for (u32 first = 0, size = 0; first < faces.size; first += size) {
    size = min_of(first % most_in_part == 0 ? most_in_part : size, faces.size - first);
    while (size > 1 && !try_together(m, near_faces, scope, faces.part(first, size), sink)) size /= 2;
    if (size == 1) test_alone(m, near_faces, scope, faces[first], sink);
  }
}

void test_group(const Mesh& m, const NearFaces& near_faces, const DetectScope& scope, Span<const u32> faces,
                ContactSink& sink) {
  if (try_unfolded(m, near_faces, scope, faces, sink)) return;
  for (u32 first = 0; first < faces.size; first += most_in_part) {
    const Span<const u32> part = faces.part(first, min_of(most_in_part, faces.size - first));
    const bool is_whole = part.size == faces.size;  // has failed already
    if (is_whole || !try_unfolded(m, near_faces, scope, part, sink)) test_parts(m, near_faces, scope, part, sink);
  }
}

// ---------------------------------------------------------------- groups

// Values of `active`. Groups follow each other in one list; two consecutive groups have different marks.
enum : u8 { ungrouped = 1, first_mark = 2, second_mark = 3 };

// Lists the active faces group by group. A group grows from a face over edges, breadth first, so that it becomes about
// as wide as long.
void gather_groups(const Mesh& m, const DetectScope& scope, u32* group) {
  u32 count = 0;
  u8 mark = first_mark;
  const auto take = [&](u32 f) {
    scope.active[f] = mark;
    group[count++] = f;
  };
  for (u32 first : scope.faces) {
    if (scope.active[first] != ungrouped) continue;
    const u32 end = count + most_in_group;
    u32 next = count;
    take(first);
    for (; next < count && count < end; ++next)
      for (u32 h = 3 * group[next]; h < 3 * group[next] + 3; ++h) {
        const u32 beside = m.opposite[h] == none ? none : face_of(m.opposite[h]);
        if (beside != none && scope.active[beside] == ungrouped && count < end) take(beside);
      }
    mark = mark == first_mark ? second_mark : first_mark;
  }
}

// Tests the groups that begin at first .. last - 1 in the list.
void test_groups(const Mesh& m, const NearFaces& g, const DetectScope& scope, Span<const u32> faces, u32 first,
                 u32 last, ContactSink& sink) {
  const auto begins_group = [&](u32 i) { return i == 0 || scope.active[faces[i]] != scope.active[faces[i - 1]]; };
  while (first < last && !begins_group(first)) ++first;
  while (first < last) {
    u32 end = first + 1;
    while (end < faces.size && !begins_group(end)) ++end;
    test_group(m, g, scope, faces.part(first, end - first), sink);
    first = end;
  }
}

}  // namespace

void detect(const Mesh& m, const NearFaces& g, const DetectScope& scope, const Exec& exec, Detection& out) {
  constexpr u32 chunk = 1024;  // faces; about 100 microseconds of work, against a few for handing out a chunk
  out.pairs.clear();
  ContactSink sink{out};
  const bool grouped = scope.room.size >= scope.faces.size;
  if (grouped) gather_groups(m, scope, scope.room.data);
  for_chunks(exec, scope.faces.size, chunk, [&](u32 first, u32 last) {
    if (grouped)
      test_groups(m, g, scope, {scope.room.data, scope.faces.size}, first, last, sink);
    else
      test_parts(m, g, scope, scope.faces.part(first, last - first), sink);
  });
  sink.finish();
}

}  // namespace tpa
