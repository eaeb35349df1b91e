// SPDX-License-Identifier: MIT
// detectors: complete detection as the library does it, and as its peers do. Each takes a mesh and gives the sorted
// pairs of triangles that meet beyond what they share, and the seconds that took, structure build included.
#pragma once

#include <optional>
#include <utility>

#include "meshes.h"
#include "topoadapt.h"

namespace bench {

using Pairs = std::vector<std::pair<uint32_t, uint32_t>>;

struct Measured {
  Pairs pairs;
  double seconds = 0;
};

struct Detector {
  const char* name;
  // The best of `repeats` runs.
  Measured (*run)(const Mesh& mesh, int repeats);
};

// Keeps the best time of `repeats` runs of work().
template <class Prepare, class Work>
double BestTime(int repeats, Prepare prepare, Work work);

// Does the library load the mesh? Says why not.
bool IsLoaded(const Mesh& mesh, const std::string& name);

Measured DetectOurs(const Mesh& mesh, int repeats);
Measured DetectWithCgal(const Mesh& mesh, int repeats);
Measured DetectWithEmbree(const Mesh& mesh, int repeats);

}  // namespace bench

#include <time.h>

#include <algorithm>

// Processor time, which on one core is what the clock on the wall shows on an idle machine.
template <class Prepare, class Work>
double bench::BestTime(int repeats, Prepare prepare, Work work) {
  const auto now = [] {
    timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  };
  double best = 1e30;
  for (int i = 0; i < repeats; ++i) {
    prepare();
    const double start = now();
    work();
    best = std::min(best, now() - start);
  }
  return best;
}
