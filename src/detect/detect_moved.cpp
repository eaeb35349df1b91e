#include "detect/detect_moved.h"

#include "base/open_hash.h"
#include "detect/cull_faces.h"
#include "detect/face_pair.h"
#include "geometry/slab_bitmaps.h"

// The way of an active face:
//   group     Up to 256 faces that are connected are proven to meet nothing of the surface round them
//             (detect/cull_faces.h), and tested against other faces near by. If the surface bends too much for
//             the proof, parts of the group are tried.
//   together  A part without proof is tested against all faces near it, found by one search. Pairs with a common
//             corner whose star is proven are left out.
//   alone     A face amid much smaller ones, or far from the rest of its part, searches by itself.

namespace tpa {

namespace {

constexpr u32 words_of_part = TPA_SMALL ? 1 : 2, most_in_group = most_unfolded,
              most_in_part = words_of_part * SlabSets::of_word;
static_assert(most_in_part <= most_in_group && most_in_group <= SlabSets::most);

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

// The corners of a part, each with the set of its faces in the part. The set is empty unless the star is proven, so two
// faces that share a corner with a set do not meet.
struct ProvenCorners {
  static constexpr u32 most = 3 * most_in_part, slots = TPA_SMALL ? 256 : 512;
  static_assert(most < slots);
  u32 count = 0;
  u32 vertex[most], slot[slots];
  u64 faces[most][words_of_part];

  ProvenCorners(const Mesh& m, u8* star, Span<const u32> part) {
    hash().clear();
    for (u32 i = 0; i < part.size; ++i)
      for (u32 k = 0; k < 3; ++k)
        faces[enter(face_corners(m, part[i])[k])][i / SlabSets::of_word] |= u64{1} << i % SlabSets::of_word;
    for (u32 at = 0; at < count; ++at)
      if (!star_proven(m, star, vertex[at])) clear(at);
  }
  ProvenCorners(const ProvenCorners&) = delete;

  // Takes the faces that share a proven corner with g out of a set of faces of the part.
  void leave_out(const u32* g, u64* set) {
    for (u32 k = 0; k < 3; ++k) {
      const u32 at = find(g[k]);
      if (at == none) continue;
      for (u32 w = 0; w < words_of_part; ++w) set[w] &= ~faces[at][w];
    }
  }

 private:
  OpenHash hash() { return {slot, slots}; }
  u32& find(u32 v) {
    return hash().find(scattered(v), [&](u32 at) { return vertex[at] == v; });
  }
  void clear(u32 at) {
    for (u64& set : faces[at]) set = 0;
  }
  u32 enter(u32 v) {
    u32& at = find(v);
    if (at != none) return at;
    vertex[count] = v;
    clear(count);
    return at = count++;
  }
};

// Both faces of an active pair come across the pair; the one with the lower number reports it.
bool reports(u32 f, u32 g, bool g_is_active) { return !g_is_active || f < g; }

// Tests some faces against all faces near them. `proven` may be nullptr.
void test_pairs(const Mesh& m, const DetectScope& scope, const BoxedFaces& some, Span<const u32> near,
                ProvenCorners* proven, ContactSink& sink) {
  SlabSets::Word room[SlabSets::most / SlabSets::of_word];
  const SlabSets boxes({some.box, some.faces.size}, some.all, room);
  for (u32 g : near) {
    u64 met[SlabSets::most / SlabSets::of_word] = {};
    boxes.meeting(face_box(m, g), met);
    if (proven != nullptr) proven->leave_out(face_corners(m, g), met);
    const Probe probe = probe_of(m, face_corners(m, g));
    for (u32 w = 0; w < boxes.words; ++w)
      for (; met[w] != 0; met[w] &= met[w] - 1) {
        const u32 f = some.faces[w * SlabSets::of_word + static_cast<u32>(__builtin_ctzll(met[w]))];
        if (reports(f, g, scope.active[g] != 0) && meets(m, probe, face_corners(m, f))) sink.add(f, g);
      }
  }
}

struct ListedFaces {
  static constexpr u32 most = 2048;
  u32 count = 0;
  u32 face[most];
};

// Lists the faces near a box but for those with is_proven(g). False if there are more than `most`, with those.
template <class IsProven>
bool list_near(const NearFaces& near_faces, const Box& box, u32 most, IsProven is_proven, ListedFaces& list) {
  u32 asked = 0;
  const auto any = [](u32) { return true; };
  return none == find_near(near_faces, box, any, [&](u32 g) {
           if (asked++ == most) return true;
           if (!is_proven(g)) list.face[list.count++] = g;
           return false;
         });
}

// ---------------------------------------------------------------- group

// False if the faces are not proven, or too many others lie near.
bool try_unfolded(const Mesh& m, const NearFaces& near_faces, const DetectScope& scope, Span<const u32> some,
                  ContactSink& sink) {
  Unfolded u;
  if (!are_unfolded(m, some, u)) return false;
  const BoxedFaces boxed(m, some);
  const auto is_proven = [&](u32 g) { return u.has(g) || is_aside(m, u, g); };
  ListedFaces near;
  if (!list_near(near_faces, boxed.all, ListedFaces::most, is_proven, near)) return false;
  test_pairs(m, scope, boxed, {near.face, near.count}, nullptr, sink);
  return true;
}

// ---------------------------------------------------------------- together

// False if the faces do not lie side by side, or lie amid much smaller ones: a part of 128 faces is about eleven faces
// wide, and a few hundred lie near it where two layers of the surface meet.
bool try_together(const Mesh& m, const NearFaces& near_faces, const DetectScope& scope, Span<const u32> some,
                  ContactSink& sink) {
  const BoxedFaces boxed(m, some);
  if (extent_of(boxed.all) > 16 * boxed.largest) return false;
  const u32 most_near = 256 + 14 * some.size;
  static_assert(256 + 14 * most_in_part <= ListedFaces::most);
  const auto is_proven = [](u32) { return false; };
  ListedFaces near;
  if (!list_near(near_faces, boxed.all, most_near, is_proven, near)) return false;
  ProvenCorners proven(m, scope.star, some);
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

// Tests faces without the proof of try_unfolded(). When a part fails, halves of it are tried, down to single faces; the
// rest of the part goes on in pieces of the size that succeeded.
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
    const bool is_whole = part.size == faces.size;  // has failed
    if (is_whole || !try_unfolded(m, near_faces, scope, part, sink)) test_parts(m, near_faces, scope, part, sink);
  }
}

// ---------------------------------------------------------------- groups

// In `active`. Groups follow each other in one list; two neighbours have different marks.
enum : u8 { is_active = 1, first_mark = 2, second_mark = 3 };

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
    if (scope.active[first] != is_active) continue;
    const u32 end = count + most_in_group;
    u32 next = count;
    take(first);
    for (; next < count; ++next)
      for (u32 h = 3 * group[next]; h < 3 * group[next] + 3; ++h) {
        const u32 beside = m.opposite[h] == none ? none : face_of(m.opposite[h]);
        if (beside != none && scope.active[beside] == is_active && count < end) take(beside);
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
  const bool grouped = scope.room.size > scope.faces.size;
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
