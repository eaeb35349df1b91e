// SPDX-License-Identifier: MIT
#include "contact_trial.h"

#include <set>

#include "cut/pieces.h"
#include "detect/face_pair.h"
#include "detect/new_faces.h"
#include "support/transaction.h"

namespace figures {

namespace {

using support::Mesh;
using tpa::u32;

// One transaction up to the cut, as in src/step/transaction.cpp; rolled back at the end.
struct Cutting : support::Transaction {
  using Transaction::Transaction;

  bool Cut() {
    tpa::u64 cuts = 0;
    tpa::gather_clusters(w.edit.mesh, w.detection.pairs.span(), w.clusters);
    if (!tpa::find_loops(w.edit.mesh, w.clusters, cuts)) return false;
    tpa::judge_patches(w.edit.mesh, w.near_faces, 0, w.clusters);
    tpa::form_groups(w.edit.mesh, w.detection.pairs.span(), w.clusters);
    return tpa::form_pieces(w.edit.mesh, w.clusters, w.cluster_area) && tpa::cut(w.edit, w.near_faces, w.clusters);
  }
  // Do the k loops belong to k clusters?
  bool IsHandle(const tpa::Piece& piece, size_t k) const {
    std::set<u32> clusters;
    for (u32 l = 0; l < piece.loops; ++l) clusters.insert(w.clusters.loops[piece.first_loop + l].cluster);
    return piece.loops == k && clusters.size() == k;
  }
  Loops LoopsOf(const tpa::Piece& piece, std::vector<u32>& vertices) const {
    Loops loops(piece.loops);
    for (u32 l = 0; l < piece.loops; ++l) {
      const tpa::CutLoop& loop = w.clusters.loops[piece.first_loop + l];
      for (u32 i = 0; i < loop.count; ++i) {
        vertices.push_back(w.clusters.cuts[loop.first + i].vertex);
        loops[l].push_back(w.edit.mesh.position[vertices.back()]);
      }
    }
    return loops;
  }
  // Do the faces between the vertices meet neither each other nor the mesh?
  bool IsFree(const std::vector<u32>& vertices, const Faces& faces) const {
    std::vector<tpa::FaceCorners> trials;
    for (const auto& f : faces) trials.push_back({{vertices[f.v[0]], vertices[f.v[1]], vertices[f.v[2]]}});
    for (size_t i = 0; i < trials.size(); ++i) {
      if (!tpa::trials_are_free(w.edit.mesh, w.near_faces, nullptr, &trials[i], 1, tpa::Expected::bent)) return false;
      for (size_t k = 0; k < i; ++k)
        if (tpa::corners_meet(w.edit.mesh, trials[i].v, trials[k].v)) return false;
    }
    return true;
  }
  // The rank of the first free stored handle, or none.
  u32 FirstFree(const std::vector<u32>& vertices, StoredChoice& stored) {
    if (!stored.tabled()) return tpa::none;
    stored.Rank();
    for (u32 i = 0; i < stored.count(); ++i)
      if (IsFree(vertices, stored.Get(i))) return i;
    return tpa::none;
  }
  Trial Judge(const tpa::Piece& piece) {
    Trial trial;
    std::vector<u32> vertices;
    trial.loops = LoopsOf(piece, vertices);
    StoredChoice stored(trial.loops);
    trial.tabled = stored.tabled();
    const u32 rank = FirstFree(vertices, stored);
    const tpa::PieceOutcome outcome = tpa::connect_piece(w.edit, w.near_faces, w.clusters, piece, {candidates, {}},
                                                         tpa::Candidates::tested, w.closing);
    trial.agrees = outcome.done || rank == tpa::none;
    trial.source = rank == 0           ? Source::first_stored
                   : rank != tpa::none ? Source::later_stored
                   : outcome.done      ? Source::other_handle
                                       : Source::nothing;
    return trial;
  }
};

// Does the part, moved, meet an earlier part?
class Touching {
 public:
  Touching(tpa_context* context, const Mesh& before, const Mesh& part)
      : context_(context),
        part_(part),
        vertices_(support::VertexCount(before)),
        faces_(support::TriangleCount(before)) {
    support::Load(context, support::Together({before, part}));
  }
  bool At(const support::Point& by) {
    tpa::Workspace w = tpa::open(*tpa::context_of(context_));
    for (u32 v = 0; v < support::VertexCount(part_); ++v) {
      const support::Point p = support::PositionOf(part_, v);
      w.edit.mesh.position[vertices_ + v] = {p[0] + by[0], p[1] + by[1], p[2] + by[2]};
    }
    tpa::detect_all(w, {});
    for (const tpa::Contact& c : w.detection.pairs)
      if (c.a < faces_ && c.b >= faces_) return true;
    return false;
  }

 private:
  tpa_context* context_;
  const Mesh& part_;
  u32 vertices_, faces_;
};

support::Point Times(const support::Point& p, double by) { return {p[0] * by, p[1] * by, p[2] * by}; }

tpa_config SmallConfig() { return support::DefaultConfig(2000); }

// Contacts within one part are of no interest here.
bool HasForeignContactsOnly(const tpa::Detection& found, const std::vector<u32>& part_of_face) {
  for (const tpa::Contact& c : found.pairs)
    if (part_of_face[c.a] == part_of_face[c.b]) return false;
  return found.found <= found.pairs.capacity;
}

}  // namespace

Laboratory::Laboratory() : arena_(SmallConfig()) {}

Mesh Laboratory::PushTogether(const Scene& scene) {
  Mesh all = scene.parts[0];
  for (size_t i = 1; i < scene.parts.size(); ++i) {
    const support::Point& outwards = scene.outwards[i];
    Touching touching(*arena_, all, scene.parts[i]);
    double near = -0.5, far = 6;
    for (int step = 0; step < 9; ++step) {
      const double middle = 0.5 * (near + far);
      (touching.At(Times(outwards, middle)) ? near : far) = middle;
    }
    all = support::Together({all, support::Translated(scene.parts[i], Times(outwards, near - scene.depths[i]))});
  }
  return all;
}

std::vector<Trial> Laboratory::Run(const Scene& scene) {
  const size_t k = scene.parts.size();
  std::vector<u32> part_of_face;
  for (size_t i = 0; i < k; ++i)
    part_of_face.resize(part_of_face.size() + support::TriangleCount(scene.parts[i]), static_cast<u32>(i));
  if (support::Load(*arena_, PushTogether(scene)) != TPA_OK) return {};
  Cutting cutting(*arena_);
  std::vector<Trial> trials;
  if (!HasForeignContactsOnly(cutting.w.detection, part_of_face) || !cutting.Cut()) return trials;
  for (const tpa::Piece& piece : cutting.w.clusters.pieces) {
    if (!cutting.IsHandle(piece, k)) return trials;  // the holes of other pieces would stay open
    trials.push_back(cutting.Judge(piece));
    if (trials.back().source == Source::nothing) break;
  }
  return trials;
}

}  // namespace figures
