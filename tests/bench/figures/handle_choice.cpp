#include "handle_choice.h"

#include <algorithm>

namespace figures {

using tpa::u32;

namespace {

// As the exact searches take them, one behind the other in `points`.
template <class JoinedLoops>
JoinedLoops Joined(const Loops& loops, std::vector<tpa::Vec3>& points) {
  JoinedLoops out;
  for (size_t l = 0; l < loops.size(); ++l) {
    points.insert(points.end(), loops[l].begin(), loops[l].end());
    out.first[l + 1] = static_cast<u32>(points.size());
  }
  out.points = points.data();
  return out;
}

}  // namespace

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

namespace {

// Total length of the edges between loops.
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

}  // namespace

WholeChoice::WholeChoice(const Loops& loops) : loops_(loops) {
  tpa::u64 vertices = 0;
  for (const auto& loop : loops) vertices += loop.size();
  scratch_.resize(tpa::candidate_scratch_bytes(vertices, loops.size()) / 8 + 1);
}

double WholeChoice::First(double limit, tpa::u64 work) {
  return loops_.size() == 2 ? FirstOfTwo() : loops_.size() == 3 ? FirstOfThree(limit, work) : FirstOfFour(limit, work);
}

double WholeChoice::FirstOfTwo() {
  const tpa::Loop loops[2] = {{loops_[0].data(), static_cast<u32>(loops_[0].size())},
                              {loops_[1].data(), static_cast<u32>(loops_[1].size())}};
  Faces faces(tpa::candidate_face_count({loops, 2}));
  tpa::CandidateSearch search;
  const tpa::Span<tpa::u8> scratch{reinterpret_cast<tpa::u8*>(scratch_.data()), static_cast<u32>(8 * scratch_.size())};
  u32 count = 0;
  const bool found = tpa::begin(search, {loops, 2}, scratch, {candidates, true, {}}) &&
                     tpa::next(search, {faces.data(), static_cast<u32>(faces.size())}, count);
  return found ? LengthBetween(loops_, faces) : 0;
}

double WholeChoice::FirstOfThree(double limit, tpa::u64 work) {
  std::vector<tpa::Vec3> points;
  const auto loops = Joined<tpa::ThreeLoops>(loops_, points);
  tpa::ThreeHandle best;
  bool complete = false;
  const u32 found =
      tpa::shortest_of_three(loops, limit, work, reinterpret_cast<tpa::u8*>(scratch_.data()), {&best, 1}, complete);
  return complete && found == 1 ? best.length : 0;
}

double WholeChoice::FirstOfFour(double limit, tpa::u64 work) {
  std::vector<tpa::Vec3> points;
  const auto loops = Joined<tpa::ShortLoops>(loops_, points);
  tpa::ShortestScratch scratch;
  bool complete = false;
  const bool fits =
      tpa::lay_out_four(loops, 1, reinterpret_cast<tpa::u8*>(scratch_.data()), 8 * scratch_.size(), scratch);
  const u32 found = fits ? tpa::shortest_of_four(loops, limit, work, scratch, complete) : 0;
  return complete && found == 1 ? scratch.found.best[0].length : 0;
}

}  // namespace figures
