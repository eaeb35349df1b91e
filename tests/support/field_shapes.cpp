// SPDX-License-Identifier: MIT
#include "support/field_shapes.h"

#include <algorithm>
#include <map>
#include <stdexcept>

#include "support/mesh_building.h"
#include "support/tangle_shapes.h"

namespace support {

namespace {

Point Middle(const Point& a, const Point& b) { return Scaled(0.5, Sum(a, b)); }

// The points of layers 0 .. `layers` and the quadrilaterals between; point i of layer l is vertex l * size + i.
Mesh Wall(const Outline& outline, double height, int layers) {
  Mesh m;
  const size_t n = outline.size(), count = static_cast<size_t>(layers);
  for (size_t l = 0; l <= count; ++l)
    for (const Flat& p : outline) AddVertex(m, {p[0], p[1], height * static_cast<double>(l) / layers});
  for (size_t l = 0; l < count; ++l)
    for (size_t i = 0; i < n; ++i) {
      const size_t j = (i + 1) % n, low = l * n, high = low + n;
      AddQuad(m, low + i, low + j, high + j, high + i);
    }
  return m;
}

double Turn(const Flat& a, const Flat& b, const Flat& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

using Corners = std::array<size_t, 3>;

bool IsEar(const Outline& p, const std::vector<size_t>& left, size_t at) {
  const size_t n = left.size(), a = left[(at + n - 1) % n], b = left[at], c = left[(at + 1) % n];
  if (Turn(p[a], p[b], p[c]) <= 0) return false;
  for (size_t v : left) {
    if (v == a || v == b || v == c) continue;
    if (Turn(p[a], p[b], p[v]) >= 0 && Turn(p[b], p[c], p[v]) >= 0 && Turn(p[c], p[a], p[v]) >= 0) return false;
  }
  return true;
}

std::vector<Corners> EarsOf(const Outline& p) {
  std::vector<size_t> left(p.size());
  for (size_t i = 0; i < left.size(); ++i) left[i] = i;
  std::vector<Corners> ears;
  while (left.size() > 3) {
    size_t at = 0;
    while (at < left.size() && !IsEar(p, left, at)) ++at;
    if (at == left.size()) throw std::invalid_argument("a polygon without ears is not simple");
    const size_t n = left.size();
    ears.push_back({left[(at + n - 1) % n], left[at], left[(at + 1) % n]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
  }
  ears.push_back({left[0], left[1], left[2]});
  return ears;
}

}  // namespace

double SignedVolume(const Mesh& m) {
  double sum = 0;
  for (size_t f = 0; f < m.triangles.size(); f += 3)
    sum +=
        Dot(PositionOf(m, m.triangles[f]), Cross(PositionOf(m, m.triangles[f + 1]), PositionOf(m, m.triangles[f + 2])));
  return sum / 6;
}

Mesh Subdivided(const Mesh& m) {
  Mesh out;
  out.positions = m.positions;
  std::map<std::pair<uint32_t, uint32_t>, size_t> middles;
  const auto middle = [&](uint32_t a, uint32_t b) {
    const auto [place, added] = middles.emplace(std::minmax(a, b), VertexCount(out));
    if (added) AddVertex(out, Middle(PositionOf(m, a), PositionOf(m, b)));
    return place->second;
  };
  for (size_t f = 0; f < m.triangles.size(); f += 3) {
    const uint32_t a = m.triangles[f], b = m.triangles[f + 1], c = m.triangles[f + 2];
    const size_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    AddTriangle(out, a, ab, ca);
    AddTriangle(out, b, bc, ab);
    AddTriangle(out, c, ca, bc);
    AddTriangle(out, ab, bc, ca);
  }
  return out;
}

double MeanEdgeOf(const Mesh& m) {
  double sum = 0;
  for (size_t f = 0; f < m.triangles.size(); f += 3)
    for (size_t i = 0; i < 3; ++i)
      sum += Distance(PositionOf(m, m.triangles[f + i]), PositionOf(m, m.triangles[f + (i + 1) % 3]));
  return sum / static_cast<double>(m.triangles.size());
}

double DiagonalOf(const Mesh& m) {
  Point low = PositionOf(m, 0), high = low;
  for (size_t i = 0; i < m.positions.size(); ++i) {
    low[i % 3] = std::min(low[i % 3], m.positions[i]);
    high[i % 3] = std::max(high[i % 3], m.positions[i]);
  }
  return Distance(low, high);
}

std::vector<Point> VertexNormals(const Mesh& m) {
  std::vector<Point> normals(VertexCount(m), Point{});
  for (size_t f = 0; f < m.triangles.size(); f += 3) {
    const Point p = PositionOf(m, m.triangles[f]);
    const Point n =
        Cross(Difference(PositionOf(m, m.triangles[f + 1]), p), Difference(PositionOf(m, m.triangles[f + 2]), p));
    for (size_t i = 0; i < 3; ++i) {
      Point& normal = normals[m.triangles[f + i]];
      normal = Sum(normal, n);
    }
  }
  for (Point& n : normals)
    if (Length(n) > 0) n = Unit(n);
  return normals;
}

Outline Refined(const Outline& outline, int parts) {
  Outline out;
  for (size_t i = 0; i < outline.size(); ++i) {
    const Flat &a = outline[i], &b = outline[(i + 1) % outline.size()];
    for (int k = 0; k < parts; ++k) {
      const double t = static_cast<double>(k) / parts;
      out.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])});
    }
  }
  return out;
}

Mesh Extruded(const Outline& outline, double height, int layers, Cap cap) {
  Mesh m = Wall(outline, height, layers);
  const size_t n = outline.size(), top = static_cast<size_t>(layers) * n;
  if (cap == Cap::corner) {
    for (size_t i = 1; i + 1 < n; ++i) {
      AddTriangle(m, 0, i + 1, i);
      AddTriangle(m, top, top + i, top + i + 1);
    }
    return m;
  }
  Point middle{};
  for (const Flat& p : outline) middle = Sum(middle, {p[0] / static_cast<double>(n), p[1] / static_cast<double>(n), 0});
  const size_t low = VertexCount(m), high = low + 1;
  AddVertex(m, middle);
  AddVertex(m, {middle[0], middle[1], height});
  for (size_t i = 0; i < n; ++i) {
    AddTriangle(m, low, (i + 1) % n, i);
    AddTriangle(m, high, top + i, top + (i + 1) % n);
  }
  return m;
}

Mesh Prism(const Outline& outline, double height) {
  Mesh m = Wall(outline, height, 1);
  const size_t n = outline.size();
  for (const Corners& c : EarsOf(outline)) {
    AddTriangle(m, c[0], c[2], c[1]);
    AddTriangle(m, n + c[0], n + c[1], n + c[2]);
  }
  return m;
}

Mesh Lofted(const std::vector<std::vector<Point>>& rings, bool closed) {
  Mesh m;
  const size_t n = rings.size(), size = rings[0].size();
  for (const auto& ring : rings)
    for (const Point& p : ring) AddVertex(m, p);
  for (size_t i = 0; i + (closed ? 0 : 1) < n; ++i)
    for (size_t k = 0; k < size; ++k) {
      const size_t a = i * size, b = (i + 1) % n * size, l = (k + 1) % size;
      AddQuad(m, a + k, a + l, b + l, b + k);
    }
  for (size_t k = 1; !closed && k + 1 < size; ++k) {
    const size_t last = (n - 1) * size;
    AddTriangle(m, 0, k + 1, k);
    AddTriangle(m, last, last + k, last + k + 1);
  }
  return SignedVolume(m) < 0 ? Reversed(m) : m;
}

}  // namespace support
