// SPDX-License-Identifier: MIT
// Motions whose result is known, or which go on for long: growing and shrinking, and flows.
#include <algorithm>

#include "tool/scenes/elementary.h"
#include "tool/scenes/scene.h"
#include "tool/scenes/shapes.h"
#include "tool/scenes/sphere.h"
#include "tool/topology.h"

namespace tool {

namespace {

using Field = std::function<Point(const Point& at, double time)>;

// The classical method of fourth order.
Point carried_along(const Field& field, const Point& p, double time, double step) {
  const Point a = field(p, time), b = field(p + step / 2 * a, time + step / 2);
  const Point c = field(p + step / 2 * b, time + step / 2), d = field(p + step * c, time + step);
  return p + step / 6 * (a + 2 * b + 2 * c + d);
}

Motion flow(const Field& field) {
  return [field](const Moment& m, std::vector<double>& targets) {
    for (size_t v = 0; v < m.vertices(); ++v) {
      const Point p = carried_along(field, m.position(v), m.time, m.step);
      std::copy(p.begin(), p.end(), targets.begin() + static_cast<std::ptrdiff_t>(3 * v));
    }
  };
}

struct Symmetric {
  double a[3][3] = {};
};

// Eigenvalues and unit eigenvectors (columns of `vectors`) by Jacobi's rotations.
void eigen(Symmetric& m, double (&values)[3], double (&vectors)[3][3]) {
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) vectors[i][k] = i == k ? 1 : 0;
  const auto aside = [&] { return m.a[0][1] * m.a[0][1] + m.a[0][2] * m.a[0][2] + m.a[1][2] * m.a[1][2]; };
  const double trace = m.a[0][0] + m.a[1][1] + m.a[2][2];
  while (aside() > 1e-28 * trace * trace)
    for (int p = 0; p < 2; ++p)
      for (int q = p + 1; q < 3; ++q) {
        if (m.a[p][q] == 0) continue;
        const double angle = 0.5 * arc_tangent(2 * m.a[p][q], m.a[q][q] - m.a[p][p]);
        const double c = cosine(angle), s = sine(angle);
        for (auto* rows : {&m.a, &vectors})
          for (auto& row : *rows) {
            const double x = row[p], y = row[q];
            row[p] = c * x - s * y;
            row[q] = s * x + c * y;
          }
        for (int k = 0; k < 3; ++k) {
          const double x = m.a[p][k], y = m.a[q][k];
          m.a[p][k] = c * x - s * y;
          m.a[q][k] = s * x + c * y;
        }
      }
  for (int i = 0; i < 3; ++i) values[i] = m.a[i][i];
}

// Each face moves along its normal by `way`. Each vertex goes to the point where the moved planes of its faces meet, in
// the sense of least squares weighted by the angles at the vertex (face offsetting, Jiao 2007). Eigenvectors of the
// normals' outer products with small eigenvalues are left out: along them the planes leave the vertex free. An edge
// whose faces move apart would stay sharp; its vertices go no further than the faces (Huygens).
void offset_faces(const Moment& m, double way, std::vector<double>& targets) {
  // On a smooth surface planes meet a little beyond their own distance.
  constexpr double furthest = 1.02;
  // Less of the largest eigenvalue than this is noise of a smooth surface (Jiao 2007, section 3.2).
  constexpr double smallest_eigenvalue = 0.003;
  const size_t n = m.vertices();
  std::vector<Symmetric> outer(n);
  std::vector<Point> sum(n, Point{}), bend(n, Point{});  // of the normals; of the ways to the neighbours
  for (size_t f = 0; f < m.triangles.size(); f += 3) {
    const Point corner[3] = {m.position(m.triangles[f]), m.position(m.triangles[f + 1]),
                             m.position(m.triangles[f + 2])};
    const Point normal = cross(corner[1] - corner[0], corner[2] - corner[0]);
    if (dot(normal, normal) == 0) continue;
    const Point u = unit(normal);
    for (size_t i = 0; i < 3; ++i) {
      const Point a = corner[(i + 1) % 3] - corner[i], b = corner[(i + 2) % 3] - corner[i];
      const double angle = arc_tangent(length(cross(a, b)), dot(a, b));
      const uint32_t v = m.triangles[f + i];
      sum[v] = sum[v] + angle * u;
      bend[v] = bend[v] + a + b;
      for (size_t r = 0; r < 3; ++r)
        for (size_t c = 0; c < 3; ++c) outer[v].a[r][c] += angle * u[r] * u[c];
    }
  }
  for (size_t v = 0; v < n; ++v) {
    double values[3], vectors[3][3];
    eigen(outer[v], values, vectors);
    const double most = std::max({values[0], values[1], values[2]});
    Point move{};
    for (size_t k = 0; k < 3; ++k) {
      if (!(values[k] > smallest_eigenvalue * most)) continue;
      const Point e{vectors[0][k], vectors[1][k], vectors[2][k]};
      move = move + way * dot(e, sum[v]) / values[k] * e;
    }
    const bool fans_out = (dot(bend[v], sum[v]) > 0) == (way < 0);
    if (fans_out && length(move) > furthest * std::fabs(way)) move = furthest * std::fabs(way) * unit(move);
    for (size_t i = 0; i < 3; ++i) targets[3 * v + i] += move[i];
  }
}

// Each collapse takes some volume away: the fewer, the better.
void suffer_short_edges(Scene& s) {
  s.split_ratio = 1.4;
  s.collapse_ratio = 0.4;
}

// Sines with random wave vectors and phases as a vector potential; the flow is its curl. Wavelengths follow the noise
// of the smoke in Bridson et al. 2007: 1.5, and half of it with half the gain.
struct CurlNoise {
  struct Wave {
    Point k, amplitude;
    double phase;
  };
  std::vector<Wave> waves;

  explicit CurlNoise(uint64_t seed) {
    Dice dice(seed);
    for (int octave = 0; octave < 2; ++octave)
      for (int i = 0; i < 6; ++i) {
        const double wavelength = octave == 0 ? 1.5 : 0.75, gain = octave == 0 ? 0.02 : 0.005;
        waves.push_back({2 * pi / wavelength * dice.direction(), gain * dice.direction(), dice.uniform(0, 2 * pi)});
      }
  }
  // The curl of amplitude sin(k p + phase) is k x amplitude cos(k p + phase).
  Point operator()(const Point& p, double) const {
    Point sum{};
    for (const Wave& w : waves) sum = sum + cosine(dot(w.k, p) + w.phase) * cross(w.k, w.amplitude);
    return sum;
  }
};

}  // namespace

// Enright et al. 2002 (after LeVeque 1996): out for half of the time, and back.
Scene make_enright(uint64_t) {
  constexpr double period = 3, edge = 0.01;
  Scene s;
  s.mesh = make_sphere({0.35, 0.35, 0.35}, 0.15, static_cast<int>(std::lround(pi / 2 * 0.15 / edge)));
  s.motion = flow([](const Point& p, double time) {
    const auto once = [](double a) { return sine(pi * a); };
    const auto twice = [](double a) { return sine(2 * pi * a); };
    const double x = p[0], y = p[1], z = p[2], now = cosine(pi * time / period);
    return now * Point{2 * once(x) * once(x) * twice(y) * twice(z), -twice(x) * once(y) * once(y) * twice(z),
                       -twice(x) * twice(y) * once(z) * once(z)};
  });
  s.edge_length = edge;
  suffer_short_edges(s);
  s.step = 0.01;
  s.duration = period;
  s.end = SceneEnd{{0}};
  s.volume = parts_of(s.mesh)[0].volume;
  s.volume_tolerance = 0.005;
  return s;
}

Scene make_curl_noise(uint64_t seed) {
  constexpr double edge = 0.06;
  Scene s;
  s.mesh = make_sphere({0, 0, 0}, 0.5, static_cast<int>(std::lround(pi / 2 * 0.5 / edge)));
  s.motion = flow(CurlNoise(seed));
  s.edge_length = edge;
  suffer_short_edges(s);
  s.step = 0.05;
  s.duration = 30;
  return s;
}

namespace {

// Two spheres of radius .2 at (+-.25, 0, 0): their surface moves out at speed .2 until t = 1, then in until `until`.
Scene grow_and_shrink(double until, double volume) {
  constexpr double radius = 0.2, speed = 0.2, edge = 0.02;
  Scene s;
  for (const double x : {-0.25, 0.25})
    append(s.mesh, make_sphere({x, 0, 0}, radius, static_cast<int>(std::lround(pi / 2 * radius / edge))));
  s.motion = [](const Moment& m, std::vector<double>& targets) {
    offset_faces(m, (m.time + m.step / 2 < 1 ? speed : -speed) * m.step, targets);
  };
  s.edge_length = edge;
  s.step = 0.005;
  s.duration = until;
  s.end = SceneEnd{{0}};
  s.volume = volume;
  s.volume_tolerance = 0.01;
  return s;
}

}  // namespace

Scene make_grow(uint64_t) { return grow_and_shrink(1, 0.4866851); }
Scene make_grow_and_shrink(uint64_t) { return grow_and_shrink(2, 0.0734668); }

}  // namespace tool
