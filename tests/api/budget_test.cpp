// SPDX-License-Identifier: MIT
// Budgets of work: one that suffices does not matter, one unit less fails the call and leaves everything as before; so
// does a call that is cancelled. Counts of work do not depend on threads.
#include <atomic>
#include <cmath>
#include <cstring>
#include <functional>
#include <thread>

#include "support/limit_scenes.h"
#include "support/schedules.h"
#include "support/state_support.h"

namespace budget_test {
namespace {

using namespace support;

struct Tally {
  uint64_t calls = 0, exhausted = 0;
};

// A context that goes back to an earlier state.
class Rewound {
 public:
  explicit Rewound(const Arena& arena) : arena_(arena), saved_(arena.block(), arena.block() + arena.size().bytes) {}
  void Rewind() const { std::memcpy(arena_.block(), saved_.data(), saved_.size()); }

 private:
  const Arena& arena_;
  std::vector<char> saved_;
};

struct Ended {
  tpa_status status;
  std::string bytes;
  uint64_t units;
  tpa_issue issue;
};

struct Calls {
  const Arena& arena;
  const CallScene& scene;

  Ended Make(const CallOf& call, tpa_exec exec) const {
    Ended ended{};
    exec.progress = &ended.units;
    ended.status = MakeCall(*arena, scene, call, &exec, ended.bytes, &ended.issue);
    ended.bytes += Observe(*arena).bytes;
    return ended;
  }
};

// With this budget the call fails, and leaves a state from which it goes on as ever.
void Exhaust(const Calls& calls, const CallOf& call, const tpa_exec& exec, const Ended& whole) {
  tpa_drop_targets(*calls.arena);  // of a step that failed before
  const Observed before = Observe(*calls.arena);
  const uint64_t digest = DigestOf(*calls.arena);
  const Ended cut_short = calls.Make(call, exec);
  ASSERT_EQ(cut_short.status, TPA_E_BUDGET) << exec.budget << " of " << whole.units;
  EXPECT_EQ(cut_short.issue.available, exec.budget);
  const uint64_t margin = whole.units / 8 + 64;  // of the retry, below
  EXPECT_TRUE(cut_short.issue.needed == 0 || cut_short.issue.needed == whole.units + margin) << cut_short.issue.needed;
  // A step or an adaptation knows at the end, before its commit.
  const bool knows = call.kind == CallKind::step || call.kind == CallKind::adapt;
  if (knows && whole.status == TPA_OK && exec.budget + 1 == whole.units) {
    EXPECT_EQ(cut_short.issue.needed, whole.units + margin);
  }
  EXPECT_EQ(cut_short.units, exec.budget);
  EXPECT_TRUE(Observe(*calls.arena) == before) << exec.budget << " of " << whole.units;
  tpa_drop_targets(*calls.arena);  // which MakeCall() sets
  EXPECT_EQ(DigestOf(*calls.arena), digest) << exec.budget << " of " << whole.units;
  tpa_exec enough = Sized<tpa_exec>();
  enough.budget = cut_short.issue.needed;  // 0: not known, and no bound
  const Ended after = calls.Make(call, enough);
  ASSERT_EQ(after.status, whole.status) << "needed is not enough: " << Text(after.issue);
  ASSERT_TRUE(after.bytes == whole.bytes) << exec.budget << " of " << whole.units;
}

// Whatever the threads, a call costs the same; a budget of so much suffices, and one unit less does not.
void TryCall(const Calls& calls, const CallOf& call, Random& random, Tally& tally) {
  const Rewound state(calls.arena);
  const Ended whole = calls.Make(call, Sized<tpa_exec>());
  ++tally.calls;
  for (auto* parallel_for : {static_cast<decltype(&Backwards)>(nullptr), &Backwards, &OnTwoThreads}) {
    tpa_exec exec = Sized<tpa_exec>();
    exec.parallel_for = parallel_for;
    exec.budget = whole.units;
    state.Rewind();
    const Ended again = calls.Make(call, exec);
    ASSERT_EQ(again.status, whole.status) << Text(again.issue);
    ASSERT_EQ(again.units, whole.units);
    ASSERT_TRUE(again.bytes == whole.bytes);
    for (uint64_t budget : {whole.units - 1, uint64_t{1} + random() % std::max<uint64_t>(1, whole.units)}) {
      if (budget == 0 || budget >= whole.units) continue;
      exec.budget = budget;
      state.Rewind();
      Exhaust(calls, call, exec, whole);
      ++tally.exhausted;
      if (testing::Test::HasFatalFailure()) return;
    }
  }
  state.Rewind();
  calls.Make(call, Sized<tpa_exec>());
}

void Try(const CallScene& scene, uint64_t seed, Tally& tally) {
  SCOPED_TRACE(scene.name);
  const MeshOnFailure given(scene.name, scene.mesh);
  const Arena arena(AmpleLimits(scene));
  Random random(seed);
  for (const CallOf& call : scene.calls) {
    SCOPED_TRACE(call_names[static_cast<size_t>(call.kind)]);
    if (call.kind == CallKind::load)
      ASSERT_EQ(Load(*arena, scene.mesh), TPA_OK);
    else
      TryCall({arena, scene}, call, random, tally);
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(Budget, OneUnitLessFailsAndChangesNothing) {
  Tally tally;
  for (uint64_t seed = 1; seed <= 6; ++seed) Try(RandomCallScene(seed), seed, tally);
  for (uint64_t seed = 101; seed <= 102; ++seed) Try(Hashed(RandomCallScene(seed)), seed, tally);
  std::cout << tally.calls << " calls, " << tally.exhausted << " without enough\n";
  EXPECT_GT(tally.exhausted, 4 * tally.calls);
}

TEST(BudgetLong, OneUnitLessFailsAndChangesNothing) {
  Tally tally;
  for (uint64_t seed = 2001; seed <= 2024; ++seed) Try(RandomCallScene(seed), seed, tally);
  for (uint64_t seed = 2301; seed <= 2306; ++seed) Try(Hashed(RandomCallScene(seed)), seed, tally);
  EXPECT_GT(tally.exhausted, 4 * tally.calls);
}

// ---------------------------------------------------------------- cancelling

// Runs tasks serially. Becomes nonzero before round `at` of tasks.
struct Canceller {
  int32_t flag = 0;
  uint32_t rounds = 0, at = 0;
};
void RunAndCancel(void* user, uint32_t count, Task task, void* data) {
  auto& canceller = *static_cast<Canceller*>(user);
  if (++canceller.rounds == canceller.at) __atomic_store_n(&canceller.flag, 1, __ATOMIC_RELAXED);
  for (uint32_t i = 0; i < count; ++i) task(data, i);
}

tpa_exec CancelledBy(Canceller& canceller) {
  auto exec = Sized<tpa_exec>();
  exec.user = &canceller;
  exec.parallel_for = RunAndCancel;
  exec.cancel = &canceller.flag;
  return exec;
}

// In each call of a scene, at a random round of tasks.
void TryToCancel(const CallScene& scene, uint64_t seed, uint32_t& cancelled) {
  SCOPED_TRACE(scene.name);
  const MeshOnFailure given(scene.name, scene.mesh);
  const Arena arena(AmpleLimits(scene));
  const Calls calls{arena, scene};
  Random random(seed);
  for (const CallOf& call : scene.calls) {
    SCOPED_TRACE(call_names[static_cast<size_t>(call.kind)]);
    if (call.kind == CallKind::load) {
      ASSERT_EQ(Load(*arena, scene.mesh), TPA_OK);
      continue;
    }
    const Rewound state(arena);
    Canceller never;
    const Ended whole = calls.Make(call, CancelledBy(never));
    if (never.rounds == 0) continue;
    state.Rewind();
    const Observed before = Observe(*arena);
    const uint64_t digest = DigestOf(*arena);
    Canceller canceller;
    canceller.at = 1 + static_cast<uint32_t>(random() % never.rounds);
    const Ended ended = calls.Make(call, CancelledBy(canceller));
    // The end of the call may come before the next look at the flag.
    if (ended.status == TPA_E_CANCELLED) {
      ++cancelled;
      EXPECT_TRUE(Observe(*arena) == before);
      tpa_drop_targets(*arena);
      EXPECT_EQ(DigestOf(*arena), digest);
      canceller.flag = 0;
      const Ended after = calls.Make(call, CancelledBy(never));
      ASSERT_EQ(after.status, whole.status);
      ASSERT_TRUE(after.bytes == whole.bytes);
    } else {
      ASSERT_TRUE(ended.bytes == whole.bytes);
    }
  }
}

TEST(Budget, CancelledCallsChangeNothing) {
  uint32_t cancelled = 0;
  for (uint64_t seed = 1; seed <= 12; ++seed) TryToCancel(RandomCallScene(seed), seed, cancelled);
  EXPECT_GT(cancelled, 12u);
}

// Ever new positions at random: no mesh could be farther from the cases that are meant.
Mesh RandomPositions(int parts) {
  Mesh m = Sphere({}, 1, parts);
  Random random(902);
  for (double& x : m.positions) x = Uniform(random, -1, 1);
  return m;
}

tpa_config RoomForAllPairs(const Mesh& m) {
  tpa_config config = DefaultConfig(8 * VertexCount(m));
  config.max_contacts = 500000;
  config.max_pieces = 2000000;
  return config;
}

TEST(Budget, OfAnotherThread) {
  const Mesh m = RandomPositions(15);
  const Arena arena(RoomForAllPairs(m), m);
  const uint64_t digest = DigestOf(*arena);
  int32_t flag = 0;
  auto exec = Sized<tpa_exec>();
  exec.cancel = &flag;
  uint64_t units = 0;
  exec.progress = &units;
  tpa_issue issue;
  std::thread other([&] {
    while (__atomic_load_n(&units, __ATOMIC_RELAXED) < 1000000) std::this_thread::yield();
    __atomic_store_n(&flag, 1, __ATOMIC_RELAXED);
  });
  EXPECT_EQ(tpa_adapt(*arena, &exec, nullptr, &issue), TPA_E_CANCELLED);
  other.join();
  EXPECT_EQ(Text(issue), "cancelled");
  EXPECT_EQ(DigestOf(*arena), digest);
}

// Room for 600,000 pieces, of millions: this is found out by counting, not by filling the room, in twice the work.
TEST(Budget, EndsCrowdedCutsEarly) {
  const Mesh m = RandomPositions(9);
  tpa_config config = DefaultConfig(8 * VertexCount(m));
  config.max_contacts = 300 * VertexCount(m);
  config.max_pieces = 600000;
  const Arena arena(config, m);
  const uint64_t digest = DigestOf(*arena);
  auto exec = Sized<tpa_exec>();
  uint64_t units = 0;
  exec.progress = &units;
  tpa_issue issue;
  EXPECT_EQ(tpa_adapt(*arena, &exec, nullptr, &issue), TPA_E_LIMIT);
  EXPECT_EQ(issue.limit, TPA_LIMIT_PIECES);
  EXPECT_GT(issue.needed, 4 * config.max_pieces);
  EXPECT_EQ(DigestOf(*arena), digest);
  EXPECT_LT(units, 45000000u);
}

// What such a refusal names as needed is enough.
TEST(Budget, CrowdedCutsSucceedWithTheRoomThatTheyName) {
  const Mesh m = RandomPositions(4);
  tpa_config config = DefaultConfig(60000);
  config.max_contacts = 100 * VertexCount(m);
  config.max_pieces = 6000;
  tpa_issue issue;
  const Arena small(config, m);
  ASSERT_EQ(tpa_adapt(*small, nullptr, nullptr, &issue), TPA_E_LIMIT);
  ASSERT_EQ(issue.limit, TPA_LIMIT_PIECES);
  config.max_pieces = static_cast<uint32_t>(issue.needed);
  const Arena enough(config, m);
  EXPECT_EQ(tpa_adapt(*enough, nullptr, nullptr, &issue), TPA_OK) << Text(issue);
  config.max_pieces = 1000000;
  const Arena ample(config, m);
  EXPECT_EQ(tpa_adapt(*ample, nullptr, nullptr, &issue), TPA_OK) << Text(issue);
  EXPECT_EQ(Observe(*enough), Observe(*ample));
}

// 902 vertices, 446,696 pairs: without a bound a matter of minutes.
TEST(Budget, EndsWhatWouldTakeMinutes) {
  const Mesh m = RandomPositions(15);
  ASSERT_EQ(VertexCount(m), 902u);
  const Arena arena(RoomForAllPairs(m), m);
  const uint64_t digest = DigestOf(*arena);
  auto exec = Sized<tpa_exec>();
  uint64_t units = 0;
  exec.progress = &units;
  for (const uint64_t budget : {1000u, 100000u, 10000000u}) {
    exec.budget = budget;
    tpa_issue issue;
    EXPECT_EQ(tpa_adapt(*arena, &exec, nullptr, &issue), TPA_E_BUDGET);
    EXPECT_EQ(issue.available, budget);
    EXPECT_EQ(units, budget);
    EXPECT_EQ(Text(issue), "budget of work spent: " + std::to_string(budget) + " units");
    EXPECT_EQ(DigestOf(*arena), digest);
  }
  // A room that the crossings exceed is refused before all crossings are counted.
  exec.budget = 150000000;
  tpa_issue issue;
  EXPECT_EQ(tpa_adapt(*arena, &exec, nullptr, &issue), TPA_E_LIMIT);
  EXPECT_EQ(issue.limit, TPA_LIMIT_PIECES);
  EXPECT_GT(issue.needed, 140000000u);
  EXPECT_EQ(DigestOf(*arena), digest);
}

// ---------------------------------------------------------------- progress

TEST(Budget, ProgressOnlyGrows) {
  struct Watched {
    uint64_t progress = 0, last = 0;
    bool grows = true;
  } watched;
  const CallScene scene = RandomCallScene(3);
  const Arena arena(AmpleLimits(scene), scene.mesh);
  auto exec = Sized<tpa_exec>();
  exec.user = &watched;
  exec.progress = &watched.progress;
  exec.parallel_for = [](void* user, uint32_t count, Task task, void* data) {
    auto& w = *static_cast<Watched*>(user);
    w.grows = w.grows && w.progress >= w.last;
    w.last = w.progress;
    for (uint32_t i = 0; i < count; ++i) task(data, i);
  };
  ASSERT_EQ(tpa_adapt(*arena, &exec, nullptr, nullptr), TPA_OK);
  EXPECT_TRUE(watched.grows);
  EXPECT_GT(watched.last, 0u);
  EXPECT_GE(watched.progress, watched.last);
}

TEST(Budget, IsNotReadFromAnOlderStructure) {
  const Mesh m = Sphere({}, 1, 5);
  const Arena arena(ConfigFor(m), m);
  auto exec = Sized<tpa_exec>();
  exec.budget = 1;
  EXPECT_EQ(tpa_step(*arena, &exec, nullptr, nullptr), TPA_E_BUDGET);
  exec.struct_size = offsetof(tpa_exec, budget);
  EXPECT_EQ(tpa_step(*arena, &exec, nullptr, nullptr), TPA_OK);
}

// ---------------------------------------------------------------- hubs

// Two vertices with so many triangles each, a double cone.
Mesh Hub(uint32_t valence) {
  Mesh m;
  m.positions = {0, 0, 0.5, 0, 0, -0.5};
  for (uint32_t i = 0; i < valence; ++i) {
    const double angle = 6.283185307179586 * i / valence;
    m.positions.insert(m.positions.end(), {std::cos(angle), std::sin(angle), 0});
    const uint32_t a = 2 + i, b = 2 + (i + 1) % valence;
    m.triangles.insert(m.triangles.end(), {0, a, b, 1, b, a});
  }
  return m;
}

using HubCall = std::function<tpa_status(tpa_context*, const tpa_exec*)>;

uint64_t UnitsOf(const Mesh& m, const tpa_config& config, const HubCall& call) {
  const Arena arena(config, m);
  uint64_t units = 0;
  auto exec = Sized<tpa_exec>();
  exec.progress = &units;
  EXPECT_EQ(call(*arena, &exec), TPA_OK);
  return units;
}

uint64_t UnitsOf(uint32_t valence, uint32_t detect_mode, const HubCall& call) {
  const Mesh m = Hub(valence);
  tpa_config config = ConfigFor(m);
  config.detect_mode = detect_mode;
  config.cell_size = 6.3 / valence;
  return UnitsOf(m, config, call);
}

tpa_status StepOf(tpa_context* context, const tpa_exec* exec, uint32_t vertices) {
  std::vector<double> targets = MeshOf(context).positions;
  std::vector<uint32_t> ids(vertices);
  for (uint32_t v = 0; v < vertices; ++v) ids[v] = v;
  targets.resize(3 * size_t{vertices});
  for (double& x : targets) x += 0.01;
  EXPECT_EQ(tpa_step(context, nullptr, nullptr, nullptr), TPA_OK);  // knows that nothing meets
  EXPECT_EQ(MoveSome(context, ids, targets), TPA_OK);
  return tpa_step(context, exec, nullptr, nullptr);
}

// Each pair of faces at a hub would be some thousand units for each face.
constexpr uint64_t most_units_of_face = 100;

TEST(Hubs, CostWhatTheirFacesCost) {
  const std::pair<const char*, HubCall> kinds[] = {
      {"detect",
       [](tpa_context* c, const tpa_exec* e) {
         auto contacts = Sized<tpa_contacts>();
         return tpa_detect(c, e, &contacts, nullptr);
       }},
      {"step", [](tpa_context* c, const tpa_exec* e) { return StepOf(c, e, VertexCount(MeshOf(c))); }},
      {"step of the hub", [](tpa_context* c, const tpa_exec* e) { return StepOf(c, e, 1); }},
      {"adapt", [](tpa_context* c, const tpa_exec* e) { return tpa_adapt(c, e, nullptr, nullptr); }},
      {"smooth", [](tpa_context* c, const tpa_exec* e) {
         auto options = Sized<tpa_smooth_options>();
         options.iterations = 3;
         return tpa_smooth(c, &options, e, nullptr, nullptr);
       }}};
  for (const uint32_t mode : {TPA_DETECT_COMPLETE, TPA_DETECT_VERTEX_HASH})
    for (const auto& [name, call] : kinds) {
      for (const uint32_t valence : {2000u, 4000u})
        EXPECT_LE(UnitsOf(valence, mode, call), most_units_of_face * 2 * valence) << name << " in mode " << mode;
    }
}

// The ratio of the work on hubs of four times the valence: 4 for work in proportion to it, 16 for its square.
double GrowthOf(uint32_t valence, const std::function<uint64_t(uint32_t)>& units_of) {
  const uint64_t small = units_of(valence), large = units_of(4 * valence);
  EXPECT_GT(small, 1000u);
  return static_cast<double>(large) / static_cast<double>(small);
}

double MeanEdgeOfHub(uint32_t valence) { return (2 * std::hypot(1, 0.5) + 6.28 / valence) / 3; }

TEST(Hubs, SweepsGrowWithTheValence) {
  const double growth = GrowthOf(400, [](uint32_t valence) {
    return UnitsOf(valence, TPA_DETECT_COMPLETE, [&](tpa_context* c, const tpa_exec* e) {
      auto options = Sized<tpa_remesh_options>();
      options.iterations = 1;
      options.target_length = MeanEdgeOfHub(valence);
      options.relaxation = 0.5;
      auto report = Sized<tpa_report>();
      const tpa_status status = tpa_remesh(c, &options, e, &report, nullptr);
      EXPECT_GT(report.collapses, valence / 2);
      return status;
    });
  });
  EXPECT_LT(growth, 5);
}

// Two double cones run into each other with their rims.
uint64_t UnitsOfEvent(uint32_t valence) {
  const Mesh fixed = Hub(valence), mesh = Together({fixed, Mapped(fixed, [](Point p) {
                                                      return Point{p[0] + 2.1, p[1] + .01, p[2] + .007};
                                                    })});
  tpa_config config = ConfigFor(mesh);
  config.max_vertices *= 8;
  config.max_contacts = 16 * TriangleCount(mesh);
  return UnitsOf(mesh, config, [&](tpa_context* c, const tpa_exec* e) {
    EXPECT_EQ(tpa_step(c, nullptr, nullptr, nullptr), TPA_OK);  // knows that nothing meets
    std::vector<uint32_t> ids;
    std::vector<double> targets;
    for (uint32_t v = VertexCount(fixed); v < VertexCount(mesh); ++v) {
      ids.push_back(v);
      for (size_t k = 0; k < 3; ++k) targets.push_back(mesh.positions[3 * size_t{v} + k] - (k == 0 ? .15 : 0));
    }
    EXPECT_EQ(MoveSome(c, ids, targets), TPA_OK);
    auto report = Sized<tpa_report>();
    const tpa_status status = tpa_step(c, e, &report, nullptr);
    EXPECT_EQ(report.groups, 1u);
    return status;
  });
}

TEST(Hubs, EventsBesideThemGrowLittleFasterThanTheValence) { EXPECT_LT(GrowthOf(400, UnitsOfEvent), 8); }

}  // namespace
}  // namespace budget_test
