// SPDX-License-Identifier: MIT
#include "oracle/handle_oracle.h"

#include <algorithm>
#include <map>
#include <utility>

#include "oracle/strip_words.h"

namespace handle_oracle {

namespace {

using strip_words::Excess;

// ---------------------------------------------------------------- corners

// Corners of inner triangles become one vertex if a strip between them has no step along their polygon.
struct Corners {
  std::array<int8_t, 16> joined,
      missing;                // the vertex of a corner; strips' ends that a vertex still waits for
  std::array<bool, 16> used;  // place 3 has no triangle 3

  explicit Corners(const Plan& plan) {
    missing.fill(0);
    for (int c = 0; c < 16; ++c) joined[size_t(c)] = static_cast<int8_t>(c);
    for (const PlanStrip& s : plan.strips)
      for (int polygon : {s.x, s.y})
        for (bool end : {false, true}) ++missing[size_t(s.Corner(polygon, end))];
    for (size_t c = 0; c < 16; ++c) used[c] = missing[c] > 0;
  }
  int At(int corner) const { return joined[size_t(corner)]; }
  bool IsFinished(int corner) const { return used[size_t(corner)] && At(corner) == corner && !missing[size_t(corner)]; }
  void Join(int a, int b) {
    if (a == b) return;
    missing[size_t(a)] = static_cast<int8_t>(missing[size_t(a)] + missing[size_t(b)]);
    missing[size_t(b)] = 0;
    std::replace(joined.begin(), joined.end(), static_cast<int8_t>(b), static_cast<int8_t>(a));
  }
};

// The edges that a strip has at a vertex of the plan.
struct Fan {
  int vertex, edges;
};

// Vertices at the ends of one strip, in corners joined already.
class Ends {
 public:
  Ends(const PlanStrip& strip, std::array<int, 2> lengths, Corners* corners) : lengths_(lengths) {
    for (size_t i = 0; i < 2; ++i) {
      const int polygon = i == 0 ? strip.x : strip.y;
      for (size_t end = 0; end < 2; ++end) at_[i][end] = corners->At(strip.Corner(polygon, end));
    }
  }
  bool Joins(size_t i) const { return lengths_[i] == 0 && at_[i][0] != at_[i][1]; }
  int At(size_t i, size_t end) const { return at_[i][end]; }
  // A polygon without a step has all edges of the strip at its one vertex.
  int Fans(const strip_words::WordClass& word, std::array<Fan, 4>* fans) const {
    size_t n = 0;
    for (size_t i = 0; i < 2; ++i) {
      const int sign = i == 0 ? 1 : -1;
      if (lengths_[i] == 0) {
        (*fans)[n++] = {at_[i][0], lengths_[1 - i] + 1};
      } else {
        (*fans)[n++] = {at_[i][0], 1 + std::max(0, sign * word.first)};
        (*fans)[n++] = {at_[i][1], 1 + std::max(0, sign * word.last)};
      }
    }
    return static_cast<int>(n);
  }

 private:
  std::array<int, 2> lengths_;
  std::array<std::array<int, 2>, 2> at_;
};

// ---------------------------------------------------------------- double strips

// Two strips between the same polygons touch where a strip beside them has no step along one of these polygons.
// Touching along both polygons at the same end repeats an edge. Touching along x at one end and along y at the other
// end repeats an edge if each strip goes all along the one polygon first.
enum class Touch { kNot, kEdge, kXThenY, kYThenX };

Touch TouchOf(const Plan& plan, const Lengths& l) {
  if (!plan.row) return Touch::kNot;
  // Strips 0 and 1 lie between the end of strip 4 and the start of strip 5, strips 2 and 3 on the other side.
  const bool x_here = l[0][0] == 0, y_here = l[1][0] == 0, x_there = l[2][0] == 0, y_there = l[3][0] == 0;
  if ((x_here && y_here) || (x_there && y_there)) return Touch::kEdge;
  if (x_here && y_there) return Touch::kXThenY;
  return x_there && y_here ? Touch::kYThenX : Touch::kNot;
}

// Does a word take all steps along one polygon, then all along the other?
bool IsTwoRuns(const strip_words::WordClass& word, std::array<int, 2> lengths, bool x_first) {
  if (lengths[0] == 0 || lengths[1] == 0) return true;
  return word.first == (x_first ? -lengths[0] : lengths[1]);
}

bool MakesDoubleEdge(Touch touch, size_t strip, const strip_words::WordClass& word, std::array<int, 2> lengths) {
  if (touch != Touch::kXThenY && touch != Touch::kYThenX) return false;
  return IsTwoRuns(word, lengths, (touch == Touch::kXThenY) == (strip == 4));
}

// ---------------------------------------------------------------- putting strips in

// Edges at each unfinished vertex in four bits; above them, whether strip 4 is a half of a double edge.
using Partial = std::pair<uint64_t, int>;  // and the excess so far
using Partials = std::vector<std::pair<Partial, uint64_t>>;
constexpr int flag_bit = 62;

// Vertices by four bits: 15 of them, polygon 3 has no triangle 3.
static_assert(4 * 15 <= flag_bit);

int EdgesAt(uint64_t state, int vertex) { return static_cast<int>(state >> (4 * vertex) & 15); }

void Merge(Partials* partials) {
  std::sort(partials->begin(), partials->end());
  size_t n = 0;
  for (size_t i = 0; i < partials->size(); ++i) {
    if (n > 0 && (*partials)[n - 1].first == (*partials)[i].first)
      (*partials)[n - 1].second += (*partials)[i].second;
    else
      (*partials)[n++] = (*partials)[i];
  }
  partials->resize(n);
}

// The least excess still to come after some strips. Unfinished vertices share a known number of faces; vertices of the
// longest polygon can have only so many of them. An even spread costs least.
class Outlook {
 public:
  Outlook(const Plan& plan, const Sides& sides, size_t strips_in, const Lengths& lengths, const Corners& corners) {
    longest_ = static_cast<int>(std::max_element(sides.begin(), sides.end()) - sides.begin());
    std::array<int, 4> rest{}, unfinished{};
    std::array<bool, 4> beside{};
    for (size_t i = 0; i < sides.size(); ++i) {
      rest[i] = unfinished[i] = sides[i];
      for (int c = 4 * static_cast<int>(i); c < 4 * static_cast<int>(i) + 4; ++c)
        if (corners.IsFinished(c)) --unfinished[i];
    }
    for (size_t i = 0; i < plan.strips.size(); ++i) {
      const PlanStrip& s = plan.strips[i];
      const bool at_longest = s.x == longest_ || s.y == longest_;
      if (i >= strips_in) {
        strips_ += 1, strips_at_longest_ += at_longest;
        if (at_longest) beside[size_t(s.x == longest_ ? s.y : s.x)] = true;
        continue;
      }
      for (size_t side = 0; side < 2; ++side) {
        const size_t place = static_cast<size_t>(side == 0 ? s.x : s.y);
        rest[place] -= lengths[i][side];
        unfinished[place] -= std::max(0, lengths[i][side] - 1);
      }
    }
    for (size_t i = 0; i < sides.size(); ++i) {
      all_rest_ += rest[i], all_unfinished_ += unfinished[i];
      if (beside[i]) beside_ += rest[i];
    }
    rest_ = rest[size_t(longest_)], unfinished_ = unfinished[size_t(longest_)];
  }
  // Given the edges so far at unfinished vertices.
  int LeastExcess(uint64_t state) {
    const int all = Sum(state), mine = Sum(state >> (16 * longest_) & 0xffff);
    for (const auto& [key, value] : known_)
      if (key == std::pair(mine, all)) return value;
    int least = max_excess + 1;
    const int faces = all_unfinished_ + all + 2 * (all_rest_ + strips_);
    for (int q = 0; q <= beside_; ++q) {
      const int my_faces = unfinished_ + mine + rest_ + strips_at_longest_ + q;
      least = std::min(least, Even(unfinished_, my_faces) + Even(all_unfinished_ - unfinished_, faces - my_faces));
    }
    known_.push_back({{mine, all}, least});
    return least;
  }

 private:
  static int Sum(uint64_t state) {
    int sum = 0;
    for (; state != 0; state >>= 4) sum += static_cast<int>(state & 15);
    return sum;
  }
  static int Even(int vertices, int faces) {
    if (vertices == 0) return faces == 0 ? 0 : max_excess + 1;
    const int d = faces / vertices, more = faces % vertices;
    return (vertices - more) * Excess(d) + more * Excess(d + 1);
  }

  int longest_, rest_ = 0, unfinished_ = 0, beside_ = 0, strips_at_longest_ = 0;
  int all_rest_ = 0, all_unfinished_ = 0, strips_ = 0;
  std::vector<std::pair<std::pair<int, int>, int>> known_;  // few
};

class Sweep {
 public:
  // Sides by the plan's places.
  Sweep(const Plan& plan, const Sides& sides, int budget, std::vector<Family>* families)
      : plan_(plan), sides_(sides), budget_(budget), words_(strip_words::WordsUpTo(budget)), families_(families) {
    lengths_.resize(plan.strips.size());
  }
  void Run() { Put(0, Corners(plan_), sides_, {{{0, 0}, 1}}); }

 private:
  void Put(size_t strip, const Corners& corners, const Sides& rest, const Partials& partials) {
    if (strip == plan_.strips.size()) return Finish(partials);
    if (!IsFeasible(strip, rest, budget_ - Least(partials))) return;
    const PlanStrip& s = plan_.strips[strip];
    const int p_from = Needed(strip, s.x, rest), q_from = Needed(strip, s.y, rest);
    for (int p = p_from; p <= rest[size_t(s.x)]; ++p)
      for (int q = q_from; q <= rest[size_t(s.y)]; ++q) {
        lengths_[strip] = {p, q};
        Sides left = rest;
        left[size_t(s.x)] -= p;
        left[size_t(s.y)] -= q;
        Corners next = corners;
        const Partials extended = Extended(strip, &next, partials);
        if (!extended.empty()) Put(strip + 1, next, left, extended);
      }
  }
  // The last strip of a polygon takes the rest.
  int Needed(size_t strip, int polygon, const Sides& rest) const {
    for (size_t i = strip + 1; i < plan_.strips.size(); ++i)
      if (plan_.strips[i].x == polygon || plan_.strips[i].y == polygon) return 0;
    return rest[size_t(polygon)];
  }
  // A strip with excess e has lengths that differ by e + 1 at most: its longer kind of steps has at most one
  // run more than there are other steps. So polygons' rests are bounded by those of their neighbours.
  bool IsFeasible(size_t strip, const Sides& rest, int spare) const {
    for (size_t polygon = 0; polygon < rest.size(); ++polygon) {
      int strips = 0, mine = 0, others = 0;
      std::array<bool, 4> neighbour{};
      for (size_t i = strip; i < plan_.strips.size(); ++i, ++strips) {
        const PlanStrip& s = plan_.strips[i];
        const bool is_x = s.x == static_cast<int>(polygon), is_y = s.y == static_cast<int>(polygon);
        mine += is_x || is_y;
        if (is_x || is_y) neighbour[size_t(is_x ? s.y : s.x)] = true;
      }
      for (size_t i = 0; i < rest.size(); ++i) others += neighbour[i] ? rest[i] : 0;
      if (rest[polygon] > others + mine + spare) return false;
      if (mine == strips && others > rest[polygon] + mine + spare) return false;
    }
    return true;
  }
  static int Least(const Partials& partials) {
    int least = max_excess;
    for (const auto& [partial, count] : partials) least = std::min(least, partial.second);
    return least;
  }

  Partials Extended(size_t strip, Corners* corners, const Partials& partials) {
    const PlanStrip& s = plan_.strips[strip];
    const auto [p, q] = lengths_[strip];
    const auto& words = words_.Of(p, q, {p == sides_[size_t(s.x)], q == sides_[size_t(s.y)]});
    if (words.empty()) return {};
    const Touch touch = strip >= 4 ? TouchOf(plan_, lengths_) : Touch::kNot;
    if (touch == Touch::kEdge) return {};
    std::array<std::array<int, 2>, 2> joins{};
    const Ends before(s, lengths_[strip], corners);
    for (size_t i = 0; i < 2; ++i) {
      if (before.Joins(i)) joins[i] = {before.At(i, 0), before.At(i, 1)};
      corners->Join(joins[i][0], joins[i][1]);
    }
    const Ends ends(s, lengths_[strip], corners);
    for (size_t i = 0; i < 2; ++i)
      for (size_t end = 0; end < 2; ++end) --corners->missing[size_t(ends.At(i, end))];
    Outlook outlook(plan_, sides_, strip + 1, lengths_, *corners);
    Partials result;
    for (const auto& [partial, count] : partials) {
      Partial start = partial;
      if (!Joined(joins, &start)) continue;
      for (const strip_words::WordClass& word : words) {
        if (start.second + word.excess > budget_) break;
        Partial next = start;
        if (MakesDoubleEdge(touch, strip, word, lengths_[strip])) {
          if (next.first >> flag_bit) continue;
          next.first |= uint64_t{1} << flag_bit;
        }
        next.second += word.excess;
        if (!Added(ends, word, *corners, &next)) continue;
        const uint64_t edges = next.first & ~(uint64_t{1} << flag_bit);
        if (next.second + outlook.LeastExcess(edges) <= budget_) result.push_back({next, count * word.words});
      }
    }
    Merge(&result);
    return result;
  }
  bool Joined(const std::array<std::array<int, 2>, 2>& joins, Partial* partial) const {
    for (const auto& [into, from] : joins) {
      if (into == from) continue;
      const int edges = EdgesAt(partial->first, into) + EdgesAt(partial->first, from);
      if (TooMany(edges, *partial)) return false;
      const uint64_t cleared = partial->first & ~(uint64_t{15} << (4 * into)) & ~(uint64_t{15} << (4 * from));
      partial->first = cleared | static_cast<uint64_t>(edges) << (4 * into);
    }
    return true;
  }
  // A vertex has one face more than edges of strips. Four bits hold what max_excess allows.
  bool TooMany(int edges, const Partial& partial) const {
    return edges >= 3 && partial.second + Excess(edges + 1) > budget_;
  }
  bool Added(const Ends& ends, const strip_words::WordClass& word, const Corners& corners, Partial* partial) const {
    std::array<Fan, 4> fans;
    const int n = ends.Fans(word, &fans);
    for (int i = 0; i < n; ++i) {
      const auto [vertex, more] = fans[size_t(i)];
      const int edges = EdgesAt(partial->first, vertex) + more;
      if (TooMany(edges, *partial)) return false;
      partial->first += static_cast<uint64_t>(more) << (4 * vertex);
    }
    for (int i = 0; i < n; ++i) {
      const int vertex = fans[size_t(i)].vertex, edges = EdgesAt(partial->first, vertex);
      if (corners.missing[size_t(vertex)] > 0 || edges == 0) continue;  // not finished, or counted by another end
      partial->second += Excess(edges + 1);
      partial->first &= ~(uint64_t{15} << (4 * vertex));
    }
    return partial->second <= budget_;
  }
  void Finish(const Partials& partials) {
    if (partials.empty()) return;
    Family family{&plan_, lengths_, std::vector<uint64_t>(static_cast<size_t>(budget_) + 1)};
    for (const auto& [partial, count] : partials) family.shapes[size_t(partial.second)] += count;
    families_->push_back(std::move(family));
  }

  const Plan& plan_;
  const Sides& sides_;
  int budget_;
  strip_words::Words& words_;
  Lengths lengths_;
  std::vector<Family>* families_;
};

}  // namespace

std::vector<Family> FamiliesUpTo(const std::vector<Plan>& plans, const Sides& sides, int budget) {
  std::vector<Family> families;
  // Mirror images, and plans that differ by an exchange of equal polygons, have the same lengths and counts.
  std::map<std::pair<bool, Sides>, std::vector<Family>> known;
  for (const Plan& plan : plans) {
    Sides by_place;
    for (int polygon : plan.polygons) by_place.push_back(sides[size_t(polygon)]);
    const auto [place, is_new] = known.try_emplace({plan.row, by_place});
    if (is_new) Sweep(plan, by_place, budget, &place->second).Run();
    for (Family family : place->second) {
      family.plan = &plan;
      families.push_back(std::move(family));
    }
  }
  return families;
}

// Every closed strip enters each vertex of the first polygon, x, by one step. So it enters vertex 0 at one of the
// vertices of y, in a run of n steps at one of n places. The runs before and after are runs along y, as words go round.
// With only one run of each kind an edge would come twice.
std::vector<uint64_t> PairsUpTo(const Sides& sides, int budget) {
  strip_words::Words& words = strip_words::WordsUpTo(budget);
  std::vector<uint64_t> handles(static_cast<size_t>(budget) + 1);
  for (int n = 1; n < sides[0]; ++n)
    for (int e = n * (n - 1) / 2; e <= budget; ++e)
      handles[size_t(e)] += static_cast<uint64_t>(sides[1] * n) *
                            words.Middle(sides[0] - n, sides[1], strip_words::kY, strip_words::kY, e - n * (n - 1) / 2);
  return handles;
}

// Rotations change every shape of three or four polygons: they move its inner triangles.
uint64_t Rotations(const Sides& sides) {
  uint64_t rotations = 1;
  for (int side : sides) rotations *= static_cast<uint64_t>(side);
  return rotations;
}

Minimum MinimumOf(const std::vector<Plan>& plans, const Sides& sides) {
  Minimum m;
  while (m.handles == 0 && m.excess < max_excess) {
    ++m.excess;
    if (sides.size() == 2) {
      m.handles = PairsUpTo(sides, m.excess).back();
      continue;
    }
    for (Family& family : FamiliesUpTo(plans, sides, m.excess)) {
      if (family.shapes.back() == 0) continue;
      m.shapes += family.shapes.back();
      m.families.push_back(std::move(family));
    }
    m.handles = m.shapes * Rotations(sides);
  }
  return m;
}

// d (d - 7) + 12 is twice the excess of a vertex, and the sum of d is three times the faces.
int SumOfSquares(const Sides& sides, int excess) {
  const int mu = handle_lists::Mu(sides), faces = mu + 2 * static_cast<int>(sides.size()) - 4;
  return 2 * excess + 21 * faces - 12 * mu;
}

}  // namespace handle_oracle
