// SPDX-License-Identifier: MIT
#include "support/random_commits.h"

#include <cmath>

#include "support/field_shapes.h"
#include "support/tangle_shapes.h"

namespace support {

namespace {

Mesh RandomBody(Random& random) {
  switch (random() % 5) {
    case 0: return Torus({0, 0, 0}, 1, Uniform(random, .2, .5), WholeIn(random, 8, 24), WholeIn(random, 4, 9));
    case 1: return Bumpy(.3, WholeIn(random, 2, 6), random);
    case 2: return Stick(Uniform(random, .1, .5), Uniform(random, 1, 4), WholeIn(random, 4, 9));
    case 3:
      return Slab(Uniform(random, .3, 2), Uniform(random, .3, 2), Uniform(random, .1, 1), Uniform(random, .2, .5));
    default: return Sphere({0, 0, 0}, Uniform(random, .3, 1), WholeIn(random, 1, 6));
  }
}

// Pushes a place, pinches a waist, or shakes everything.
Mesh Moved(const Mesh& m, Random& random) {
  const Point place = PositionOf(m, random() % VertexCount(m)), way = RandomPoint(random, -1, 1);
  const uint64_t kind = random() % 4;
  const double reach = Uniform(random, .2, .8), shake = Uniform(random, .01, .15);
  return Mapped(m, [&](Point p) {
    const double far = kind == 0 ? std::abs(p[2] - place[2]) / .2 : Distance(p, place) / reach;
    for (size_t k = 0; k < 3; ++k)
      if (kind == 3)
        p[k] += Uniform(random, -shake, shake);
      else if (far < 1 && kind > 0)
        p[k] += (1 - far) * way[k];
      else if (far < 1 && k < 2 && std::abs(p[k] - place[k]) < 1)
        p[k] = place[k] + (far - .3 * (1 - far)) * (p[k] - place[k]);
    return p;
  });
}

tpa_status Commit(tpa_context* context, Random& random, bool first, RandomCommit& commit) {
  const uint64_t kind = first ? 0 : random() % 8;
  if (kind == 0) {
    commit.kind = "adapt";
    return tpa_adapt(context, nullptr, nullptr, nullptr);
  }
  if (kind == 1) {
    commit.kind = "smooth";
    auto all = Sized<tpa_smooth_options>();
    all.iterations = static_cast<uint32_t>(WholeIn(random, 0, 5));
    return tpa_smooth(context, &all, nullptr, nullptr, nullptr);
  }
  if (kind == 2) {
    commit.kind = "remesh";
    auto options = Sized<tpa_remesh_options>();
    options.iterations = static_cast<uint32_t>(Coin(random) ? WholeIn(random, 1, 12) : WholeIn(random, 1, 100));
    options.target_length = Uniform(random, .5, 2) * MeanEdgeOf(commit.before);
    options.relaxation = Coin(random) ? Uniform(random, 0, 1) : 0;
    return tpa_remesh(context, &options, nullptr, nullptr, nullptr);
  }
  if (kind == 3) {
    commit.kind = "reorder";
    return tpa_reorder(context, nullptr);
  }
  commit.kind = "step";
  commit.targets = Moved(commit.before, random);
  EXPECT_EQ(MoveAll(context, commit.targets.positions), TPA_OK);
  return tpa_step(context, nullptr, nullptr, nullptr);
}

}  // namespace

Mesh RandomScene(Random& random) {
  std::vector<Mesh> bodies;
  const int count = WholeIn(random, 1, 5);
  for (int i = 0; i < count; ++i)
    bodies.push_back(Translated(RandomlyTurned(RandomBody(random), random), RandomPoint(random, -1.2, 1.2)));
  return Renumbered(Together(bodies), random);
}

void PlayRandomCommits(uint64_t seed, int commits, const std::function<void(tpa_context*, const RandomCommit&)>& look) {
  Random random(seed);
  const Mesh scene = RandomScene(random);
  tpa_config config = DefaultConfig(12 * VertexCount(scene) + 2000);
  config.max_contacts = 1 << 14;
  config.max_cut_edges = 1 << 14;
  config.max_pieces = 1 << 17;
  const Arena arena(config, scene);
  for (int i = 0; i < commits; ++i) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", commit " + std::to_string(i));
    RandomCommit commit{MeshOf(*arena), MeshOf(*arena), ""};
    if (commit.before.positions.empty()) return;
    const tpa_status status = Commit(*arena, random, i == 0, commit);
    if (status == TPA_E_LIMIT || status == TPA_E_TANGLED) return;  // crumpled beyond the room, or left tangled
    ASSERT_EQ(status, TPA_OK) << commit.kind;
    look(*arena, commit);
  }
}

}  // namespace support
