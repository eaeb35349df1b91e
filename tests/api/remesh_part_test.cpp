// SPDX-License-Identifier: MIT
// Remeshing of a part of the mesh, towards lengths that differ from place to place, and of what has changed since the
// last call. The oracles: a context that knows of no changes, the whole mesh as the part, the exact judge.
#include <algorithm>
#include <cmath>
#include <set>

#include "api/api.h"
#include "support/share.h"
#include "support/step_scenes.h"
#include "support/support.h"

namespace remesh_part_test {
namespace {

using namespace support;

tpa_remesh_options OptionsFor(double target, uint32_t iterations) {
  auto options = Sized<tpa_remesh_options>();
  options.iterations = iterations;
  options.target_length = target;
  options.relaxation = 0.5;
  return options;
}

uint64_t DigestOf(const tpa_context* context) {
  uint64_t digest = 0;
  EXPECT_EQ(tpa_digest(context, &digest), TPA_OK);
  return digest;
}

// Gives `to` the state of `from`, but nothing that `from` knows besides.
void CarryState(const tpa_context* from, tpa_context* to) {
  size_t size = 0;
  tpa_save(from, nullptr, 0, &size, nullptr);
  std::vector<uint8_t> state(size);
  ASSERT_EQ(tpa_save(from, state.data(), size, &size, nullptr), TPA_OK);
  ASSERT_EQ(tpa_restore(to, state.data(), size, nullptr), TPA_OK);
}

struct Done {
  tpa_report report = Sized<tpa_report>();
  uint64_t units = 0, digest = 0;
};

Done RemeshedWith(tpa_context* context, const tpa_remesh_options& options) {
  Done done;
  auto exec = Sized<tpa_exec>();
  exec.progress = &done.units;
  tpa_issue issue;
  EXPECT_EQ(tpa_remesh(context, &options, &exec, &done.report, &issue), TPA_OK) << Text(issue);
  done.digest = DigestOf(context);
  return done;
}

uint32_t Operations(const Done& done) { return done.report.splits + done.report.collapses + done.report.flips; }

void ExpectEqual(const Done& a, const Done& b, const std::string& name) {
  EXPECT_EQ(a.digest, b.digest) << name;
  EXPECT_EQ(a.report.splits, b.report.splits) << name;
  EXPECT_EQ(a.report.collapses, b.report.collapses) << name;
  EXPECT_EQ(a.report.flips, b.report.flips) << name;
  EXPECT_EQ(a.report.moved, b.report.moved) << name;
}

std::vector<uint32_t> VerticesWithin(const Mesh& m, const Point& at, double reach) {
  std::vector<uint32_t> ids;
  for (uint32_t v = 0; v < VertexCount(m); ++v)
    if (Distance(PositionOf(m, v), at) < reach) ids.push_back(v);
  return ids;
}

// Moves the vertices round a random place, or all of them, or a few by themselves.
void StepSomewhere(tpa_context* context, Random& random) {
  const Mesh m = MeshOf(context);
  const Point at = PositionOf(m, static_cast<uint32_t>(random() % VertexCount(m)));
  const double reach = random() % 4 == 0 ? 10 : Uniform(random, 0.1, 0.6), factor = Uniform(random, 0.9, 1.15);
  std::vector<double> targets = m.positions;
  const bool scattered = random() % 2 == 0;
  for (uint32_t i = 0; scattered && i < 30; ++i) targets[random() % targets.size()] += Uniform(random, -0.05, 0.05);
  for (uint32_t v = 0; !scattered && v < VertexCount(m); ++v)
    if (Distance(PositionOf(m, v), at) < reach)
      for (size_t k = 0; k < 3; ++k) targets[3 * v + k] = factor * targets[3 * v + k] + Uniform(random, -0.01, 0.01);
  ASSERT_EQ(MoveAll(context, targets), TPA_OK);
  tpa_issue issue;
  ASSERT_EQ(tpa_step(context, nullptr, nullptr, &issue), TPA_OK) << Text(issue);
}

// A call with too small a budget, in most cases. True if it failed.
bool FailSomewhere(tpa_context* context, tpa_remesh_options options, Random& random) {
  auto exec = Sized<tpa_exec>();
  exec.budget = 1 + random() % (random() % 2 == 0 ? 1000 : 400000);
  if (random() % 3 > 0) {
    if (random() % 4 == 0) options.target_length *= 0.8;
    return tpa_remesh(context, &options, &exec, nullptr, nullptr) != TPA_OK;
  }
  std::vector<double> targets = MeshOf(context).positions;
  for (double& x : targets) x *= 1.1;
  EXPECT_EQ(MoveAll(context, targets), TPA_OK);
  const bool failed = tpa_advance(context, 0.05, &exec, nullptr, nullptr) != TPA_OK;
  tpa_drop_targets(context);
  return failed;
}

// Whatever went before, a look at the changes gives the bits of a look at everything.
TEST(RemeshPart, ChangesAreAllThatASweepNeeds) {
  uint32_t operations = 0, failed = 0;
  tpa_config config = DefaultConfig(20000);
  config.max_substeps = 20;
  for (uint64_t seed = 1; seed <= Share(5u); ++seed) {
    Random random(seed);
    const Mesh m = Together({Torus({0, 0, 0}, 1, 0.4, 30, 15), Sphere({0, 0, 2}, 0.7, 8)});
    Arena known(config, m), anew(config, m);
    std::vector<float> lengths;
    for (int round = 0; round < 20; ++round) {
      const std::string name = "seed " + std::to_string(seed) + ", round " + std::to_string(round);
      StepSomewhere(*known, random);
      if (random() % 4 == 0) StepSomewhere(*known, random);
      auto options = OptionsFor(random() % 16 == 0 ? 0.2 : 0.12, static_cast<uint32_t>(1 + random() % 8));
      if (random() % 3 == 0 && FailSomewhere(*known, options, random)) ++failed;
      if (random() % 12 == 0) {
        lengths.resize(VertexCount(MeshOf(*known)));
        for (float& x : lengths) x = static_cast<float>(Uniform(random, 0.1, 0.2));
        options.lengths = lengths.data();
      }
      std::vector<uint32_t> part;
      if (random() % 3 == 0) {
        const Mesh now = MeshOf(*known);
        part = VerticesWithin(now, PositionOf(now, static_cast<uint32_t>(random() % VertexCount(now))), 0.6);
        options.vertices = part.data();
        options.count = static_cast<uint32_t>(part.size());
      }
      CarryState(*known, *anew);
      const Done a = RemeshedWith(*known, options), b = RemeshedWith(*anew, options);
      ExpectEqual(a, b, name);
      operations += Operations(a);
      ASSERT_FALSE(HasFailure());
    }
    EXPECT_TRUE(IsSound(MeshOf(*known), "changes-seed-" + std::to_string(seed)));
  }
  EXPECT_GT(operations, Least(4000u));
  EXPECT_GT(failed, Least(15u));
}

// Counted in units of work: a mesh at rest, and a mesh with a few moved vertices.
TEST(RemeshPart, ASweepOfAMeshAtRestCostsNextToNothing) {
  Arena arena(DefaultConfig(40000), Sphere({0, 0, 0}, 1, 40));
  const tpa_remesh_options options = OptionsFor(0.025, 1);
  Done last;
  for (int i = 0; i < 100 && (i == 0 || Operations(last) > 0); ++i) last = RemeshedWith(*arena, options);
  ASSERT_EQ(Operations(last), 0u);
  const Mesh m = MeshOf(*arena);
  ASSERT_GT(VertexCount(m), 15000u);
  EXPECT_LT(RemeshedWith(*arena, options).units, VertexCount(m) / 100);
  EXPECT_EQ(MeshOf(*arena).positions, m.positions);
  Arena anew(DefaultConfig(40000), m);
  EXPECT_GT(RemeshedWith(*anew, options).units, VertexCount(m) / 2);

  std::vector<double> target = {m.positions[0] * 1.002, m.positions[1] * 1.002, m.positions[2] * 1.002};
  ASSERT_EQ(MoveSome(*arena, {0}, target), TPA_OK);
  ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_OK);
  EXPECT_LT(RemeshedWith(*arena, options).units, VertexCount(m) / 50);
}

// Volumes of bodies are measured for what a sweep tries: a mesh at rest keeps them as they were.
TEST(RemeshPart, ASweepOfAMeshAtRestMeasuresNoVolume) {
  Arena arena(DefaultConfig(4000), Sphere({0, 0, 0}, 1, 6));
  const tpa_remesh_options options = OptionsFor(.2, 1);
  Done last;
  for (int i = 0; i < 100 && (i == 0 || Operations(last) > 0); ++i) last = RemeshedWith(*arena, options);
  ASSERT_EQ(Operations(last), 0u);
  double& sum = tpa::table_data<tpa::Component>(*tpa::context_of(*arena), tpa::table_components)[0].volume.sum;
  sum = -1;
  RemeshedWith(*arena, options);
  EXPECT_EQ(sum, -1);
}

TEST(RemeshPart, AllVerticesAndEqualLengthsAreTheWholeMesh) {
  for (uint64_t seed = 1; seed <= Share(10u); ++seed) {
    Random random(seed);
    Mesh m = Torus({0, 0, 0}, 1, 0.4, 24, 12);
    for (double& x : m.positions) x += Uniform(random, -0.03, 0.03);
    if (!AllMeetingPairs(m).empty()) continue;
    const tpa_config config = DefaultConfig(20000);
    // A power of two, so that lengths as parts of it round nothing.
    const auto whole = OptionsFor(seed % 2 == 0 ? 0.125 : 0.25, 3);
    auto part = whole, lengths = whole;
    std::vector<uint32_t> all(VertexCount(m));
    for (uint32_t v = 0; v < all.size(); ++v) all[v] = v;
    std::shuffle(all.begin(), all.end(), random);
    part.vertices = all.data();
    part.count = VertexCount(m);
    const std::vector<float> equal(VertexCount(m), static_cast<float>(whole.target_length));
    lengths.lengths = equal.data();
    lengths.target_length = 0;
    Arena a(config, m), b(config, m), c(config, m);
    const Done done = RemeshedWith(*a, whole);
    EXPECT_GT(Operations(done), 100u);
    ExpectEqual(done, RemeshedWith(*b, part), "part, seed " + std::to_string(seed));
    ExpectEqual(done, RemeshedWith(*c, lengths), "lengths, seed " + std::to_string(seed));
  }
}

// Lengths for each vertex leave the faces beyond the part unseen; one length looks at all faces.
TEST(RemeshPart, APartWithEqualLengthsIsAPartWithALength) {
  for (uint64_t seed = 1; seed <= Share(10u); ++seed) {
    Random random(seed);
    Mesh m = Torus({0, 0, 0}, 1, 0.4, 30, 15);
    for (double& x : m.positions) x += Uniform(random, -0.02, 0.02);
    if (!AllMeetingPairs(m).empty()) continue;
    const tpa_config config = DefaultConfig(20000);
    Arena a(config, m), b(config, m);
    const auto first = OptionsFor(0.25, 1);
    ExpectEqual(RemeshedWith(*a, first), RemeshedWith(*b, first), "whole");
    m = MeshOf(*a);
    const Point at = PositionOf(m, static_cast<uint32_t>(random() % VertexCount(m)));
    const std::vector<uint32_t> ids = VerticesWithin(m, at, 0.6);
    auto one = OptionsFor(0.125, 3), each = one;
    one.vertices = each.vertices = ids.data();
    one.count = each.count = static_cast<uint32_t>(ids.size());
    const std::vector<float> equal(VertexCount(m), 0.125f);
    each.lengths = equal.data();
    const Done done = RemeshedWith(*a, one);
    EXPECT_GT(Operations(done), 10u);
    ExpectEqual(done, RemeshedWith(*b, each), "seed " + std::to_string(seed));
  }
}

// Counted in units of work.
TEST(RemeshPart, APartWithLengthsCostsWhatThePartCosts) {
  Arena arena(DefaultConfig(40000), Sphere({0, 0, 0}, 1, 40));
  auto options = OptionsFor(0.025, 1);
  for (int i = 0; i < 100 && (i == 0 || Operations(RemeshedWith(*arena, options)) > 0); ++i) continue;
  const Mesh m = MeshOf(*arena);
  const std::vector<float> lengths(VertexCount(m), 0.025f);
  const std::vector<uint32_t> ids = VerticesWithin(m, PositionOf(m, 0), 0.1);
  options.lengths = lengths.data();
  options.vertices = ids.data();
  options.count = static_cast<uint32_t>(ids.size());
  EXPECT_LT(RemeshedWith(*arena, options).units, VertexCount(m) / 50);

  // Edges elsewhere wait for a call that may change them, however much has moved there.
  std::vector<double> targets = m.positions;
  for (size_t i = 0; i < targets.size(); i += 6) targets[i] *= 1.0001;
  ASSERT_EQ(MoveAll(*arena, targets), TPA_OK);
  ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_OK);
  EXPECT_LT(RemeshedWith(*arena, options).units, VertexCount(m) / 25);
}

// Two neighbours in a plane become one vertex, which alone relaxes: in each iteration half of the way that is left to
// the mean of its neighbours, though nothing else happens any more.
TEST(RemeshPart, ASingleVertexRelaxesInEachIteration) {
  const Mesh m = Mapped(Box({0, 0, 0}, {1, 1, 1}, 6), [](const Point& p) {
    return Point{p[0] * (1 + p[0]) / 2, p[1] * (1 + p[1]) / 2, p[2]};
  });
  const std::vector<uint32_t> pair = VerticesWithin(m, {.3, .375, 1}, .08);
  ASSERT_EQ(pair.size(), 2u);
  Point first{};
  for (uint32_t iterations = 1; iterations <= 12; ++iterations) {
    auto options = OptionsFor(.24, iterations);
    options.vertices = pair.data();
    options.count = 2;
    Arena arena(ConfigFor(m), m);
    const Done done = RemeshedWith(*arena, options);
    ASSERT_EQ(done.report.collapses, 1u);
    ASSERT_EQ(Operations(done), 1u);
    const Mesh after = MeshOf(*arena);
    const std::vector<tpa_vertex_origin> origins = VertexOriginsOf(*arena);
    uint32_t left = 0;
    while (origins[left].parents[1] == TPA_NONE) ++left;
    std::set<uint32_t> ring;
    for (size_t h = 0; h < after.triangles.size(); ++h)
      if (after.triangles[h] == left)
        for (size_t i = 1; i < 3; ++i) ring.insert(after.triangles[h - h % 3 + (h + i) % 3]);
    Point mean{};
    for (uint32_t v : ring) mean = Sum(mean, Scaled(1. / static_cast<double>(ring.size()), PositionOf(after, v)));
    const Point now = PositionOf(after, left);
    if (iterations == 1) {
      first = now;
      EXPECT_GT(Distance(first, mean), .005);
    }
    const Point wanted = Sum(mean, Scaled(std::pow(.5, iterations - 1), Difference(first, mean)));
    EXPECT_LT(Distance(now, wanted), 1e-12) << iterations << " iterations";
  }
}

using Corners = std::array<uint32_t, 3>;
Corners Rotated(Corners t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

TEST(RemeshPart, TheRestKeepsItsBits) {
  uint32_t operations = 0, kept = 0;
  for (uint64_t seed = 1; seed <= Share(12u); ++seed) {
    Random random(seed);
    const std::string name = "part-seed-" + std::to_string(seed);
    const Mesh m = Torus({0, 0, 0}, 1, 0.4, 40, 20);
    Arena arena(DefaultConfig(40000), m);
    std::vector<uint32_t> part;
    const double below = Uniform(random, -0.5, 0.8);
    for (uint32_t v = 0; v < VertexCount(m); ++v)
      if (seed % 3 == 0 ? random() % 2 == 0 : m.positions[3 * v] < below) part.push_back(v);
    const std::set<uint32_t> chosen(part.begin(), part.end());
    part.insert(part.end(), part.begin(), part.begin() + static_cast<std::ptrdiff_t>(part.size() / 2));  // twice
    auto options = OptionsFor(seed % 2 == 0 ? 0.06 : 0.3, 4);
    options.vertices = part.data();
    options.count = static_cast<uint32_t>(part.size());
    operations += Operations(RemeshedWith(*arena, options));
    const Mesh after = MeshOf(*arena);
    EXPECT_TRUE(IsSound(after, name)) << name;
    EXPECT_EQ(TopologyOf(after).Genera(), TopologyOf(m).Genera()) << name;
    const std::vector<uint32_t> old_to_new = OldToNewOf(*arena);
    for (uint32_t v = 0; v < VertexCount(m); ++v) {
      if (chosen.count(v) > 0) continue;
      ASSERT_NE(old_to_new[v], TPA_NONE) << name;
      EXPECT_EQ(PositionOf(after, old_to_new[v]), PositionOf(m, v)) << name;
    }
    std::set<Corners> triangles;
    for (size_t t = 0; t < after.triangles.size(); t += 3)
      triangles.insert(Rotated({after.triangles[t], after.triangles[t + 1], after.triangles[t + 2]}));
    for (size_t t = 0; t < m.triangles.size(); t += 3) {
      const Corners c = {m.triangles[t], m.triangles[t + 1], m.triangles[t + 2]};
      if (chosen.count(c[0]) + chosen.count(c[1]) + chosen.count(c[2]) > 0) continue;
      EXPECT_EQ(triangles.count(Rotated({old_to_new[c[0]], old_to_new[c[1]], old_to_new[c[2]]})), 1u) << name;
      ++kept;
    }
    // What lies outside has yet to be looked at.
    Arena anew(DefaultConfig(40000));
    CarryState(*arena, *anew);
    const auto rest = OptionsFor(options.target_length, 1);
    ExpectEqual(RemeshedWith(*arena, rest), RemeshedWith(*anew, rest), name);
  }
  EXPECT_GT(operations, Least(3000u));
  EXPECT_GT(kept, Least(5000u));
}

// The field is linear, as are the means at new vertices.
TEST(RemeshPart, EdgesFollowAField) {
  const auto aim = [](const Point& p) { return 0.07 + 0.03 * (p[0] + 1.5); };
  for (const int fineness : {6, 40}) {
    const std::string name = "field-" + std::to_string(fineness);
    Arena arena(DefaultConfig(60000), Sphere({0, 0, 0}, 1.5, fineness));
    for (int round = 0; round < 4; ++round) {
      const Mesh m = MeshOf(*arena);
      std::vector<float> lengths;
      for (uint32_t v = 0; v < VertexCount(m); ++v) lengths.push_back(static_cast<float>(aim(PositionOf(m, v))));
      auto options = OptionsFor(0, 5);
      options.lengths = lengths.data();
      RemeshedWith(*arena, options);
    }
    const Mesh after = MeshOf(*arena);
    EXPECT_TRUE(IsSound(after, name)) << name;
    EXPECT_EQ(TopologyOf(after).Genera(), (std::vector<int64_t>{0})) << name;
    double good = 0, all = 0;
    for (size_t h = 0; h < after.triangles.size(); ++h) {
      const Point p = PositionOf(after, after.triangles[h]);
      const Point q = PositionOf(after, after.triangles[h % 3 == 2 ? h - 2 : h + 1]);
      const double part = Distance(p, q) / (0.5 * (aim(p) + aim(q)));
      good += part > 0.79 && part < 1.35 ? 1 : 0;
      ++all;
    }
    EXPECT_GT(good / all, 0.93) << name;
  }
}

TEST(RemeshPart, FailuresLeaveEverythingAsItWas) {
  const Mesh m = Sphere({0, 0, 0}, 1, 8);
  std::vector<uint32_t> part;
  for (uint32_t v = 0; v < VertexCount(m); v += 1 + v % 2) part.push_back(v);
  std::vector<float> lengths(VertexCount(m), 0.08f);
  auto options = OptionsFor(1, 3);
  options.vertices = part.data();
  options.count = static_cast<uint32_t>(part.size());
  options.lengths = lengths.data();
  Arena ample(DefaultConfig(40000), m);
  const Done done = RemeshedWith(*ample, options);
  for (const uint32_t room : {10u, 60u}) {
    Arena arena(DefaultConfig(VertexCount(m) + room), m);
    const Observed before = Observe(*arena);
    tpa_issue issue;
    ASSERT_EQ(tpa_remesh(*arena, &options, nullptr, nullptr, &issue), TPA_E_LIMIT);
    EXPECT_TRUE(Observe(*arena) == before);
    Arena raised(DefaultConfig(static_cast<uint32_t>(issue.needed)), m);
    ExpectEqual(done, RemeshedWith(*raised, options), "raised");
  }
  for (uint64_t budget = 1; budget < done.units; budget += done.units / 20 + 1) {
    Arena arena(DefaultConfig(40000), m);
    const Observed before = Observe(*arena);
    auto exec = Sized<tpa_exec>();
    exec.budget = budget;
    ASSERT_EQ(tpa_remesh(*arena, &options, &exec, nullptr, nullptr), TPA_E_BUDGET) << budget;
    EXPECT_TRUE(Observe(*arena) == before) << budget;
    EXPECT_EQ(RemeshedWith(*arena, options).digest, done.digest) << budget;
  }
}

TEST(RemeshPart, ListsOutOfRangeAreRefused) {
  const Mesh m = Sphere({0, 0, 0}, 1, 3);
  Arena arena(ConfigFor(m), m);
  const Observed before = Observe(*arena);
  const std::vector<uint32_t> part = {0, 1, VertexCount(m), 2};
  std::vector<float> lengths(VertexCount(m), 0.5f);
  tpa_issue issue;
  auto options = OptionsFor(0.3, 1);
  options.vertices = part.data();
  options.count = 4;
  EXPECT_EQ(tpa_remesh(*arena, &options, nullptr, nullptr, &issue), TPA_E_MESH);
  EXPECT_EQ(issue.defect, TPA_DEFECT_INDEX_RANGE);
  EXPECT_EQ(issue.element, 2u);
  options.count = 2;
  options.reserved = 1;
  EXPECT_EQ(tpa_remesh(*arena, &options, nullptr, nullptr, &issue), TPA_E_ARGUMENT);
  options.reserved = 0;
  options.lengths = lengths.data();
  for (const float bad : {0.0f, -1.0f, NAN, INFINITY, 1e-35f}) {
    lengths[7] = bad;
    EXPECT_EQ(tpa_remesh(*arena, &options, nullptr, nullptr, &issue), TPA_E_ARGUMENT) << bad;
    EXPECT_EQ(issue.element, 7u);
    EXPECT_NE(Text(issue).find("options.lengths"), std::string::npos) << Text(issue);
  }
  EXPECT_TRUE(Observe(*arena) == before);
}

}  // namespace
}  // namespace remesh_part_test
