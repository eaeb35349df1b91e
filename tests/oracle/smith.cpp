// SPDX-License-Identifier: MIT
#include "oracle/smith.h"

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace smith {

namespace {

// a - b c
int64_t MinusProduct(int64_t a, int64_t b, int64_t c) {
  int64_t product, result;
  if (__builtin_mul_overflow(b, c, &product) || __builtin_sub_overflow(a, product, &result))
    throw std::overflow_error("an entry of a Smith normal form");
  return result;
}

// Takes away pivots +1 and -1 one by one. A unit pivot clears its column by operations on lines, then its line by
// operations on columns, without effect elsewhere: so both are simply dropped. Among the units of the shortest line,
// the pivot in the shortest column fills least.
class UnitElimination {
 public:
  UnitElimination(Matrix* lines, int columns) : lines_(*lines), column_(size_t(columns)), at_(lines->size()) {
    for (size_t i = 0; i < lines_.size(); ++i) {
      for (const Entry& e : lines_[i]) column_[size_t(e.column)].push_back(static_cast<int>(i));
      Enlist(static_cast<int>(i));
    }
  }
  int Run() {
    int units = 0;
    for (size_t size = 1; size < by_size_.size();) {
      if (by_size_[size].empty()) {
        ++size;
        continue;
      }
      const int line = by_size_[size].back();
      by_size_[size].pop_back();
      if (lines_[size_t(line)].size() != size || at_[size_t(line)] != size) continue;  // has changed since
      const Entry* unit = UnitOf(line);
      if (!unit) continue;  // listed again after a change
      size = Eliminate(line, *unit);
      ++units;
    }
    return units;
  }

 private:
  void Enlist(int line) {
    const size_t size = lines_[size_t(line)].size();
    if (by_size_.size() <= size) by_size_.resize(size + 1);
    by_size_[size].push_back(line);
    at_[size_t(line)] = size;
  }
  const Entry* UnitOf(int line) const {
    const Entry* best = nullptr;
    for (const Entry& e : lines_[size_t(line)])
      if (std::abs(e.value) == 1 && (!best || column_[size_t(e.column)].size() < column_[size_t(best->column)].size()))
        best = &e;
    return best;
  }
  // Returns the length of the shortest changed line, or of the pivot's line if shorter.
  size_t Eliminate(int pivot, Entry unit) {
    std::vector<Entry> line;
    std::swap(line, lines_[size_t(pivot)]);
    for (const Entry& e : line) Forget(e.column, pivot);
    std::vector<int> others;
    std::swap(others, column_[size_t(unit.column)]);
    size_t shortest = line.size();
    for (int other : others) {
      Subtract(other, line, unit);
      Enlist(other);
      shortest = std::min(shortest, lines_[size_t(other)].size());
    }
    return shortest;
  }
  void Forget(int column, int line) {
    std::vector<int>& c = column_[size_t(column)];
    c.erase(std::find(c.begin(), c.end(), line));
  }
  // lines[to] -= factor * line, so that the pivot's column vanishes. The list of the pivot's column is up to date
  // already.
  void Subtract(int to, const std::vector<Entry>& line, Entry unit) {
    std::vector<Entry>& target = lines_[size_t(to)];
    int64_t factor = 0;
    for (const Entry& e : target)
      if (e.column == unit.column) factor = e.value * unit.value;
    merged_.clear();
    size_t i = 0, j = 0;
    while (i < target.size() || j < line.size()) {
      const int a = i < target.size() ? target[i].column : INT32_MAX;
      const int b = j < line.size() ? line[j].column : INT32_MAX;
      const int column = std::min(a, b);
      const int64_t old = a == column ? target[i++].value : 0;
      const int64_t value = MinusProduct(old, factor, b == column ? line[j++].value : 0);
      if (value != 0) merged_.push_back({column, value});
      if (column == unit.column) continue;
      if (old == 0 && value != 0) column_[size_t(column)].push_back(to);
      if (old != 0 && value == 0) Forget(column, to);
    }
    std::swap(target, merged_);
  }

  Matrix& lines_;
  std::vector<std::vector<int>> column_;  // the lines with an entry in the column
  std::vector<std::vector<int>> by_size_;
  std::vector<size_t> at_;  // size under which a line is listed
  std::vector<Entry> merged_;
};

using Dense = std::vector<std::vector<int64_t>>;

// Moves the least entry from t on to (t, t). False if all are zero.
bool PivotLeast(Dense* m, size_t t) {
  size_t r = t, c = t;
  int64_t best = 0;
  for (size_t i = t; i < m->size(); ++i)
    for (size_t j = t; j < (*m)[i].size(); ++j) {
      const int64_t size = std::abs((*m)[i][j]);
      if (size != 0 && (best == 0 || size < best)) best = size, r = i, c = j;
    }
  if (best == 0) return false;
  std::swap((*m)[t], (*m)[r]);
  for (auto& row : *m) std::swap(row[t], row[c]);
  return true;
}

// Division with remainder along the pivot's row and column. True if nothing but the pivot is left in them.
bool ClearCross(Dense* m, size_t t) {
  bool clean = true;
  for (size_t i = t + 1; i < m->size(); ++i) {
    const int64_t by = (*m)[i][t] / (*m)[t][t];
    for (size_t j = t; j < (*m)[i].size(); ++j) (*m)[i][j] = MinusProduct((*m)[i][j], by, (*m)[t][j]);
    clean = clean && (*m)[i][t] == 0;
  }
  for (size_t j = t + 1; j < (*m)[t].size(); ++j) {
    const int64_t by = (*m)[t][j] / (*m)[t][t];
    for (size_t i = t; i < m->size(); ++i) (*m)[i][j] = MinusProduct((*m)[i][j], by, (*m)[i][t]);
    clean = clean && (*m)[t][j] == 0;
  }
  return clean;
}

std::vector<int64_t> Diagonal(Dense m) {
  std::vector<int64_t> diagonal;
  for (size_t t = 0; !m.empty() && t < std::min(m.size(), m[0].size()); ++t) {
    do {
      if (!PivotLeast(&m, t)) return diagonal;
    } while (!ClearCross(&m, t));
    diagonal.push_back(std::abs(m[t][t]));
  }
  return diagonal;
}

Dense Densified(const Matrix& lines, int columns) {
  Dense dense;
  for (const auto& line : lines) {
    if (line.empty()) continue;
    dense.emplace_back(static_cast<size_t>(columns));
    for (const Entry& e : line) dense.back()[size_t(e.column)] = e.value;
  }
  return dense;
}

}  // namespace

std::vector<int64_t> ElementaryDivisors(Matrix m, int columns) {
  const int units = UnitElimination(&m, columns).Run();
  std::vector<int64_t> rest = Diagonal(Densified(m, columns));
  // Z/a + Z/b = Z/gcd + Z/lcm.
  for (size_t i = 0; i < rest.size(); ++i)
    for (size_t j = i + 1; j < rest.size(); ++j) {
      const int64_t gcd = std::gcd(rest[i], rest[j]);
      rest[j] = -MinusProduct(0, rest[i] / gcd, rest[j]);
      rest[i] = gcd;
    }
  rest.insert(rest.begin(), static_cast<size_t>(units), 1);
  return rest;
}

Homology HomologyOf(const std::vector<std::array<int, 3>>& faces, int vertices) {
  // Boundaries of edges in terms of vertices, and (as lines again) coboundaries of edges in terms of faces: a
  // transposed matrix has the same divisors.
  std::vector<int> number(static_cast<size_t>(vertices) * static_cast<size_t>(vertices), -1);
  Matrix ends, sides;
  for (size_t f = 0; f < faces.size(); ++f)
    for (size_t c = 0; c < 3; ++c) {
      const int a = faces[f][c], b = faces[f][(c + 1) % 3];
      int& edge = number[static_cast<size_t>(std::min(a, b) * vertices + std::max(a, b))];
      if (edge < 0) {
        edge = static_cast<int>(ends.size());
        ends.push_back({{std::min(a, b), -1}, {std::max(a, b), 1}});
        sides.emplace_back();
      }
      sides[size_t(edge)].push_back({static_cast<int>(f), a < b ? 1 : -1});
    }
  const int edges = static_cast<int>(ends.size()), count = static_cast<int>(faces.size());
  const std::array<std::vector<int64_t>, 2> divisors{ElementaryDivisors(std::move(ends), vertices),
                                                     ElementaryDivisors(std::move(sides), count)};
  const int rank1 = static_cast<int>(divisors[0].size()), rank2 = static_cast<int>(divisors[1].size());
  Homology h{{vertices - rank1, edges - rank1 - rank2, count - rank2}, {}};
  for (size_t i = 0; i < 2; ++i)
    for (int64_t d : divisors[i])
      if (d != 1) h.torsion[i].push_back(d);
  return h;
}

}  // namespace smith
