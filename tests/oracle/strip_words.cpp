// SPDX-License-Identifier: MIT
#include "oracle/strip_words.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace strip_words {

const std::vector<WordClass>& Words::Of(int p, int q, std::array<bool, 2> whole) {
  auto& table = tables_[static_cast<size_t>(((p * side + q) * 2 + whole[kX]) * 2 + whole[kY])];
  if (!table) table = std::make_unique<std::vector<WordClass>>(Classes(p, q, whole));
  return *table;
}

void Words::FillMiddles() {
  middle_.assign(static_cast<size_t>(side * side * 4 * (budget_ + 1)), 0);
  for (int a = 0; a < side; ++a)
    for (int b = 0; b < side; ++b)
      for (Letter first : {kX, kY})
        for (Letter last : {kX, kY}) FillMiddle(a, b, first, last);
}

void Words::FillMiddle(int a, int b, Letter first, Letter last) {
  const Letter before = last == kX ? kY : kX;
  for (int n = 1; n <= (last == kX ? a : b); ++n) {
    const int excess = n * (n - 1) / 2, a0 = last == kX ? a - n : a, b0 = last == kX ? b : b - n;
    if (a0 == 0 && b0 == 0 && first == last && excess <= budget_) ++Middle(a, b, first, last, excess);
    for (int e = excess; e <= budget_; ++e) Middle(a, b, first, last, e) += Middle(a0, b0, first, before, e - excess);
  }
}

namespace {

// The words that start with m and end with n steps of given letters: what is left for their middle.
struct Frame {
  Letter first, last;
  int m, n, a, b;

  // All x-steps are one run: at an end, or alone in the middle.
  bool XIsOneRun(int p) const {
    return (first == kX && m == p) || (last == kX && n == p) || (first == kY && last == kY && b == 0);
  }
  bool YIsOneRun(int q) const {
    return (first == kY && m == q) || (last == kY && n == q) || (first == kX && last == kX && a == 0);
  }
};

// Of words whose first and last runs are two different ones.
std::vector<Frame> FramesOf(int p, int q) {
  std::vector<Frame> frames;
  for (Letter first : {kX, kY})
    for (Letter last : {kX, kY})
      for (int m = 1; m <= (first == kX ? p : q); ++m)
        for (int n = 1; n <= (last == kX ? p : q); ++n) {
          const int a = p - (first == kX ? m : 0) - (last == kX ? n : 0);
          const int b = q - (first == kY ? m : 0) - (last == kY ? n : 0);
          if (a >= 0 && b >= 0) frames.push_back({first, last, m, n, a, b});
        }
  return frames;
}

}  // namespace

std::vector<WordClass> Words::Classes(int p, int q, std::array<bool, 2> whole) {
  std::map<std::tuple<int, int, int>, uint64_t> found;  // excess, first, last
  const auto add = [&](int excess, int first, int last, uint64_t words) {
    if (excess <= budget_ && words > 0) found[{excess, first, last}] += words;
  };
  // Once round both polygons ends at the edge where it began.
  if (whole[kX] && whole[kY]) return {};
  if ((p == 0 || q == 0) && !whole[p == 0 ? kY : kX]) add(std::max(0, p + q - 1), 0, 0, 1);
  if (p > 0 && q > 0) {
    for (const Frame& f : FramesOf(p, q)) {
      if ((whole[kX] && f.XIsOneRun(p)) || (whole[kY] && f.YIsOneRun(q))) continue;
      const int ends = f.m - 1 + f.n - 1, i = f.first == kY ? f.m : -f.m, j = f.last == kY ? f.n : -f.n;
      if (f.a == 0 && f.b == 0 && f.first != f.last) add(ends, i, j, 1);
      for (int e = 0; e + ends <= budget_; ++e)
        add(e + ends, i, j, Middle(f.a, f.b, f.first == kX ? kY : kX, f.last == kX ? kY : kX, e));
    }
  }
  std::vector<WordClass> classes;
  for (const auto& [key, words] : found)
    classes.push_back({std::get<1>(key), std::get<2>(key), std::get<0>(key), words});
  return classes;
}

Words& WordsUpTo(int budget) {
  static std::map<int, Words> words;
  return words.try_emplace(budget, budget).first->second;
}

}  // namespace strip_words
