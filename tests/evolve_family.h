// evolve_family: plays scenes and judges them, for the tests and for the table of success. What happens at each step is
// asked of the library; the end is judged by oracles of their own.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "evolution.h"

namespace support {

struct Verdict {
  std::string fault;       // empty: all as it should be
  bool undecided = false;  // the end is too near to a change of topology to be compared
  tool::Evolution evolution;
  tool::TriangleMesh mesh;  // at the end
  bool Good() const { return fault.empty(); }
};

// Clean at every step, never stalled, and at the end closed, free of self-intersections, the boundary of a region, and
// of the topology and volume that the scene should end in. Steps longer than the scene's own end otherwise, unless the
// scene says that they do not, and steps that are not cut may pass through the surface: then the end only has to be
// clean.
Verdict Judge(const tool::Scene& scene, const tool::EvolutionOptions& options);

// The first fault of a mesh as the boundary of a region: there is 0 outside of each component, and 1 inside, counted
// by solid angles. Empty: none.
std::string RegionFault(const tool::TriangleMesh& mesh);

// A scene, and how it is posed and played; zeros: as it is.
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

// A scene of each seed, and what came of them.
enum class Pose { as_is, renumbered, turned };
struct FamilyResult {
  uint32_t played = 0, good = 0, undecided = 0;
  std::vector<std::string> faults;  // one line for each scene that failed, with the command that shows it
  double seconds = 0;
};
// Seeds from 1 on; the play's own seed is not asked, and the pose's number is chosen by the seed.
FamilyResult JudgeFamily(Play play, uint32_t seeds, Pose pose = Pose::as_is);

}  // namespace support
