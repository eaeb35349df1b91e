// SPDX-License-Identifier: MIT
// Calls that keep what is done when the budget ends (TPA_EXEC_KEEP), and failures that cost the next call nothing.
#include <cmath>
#include <cstring>
#include <numeric>

#include "support/field_shapes.h"
#include "support/limit_scenes.h"
#include "support/schedules.h"
#include "support/state_support.h"
#include "support/uneven_bodies.h"

namespace keep_test {
namespace {

using namespace support;

struct Spent {
  tpa_status status;
  uint64_t units = 0;
  tpa_report report = Sized<tpa_report>();
  tpa_issue issue{};
};

tpa_exec Keeping(uint64_t budget, uint64_t& units) {
  auto exec = Sized<tpa_exec>();
  exec.flags = TPA_EXEC_KEEP;
  exec.budget = budget;
  exec.progress = &units;
  return exec;
}

// ---------------------------------------------------------------- random calls

struct Kept {
  uint64_t calls = 0, unfinished = 0, too_small = 0;
};

uint32_t UnfinishedIn(const std::string& bytes) {
  tpa_report report;
  std::memcpy(&report, bytes.data(), sizeof report);
  return report.unfinished;
}

bool MayBeTangled(CallKind kind) { return kind == CallKind::adapt; }

// With so much, the call ends within the budget in the same way on all threads, and the mesh is sound.
void KeepOf(tpa_context* context, const CallScene& scene, const CallOf& call, uint64_t budget, const std::string& whole,
            Kept& kept) {
  const Bytes start = SavedFrom(context);
  std::string first;
  for (auto* parallel_for : {static_cast<decltype(&Backwards)>(nullptr), &Backwards, &OnTwoThreads}) {
    ASSERT_EQ(tpa_restore(context, start.data(), start.size(), nullptr), TPA_OK);
    const Observed before = Observe(context);
    uint64_t units = 0;
    tpa_exec exec = Keeping(budget, units);
    exec.parallel_for = parallel_for;
    std::string bytes;
    tpa_issue issue;
    const tpa_status status = MakeCall(context, scene, call, &exec, bytes, &issue);
    ASSERT_LE(units, budget);
    ASSERT_TRUE(status == TPA_OK || status == TPA_E_BUDGET) << Text(issue);
    if (status == TPA_E_BUDGET) {
      ASSERT_TRUE(Observe(context) == before);
      ++kept.too_small;
    } else {
      const uint32_t unfinished = UnfinishedIn(bytes);
      const Mesh mesh = MeshOf(context);
      if (!MayBeTangled(call.kind)) {
        ASSERT_TRUE(IsSound(mesh, scene.name));
      }
      kept.unfinished += unfinished > 0 ? 1 : 0;
      bytes += Observe(context).bytes;
      if (unfinished == 0) {
        ASSERT_TRUE(bytes == whole) << "other bits within the budget";
      }
    }
    bytes += std::to_string(status) + "/" + std::to_string(units);
    if (first.empty())
      first = bytes;
    else
      ASSERT_TRUE(bytes == first) << "threads make a difference";
  }
  ++kept.calls;
}

void TryKeeping(const CallScene& scene, uint64_t seed, Kept& kept) {
  SCOPED_TRACE(scene.name);
  const MeshOnFailure given(scene.name, scene.mesh);
  const Arena arena(AmpleLimits(scene));
  Random random(seed);
  for (const CallOf& call : scene.calls) {
    SCOPED_TRACE(call_names[static_cast<size_t>(call.kind)]);
    std::string whole;
    tpa_issue issue;
    if (call.kind == CallKind::load) {
      ASSERT_EQ(Load(*arena, scene.mesh), TPA_OK);
      continue;
    }
    const Bytes start = SavedFrom(*arena);
    uint64_t units = 0;
    tpa_exec exec = Keeping(0, units);
    if (MakeCall(*arena, scene, call, &exec, whole, &issue) != TPA_OK) return;
    whole += Observe(*arena).bytes;
    const Bytes end = SavedFrom(*arena);
    if (call.kind == CallKind::detect || call.kind == CallKind::validate) continue;
    ASSERT_EQ(UnfinishedIn(whole), 0u);
    for (int i = 0; i < 4; ++i) {
      ASSERT_EQ(tpa_restore(*arena, start.data(), start.size(), nullptr), TPA_OK);
      KeepOf(*arena, scene, call, 1 + random() % (i == 0 ? units / 8 + 1 : 2 * units + 1), whole, kept);
      if (testing::Test::HasFatalFailure()) return;
    }
    ASSERT_EQ(tpa_restore(*arena, end.data(), end.size(), nullptr), TPA_OK);
  }
}

void PlayKept(uint64_t from, uint64_t to, Kept& kept) {
  for (uint64_t seed = from; seed <= to; ++seed) {
    TryKeeping(seed % 4 == 0 ? Hashed(RandomCallScene(seed)) : RandomCallScene(seed), seed, kept);
    if (testing::Test::HasFatalFailure()) return;
  }
  std::cout << kept.calls << " calls, " << kept.unfinished << " ends unfinished, " << kept.too_small << " too small\n";
}

TEST(Keep, EndsWithinTheBudgetWithASoundMesh) {
  Kept kept;
  PlayKept(1, 12, kept);
  EXPECT_GT(kept.unfinished, kept.calls / 4);
}

TEST(KeepLong, EndsWithinTheBudgetWithASoundMesh) {
  Kept kept;
  PlayKept(1001, 1060, kept);
  EXPECT_GT(kept.unfinished, kept.calls / 4);
}

// ---------------------------------------------------------------- steps

// Two pairs of balls, far from each other, and targets that let each pair overlap.
struct Pairs2 {
  Mesh mesh;
  std::vector<double> targets;
};
Pairs2 TwoPairs() {
  Pairs2 out{Together({Sphere({0, 0, 0}, 1, 8), Sphere({2.1, 0, 0}, 1, 8), Sphere({20, 0, 0}, 1, 8),
                       Sphere({22.1, 0, 0}, 1, 8)}),
             {}};
  out.targets = out.mesh.positions;
  for (size_t v = 0; v < out.targets.size() / 3; ++v) {
    const double x = out.mesh.positions[3 * v], within = x < 10 ? x : x - 20;
    out.targets[3 * v] += within < 1.05 ? 0.1 : -0.1;
  }
  return out;
}

Spent StepTo(tpa_context* context, const std::vector<double>& targets, uint64_t budget, uint32_t flags) {
  Spent out;
  tpa_exec exec = Keeping(budget, out.units);
  exec.flags = flags;
  EXPECT_EQ(MoveAll(context, targets), TPA_OK);
  out.status = tpa_step(context, &exec, &out.report, &out.issue);
  return out;
}

uint32_t ComponentsOf(const tpa_context* context) {
  return static_cast<uint32_t>(TopologyOf(MeshOf(context)).components.size());
}

// Least budget of a call that finishes so many islands at least; the outcome is monotone here.
TEST(KeepStep, AnIslandThatTheBudgetHoldsIsDoneAndTheOtherOneComesNext) {
  const Pairs2 scene = TwoPairs();
  const tpa_config config = ConfigFor(scene.mesh);
  uint64_t whole = 0;
  {
    const Arena arena(config, scene.mesh);
    const Spent s = StepTo(*arena, scene.targets, 0, TPA_EXEC_KEEP);
    ASSERT_EQ(s.status, TPA_OK);
    ASSERT_EQ(ComponentsOf(*arena), 2u);
    whole = s.units;
  }
  std::array<uint32_t, 3> seen{};
  for (uint64_t budget = whole / 20; budget <= 2 * whole; budget += whole / 20) {
    SCOPED_TRACE(budget);
    const Arena arena(config, scene.mesh);
    const Spent s = StepTo(*arena, scene.targets, budget, TPA_EXEC_KEEP);
    if (s.status == TPA_E_BUDGET) continue;
    ASSERT_EQ(s.status, TPA_OK);
    ASSERT_LE(s.units, budget);
    ASSERT_TRUE(IsSound(MeshOf(*arena), "pairs"));
    const uint32_t merged = 4 - ComponentsOf(*arena);
    ++seen[merged];
    if (merged == 1) {
      EXPECT_EQ(s.report.unfinished, 1u);
      EXPECT_GT(s.report.rolled_back_vertices, 0u);
      // The pair at the origin holds the lowest face, so it comes first; the vertices held back lie on the other one.
      const uint32_t* list;
      uint32_t count;
      tpa_rolled_back(*arena, &list, &count);
      ASSERT_EQ(count, s.report.rolled_back_vertices);
      const Mesh now = MeshOf(*arena);
      for (uint32_t i = 0; i < count; ++i) EXPECT_GT(now.positions[3 * list[i]], 10);
      // The next call goes on: enough units for all would do now, too.
      std::vector<double> next = now.positions;
      for (size_t v = 0; v < next.size() / 3; ++v) {
        const double x = now.positions[3 * v];
        next[3 * v] += x < 10 ? 0 : x < 21.05 ? 0.1 : -0.1;
      }
      const Spent then = StepTo(*arena, next, 2 * whole, TPA_EXEC_KEEP);
      ASSERT_EQ(then.status, TPA_OK);
      EXPECT_EQ(then.report.unfinished, 0u);
      EXPECT_EQ(ComponentsOf(*arena), 2u);
    } else if (merged == 2) {
      EXPECT_EQ(s.report.unfinished, 0u);
      EXPECT_EQ(s.report.rolled_back_vertices, 0u);
    } else {
      EXPECT_GE(s.report.unfinished, 1u);
    }
  }
  EXPECT_GT(seen[0], 0u);
  EXPECT_GT(seen[1], 0u);
  EXPECT_GT(seen[2], 0u);
}

// Where the budget hardly holds the detection, all vertices stay, and are named.
TEST(KeepStep, HoldsAllVerticesBackWhereNothingElseFits) {
  const Pairs2 scene = TwoPairs();
  const Arena arena(ConfigFor(scene.mesh), scene.mesh);
  const uint32_t n = VertexCount(scene.mesh);
  const Spent s = StepTo(*arena, scene.targets, 8 * n + TriangleCount(scene.mesh), TPA_EXEC_KEEP);
  ASSERT_EQ(s.status, TPA_OK) << Text(s.issue);
  EXPECT_EQ(s.report.rolled_back_vertices, n);
  EXPECT_EQ(s.report.unfinished, 1u);
  EXPECT_EQ(MeshOf(*arena).positions, scene.mesh.positions);
  EXPECT_EQ(tpa_drop_targets(*arena), TPA_OK);
}

TEST(KeepAdvance, EndsWithASubStep) {
  Mesh mesh = Together({Sphere({0, 0, 0}, 1, 8), Sphere({3, 0, 0}, 1, 8)});
  std::vector<double> targets = mesh.positions;
  for (size_t v = 0; v < targets.size() / 3; ++v) targets[3 * v] += mesh.positions[3 * v] < 1.5 ? 0.6 : -0.6;
  tpa_config config = ConfigFor(mesh);
  config.max_substeps = 100;
  uint64_t whole = 0;
  uint32_t unfinished = 0;
  for (uint64_t part = 10; part-- > 0;) {
    const Arena arena(config, mesh);
    Spent s;
    tpa_exec exec = Keeping(part == 9 ? 0 : whole * (part + 1) / 10, s.units);
    ASSERT_EQ(MoveAll(*arena, targets), TPA_OK);
    s.status = tpa_advance(*arena, 0.2, &exec, &s.report, &s.issue);
    if (part == 9) whole = s.units;
    if (s.status == TPA_E_BUDGET) continue;
    ASSERT_EQ(s.status, TPA_OK) << Text(s.issue);
    ASSERT_LE(s.units, whole);
    ASSERT_TRUE(IsSound(MeshOf(*arena), "advance"));
    unfinished += s.report.unfinished > 0 ? 1 : 0;
    EXPECT_EQ(s.report.unfinished > 0, s.report.rolled_back_vertices > 0);
  }
  EXPECT_GT(unfinished, 2u);
}

// ---------------------------------------------------------------- remeshing

Mesh Octahedron() {
  return {{1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1},
          {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 1, 0, 5, 2, 1, 5, 3, 2, 5, 0, 3, 5}};
}

// Frames of remeshing until nothing is left to be done, all within the budget. Returns the frames with work left.
uint32_t RemeshInFrames(tpa_context* context, uint64_t budget, uint32_t most_frames) {
  auto options = Sized<tpa_remesh_options>();
  options.iterations = 1;
  options.target_length = 0.05;
  options.relaxation = 0.4;
  uint32_t frames = 0;
  for (; frames < most_frames; ++frames) {
    Spent s;
    const tpa_exec exec = Keeping(budget, s.units);
    s.status = tpa_remesh(context, &options, &exec, &s.report, &s.issue);
    EXPECT_EQ(s.status, TPA_OK) << Text(s.issue);
    EXPECT_LE(s.units, budget);
    if (s.status != TPA_OK || s.report.unfinished + s.report.splits + s.report.collapses == 0) break;
  }
  return frames;
}

TEST(KeepRemesh, ReachesTheLengthsUnderAnyBudget) {
  const Mesh octahedron = Octahedron();
  const tpa_config config = DefaultConfig(20000);
  const Arena whole(config, octahedron);
  RemeshInFrames(*whole, 1000000000, 60);
  const double vertices = VertexCount(MeshOf(*whole));
  for (uint64_t budget : {20000u, 60000u, 200000u, 800000u}) {
    SCOPED_TRACE(budget);
    const Arena arena(config, octahedron);
    EXPECT_LT(RemeshInFrames(*arena, budget, 600), 600u);
    const Mesh mesh = MeshOf(*arena);
    EXPECT_NEAR(VertexCount(mesh), vertices, 0.15 * vertices);
    EXPECT_TRUE(IsSound(mesh, "octahedron"));
  }
}

// The gate's units are set aside as an estimate. Large triangles beside many small ones, and hubs, take the most.
TEST(KeepRemesh, HoldsItsGateFromTwelveUnitsATriangleOn) {
  uint32_t calls = 0, unfinished = 0;
  for (uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const auto between = [&](int low, int high) {
      return low + static_cast<int>(random() % static_cast<uint64_t>(high - low));
    };
    const int sides = between(10, 60), meridians = between(8, 100), bands = between(6, 20), ratio = between(1, 300);
    for (const Mesh& mesh : {Needles(sides, bands), Globe(meridians, bands), GradedSphere(sides, ratio)}) {
      const Arena arena(DefaultConfig(100000), mesh);
      auto options = Sized<tpa_remesh_options>();
      options.iterations = 3;
      options.target_length = MeanEdgeOf(mesh) * Uniform(random, 0.4, 3);
      options.relaxation = seed % 2 == 0 ? 0.4 : 0;
      for (int frame = 0; frame < 20; ++frame) {
        Spent s;
        const tpa_exec exec = Keeping(4000 + 12 * uint64_t{TriangleCount(MeshOf(*arena))}, s.units);
        s.status = tpa_remesh(*arena, &options, &exec, &s.report, &s.issue);
        ASSERT_EQ(s.status, TPA_OK) << Text(s.issue);
        ++calls;
        unfinished += s.report.unfinished > 0 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(unfinished, calls / 10);
}

TEST(KeepSmooth, MakesAsManyRoundsAsTheBudgetHolds) {
  const Mesh mesh = Sphere({0, 0, 0}, 1, 10);
  const tpa_config config = ConfigFor(mesh);
  auto options = Sized<tpa_smooth_options>();
  options.iterations = 100;
  uint64_t whole = 0;
  uint32_t last = 101;
  bool any = false;
  for (uint64_t part : {10u, 9u, 7u, 5u, 3u, 1u}) {
    const Arena arena(config, mesh);
    Spent s;
    const tpa_exec exec = Keeping(whole * part / 10, s.units);
    s.status = tpa_smooth(*arena, &options, &exec, &s.report, &s.issue);
    if (whole == 0) whole = s.units;
    ASSERT_EQ(s.status, TPA_OK) << Text(s.issue);
    ASSERT_LE(s.units, whole);
    const uint32_t made = options.iterations - s.report.unfinished;
    EXPECT_LE(made, last);
    last = made;
    any = any || (made > 0 && made < options.iterations);
    // As many rounds in a call without a bound give the same bits.
    const Arena other(config, mesh);
    options.iterations = made;
    ASSERT_EQ(tpa_smooth(*other, &options, nullptr, nullptr, nullptr), TPA_OK);
    EXPECT_EQ(MeshOf(*other).positions, MeshOf(*arena).positions);
    options.iterations = 100;
  }
  EXPECT_TRUE(any);
}

// ---------------------------------------------------------------- failures

// A body of 18,000 vertices: after a step of one vertex, the next ones cost some dozens of units; a failed step of all
// vertices does not change that (P8).
TEST(Failures, CostTheNextCallNothing) {
  const Mesh torus = Torus({0, 0, 0}, 1, 0.4, 150, 30);
  const Arena arena(ConfigFor(torus), torus);
  const auto step_one = [&](uint32_t v) {
    Spent s;
    tpa_exec exec = Keeping(0, s.units);
    exec.flags = 0;
    std::vector<double> to(3);
    for (size_t i = 0; i < 3; ++i) to[i] = torus.positions[3 * v + i] * 1.0005;
    EXPECT_EQ(MoveSome(*arena, {v}, to), TPA_OK);
    EXPECT_EQ(tpa_step(*arena, &exec, nullptr, &s.issue), TPA_OK);
    return s.units;
  };
  step_one(0);
  step_one(1);
  const uint64_t usual = step_one(2);
  ASSERT_LT(usual, 500u);
  std::vector<double> all = torus.positions;
  for (double& x : all) x *= 1.001;
  for (uint64_t budget : {10u, 1000u, 15000u}) {
    const Spent failed = StepTo(*arena, all, budget, 0);
    ASSERT_EQ(failed.status, TPA_E_BUDGET);
    tpa_drop_targets(*arena);
    EXPECT_LT(step_one(3), 2 * usual);
  }
  int32_t flag = 1;
  auto cancelled = Sized<tpa_exec>();
  cancelled.cancel = &flag;
  ASSERT_EQ(MoveAll(*arena, all), TPA_OK);
  ASSERT_EQ(tpa_step(*arena, &cancelled, nullptr, nullptr), TPA_E_CANCELLED);
  tpa_drop_targets(*arena);
  EXPECT_LT(step_one(4), 2 * usual);
}

// A remeshing or smoothing that fails leaves behind where remeshing would do something, the tree, and the volumes.
uint64_t RemeshTo(tpa_context* context, double length, const tpa_exec& exec, tpa_status expected) {
  uint64_t units = 0;
  auto options = Sized<tpa_remesh_options>();
  options.iterations = 1;
  options.target_length = length;
  tpa_exec counted = exec;
  counted.progress = &units;
  EXPECT_EQ(tpa_remesh(context, &options, &counted, nullptr, nullptr), expected);
  return units;
}

TEST(Failures, OfRemeshingCostTheNextCallNothing) {
  const Mesh torus = Torus({0, 0, 0}, 1, 0.4, 150, 60);
  const Arena arena(ConfigFor(torus), torus);
  const auto step_one = [&](uint32_t v) {
    Spent s;
    tpa_exec exec = Keeping(0, s.units);
    exec.flags = 0;
    const Mesh now = MeshOf(*arena);
    std::vector<double> to(3);
    for (size_t i = 0; i < 3; ++i) to[i] = now.positions[3 * v + i] * 1.0001;
    EXPECT_EQ(MoveSome(*arena, {v}, to), TPA_OK);
    EXPECT_EQ(tpa_step(*arena, &exec, nullptr, &s.issue), TPA_OK);
    return s.units;
  };
  const auto whole = Sized<tpa_exec>();
  auto small = whole, cancelled = whole;
  small.budget = 15;
  int32_t flag = 1;
  cancelled.cancel = &flag;
  for (int i = 0; i < 12; ++i) RemeshTo(*arena, 0.04, whole, TPA_OK);
  step_one(0);
  const uint64_t usual_step = step_one(1), usual = RemeshTo(*arena, 0.04, whole, TPA_OK);
  ASSERT_LT(usual_step, 500u);
  ASSERT_LT(usual, 5000u);
  step_one(0);
  for (const tpa_exec& failing : {small, cancelled}) {
    RemeshTo(*arena, 0.04, failing, failing.budget > 0 ? TPA_E_BUDGET : TPA_E_CANCELLED);
    EXPECT_LT(step_one(1), 2 * usual_step);
  }
  RemeshTo(*arena, 0.02, small, TPA_E_BUDGET);  // other lengths, of which the context learns nothing
  auto smoothing = Sized<tpa_smooth_options>();
  smoothing.iterations = 2;
  ASSERT_EQ(tpa_smooth(*arena, &smoothing, &cancelled, nullptr, nullptr), TPA_E_CANCELLED);
  EXPECT_LT(step_one(1), 2 * usual_step);
  EXPECT_LT(RemeshTo(*arena, 0.04, whole, TPA_OK), 2 * usual + 2 * usual_step);
}

// A call that fails at its very end has measured the volumes of the moved mesh. They must not bound what the next call
// may take from the bodies: it has the outcome that it has without the failure.
TEST(Failures, LeaveNoVolumesBehind) {
  const Pairs2 scene = TwoPairs();
  const tpa_config config = ConfigFor(scene.mesh);
  std::vector<double> shrunk = scene.mesh.positions;
  for (size_t v = 0; v < shrunk.size() / 3; ++v) {
    const double x = scene.mesh.positions[3 * v], of_pair = x < 10 ? 0 : 20,
                 centre = x - of_pair < 1.05 ? of_pair : of_pair + 2.1;
    for (size_t i = 0; i < 3; ++i) {
      const double middle = i == 0 ? centre : 0;
      shrunk[3 * v + i] = middle + 0.05 * (scene.mesh.positions[3 * v + i] - middle);
    }
  }
  uint64_t whole = 0;
  Mesh expected;
  {
    const Arena arena(config, scene.mesh);
    whole = StepTo(*arena, shrunk, 0, 0).units;
    ASSERT_EQ(Load(*arena, scene.mesh), TPA_OK);
    ASSERT_EQ(StepTo(*arena, scene.targets, 0, 0).status, TPA_OK);
    expected = MeshOf(*arena);
  }
  for (const uint64_t less : {uint64_t{1}, whole / 20, whole / 4}) {
    SCOPED_TRACE(less);
    const Arena arena(config, scene.mesh);
    ASSERT_EQ(StepTo(*arena, shrunk, whole - less, 0).status, TPA_E_BUDGET);
    ASSERT_EQ(StepTo(*arena, scene.targets, 0, 0).status, TPA_OK);
    const Mesh mesh = MeshOf(*arena);
    EXPECT_EQ(mesh.positions, expected.positions);
    EXPECT_EQ(mesh.triangles, expected.triangles);
  }
}

TEST(Failures, UnknownFlagsAreRefused) {
  const Mesh mesh = Octahedron();
  const Arena arena(ConfigFor(mesh), mesh);
  auto exec = Sized<tpa_exec>();
  exec.flags = 2;
  tpa_issue issue;
  EXPECT_EQ(tpa_step(*arena, &exec, nullptr, &issue), TPA_E_ARGUMENT);
  EXPECT_NE(Text(issue).find("exec.flags"), std::string::npos) << Text(issue);
}

}  // namespace
}  // namespace keep_test
