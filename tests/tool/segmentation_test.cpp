// SPDX-License-Identifier: MIT
// The main job: the phantoms of the paper's section 6 come out with their topology, near their surface, and clean.
#include "tool/segment/segmentation.h"

#include <gtest/gtest.h>

#include "support/mesh_on_failure.h"

namespace segmentation_test {
namespace {

struct Expected {
  const char* phantom;
  uint64_t noise_seed;
};

std::string NameOf(const testing::TestParamInfo<Expected>& test) {
  std::string name = test.param.phantom;
  for (char& c : name)
    if (c == '-') c = '_';
  return name + "_" + std::to_string(test.param.noise_seed);
}

class PaperPhantoms : public testing::TestWithParam<Expected> {};

TEST_P(PaperPhantoms, ComeOutWithTheirTopology) {
  tool::Segmentation s;
  const tool::Status made = tool::prepare_phantom(GetParam().phantom, GetParam().noise_seed, s);
  ASSERT_TRUE(made.ok) << made.message;
  const tool::Status done = tool::run_segmentation(s, {});
  const support::MeshOnFailure judged("segmented", s.mesh);
  ASSERT_TRUE(done.ok) << done.message;
  std::vector<int> genera;
  for (const tool::Part& p : s.parts) genera.push_back(static_cast<int>(p.genus));
  EXPECT_EQ(genera, s.phantom->genera);
  EXPECT_EQ(s.self_intersections, 0u);
  EXPECT_EQ(s.result.ended, tool::Ended::at_rest);
  EXPECT_GE(s.filling.share(), 0.93);  // noise makes half of the voxels on the surface voxels of the object
  // Voxels; the bounds are promises of the project.
  EXPECT_LE(s.mean_distance, 0.5);
  EXPECT_LE(s.largest_distance, 2.0);
}

INSTANTIATE_TEST_SUITE_P(Section6, PaperPhantoms, testing::Values(Expected{"genus-3", 1}, Expected{"torus-nested", 1}),
                         NameOf);
INSTANTIATE_TEST_SUITE_P(Section6Long, PaperPhantoms,
                         testing::Values(Expected{"cube-cavity", 1}, Expected{"cyst", 1},
                                         // Once stuck behind the rod, at a crease that no cap would close.
                                         Expected{"cyst", 11},
                                         // Once split long thin triangles without end.
                                         Expected{"genus-3", 6}),
                         NameOf);

// The seed must lie within the volume and within the object.
TEST(Seeds, AreRefusedWithTheReason) {
  tool::Segmentation s;
  ASSERT_TRUE(tool::prepare_phantom("torus-nested", 1, s).ok);
  s.options.seeds[0][0] = -3;
  EXPECT_NE(tool::run_segmentation(s, {}).message.find("outside the volume"), std::string::npos);
  s.options.seeds[0][0] = 50;
  s.options.seeds[0][1] = 50;
  EXPECT_NE(tool::run_segmentation(s, {}).message.find("outside the object"), std::string::npos);
}

}  // namespace
}  // namespace segmentation_test
