// SPDX-License-Identifier: MIT
// locality_trial: the same scene alone, and beside bodies that it does not meet (P3'). The near mesh, origins, events,
// vertices held back, and the near share of the report are compared to the bit, but for ids.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "support/support.h"

namespace support {

// A mesh and where its vertices go; equal positions have no target. A tangled mesh goes through tpa_adapt instead.
struct NearScene {
  Mesh mesh;
  std::vector<double> targets;
  bool adapts = false;
};

struct NearFamily {
  std::string name;
  std::function<NearScene(Random& random)> make;
};
inline void PrintTo(const NearFamily& family, std::ostream* out) { *out << family.name; }
const std::vector<NearFamily>& NearFamilies();

// Bodies beside a scene, apart from it by a plane z = `limit`.
struct Beside {
  Mesh mesh;
  std::vector<double> targets;  // empty: no vertex has a target
  double limit = 500;
  bool is_active = false;    // has contacts of its own
  bool comes_first = false;  // its ids are below those of the scene
  bool all_targets = false;  // vertices of the scene that stay have targets at their own places
};

struct BesideKind {
  std::string name;
  std::function<Beside(const NearScene& near, Random& random)> make;
};
const std::vector<BesideKind>& BesideKinds();

struct LocalityTrial {
  NearScene scene;
  bool meets = false;  // the scene has contacts
  struct Difference {
    std::string kind;    // of the bodies beside
    std::string what;    // "status", "mesh", "origins", "held back", "events" or "report", and more
    Mesh alone, beside;  // results
    bool IsOfReport() const { return what.rfind("report", 0) == 0; }
  };
  std::vector<Difference> differences;
  std::vector<std::string> played;  // kinds
};

// How the scene beside these bodies differs from the scene alone; empty if not at all.
std::string DifferenceBeside(const NearScene& scene, const Beside& beside);
// Beside all kinds, or beside `most` of them at random.
LocalityTrial PlayLocality(const NearFamily& family, uint64_t seed, size_t most);

}  // namespace support
