// SPDX-License-Identifier: MIT
#include "oracle/handle_lists.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace handle_lists {

// ---------------------------------------------------------------- keys

int Mu(const Sides& sides) { return std::accumulate(sides.begin(), sides.end(), 0); }

std::string Name(const Sides& sides) {
  std::string s = "(";
  for (int side : sides) s += std::to_string(side) + " ";
  s.back() = ')';
  return s;
}

std::vector<Sides> Keys(int k, int largest_sum, int largest_side) {
  std::vector<Sides> keys;
  Sides sides(size_t(k), 3);
  for (;;) {
    if (Mu(sides) <= largest_sum) keys.push_back(sides);
    size_t i = size_t(k);
    while (i > 0 && sides[i - 1] == (i == 1 ? largest_side : sides[i - 2])) --i;
    if (i == 0) return keys;
    ++sides[i - 1];
    std::fill(sides.begin() + static_cast<long>(i), sides.end(), 3);
  }
}

Polygons PolygonsOf(const Sides& sides) {
  Polygons p;
  int first = 0;
  for (size_t i = 0; i < sides.size(); ++i) {
    for (int v = 0; v < sides[i]; ++v) {
      p.next.push_back(first + (v + 1) % sides[i]);
      p.of.push_back(static_cast<int>(i));
    }
    first += sides[i];
  }
  return p;
}

// ---------------------------------------------------------------- handles

Face Normal(Face f) {
  std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
  return f;
}

Handle Normal(Handle h) {
  for (Face& f : h) f = Normal(f);
  std::sort(h.begin(), h.end());
  return h;
}

std::string Print(const Handle& h) {
  std::string s;
  for (const Face& f : h) {
    s += "(" + std::to_string(f[0] + 1) + "," + std::to_string(f[1] + 1) + "," + std::to_string(f[2] + 1) + ") ";
  }
  return s;
}

int SumOfSquares(const Handle& h, int mu) {
  std::vector<int> d(static_cast<size_t>(mu));
  for (const Face& f : h)
    for (int v : f) ++d[static_cast<size_t>(v)];
  return std::inner_product(d.begin(), d.end(), d.begin(), 0);
}

bool HasChord(const Handle& h, const Sides& sides) {
  const Polygons p = PolygonsOf(sides);
  for (const Face& f : h)
    for (size_t c = 0; c < 3; ++c) {
      const int a = f[c], b = f[(c + 1) % 3];
      if (p.of[size_t(a)] == p.of[size_t(b)] && p.next[size_t(a)] != b && p.next[size_t(b)] != a) return true;
    }
  return false;
}

Handle WithCaps(const Handle& h, const Sides& sides) {
  const int mu = Mu(sides);
  const Polygons p = PolygonsOf(sides);
  Handle all = h;
  for (int v = 0; v < mu; ++v) all.push_back({p.next[size_t(v)], v, mu + p.of[size_t(v)]});
  return all;
}

namespace {

// A link of simple polygons has one successor for each of its vertices.
bool IsOneSimplePolygon(const std::map<int, int>& link) {
  int at = link.begin()->first;
  size_t steps = 0;
  do {
    const auto it = link.find(at);
    if (it == link.end()) return false;
    at = it->second, ++steps;
  } while (at != link.begin()->first && steps <= link.size());
  return steps == link.size();
}

bool IsConnected(const std::vector<std::map<int, int>>& link) {
  std::vector<int> seen(link.size()), stack{0};
  seen[0] = 1;
  while (!stack.empty()) {
    const int v = stack.back();
    stack.pop_back();
    for (const auto& [w, unused] : link[size_t(v)])
      if (!seen[size_t(w)]++) stack.push_back(w);
  }
  return std::count(seen.begin(), seen.end(), 0) == 0;
}

}  // namespace

std::string WhyNotSphere(const Handle& handle, const Sides& sides, int genus) {
  const int mu = Mu(sides), k = static_cast<int>(sides.size());
  if (static_cast<int>(handle.size()) != mu + 2 * k - 4 + 4 * genus) return "number of faces";
  const Handle all = WithCaps(handle, sides);
  std::vector<std::map<int, int>> link(size_t(mu + k));
  std::set<std::pair<int, int>> edges;
  for (const Face& f : all)
    for (int c = 0; c < 3; ++c) {
      const int a = f[size_t(c)], b = f[size_t((c + 1) % 3)], d = f[size_t((c + 2) % 3)];
      if (a < 0 || a >= mu + k || a == b) return "a corner";
      if (!link[size_t(a)].emplace(b, d).second) return "an edge twice in one direction";
      edges.insert({std::min(a, b), std::max(a, b)});
    }
  for (const auto& l : link) {
    if (l.size() < 3) return "a vertex with two faces";
    if (!IsOneSimplePolygon(l)) return "a link that is open, or of several polygons";
  }
  if (!IsConnected(link)) return "several components";
  if (mu + k - static_cast<int>(edges.size()) + static_cast<int>(all.size()) != 2 - 2 * genus) return "Euler number";
  return "";
}

// ---------------------------------------------------------------- symmetry

namespace {

constexpr int none = 255;

// Faces by their directed edges, and a walk over them.
class Walker {
 public:
  Walker(const Handle& h, int mu) : mu_(mu), apex_(size_t(mu * mu), none) {
    for (const Face& f : h)
      for (size_t c = 0; c < 3; ++c) apex_[At(f[c], f[(c + 1) % 3])] = static_cast<uint8_t>(f[(c + 2) % 3]);
  }
  // Breadth first from a face across its edges. What is written down tells the faces again, vertices numbered
  // as they are met.
  void Walk(int a, int b, std::vector<uint8_t>* code) {
    code->clear(), edges_.clear();
    done_.assign(apex_.size(), 0), number_.assign(size_t(mu_), none);
    met_ = 0;
    NumberOf(a), NumberOf(b);
    edges_.push_back({a, b});
    for (size_t i = 0; i < edges_.size(); ++i) {
      const auto [u, v] = edges_[i];
      const int c = apex_[At(u, v)];
      if (c == none || done_[At(u, v)]) {
        code->push_back(none);
        continue;
      }
      done_[At(u, v)] = done_[At(v, c)] = done_[At(c, u)] = 1;
      code->push_back(NumberOf(c));
      edges_.push_back({c, v});
      edges_.push_back({u, c});
    }
  }

 private:
  size_t At(int a, int b) const { return static_cast<size_t>(a * mu_ + b); }
  uint8_t NumberOf(int v) {
    if (number_[size_t(v)] == none) number_[size_t(v)] = static_cast<uint8_t>(met_++);
    return number_[size_t(v)];
  }

  int mu_, met_ = 0;
  std::vector<uint8_t> apex_, number_;
  std::vector<char> done_;
  std::vector<std::pair<int, int>> edges_;
};

// The side with the fewest vertices on its polygons together: an equivalence keeps them.
int RarestSide(const Sides& sides) {
  const auto vertices = [&](int side) { return side * std::count(sides.begin(), sides.end(), side); };
  return *std::min_element(sides.begin(), sides.end(),
                           [&](int a, int b) { return std::pair(vertices(a), a) < std::pair(vertices(b), b); });
}

}  // namespace

Symmetry SymmetryOf(const Handle& h, const Sides& sides) {
  const Polygons p = PolygonsOf(sides);
  const int side = RarestSide(sides), mu = Mu(sides);
  Walker walker(h, mu);
  Symmetry s;
  std::vector<uint8_t> code;
  for (int v = 0; v < mu; ++v) {
    if (sides[size_t(p.of[size_t(v)])] != side) continue;
    walker.Walk(v, p.next[size_t(v)], &code);
    if (s.stabiliser == 0 || code < s.code) s.code = code, s.stabiliser = 0;
    if (code == s.code) ++s.stabiliser;
  }
  return s;
}

uint64_t GroupOrder(const Sides& sides) {
  uint64_t order = 1;
  for (size_t i = 0; i < sides.size(); ++i)
    order *= static_cast<uint64_t>(sides[i]) *
             static_cast<uint64_t>(std::count(sides.begin(), sides.begin() + static_cast<long>(i) + 1, sides[i]));
  return order;
}

// ---------------------------------------------------------------- all consistent handles

AdvancingFront::AdvancingFront(Sides sides, int limit)
    : sides_(std::move(sides)), limit_(limit), mu_(Mu(sides_)), p_(PolygonsOf(sides_)) {
  const int k = static_cast<int>(sides_.size());
  faces_wanted_ = mu_ + 2 * k - 4;
  allowance_ = (limit_ - 9 * mu_ - 42 * (k - 2)) / 2;
  used_.assign(size_t(mu_), std::vector<char>(size_t(mu_)));
  d_.assign(size_t(mu_), 0);
  missing_.assign(size_t(mu_), 2);
}

bool AdvancingFront::Missing(int a, int b) const {
  if (used_[size_t(a)][size_t(b)] || PolygonEdge(b, a)) return false;
  return PolygonEdge(a, b) || used_[size_t(b)][size_t(a)];
}

void AdvancingFront::CountMissing(int a, int b, int sign) {
  const int edges = (Missing(a, b) ? 1 : 0) + (Missing(b, a) ? 1 : 0);
  missing_[size_t(a)] += sign * edges;
  missing_[size_t(b)] += sign * edges;
}

int AdvancingFront::Cost() const {
  int cost = 0;
  for (size_t v = 0; v < size_t(mu_); ++v) {
    const int e = d_[v] - 3;
    if (e > 1 || missing_[v] == 0) cost += e * (e - 1) / 2;
  }
  return cost;
}

void AdvancingFront::Run() {
  if (static_cast<int>(faces_.size()) > faces_wanted_ || Cost() > allowance_) return;
  for (int a = 0; a < mu_; ++a)
    for (int b = 0; b < mu_; ++b) {
      if (a == b || !Missing(a, b)) continue;
      for (int c = 0; c < mu_; ++c) {
        if (c == a || c == b || !Allowed(b, c) || !Allowed(c, a)) continue;
        Put({a, b, c}, 1);
        Run();
        Put({a, b, c}, -1);
      }
      return;
    }
  if (WhyNotSphere(faces_, sides_).empty() && SumOfSquares(faces_, mu_) <= limit_) found.insert(Normal(faces_));
}

void AdvancingFront::Put(Face f, int sign) {
  for (size_t c = 0; c < 3; ++c) {
    const int a = f[c], b = f[(c + 1) % 3];
    CountMissing(a, b, -1);
    used_[size_t(a)][size_t(b)] = sign > 0;
    CountMissing(a, b, 1);
    d_[size_t(a)] += sign;
  }
  if (sign > 0)
    faces_.push_back(f);
  else
    faces_.pop_back();
}

}  // namespace handle_lists
