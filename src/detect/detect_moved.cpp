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

// A part fits into a word. With two words for a part nothing takes less time.
constexpr u32 most_in_group = most_unfolded, most_in_part = SlabBitmaps::of_word;
static_assert(most_in_part <= most_in_group && most_in_group <= SlabBitmaps::most);

// Faces of a group or of a part, with their boxes.
struct BoxedFaces {
  Span<const u32> faces;
  Box all;
  f32 largest;  // extent of a box
  Box box[most_in_group];

  void set(const Mesh& m, Span<const u32> some) {
    faces = some, all = empty_box, largest = 0;
    for (u32 i = 0; i < some.size; ++i) {
      box[i] = face_box(m, some[i]);
      all = united(all, box[i]);
      largest = max_of(largest, extent_of(box[i]));
    }
  }
};

// The corners of a part with proven stars, each with the set of its faces in the part: bit i for face i. A face with
// such a corner does not meet the faces of the set. Corners without proof have the empty set.
struct ProvenCorners {
  static constexpr u32 most = 3 * most_in_part, slots = 256;
  static_assert(most < slots);
  u32 count;
  u32 vertex[most];
  u64 faces[most];

  void set(const Mesh& m, u8* star, Span<const u32> part) {
    count = 0;
    numbers_ = {slot_, slots};
    numbers_.clear();
    for (u32 i = 0; i < part.size; ++i)
      for (u32 k = 0; k < 3; ++k) faces[enter(face_corners(m, part[i])[k])] |= u64{1} << i;
    for (u32 at = 0; at < count; ++at)
      if (!star_proven(m, star, vertex[at])) faces[at] = 0;
  }

  // Takes the faces with a proven corner in common with g out of a set of faces of the part.
  void leave_out(const u32* g, u64& set) const {
    for (u32 k = 0; k < 3; ++k)
      if (const u32 at = number_of(g[k]); at != none) set &= ~faces[at];
  }

 private:
  u32 slot_[slots];
  OpenHash numbers_;

  u32& number_of(u32 v) const {
    return numbers_.find(scattered(v), [&](u32 at) { return vertex[at] == v; });
  }
  u32 enter(u32 v) {
    u32& at = number_of(v);
    if (at != none) return at;
    vertex[count] = v;
    faces[count] = 0;
    return at = count++;
  }
};

// A pair of active faces is found from both sides; the face with the lower number reports the pair.
bool reports(u32 f, u32 g, bool g_is_active) { return !g_is_active | (f < g); }

// A tested face and a face near it.
enum PairSide : u32 { of_tested, of_near };
struct NearPair {
  u32 face[2];
};

// Keeps the pairs in front that the plane of one face, `plane`, does not certainly part; returns their number. Without
// a branch, since answers are random.
u32 keep_unparted(const Mesh& m, PairSide plane, NearPair* pair, u32 count) {
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
  u32 count;
  MetFaces met[most + 1];  // an entry is written before it is counted, as are pairs below
};

struct ListedFaces {
  static constexpr u32 most = 2048;
  u32 count;
  u32 face[most];
};

// The arrays of a task.
struct PairRoom {
  static constexpr u32 most_pairs = 256;
  Unfolded unfolded;
  ProvenCorners proven;
  BoxedFaces boxed;
  ListedFaces near;
  SlabBitmaps::Word word[SlabBitmaps::most / SlabBitmaps::of_word];
  MetList list;
  NearPair pair[most_pairs + 1];
};

struct Task {
  const Mesh& m;
  const NearFaces near_faces;  // with the meter of the task
  const DetectScope& scope;
  ContactSink& sink;
  PairRoom& room;
  Meter* meter() const { return near_faces.meter; }
};

// Units of work.
constexpr u64 of_tested_face = 2;

// Tests all pairs of the list, and empties it. One loop runs over the bits of all entries: the number of bits in an
// entry is random, so the end of an inner loop would be mispredicted.
void test_listed(const Task& t, Span<const u32> tested) {
  MetList& list = t.room.list;
  NearPair* pair = t.room.pair;
  for (u32 i = 0; i < list.count && !has_stopped(t.meter());) {
    u32 pairs = 0;
    while (i < list.count && pairs < PairRoom::most_pairs) {
      MetFaces& met = list.met[i];
      const u32 f = tested[met.first + static_cast<u32>(__builtin_ctzll(met.set))];
      pair[pairs] = {{f, met.near}};
      pairs += reports(f, met.near, t.scope.active[met.near] != 0) ? 1u : 0u;
      met.set &= met.set - 1;
      i += met.set == 0 ? 1u : 0u;
    }
    u64 units = pairs;
    pairs = keep_unparted(t.m, of_near, pair, pairs);
    pairs = keep_unparted(t.m, of_tested, pair, pairs);
    spend(t.meter(), units + of_exact_test * pairs);
    for (u32 k = 0; k < pairs; ++k)
      if (faces_meet(t.m, pair[k].face[0], pair[k].face[1])) t.sink.add(pair[k].face[0], pair[k].face[1]);
  }
  list.count = 0;
}

// Tests the boxed faces against the listed near faces. `proven` may be nullptr.
void test_pairs(const Task& t, const ProvenCorners* proven) {
  const BoxedFaces& some = t.room.boxed;
  const SlabBitmaps boxes({some.box, some.faces.size}, some.all, t.room.word);
  MetList& list = t.room.list;
  list.count = 0;
  for (u32 g : Span<const u32>{t.room.near.face, t.room.near.count}) {
    if (list.count + boxes.words > MetList::most) test_listed(t, some.faces);
    u64 met[SlabBitmaps::most / SlabBitmaps::of_word] = {};
    boxes.meeting(face_box(t.m, g), met);
    if (proven != nullptr) proven->leave_out(face_corners(t.m, g), met[0]);
    for (u32 w = 0; w < boxes.words; ++w) {
      list.met[list.count] = {met[w], w * SlabBitmaps::of_word, g};
      list.count += met[w] != 0 ? 1u : 0u;
    }
  }
  test_listed(t, some.faces);
}

// Lists the faces near the boxed faces, without faces that the proof `u` rules out; `u` may be nullptr. False if more
// than `most` faces lie near.
bool list_near(const Task& t, const Unfolded* u, u32 most) {
  ListedFaces& list = t.room.near;
  list.count = 0;
  PassedOver passed;
  const u32 common = t.near_faces.tree->has_hubs ? common_corner(t.m, t.room.boxed.faces) : none;
  if (common != none && star_proven(t.m, t.scope.star, common)) passed.hub[0] = common;
  u32 asked = 0;
  const auto any = [](u32) { return true; };
  return none == find_near(
                     t.near_faces, t.room.boxed.all, any,
                     [&](u32 g) {
                       if (asked++ == most) return true;
                       const bool is_proven = u != nullptr && (u->has(g) || is_aside(t.m, *u, g));
                       if (!is_proven) list.face[list.count++] = g;
                       return false;
                     },
                     passed);
}

// ---------------------------------------------------------------- group

// False without a proof, or if too many faces lie near.
bool try_unfolded(const Task& t, Span<const u32> some) {
  Unfolded& u = t.room.unfolded;
  if (!are_unfolded(t.m, some, u)) return false;
  t.room.boxed.set(t.m, some);
  if (!list_near(t, &u, ListedFaces::most)) return false;
  test_pairs(t, nullptr);
  return true;
}

// ---------------------------------------------------------------- together

// False if the faces do not lie side by side, or lie amid much smaller faces. The limits leave room for a whole part,
// about eight faces wide, with several hundred faces near it where two layers of the surface meet.
bool try_together(const Task& t, Span<const u32> some) {
  const BoxedFaces& boxed = t.room.boxed;
  t.room.boxed.set(t.m, some);
  if (extent_of(boxed.all) > 16 * boxed.largest) return false;
  const u32 most_near = 256 + 14 * some.size;
  static_assert(256 + 14 * most_in_part <= ListedFaces::most);
  if (!list_near(t, nullptr, most_near)) return false;
  t.room.proven.set(t.m, t.scope.star, some);
  test_pairs(t, &t.room.proven);
  return true;
}

// ---------------------------------------------------------------- alone

void test_alone(const Task& t, u32 f) {
  const u32* corner = face_corners(t.m, f);
  const auto share_proven_corner = [&](u32 g) {
    const u32 shared = shared_corners(corner, face_corners(t.m, g));
    for (u32 k = 0; k < 3; ++k)
      if ((shared >> k & 1) != 0 && star_proven(t.m, t.scope.star, corner[k])) return true;
    return false;
  };
  PassedOver passed;
  for (u32 i = 0; i < 3 && t.near_faces.tree->has_hubs; ++i)
    if (star_proven(t.m, t.scope.star, corner[i])) passed.hub[i] = corner[i];
  const auto is_tested = [&](u32 g) { return reports(f, g, t.scope.active[g] != 0) && !share_proven_corner(g); };
  find_near(
      t.near_faces, face_box(t.m, f), is_tested,
      [&](u32 g) {
        spend(t.meter(), of_exact_test);
        if (faces_meet(t.m, f, g)) t.sink.add(f, g);
        return has_stopped(t.meter());
      },
      passed);
}

// ---------------------------------------------------------------- from group to alone

// Tests faces without a proof. If try_together() fails for a part, halves of the part are tried, down to single faces;
// the rest of the part goes on in halves of the size that succeeded.
void test_parts(const Task& t, Span<const u32> faces) {
  for (u32 first = 0, size = 0; first < faces.size && !has_stopped(t.meter()); first += size) {
    size = min_of(first % most_in_part == 0 ? most_in_part : size, faces.size - first);
    while (size > 1 && !try_together(t, faces.part(first, size))) size /= 2;
    if (size == 1) test_alone(t, faces[first]);
  }
}

void test_group(const Task& t, Span<const u32> faces) {
  spend(t.meter(), of_tested_face * faces.size);
  if (try_unfolded(t, faces)) return;
  for (u32 first = 0; first < faces.size; first += most_in_part) {
    const Span<const u32> part = faces.part(first, min_of(most_in_part, faces.size - first));
    const bool is_whole = part.size == faces.size;  // has failed already
    if (is_whole || !try_unfolded(t, part)) test_parts(t, part);
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
void test_groups(const Task& t, Span<const u32> faces, u32 first, u32 last) {
  const auto begins_group = [&](u32 i) { return i == 0 || t.scope.active[faces[i]] != t.scope.active[faces[i - 1]]; };
  while (first < last && !begins_group(first)) ++first;
  while (first < last && !has_stopped(t.meter())) {
    u32 end = first + 1;
    while (end < faces.size && !begins_group(end)) ++end;
    test_group(t, faces.part(first, end - first));
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
  for_metered_runs(exec, scope.faces.size, chunk, scope.rooms.count, [&](u32 run, u32 first, u32 last, Meter* meter) {
    const Task t{m, {&m, g.tree, meter}, scope, sink, scope.rooms.room<PairRoom>(run)};
    if (grouped)
      test_groups(t, {scope.room.data, scope.faces.size}, first, last);
    else
      test_parts(t, scope.faces.part(first, last - first));
  });
  sink.finish();
  spend(exec.meter, sorting_steps(out.pairs.size));
}

}  // namespace tpa
