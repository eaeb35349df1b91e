// SPDX-License-Identifier: MIT
#include "tool/segment/forces.h"

#include <algorithm>
#include <cmath>

namespace tool {

namespace {

// Each time the image turns a vertex back, the speed of the vertex is halved; below this part of the full speed the
// vertex is anchored.
constexpr double least_gain = 1.0 / 16;
// A vertex is also anchored after this many moves in a row by less than this part of a voxel's side.
constexpr double rest_distance = 0.03;
constexpr int rest_iterations = 4;

}  // namespace

double drive(const Forces& forces, const Point& at) {
  const Volume& volume = forces.volume;
  const Point p = forces.to_index(at);
  const int size[3] = {volume.nx, volume.ny, volume.nz};
  for (size_t k = 0; k < 3; ++k)
    if (p[k] < -0.5 || p[k] > size[k] - 0.5) return -1;
  return std::clamp(forces.threshold.depth(volume.sample(p[0], p[1], p[2])) / forces.width, -1.0, 1.0);
}

void measure_stars(const std::vector<uint32_t>& triangles, const std::vector<double>& x,
                   const std::vector<Particle>& particles, std::vector<Star>& stars) {
  stars.assign(x.size() / 3, {});
  const auto anchored = [&](uint32_t v) { return particles[v].gain == 0; };
  for (size_t h = 0; h < triangles.size(); h += 3) {
    const uint32_t* c = &triangles[h];
    if (anchored(c[0]) && anchored(c[1]) && anchored(c[2])) continue;
    const Point p[3] = {point_at(&x[3 * size_t{c[0]}]), point_at(&x[3 * size_t{c[1]}]), point_at(&x[3 * size_t{c[2]}])};
    const Point normal = cross(p[1] - p[0], p[2] - p[0]);
    for (size_t i = 0; i < 3; ++i) {
      const size_t next = i == 2 ? 0 : i + 1;
      Star &here = stars[c[i]], &there = stars[c[next]];
      here.normal = here.normal + normal;
      // Each neighbour of a vertex follows it in exactly one of its triangles.
      here.sum = here.sum + p[next];
      ++here.degree;
      const Point edge = p[next] - p[i];
      here.shortest = std::min(here.shortest, dot(edge, edge));
      there.shortest = std::min(there.shortest, dot(edge, edge));
    }
  }
}

bool move_vertex(const Forces& forces, const Star& star, const double* p, Particle& particle, double* next) {
  if (particle.gain == 0) return false;
  const double s = drive(forces, point_at(p));
  if (s * static_cast<double>(particle.last) < 0) {
    const bool slow = static_cast<double>(particle.gain) < 2 * least_gain;
    // A vertex is anchored on the inner side of the border, where grey values may lie on the threshold.
    if (slow && s > 0) {
      particle.gain = 0;
      return false;
    }
    if (!slow) particle.gain *= 0.5f;
  }
  particle.last = static_cast<float>(s);
  const double size_of_normal = length(star.normal);
  const double push = size_of_normal > 0 ? forces.speed * forces.edge_length * s / size_of_normal : 0;
  const double gain = static_cast<double>(particle.gain);
  double move[3], size = 0;
  for (size_t k = 0; k < 3; ++k) {
    const double pull = star.sum[k] / star.degree - p[k];
    move[k] = gain * (push * star.normal[k] + forces.tension * pull);
    size += move[k] * move[k];
  }
  particle.resting = size < rest_distance * rest_distance * forces.voxel * forces.voxel ? particle.resting + 1 : 0;
  if (particle.resting >= rest_iterations) {
    particle.gain = 0;
    return false;
  }
  const double most = 0.5 * std::sqrt(star.shortest);
  const double scale = size > most * most ? most / std::sqrt(size) : 1;
  for (int k = 0; k < 3; ++k) next[k] = std::nearbyint((p[k] + scale * move[k]) / forces.grid) * forces.grid;
  return true;
}

}  // namespace tool
