// Patches, clusters and sheets: what complete detection passes over without looking at pairs. The judge tries each
// triangle with each, on surfaces that fold, roll up, wind twice round an axis, or nearly do.
#include <algorithm>
#include <cfloat>
#include <cmath>
#include <thread>

#include "detect/cull_clusters.h"
#include "detect/detect_all.h"
#include "support/library_mesh.h"
#include "support/share.h"
#include "support/support.h"
#include "tool/scenes/elementary.h"

namespace {

using namespace support;

// The library's view of a mesh, with memory for one detection.
class Workbench : public LibraryMesh {
 public:
  explicit Workbench(const Mesh& mesh)
      : LibraryMesh(mesh),
        star_(VertexCount(mesh)),
        found_(TriangleCount(mesh) * 64),
        memory_(tpa::face_tree_bytes(VertexCount(mesh), TriangleCount(mesh)) / sizeof(Line) + 1) {
    c = tpa::open_face_tree(reinterpret_cast<uint8_t*>(memory_.data()), m.vertex_count, m.face_count);
  }
  Pairs Detect(const uint8_t* active = nullptr) {
    tpa::Detection out;
    out.pairs = {found_.data(), static_cast<uint32_t>(found_.size()), 0};
    tpa::detect_complete(m, c, active, star_.data(), {}, out);
    EXPECT_TRUE(std::all_of(star_.begin(), star_.end(), [](uint8_t s) { return s == 0; }));
    Pairs pairs;
    for (const tpa::Contact& p : out.pairs) pairs.emplace_back(p.a, p.b);
    return pairs;
  }
  // Share of the clusters that are proven one by one.
  double ProvenShare() {
    tpa::arrange(c, m, {});
    uint32_t proven = 0;
    tpa::Sheet sheet;
    for (uint32_t i = 0; i < c.count; ++i) proven += tpa::find_sheet(c, m, i, sheet) ? 1 : 0;
    return static_cast<double>(proven) / c.count;
  }

  tpa::FaceTree c;

 private:
  struct alignas(64) Line {
    char bytes[64];
  };
  std::vector<uint8_t> star_;
  std::vector<tpa::Contact> found_;
  std::vector<Line> memory_;
};

void ExpectAsJudged(const Mesh& m, const std::string& name) {
  EXPECT_EQ(Workbench(m).Detect(), AllMeetingPairs(m)) << Written(m, name);
}

std::string Seeded(const char* name, uint64_t seed) { return std::string(name) + "-seed-" + std::to_string(seed); }

// ---------------------------------------------------------------- patches

// Faces that are reached from one over edges within the range of places.
size_t CountConnected(const Workbench& w, const tpa::Patches& p, uint32_t patch) {
  std::vector<uint32_t> reached = {p.face[p.first[patch]]};
  const auto *first = p.face + p.first[patch], *last = p.face + p.first[patch + 1];
  for (size_t i = 0; i < reached.size(); ++i)
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t next = tpa::face_of(w.m.opposite[3 * reached[i] + k]);
      if (std::find(first, last, next) != last && std::find(reached.begin(), reached.end(), next) == reached.end())
        reached.push_back(next);
    }
  return reached.size();
}

// All that patches promise; how many zones there are.
uint32_t ExpectPatches(const Mesh& mesh, const std::string& name, bool connected = true) {
  SCOPED_TRACE(name);
  Workbench w(mesh);
  tpa::arrange(w.c, w.m, {});  // for its points
  const size_t n = w.m.face_count + tpa::most_zones, most = tpa::most_patches(w.m.face_count);
  std::vector<uint32_t> face(n), first(most), leader(most), following(most), patch_of(n), joined(most);
  std::vector<uint8_t> size(most), looked(most);
  tpa::Patches p;
  p.face = face.data(), p.first = first.data(), p.leader = leader.data(), p.following = following.data();
  p.size = size.data(), p.looked = looked.data();
  tpa::find_patches(w.m, w.c.point, {}, p, patch_of.data());
  std::vector<int> seen(w.m.face_count);
  int disconnected = 0;
  tpa::for_each_patch(p, [&](uint32_t i) {
    const uint32_t count = p.first[i + 1] - p.first[i];
    ASSERT_LT(i + 1, most);
    const bool in_pieces = CountConnected(w, p, i) != count;
    EXPECT_LE(count, in_pieces ? tpa::most_in_joined_patches : tpa::most_in_patch);
    disconnected += in_pieces ? 1 : 0;
    for (uint32_t at = p.first[i]; at < p.first[i + 1]; ++at) {
      EXPECT_EQ(patch_of[p.face[at]], i);
      ++seen[p.face[at]];
    }
    EXPECT_EQ(p.leader[p.leader[i]], p.leader[i]);
    joined[p.leader[i]] += count;
  });
  EXPECT_EQ(disconnected == 0, connected);
  EXPECT_EQ(seen, std::vector<int>(w.m.face_count, 1));
  tpa::for_each_patch(p, [&](uint32_t i) {
    if (p.leader[i] != i) return;
    EXPECT_LE(joined[i], tpa::most_in_joined_patches);
    EXPECT_EQ(joined[i], p.size[i]);
    uint32_t listed = 0;
    for (uint32_t k = i; k != tpa::none; k = p.following[k]) listed += p.first[k + 1] - p.first[k];
    EXPECT_EQ(listed, joined[i]);
  });
  return p.zones;
}

TEST(Patches, AreConnectedAndHoldEachFaceOnce) {
  Random random(1);
  for (const Mesh& mesh : {Sphere({0, 0, 0}, 1, 16), Torus({0, 0, 0}, 3, 1, 600, 20), Torus({0, 0, 0}, 3, 1, 200, 20),
                           Together({Box({0, 0, 0}, {1, 1, 1}, 1), Box({2, 0, 0}, {3, 1, 1}, 9)})})
    EXPECT_EQ(ExpectPatches(Renumbered(mesh, random), "renumbered"), 1u);
}

// Zones of numbers, and of places: where numbers tell nothing, where the mesh is far denser in one place, and where it
// has many components.
TEST(Patches, AreConnectedInMeshesOfManyZones) {
  Random random(2);
  const Mesh torus = Torus({0, 0, 0}, 3, 1, 800, 100), two = Together({torus, Torus({0, 0, 9}, .01, .001, 800, 100)});
  std::vector<Mesh> many;
  for (int i = 0; i < 900; ++i) many.push_back(Sphere(RandomPoint(random, -9, 9), .1, 4));
  EXPECT_EQ(ExpectPatches(torus, "torus"), 4u);
  EXPECT_EQ(ExpectPatches(two, "two"), 8u);
  EXPECT_EQ(ExpectPatches(Together(many), "many"), 2u);
  EXPECT_EQ(ExpectPatches(Renumbered(torus, random), "torus, renumbered"), 4u);
  EXPECT_EQ(ExpectPatches(Renumbered(two, random), "two, renumbered"), 8u);
  EXPECT_EQ(ExpectPatches(Renumbered(Together(many), random), "many, renumbered"), 2u);
}

// There is a patch for each of many tetrahedra. There is not for each of many pairs of faces back to back, in one zone
// and in several.
TEST(Patches, AreFewerThanAThirdOfTheFaces) {
  Random random(3);
  for (const size_t count : {9000u, 20000u}) {
    std::vector<Mesh> tetrahedra, pairs;
    for (size_t i = 0; i < count; ++i) {
      const Point at = RandomPoint(random, -9, 9);
      pairs.push_back(Translated({{0, 0, 0, .1, 0, 0, 0, .1, 0}, {0, 1, 2, 2, 1, 0}}, at));
      tetrahedra.push_back(
          Translated({{0, 0, 0, .1, 0, 0, 0, .1, 0, 0, 0, .1}, {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3}}, at));
    }
    ExpectPatches(Renumbered(Together(tetrahedra), random), "tetrahedra");
    ExpectPatches(Renumbered(Together(pairs), random), "pairs", false);
  }
}

// ---------------------------------------------------------------- order, clusters, tree

TEST(FaceTree, HoldEachFaceOnceWithinTheirBoxes) {
  for (uint64_t seed = 1; seed <= Share(10u); ++seed) {
    Random random(seed);
    const Mesh mesh = Renumbered(Together({Sphere(RandomPoint(random, -3, 3), 1, 3 + static_cast<int>(random() % 12)),
                                           Sphere({0, 0, 9}, .01, 9)}),
                                 random);
    Workbench w(mesh);
    tpa::arrange(w.c, w.m, {});
    std::vector<int> seen(w.m.face_count);
    ASSERT_EQ(w.c.first[0], 0u);
    ASSERT_EQ(w.c.first[w.c.count], w.m.face_count);
    for (uint32_t i = 0; i < w.c.count; ++i) {
      ASSERT_LT(w.c.first[i], w.c.first[i + 1]);
      ASSERT_LE(w.c.first[i + 1] - w.c.first[i], tpa::most_in_cluster);
      for (uint32_t p = w.c.first[i]; p < w.c.first[i + 1]; ++p) {
        const uint32_t f = tpa::face_at(w.c, p);
        ++seen[f];
        for (uint32_t h = 3 * f; h < 3 * f + 3; ++h) {
          const tpa::Vec3& corner = tpa::corner_position(w.m, h);
          const tpa::Box point = tpa::flat_box(w.c.frame, corner, corner);
          for (uint32_t k = 0; k < 3; ++k) {
            EXPECT_GE(point.low[k], w.c.node.low[k][i]);
            EXPECT_LE(point.high[k], w.c.node.high[k][i]);
          }
          EXPECT_EQ(tpa::boxes_meeting(w.c.box, p, p + 1, tpa::byte_box(w.c.byte_frame[i], point)), 1u);
        }
      }
    }
    EXPECT_EQ(seen, std::vector<int>(w.m.face_count, 1)) << "seed " << seed;
  }
}

TEST(FaceTree, AQueryFindsExactlyTheBoxesThatMeetIt) {
  Workbench w(Together({Sphere({0, 0, 0}, 1, 24), Torus({0, 0, 0}, 2, .5, 60, 20)}));
  tpa::arrange(w.c, w.m, {});
  ASSERT_GT(w.c.levels, 2u);
  for (uint64_t seed = 1; seed <= Share(200u); ++seed) {
    Random random(seed);
    tpa::Box query;
    for (int k = 0; k < 3; ++k) {
      query.low[k] = static_cast<float>(Uniform(random, -1.1, 1));
      query.high[k] = query.low[k] + static_cast<float>(Uniform(random, 0, .5));
    }
    std::vector<uint32_t> found, expected;
    tpa::for_each_cluster_near(w.c, query, 0, [&](uint32_t i) {
      found.push_back(i);
      return true;
    });
    for (uint32_t i = 0; i < w.c.count; ++i)
      if (boxes_meet(tpa::node_box(w.c, i), query)) expected.push_back(i);
    EXPECT_EQ(found, expected) << "seed " << seed;
  }
}

// Outlines in double precision from the same points: what they say of each cluster holds, and no slab is thicker than
// its points are apart.
TEST(FaceTree, OutlinesHoldTheirFacesClosely) {
  const auto corner = [](const Workbench& w, uint32_t face, uint32_t i) {
    const float* p = w.c.point + 3 * w.m.corner[3 * face + i];
    return Point{p[0], p[1], p[2]};
  };
  constexpr double rounded = 1e-6;
  for (const Mesh& mesh : {Sphere({3, 4, 5}, 1, 24), Torus({0, 0, 0}, 3, 1, 120, 40), Box({0, 0, 0}, {1, 2, 3}, 9)}) {
    Workbench w(mesh);
    tpa::arrange(w.c, w.m, {});
    for (uint32_t cluster = 0; cluster < w.c.count; ++cluster) {
      const tpa::Outline& o = w.c.outline[cluster];
      const Point middle{o.middle[0], o.middle[1], o.middle[2]}, normal{o.normal[0], o.normal[1], o.normal[2]};
      EXPECT_NEAR(Length(normal), 1, rounded);
      double low = 9, high = -9;
      for (uint32_t place = w.c.first[cluster]; place < w.c.first[cluster + 1]; ++place) {
        Point at[3];
        for (uint32_t i = 0; i < 3; ++i) {
          at[i] = Difference(corner(w, tpa::face_at(w.c, place), i), middle);
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

using Task = void (*)(void* data, uint32_t index);
void Backwards(void*, uint32_t count, Task task, void* data) {
  for (uint32_t i = count; i-- > 0;) task(data, i);
}
void OnTwoThreads(void*, uint32_t count, Task task, void* data) {
  const auto half = [&](uint32_t first) {
    for (uint32_t i = first; i < count; i += 2) task(data, i);
  };
  std::thread other(half, 1);
  half(0);
  other.join();
}

TEST(FaceTree, AreTheSameWhateverFindsThem) {
  Random random(3);
  const Mesh torus = Torus({0, 0, 0}, 3, 1, 800, 100);
  for (const Mesh& mesh : {torus, Renumbered(torus, random)}) {
    Workbench one(mesh);
    tpa::arrange(one.c, one.m, {});
    for (auto* run : {Backwards, OnTwoThreads}) {
      Workbench w(mesh);
      tpa::arrange(w.c, w.m, {nullptr, run});
      ASSERT_EQ(w.c.count, one.c.count);
      EXPECT_TRUE(std::equal(w.c.first, w.c.first + w.c.count + 1, one.c.first));
      EXPECT_TRUE(std::equal(w.c.face, w.c.face + w.c.places, one.c.face));
    }
  }
}

// A cluster lies where the first corner of its first face does: bit by bit, the octants that hold it from the whole box
// down, eleven times.
std::vector<int> OctantsOf(const tpa::FaceTree& c, const tpa::Mesh& m, uint32_t cluster) {
  const float* p = c.point + 3 * size_t{m.corner[3 * size_t{tpa::face_at(c, c.first[cluster])}]};
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

TEST(FaceTree, FollowEachOtherAlongTheCurve) {
  Random random(4);
  const Mesh torus = Torus({0, 0, 0}, 3, 1, 800, 100);
  for (const Mesh& mesh : {torus, Renumbered(torus, random), Sphere({0, 0, 0}, 1, 30)}) {
    Workbench w(mesh);
    tpa::arrange(w.c, w.m, {});
    uint32_t later = 0;
    for (uint32_t i = 0; i + 1 < w.c.count; ++i) later += OctantsOf(w.c, w.m, i) <= OctantsOf(w.c, w.m, i + 1) ? 1 : 0;
    // Where a corner lies on a border, rounding may take it for one of either side.
    EXPECT_GT(w.c.count, 100u);
    EXPECT_GE(1000 * later, 990 * (w.c.count - 1)) << later << " of " << w.c.count - 1;
  }
}

// ---------------------------------------------------------------- sheets

TEST(Sheets, SmoothSurfacesAreProvenForTheMostPart) {
  EXPECT_GT(Workbench(Sphere({1, 2, 3}, 5, 32)).ProvenShare(), .9);
  EXPECT_GT(Workbench(Torus({0, 0, 0}, 3, 1, 240, 80)).ProvenShare(), .9);
  EXPECT_GT(Workbench(Torus({0, 0, 0}, 3, 1, 120, 40)).ProvenShare(), .4);
  EXPECT_GT(Workbench(Box({0, 0, 0}, {1, 1, 1}, 32)).ProvenShare(), .9);
  // Faces ten times as long as wide.
  EXPECT_GT(Workbench(Torus({0, 0, 0}, 3, 1, 1200, 40)).ProvenShare(), .9);
}

// What clears two sheets that lie close by each other is that neither is looked at when the other is judged.
TEST(Sheets, AreFollowedOverTheirEdgesOnly) {
  EXPECT_GT(Workbench(Together({Sphere({0, 0, 0}, 1, 32), Sphere({0, 0, 0}, .999, 32)})).ProvenShare(), .9);
  EXPECT_GT(Workbench(Together({Sphere({0, 0, 0}, 1, 32), Sphere({.3, 0, 0}, 1, 32)})).ProvenShare(), .9);
}

TEST(Sheets, NeighboursThatHardlyBendAreProvenAtOnce) {
  Workbench w(Together({Sphere({0, 0, 0}, 1, 64), Sphere({.3, 0, 0}, 1, 64)}));
  tpa::arrange(w.c, w.m, {});
  uint32_t proven = 0;
  tpa::Sheet sheet;
  for (uint32_t i = 0; i < w.c.count; ++i) {
    std::vector<uint32_t> several = {i};
    const tpa::Neighbours& n = w.c.neighbours[i];
    several.insert(several.end(), n.cluster, n.cluster + std::min(n.count, tpa::Neighbours::capacity));
    if (!tpa::find_common_sheet(w.c, w.m, {several.data(), static_cast<uint32_t>(several.size())}, sheet)) continue;
    ++proven;
    for (uint32_t k : several) EXPECT_TRUE(sheet.has(k));
  }
  EXPECT_GT(proven, .9 * w.c.count);
}

TEST(Sheets, WaveyAndFoldedSpheres) {
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

// Everything faces outward, and yet the surface lies over itself: only that it covers the plane twice gives it away.
TEST(Sheets, SurfacesThatWindTwiceRoundAnAxis) {
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

TEST(Sheets, RolledUpSheets) {
  // A flat torus rolled into a spiral whose turns come closer and closer, and then pass through one another.
  for (double gap : {.3, .2, .15, .1, .05, .01}) {
    const Mesh m = Mapped(Torus({0, 0, 0}, 3, 1, 60, 24), [&](Point p) {
      const double t = 2.2 * p[0], r = 1 + gap * t / 6 + .04 * p[2];
      return Point{r * tool::cosine(t), r * tool::sine(t), p[1]};
    });
    ExpectAsJudged(m, "rolled");
  }
}

TEST(Sheets, FoldedStarsAndFansOfManyFaces) {
  for (uint64_t seed = 1; seed <= Share(30u); ++seed) {
    Random random(seed);
    // A double cone with a fan of many faces at either end; some link vertices are moved across.
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

TEST(Sheets, SlightlyPerturbedCoincidentSheets) {
  for (double gap : {0., 0x1p-40, 0x1p-26, 0x1p-23, 0x1p-20, 1e-5, 1e-3}) {
    const Mesh sphere = Sphere({0, 0, 0}, 1, 8);
    Mesh inner = sphere;
    for (double& x : inner.positions) x *= 1 - gap;
    ExpectAsJudged(Together({sphere, inner}), "coincident");
    // One facing in, as the inside of a thin shell does.
    for (size_t i = 0; i < inner.triangles.size(); i += 3) std::swap(inner.triangles[i], inner.triangles[i + 1]);
    ExpectAsJudged(Together({sphere, inner}), "shell");
  }
}

TEST(Sheets, TinyAndHugeFacesTogether) {
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

// ---------------------------------------------------------------- what has moved

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

// A set that holds few, against std::set: the order of coming, what is in it, and when it is full.
TEST(ClusterSet, HoldsEachOnceInTheOrderOfComing) {
  uint32_t full = 0, crowded = 0;
  for (uint64_t seed = 1; seed <= Share(2000u); ++seed) {
    Random random(seed);
    tpa::ClusterSet<15, 64> set;
    for (int filling = 0; filling < 2; ++filling) {
      std::vector<uint32_t> expected;
      // Few numbers, or such as share a slot.
      const uint32_t range = 1 + static_cast<uint32_t>(random() % 40), stride = random() % 2 == 0 ? 1 : 64;
      for (int i = 0; i < 60; ++i) {
        const uint32_t wanted = stride * static_cast<uint32_t>(random() % range);
        const bool known = std::find(expected.begin(), expected.end(), wanted) != expected.end();
        const bool fits = known || expected.size() < 15;
        if (!known && fits) expected.push_back(wanted);
        ASSERT_EQ(set.add(wanted), fits) << seed;
        ASSERT_EQ(std::vector<uint32_t>(set.cluster, set.cluster + set.count), expected) << seed;
        const uint8_t place = set.place[set.slot_of(wanted)];
        ASSERT_EQ(place != 0, fits) << seed;
        ASSERT_TRUE(!fits || set.cluster[place - 1] == wanted) << seed;
        full += fits ? 0 : 1;
      }
      crowded += stride == 64 && expected.size() > 5 ? 1 : 0;
      set.clear();
    }
  }
  EXPECT_GT(full, Least(10000));
  EXPECT_GT(crowded, Least(1000));
}

}  // namespace
