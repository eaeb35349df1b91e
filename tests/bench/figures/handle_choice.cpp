#include "handle_choice.h"

#include <numeric>

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

double ShortestBetween(const Loops& loops) {
  std::vector<tpa::Vec3> points = loops[0];
  points.insert(points.end(), loops[1].begin(), loops[1].end());
  const u32 p = static_cast<u32>(loops[0].size()), q = static_cast<u32>(loops[1].size());
  std::vector<u32> numbers(points.size());
  std::iota(numbers.begin(), numbers.end(), 0u);
  std::vector<tpa::u64> scratch(tpa::candidate_scratch_bytes(p + q, 2) / 8 + 1);
  tpa::StripOrder order;
  if (!tpa::lay_out_strip_order(p, q, 1, reinterpret_cast<tpa::u8*>(scratch.data()), 8 * scratch.size(), order))
    return 0;
  tpa::find_strips({points.data(), {numbers.data(), p}, {numbers.data() + p, q}}, {}, order);
  return order.count > 0 ? order.best[0].length : 0;
}

}  // namespace figures
