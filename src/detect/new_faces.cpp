// SPDX-License-Identifier: MIT
#include "detect/new_faces.h"

#include "detect/face_pair.h"
#include "detect/hub_stars.h"
#include "detect/trial_fences.h"
#include "geometry/slab_bitmaps.h"
#include "geometry/star.h"

namespace tpa {

namespace {

constexpr f64 least_normal_cosine = 0.5;
constexpr HubsPassed no_hubs{};

// Are the trial faces, in some order, a closed fan round their first vertex, and proven to share nothing but the
// spokes? False for fans too large for the proof.
bool fan_is_unfolded(const Mesh& m, const FaceCorners* trials, u32 n) {
  if (n < 3 || n > star_is_unfolded_limit) return false;
  Points<star_room> room;
  Vec3* const link = room.data();
  for (u32 count = 0, at = 0; count < n;) {
    if (trials[at].v[0] != trials[0].v[0]) return false;
    link[count++] = m.position[trials[at].v[1]];
    const u32 to = trials[at].v[2];
    u32 tries = 0;
    do {
      at = at + 1 == n ? 0 : at + 1;
    } while (trials[at].v[1] != to && ++tries < n);
    if (tries == n) return false;
    if (at == 0) return count == n && star_is_unfolded(m.position[trials[0].v[0]], link, n);
  }
  return false;
}

struct FencedTrials {
  u64 set;
  TrialFences fences;
};

// The trial faces, with their planes and boxes.
struct TrialRoom {
  Probe probes[largest_star];
  Box box[largest_star];
  TrialCorners corners;
  FencedTrials part[2];  // those that lean to the first one, and all others
  SlabBitmaps::Word word;
};
static_assert(sizeof(TrialRoom) <= trial_room_bytes && largest_star <= SlabBitmaps::of_word);

void fence_in(TrialRoom& room, const Mesh& m, const NearFaces& g, const FaceCorners* trials, u32 n) {
  Vec3 normal[2];
  for (FencedTrials& part : room.part) part.set = 0;
  for (u32 i = 0; i < n; ++i) {
    const Vec3& of_i = room.probes[i].plane.normal;
    const u32 k = i == 0 || turns_little(room.probes[0].plane.normal, of_i) ? 0 : 1;
    room.part[k].set |= u64{1} << i;
    normal[k] = normal[k] + of_i;
  }
  for (u32 k = 0; k < 2; ++k)
    if (room.part[k].set != 0)
      make_fences(room.part[k].fences, room.corners, m, g, trials, room.part[k].set, normal[k]);
}

// The set of trial faces for which is_beyond(fences) is false.
template <class IsBeyond>
u64 not_beyond(const TrialRoom& room, IsBeyond is_beyond) {
  u64 set = 0;
  for (const FencedTrials& part : room.part)
    if (part.set != 0 && !is_beyond(part.fences)) set |= part.set;
  return set;
}

// The search leaf by leaf, where fences pass over most boxes and faces, and proofs of stars over those at hubs.
// meets_one_of(box, set of trial faces, corners) tests a face.
template <class MeetsOneOf>
bool are_free_of_mesh(const Mesh& m, const NearFaces& g, const u8* going, const HubsPassed& passed, const Box& all,
                      const TrialRoom& room, const MeetsOneOf& meets_one_of) {
  u64 near = 0;
  const auto enters = [&](const Box& box, u32 hub) {
    near = ~passed.passed_at(hub) & not_beyond(room, [&](const TrialFences& s) { return is_box_beyond(s, box); });
    return near != 0;
  };
  const auto meets_a_trial = [&](u32 f) {
    if (going != nullptr && going[f] != 0) return false;
    const u32* v = face_corners(m, f);
    u64 set = near & ~(passed.passed_at(v[0]) | passed.passed_at(v[1]) | passed.passed_at(v[2]));
    if (set == 0) return false;
    set &= not_beyond(room, [&](const TrialFences& s) { return is_beyond_fence(s, m, v); });
    return set != 0 && meets_one_of(face_box(m, f), set, v);
  };
  return find_near_within(g, all, enters, meets_a_trial) == none;
}

}  // namespace

bool turns_little(const Vec3& before, const Vec3& after) {
  const f64 d = dot(before, after);
  return d > 0 && d * d > least_normal_cosine * least_normal_cosine * squared_length(before) * squared_length(after);
}

bool trials_are_free(const Mesh& m, const NearFaces& g, const u8* going, const FaceCorners* trials, u32 n,
                     Expected expected) {
  spend(g.meter, 4 + n);
  if (n == 0) return true;
  const HubsPassed& passed = g.hubs != nullptr ? pass_hubs(*g.hubs, m, trials, n) : no_hubs;
  // The view of a hub's neighbourhood is crowded.
  if (passed.count == 0 && expected == Expected::flat && covers_once(m, g, going, trials, n)) return true;
  TrialRoom& room = *reinterpret_cast<TrialRoom*>(g.tree->trial_room);
  Box all = empty_box;
  for (u32 i = 0; i < n; ++i) {
    const u32* v = trials[i].v;
    room.probes[i] = probe_of(m, v);
    room.box[i] = box_of(m.position[v[0]], m.position[v[1]], m.position[v[2]]);
    all = united(all, room.box[i]);
  }
  const SlabBitmaps boxes({room.box, n}, all, &room.word);
  // Does a face with this box meet one of the trial faces in the set?
  const auto meets_one_of = [&](const Box& around, u64 set, const u32* v) {
    u64 met;
    for (boxes.meeting(around, &met), met &= set; met != 0; met &= met - 1) {
      spend(g.meter, of_exact_test);
      if (meets(m, room.probes[__builtin_ctzll(met)], v)) return true;
    }
    return false;
  };
  if (!fan_is_unfolded(m, trials, n))
    for (u32 i = 1; i < n; ++i)
      if (meets_one_of(room.box[i], (u64{1} << i) - 1, trials[i].v)) return false;
  fence_in(room, m, g, trials, n);
  return are_free_of_mesh(m, g, going, passed, all, room, meets_one_of);
}

}  // namespace tpa
