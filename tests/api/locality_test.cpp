// SPDX-License-Identifier: MIT
// Only what meets matters (P3'): a scene beside bodies that it does not meet ends with the same bits as alone, but for
// ids. `locality_figures` counts more seeds.
#include "support/locality_trial.h"
#include "support/share.h"

namespace locality_test {
namespace {

using namespace support;

class Locality : public testing::TestWithParam<NearFamily> {};
class LocalityLong : public Locality {};

void PlaySeeds(const NearFamily& family, uint64_t from, uint64_t to, size_t kinds) {
  uint64_t met = 0;
  for (uint64_t seed = from; seed <= to; ++seed) {
    const LocalityTrial t = PlayLocality(family, seed, kinds);
    met += t.meets ? 1 : 0;
    for (const auto& d : t.differences) {
      const std::string name = family.name + "-" + std::to_string(seed);
      const MeshOnFailure scene(name, t.scene.mesh), alone(name + "-alone", d.alone),
          beside(name + "-" + d.kind, d.beside);
      ADD_FAILURE() << name << " beside " << d.kind << ": " << d.what;
    }
  }
  EXPECT_GT(met, (to - from + 1) / 4);
}

TEST_P(Locality, SceneEndsAsAlone) { PlaySeeds(GetParam(), 1, Share(17u), 4); }
TEST_P(LocalityLong, SceneEndsAsAlone) { PlaySeeds(GetParam(), 1001, 1167, BesideKinds().size()); }

std::string NameOf(const testing::TestParamInfo<NearFamily>& info) {
  std::string name = info.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

// The judge itself: one vertex of an octahedron moves into a body beside it, or stops short of it.
TEST(LocalityJudge, SeesABodyThatMeetsTheScene) {
  NearScene scene{Sphere({0, 0, 0}, 1, 1), {}};
  scene.targets = scene.mesh.positions;
  for (size_t i = 2; i < scene.targets.size(); i += 3) scene.targets[i] += scene.targets[i] == 1 ? 0.5 : 0;
  const auto body_at = [](double z) { return Beside{Translated(Sphere({}, 0.5, 3), {0.01, 0.02, z}), {}, z - 0.51}; };
  const auto meshes_differ = [&](double z) { return DifferenceBeside(scene, body_at(z)).rfind("mesh", 0) == 0; };
  EXPECT_FALSE(meshes_differ(2.1));
  EXPECT_TRUE(meshes_differ(1.9));
}

INSTANTIATE_TEST_SUITE_P(Scenes, Locality, testing::ValuesIn(NearFamilies()), NameOf);
INSTANTIATE_TEST_SUITE_P(Scenes, LocalityLong, testing::ValuesIn(NearFamilies()), NameOf);

}  // namespace
}  // namespace locality_test
