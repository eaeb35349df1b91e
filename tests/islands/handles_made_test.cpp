// SPDX-License-Identifier: MIT
// Handles that islands make: tubes between balls, whose numbers the genus of the whole mesh tells.
#include "islands/handles_made.h"

#include <set>

#include "support/open_island.h"

namespace handles_made_test {
namespace {

using namespace support;

// Balls side by side, with an idle one.
Mesh Balls(uint32_t count) {
  std::vector<Mesh> balls;
  for (uint32_t i = 0; i < count; ++i) balls.push_back(Sphere({4. * i, 0, 0}, 1, 5));
  balls.push_back(Sphere({0, 0, 50}, 1, 2));
  return Together(balls);
}
const uint32_t faces_of_ball = TriangleCount(Sphere({0, 0, 0}, 1, 5));

// The next island begins, as the library begins it.
void BeginIsland(OpenIsland& island, uint32_t number) {
  tpa::Claims& claims = island.w.edit.journal.claims;
  claims.vertices.cut_off(0);
  claims.faces.cut_off(0);
  claims.owner = number;
  claims.met = tpa::none;
}

int64_t GenusOf(const OpenIsland& island) { return TopologyOf(island.Now()).Genus(); }

TEST(HandlesMade, ByATubeAreOneWithinAComponentAndNoneBetweenTwo) {
  for (bool within : {false, true}) {
    OpenIsland island(Balls(2));
    EXPECT_EQ(tpa::handles_made(island.t), 0);
    island.Bridge(0, within ? faces_of_ball / 2 : faces_of_ball);
    EXPECT_EQ(TopologyOf(island.Now()).defect, "");
    EXPECT_EQ(tpa::handles_made(island.t), within ? 1 : 0);
    EXPECT_EQ(GenusOf(island), within ? 1 : 0);
  }
}

TEST(HandlesMade, ByTwoTubesBetweenTwoComponentsAreOne) {
  OpenIsland island(Balls(2));
  for (uint32_t f : {0u, faces_of_ball / 2}) island.Bridge(f, faces_of_ball + f);
  EXPECT_EQ(tpa::handles_made(island.t), 1);
  EXPECT_EQ(GenusOf(island), 1);
}

TEST(HandlesMade, AreFewerThanNoneWhereAHandleIsOpened) {
  const Mesh ring = Torus({0, 0, 0}, 1, .3, 12, 6), ball = Sphere({0, 0, 0}, 1, 3);
  OpenIsland island(Together({ring, Balls(1)}));
  std::vector<uint32_t> all;
  for (uint32_t v = 0; v < VertexCount(ring); ++v) all.push_back(v);
  island.Remove(all);
  EXPECT_EQ(tpa::handles_made(island.t), -1 + 0) << "the component goes with its handle";
  island.Make(ball);
  EXPECT_EQ(tpa::handles_made(island.t), -1);
}

TEST(HandlesMade, AreNoneWhereAComponentComesApartOrGoes) {
  OpenIsland island(Balls(2));
  std::vector<uint32_t> first;
  for (uint32_t v = 0; v < VertexCount(Sphere({0, 0, 0}, 1, 5)); ++v) first.push_back(v);
  island.Remove(first);
  EXPECT_EQ(tpa::handles_made(island.t), 0);
  island.Make(Sphere({0, 0, 0}, .5, 2));
  island.Make(Sphere({0, 0, 3}, .5, 2));
  EXPECT_EQ(tpa::handles_made(island.t), 0);
}

// Two bodies that meet in two places, each an island: the second makes the handle.
TEST(HandlesMade, BySecondOfTwoIslandsBetweenTheSameComponentsAreOne) {
  OpenIsland island(Balls(2));
  island.Bridge(0, faces_of_ball);
  EXPECT_EQ(tpa::handles_made(island.t), 0);
  tpa::note_joins(island.t);
  BeginIsland(island, 1);
  island.Bridge(faces_of_ball / 2, faces_of_ball + faces_of_ball / 2);
  EXPECT_EQ(tpa::handles_made(island.t), 1);
  tpa::forget_joins(island.w.before);
  EXPECT_EQ(tpa::handles_made(island.t), 0) << "without the first island";
}

// Faces below `end` apart from each other: no edge joins two of them.
std::vector<uint32_t> ApartFaces(const Mesh& m, uint32_t end) {
  std::vector<uint32_t> faces;
  std::vector<bool> used(VertexCount(m));
  for (uint32_t f = 0; f < end; ++f) {
    const uint32_t* v = m.triangles.data() + 3 * f;
    if (used[v[0]] || used[v[1]] || used[v[2]]) continue;
    faces.push_back(f);
    const std::set<uint32_t> corners(v, v + 3);
    for (size_t h = 0; h < m.triangles.size(); ++h)
      if (corners.count(m.triangles[h]) != 0)
        for (size_t i = 0; i < 3; ++i) used[m.triangles[h / 3 * 3 + i]] = true;
  }
  return faces;
}

// Islands of one to three tubes each, between any faces of any balls.
TEST(HandlesMade, OfIslandsOneByOneAreThoseOfTheWholeMesh) {
  int joined = 0, made = 0;
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    constexpr uint32_t balls = 5;
    OpenIsland island(Balls(balls));
    std::vector<uint32_t> faces = ApartFaces(Balls(balls), balls * faces_of_ball);
    ASSERT_GE(faces.size(), 2u * 6 * 3);
    std::shuffle(faces.begin(), faces.end(), random);
    int64_t genus = 0;
    for (uint32_t number = 0; number < 6; ++number) {
      BeginIsland(island, number);
      for (uint64_t tubes = 1 + random() % 3; tubes > 0; --tubes) {
        const uint32_t f = faces.back(), g = faces[faces.size() - 2];
        faces.resize(faces.size() - 2);
        island.Bridge(f, g);
      }
      const Topology now = TopologyOf(island.Now());
      ASSERT_EQ(now.defect, "");
      EXPECT_EQ(tpa::handles_made(island.t), now.Genus() - genus) << "seed " << seed << " island " << number;
      made += now.Genus() > genus ? 1 : 0;
      joined += now.components.size() < balls + 1 ? 1 : 0;
      genus = now.Genus();
      tpa::note_joins(island.t);
    }
  }
  EXPECT_GT(made, 30);
  EXPECT_GT(joined, 30);
}

}  // namespace
}  // namespace handles_made_test
