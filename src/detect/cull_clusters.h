// cull_clusters: proofs that the faces of a cluster, or of several, meet nothing of the sheet that they are part of.
//
// Let P be these clusters. Look along a direction d at a disc D that their faces lie in. Let S be P and all clusters
// that are reached from it over common edges by way of clusters that may reach over D. If (1) all faces of S turn the
// same side up, and (2) beside some point inside D no face of S but one of P is over it, then no face of P meets any
// face of S except in what they share.
// For an edge of S over D belongs to two faces that are over D, and so both in S: no border of S runs over D, nor over
// what is close round it. By (1) each point there that lies on no edge is then covered equally often (the winding
// number of the border, which is constant off it), and by (2) once, since P covers some of D. Two faces through one
// point in space, with the faces round it, would both cover what is near that point. All faces that share a vertex with
// one of P are in S, since they reach over D, and follow each other round the vertex.
#pragma once

#include "detect/face_tree.h"

namespace tpa {

// FaceTree that were looked at, and which of them are in S.
struct Sheet {
  static constexpr u32 most = 160;
  ClusterSet<most, 512> known;
  u32 count = 0;
  u32 member[most + 1];
  bool belongs[most + 4];  // by place in `known`

  bool has(u32 cluster) const {
    const u8 at = known.place[known.slot_of(cluster)];
    return at != 0 && belongs[at - 1];
  }
  void clear() {
    known.clear();
    count = 0;
    memset(belongs, 0, sizeof belongs);
  }
  // Notes a cluster, once; false where there is no room.
  bool note(u32 cluster) { return known.add(cluster); }
  // Whether the cluster, which is known at this place, is in S: as good as random, so nothing branches on it. One
  // member more is written than is counted; and `belongs` for up to three places that are not known yet.
  void take(u32 at, u32 cluster, u32 is_in) {
    belongs[at] = is_in != 0;
    member[count] = cluster;
    count += is_in;
  }
};

// Finds S for a cluster; false where it proves nothing.
bool find_sheet(const FaceTree& c, const Mesh& m, u32 cluster, Sheet& s);
// For several at once: cheaper where the surface hardly bends, and sooner given up.
bool find_common_sheet(const FaceTree& c, const Mesh& m, Span<const u32> several, Sheet& s);

}  // namespace tpa
