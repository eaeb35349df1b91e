// handle_choice: the library's two ways to choose, with their scratch: the shortest handles of the database,
// and the shortest of all.
#pragma once

#include <vector>

#include "triangulate/candidates.h"
#include "triangulate/four_in_order.h"
#include "triangulate/rank_stored.h"
#include "triangulate/three_in_order.h"

namespace figures {

// Closed, in the directions in which a handle runs through them.
using Loops = std::vector<std::vector<tpa::Vec3>>;
using Faces = std::vector<tpa::HandleFace>;

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

// The shortest handle of all, of the database or not. Refers to the loops.
class WholeChoice {
 public:
  explicit WholeChoice(const Loops& loops);
  // Total length of its edges between loops; zero where the search did not come to its end within `work`
  // (triangulate/four_in_order.h). `limit` is the length of a handle that is known.
  double First(double limit, tpa::u64 work);

 private:
  double FirstOfTwo();
  double FirstOfThree(double limit, tpa::u64 work);
  double FirstOfFour(double limit, tpa::u64 work);
  const Loops& loops_;
  std::vector<tpa::u64> scratch_;
};

}  // namespace figures
