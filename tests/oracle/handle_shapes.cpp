// SPDX-License-Identifier: MIT
// The plans, and the shapes of a family one by one (oracle/handle_oracle.h).
#include <algorithm>
#include <utility>

#include "oracle/handle_oracle.h"
#include "oracle/strip_words.h"

namespace handle_oracle {

using handle_lists::Face;
using handle_lists::Mu;

namespace {

// Round place 0 in its direction: the strips to 1, 2 and 3, or in the opposite order. Triangle i lacks place i.
Plan Tetrahedron(bool mirrored) {
  Plan plan{{0, 1, 2, 3}, false, {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}}};
  if (mirrored)
    for (PlanStrip& s : plan.strips) std::swap(s.from, s.to);
  return plan;
}

// Round place 0: strips to 1, 2, 1 and 3. This plan is its own mirror image. Triangles 2 and 3 are at place 2,
// triangles 0 and 1 at place 3.
Plan Row(std::vector<int> polygons) {
  return {
      std::move(polygons), true, {{0, 2, 2, 3}, {1, 2, 3, 2}, {0, 3, 0, 1}, {1, 3, 1, 0}, {0, 1, 1, 2}, {0, 1, 3, 0}}};
}

}  // namespace

std::vector<Plan> PlansOf(int k) {
  if (k == 2) return {};
  if (k == 3) return {{{0, 1, 2}, false, {{0, 1, 0, 1}, {1, 2, 0, 1}, {2, 0, 0, 1}}}};
  std::vector<Plan> plans = {Tetrahedron(false), Tetrahedron(true)};
  for (int a = 0; a < 4; ++a)
    for (int b = a + 1; b < 4; ++b) {
      std::vector<int> polygons{a, b};
      for (int c = 0; c < 4; ++c)
        if (c != a && c != b) polygons.push_back(c);
      plans.push_back(Row(polygons));
    }
  return plans;
}

int Unevenness(const Lengths& lengths) {
  int sum = 0;
  for (const auto& [p, q] : lengths) sum += (p + q) * (p + q);
  return sum;
}

namespace {

// Writes all words of all strips step by step on numbered vertices. Cuts off only if the vertices so far have too much
// excess; the criterion at the end judges consistency.
class Lister {
 public:
  Lister(const Family& family, const Sides& sides, int budget, const std::function<void(const Handle&)>& visit)
      : family_(family), strips_(family.plan->strips), sides_(sides), budget_(budget), visit_(visit) {
    int first = 0;
    std::vector<int> firsts;
    for (int side : sides) firsts.push_back(std::exchange(first, first + side));
    for (int polygon : family.plan->polygons) {
      first_.push_back(firsts[size_t(polygon)]);
      side_.push_back(sides[size_t(polygon)]);
    }
    edges_.assign(static_cast<size_t>(Mu(sides)), 0);
    PlaceCorners();
    PutInnerTriangles();
  }
  void Run() { Start(0, 0); }

 private:
  // One corner of each polygon is its vertex 0; the others follow along the strips.
  void PlaceCorners() {
    corner_.fill(-1);
    for (int place = 0; place < static_cast<int>(side_.size()); ++place)
      for (const PlanStrip& s : strips_)
        if (s.x == place || s.y == place) {
          corner_[size_t(s.Corner(place, false))] = 0;
          break;
        }
    for (size_t round = 0; round < 4; ++round)
      for (size_t i = 0; i < strips_.size(); ++i) {
        Follow(strips_[i].x, strips_[i], family_.lengths[i][0]);
        Follow(strips_[i].y, strips_[i], -family_.lengths[i][1]);
      }
  }
  void Follow(int place, const PlanStrip& s, int steps) {
    const int side = side_[size_t(place)];
    int& from = corner_[size_t(s.Corner(place, false))];
    int& to = corner_[size_t(s.Corner(place, true))];
    if (from >= 0 && to < 0) to = (from + steps + side) % side;
    if (to >= 0 && from < 0) from = (to - steps + side) % side;
  }
  int Vertex(int place, int position) const {
    const int side = side_[size_t(place)];
    return first_[size_t(place)] + (position % side + side) % side;
  }
  // A strip uses its edge from x to y at its end, and from y to x at its start.
  void PutInnerTriangles() {
    std::array<int, 16> next;
    next.fill(-1);
    for (const PlanStrip& s : strips_) {
      next[size_t(s.Corner(s.y, true))] = s.Corner(s.x, true);
      next[size_t(s.Corner(s.x, false))] = s.Corner(s.y, false);
    }
    for (int a = 0; a < 16; ++a) {
      if (next[size_t(a)] < 0) continue;
      const int b = next[size_t(a)], c = next[size_t(b)];
      if (a < b && a < c) faces_.push_back({At(a), At(b), At(c)});
    }
  }
  int At(int corner) const { return Vertex(corner / 4, corner_[size_t(corner)]); }

  void Start(size_t strip, int excess) {
    if (strip == strips_.size()) return Finish();
    Point(strip, 0, 0, excess);
  }
  // Puts the edge after i steps along x and j along y, and its possible continuations.
  void Point(size_t strip, int i, int j, int excess) {
    const PlanStrip& s = strips_[strip];
    const auto [p, q] = family_.lengths[strip];
    const int x = Vertex(s.x, corner_[size_t(s.Corner(s.x, false))] + i);
    const int y = Vertex(s.y, corner_[size_t(s.Corner(s.y, false))] - j);
    excess += AddEdge(x) + AddEdge(y);
    if (excess <= budget_) {
      if (i == p && j == q) Start(strip + 1, excess);
      if (i < p) Step({x, Vertex(s.x, x - first_[size_t(s.x)] + 1), y}, strip, i + 1, j, excess + Left(i > 0, x));
      if (j < q) Step({Vertex(s.y, y - first_[size_t(s.y)] - 1), y, x}, strip, i, j + 1, excess + Left(j > 0, y));
    }
    --edges_[size_t(x)];
    --edges_[size_t(y)];
  }
  void Step(Face face, size_t strip, int i, int j, int excess) {
    faces_.push_back(face);
    Point(strip, i, j, excess);
    faces_.pop_back();
  }
  // A vertex has one face more than edges. From four faces on, each face adds to its excess.
  int AddEdge(int v) {
    const int d = 1 + ++edges_[size_t(v)];
    return d > 4 ? strip_words::Excess(d) - strip_words::Excess(d - 1) : 0;
  }
  // A vertex in the middle of a strip is final when the word goes on.
  int Left(bool middle, int v) const { return middle && edges_[size_t(v)] == 1 ? strip_words::Excess(2) : 0; }

  void Finish() {
    const int sum = handle_lists::SumOfSquares(faces_, Mu(sides_));
    if (sum <= SumOfSquares(sides_, budget_) && handle_lists::WhyNotSphere(faces_, sides_).empty()) visit_(faces_);
  }

  const Family& family_;
  const std::vector<PlanStrip>& strips_;
  const Sides& sides_;
  int budget_;
  const std::function<void(const Handle&)>& visit_;
  std::vector<int> first_, side_;  // by place
  std::array<int, 16> corner_;     // positions on their polygons
  std::vector<int> edges_;
  Handle faces_;
};

}  // namespace

void ListShapes(const Family& family, const Sides& sides, int budget, const std::function<void(const Handle&)>& visit) {
  Lister(family, sides, budget, visit).Run();
}

}  // namespace handle_oracle
