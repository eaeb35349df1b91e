#include "handle_choice.h"

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
  tpa::WordHandle images[24];
  tpa::exchange_images(key_, tpa::tabled_generator(key_, ranked_[i].generator), images);
  tpa::Placement at;
  for (u32 p = 0; p < key_.k; ++p) {
    at.sides[p] = key_.sides[p], at.first[p] = first_[key_.order[p]];
    at.rotation[p] = ranked_[i].rotation[p];
  }
  Faces faces(faces_);
  tpa::write_faces(key_.k, images[ranked_[i].image], at, faces.data());
  return faces;
}

WholeChoice::WholeChoice(const Loops& loops) {
  tpa::u64 vertices = 0;
  for (const auto& loop : loops) {
    loops_.push_back({loop.data(), static_cast<u32>(loop.size())});
    vertices += loop.size();
  }
  scratch_.resize(tpa::candidate_scratch_bytes(vertices, loops.size()) / 8 + 1);
  faces_.resize(tpa::candidate_face_count({loops_.data(), static_cast<u32>(loops_.size())}));
}

bool WholeChoice::First() {
  tpa::CandidateSearch search;
  tpa::CandidateOptions options;
  options.shortest_first = true;
  const tpa::Span<tpa::u8> scratch{reinterpret_cast<tpa::u8*>(scratch_.data()),
                                   static_cast<u32>(8 * scratch_.size())};
  u32 count = 0;
  return tpa::begin(search, {loops_.data(), static_cast<u32>(loops_.size())}, scratch, options) &&
         tpa::next(search, {faces_.data(), static_cast<u32>(faces_.size())}, count);
}

double LengthBetween(const Loops& loops, const Faces& faces) {
  std::vector<tpa::Vec3> points;
  std::vector<size_t> loop_of;
  for (size_t l = 0; l < loops.size(); ++l) {
    loop_of.insert(loop_of.end(), loops[l].size(), l);
    points.insert(points.end(), loops[l].begin(), loops[l].end());
  }
  double sum = 0;  // each edge between loops has two faces
  for (const tpa::HandleFace& f : faces)
    for (u32 c = 0; c < 3; ++c) {
      const u32 a = f.v[c], b = f.v[(c + 1) % 3];
      if (loop_of[a] != loop_of[b]) sum += 0.5 * tpa::length(points[a] - points[b]);
    }
  return sum;
}

}  // namespace figures
