// SPDX-License-Identifier: MIT
// Meshes from the field are what tpa_load accepts, and their judge knows right results from wrong ones.
#include "support/field_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "oracle/mesh_oracle.h"
#include "oracle/region_columns.h"
#include "oracle/region_topology.h"
#include "support/field_shapes.h"
#include "support/region_trial.h"
#include "support/share.h"
#include "support/tangle_shapes.h"

namespace field_meshes_test {
namespace {

using namespace support;

TEST(FieldMeshes, AreClosedOrientedManifolds) {
  for (const FieldFamily& f : FieldFamilies())
    for (uint64_t seed = 1; seed <= Share(5u); ++seed) {
      if (f.name.rfind("tangle-", 0) == 0) continue;  // resolve_test loads them
      const Mesh m = MakeFieldMesh(f, seed);
      if (m.triangles.empty()) continue;  // no files here
      ASSERT_EQ(TopologyOf(m).defect, "") << f.name << " " << seed << ", " << Written(m, f.name);
      EXPECT_GT(SignedVolume(m), 0) << f.name << " " << seed;
    }
}

TEST(FieldMeshes, AreTheSameForTheSameSeed) {
  for (const char* name : {"boxes-grid", "outline-fine", "spring-coarse", "copies-shifted"}) {
    const FieldFamily& f = FieldFamilyOf(name);
    EXPECT_EQ(MakeFieldMesh(f, 7).positions, MakeFieldMesh(f, 7).positions) << name;
    EXPECT_NE(MakeFieldMesh(f, 7).positions, MakeFieldMesh(f, 8).positions) << name;
  }
}

// ---------------------------------------------------------------- columns

TEST(RegionColumns, MeasureLossesAndGains) {
  const Mesh box = Box({0, 0, 0}, {4, 4, 4}, 2), top = Box({0, 0, 3}, {4, 4, 4}, 1),
             beside = Box({4, 0, 0}, {5, 4, 4}, 1);
  const RegionDifference same = CompareRegions(box, Together({box, box}), 2000, 1);
  EXPECT_NEAR(same.Lost() + same.Gained(), 0, 1e-12);
  EXPECT_FALSE(same.is_plain);
  const RegionDifference less = CompareRegions(box, Box({0, 0, 0}, {4, 4, 3}, 1), 2000, 1);
  EXPECT_NEAR(less.Lost(), 0.25, 0.01);
  EXPECT_NEAR(less.Gained(), 0, 1e-12);
  EXPECT_NEAR(less.VolumeError(), -0.25, 0.01);
  EXPECT_TRUE(less.is_plain);
  const RegionDifference more = CompareRegions(Together({box, top}), Together({box, beside}), 2000, 1);
  EXPECT_NEAR(more.Gained(), 0.25, 0.02);
  EXPECT_NEAR(more.Lost(), 0, 1e-12);
  const RegionDifference none = CompareRegions(Reversed(box), box, 2000, 1);
  EXPECT_EQ(none.truth, 0);
  EXPECT_EQ(none.Gained(), 1);
  const RegionDifference all = CompareRegions(box, {}, 2000, 1);
  EXPECT_NEAR(all.Lost(), 1, 1e-12);
}

TEST(RegionColumns, KnowVolumes) {
  const Mesh ball = Sphere({}, 1, 40);
  const RegionDifference d = CompareRegions(Together({ball, Translated(ball, {1, 0, 0})}), ball, 20000, 3);
  EXPECT_NEAR(d.result / SignedVolume(ball), 1, 0.005);
  EXPECT_NEAR(d.Lost(), 11.0 / 27, 0.005);  // caps of height 1/2 of both balls are the overlap
}

// ---------------------------------------------------------------- the judge

// The sides of the unit cells where a mesh on a grid of whole numbers has winding number >= 1.
Mesh SurfaceOfCells(const Mesh& given) {
  const Lattice lattice{{-1, -1, -1}, 1, {10, 10, 10}};
  const Cells cells = AtLeastOne(WindingNumbers(given, lattice));
  Mesh m;
  std::map<std::array<int, 3>, uint32_t> number;
  const auto vertex = [&](const std::array<int, 3>& at) {
    const auto [place, added] = number.emplace(at, VertexCount(m));
    for (size_t i = 0; added && i < 3; ++i) m.positions.push_back(at[i] - 1);
    return place->second;
  };
  for (int c = 0; c < 8 * 8 * 8; ++c) {
    const std::array<int, 3> at = {c % 8 + 1, c / 8 % 8 + 1, c / 64 + 1};
    if (cells[lattice.At(at[0], at[1], at[2])] == 0) continue;
    for (size_t axis = 0; axis < 3; ++axis)
      for (int side : {0, 1}) {
        std::array<int, 3> beside = at;
        beside[axis] += 2 * side - 1;
        if (cells[lattice.At(beside[0], beside[1], beside[2])] != 0) continue;
        uint32_t corner[4];
        for (int k = 0; k < 4; ++k) {
          std::array<int, 3> p = at;
          p[axis] += side;
          p[(axis + 1) % 3] += k == 1 || k == 2 ? 1 : 0;
          p[(axis + 2) % 3] += k >= 2 ? 1 : 0;
          corner[side == 1 ? k : 3 - k] = vertex(p);
        }
        for (int k : {0, 1, 2, 0, 2, 3}) m.triangles.push_back(corner[k]);
      }
  }
  return m;
}

TEST(RegionJudge, AcceptsExactResults) {
  int judged = 0;
  for (const char* name : {"boxes-grid", "boxes-grid-fine", "boxes-signed"}) {
    const FieldFamily& f = FieldFamilyOf(name);
    for (uint64_t seed = 1; seed <= 40; seed += Stride()) {
      const Mesh given = MakeFieldMesh(f, seed), exact = SurfaceOfCells(given);
      if (exact.triangles.empty() || !TopologyOf(exact).defect.empty()) continue;  // touches itself
      const RegionVerdict v = JudgeRegion(f, given, exact, seed);
      EXPECT_EQ(v.outcome, Outcome::right) << name << " " << seed << ": " << v.reason;
      judged += v.topology_judged ? 1 : 0;
    }
  }
  EXPECT_GT(judged, Least(30));
}

class Judged : public testing::Test {
 protected:
  RegionVerdict Verdict(const Mesh& result) const {
    return JudgeRegion(FieldFamilyOf("boxes-near"), given_, result, 1);
  }
  void ExpectWrong(const Mesh& result, const std::string& reason) const {
    const RegionVerdict v = Verdict(result);
    EXPECT_EQ(v.outcome, Outcome::wrong);
    EXPECT_NE(v.reason.find(reason), std::string::npos) << v.reason;
  }
  const Mesh box_ = Box({0, 0, 0}, {1, 1, 1}, 2);
  const Mesh given_ = Together({box_, Translated(Box({0, 0, 0}, {0.5, 0.5, 0.5}, 1), {0.25, 0.25, 0.25})});
};

TEST_F(Judged, TheBoundaryIsRight) { EXPECT_EQ(Verdict(box_).outcome, Outcome::right) << Verdict(box_).reason; }
TEST_F(Judged, LayersAreWrong) { ExpectWrong(given_, "winding numbers"); }
TEST_F(Judged, ALostLayerIsWrong) { ExpectWrong(Box({0, 0, 0}, {1, 1, 0.99}, 2), "lost"); }
TEST_F(Judged, AnInsideOutResultIsWrong) { ExpectWrong(Reversed(box_), "lost"); }
TEST_F(Judged, NothingIsWrong) { ExpectWrong({}, "lost"); }
TEST_F(Judged, ContactsAreWrong) { ExpectWrong(Together({box_, box_}), "pairs meet"); }
TEST_F(Judged, ASmallVoidIsWrong) {
  ExpectWrong(Together({box_, Reversed(Box({0.3, 0.3, 0.3}, {0.35, 0.35, 0.35}, 1))}), "1 voids instead of");
}
TEST_F(Judged, ASmallBodyIsWrong) {
  ExpectWrong(Together({box_, Box({1.1, 0.3, 0.3}, {1.15, 0.35, 0.35}, 1)}),
              "2 bodies, 0 tunnels, 0 voids instead of 1");
}
TEST_F(Judged, AHoleIsWrong) {
  Mesh open = box_;
  open.triangles.resize(open.triangles.size() - 3);
  ExpectWrong(open, "link");
}

// A hole of a thousandth of the volume, in the given mesh only.
TEST(RegionJudge, MissesNoTunnel) {
  const Mesh box = Box({0, 0, 0}, {1, 1, 1}, 2), hole = Reversed(Box({0.4, 0.4, -0.5}, {0.43, 0.43, 1.5}, 1));
  const RegionVerdict v = JudgeRegion(FieldFamilyOf("boxes-near"), Together({box, hole}), box, 1);
  EXPECT_EQ(v.outcome, Outcome::wrong);
  EXPECT_NE(v.reason.find("0 tunnels, 0 voids instead of 1 bodies, 1 tunnels"), std::string::npos) << v.reason;
}

// Boxes that share an edge may come out joined or apart, but not without one of them.
TEST(RegionJudge, LeavesOpenHowTouchingBoxesEnd) {
  const Mesh a = Box({0, 0, 0}, {1, 1, 1}, 1), b = Box({1, 1, 0}, {2, 2, 1}, 1);
  const FieldFamily& f = FieldFamilyOf("boxes-grid");
  const Mesh given = Together({a, b});
  const Mesh apart = Together({Box({0, 0, 0}, {0.9995, 1, 1}, 1), b});
  EXPECT_EQ(JudgeRegion(f, given, apart, 1).outcome, Outcome::right) << JudgeRegion(f, given, apart, 1).reason;
  const Mesh joined =
      Prism({{0, 0}, {1, 0}, {1, 0.97}, {1.03, 1}, {2, 1}, {2, 2}, {1, 2}, {1, 1.03}, {0.97, 1}, {0, 1}}, 1);
  EXPECT_EQ(JudgeRegion(f, given, joined, 1).outcome, Outcome::right) << JudgeRegion(f, given, joined, 1).reason;
  EXPECT_EQ(JudgeRegion(f, given, a, 1).outcome, Outcome::wrong);
}

}  // namespace
}  // namespace field_meshes_test
