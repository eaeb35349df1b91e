// SPDX-License-Identifier: MIT
// Smoothing: noise goes, the size stays (Taubin 1995), and no vertex moves into another part.
#include <cmath>
#include <numeric>

#include "support/share.h"
#include "support/support.h"

namespace smooth_test {
namespace {

using namespace support;

tpa_smooth_options Rounds(uint32_t iterations) {
  auto options = Sized<tpa_smooth_options>();
  options.iterations = iterations;
  return options;
}

Mesh NoisySphere(uint64_t seed, double noise) {
  Random random(seed);
  Mesh m = Sphere({0, 0, 0}, 1, 10);
  for (size_t v = 0; v < VertexCount(m); ++v) {
    const double r = 1 + Uniform(random, -noise, noise);
    for (size_t i = 0; i < 3; ++i) m.positions[3 * v + i] *= r;
  }
  return m;
}

struct Radii {
  double mean = 0, deviation = 0;
};
Radii RadiiOf(const Mesh& m) {
  Radii r;
  double squares = 0;
  const auto n = static_cast<double>(VertexCount(m));
  for (size_t v = 0; v < VertexCount(m); ++v) {
    const Point p = PositionOf(m, v);
    const double x = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    r.mean += x / n;
    squares += x * x / n;
  }
  r.deviation = std::sqrt(std::max(0.0, squares - r.mean * r.mean));
  return r;
}

TEST(Smooth, TakesNoiseAwayAndKeepsTheSize) {
  for (uint64_t seed = 1; seed <= Share(5u); ++seed) {
    const Mesh m = NoisySphere(seed, 0.03);
    Arena arena(ConfigFor(m), m);
    const tpa_smooth_options options = Rounds(10);
    auto report = Sized<tpa_report>();
    tpa_issue issue;
    ASSERT_EQ(tpa_smooth(*arena, &options, nullptr, &report, &issue), TPA_OK) << Text(issue);
    const Mesh after = MeshOf(*arena);
    EXPECT_TRUE(IsSound(after, "smooth"));
    EXPECT_EQ(after.triangles, m.triangles);
    EXPECT_EQ(report.moved, VertexCount(m));
    EXPECT_LT(RadiiOf(after).deviation, 0.5 * RadiiOf(m).deviation) << "seed " << seed;
    EXPECT_NEAR(RadiiOf(after).mean, RadiiOf(m).mean, 0.01) << "seed " << seed;
    EXPECT_NEAR(TopologyOf(after).Volume(), TopologyOf(m).Volume(), 0.02 * TopologyOf(m).Volume());
  }
}

TEST(Smooth, ManyRoundsDoNotShrink) {
  // Below the pass band a round amplifies by a little, above it damps: Laplacian smoothing alone would leave a point.
  const Mesh m = Sphere({0, 0, 0}, 1, 8);
  Arena arena(ConfigFor(m), m);
  const tpa_smooth_options options = Rounds(40);
  ASSERT_EQ(tpa_smooth(*arena, &options, nullptr, nullptr, nullptr), TPA_OK);
  const double ratio = TopologyOf(MeshOf(*arena)).Volume() / TopologyOf(m).Volume();
  EXPECT_GT(ratio, 0.99);
  EXPECT_LT(ratio, 1.2);
}

TEST(Smooth, IsTheFormulaToTheBitWhereNothingIsInTheWay) {
  // p' = p + factor * (mean of the neighbours - p), with lambda and then mu, up to the order of the sum.
  const Mesh m = NoisySphere(3, 0.01);
  tpa_config config = ConfigFor(m);
  Arena arena(config, m);
  const tpa_smooth_options options = Rounds(1);
  ASSERT_EQ(tpa_smooth(*arena, &options, nullptr, nullptr, nullptr), TPA_OK);
  std::vector<double> p = m.positions;
  for (double factor : {config.smooth_lambda, config.smooth_mu}) {
    std::vector<double> sum(p.size());
    std::vector<double> count(p.size() / 3);
    for (size_t f = 0; f < m.triangles.size(); f += 3)
      for (size_t i = 0; i < 3; ++i) {
        // Every edge is met once in each direction.
        const size_t a = m.triangles[f + i], b = m.triangles[f + (i + 1) % 3];
        count[a] += 1;
        for (size_t k = 0; k < 3; ++k) sum[3 * a + k] += p[3 * b + k];
      }
    for (size_t i = 0; i < p.size(); ++i) p[i] += factor * (sum[i] / count[i / 3] - p[i]);
  }
  const Mesh after = MeshOf(*arena);
  for (size_t i = 0; i < p.size(); ++i) ASSERT_NEAR(after.positions[i], p[i], 1e-14) << i;
}

// Smoothing moves vertices outwards too; as far as numbers go, and no farther.
TEST(Smooth, StaysWithinTheRangeOfNumbers) {
  for (uint64_t seed = 1; seed <= Share(20u); ++seed) {
    Random random(seed);
    Mesh m = Sphere({0, 0, 0}, 1, 4);
    for (double& x : m.positions) x += Uniform(random, -0.05, 0.05);
    double largest = 0;
    for (double x : m.positions) largest = std::max(largest, std::abs(x));
    for (double& x : m.positions) x *= 0x1p100 / largest;
    auto remeshing = Sized<tpa_remesh_options>();
    remeshing.target_length = 0x1p98;
    remeshing.iterations = 3;
    remeshing.relaxation = 1;
    const tpa_smooth_options options = Rounds(3);
    for (bool remesh : {false, true}) {
      tpa_config config = ConfigFor(m);
      config.max_vertices *= 2;
      Arena arena(config, m);
      tpa_issue issue;
      const tpa_status status = remesh ? tpa_remesh(*arena, &remeshing, nullptr, nullptr, &issue)
                                       : tpa_smooth(*arena, &options, nullptr, nullptr, &issue);
      ASSERT_EQ(status, TPA_OK) << Text(issue);
      auto validation = Sized<tpa_validation>();
      EXPECT_EQ(tpa_validate(*arena, nullptr, &validation, &issue), TPA_OK) << Text(issue) << ", seed " << seed;
    }
  }
}

TEST(Smooth, OnlyTheVerticesThatAreNamedMove) {
  const Mesh m = NoisySphere(1, 0.03);
  Arena arena(ConfigFor(m), m);
  const uint32_t ids[4] = {5, 17, 5, 100};  // a vertex twice
  tpa_smooth_options options = Rounds(3);
  options.count = 4;
  options.vertices = ids;
  auto report = Sized<tpa_report>();
  ASSERT_EQ(tpa_smooth(*arena, &options, nullptr, &report, nullptr), TPA_OK);
  const Mesh after = MeshOf(*arena);
  EXPECT_EQ(report.moved, 3u);
  for (size_t v = 0; v < VertexCount(m); ++v) {
    const bool named = v == 5 || v == 17 || v == 100;
    EXPECT_EQ(PositionOf(after, v) == PositionOf(m, v), !named) << v;
  }
}

TEST(Smooth, AVertexThatWouldRunIntoAnotherPartStays) {
  for (uint64_t seed = 1; seed <= Share(20u); ++seed) {
    // A spike of a wall reaches through a hole too narrow for its smoothed shape: shells with common noise.
    Random random(seed);
    Mesh outer = Sphere({0, 0, 0}, 1, 8), inner = outer;
    for (size_t v = 0; v < VertexCount(outer); ++v) {
      const double r = Uniform(random, 0.85, 1.15);
      for (size_t i = 0; i < 3; ++i) {
        outer.positions[3 * v + i] *= r;
        inner.positions[3 * v + i] *= r - 0.004;
      }
    }
    for (size_t i = 0; i < inner.triangles.size(); i += 3) std::swap(inner.triangles[i], inner.triangles[i + 1]);
    const Mesh m = Together({outer, inner});
    if (!AllMeetingPairs(m).empty()) continue;
    Arena arena(ConfigFor(m), m);
    // Only the first shell is smoothed, into contact with the second.
    std::vector<uint32_t> ids(VertexCount(outer));
    for (uint32_t i = 0; i < ids.size(); ++i) ids[i] = i;
    tpa_smooth_options options = Rounds(10);
    options.count = static_cast<uint32_t>(ids.size());
    options.vertices = ids.data();
    auto report = Sized<tpa_report>();
    ASSERT_EQ(tpa_smooth(*arena, &options, nullptr, &report, nullptr), TPA_OK);
    const Mesh after = MeshOf(*arena);
    EXPECT_TRUE(IsSound(after, "shells")) << "seed " << seed;
    uint32_t moved = 0;
    for (size_t v = 0; v < VertexCount(m); ++v) moved += PositionOf(after, v) == PositionOf(m, v) ? 0u : 1u;
    EXPECT_EQ(moved, report.moved) << "seed " << seed;
    EXPECT_LT(moved, ids.size()) << "seed " << seed << ": nothing was in the way";
  }
}

TEST(Smooth, RefusesWhatDoesNotExist) {
  const Mesh m = Sphere({0, 0, 0}, 1, 3);
  Arena arena(ConfigFor(m), m);
  const Observed before = Observe(*arena);
  const uint32_t ids[2] = {0, VertexCount(m)};
  tpa_smooth_options options = Rounds(1);
  options.count = 2;
  options.vertices = ids;
  tpa_issue issue;
  EXPECT_EQ(tpa_smooth(*arena, &options, nullptr, nullptr, &issue), TPA_E_MESH);
  EXPECT_EQ(issue.other, VertexCount(m));
  options.struct_size = 1;
  EXPECT_EQ(tpa_smooth(*arena, &options, nullptr, nullptr, &issue), TPA_E_ARGUMENT);
  EXPECT_EQ(issue.argument, 2);
  EXPECT_TRUE(Observe(*arena) == before);
}

TEST(Smooth, TargetsMapsAndEventsAreForgottenAtTheCommit) {
  const Mesh m = Together({Sphere({0, 0, 0}, 1, 4), Sphere({2.1, 0, 0}, 1, 4)});
  Arena arena(ConfigFor(m), m);
  std::vector<double> targets = m.positions;
  for (size_t i = 0; i < targets.size() / 2; i += 3) targets[i] += .4;
  ASSERT_EQ(MoveAll(*arena, targets), TPA_OK);
  ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_OK);
  ASSERT_FALSE(EventsOf(*arena).empty());
  const Mesh merged = MeshOf(*arena);
  ASSERT_EQ(MoveAll(*arena, {3, 3, 3}), TPA_OK);
  const tpa_smooth_options none = Rounds(0);
  ASSERT_EQ(tpa_smooth(*arena, &none, nullptr, nullptr, nullptr), TPA_OK);
  EXPECT_TRUE(EventsOf(*arena).empty());
  const std::vector<uint32_t> map = OldToNewOf(*arena);
  ASSERT_EQ(map.size(), VertexCount(merged));
  for (uint32_t v = 0; v < map.size(); ++v) EXPECT_EQ(map[v], v);
  ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_OK);
  EXPECT_EQ(MeshOf(*arena).positions, merged.positions);
}

TEST(Smooth, ThinBodiesAreNotTurnedInsideOut) {
  uint32_t tried = 0, moved = 0;
  for (uint64_t seed = 1; seed <= Share(20000u); ++seed) {
    Random random(seed);
    const Mesh m = ThinBody(random);
    if (!AllMeetingPairs(m).empty()) continue;
    ++tried;
    Arena arena(DefaultConfig(100), m);
    const tpa_smooth_options options = Rounds(static_cast<uint32_t>(1 + seed % 20));
    auto report = Sized<tpa_report>();
    ASSERT_EQ(tpa_smooth(*arena, &options, nullptr, &report, nullptr), TPA_OK) << "seed " << seed;
    moved += report.moved > 0 ? 1u : 0u;
    EXPECT_EQ(TopologyOf(MeshOf(*arena)).Volume() < 0, TopologyOf(m).Volume() < 0) << "seed " << seed;
  }
  EXPECT_GT(tried, Least(3000u));
  EXPECT_GT(moved, Least(1000u));
}

// Bodies as flat as the uncertainty of known volumes, beside a large body.
TEST(Smooth, DoesNotDependOnWhatIsKnown) {
  for (const uint64_t seed : {99u, 143u, 376u}) {
    Random random(seed);
    Mesh thin = ThinBody(random);
    const double flatness = std::pow(10, Uniform(random, -7.5, -4.5));
    for (size_t i = 2; i < thin.positions.size(); i += 3) thin.positions[i] *= flatness;
    const Mesh large = Sphere({10, 0, 0}, 1, 60), m = Together({large, thin});
    std::vector<double> targets = m.positions;
    targets[0] += 1e-5;
    std::vector<uint32_t> vertices(VertexCount(thin));
    std::iota(vertices.begin(), vertices.end(), VertexCount(large));
    auto options = Rounds(5);
    options.vertices = vertices.data();
    options.count = VertexCount(thin);
    Mesh smoothed[2];
    for (const bool validated : {false, true}) {
      Arena arena(ConfigFor(m), m);
      ASSERT_EQ(MoveAll(*arena, targets), TPA_OK);
      ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_OK);
      auto validation = Sized<tpa_validation>();
      if (validated) {
        ASSERT_EQ(tpa_validate(*arena, nullptr, &validation, nullptr), TPA_OK);
      }
      ASSERT_EQ(tpa_smooth(*arena, &options, nullptr, nullptr, nullptr), TPA_OK);
      smoothed[validated ? 1 : 0] = MeshOf(*arena);
    }
    EXPECT_EQ(smoothed[0].positions, smoothed[1].positions) << "seed " << seed;
  }
}

}  // namespace
}  // namespace smooth_test
