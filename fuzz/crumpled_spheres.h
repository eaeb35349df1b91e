// SPDX-License-Identifier: MIT
// crumpled_spheres: bytes become a context's limits, a few crumpled, overlapping spheres, and their motion.
#pragma once

#include <vector>

#include "bytes.h"
#include "tool/io/mesh_io.h"
#include "tool/scenes/sphere.h"
#include "topoadapt.h"

namespace fuzz {

inline tpa_config CrumpledConfig(Bytes& in) {
  tpa_config config;
  tpa_config_init(&config, sizeof config);
  config.max_vertices = 1024u + 16u * in.Byte();
  config.max_candidates = 1u + in.Byte() % 64;
  config.max_contacts = config.max_vertices / 2 * (1u + in.Byte() % 8);
  return config;
}

inline tool::TriangleMesh CrumpledSpheres(Bytes& in) {
  tool::TriangleMesh scene;
  const int balls = 1 + in.Byte() % 4;
  const double crumple = 0.01 * in.Byte();
  for (int b = 0; b < balls; ++b) {
    const double center[3] = {in.Around(3), in.Around(3), in.Around(3)};
    const tool::TriangleMesh ball = tool::make_sphere(center, 0.5 + in.Byte() / 64.0, 2 + in.Byte() % 4);
    const auto first = static_cast<uint32_t>(scene.positions.size() / 3);
    for (const double c : ball.positions) scene.positions.push_back(c + in.Around(crumple));
    for (const uint32_t v : ball.triangles) scene.triangles.push_back(first + v);
  }
  return scene;
}

// Moves all vertices at random, and half of them through the others.
inline void MoveAbout(Bytes& in, std::vector<double>& positions) {
  const double reach = 0.02 * in.Byte();
  const double drift[3] = {in.Around(1), in.Around(1), in.Around(1)};
  for (size_t i = 0; i < positions.size(); ++i) {
    const bool swept = i / 3 < positions.size() / 6;
    positions[i] += in.Around(reach) + (swept ? drift[i % 3] : 0);
  }
}

}  // namespace fuzz
