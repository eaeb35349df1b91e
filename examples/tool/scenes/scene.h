// SPDX-License-Identifier: MIT
// scene: surfaces that move in a known way until their topology changes, each with the topology expected at its end. A
// scene is made from a name and a seed. Its motion sees the present mesh and sets the targets of the vertices.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tool/io/mesh_io.h"
#include "tool/result.h"
#include "tool/scenes/points.h"

namespace tool {

// Input of a scene's motion.
struct Moment {
  double time = 0;  // now
  double step = 0;  // targets are for time + step
  std::span<const double> positions;
  std::span<const uint32_t> triangles;
  std::span<const double> carried;  // Scene::carried, interpolated at new vertices

  size_t vertices() const { return positions.size() / 3; }
  Point position(size_t v) const { return {positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]}; }
};

// Writes a target for each vertex: x, y, z.
using Motion = std::function<void(const Moment& moment, std::vector<double>& targets)>;

// The end of a scene, if known.
struct SceneEnd {
  std::vector<long> genera;  // of the components, ascending
  bool operator==(const SceneEnd&) const = default;
};

// A union of equal balls: its Betti numbers are the scene's end, for callers able to compute them.
struct BallUnion {
  std::vector<Point> centers;
  double radius = 0;  // at the end
  double margin = 0;  // radii closer to each other look alike at the scene's resolution
};

struct Scene {
  std::string name;
  TriangleMesh mesh;
  uint32_t carried_width = 0;   // numbers carried along by each vertex
  std::vector<double> carried;  // carried_width for each vertex of the mesh
  Motion motion;
  double step = 0;  // of time
  double duration = 0;
  bool whole_steps = false;  // long steps are the subject of the scene: never cut
  bool any_step = false;     // it ends the same with longer steps: the targets are places, whatever the mesh is like
  double edge_length = 0;    // edge length of remeshing after every step; 0: never
  double split_ratio = 0, collapse_ratio = 0;  // as in tpa_remesh_options
  std::optional<SceneEnd> end;
  std::optional<BallUnion> balls;
  double volume = 0;            // at the end; 0: not known
  double volume_tolerance = 0;  // relative
};

struct SceneKind {
  const char* name;
  const char* line;  // description in one line
  Scene (*make)(uint64_t seed);
};

// All kinds, in order of listing.
std::span<const SceneKind> scene_kinds();

// Fails for an unknown name.
Status make_scene(std::string_view name, uint64_t seed, Scene& scene);

// The same scene with vertices and triangles in another order, turned by one of the 24 exact rotations that permute the
// axes.
Scene renumbered(const Scene& scene, uint64_t seed);
Scene turned(const Scene& scene, int rotation);

// The makers, by family.
Scene make_merging_pair(uint64_t seed);
Scene make_ramming_pair(uint64_t seed);
Scene make_meeting_3(uint64_t seed);
Scene make_meeting_4(uint64_t seed);
Scene make_meeting_5(uint64_t seed);
Scene make_meeting_8(uint64_t seed);
Scene make_dumbbell(uint64_t seed);
Scene make_tube(uint64_t seed);
Scene make_shell(uint64_t seed);
Scene make_ring(uint64_t seed);
Scene make_vanish(uint64_t seed);
Scene make_grow(uint64_t seed);
Scene make_grow_and_shrink(uint64_t seed);
Scene make_enright(uint64_t seed);
Scene make_curl_noise(uint64_t seed);
Scene make_balls_2(uint64_t seed);
Scene make_balls_3(uint64_t seed);
Scene make_balls_4(uint64_t seed);
Scene make_balls_5(uint64_t seed);
Scene make_balls_6(uint64_t seed);
Scene make_balls_7(uint64_t seed);
Scene make_balls_8(uint64_t seed);
Scene make_balls_cube(uint64_t seed);
Scene make_balls_100(uint64_t seed);
Scene make_balls_1000(uint64_t seed);

}  // namespace tool
