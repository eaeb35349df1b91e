// SPDX-License-Identifier: MIT
// strip_words: counts the words of a strip by what their neighbours see of them (oracle/handle_oracle.h).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace strip_words {

inline int Excess(int d) { return (d - 3) * (d - 4) / 2; }

enum Letter { kX, kY };  // a step along x, along y

// What the other strips see of a word: how far its first and its last run fan out from a corner. Positive for
// runs of y-steps (they fan out from x's corner), negative for x-steps. Words without x-steps or without
// y-steps are known by their lengths, and have zeros here.
struct WordClass {
  int first, last, excess;
  uint64_t words;
};

// Tables for excesses up to a budget, filled when asked for.
class Words {
 public:
  explicit Words(int budget) : budget_(budget) { FillMiddles(); }

  // Words with p x-steps and q y-steps, least excess first; whole[l]: the steps l lead once round their
  // polygon, so that an edge comes twice if no other step stands between them.
  const std::vector<WordClass>& Of(int p, int q, std::array<bool, 2> whole);
  // Sequences of runs with a x-steps and b y-steps, by first and last letter and excess.
  uint64_t& Middle(int a, int b, Letter first, Letter last, int excess) {
    return middle_[static_cast<size_t>((((a * side + b) * 2 + first) * 2 + last) * (budget_ + 1) + excess)];
  }

 private:
  static constexpr int side = 16;

  void FillMiddles();
  void FillMiddle(int a, int b, Letter first, Letter last);
  std::vector<WordClass> Classes(int p, int q, std::array<bool, 2> whole);

  int budget_;
  std::vector<uint64_t> middle_;
  std::array<std::unique_ptr<std::vector<WordClass>>, side * side * 4> tables_;
};

// Made once for each budget.
Words& WordsUpTo(int budget);

}  // namespace strip_words
