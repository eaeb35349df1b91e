// SPDX-License-Identifier: MIT
// Buds, leaves and neighbourhoods: proofs let complete detection pass over most pairs. The judge tries all pairs of
// triangles, on surfaces that fold, roll up, wind twice round an axis, or nearly do.
#include <algorithm>
#include <cfloat>
#include <cmath>

#include "detect/cull_leaves.h"
#include "detect/detect_all.h"
#include "support/library_mesh.h"
#include "support/schedules.h"
#include "support/share.h"
#include "support/support.h"
#include "tool/scenes/elementary.h"

namespace face_tree_test {
namespace {

using namespace support;

// The library's view of a mesh, with memory for one detection.
class Workbench : public LibraryMesh {
 public:
  explicit Workbench(const Mesh& mesh)
      : LibraryMesh(mesh),
        star_(VertexCount(mesh)),
        found_(TriangleCount(mesh) * 64),
        memory_(tpa::face_tree_bytes(VertexCount(mesh), TriangleCount(mesh)) / sizeof(Line) + 1),
        rooms_(TriangleCount(mesh)) {
    tree = tpa::open_face_tree(reinterpret_cast<uint8_t*>(memory_.data()), m.vertex_count, m.face_count);
  }
  Pairs Detect(const uint8_t* active = nullptr) {
    tpa::Detection out;
    out.pairs = {found_.data(), static_cast<uint32_t>(found_.size()), 0};
    tpa::detect_complete(m, tree, active, star_.data(), rooms_.rooms, {}, out);
    EXPECT_TRUE(std::all_of(star_.begin(), star_.end(), [](uint8_t s) { return s == 0; }));
    Pairs pairs;
    for (const tpa::Contact& p : out.pairs) pairs.emplace_back(p.a, p.b);
    return pairs;
  }
  // Share of the leaves proven each by itself.
  double ProvenShare() {
    tpa::arrange(tree, m, {});
    uint32_t proven = 0;
    tpa::Neighbourhood neighbourhood;
    for (uint32_t i = 0; i < tree.count; ++i) proven += tpa::find_neighbourhood(tree, m, i, neighbourhood) ? 1u : 0u;
    return static_cast<double>(proven) / tree.count;
  }

  tpa::FaceTree tree;

 private:
  struct alignas(64) Line {
    char bytes[64];
  };
  std::vector<uint8_t> star_;
  std::vector<tpa::Contact> found_;
  std::vector<Line> memory_;
  RoomsWithMemory rooms_;
};

void ExpectAsJudged(const Mesh& m, const std::string& name) {
  EXPECT_EQ(Workbench(m).Detect(), AllMeetingPairs(m)) << Written(m, name);
}

std::string Seeded(const char* name, uint64_t seed) { return std::string(name) + "-seed-" + std::to_string(seed); }

// ---------------------------------------------------------------- buds

// Counts the faces of a bud reached from its first face over edges.
size_t CountConnected(const Workbench& w, const tpa::Buds& p, uint32_t bud) {
  std::vector<uint32_t> reached = {p.face[p.first[bud]]};
  const auto *first = p.face + p.first[bud], *last = p.face + p.first[bud + 1];
  for (size_t i = 0; i < reached.size(); ++i)
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t next = tpa::face_of(w.m.opposite[3 * reached[i] + k]);
      if (std::find(first, last, next) != last && std::find(reached.begin(), reached.end(), next) == reached.end())
        reached.push_back(next);
    }
  return reached.size();
}

// Expects all promises of buds; returns the number of zones.
uint32_t ExpectBuds(const Mesh& mesh, const std::string& name, bool connected = true) {
  SCOPED_TRACE(name);
  Workbench w(mesh);
  tpa::arrange(w.tree, w.m, {});  // for its points
  const size_t n = w.m.face_count + tpa::most_zones, most = tpa::most_buds(w.m.face_count);
  std::vector<uint32_t> face(n), first(most), leader(most), following(most), bud_of(n), joined(most);
  std::vector<uint8_t> size(most), looked(most);
  tpa::Buds p;
  p.face = face.data(), p.first = first.data(), p.leader = leader.data(), p.following = following.data();
  p.size = size.data(), p.looked = looked.data();
  tpa::grow_buds(w.m, w.tree.point, {}, p, bud_of.data());
  std::vector<int> seen(w.m.face_count);
  int disconnected = 0;
  tpa::for_each_bud(p, [&](uint32_t i) {
    const uint32_t count = p.first[i + 1] - p.first[i];
    ASSERT_LT(i + 1, most);
    const bool in_pieces = CountConnected(w, p, i) != count;
    EXPECT_LE(count, in_pieces ? tpa::most_in_joined_buds : tpa::most_in_bud);
    disconnected += in_pieces ? 1 : 0;
    for (uint32_t at = p.first[i]; at < p.first[i + 1]; ++at) {
      EXPECT_EQ(bud_of[p.face[at]], i);
      ++seen[p.face[at]];
    }
    EXPECT_EQ(p.leader[p.leader[i]], p.leader[i]);
    joined[p.leader[i]] += count;
  });
  EXPECT_EQ(disconnected == 0, connected);
  EXPECT_EQ(seen, std::vector<int>(w.m.face_count, 1));
  tpa::for_each_bud(p, [&](uint32_t i) {
    if (p.leader[i] != i) return;
    EXPECT_LE(joined[i], tpa::most_in_joined_buds);
    EXPECT_EQ(joined[i], p.size[i]);
    uint32_t listed = 0;
    for (uint32_t k = i; k != tpa::none; k = p.following[k]) listed += p.first[k + 1] - p.first[k];
    EXPECT_EQ(listed, joined[i]);
  });
  return p.zones;
}

TEST(Buds, AreConnectedAndHoldEachFaceOnce) {
  Random random(1);
  for (const Mesh& mesh : {Sphere({0, 0, 0}, 1, 16), Torus({0, 0, 0}, 3, 1, 600, 20), Torus({0, 0, 0}, 3, 1, 200, 20),
                           Together({Box({0, 0, 0}, {1, 1, 1}, 1), Box({2, 0, 0}, {3, 1, 1}, 9)})})
    EXPECT_EQ(ExpectBuds(Renumbered(mesh, random), "renumbered"), 1u);
}

// Zones of numbers and of places: with random numbers, with a mesh far denser in one place, and with many components.
TEST(Buds, AreConnectedInMeshesOfManyZones) {
  Random random(2);
  const Mesh torus = Torus({0, 0, 0}, 3, 1, 800, 100), two = Together({torus, Torus({0, 0, 9}, .01, .001, 800, 100)});
  std::vector<Mesh> many;
  for (int i = 0; i < 900; ++i) many.push_back(Sphere(RandomPoint(random, -9, 9), .1, 4));
  EXPECT_EQ(ExpectBuds(torus, "torus"), 4u);
  EXPECT_EQ(ExpectBuds(two, "two"), 8u);
  EXPECT_EQ(ExpectBuds(Together(many), "many"), 2u);
  EXPECT_EQ(ExpectBuds(Renumbered(torus, random), "torus, renumbered"), 4u);
  EXPECT_EQ(ExpectBuds(Renumbered(two, random), "two, renumbered"), 8u);
  EXPECT_EQ(ExpectBuds(Renumbered(Together(many), random), "many, renumbered"), 2u);
}

// Buds suffice for each of many tetrahedra, but not for each of many pairs of faces back to back, in one zone and in
// several.
TEST(Buds, AreFewerThanAThirdOfTheFaces) {
  Random random(3);
  for (const size_t count : {9000u, 20000u}) {
    std::vector<Mesh> tetrahedra, pairs;
    for (size_t i = 0; i < count; ++i) {
      const Point at = RandomPoint(random, -9, 9);
      pairs.push_back(Translated({{0, 0, 0, .1, 0, 0, 0, .1, 0}, {0, 1, 2, 2, 1, 0}}, at));
      tetrahedra.push_back(
          Translated({{0, 0, 0, .1, 0, 0, 0, .1, 0, 0, 0, .1}, {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3}}, at));
    }
    ExpectBuds(Renumbered(Together(tetrahedra), random), "tetrahedra");
    ExpectBuds(Renumbered(Together(pairs), random), "pairs", false);
  }
}

// ---------------------------------------------------------------- order, leaves, tree

TEST(FaceTree, LeavesHoldEachFaceOnceWithinTheirBoxes) {
  for (uint64_t seed = 1; seed <= Share(10u); ++seed) {
    Random random(seed);
    const Mesh mesh = Renumbered(Together({Sphere(RandomPoint(random, -3, 3), 1, 3 + static_cast<int>(random() % 12)),
                                           Sphere({0, 0, 9}, .01, 9)}),
                                 random);
    Workbench w(mesh);
    tpa::arrange(w.tree, w.m, {});
    std::vector<int> seen(w.m.face_count);
    ASSERT_EQ(w.tree.first[0], 0u);
    ASSERT_EQ(w.tree.first[w.tree.count], w.m.face_count);
    for (uint32_t i = 0; i < w.tree.count; ++i) {
      ASSERT_LT(w.tree.first[i], w.tree.first[i + 1]);
      ASSERT_LE(w.tree.first[i + 1] - w.tree.first[i], tpa::most_in_leaf);
      for (uint32_t p = w.tree.first[i]; p < w.tree.first[i + 1]; ++p) {
        const uint32_t f = tpa::face_at(w.tree, p);
        ++seen[f];
        for (uint32_t h = 3 * f; h < 3 * f + 3; ++h) {
          const tpa::Vec3& corner = tpa::corner_position(w.m, h);
          const tpa::Box point = tpa::flat_box(w.tree.frame, corner, corner);
          for (uint32_t k = 0; k < 3; ++k) {
            EXPECT_GE(point.low[k], w.tree.node.low[k][i]);
            EXPECT_LE(point.high[k], w.tree.node.high[k][i]);
          }
          EXPECT_EQ(tpa::boxes_meeting(w.tree.box, p, p + 1, tpa::byte_box(w.tree.byte_frame[i], point)), 1u);
        }
      }
    }
    EXPECT_EQ(seen, std::vector<int>(w.m.face_count, 1)) << "seed " << seed;
  }
}

TEST(FaceTree, AQueryFindsExactlyTheBoxesThatMeetIt) {
  Workbench w(Together({Sphere({0, 0, 0}, 1, 24), Torus({0, 0, 0}, 2, .5, 60, 20)}));
  tpa::arrange(w.tree, w.m, {});
  ASSERT_GT(w.tree.levels, 2u);
  for (uint64_t seed = 1; seed <= Share(200u); ++seed) {
    Random random(seed);
    tpa::Box query;
    for (int k = 0; k < 3; ++k) {
      query.low[k] = static_cast<float>(Uniform(random, -1.1, 1));
      query.high[k] = query.low[k] + static_cast<float>(Uniform(random, 0, .5));
    }
    std::vector<uint32_t> found, expected;
    tpa::for_each_leaf_near(w.tree, query, 0, [&](uint32_t i) {
      found.push_back(i);
      return true;
    });
    for (uint32_t i = 0; i < w.tree.count; ++i)
      if (boxes_meet(tpa::node_box(w.tree, i), query)) expected.push_back(i);
    EXPECT_EQ(found, expected) << "seed " << seed;
  }
}

// Outlines against double precision on the same points: all bounds hold, and slabs fit closely.
TEST(FaceTree, OutlinesHoldTheirFacesClosely) {
  const auto corner = [](const Workbench& w, uint32_t face, uint32_t i) {
    const float* p = w.tree.point + 3 * w.m.corner[3 * face + i];
    return Point{p[0], p[1], p[2]};
  };
  constexpr double rounded = 1e-6;
  for (const Mesh& mesh : {Sphere({3, 4, 5}, 1, 24), Torus({0, 0, 0}, 3, 1, 120, 40), Box({0, 0, 0}, {1, 2, 3}, 9)}) {
    Workbench w(mesh);
    tpa::arrange(w.tree, w.m, {});
    for (uint32_t leaf = 0; leaf < w.tree.count; ++leaf) {
      const tpa::Outline& o = w.tree.outline[leaf];
      const Point middle{o.middle[0], o.middle[1], o.middle[2]}, normal{o.normal[0], o.normal[1], o.normal[2]};
      EXPECT_NEAR(Length(normal), 1, rounded);
      double low = 9, high = -9;
      for (uint32_t place = w.tree.first[leaf]; place < w.tree.first[leaf + 1]; ++place) {
        Point at[3];
        for (uint32_t i = 0; i < 3; ++i) {
          at[i] = Difference(corner(w, tpa::face_at(w.tree, place), i), middle);
          EXPECT_LE(Length(at[i]), o.radius + rounded);
          low = std::min(low, Dot(normal, at[i]));
          high = std::max(high, Dot(normal, at[i]));
        }
        const Point turn = Cross(Difference(at[1], at[0]), Difference(at[2], at[0]));
        const double along = Dot(normal, turn), across = Length(Difference(turn, Scaled(along, normal)));
        EXPECT_TRUE(o.slope == FLT_MAX || across <= along * (double{o.slope} + o.doubt + rounded));
      }
      EXPECT_NEAR(o.level, (low + high) / 2, rounded);
      EXPECT_NEAR(o.thickness, (high - low) / 2, rounded);
    }
  }
}

TEST(FaceTree, IsTheSameWithAnyThreads) {
  Random random(3);
  const Mesh torus = Torus({0, 0, 0}, 3, 1, 800, 100);
  for (const Mesh& mesh : {torus, Renumbered(torus, random)}) {
    Workbench one(mesh);
    tpa::arrange(one.tree, one.m, {});
    for (auto* run : {Backwards, OnTwoThreads}) {
      Workbench w(mesh);
      tpa::arrange(w.tree, w.m, {nullptr, run});
      ASSERT_EQ(w.tree.count, one.tree.count);
      EXPECT_TRUE(std::equal(w.tree.first, w.tree.first + w.tree.count + 1, one.tree.first));
      EXPECT_TRUE(std::equal(w.tree.face, w.tree.face + w.tree.places, one.tree.face));
    }
  }
}

// Octants of the first corner of a leaf, the place of the leaf on the curve, from the whole box down, eleven times.
std::vector<int> OctantsOf(const tpa::FaceTree& tree, const tpa::Mesh& m, uint32_t leaf) {
  const float* p = tree.point + 3 * size_t{m.corner[3 * size_t{tpa::face_at(tree, tree.first[leaf])}]};
  double low[3] = {-1, -1, -1}, size = 2;
  std::vector<int> octants;
  for (int level = 0; level < 11; ++level) {
    size /= 2;
    int octant = 0;
    for (int k = 0; k < 3; ++k) {
      // Points keep away from the upper side by a millionth.
      const bool upper = p[k] >= low[k] + size * (1 + 1e-6);
      octant |= upper ? 1 << k : 0;
      low[k] += upper ? size : 0;
    }
    octants.push_back(octant);
  }
  return octants;
}

TEST(FaceTree, LeavesFollowEachOtherAlongTheCurve) {
  Random random(4);
  const Mesh torus = Torus({0, 0, 0}, 3, 1, 800, 100);
  for (const Mesh& mesh : {torus, Renumbered(torus, random), Sphere({0, 0, 0}, 1, 30)}) {
    Workbench w(mesh);
    tpa::arrange(w.tree, w.m, {});
    uint32_t later = 0;
    for (uint32_t i = 0; i + 1 < w.tree.count; ++i)
      later += OctantsOf(w.tree, w.m, i) <= OctantsOf(w.tree, w.m, i + 1) ? 1u : 0u;
    // Rounding may take corners on a border of octants to either side.
    EXPECT_GT(w.tree.count, 100u);
    EXPECT_GE(1000 * later, 990 * (w.tree.count - 1)) << later << " of " << w.tree.count - 1;
  }
}

// ---------------------------------------------------------------- neighbourhoods

TEST(Neighbourhoods, SmoothSurfacesAreProvenForTheMostPart) {
  EXPECT_GT(Workbench(Sphere({1, 2, 3}, 5, 32)).ProvenShare(), .9);
  EXPECT_GT(Workbench(Torus({0, 0, 0}, 3, 1, 240, 80)).ProvenShare(), .9);
  EXPECT_GT(Workbench(Torus({0, 0, 0}, 3, 1, 120, 40)).ProvenShare(), .4);
  EXPECT_GT(Workbench(Box({0, 0, 0}, {1, 1, 1}, 32)).ProvenShare(), .9);
  // Faces ten times as long as wide.
  EXPECT_GT(Workbench(Torus({0, 0, 0}, 3, 1, 1200, 40)).ProvenShare(), .9);
}

// Surfaces close by each other are proven, since a proof never looks at the other surface.
TEST(Neighbourhoods, AreFollowedOverTheirEdgesOnly) {
  EXPECT_GT(Workbench(Together({Sphere({0, 0, 0}, 1, 32), Sphere({0, 0, 0}, .999, 32)})).ProvenShare(), .9);
  EXPECT_GT(Workbench(Together({Sphere({0, 0, 0}, 1, 32), Sphere({.3, 0, 0}, 1, 32)})).ProvenShare(), .9);
}

TEST(Neighbourhoods, NeighboursThatHardlyBendAreProvenAtOnce) {
  Workbench w(Together({Sphere({0, 0, 0}, 1, 64), Sphere({.3, 0, 0}, 1, 64)}));
  tpa::arrange(w.tree, w.m, {});
  uint32_t proven = 0;
  tpa::Neighbourhood neighbourhood;
  for (uint32_t i = 0; i < w.tree.count; ++i) {
    std::vector<uint32_t> several = {i};
    const tpa::AdjacentLeaves& n = w.tree.adjacent[i];
    several.insert(several.end(), n.leaf, n.leaf + std::min(n.count, tpa::AdjacentLeaves::capacity));
    if (!tpa::find_common_neighbourhood(w.tree, w.m, {several.data(), static_cast<uint32_t>(several.size())},
                                        neighbourhood))
      continue;
    ++proven;
    for (uint32_t k : several) EXPECT_TRUE(neighbourhood.has(k));
  }
  EXPECT_GT(proven, .9 * w.tree.count);
}

TEST(Neighbourhoods, WaveyAndFoldedSpheres) {
  size_t some = 0, none = 0;
  for (uint64_t seed = 1; seed <= Share(24u); ++seed) {
    Random random(seed);
    const double a = Uniform(random, 0, .5), k = Uniform(random, 3, 12), phase = Uniform(random, 0, 6);
    const Mesh m = Mapped(Sphere({0, 0, 0}, 1, 12), [&](Point p) {
      return Point{p[0] + a * tool::sine(k * p[1] + phase), p[1] + a * tool::sine(k * p[2]),
                   p[2] + a * tool::sine(k * p[0])};
    });
    ExpectAsJudged(m, Seeded("waves", seed));
    (Workbench(m).Detect().empty() ? none : some) += 1;
  }
  EXPECT_GT(some, Least(4u));
  EXPECT_GT(none, Least(2u));
}

// All faces turn outward, and yet the surface lies over itself: only condition (2) of the proof fails.
TEST(Neighbourhoods, SurfacesThatWindTwiceRoundAnAxis) {
  for (double lift : {0., 1e-9, 1e-3, .02, .2}) {
    const Mesh m = Mapped(Sphere({0, 0, 0}, 1, 12), [&](Point p) {
      const double r = std::sqrt(p[0] * p[0] + p[1] * p[1]), t = 2 * tool::arc_tangent(p[1], p[0]);
      return Point{r * tool::cosine(t), r * tool::sine(t), p[2] + lift * tool::sine(t / 2) * r};
    });
    const Pairs expected = AllMeetingPairs(m);
    EXPECT_FALSE(expected.empty());
    EXPECT_EQ(Workbench(m).Detect(), expected) << lift << "; " << Written(m, "twice");
  }
}

TEST(Neighbourhoods, RolledUpSheets) {
  // A flat torus rolled into a spiral with turns closer and closer, until they pass through each other.
  for (double gap : {.3, .2, .15, .1, .05, .01}) {
    const Mesh m = Mapped(Torus({0, 0, 0}, 3, 1, 60, 24), [&](Point p) {
      const double t = 2.2 * p[0], r = 1 + gap * t / 6 + .04 * p[2];
      return Point{r * tool::cosine(t), r * tool::sine(t), p[1]};
    });
    ExpectAsJudged(m, "rolled");
  }
}

TEST(Neighbourhoods, FoldedStarsAndFansOfManyFaces) {
  for (uint64_t seed = 1; seed <= Share(30u); ++seed) {
    Random random(seed);
    // A double cone, a fan of many faces at either end, with some link vertices moved across.
    const uint32_t n = 20 + static_cast<uint32_t>(random() % 300);
    Mesh m;
    for (uint32_t i = 0; i < n; ++i) {
      const double t = 2 * 3.141592653589793 * (i + (random() % 8 == 0 ? Uniform(random, -3, 3) : 0)) / n;
      m.positions.insert(m.positions.end(), {tool::cosine(t), tool::sine(t), Uniform(random, -.01, .01)});
    }
    m.positions.insert(m.positions.end(), {0, 0, 1, 0, 0, seed % 3 == 0 ? .9 : -1});
    for (uint32_t i = 0; i < n; ++i) {
      const uint32_t j = (i + 1) % n;
      m.triangles.insert(m.triangles.end(), {n, i, j, n + 1, j, i});
    }
    ExpectAsJudged(m, Seeded("fans", seed));
  }
}

TEST(Neighbourhoods, SlightlyPerturbedCoincidentSheets) {
  for (double gap : {0., 0x1p-40, 0x1p-26, 0x1p-23, 0x1p-20, 1e-5, 1e-3}) {
    const Mesh sphere = Sphere({0, 0, 0}, 1, 8);
    Mesh inner = sphere;
    for (double& x : inner.positions) x *= 1 - gap;
    ExpectAsJudged(Together({sphere, inner}), "coincident");
    // The inner sphere turns inward, as the inside of a thin shell.
    for (size_t i = 0; i < inner.triangles.size(); i += 3) std::swap(inner.triangles[i], inner.triangles[i + 1]);
    ExpectAsJudged(Together({sphere, inner}), "shell");
  }
}

TEST(Neighbourhoods, TinyAndHugeFacesTogether) {
  for (uint64_t seed = 1; seed <= Share(8u); ++seed) {
    Random random(seed);
    std::vector<Mesh> parts = {Box({-1, -1, -1}, {1, 1, 1}, 1 + static_cast<int>(seed % 3))};
    for (double r : {1e-1, 1e-3, 1e-6, 1e-8}) {
      Point p = RandomPoint(random, -1, 1);
      p[seed % 3] = 1;
      parts.push_back(Sphere(p, r, 6));
      p[(seed + 1) % 3] += 1.5 * r;
      parts.push_back(Sphere(p, r, 6));
    }
    ExpectAsJudged(Together(parts), Seeded("sizes", seed));
  }
}

// ---------------------------------------------------------------- moved faces

TEST(Moved, PairsOfFacesAtRestAreLeftOut) {
  size_t some = 0;
  for (uint64_t seed = 1; seed <= Share(12u); ++seed) {
    Random random(seed);
    const Mesh m = Together({Sphere({0, 0, 0}, 1, 10), Sphere(RandomPoint(random, -.8, .8), 1, 11)});
    const size_t share = 1 + random() % 30;
    std::vector<uint8_t> active(TriangleCount(m));
    for (uint8_t& a : active) a = random() % share == 0 ? 1 : 0;
    Pairs expected = AllMeetingPairs(m);
    std::erase_if(expected, [&](const auto& p) { return active[p.first] == 0 && active[p.second] == 0; });
    some += expected.size();
    EXPECT_EQ(Workbench(m).Detect(active.data()), expected) << "seed " << seed;
  }
  EXPECT_GT(some, Least(100u));
}

// A small set against a list: the order of addition, the content, and a full set.
TEST(LeafSet, HoldsEachOnceInTheOrderOfAddition) {
  uint32_t full = 0, crowded = 0;
  for (uint64_t seed = 1; seed <= Share(2000u); ++seed) {
    Random random(seed);
    tpa::LeafSet<15, 64> set;
    for (int filling = 0; filling < 2; ++filling) {
      std::vector<uint32_t> expected;
      // Few numbers, or numbers of a common slot.
      const uint32_t range = 1 + static_cast<uint32_t>(random() % 40), stride = random() % 2 == 0 ? 1 : 64;
      for (int i = 0; i < 60; ++i) {
        const uint32_t wanted = stride * static_cast<uint32_t>(random() % range);
        const bool known = std::find(expected.begin(), expected.end(), wanted) != expected.end();
        const bool fits = known || expected.size() < 15;
        if (!known && fits) expected.push_back(wanted);
        ASSERT_EQ(set.add(wanted), fits) << seed;
        ASSERT_EQ(std::vector<uint32_t>(set.leaf, set.leaf + set.count), expected) << seed;
        const uint8_t place = set.place[set.slot_of(wanted)];
        ASSERT_EQ(place != 0, fits) << seed;
        ASSERT_TRUE(!fits || set.leaf[place - 1] == wanted) << seed;
        full += fits ? 0u : 1u;
      }
      crowded += stride == 64 && expected.size() > 5 ? 1u : 0u;
      set.clear();
    }
  }
  EXPECT_GT(full, Least(10000));
  EXPECT_GT(crowded, Least(1000));
}

}  // namespace
}  // namespace face_tree_test
