// SPDX-License-Identifier: MIT
// evolve_family: plays scenes and judges them, for the tests and for the table of success. The library judges each
// step; independent oracles judge the end.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tool/scenes/evolution.h"

namespace support {

// How a play ended.
enum class Ending {
  right,          // clean, with the topology and volume expected at the end
  clean,          // clean; nothing more is known of the end under these options
  near_critical,  // clean; too near to a change of topology to be compared
  wrong           // another end; or not clean at some step, stalled, or not the boundary of a region
};

struct Verdict {
  Ending ending = Ending::right;
  std::string fault;  // of wrong endings
  tool::Evolution evolution;
  tool::TriangleMesh mesh;  // at the end
  bool Good() const { return ending < Ending::wrong; }
};

// Clean at every step, never stalled, and at the end closed, free of self-intersections, and where tool::end_is_known()
// the boundary of a region, of the topology and volume that the scene should end in.
Verdict Judge(const tool::Scene& scene, const tool::EvolutionOptions& options);

// The first fault of a mesh as the boundary of a region: there is 0 outside of each component, and 1 inside, counted
// by solid angles. Empty: none.
std::string RegionFault(const tool::TriangleMesh& mesh);

// A scene with its pose and options; zeros: as made.
struct Play {
  std::string kind;
  uint64_t seed = 1;
  uint64_t renumber = 0;
  int turn = 0;
  double stride = 0;
  bool substeps = true;
  std::string Command() const;
};
Verdict Judge(const Play& play);

// A scene of each seed, and their outcomes.
enum class Pose { as_is, renumbered, turned };
struct FamilyResult {
  struct Failure {
    std::string command, fault;  // the command shows the end of the play
  };
  uint32_t played = 0, right = 0, clean = 0, near_critical = 0;
  std::vector<Failure> failures;
  double seconds = 0;
};
// Seeds from the play's own on; the pose's number is chosen by the seed.
FamilyResult JudgeFamily(Play play, uint32_t seeds, Pose pose = Pose::as_is);

}  // namespace support
