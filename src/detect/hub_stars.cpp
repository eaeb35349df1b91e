// SPDX-License-Identifier: MIT
#include "detect/hub_stars.h"

namespace tpa {

namespace {

// Stars of fewer faces are searched in no time.
constexpr u32 most_faces_searched = 64;
constexpr u64 faces_for_unit = 4;

bool lives_as_hub(const Mesh& m, u32 v) { return vertex_lives(m, v) && has_more_faces(m, v, most_faces_searched); }

HubStar proven(const Mesh& m, Meter* meter, u32 v) {
  const Vec3& p = m.position[v];
  const auto spoke = [&](u32 u) { return m.position[u] - p; };
  FanNormal normal;
  u64 faces = 0;
  for_each_outgoing(m, v, [&](u32 h) {
    normal.add(spoke(head(m, h)), spoke(apex(m, h)));
    ++faces;
  });
  FanTurns turns(normal);
  for_each_outgoing(m, v, [&](u32 h) { turns.add(spoke(head(m, h)), spoke(apex(m, h))); });
  spend(meter, faces / faces_for_unit);
  return {.vertex = v, .unfolded = turns.unfolded(), .reach = normal.reach, .turns = turns};
}

bool is_known(const HubStars& hubs, u32 v) {
  for (const HubStar& star : hubs.star)
    if (star.vertex == v) return true;
  return false;
}

// Trial faces round a hub: the corners after the hub, and the ends of the chain.
struct HubChain {
  const HubStar& hub;
  const Mesh& m;
  const FaceCorners* trials;
  u32 n;
  u64 at_hub = 0;  // the set of trial faces
  u32 first = none, last = none;

  Vec3 spoke(u32 v) const { return m.position[v] - m.position[hub.vertex]; }
  u32 corner_of_hub(u32 i) const {
    u32 k = 0;
    while (k < 3 && trials[i].v[k] != hub.vertex) ++k;
    return k;
  }
  u32 from(u32 i) const { return trials[i].v[(corner_of_hub(i) + 1) % 3]; }
  u32 to(u32 i) const { return trials[i].v[(corner_of_hub(i) + 2) % 3]; }
  bool is_within_reach(const Vec3& a) const {
    return max_of(abs_of(a.x), max_of(abs_of(a.y), abs_of(a.z))) <= hub.reach;
  }
  // Is v seen strictly between the ends?
  bool is_between(u32 v) const {
    const Vec3 at = spoke(v);
    return is_within_reach(at) && hub.turns.turns_up(spoke(first), at) && hub.turns.turns_up(at, spoke(last));
  }
};

template <class Visit>
void for_each_at_hub(const HubChain& c, Visit visit) {
  for (u64 rest = c.at_hub; rest != 0; rest &= rest - 1) visit(static_cast<u32>(__builtin_ctzll(rest)));
}

// False unless the trial faces at the hub are a single open chain.
bool find_ends(HubChain& c) {
  u32 firsts = 0, lasts = 0;
  for_each_at_hub(c, [&](u32 i) {
    bool follows = false, goes_on = false;
    for_each_at_hub(c, [&](u32 k) {
      follows = follows || c.to(k) == c.from(i);
      goes_on = goes_on || c.from(k) == c.to(i);
    });
    if (!follows) c.first = c.from(i), ++firsts;
    if (!goes_on) c.last = c.to(i), ++lasts;
  });
  return firsts == 1 && lasts == 1 && c.first != c.last;
}

bool stays_unfolded(const HubChain& c) {
  bool up = true;
  u32 changes = 0;
  for_each_at_hub(c, [&](u32 i) {
    const Vec3 a = c.spoke(c.from(i)), b = c.spoke(c.to(i));
    up = up && c.is_within_reach(a) && c.is_within_reach(b) && c.hub.turns.turns_up(a, b);
    changes += c.hub.turns.is_behind(a) != c.hub.turns.is_behind(b) ? 1u : 0u;
  });
  return up && changes <= 1 && c.hub.turns.turns_up(c.spoke(c.first), c.spoke(c.last));
}

bool is_in_sector(const HubChain& c, u32 i) {
  u32 between = 0;
  for (u32 v : c.trials[i].v) {
    if (v == c.first || v == c.last) continue;
    if (!c.is_between(v)) return false;
    ++between;
  }
  return between > 0;
}

u64 trials_at(u32 v, const FaceCorners* trials, u32 n) {
  u64 set = 0;
  for (u32 i = 0; i < n; ++i) set |= u64{trials[i].v[0] == v || trials[i].v[1] == v || trials[i].v[2] == v} << i;
  return set;
}

}  // namespace

void forget_star(HubStars& hubs, u32 v) {
  for (HubStar& star : hubs.star)
    if (star.vertex == v) star.vertex = none;
}

void know_stars(HubStars& hubs, const Mesh& m, Meter* meter, const FaceCorners* trials, u32 n) {
  for (u32 i = 0; i < n; ++i)
    for (u32 v : trials[i].v) {
      if (is_known(hubs, v) || !lives_as_hub(m, v)) continue;
      hubs.star[hubs.next] = proven(m, meter, v);
      hubs.next = (hubs.next + 1) % HubsPassed::most;
    }
}

const HubsPassed& pass_hubs(HubStars& hubs, const Mesh& m, const FaceCorners* trials, u32 n) {
  HubsPassed& passed = hubs.passed;
  passed.count = 0;
  for (HubStar& star : hubs.star) {
    HubChain chain{.hub = star, .m = m, .trials = trials, .n = n};
    if (star.vertex == none || !star.unfolded || (chain.at_hub = trials_at(star.vertex, trials, n)) == 0) continue;
    if (!find_ends(chain) || !stays_unfolded(chain)) {
      star.vertex = none;
      continue;
    }
    u64 set = chain.at_hub;
    for (u32 i = 0; i < n; ++i)
      if ((set >> i & 1) == 0 && is_in_sector(chain, i)) set |= u64{1} << i;
    passed.hub[passed.count] = star.vertex;
    passed.trials[passed.count++] = set;
  }
  return passed;
}

}  // namespace tpa
