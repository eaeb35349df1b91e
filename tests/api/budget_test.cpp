// SPDX-License-Identifier: MIT
// Budgets of work: one that suffices does not matter, one unit less fails the call and leaves everything as before; so
// does a call that is cancelled. Counts of work do not depend on threads.
#include <cstring>

#include "support/limit_scenes.h"
#include "support/schedules.h"
#include "support/state_support.h"

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
  const Observed before = Observe(*calls.arena);
  const uint64_t digest = DigestOf(*calls.arena);
  const Ended cut_short = calls.Make(call, exec);
  ASSERT_EQ(cut_short.status, TPA_E_BUDGET) << exec.budget << " of " << whole.units;
  EXPECT_EQ(cut_short.issue.available, exec.budget);
  EXPECT_TRUE(cut_short.issue.needed == 0 || cut_short.issue.needed == whole.units) << cut_short.issue.needed;
  EXPECT_EQ(cut_short.units, exec.budget);
  EXPECT_TRUE(Observe(*calls.arena) == before) << exec.budget << " of " << whole.units;
  tpa_drop_targets(*calls.arena);  // which MakeCall() sets
  EXPECT_EQ(DigestOf(*calls.arena), digest) << exec.budget << " of " << whole.units;
  const Ended after = calls.Make(call, Sized<tpa_exec>());
  ASSERT_EQ(after.status, whole.status);
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
  for (uint64_t seed = 2001; seed <= 2200; ++seed) Try(RandomCallScene(seed), seed, tally);
  for (uint64_t seed = 2301; seed <= 2350; ++seed) Try(Hashed(RandomCallScene(seed)), seed, tally);
  EXPECT_GT(tally.exhausted, 4 * tally.calls);
}

}  // namespace
