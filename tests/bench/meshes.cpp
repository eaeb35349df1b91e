// SPDX-License-Identifier: MIT
#include "meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <random>
#include <unordered_map>

#include "tool/scenes/elementary.h"

namespace bench {

namespace {

void Append(Mesh& to, const Mesh& m) {
  const uint32_t first = VertexCount(to);
  to.positions.insert(to.positions.end(), m.positions.begin(), m.positions.end());
  for (uint32_t v : m.triangles) to.triangles.push_back(first + v);
}

uint32_t AddUnit(Mesh& m, double x, double y, double z) {
  const double r = std::sqrt(x * x + y * y + z * z);
  m.positions.insert(m.positions.end(), {x / r, y / r, z / r});
  return VertexCount(m) - 1;
}

Mesh Icosahedron() {
  Mesh m;
  const double t = std::numbers::phi;
  for (int i = 0; i < 3; ++i)
    for (double a : {-1.0, 1.0})
      for (double b : {-t, t}) {
        double p[3];
        p[i] = 0, p[(i + 1) % 3] = a, p[(i + 2) % 3] = b;
        AddUnit(m, p[0], p[1], p[2]);
      }
  const auto at = [&](uint32_t v) { return m.positions.data() + 3 * v; };
  const auto near = [&](uint32_t a, uint32_t b) {
    return std::hypot(at(a)[0] - at(b)[0], at(a)[1] - at(b)[1], at(a)[2] - at(b)[2]) < 1.2;
  };
  for (uint32_t a = 0; a < 12; ++a)
    for (uint32_t b = a + 1; b < 12; ++b)
      for (uint32_t c = b + 1; c < 12; ++c) {
        if (!near(a, b) || !near(b, c) || !near(a, c)) continue;
        const double *p = at(a), *q = at(b), *r = at(c);
        const double volume = p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) +
                              p[2] * (q[0] * r[1] - q[1] * r[0]);
        for (uint32_t v : {a, volume > 0 ? b : c, volume > 0 ? c : b}) m.triangles.push_back(v);
      }
  return m;
}

Mesh Quartered(const Mesh& m) {
  Mesh fine;
  fine.positions = m.positions;
  fine.triangles.reserve(4 * m.triangles.size());
  std::unordered_map<uint64_t, uint32_t> middles;
  const auto middle = [&](uint32_t a, uint32_t b) {
    const auto [entry, fresh] = middles.try_emplace(uint64_t{std::min(a, b)} << 32 | std::max(a, b));
    if (fresh) {
      const double *p = m.positions.data() + 3 * a, *q = m.positions.data() + 3 * b;
      entry->second = AddUnit(fine, p[0] + q[0], p[1] + q[1], p[2] + q[2]);
    }
    return entry->second;
  };
  for (size_t i = 0; i < m.triangles.size(); i += 3) {
    const uint32_t *c = m.triangles.data() + i, ab = middle(c[0], c[1]), bc = middle(c[1], c[2]),
                   ca = middle(c[2], c[0]);
    for (uint32_t v : {c[0], ab, ca, ab, c[1], bc, ca, bc, c[2], ab, bc, ca}) fine.triangles.push_back(v);
  }
  return fine;
}

// Rows of `around` vertices; the last row closes to the first one if `closed`, else both ends get a pole.
void AddQuads(Mesh& m, int rows, int around, bool closed) {
  const auto id = [&](int row, int k) { return static_cast<uint32_t>(row % rows * around + k % around); };
  for (int row = 0; row + (closed ? 0 : 1) < rows; ++row)
    for (int k = 0; k < around; ++k) {
      const uint32_t a = id(row, k), b = id(row, k + 1), c = id(row + 1, k + 1), d = id(row + 1, k);
      for (uint32_t v : {a, b, c, a, c, d}) m.triangles.push_back(v);
    }
}

double MeanEdge(const Mesh& m) {
  double sum = 0;
  for (size_t i = 0; i < m.triangles.size(); i += 3) {
    const double *p = m.positions.data() + 3 * m.triangles[i], *q = m.positions.data() + 3 * m.triangles[i + 1];
    sum += std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
  }
  return sum * 3 / static_cast<double>(m.triangles.size());
}

double Unit(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

std::vector<uint32_t> Order(uint32_t n, std::mt19937_64& random) {
  std::vector<uint32_t> order(n);
  std::iota(order.begin(), order.end(), 0u);
  for (uint32_t i = n; i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  return order;
}

}  // namespace

Mesh Icosphere(int levels, double radius, double x) {
  Mesh m = Icosahedron();
  for (int i = 0; i < levels; ++i) m = Quartered(m);
  for (size_t i = 0; i < m.positions.size(); ++i) m.positions[i] = radius * m.positions[i] + (i % 3 == 0 ? x : 0);
  return m;
}

Mesh TwoSpheres(int levels) {
  Mesh m = Icosphere(levels, 1, 0);
  Append(m, Icosphere(levels, 1, 0.7310585));
  return m;
}

Mesh NestedShells(int levels, int shells) {
  const double gap = 0.5 * MeanEdge(Icosphere(levels, 1, 0));
  Mesh m;
  for (int i = 0; i < shells; ++i) Append(m, Icosphere(levels, 1 - i * gap, 0));
  return m;
}

Mesh Knot(int along, int around) {
  const double pi = std::numbers::pi, tube = 0.28;
  const auto curve = [](double t) {
    const double r = 2 + tool::cosine(3 * t);
    return std::array{r * tool::cosine(2 * t), r * tool::sine(2 * t), tool::sine(3 * t)};
  };
  Mesh m;
  for (int i = 0; i < along; ++i) {
    const double t = 2 * pi * i / along;
    const auto p = curve(t), q = curve(t + 1e-4);
    const double d[3] = {q[0] - p[0], q[1] - p[1], q[2] - p[2]};
    // Two directions across: away from the axis of the torus, made orthogonal, and their product.
    double u[3] = {p[0] - 2 * tool::cosine(2 * t), p[1] - 2 * tool::sine(2 * t), p[2]};
    const double along_u = (u[0] * d[0] + u[1] * d[1] + u[2] * d[2]) / (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (int k = 0; k < 3; ++k) u[k] -= along_u * d[k];
    double w[3] = {d[1] * u[2] - d[2] * u[1], d[2] * u[0] - d[0] * u[2], d[0] * u[1] - d[1] * u[0]};
    const double lu = std::hypot(u[0], u[1], u[2]), lw = std::hypot(w[0], w[1], w[2]);
    for (int j = 0; j < around; ++j) {
      const double a = 2 * pi * j / around;
      for (size_t k = 0; k < 3; ++k)
        m.positions.push_back(p[k] + tube * (tool::cosine(a) * u[k] / lu + tool::sine(a) * w[k] / lw));
    }
  }
  AddQuads(m, along, around, true);
  return m;
}

Mesh Torus(int along, int around) {
  const double pi = std::numbers::pi;
  Mesh m;
  for (int i = 0; i < along; ++i)
    for (int k = 0; k < around; ++k) {
      const double a = 2 * pi * i / along, b = 2 * pi * k / around, r = 1 + 0.3 * tool::cosine(b);
      m.positions.insert(m.positions.end(), {r * tool::cosine(a), -r * tool::sine(a), 0.3 * tool::sine(b)});
    }
  AddQuads(m, along, around, true);
  return m;
}

Mesh Noisy(Mesh m, double share, uint64_t seed) {
  std::mt19937_64 random(seed);
  const double reach = share * MeanEdge(m);
  for (double& x : m.positions) x += reach * (2 * Unit(random) - 1);
  return m;
}

Mesh Graded(int around) {
  const double pi = std::numbers::pi;
  // Latitudes from one small cap to the other pole so that rows are as high as their edges are long: log tan.
  const double first = tool::logarithm(1.0 / 1000), last = tool::logarithm(tool::tangent(pi / 2 * 0.9));
  const int rows = static_cast<int>((last - first) * around / (2 * pi));
  Mesh m;
  for (int i = 0; i <= rows; ++i) {
    const double polar = 2 * std::atan(tool::exponential(first + (last - first) * i / rows));
    for (int k = 0; k < around; ++k) {
      const double a = -2 * pi * k / around;
      m.positions.insert(m.positions.end(),
                         {tool::sine(polar) * tool::cosine(a), tool::sine(polar) * tool::sine(a), tool::cosine(polar)});
    }
  }
  AddQuads(m, rows + 1, around, false);
  // Two poles.
  const uint32_t n = VertexCount(m);
  const auto ring = [&](int row, int k) { return static_cast<uint32_t>(row * around + k % around); };
  m.positions.insert(m.positions.end(), {0, 0, 1, 0, 0, -1});
  for (int k = 0; k < around; ++k) {
    for (uint32_t v : {n, ring(0, k + 1), ring(0, k)}) m.triangles.push_back(v);
    for (uint32_t v : {n + 1, ring(rows, k), ring(rows, k + 1)}) m.triangles.push_back(v);
  }
  return m;
}

Mesh Shuffled(const Mesh& m, bool triangles, uint64_t seed) {
  std::mt19937_64 random(seed);
  const std::vector<uint32_t> place = Order(VertexCount(m), random);
  Mesh out = m;
  for (uint32_t v = 0; v < VertexCount(m); ++v)
    std::copy_n(m.positions.begin() + 3 * v, 3, out.positions.begin() + 3 * place[v]);
  std::vector<uint32_t> order(TriangleCount(m));
  std::iota(order.begin(), order.end(), 0u);
  if (triangles) order = Order(TriangleCount(m), random);
  for (uint32_t f = 0; f < TriangleCount(m); ++f)
    for (uint32_t i = 0; i < 3; ++i) out.triangles[3 * f + i] = place[m.triangles[3 * order[f] + i]];
  return out;
}

std::vector<NamedMesh> StandardMeshes(uint32_t most) {
  std::vector<NamedMesh> meshes;
  const char* sizes[] = {"2.5k", "10k", "40k", "160k", "640k", "2.5M"};
  for (int i = 0; i < 6; ++i)
    if (2 * (10 * (1u << 2 * (i + 4)) + 2) <= most)
      meshes.push_back({std::string("spheres-") + sizes[i], TwoSpheres(i + 4)});
  if (most >= 200000) {
    meshes.push_back({"shells-160k", NestedShells(5, 16)});
    meshes.push_back({"knot-160k", Knot(5000, 32)});
    meshes.push_back({"noise1-160k", Noisy(Icosphere(7, 1, 0), 0.01, 1)});
    meshes.push_back({"noise10-160k", Noisy(Icosphere(7, 1, 0), 0.1, 2)});
    meshes.push_back({"graded-160k", Graded(320)});
  }
  const size_t coherent = meshes.size();
  for (size_t i = 0; i < coherent; ++i)
    if (meshes[i].name.starts_with("spheres"))
      meshes.push_back({"shuffled-" + meshes[i].name.substr(8), Shuffled(meshes[i].mesh, false, 3)});
  for (size_t i = 0; i < coherent; ++i)
    if (meshes[i].name.starts_with("spheres"))
      meshes.push_back({"shuffled-all-" + meshes[i].name.substr(8), Shuffled(meshes[i].mesh, true, 4)});
  return meshes;
}

}  // namespace bench
