// SPDX-License-Identifier: MIT
// cutters: the exact cut and its peers, each with the same self-intersecting mesh, in a process of its own.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "meshes.h"

namespace bench {

struct Cut {
  double seconds = 0;  // of processor time, without the making of the peer's own mesh
  Mesh mesh;
};

// Nothing where the peer refuses the mesh, or says that it failed.
using Cutter = std::optional<Cut> (*)(const Mesh& mesh);

// tpa_load and tpa_adapt.
std::optional<Cut> CutWithLibrary(const Mesh& mesh);
// CGAL's autorefine_and_remove_self_intersections, on the whole mesh.
std::optional<Cut> AutorefineWithCgal(const Mesh& mesh);
// CGAL's corefine_and_compute_union, component by component.
std::optional<Cut> UniteWithCgal(const Mesh& mesh);

// In a child process, which ends after so many seconds on the wall: no peer can hang or crash the benchmark.
struct Outcome {
  enum Kind { done, refused, crashed, late } kind = refused;
  Cut cut;
};
Outcome RunInChild(Cutter cutter, const Mesh& mesh, int seconds);
// The same for a program that reads the mesh from its standard input and writes the cut to its standard output: as
// doubles, the seconds and the counts of coordinates and corners (the input has no seconds), then all of these.
Outcome RunProgram(const std::vector<std::string>& command, const Mesh& mesh, int seconds);

}  // namespace bench
