#include "support.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <numeric>
#include <set>

#include "elementary.h"

namespace support {

// ---------------------------------------------------------------- meshes

Mesh Sphere(Point center, double radius, int parts) {
  return tool::make_sphere({center[0], center[1], center[2]}, radius, parts);
}

namespace {

void AddVertex(Mesh& m, const Point& p) { m.positions.insert(m.positions.end(), p.begin(), p.end()); }
void AddTriangle(Mesh& m, size_t a, size_t b, size_t c) {
  for (size_t v : {a, b, c}) m.triangles.push_back(static_cast<uint32_t>(v));
}
void AddQuad(Mesh& m, size_t a, size_t b, size_t c, size_t d) {
  AddTriangle(m, a, b, c);
  AddTriangle(m, a, c, d);
}

Point Minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point Cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double Dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point Unit(const Point& a) {
  const double n = std::sqrt(Dot(a, a));
  return {a[0] / n, a[1] / n, a[2] / n};
}

constexpr double pi = 3.14159265358979323846;

}  // namespace

Mesh Torus(Point center, double ring, double tube, int around, int across) {
  Mesh m;
  for (int i = 0; i < around; ++i)
    for (int k = 0; k < across; ++k) {
      const double a = 2 * pi * i / around, b = 2 * pi * k / across, r = ring + tube * tool::cosine(b);
      AddVertex(m, {center[0] + r * tool::cosine(a), center[1] + r * tool::sine(a), center[2] + tube * tool::sine(b)});
    }
  const auto at = [&](int i, int k) { return static_cast<size_t>((i % around) * across + k % across); };
  for (int i = 0; i < around; ++i)
    for (int k = 0; k < across; ++k) AddQuad(m, at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1));
  return m;
}

Mesh Box(Point low, Point high, int n) {
  Mesh m;
  std::map<std::array<int, 3>, size_t> number;
  const auto vertex = [&](const std::array<int, 3>& at) {
    const auto [place, added] = number.emplace(at, number.size());
    if (added) {
      Point p;
      for (size_t i = 0; i < 3; ++i) p[i] = low[i] + (high[i] - low[i]) * at[i] / n;
      AddVertex(m, p);
    }
    return place->second;
  };
  for (size_t axis = 0; axis < 3; ++axis)
    for (int side : {0, n})
      for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k) {
          size_t corner[4];
          constexpr int step[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
          for (size_t c = 0; c < 4; ++c) {
            std::array<int, 3> at{};
            at[axis] = side;
            at[(axis + 1) % 3] = i + step[c][0];
            at[(axis + 2) % 3] = k + step[c][1];
            corner[c] = vertex(at);
          }
          if (side == 0)
            AddQuad(m, corner[0], corner[3], corner[2], corner[1]);
          else
            AddQuad(m, corner[0], corner[1], corner[2], corner[3]);
        }
  return m;
}

Mesh Tube(const std::vector<Point>& points, const std::vector<double>& radii, int sides, Point up) {
  Mesh m;
  const size_t n = points.size(), count = static_cast<size_t>(sides);
  for (size_t i = 0; i < n; ++i) {
    const Point along = Unit(Minus(points[std::min(i + 1, n - 1)], points[i == 0 ? 0 : i - 1]));
    const Point u = Unit(Cross(up, along)), v = Cross(along, u);
    for (int k = 0; k < sides; ++k) {
      const double a = 2 * pi * k / sides;
      Point p = points[i];
      for (size_t c = 0; c < 3; ++c) p[c] += radii[i] * (tool::cosine(a) * u[c] + tool::sine(a) * v[c]);
      AddVertex(m, p);
    }
  }
  const size_t first = n * count, last = first + 1;
  AddVertex(m, points.front());
  AddVertex(m, points.back());
  for (size_t k = 0; k < count; ++k) {
    const size_t next = (k + 1) % count;
    for (size_t i = 0; i + 1 < n; ++i)
      AddQuad(m, i * count + k, i * count + next, (i + 1) * count + next, (i + 1) * count + k);
    AddTriangle(m, first, next, k);
    AddTriangle(m, last, (n - 1) * count + k, (n - 1) * count + next);
  }
  return m;
}

Mesh Together(const std::vector<Mesh>& parts) {
  Mesh all;
  for (const Mesh& m : parts) {
    const uint32_t base = VertexCount(all);
    all.positions.insert(all.positions.end(), m.positions.begin(), m.positions.end());
    for (uint32_t v : m.triangles) all.triangles.push_back(base + v);
  }
  return all;
}

Mesh Translated(Mesh m, Point by) {
  for (size_t i = 0; i < m.positions.size(); ++i) m.positions[i] += by[i % 3];
  return m;
}

// From the generator's bits, so that every standard library draws the same.
double Uniform(Random& random, double low, double high) {
  return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
}

Point RandomPoint(Random& random, double low, double high) {
  Point p;
  for (double& x : p) x = Uniform(random, low, high);
  return p;
}

namespace {

std::vector<uint32_t> RandomPermutation(uint32_t n, Random& random) {
  std::vector<uint32_t> order(n);
  std::iota(order.begin(), order.end(), 0u);
  for (uint32_t i = n; i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  return order;
}

}  // namespace

Mesh Renumbered(const Mesh& m, Random& random) {
  const std::vector<uint32_t> vertex = RandomPermutation(VertexCount(m), random);
  const std::vector<uint32_t> triangle = RandomPermutation(TriangleCount(m), random);
  Mesh out = m;
  for (size_t v = 0; v < vertex.size(); ++v)
    for (size_t i = 0; i < 3; ++i) out.positions[3 * size_t{vertex[v]} + i] = m.positions[3 * v + i];
  for (size_t f = 0; f < triangle.size(); ++f) {
    const size_t turn = random() % 3;
    for (size_t i = 0; i < 3; ++i)
      out.triangles[3 * size_t{triangle[f]} + (i + turn) % 3] = vertex[m.triangles[3 * f + i]];
  }
  return out;
}

Point QuarterTurned(Point p, int rotation) {
  // Six places for the x axis, four turns about it.
  for (int i = 0; i < rotation % 4; ++i) p = {p[0], -p[2], p[1]};
  const int place = rotation / 4 % 6;
  for (int i = 0; place < 4 && i < place; ++i) p = {-p[1], p[0], p[2]};
  if (place == 4) p = {p[2], p[1], -p[0]};
  if (place == 5) p = {-p[2], p[1], p[0]};
  return p;
}

Mesh QuarterTurned(Mesh m, int rotation) {
  for (size_t v = 0; v < VertexCount(m); ++v) {
    const Point p = QuarterTurned(PositionOf(m, v), rotation);
    std::copy(p.begin(), p.end(), m.positions.begin() + static_cast<std::ptrdiff_t>(3 * v));
  }
  return m;
}

// ---------------------------------------------------------------- exact arithmetic

namespace {

// Sum of limbs[i] * 2^(24 i) with a sign in every limb, so that adding and multiplying need no carries until the end.
struct Integer {
  std::vector<int64_t> limbs;
};

Integer Combined(const Integer& a, const Integer& b, int64_t factor) {
  Integer out{std::vector<int64_t>(std::max(a.limbs.size(), b.limbs.size()))};
  for (size_t i = 0; i < a.limbs.size(); ++i) out.limbs[i] += a.limbs[i];
  for (size_t i = 0; i < b.limbs.size(); ++i) out.limbs[i] += factor * b.limbs[i];
  return out;
}

// Limbs within (-2^24, 2^24) but the last.
Integer Carried(Integer a) {
  for (int i = 0; i < 4; ++i) a.limbs.push_back(0);
  for (size_t i = 0; i + 1 < a.limbs.size(); ++i) {
    const int64_t carry = a.limbs[i] / (1 << 24);
    a.limbs[i] -= carry * (1 << 24);
    a.limbs[i + 1] += carry;
  }
  while (!a.limbs.empty() && a.limbs.back() == 0) a.limbs.pop_back();
  return a;
}

// Products of limbs are below 2^48, sums of up to 2^14 of them fit.
Integer Product(const Integer& a, const Integer& b) {
  Integer out{std::vector<int64_t>(a.limbs.size() + b.limbs.size())};
  for (size_t i = 0; i < a.limbs.size(); ++i)
    for (size_t k = 0; k < b.limbs.size(); ++k) out.limbs[i + k] += a.limbs[i] * b.limbs[k];
  return Carried(out);
}

// The limbs below the highest add up to less than one unit of it.
int SignOf(const Integer& a) {
  const Integer c = Carried(a);
  return c.limbs.empty() ? 0 : c.limbs.back() > 0 ? 1 : -1;
}

// x * 2^264: whole for every double of the exact range.
Integer Whole(double x) {
  int exponent = 0;
  const double fraction = std::frexp(x, &exponent);
  const auto mantissa = static_cast<int64_t>(std::ldexp(fraction, 53));
  const int shift = exponent - 53 + 264;  // 2^-100 * 2^-53 * 2^264 is whole
  Integer out{std::vector<int64_t>(static_cast<size_t>(shift / 24) + 4)};
  const int within = shift % 24;
  const int64_t sign = mantissa < 0 ? -1 : 1;
  auto rest = static_cast<uint64_t>(sign * mantissa);
  for (int k = 0; k < 3; ++k, rest >>= 24)
    out.limbs[static_cast<size_t>(shift / 24 + k)] = sign * (static_cast<int64_t>(rest & 0xFFFFFF) << within);
  return Carried(out);
}

int ExactDeterminant(const double (&p)[4][3], int n) {
  // Rows p[1] - p[0] .. p[n] - p[0] of n columns.
  Integer r[3][3];
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) r[i][k] = Carried(Combined(Whole(p[i + 1][k]), Whole(p[0][k]), -1));
  const auto minor = [&](int i, int k, int a, int b) {
    return Carried(Combined(Product(r[i][a], r[k][b]), Product(r[i][b], r[k][a]), -1));
  };
  if (n == 2) return SignOf(minor(0, 1, 0, 1));
  return SignOf(Combined(Combined(Product(r[0][0], minor(1, 2, 1, 2)), Product(r[0][1], minor(1, 2, 0, 2)), -1),
                         Product(r[0][2], minor(1, 2, 0, 1)), 1));
}

// Quarters below 64: differences have at most ten bits, so that determinants of them are exact as they are.
bool OnSmallLattice(const Point& p) {
  for (double x : p)
    if (!(std::fabs(x) < 64 && 4 * x == std::floor(4 * x))) return false;
  return true;
}

int Turn(const Point& a, const Point& b, const Point& c, size_t x, size_t y) {
  const double left = (b[x] - a[x]) * (c[y] - a[y]), right = (b[y] - a[y]) * (c[x] - a[x]);
  if (OnSmallLattice(a) && OnSmallLattice(b) && OnSmallLattice(c)) return (left > right) - (left < right);
  if (std::fabs(left - right) > 1e-14 * (std::fabs(left) + std::fabs(right))) return left > right ? 1 : -1;
  const double p[4][3] = {{a[x], a[y], 0}, {b[x], b[y], 0}, {c[x], c[y], 0}, {0, 0, 0}};
  return ExactDeterminant(p, 2);
}

}  // namespace

int Side(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Point u = Minus(b, a), v = Minus(c, a), w = Minus(d, a);
  double sum = 0, size = 0;
  for (size_t i = 0; i < 3; ++i) {
    const size_t k = (i + 1) % 3, l = (i + 2) % 3;
    sum += w[i] * (u[k] * v[l] - u[l] * v[k]);
    size += std::fabs(w[i]) * (std::fabs(u[k] * v[l]) + std::fabs(u[l] * v[k]));
  }
  if (std::fabs(sum) > 1e-14 * size) return sum > 0 ? 1 : -1;
  if (OnSmallLattice(a) && OnSmallLattice(b) && OnSmallLattice(c) && OnSmallLattice(d)) return (sum > 0) - (sum < 0);
  const double p[4][3] = {{a[0], a[1], a[2]}, {b[0], b[1], b[2]}, {c[0], c[1], c[2]}, {d[0], d[1], d[2]}};
  return ExactDeterminant(p, 3);
}

// ---------------------------------------------------------------- triangles

namespace {

struct Triangle {
  Point p[3];
};

Triangle TriangleOf(const Mesh& m, uint32_t f) {
  return {{PositionOf(m, m.triangles[3 * f]), PositionOf(m, m.triangles[3 * f + 1]),
           PositionOf(m, m.triangles[3 * f + 2])}};
}

// Two axes in whose plane the triangle keeps an area.
std::pair<size_t, size_t> FlatAxes(const Triangle& t) {
  for (size_t i = 0; i < 3; ++i)
    if (Turn(t.p[0], t.p[1], t.p[2], i, (i + 1) % 3) != 0) return {i, (i + 1) % 3};
  return {0, 1};
}

bool SegmentsMeetFlat(const Point& p, const Point& q, const Point& a, const Point& b, size_t x, size_t y) {
  const int s1 = Turn(p, q, a, x, y), s2 = Turn(p, q, b, x, y), s3 = Turn(a, b, p, x, y), s4 = Turn(a, b, q, x, y);
  if (s1 * s2 > 0 || s3 * s4 > 0) return false;
  if (s1 != 0 || s2 != 0 || s3 != 0 || s4 != 0) return true;
  for (size_t i : {x, y})
    if (std::max(p[i], q[i]) < std::min(a[i], b[i]) || std::max(a[i], b[i]) < std::min(p[i], q[i])) return false;
  return true;
}

bool InsideFlat(const Point& p, const Triangle& t, size_t x, size_t y) {
  bool left = false, right = false;
  for (size_t i = 0; i < 3; ++i) {
    const int s = Turn(t.p[i], t.p[(i + 1) % 3], p, x, y);
    left = left || s > 0;
    right = right || s < 0;
  }
  return !(left && right);
}

bool SegmentMeets(const Point& p, const Point& q, const Triangle& t) {
  const int sp = Side(t.p[0], t.p[1], t.p[2], p), sq = Side(t.p[0], t.p[1], t.p[2], q);
  if (sp * sq > 0) return false;
  if (sp != 0 || sq != 0) {
    bool left = false, right = false;
    for (size_t i = 0; i < 3; ++i) {
      const int s = Side(p, q, t.p[i], t.p[(i + 1) % 3]);
      left = left || s > 0;
      right = right || s < 0;
    }
    return !(left && right);
  }
  const auto [x, y] = FlatAxes(t);
  if (InsideFlat(p, t, x, y) || InsideFlat(q, t, x, y)) return true;
  for (size_t i = 0; i < 3; ++i)
    if (SegmentsMeetFlat(p, q, t.p[i], t.p[(i + 1) % 3], x, y)) return true;
  return false;
}

bool BoxesApart(const Triangle& s, const Triangle& t) {
  for (size_t i = 0; i < 3; ++i) {
    const auto [s_low, s_high] = std::minmax({s.p[0][i], s.p[1][i], s.p[2][i]});
    const auto [t_low, t_high] = std::minmax({t.p[0][i], t.p[1][i], t.p[2][i]});
    if (s_high < t_low || t_high < s_low) return true;
  }
  return false;
}

}  // namespace

bool TrianglesMeet(const Mesh& m, uint32_t f, uint32_t g) {
  const Triangle s = TriangleOf(m, f), t = TriangleOf(m, g);
  size_t shared = 0, in_s = 0, in_t = 0, alone_s = 0, alone_t = 0;  // corners; sums tell which one is left over
  for (size_t i = 0; i < 3; ++i)
    for (size_t k = 0; k < 3; ++k)
      if (m.triangles[3 * f + i] == m.triangles[3 * g + k]) {
        ++shared;
        in_s = i;
        in_t = k;
        alone_s += i;
        alone_t += k;
      }
  switch (shared) {
    case 0:
      for (size_t i = 0; i < 3; ++i)
        if (SegmentMeets(s.p[i], s.p[(i + 1) % 3], t) || SegmentMeets(t.p[i], t.p[(i + 1) % 3], s)) return true;
      return false;
    case 1:
      // What they have in common beyond the vertex reaches from it to the opposite side of one of them.
      return SegmentMeets(s.p[(in_s + 1) % 3], s.p[(in_s + 2) % 3], t) ||
             SegmentMeets(t.p[(in_t + 1) % 3], t.p[(in_t + 2) % 3], s);
    case 2: {
      const size_t i = 3 - alone_s, k = 3 - alone_t;
      const Point &a = s.p[(i + 1) % 3], &b = s.p[(i + 2) % 3], &c = s.p[i], &d = t.p[k];
      if (Side(a, b, c, d) != 0) return false;
      const auto [x, y] = FlatAxes(s);
      return Turn(a, b, c, x, y) * Turn(a, b, d, x, y) >= 0;
    }
    default: return true;
  }
}

Pairs AllMeetingPairs(const Mesh& m) {
  const uint32_t n = TriangleCount(m);
  std::vector<Triangle> triangles(n);
  for (uint32_t f = 0; f < n; ++f) triangles[f] = TriangleOf(m, f);
  // Each with each, but for those that lie apart along x.
  std::vector<double> low(n), high(n);
  std::vector<uint32_t> order(n);
  for (uint32_t f = 0; f < n; ++f)
    std::tie(low[f], high[f]) =
        std::minmax({triangles[f].p[0][0], triangles[f].p[1][0], triangles[f].p[2][0]});
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](uint32_t f, uint32_t g) { return low[f] < low[g]; });
  Pairs pairs;
  for (uint32_t i = 0; i < n; ++i)
    for (uint32_t k = i + 1; k < n && low[order[k]] <= high[order[i]]; ++k) {
      const auto [f, g] = std::minmax(order[i], order[k]);
      if (!BoxesApart(triangles[f], triangles[g]) && TrianglesMeet(m, f, g)) pairs.emplace_back(f, g);
    }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

// ---------------------------------------------------------------- topology

int64_t Topology::Genus() const {
  int64_t sum = 0;
  for (const Component& c : components) sum += c.genus;
  return sum;
}

double Topology::Volume() const {
  double sum = 0;
  for (const Component& c : components) sum += c.volume;
  return sum;
}

std::vector<int64_t> Topology::Genera() const {
  std::vector<int64_t> genera;
  for (const Component& c : components) genera.push_back(c.genus);
  std::sort(genera.begin(), genera.end());
  return genera;
}

namespace {

// Empty, or what keeps the mesh from being a closed oriented manifold.
std::string DefectOf(const Mesh& m) {
  std::vector<std::map<uint32_t, uint32_t>> following(VertexCount(m));  // of each star: the link's directed edges
  for (size_t f = 0; f < TriangleCount(m); ++f)
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t a = m.triangles[3 * f + i], b = m.triangles[3 * f + (i + 1) % 3],
                     c = m.triangles[3 * f + (i + 2) % 3];
      if (a >= VertexCount(m)) return "index " + std::to_string(a);
      if (a == b) return "vertex twice in triangle " + std::to_string(f);
      if (!following[a].emplace(b, c).second)
        return "edge " + std::to_string(a) + " " + std::to_string(b) + " twice in one direction";
    }
  for (size_t v = 0; v < following.size(); ++v) {
    if (following[v].empty()) return "isolated vertex " + std::to_string(v);
    const uint32_t start = following[v].begin()->first;
    size_t steps = 0;
    uint32_t at = start;
    do {
      const auto next = following[v].find(at);
      if (next == following[v].end()) return "open link of vertex " + std::to_string(v);
      at = next->second;
      ++steps;
    } while (at != start && steps <= following[v].size());
    if (steps != following[v].size()) return "more than one fan at vertex " + std::to_string(v);
  }
  return "";
}

}  // namespace

Topology TopologyOf(const Mesh& m) {
  Topology out;
  out.defect = DefectOf(m);
  if (!out.defect.empty()) return out;
  std::vector<uint32_t> root(VertexCount(m));
  std::iota(root.begin(), root.end(), 0u);
  const auto find = [&](uint32_t v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (size_t f = 0; f < m.triangles.size(); f += 3)
    for (size_t i = 1; i < 3; ++i) {
      const uint32_t a = find(m.triangles[f]), b = find(m.triangles[f + i]);
      root[std::max(a, b)] = std::min(a, b);
    }
  std::map<uint32_t, Component> by_root;
  for (uint32_t v = 0; v < VertexCount(m); ++v) {
    Component& c = by_root[find(v)];
    if (c.vertices++ == 0) c.smallest_vertex = v;
  }
  for (uint32_t f = 0; f < TriangleCount(m); ++f) {
    Component& c = by_root[find(m.triangles[3 * f])];
    ++c.triangles;
    const Triangle t = TriangleOf(m, f);
    c.volume += Dot(t.p[0], Cross(t.p[1], t.p[2])) / 6;
  }
  for (auto& [unused, c] : by_root) {
    const int64_t vertices = c.vertices, triangles = c.triangles;
    c.genus = (2 - (vertices - 3 * triangles / 2 + triangles)) / 2;
    out.components.push_back(c);
  }
  return out;
}

std::string Written(const Mesh& m, const std::string& name) {
  const std::string path = (std::filesystem::temp_directory_path() / ("topoadapt-" + name + ".ply")).string();
  const tool::Status s = tool::write_mesh(path, m);
  return s ? "mesh written to " + path : s.message;
}

testing::AssertionResult IsSound(const Mesh& m, const std::string& name) {
  const Topology t = TopologyOf(m);
  if (!t.defect.empty()) return testing::AssertionFailure() << t.defect << "; " << Written(m, name);
  const Pairs pairs = AllMeetingPairs(m);
  if (!pairs.empty())
    return testing::AssertionFailure() << pairs.size() << " self-intersections, the first of triangles "
                                       << pairs[0].first << " and " << pairs[0].second << "; " << Written(m, name);
  return testing::AssertionSuccess();
}

// ---------------------------------------------------------------- the library

tpa_config DefaultConfig(uint32_t max_vertices) {
  tpa_config config;
  EXPECT_EQ(tpa_config_init(&config, sizeof config), TPA_OK);
  config.max_vertices = max_vertices;
  return config;
}

tpa_config ConfigFor(const Mesh& m) { return DefaultConfig(3 * VertexCount(m) + 64); }

void Arena::Free::operator()(char* p) const { std::free(p); }

Arena::Arena(const tpa_config& config) {
  tpa_issue issue;
  EXPECT_EQ(tpa_arena_query(&config, &size_, &issue), TPA_OK) << Text(issue);
  const size_t rounded = (size_.bytes + size_.alignment - 1) / size_.alignment * size_.alignment;
  block_.reset(static_cast<char*>(std::aligned_alloc(size_.alignment, rounded)));
  EXPECT_EQ(tpa_init(block_.get(), size_.bytes, &config, &context_, &issue), TPA_OK) << Text(issue);
}

Arena::Arena(const tpa_config& config, const Mesh& mesh) : Arena(config) {
  tpa_issue issue;
  EXPECT_EQ(Load(context_, mesh, &issue), TPA_OK) << Text(issue);
}

tpa_mesh_input InputOf(const Mesh& mesh) {
  auto input = Sized<tpa_mesh_input>();
  input.vertex_count = VertexCount(mesh);
  input.triangle_count = TriangleCount(mesh);
  input.position_type = TPA_FLOAT64;
  input.index_type = TPA_UINT32;
  input.positions = mesh.positions.data();
  input.triangles = mesh.triangles.data();
  return input;
}

tpa_status Load(tpa_context* context, const Mesh& mesh, tpa_issue* issue) {
  const tpa_mesh_input input = InputOf(mesh);
  return tpa_load(context, &input, issue);
}

tpa_status MoveAll(tpa_context* context, const std::vector<double>& targets, tpa_issue* issue) {
  auto move = Sized<tpa_move_input>();
  move.count = static_cast<uint32_t>(targets.size() / 3);
  move.position_type = TPA_FLOAT64;
  move.positions = targets.data();
  return tpa_move(context, &move, issue);
}

Mesh MeshOf(const tpa_context* context) {
  auto view = Sized<tpa_mesh_view>();
  EXPECT_EQ(tpa_view(context, &view), TPA_OK);
  Mesh m;
  m.positions.assign(view.positions, view.positions + 3 * size_t{view.vertex_count});
  m.triangles.assign(view.triangles, view.triangles + 3 * size_t{view.triangle_count});
  return m;
}

std::vector<tpa_event> EventsOf(const tpa_context* context) {
  const tpa_event* events = nullptr;
  uint32_t count = 0;
  EXPECT_EQ(tpa_events(context, &events, &count), TPA_OK);
  return {events, events + count};
}

namespace {

tpa_vertex_map_view VertexMap(const tpa_context* context) {
  auto map = Sized<tpa_vertex_map_view>();
  EXPECT_EQ(tpa_vertex_map(context, &map), TPA_OK);
  return map;
}

}  // namespace

std::vector<tpa_vertex_origin> VertexOriginsOf(const tpa_context* context) {
  const tpa_vertex_map_view map = VertexMap(context);
  return {map.origins, map.origins + map.new_count};
}

std::vector<uint32_t> OldToNewOf(const tpa_context* context) {
  const tpa_vertex_map_view map = VertexMap(context);
  return {map.old_to_new, map.old_to_new + map.old_count};
}

std::vector<uint32_t> TriangleOriginsOf(const tpa_context* context) {
  auto map = Sized<tpa_triangle_map_view>();
  EXPECT_EQ(tpa_triangle_map(context, &map), TPA_OK);
  return {map.origins, map.origins + map.new_count};
}

Pairs PairsOf(const tpa_contacts& contacts) {
  Pairs pairs;
  for (uint32_t i = 0; i < contacts.count; ++i) pairs.emplace_back(contacts.pairs[i].a, contacts.pairs[i].b);
  return pairs;
}

std::string Text(const tpa_issue& issue) {
  char text[256];
  tpa_issue_text(&issue, text, sizeof text);
  return text;
}

Observed Observe(const tpa_context* context) {
  Observed out;
  const auto add = [&](const void* data, size_t bytes) { out.bytes.append(static_cast<const char*>(data), bytes); };
  auto view = Sized<tpa_mesh_view>();
  if (tpa_view(context, &view) == TPA_OK) {
    add(&view.vertex_count, sizeof view.vertex_count);
    add(&view.triangle_count, sizeof view.triangle_count);
    add(&view.epoch, sizeof view.epoch);
    add(view.positions, 3 * sizeof(double) * view.vertex_count);
    add(view.triangles, 3 * sizeof(uint32_t) * view.triangle_count);
    add(view.opposites, 3 * sizeof(uint32_t) * view.triangle_count);
    const tpa_vertex_map_view vertices = VertexMap(context);
    add(&vertices.old_count, sizeof vertices.old_count);
    add(vertices.old_to_new, sizeof(uint32_t) * vertices.old_count);
    add(vertices.origins, sizeof(tpa_vertex_origin) * vertices.new_count);
    auto triangles = Sized<tpa_triangle_map_view>();
    EXPECT_EQ(tpa_triangle_map(context, &triangles), TPA_OK);
    add(&triangles.old_count, sizeof triangles.old_count);
    add(triangles.origins, sizeof(uint32_t) * triangles.new_count);
  }
  const tpa_event* events = nullptr;
  const uint32_t* rolled_back = nullptr;
  uint32_t count = 0;
  EXPECT_EQ(tpa_events(context, &events, &count), TPA_OK);
  add(&count, sizeof count);
  add(events, sizeof(tpa_event) * count);
  EXPECT_EQ(tpa_rolled_back(context, &rolled_back, &count), TPA_OK);
  add(&count, sizeof count);
  add(rolled_back, sizeof(uint32_t) * count);
  return out;
}

}  // namespace support
