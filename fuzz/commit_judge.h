// SPDX-License-Identifier: MIT
// commit_judge: the promises of the header about a context after a call, asked of oracles without code of the library.
// All of them abort with the promise that does not hold.
#pragma once

#include <string>

#include "deeds.h"
#include "topoadapt.h"

namespace fuzz {

// Empty without a mesh.
Mesh MeshOf(const tpa_context* context);
struct Targets {
  std::vector<uint32_t> vertices;
  std::vector<double> positions;
};
Targets TargetsOf(const tpa_context* context);

struct Judged {
  uint64_t meshes = 0, pairs = 0, events = 0, made_vertices = 0, points = 0, regions = 0;
};

// Of the context before a commit.
struct Before {
  Mesh mesh, moved;  // moved: with targets reached
  uint64_t epoch = 0;
  explicit Before(const tpa_context* context);
};

// The mesh and all that is told of it: view, export, components, opposite half-edges.
void JudgeMesh(const tpa_context* context, Judged& judged);
// What a successful commit says that it did: report, events, maps, changes, carried attributes; and the region, if the
// mesh before is known to bound one, and after tpa_adapt.
void JudgeCommit(const Deed& deed, const Before& before, const Outcome& o, bool is_proper, tpa_context* context,
                 Judged& judged);
// tpa_detect and tpa_validate against each pair of triangles.
void JudgeDetection(tpa_context* context, const Host& host, Judged& judged);

}  // namespace fuzz
