// SPDX-License-Identifier: MIT
// handle_choice: two ways to choose a handle, with their scratch: the shortest of the database, and a short handle made
// on the spot.
#pragma once

#include <vector>

#include "triangulate/candidates.h"
#include "triangulate/rank_stored.h"

namespace figures {

// Closed loops, in the directions of a handle through them.
using Loops = std::vector<std::vector<tpa::Vec3>>;
using Faces = std::vector<tpa::FaceCorners>;

inline constexpr tpa::u32 candidates = 64;         // as tpa_config_init sets
inline constexpr tpa::u32 stored_candidates = 48;  // as many of these come from the database at most

// Handles of the database between two to four loops. Refers to the loops.
class StoredChoice {
 public:
  explicit StoredChoice(const Loops& loops);
  bool tabled() const { return tpa::is_tabled(key_); }
  // Finds the shortest ones. Pre: tabled().
  void Rank();
  tpa::u32 count() const { return static_cast<tpa::u32>(ranked_.size()); }
  // Total length of the edges between loops, as rank_handles has it.
  double LengthOf(tpa::u32 i) const { return ranked_[i].length; }
  Faces Get(tpa::u32 i) const;

 private:
  tpa::SortedKey key_;
  tpa::u32 faces_ = 0, first_[tpa::max_handle_polygons + 1] = {};
  const tpa::Vec3* points_[tpa::max_handle_polygons] = {};
  std::vector<tpa::ChoiceScratch> scratch_;
  std::vector<tpa::RankedHandle> ranked_;
};

// The shortest handle of two loops; for three and four loops the shortest handle through a tree of short edges. Refers
// to the loops.
class MadeChoice {
 public:
  explicit MadeChoice(const Loops& loops);
  // Total length of the edges between loops; zero without any handle.
  double First();

 private:
  double FirstOfTwo();
  double FirstThroughTree();
  tpa::u8* Scratch() { return reinterpret_cast<tpa::u8*>(scratch_.data()); }
  tpa::u64 ScratchBytes() const { return 8 * scratch_.size(); }
  const Loops& loops_;
  std::vector<tpa::Vec3> points_;  // one loop behind the other
  std::vector<tpa::u32> numbers_, loop_of_, first_;
  std::vector<tpa::u64> scratch_;
};

}  // namespace figures
