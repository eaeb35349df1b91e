// SPDX-License-Identifier: MIT
#include "handle_choice.h"

#include <numeric>

#include "triangulate/minimum_triangulation.h"

namespace figures {

using tpa::u32;

StoredChoice::StoredChoice(const Loops& loops) : scratch_(1) {
  tpa::HandleKey key;
  for (const auto& loop : loops) {
    key.sides[key.k++] = static_cast<u32>(loop.size());
    first_[key.k] = first_[key.k - 1] + static_cast<u32>(loop.size());
  }
  faces_ = tpa::handle_face_count(key);
  key_ = tpa::sorted_key(key);
  for (u32 i = 0; i < key_.k; ++i) points_[i] = loops[key_.order[i]].data();
}

void StoredChoice::Rank() {
  ranked_.resize(stored_candidates);
  ranked_.resize(tpa::rank_handles(key_, points_, scratch_[0], {ranked_.data(), stored_candidates}));
}

Faces StoredChoice::Get(u32 i) const {
  Faces faces(faces_);
  tpa::write_ranked(key_, ranked_[i], first_, faces.data());
  return faces;
}

MadeChoice::MadeChoice(const Loops& loops) : loops_(loops), first_(1) {
  for (size_t l = 0; l < loops.size(); ++l) {
    points_.insert(points_.end(), loops[l].begin(), loops[l].end());
    loop_of_.resize(points_.size(), static_cast<u32>(l));
    first_.push_back(static_cast<u32>(points_.size()));
  }
  numbers_.resize(points_.size());
  std::iota(numbers_.begin(), numbers_.end(), 0u);
  scratch_.resize(tpa::candidate_scratch_bytes(points_.size(), loops.size()) / 8 + 1);
}

double MadeChoice::First() { return loops_.size() == 2 ? FirstOfTwo() : FirstThroughTree(); }

double MadeChoice::FirstOfTwo() {
  const u32 p = first_[1], q = first_[2] - p;
  tpa::StripOrder order;
  if (!tpa::lay_out_strip_order(p, q, 1, Scratch(), ScratchBytes(), order)) return 0;
  tpa::find_strips({points_.data(), {numbers_.data(), p}, {numbers_.data() + p, q}}, {}, order);
  return order.best.count > 0 ? order.best.at[0].length : 0;
}

double MadeChoice::FirstThroughTree() {
  const u32 k = static_cast<u32>(loops_.size());
  tpa::DiscNotes notes;
  std::vector<tpa::u64> room(4 * tpa::u64{tpa::longest_disc});
  tpa::Carver carver{reinterpret_cast<tpa::u8*>(room.data()), tpa::element_alignment};
  tpa::carve(carver, tpa::longest_disc, notes);
  const tpa::LoopsToCutOpen loops{points_.data(), loop_of_.data(), first_.data(), k, {}, &notes};
  Faces faces(points_.size() + 2 * k - 4);
  std::vector<u32> corners(points_.size() + 2 * k);
  if (!tpa::cut_open_handle(loops, 0, corners.data(), Scratch(), faces.data())) return 0;
  double sum = 0;  // each edge between loops has two faces
  for (const tpa::FaceCorners& f : faces)
    for (u32 c = 0; c < 3; ++c) {
      const u32 a = f.v[c], b = f.v[(c + 1) % 3];
      if (loop_of_[a] != loop_of_[b]) sum += 0.5 * tpa::length(points_[a] - points_[b]);
    }
  return sum;
}

}  // namespace figures
