// SPDX-License-Identifier: MIT
// Ear clipping (Meisters 1975): a convex corner is cut off together with its neighbours where the triangle holds no
// other corner. Clear ears go first, short diagonals first among these. Signs of areas are exact (Shewchuk 1997), so a
// simple polygon always has an ear left.
#include "tool/io/polygon.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>

namespace tool {

namespace {

struct Flat {
  double x = 0, y = 0;
  bool operator==(const Flat&) const = default;
};

// The sign of the exact sum, as the leading component of an expansion.
double sum_of(std::span<const double> terms) {
  double parts[12];
  size_t count = 0;
  for (double sum : terms) {
    for (size_t i = 0; i < count; ++i) {
      const double total = sum + parts[i], shared = total - sum;
      parts[i] = (sum - (total - shared)) + (parts[i] - shared);
      sum = total;
    }
    parts[count++] = sum;
  }
  while (count > 1 && parts[count - 1] == 0) --count;
  return parts[count - 1];
}

// Twice the signed area of a triangle, counterclockwise positive; the sign is exact.
double area_of(const Flat& a, const Flat& b, const Flat& c) {
  const double left = (b.x - a.x) * (c.y - a.y), right = (b.y - a.y) * (c.x - a.x), area = left - right;
  if (std::fabs(area) > 0x1p-51 * (std::fabs(left) + std::fabs(right))) return area;
  const double factors[6][2] = {{a.x, b.y}, {-a.y, b.x}, {b.x, c.y}, {-b.y, c.x}, {c.x, a.y}, {-c.y, a.x}};
  double terms[12];
  for (size_t i = 0; i < 6; ++i) {
    terms[i] = factors[i][0] * factors[i][1];
    terms[6 + i] = std::fma(factors[i][0], factors[i][1], -terms[i]);
  }
  return sum_of(terms);
}

double distance(const Flat& a, const Flat& b) {
  return std::sqrt((b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y));
}

// Corners relative to the first, scaled to sizes of at most 4 by a power of two. Far smaller coordinates become zero,
// so that no product underflows. Empty if a coordinate is not finite.
std::vector<double> scaled(std::span<const double> corners) {
  double largest = 0;
  for (const double x : corners) {
    if (!std::isfinite(x)) return {};
    largest = std::max(largest, std::fabs(x));
  }
  const int exponent = largest > 0 ? std::ilogb(largest) : 0;
  std::vector<double> result(corners.size());
  for (size_t i = 0; i < corners.size(); ++i) {
    const double way = std::scalbn(corners[i], -exponent) - std::scalbn(corners[i % 3], -exponent);
    result[i] = std::fabs(way) < 0x1p-200 ? 0 : way;
  }
  return result;
}

struct Frame {
  double across[3], up[3];
};

// Two directions that span the plane of the Newell normal, counterclockwise round it. Planes along the axes get the
// axes themselves, so their projection rounds nothing.
Frame frame_of(const std::vector<double>& corners) {
  double n[3] = {0, 0, 0};
  for (size_t i = 0; i < corners.size(); i += 3) {
    const double *p = &corners[i], *q = &corners[(i + 3) % corners.size()];
    for (size_t k = 0; k < 3; ++k) n[k] += (p[(k + 1) % 3] - q[(k + 1) % 3]) * (p[(k + 2) % 3] + q[(k + 2) % 3]);
  }
  size_t k = 2;
  for (const size_t axis : {size_t{0}, size_t{1}})
    if (std::fabs(n[axis]) > std::fabs(n[k])) k = axis;
  if (n[k] == 0) n[k] = 1;
  const size_t i = (k + 1) % 3;
  const double size = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  for (double& x : n) x /= size;
  const double width = std::sqrt(n[k] * n[k] + n[i] * n[i]);
  Frame frame{};
  frame.across[i] = n[k] / width;
  frame.across[k] = -n[i] / width;
  for (size_t axis = 0; axis < 3; ++axis) {
    const size_t next = (axis + 1) % 3, last = (axis + 2) % 3;
    frame.up[axis] = n[next] * frame.across[last] - n[last] * frame.across[next];
  }
  return frame;
}

class Clipper {
 public:
  Clipper(std::vector<Flat> corners, std::vector<uint32_t>& triangles)
      : at_(std::move(corners)), triangles_(triangles), links_(at_.size()) {
    double size = 0;
    for (const Flat& p : at_) size = std::max({size, std::fabs(p.x), std::fabs(p.y)});
    margin_ = size * 0x1p-40;
    const auto n = static_cast<uint32_t>(at_.size());
    for (uint32_t v = 0; v < n; ++v) links_[v] = {(v + n - 1) % n, (v + 1) % n, 0};
    for (uint32_t v = 0; v < n; ++v)
      if (!is_clearly_convex(v)) dents_.push_back(v);
    for (uint32_t v = 0; v < n; ++v) enlist(v);
  }

  void run() {
    for (size_t left = at_.size(); left > 2;) {
      const Tip tip = tips_.top();
      tips_.pop();
      if (tip.age != links_[tip.corner].age) continue;
      clip(tip.corner);
      --left;
    }
  }

 private:
  // In the order of preference. Polygons that cross themselves come to the last two.
  enum class Kind { repeated, clear_ear, narrow_ear, flat, convex, other };

  struct Link {
    uint32_t before, after, age;
  };

  struct Tip {
    Kind kind;
    double diagonal;
    uint32_t before, corner, age;
    bool operator<(const Tip& o) const {  // the greatest is cut off first
      return std::tie(o.kind, o.diagonal, o.before) < std::tie(kind, diagonal, before);
    }
  };

  void enlist(uint32_t v) {
    Link& link = links_[v];
    ++link.age;
    tips_.push({kind_of(v), distance(at_[link.before], at_[link.after]), link.before, v, link.age});
  }

  void clip(uint32_t v) {
    const uint32_t a = links_[v].before, c = links_[v].after;
    triangles_.insert(triangles_.end(), {a, v, c});
    ++links_[v].age;
    links_[a].after = c;
    links_[c].before = a;
    std::erase_if(dents_, [&](uint32_t d) { return d == v || d == a || d == c; });
    for (const uint32_t neighbour : {a, c})
      if (!is_clearly_convex(neighbour)) dents_.push_back(neighbour);
    for (const uint32_t neighbour : {a, c}) enlist(neighbour);
  }

  double turn_at(uint32_t v) const { return area_of(at_[links_[v].before], at_[v], at_[links_[v].after]); }

  bool is_clearly_convex(uint32_t v) const {
    return turn_at(v) > margin_ * distance(at_[links_[v].before], at_[links_[v].after]);
  }

  Kind kind_of(uint32_t v) const {
    const Flat &a = at_[links_[v].before], &b = at_[v], &c = at_[links_[v].after];
    if (a == b || b == c) return Kind::repeated;
    const double area = area_of(a, b, c);
    if (area == 0) return Kind::flat;
    if (area < 0) return Kind::other;
    if (!is_ear(v, 0)) return Kind::convex;
    const double longest = std::max({distance(a, b), distance(b, c), distance(c, a)});
    return area > margin_ * longest && is_ear(v, margin_) ? Kind::clear_ear : Kind::narrow_ear;
  }

  // Does the diagonal past a convex corner run inside the polygon at both ends, with no other corner in the triangle or
  // within `margin` of it? Any intruding chain of a simple polygon turns back at a corner that is not convex.
  bool is_ear(uint32_t v, double margin) const {
    const uint32_t first = links_[v].before, last = links_[v].after;
    if (!leads_inside(first, last) || !leads_inside(last, first)) return false;
    const Flat &a = at_[first], &b = at_[v], &c = at_[last];
    const double ab = -margin * distance(a, b), bc = -margin * distance(b, c), ca = -margin * distance(c, a);
    return std::none_of(dents_.begin(), dents_.end(), [&](uint32_t d) {
      const Flat& p = at_[d];
      if (p == a || p == b || p == c) return false;
      return area_of(a, b, p) >= ab && area_of(b, c, p) >= bc && area_of(c, a, p) >= ca;
    });
  }

  // Does the diagonal leave corner v into the polygon's angle there? (O'Rourke 1998, InCone)
  bool leads_inside(uint32_t v, uint32_t to) const {
    const Flat &before = at_[links_[v].before], &p = at_[v], &after = at_[links_[v].after], &q = at_[to];
    const bool clear_before = links_[v].before == to || area_of(p, q, before) > 0;
    const bool clear_after = links_[v].after == to || area_of(q, p, after) > 0;
    if (turn_at(v) >= 0) return clear_before && clear_after;
    return clear_before || clear_after;
  }

  std::vector<Flat> at_;
  std::vector<uint32_t>& triangles_;
  std::vector<Link> links_;
  std::vector<uint32_t> dents_;  // corners left that are not clearly convex
  std::priority_queue<Tip> tips_;
  double margin_ = 0;  // a length far below the polygon's size and far above rounding
};

// The corners in the plane of their frame. Empty if a coordinate is not finite.
std::vector<Flat> flattened(std::span<const double> corners) {
  const std::vector<double> ways = scaled(corners);
  if (ways.empty()) return {};
  const Frame frame = frame_of(ways);
  std::vector<Flat> flat(ways.size() / 3);
  for (size_t i = 0; i < flat.size(); ++i) {
    const double* p = &ways[3 * i];
    flat[i].x = frame.across[0] * p[0] + frame.across[1] * p[1] + frame.across[2] * p[2];
    flat[i].y = frame.up[0] * p[0] + frame.up[1] * p[1] + frame.up[2] * p[2];
  }
  return flat;
}

int sign_of(double x) { return (x > 0) - (x < 0); }

// Price of a cut, in order of weight.
struct Price {
  int folds = 0, taken = 0;
  double length = 0;
  friend Price operator+(const Price& p, const Price& q) {
    return {p.folds + q.folds, p.taken + q.taken, p.length + q.length};
  }
  bool operator<(const Price& o) const { return std::tie(folds, taken, length) < std::tie(o.folds, o.taken, o.length); }
};

// All cuts of a polygon of n corners, by dynamic programming over its diagonals (Klincsek 1980).
class Cuts {
 public:
  Cuts(const std::vector<Flat>& at, const std::function<bool(uint32_t, uint32_t)>& is_taken)
      : at_(at), n_(static_cast<uint32_t>(at.size())), is_taken_(is_taken), best_(n_ * n_), split_(n_ * n_) {
    for (uint32_t span = 2; span < n_; ++span)
      for (uint32_t i = 0; i + span < n_; ++i) settle(i, i + span);
  }

  std::vector<uint32_t> best() const {
    std::vector<uint32_t> cut;
    std::vector<std::pair<uint32_t, uint32_t>> ahead = {{0, n_ - 1}};
    while (!ahead.empty()) {
      const auto [i, j] = ahead.back();
      ahead.pop_back();
      if (j - i < 2) continue;
      const uint32_t k = split_[i * n_ + j];
      cut.insert(cut.end(), {i, k, j});
      ahead.insert(ahead.end(), {{i, k}, {k, j}});
    }
    return cut;
  }

  bool is_better_than(const std::vector<uint32_t>& cut) const {
    Price price;
    for (size_t f = 0; f + 2 < cut.size(); f += 3) {
      price = price + price_of(cut[f], cut[f + 1], cut[f + 2]);
      for (size_t i = 0; i < 3; ++i) {
        const uint32_t a = cut[f + i], b = cut[f + (i + 1) % 3];
        if (a < b && !is_side(a, b)) price = price + price_of(a, b);
      }
    }
    const Price& mine = best_[n_ - 1];
    return std::tie(mine.folds, mine.taken) < std::tie(price.folds, price.taken);
  }

 private:
  bool is_side(uint32_t a, uint32_t b) const { return b - a == 1 || b - a + 1 == n_; }

  // Does the diagonal cross or touch a side away from its ends?
  bool is_crossed(uint32_t a, uint32_t b) const {
    const Flat &p = at_[a], &q = at_[b];
    for (uint32_t k = 0; k < n_; ++k) {
      const uint32_t l = (k + 1) % n_;
      if (k == a || k == b || l == a || l == b) continue;
      const Flat &r = at_[k], &s = at_[l];
      if (r == p || r == q || s == p || s == q) continue;
      if (sign_of(area_of(p, q, r)) * sign_of(area_of(p, q, s)) <= 0 &&
          sign_of(area_of(r, s, p)) * sign_of(area_of(r, s, q)) <= 0)
        return true;
    }
    return false;
  }

  Price price_of(uint32_t a, uint32_t b) const {
    return {is_crossed(a, b) ? 1 : 0, is_taken_(a, b) ? 1 : 0, distance(at_[a], at_[b])};
  }
  // A triangle that lies the other way round, or has no area, is a fold.
  Price price_of(uint32_t a, uint32_t b, uint32_t c) const {
    return {area_of(at_[a], at_[b], at_[c]) > 0 ? 0 : 1, 0, 0};
  }

  void settle(uint32_t i, uint32_t j) {
    Price& best = best_[i * n_ + j];
    for (uint32_t k = i + 1; k < j; ++k) {
      const Price price = best_[i * n_ + k] + best_[k * n_ + j] + price_of(i, k, j);
      if (k > i + 1 && !(price < best)) continue;
      best = price;
      split_[i * n_ + j] = k;
    }
    if (!is_side(i, j)) best = best + price_of(i, j);
  }

  const std::vector<Flat>& at_;
  uint32_t n_;
  const std::function<bool(uint32_t, uint32_t)>& is_taken_;
  std::vector<Price> best_;      // of the part from corner i to j, at i n + j
  std::vector<uint32_t> split_;  // the third corner of the triangle at the diagonal
};

}  // namespace

void triangulate(std::span<const double> corners, std::vector<uint32_t>& triangles) {
  std::vector<Flat> flat = corners.size() > 9 ? flattened(corners) : std::vector<Flat>();
  if (flat.empty()) {
    for (uint32_t i = 2; i < corners.size() / 3; ++i) triangles.insert(triangles.end(), {0, i - 1, i});
    return;
  }
  Clipper(std::move(flat), triangles).run();
}

bool is_convex(std::span<const double> corners) {
  const std::vector<Flat> flat = flattened(corners);
  const size_t n = flat.size();
  for (size_t i = 0; i < n; ++i)
    if (!(area_of(flat[i], flat[(i + 1) % n], flat[(i + 2) % n]) > 0)) return false;
  return n > 0;
}

void triangulate_around(std::span<const double> corners, const std::function<bool(uint32_t, uint32_t)>& is_taken,
                        std::vector<uint32_t>& triangles) {
  constexpr size_t most_corners = 64;
  const std::vector<Flat> flat = flattened(corners);
  if (flat.size() < 4 || flat.size() > most_corners) return;
  const Cuts cuts(flat, is_taken);
  if (cuts.is_better_than(triangles)) triangles = cuts.best();
}

}  // namespace tool
