// SPDX-License-Identifier: MIT
#include "contact_scenes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tool/scenes/elementary.h"

namespace figures {

namespace {

using namespace support;

int RandomInt(Random& random, int low, int high) {
  return low + static_cast<int>(random() % static_cast<uint64_t>(high - low + 1));
}

Point RandomDirection(Random& random) {
  for (;;) {
    const Point p = RandomPoint(random, -1, 1);
    const double square = Dot(p, p);
    if (square > 0.01 && square <= 1) return Scaled(1 / std::sqrt(square), p);
  }
}

uint32_t AddVertex(Mesh& m, const Point& p) {
  m.positions.insert(m.positions.end(), p.begin(), p.end());
  return VertexCount(m) - 1;
}
void AddTriangle(Mesh& m, uint32_t a, uint32_t b, uint32_t c) { m.triangles.insert(m.triangles.end(), {a, b, c}); }
// Either diagonal, so that vertices have from four to eight edges.
void AddQuad(Mesh& m, uint32_t a, uint32_t b, uint32_t c, uint32_t d, Random& random) {
  const bool other = (random() >> 40) & 1;
  AddTriangle(m, a, b, other ? d : c);
  AddTriangle(m, other ? b : a, c, d);
}

// A surface of revolution round the z axis: a pole, rings of (radius, height) downwards, a pole.
Mesh Revolved(const std::vector<std::array<double, 2>>& rings, double top, double bottom, uint32_t sides,
              Random& random) {
  Mesh m;
  for (const auto& [radius, height] : rings)
    for (uint32_t k = 0; k < sides; ++k) {
      const double a = 2 * pi * k / sides;
      AddVertex(m, {radius * tool::cosine(a), radius * tool::sine(a), height});
    }
  const uint32_t first = AddVertex(m, {0, 0, top}), last = AddVertex(m, {0, 0, bottom});
  const auto ring_count = static_cast<uint32_t>(rings.size());
  for (uint32_t k = 0; k < sides; ++k) {
    const uint32_t next = (k + 1) % sides;
    AddTriangle(m, first, k, next);
    for (uint32_t i = 0; i + 1 < ring_count; ++i)
      AddQuad(m, i * sides + k, (i + 1) * sides + k, (i + 1) * sides + next, i * sides + next, random);
    AddTriangle(m, last, (ring_count - 1) * sides + next, (ring_count - 1) * sides + k);
  }
  return m;
}

Mesh Jittered(Mesh m, double by, Random& random) {
  for (double& x : m.positions) x += Uniform(random, -by, by);
  return m;
}

// z becomes -outwards, turned about it at random.
Mesh Turned(Mesh m, const Point& outwards, Random& random) {
  const Point z = Scaled(-1, outwards), x = Unit(Cross(z, RandomDirection(random)));
  const Point y = Cross(z, x);
  for (size_t v = 0; v < VertexCount(m); ++v) {
    const Point p = PositionOf(m, v);
    for (size_t i = 0; i < 3; ++i) m.positions[3 * v + i] = p[0] * x[i] + p[1] * y[i] + p[2] * z[i];
  }
  return m;
}

// Where parts may lie: sheets fill half of space, tubes and balls need a cone.
bool HaveRoom(const std::vector<Point>& outwards, bool sheet_first) {
  for (size_t i = 0; i < outwards.size(); ++i)
    for (size_t k = 0; k < i; ++k)
      if (Dot(outwards[i], outwards[k]) > (sheet_first && k == 0 ? -0.25 : 0.3)) return false;
  return true;
}

}  // namespace

Mesh RandomTube(Random& random) {
  const auto sides = static_cast<uint32_t>(RandomInt(random, 3, 7));
  const double radius = sides / (2 * pi) * Uniform(random, 0.8, 1.2);
  std::vector<std::array<double, 2>> rings;
  double height = -Uniform(random, 0.3, 0.9);
  rings.push_back({radius * Uniform(random, 0.5, 0.9), height});
  for (int i = 0; i < 4; ++i) {
    height -= Uniform(random, 0.8, 1.1);
    rings.push_back({radius * Uniform(random, 0.85, 1.15), height});
  }
  return Jittered(Revolved(rings, 0, height - 0.4, sides, random), 0.1, random);
}

Mesh RandomBall(Random& random) {
  const auto sides = static_cast<uint32_t>(RandomInt(random, 4, 7));
  const double radius = sides / (2 * pi) * Uniform(random, 1.0, 1.3);
  const int bands = RandomInt(random, 3, 4);
  std::vector<std::array<double, 2>> rings;
  for (int i = 1; i < bands; ++i)
    rings.push_back({radius * tool::sine(pi * i / bands), radius * tool::cosine(pi * i / bands)});
  const Mesh ball = Jittered(Revolved(rings, radius, -radius, sides, random), 0.1, random);
  return Translated(Turned(ball, RandomDirection(random), random), {0, 0, -radius});
}

Mesh RandomSheet(Random& random) {
  constexpr uint32_t cells = 7, row = cells + 1;
  Mesh m;
  const double dx = Uniform(random, -0.5, 0.5), dy = Uniform(random, -0.5, 0.5);
  for (double z : {0.0, -1.5})
    for (uint32_t j = 0; j <= cells; ++j)
      for (uint32_t i = 0; i <= cells; ++i)
        AddVertex(m, {i - 0.5 * cells + dx, j - 0.5 * cells + dy, z + Uniform(random, -0.25, 0.05)});
  constexpr uint32_t below = row * row;
  for (uint32_t j = 0; j < cells; ++j)
    for (uint32_t i = 0; i < cells; ++i) {
      const uint32_t a = j * row + i, b = a + 1, c = b + row, d = a + row;
      AddQuad(m, a, b, c, d, random);
      AddQuad(m, below + a, below + d, below + c, below + b, random);
    }
  // The rim, counterclockwise as seen from above.
  std::vector<uint32_t> rim;
  for (uint32_t t = 0; t < cells; ++t) rim.push_back(t);
  for (uint32_t t = 0; t < cells; ++t) rim.push_back(t * row + cells);
  for (uint32_t t = cells; t > 0; --t) rim.push_back(cells * row + t);
  for (uint32_t t = cells; t > 0; --t) rim.push_back(t * row);
  for (size_t t = 0; t < rim.size(); ++t) {
    const uint32_t a = rim[t], b = rim[(t + 1) % rim.size()];
    AddQuad(m, a, below + a, below + b, b, random);
  }
  return Jittered(m, 0.12, random);
}

Scene RandomScene(int parts, uint64_t seed) {
  Random random(seed);
  Scene scene;
  const bool sheet = random() % 2 == 0;
  do {
    scene.outwards.clear();
    for (int i = 0; i < parts; ++i) scene.outwards.push_back(RandomDirection(random));
  } while (!HaveRoom(scene.outwards, sheet));
  for (int i = 0; i < parts; ++i) {
    const bool tube = random() % 3 != 0;
    const Mesh part = sheet && i == 0 ? RandomSheet(random) : tube ? RandomTube(random) : RandomBall(random);
    const Point& outwards = scene.outwards[static_cast<size_t>(i)];
    scene.parts.push_back(Translated(Turned(part, outwards, random), RandomPoint(random, -0.2, 0.2)));
    scene.depths.push_back(Uniform(random, 0.01, 0.3));
  }
  return scene;
}

}  // namespace figures
