// SPDX-License-Identifier: MIT
// cut_workbench: a mesh with one cluster and its loops in the hands of the library.
#pragma once

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "cut/clusters.h"
#include "support/library_mesh.h"

namespace support {

struct Workbench : ArrangedMesh {
  Workbench(const Mesh& mesh, const std::set<uint32_t>& inside)
      : ArrangedMesh(mesh, 4 * TriangleCount(mesh)),
        cluster(4 * vertices, tpa::none),
        stretches(cluster.size(), tpa::none),
        members(inside.begin(), inside.end()),
        walked(faces),
        vertex_marks(vertices),
        cuts(3 * faces),
        middles(cuts.size()),
        loops(faces),
        pieces(faces) {
    r.cluster = cluster.data();
    r.stretches = stretches.data();
    r.walked = walked.data();
    r.members = {members.data(), static_cast<uint32_t>(members.size()), static_cast<uint32_t>(members.size())};
    r.cuts = {cuts.data(), 3 * faces, 0};
    r.middle = middles.data();
    r.loops = {loops.data(), faces, 0};
    r.pieces = {pieces.data(), faces, 0};
    for (const uint32_t v : inside) cluster[v] = members[0];
    uint64_t needed = 0;
    EXPECT_TRUE(tpa::find_loops(e.mesh, r, needed));
  }

  std::vector<uint32_t> cluster, stretches, members;
  std::vector<uint8_t> walked, vertex_marks;
  std::vector<tpa::Cut> cuts;
  std::vector<tpa::Vec3> middles;
  std::vector<tpa::CutLoop> loops;
  std::vector<tpa::Piece> pieces;
  tpa::Clusters r;
};

}  // namespace support
