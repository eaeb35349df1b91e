// SPDX-License-Identifier: MIT
// Detection. Complete means every pair found by a judge who tries each triangle with each; the vertex hash means
// section 3 cell by cell; threads change nothing (P6).
#include <algorithm>
#include <cmath>

#include "oracle/section_three.h"
#include "support/schedules.h"
#include "support/share.h"
#include "support/support.h"

namespace detect_test {
namespace {

using namespace support;

tpa_config RoomyConfig(const Mesh& m) {
  tpa_config config = DefaultConfig(VertexCount(m) + 8);
  config.max_contacts = 1 << 16;
  return config;
}

Pairs Detected(const Mesh& m, const tpa_config& config, const tpa_exec* exec = nullptr) {
  Arena arena(config, m);
  auto contacts = Sized<tpa_contacts>();
  tpa_issue issue;
  EXPECT_EQ(tpa_detect(*arena, exec, &contacts, &issue), TPA_OK) << Text(issue);
  return PairsOf(contacts);
}

void ExpectComplete(const Mesh& m, const std::string& name) {
  const Pairs expected = AllMeetingPairs(m), found = Detected(m, RoomyConfig(m));
  if (found == expected) return;
  Pairs missed, invented;
  std::set_difference(expected.begin(), expected.end(), found.begin(), found.end(), std::back_inserter(missed));
  std::set_difference(found.begin(), found.end(), expected.begin(), expected.end(), std::back_inserter(invented));
  ADD_FAILURE() << name << ": " << missed.size() << " missed, " << invented.size() << " invented, first "
                << (missed.empty() ? invented : missed).front().first << " "
                << (missed.empty() ? invented : missed).front().second << "; " << Written(m, name);
}

bool HasDegenerateTriangle(const Mesh& m) {
  for (size_t f = 0; f < TriangleCount(m); ++f) {
    const Point a = PositionOf(m, m.triangles[3 * f]), b = PositionOf(m, m.triangles[3 * f + 1]),
                c = PositionOf(m, m.triangles[3 * f + 2]);
    // Flat in three independent directions: no area. Lattice points stay small, so the sums are exact.
    Point n;
    for (size_t i = 0; i < 3; ++i) {
      const size_t k = (i + 1) % 3, l = (i + 2) % 3;
      n[i] = (b[k] - a[k]) * (c[l] - a[l]) - (b[l] - a[l]) * (c[k] - a[k]);
    }
    if (n == Point{0, 0, 0}) return true;
  }
  return false;
}

std::string Seeded(const char* name, uint64_t seed) { return std::string(name) + "-seed-" + std::to_string(seed); }

// ---------------------------------------------------------------- complete

TEST(Complete, CleanMeshesHaveNone) {
  for (const Mesh& m : {Sphere({1, 2, 3}, 2, 6), Torus({0, 0, 0}, 3, 1, 16, 9), Box({0, 0, 0}, {1, 1, 1}, 4),
                        Together({Sphere({0, 0, 0}, 2, 5), Sphere({0.1, 0, 0}, 1, 5)})}) {
    EXPECT_TRUE(IsSound(m, "clean"));
    EXPECT_TRUE(Detected(m, RoomyConfig(m)).empty());
  }
}

TEST(Complete, OverlappingSpheres) {
  for (uint64_t seed = 1; seed <= Share(80u); ++seed) {
    Random random(seed);
    std::vector<Mesh> parts;
    for (int i = 0; i < 3; ++i)
      parts.push_back(
          Sphere(RandomPoint(random, -1, 1), Uniform(random, 0.2, 1.2), 2 + static_cast<int>(random() % 4)));
    ExpectComplete(Together(parts), Seeded("spheres", seed));
  }
}

TEST(Complete, LatticeBoxesThatTouchInFacesEdgesAndVertices) {
  for (uint64_t seed = 1; seed <= Share(120u); ++seed) {
    Random random(seed);
    std::vector<Mesh> parts;
    for (int i = 0; i < 4; ++i) {
      Point low, high;
      for (size_t k = 0; k < 3; ++k) {
        low[k] = static_cast<double>(random() % 4) - 2;
        high[k] = low[k] + static_cast<double>(1 + random() % 2);
      }
      parts.push_back(Box(low, high, 1 + static_cast<int>(random() % 2)));
    }
    ExpectComplete(Together(parts), Seeded("boxes", seed));
  }
}

TEST(Complete, TwoBoxesInEveryKindOfTouch) {
  const Mesh box = Box({0, 0, 0}, {2, 2, 2}, 2);
  for (double x : {0., 1., 2., 3.})
    for (double y : {0., 1., 2., -2.})
      for (double z : {0., .5, 2., -1.}) ExpectComplete(Together({box, Translated(box, {x, y, z})}), "touch");
}

TEST(Complete, NoisySpheresWithFolds) {
  for (uint64_t seed = 1; seed <= Share(80u); ++seed) {
    Random random(seed);
    Mesh m = Sphere({0, 0, 0}, 1, 3 + static_cast<int>(random() % 4));
    const double noise = Uniform(random, 0.05, 0.6);
    for (double& x : m.positions) x += Uniform(random, -noise, noise);
    ExpectComplete(m, Seeded("folds", seed));
  }
}

TEST(Complete, CrumpledOnALattice) {
  // Everything is coplanar or collinear with something.
  int tried = 0;
  for (uint64_t seed = 1; seed <= Share(400u); ++seed) {
    Random random(seed);
    Mesh m = Sphere({0, 0, 0}, 1, 1 + static_cast<int>(random() % 2));
    for (double& x : m.positions) x = static_cast<double>(random() % 9) - 4;
    if (HasDegenerateTriangle(m)) continue;
    ++tried;
    ExpectComplete(m, Seeded("lattice", seed));
  }
  EXPECT_GT(tried, Least(150));
}

// Which pairs of degenerate triangles meet is a matter of definition, but not if any do.
TEST(Complete, DegenerateMeshesAreNotClean) {
  int clean = 0, degenerate = 0;
  for (uint64_t seed = 1; seed <= Share(6000u); ++seed) {
    Random random(seed);
    Mesh m = seed % 2 == 0 ? Sphere({0, 0, 0}, 1, 1)
                           : Mesh{{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}};
    const uint64_t size = 2 + seed / 2 % 3;
    for (double& x : m.positions) x = static_cast<double>(random() % size);
    const bool is_clean = AllMeetingPairs(m).empty();
    ASSERT_EQ(Detected(m, RoomyConfig(m)).empty(), is_clean) << "seed " << seed;
    clean += is_clean;
    degenerate += HasDegenerateTriangle(m);
  }
  EXPECT_GT(clean, Least(200));
  EXPECT_GT(degenerate, Least(1500));
}

TEST(Complete, MixedSizes) {
  for (uint64_t seed = 1; seed <= Share(40u); ++seed) {
    Random random(seed);
    std::vector<Mesh> parts = {Box({-500, -500, -500}, {500, 500, 500}, 1)};
    for (int i = 0; i < 12; ++i) {
      Point p = RandomPoint(random, -500, 500);
      p[random() % 3] = random() % 2 != 0 ? 500 : -500;  // across a side
      const double r = std::pow(10, Uniform(random, 0, 2.5));
      parts.push_back(Sphere(p, r, 2));
    }
    ExpectComplete(Together(parts), Seeded("mixed", seed));
  }
}

TEST(Complete, OneMeshInsideAnother) {
  for (uint64_t seed = 1; seed <= Share(30u); ++seed) {
    Random random(seed);
    const Mesh outer = Sphere({0, 0, 0}, 1, 6);
    const Mesh inner = Sphere(RandomPoint(random, -.03, .03), Uniform(random, 0.9, 1.02), 6);
    ExpectComplete(Together({outer, inner}), Seeded("nested", seed));
  }
}

TEST(Complete, FarFromTheOriginAndAtTheEndsOfTheRange) {
  for (double scale : {0x1p-97, 1e-6, 1e9, 0x1p97})
    for (uint64_t seed = 1; seed <= Share(5u); ++seed) {
      Random random(seed);
      Mesh m = Together({Sphere({0, 0, 0}, 1, 4), Sphere(RandomPoint(random, .3, .9), 1, 4)});
      if (scale > 1)
        for (double& x : m.positions) x += 3;  // away from zero: fewer bits
      for (double& x : m.positions) {
        x *= scale;
        if (std::fabs(x) < 0x1p-100) x = 0;
      }
      ExpectComplete(m, Seeded("range", seed));
    }
}

TEST(Complete, DoesNotDependOnNumberingOrPosition) {
  for (uint64_t seed = 1; seed <= Share(20u); ++seed) {
    Random random(seed);
    const Mesh m = Together({Sphere({0, 0, 0}, 1, 5), Sphere(RandomPoint(random, -1, 1), 1, 4)});
    const size_t pairs = Detected(m, RoomyConfig(m)).size();
    EXPECT_EQ(Detected(Renumbered(m, random), RoomyConfig(m)).size(), pairs) << "seed " << seed;
    for (int rotation = 0; rotation < 24; ++rotation) {
      const Mesh turned = QuarterTurned(m, rotation);
      EXPECT_EQ(Detected(turned, RoomyConfig(m)).size(), pairs) << "seed " << seed << ", rotation " << rotation;
    }
  }
}

TEST(Complete, MorePairsThanFitAreCounted) {
  const Mesh m = Together({Sphere({0, 0, 0}, 1, 6), Sphere({0.5, 0, 0}, 1, 6)});
  const size_t pairs = AllMeetingPairs(m).size();
  for (uint32_t room : {uint32_t{1}, static_cast<uint32_t>(pairs) - 1, static_cast<uint32_t>(pairs)}) {
    tpa_config config = RoomyConfig(m);
    config.max_contacts = room;
    Arena arena(config, m);
    const Observed before = Observe(*arena);
    auto contacts = Sized<tpa_contacts>();
    tpa_issue issue;
    if (room == pairs) {
      EXPECT_EQ(tpa_detect(*arena, nullptr, &contacts, &issue), TPA_OK);
      continue;
    }
    EXPECT_EQ(tpa_detect(*arena, nullptr, &contacts, &issue), TPA_E_LIMIT);
    EXPECT_EQ(issue.limit, TPA_LIMIT_CONTACTS);
    EXPECT_EQ(issue.needed, pairs);
    EXPECT_EQ(issue.available, room);
    EXPECT_TRUE(Observe(*arena) == before);
  }
}

// ---------------------------------------------------------------- section 3 cell by cell

Pairs BySectionThree(const Mesh& m, double l) {
  return PairsBySectionThree(m, l, [&](uint32_t f, uint32_t g) { return TrianglesMeet(m, f, g); });
}

// Some coordinates go to the nearest wall of a cell, or to the number before or after it.
void PutOnWalls(Mesh& m, double cell, Random& random) {
  for (double& x : m.positions) {
    if (random() % 8 != 0) continue;
    const double wall = std::round(x / cell) * cell;
    const double beyond[] = {wall, std::nextafter(wall, -1e9), std::nextafter(wall, 1e9)};
    x = beyond[wall == 0 ? 0 : random() % 3];  // beside zero numbers are too small for the library
  }
}

TEST(VertexHash, IsSectionThreeCellByCell) {
  size_t fewer = 0, some = 0, judged = 0;
  for (uint64_t seed = 1; seed <= Share(120u); ++seed) {
    Random random(seed);
    Mesh m = Together({Sphere(RandomPoint(random, -5, 5), 4, 4), Sphere(RandomPoint(random, -5, 5), 4, 5)});
    if (seed % 3 == 0)
      for (double& x : m.positions) x += Uniform(random, -1, 1);
    tpa_config config = RoomyConfig(m);
    config.max_vertices += static_cast<uint32_t>(random() % 100);
    config.detect_mode = TPA_DETECT_VERTEX_HASH;
    config.cell_size = std::pow(2, Uniform(random, -2, 3));
    if (seed % 4 == 0) PutOnWalls(m, config.cell_size, random);
    if (HasDegenerateTriangle(m)) continue;  // beyond the oracle
    ++judged;
    const Pairs expected = BySectionThree(m, config.cell_size);
    const Pairs found = Detected(m, config);
    EXPECT_EQ(found, expected) << Written(m, Seeded("hash", seed)) << ", cell " << config.cell_size;
    const Pairs all = AllMeetingPairs(m);
    EXPECT_TRUE(std::includes(all.begin(), all.end(), found.begin(), found.end())) << "seed " << seed;
    some += found.empty() ? 0u : 1u;
    fewer += found.size() < all.size() ? 1u : 0u;
  }
  EXPECT_GT(judged, Least(100u));
  EXPECT_GT(some, Least(50u));
  EXPECT_GT(fewer, Least(10u)) << "it is known to miss pairs";
}

TEST(VertexHash, CellsOfNegativeAndHugeCoordinates) {
  for (double shift : {-1e3, -0.5, 1e6, -3e9}) {
    const Mesh m = Translated(Together({Sphere({0, 0, 0}, 4, 4), Sphere({3, 2, 1}, 4, 4)}), {shift, -shift, shift / 2});
    tpa_config config = RoomyConfig(m);
    config.detect_mode = TPA_DETECT_VERTEX_HASH;
    EXPECT_EQ(Detected(m, config), BySectionThree(m, 1)) << shift;
  }
}

// 2V slots, of any V: cells that share a slot do not count as one.
TEST(VertexHash, DoesNotDependOnTheNumberOfSlots) {
  size_t pairs = 0;
  for (uint64_t seed = 1; seed <= Share(20u); ++seed) {
    Random random(seed);
    const Mesh m = Together({Sphere({0, 0, 0}, 4, 3), Sphere(RandomPoint(random, -4, 4), 4, 4)});
    tpa_config config = RoomyConfig(m);
    config.detect_mode = TPA_DETECT_VERTEX_HASH;
    config.cell_size = std::pow(2, Uniform(random, 0, 2.5));
    const Pairs expected = BySectionThree(m, config.cell_size);
    pairs += expected.size();
    for (uint32_t times : {1u, 2u, 4u, 16u})
      for (uint32_t more = 0; more < 8; ++more) {
        config.max_vertices = times * VertexCount(m) + more;
        ASSERT_EQ(Detected(m, config), expected) << Written(m, Seeded("slots", seed)) << ", " << config.max_vertices;
      }
  }
  EXPECT_GT(pairs, Least(400u));
}

// ---------------------------------------------------------------- threads

tpa_exec ExecWith(void (*parallel_for)(void*, uint32_t, Task, void*)) {
  auto exec = Sized<tpa_exec>();
  exec.parallel_for = parallel_for;
  return exec;
}

TEST(Threads, DetectionHasTheSameBitsWhateverRunsIt) {
  const Mesh m = Together({Sphere({0, 0, 0}, 1, 24), Sphere({.4, .3, .2}, 1, 24), Sphere({-.5, 0, .1}, .7, 16)});
  const Pairs serial = Detected(m, RoomyConfig(m));
  ASSERT_GT(serial.size(), 500u);
  for (auto* run : {Backwards, OnTwoThreads}) {
    const tpa_exec exec = ExecWith(run);
    for (int repeat = 0; repeat < 5; ++repeat) EXPECT_EQ(Detected(m, RoomyConfig(m), &exec), serial);
  }
}

TEST(Threads, EveryCallLeavesTheSameBits) {
  const Mesh m = Together({Sphere({0, 0, 0}, 1, 24), Sphere({.4, .3, .2}, 1, 24)});
  const auto run = [&](const tpa_exec* exec) {
    tpa_config config = ConfigFor(m);
    config.max_contacts = 1 << 14;
    Arena arena(config, m);
    tpa_issue issue;
    std::string seen;
    const auto note = [&](tpa_status status) {
      EXPECT_EQ(status, TPA_OK) << Text(issue);
      seen += Observe(*arena).bytes;
    };
    note(tpa_adapt(*arena, exec, nullptr, &issue));
    std::vector<double> targets = MeshOf(*arena).positions;
    for (size_t i = 0; i < targets.size(); ++i) targets[i] *= i % 3 == 0 ? 0.97 : 1.02;
    EXPECT_EQ(MoveAll(*arena, targets), TPA_OK);
    note(tpa_step(*arena, exec, nullptr, &issue));
    auto remesh = Sized<tpa_remesh_options>();
    remesh.iterations = 2;
    remesh.target_length = 0.08;
    remesh.relaxation = 0.5;
    note(tpa_remesh(*arena, &remesh, exec, nullptr, &issue));
    auto smooth = Sized<tpa_smooth_options>();
    smooth.iterations = 3;
    note(tpa_smooth(*arena, &smooth, exec, nullptr, &issue));
    return seen;
  };
  const std::string serial = run(nullptr);
  for (auto* parallel_for : {Backwards, OnTwoThreads}) {
    const tpa_exec exec = ExecWith(parallel_for);
    EXPECT_TRUE(run(&exec) == serial);
  }
}

TEST(Threads, AnExecOfUnknownVersionIsRefusedAndWithoutFunctionIsSerial) {
  const Mesh m = Sphere({0, 0, 0}, 1, 3);
  Arena arena(ConfigFor(m), m);
  tpa_issue issue;
  tpa_exec exec = ExecWith(Backwards);
  exec.struct_size = offsetof(tpa_exec, parallel_for);
  EXPECT_EQ(tpa_step(*arena, &exec, nullptr, &issue), TPA_E_ARGUMENT);
  EXPECT_EQ(issue.argument, 2);
  exec = ExecWith(nullptr);
  EXPECT_EQ(tpa_step(*arena, &exec, nullptr, &issue), TPA_OK);
}

}  // namespace
}  // namespace detect_test
