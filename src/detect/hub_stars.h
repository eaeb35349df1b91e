// SPDX-License-Identifier: MIT
// hub_stars: proofs that the stars of hubs are unfolded, kept while operations replace faces there (section 7). The
// boxes of all faces round a hub meet, so the search for each operation would look at all of them.
//
// The proof of a hub is that of geometry/star.h: seen along a direction, all faces of the star turn the same way and go
// round once. Suppose trial faces take the place of a chain of faces at the hub, all turn the same way, and the first
// and last spoke are less than half a turn apart. The chain before ended at the same spokes, and was part of a single
// round; if the trial faces make no full turn more, the new star goes round once, too. So:
// (1) A trial face at the hub meets the faces of the star in common corners and edges only.
// (2) So does a trial face with each corner at the end of the first or last spoke or, seen from the hub, strictly
//     between both, and at least one of them strictly between. Only the two spokes are seen at the borders of its
//     sector.
#pragma once

#include "base/meter.h"
#include "geometry/star.h"
#include "mesh/half_edges.h"

namespace tpa {

struct HubStar {
  u32 vertex = none;
  bool unfolded = false;  // proven; otherwise nobody tries again
  f64 reach = 0;          // of the proof: the largest coordinate of a spoke
  FanTurns turns{FanNormal{}};
};

// Hubs at trial faces, each with the set of trial faces proven not to meet the faces round the hub.
struct HubsPassed {
  static constexpr u32 most = 4;
  u32 count = 0;
  u32 hub[most];
  u64 trials[most];

  u64 passed_at(u32 v) const {
    for (u32 i = 0; i < count; ++i)
      if (hub[i] == v) return trials[i];
    return 0;
  }
};

// The hubs asked for last.
struct HubStars {
  HubStar star[HubsPassed::most];
  u32 next = 0;
  HubsPassed passed;  // by the last operation, here to spare the stack
};

// After vertices have moved, or if anything but the trial faces asked about took the place of others.
inline void forget_stars(HubStars& hubs) { hubs = {}; }
// The vertex goes.
void forget_star(HubStars& hubs, u32 v);

// Before an operation moves anything: proves the stars of hubs among the corners of its trial faces. O(1) for known
// hubs, else O(valence).
void know_stars(HubStars& hubs, const Mesh& m, Meter* meter, const FaceCorners* trials, u32 n);

// Pre: know_stars(); the mesh with the trial faces in place of some faces is closed. Forgets hubs whose star might be
// folded afterwards.
const HubsPassed& pass_hubs(HubStars& hubs, const Mesh& m, const FaceCorners* trials, u32 n);

}  // namespace tpa
