// SPDX-License-Identifier: MIT
// random_commits: commits of all kinds in a row on random scenes, each with the mesh before it kept by the test.
#pragma once

#include <functional>

#include "support/support.h"

namespace support {

// A tangled or free mesh of some bodies, renumbered.
Mesh RandomScene(Random& random);

struct RandomCommit {
  Mesh before, targets;  // targets: of a step; else as before
  std::string kind;
};

// Plays a scene of the seed: tpa_adapt first, then steps, remeshing, smoothing and reordering at random; calls look()
// after each commit. Ends early where a call runs out of room.
void PlayRandomCommits(uint64_t seed, int commits, const std::function<void(tpa_context*, const RandomCommit&)>& look);

}  // namespace support
