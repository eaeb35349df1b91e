// SPDX-License-Identifier: MIT
#include "detect/new_faces.h"

#include "detect/face_pair.h"
#include "detect/hub_stars.h"
#include "geometry/slab_bitmaps.h"
#include "geometry/star.h"

namespace tpa {

namespace {

constexpr f64 least_normal_cosine = 0.5;
constexpr u64 proofs_for_unit = 4;
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

// The trial faces, with their planes and boxes.
struct TrialRoom {
  Probe probes[largest_star];
  Box box[largest_star];
  FlatTriangle flat[largest_star];
  SlabBitmaps::Word word;
};
static_assert(sizeof(TrialRoom) <= trial_room_bytes && largest_star <= SlabBitmaps::of_word);

// The search near trial faces at hubs, where most boxes meet: proofs leave few of the leaves, and of the trial faces
// for each leaf. meets_one_of(box, set of trial faces, corners) tests a face.
template <class MeetsOneOf>
bool are_free_at_hubs(const Mesh& m, const NearFaces& g, const u8* going, const FaceCorners* trials, u32 n,
                      const HubsPassed& passed, const Box& all, TrialRoom& room, const MeetsOneOf& meets_one_of) {
  u64 flat = 0;
  for (u32 i = 0; i < n; ++i) flat |= u64{flatten(g, triangle_of(m, trials[i].v), room.flat[i])} << i;
  u64 near = 0, proofs = 0;
  const auto enters = [&](const Box& box, u32 hub) {
    near = (~u64{0} >> (SlabBitmaps::of_word - n)) & ~passed.passed_at(hub);
    for (u64 rest = near & flat; rest != 0; rest &= rest - 1, ++proofs)
      if (provably_off(room.flat[__builtin_ctzll(rest)], box)) near &= ~(rest & (0 - rest));
    return near != 0;
  };
  const auto meets_a_trial = [&](u32 f) {
    if (going[f] != 0) return false;
    const u32* v = m.corner + 3 * static_cast<size_t>(f);
    const u64 set = near & ~(passed.passed_at(v[0]) | passed.passed_at(v[1]) | passed.passed_at(v[2]));
    return set != 0 && meets_one_of(face_box(m, f), set, v);
  };
  const bool free = find_near_within(g, all, enters, meets_a_trial) == none;
  spend(g.meter, proofs / proofs_for_unit);
  return free;
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
  if (g.hubs != nullptr && g.tree->has_hubs)
    return are_free_at_hubs(m, g, going, trials, n, passed, all, room, meets_one_of);
  const auto meets_a_trial = [&](u32 f) { return meets_one_of(face_box(m, f), ~u64{0}, m.corner + 3 * f); };
  return find_near(
             g, all, [&](u32 f) { return going == nullptr || going[f] == 0; }, meets_a_trial) == none;
}

}  // namespace tpa
