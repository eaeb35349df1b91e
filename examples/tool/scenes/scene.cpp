// SPDX-License-Identifier: MIT
#include "tool/scenes/scene.h"

#include <algorithm>
#include <memory>
#include <numeric>

#include "tool/scenes/shapes.h"

namespace tool {

namespace {

constexpr SceneKind kinds[] = {
    {"merging-pair", "two deformed spheres that move into each other; the surface is that of their union",
     make_merging_pair},
    {"ramming-pair", "the same, but each vertex goes straight on with its body", make_ramming_pair},
    {"meeting-3", "3 spindles whose tips reach one point in the same step", make_meeting_3},
    {"meeting-4", "4 spindles whose tips reach one point in the same step", make_meeting_4},
    {"meeting-5", "5 spindles whose tips reach one point in the same step", make_meeting_5},
    {"meeting-8", "8 spindles whose tips reach one point in the same step", make_meeting_8},
    {"balls-2", "2 balls that grow; the surface is that of their union", make_balls_2},
    {"balls-3", "3 balls that grow; the surface is that of their union", make_balls_3},
    {"balls-4", "4 balls that grow; the surface is that of their union", make_balls_4},
    {"balls-5", "5 balls that grow; the surface is that of their union", make_balls_5},
    {"balls-6", "6 balls that grow; the surface is that of their union", make_balls_6},
    {"balls-7", "7 balls that grow; the surface is that of their union", make_balls_7},
    {"balls-8", "8 balls that grow; the surface is that of their union", make_balls_8},
    {"balls-cube", "8 balls at the corners of a cube that grow; the surface is that of their union", make_balls_cube},
    {"balls-100", "100 balls that grow; the surface is that of their union", make_balls_100},
    {"balls-1000", "1000 balls that grow; the surface is that of their union", make_balls_1000},
    {"dumbbell", "two balls and a neck under mean curvature: the neck pinches off", make_dumbbell},
    {"tube", "a tube of any length that shrinks at its middle and necks off", make_tube},
    {"shell", "a bowl that is pierced from both sides", make_shell},
    {"ring", "a ring whose hole closes", make_ring},
    {"vanish", "a ball that shrinks to nothing beside another", make_vanish},
    {"grow", "two spheres whose surface moves out along its normals, to a known volume", make_grow},
    {"grow-and-shrink", "the same, and in again, to a known volume", make_grow_and_shrink},
    {"enright", "a sphere in the flow of Enright et al. 2002, out and back", make_enright},
    {"curl-noise", "a sphere in a flow that is the curl of noise", make_curl_noise},
};

std::vector<uint32_t> shuffled(size_t n, Dice& dice) {
  std::vector<uint32_t> order(n);
  std::iota(order.begin(), order.end(), 0u);
  for (size_t i = n; i > 1; --i) std::swap(order[i - 1], order[dice.below(i)]);
  return order;
}

// A point turned by one of the 24 rotations: permutation of the axes and signs with determinant 1.
struct Turn {
  int axis[3];
  double sign[3];
  Point operator()(const Point& p) const {
    Point q;
    for (size_t i = 0; i < 3; ++i) q[i] = sign[i] * p[static_cast<size_t>(axis[i])];
    return q;
  }
  Turn back() const {
    Turn t{};
    for (int i = 0; i < 3; ++i) {
      t.axis[axis[i]] = i;
      t.sign[axis[i]] = sign[i];
    }
    return t;
  }
};

Turn turn_number(int rotation) {
  constexpr int axes[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  const int permutation = rotation / 4 % 6, signs = rotation % 4;
  Turn t{};
  for (int i = 0; i < 3; ++i) {
    t.axis[i] = axes[permutation][i];
    t.sign[i] = signs != 0 && i != signs - 1 ? -1 : 1;
  }
  if (permutation >= 3)
    for (double& s : t.sign) s = -s;
  return t;
}

}  // namespace

std::span<const SceneKind> scene_kinds() { return kinds; }

Status make_scene(std::string_view name, uint64_t seed, Scene& scene) {
  for (const SceneKind& kind : kinds)
    if (name == kind.name) {
      scene = kind.make(seed);
      scene.name = text_of(kind.name, "-", seed);
      return success();
    }
  return failure("unknown scene \"", name, "\"; topoadapt evolve --list lists all scenes");
}

Scene renumbered(const Scene& scene, uint64_t seed) {
  Dice dice(seed);
  Scene s = scene;
  s.name += text_of("-renumbered-", seed);
  const size_t n = vertex_count(s.mesh), width = s.carried_width;
  const std::vector<uint32_t> place = shuffled(n, dice), order = shuffled(s.mesh.triangles.size() / 3, dice);
  for (size_t v = 0; v < n; ++v) {
    set_position(s.mesh, place[v], position_of(scene.mesh, v));
    for (size_t i = 0; i < width; ++i) s.carried[width * place[v] + i] = scene.carried[width * v + i];
  }
  for (size_t f = 0; f < order.size(); ++f) {
    const size_t first = dice.below(3);
    for (size_t i = 0; i < 3; ++i)
      s.mesh.triangles[3 * order[f] + i] = place[scene.mesh.triangles[3 * f + (i + first) % 3]];
  }
  return s;
}

Scene turned(const Scene& scene, int rotation) {
  const Turn turn = turn_number(rotation), back = turn.back();
  Scene s = scene;
  s.name += text_of("-turned-", rotation);
  transform(s.mesh, turn);
  s.motion = [turn, back, motion = scene.motion](const Moment& moment, std::vector<double>& targets) {
    TriangleMesh unturned;
    unturned.positions.assign(moment.positions.begin(), moment.positions.end());
    transform(unturned, back);
    Moment m = moment;
    m.positions = unturned.positions;
    TriangleMesh aims;
    aims.positions = unturned.positions;
    motion(m, aims.positions);
    transform(aims, turn);
    targets = std::move(aims.positions);
  };
  return s;
}

}  // namespace tool
