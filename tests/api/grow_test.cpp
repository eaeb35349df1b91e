// SPDX-License-Identifier: MIT
// tpa_grow: a run that grows from the least limits goes on with the bits of a run with ample limits.
#include <algorithm>
#include <array>
#include <memory>

#include "support/evolution.h"
#include "support/limit_scenes.h"
#include "support/resolve_trial.h"

namespace grow_test {
namespace {

using namespace support;

// Room for the mesh, and for next to nothing else.
tpa_config LeastConfig(const Evolution& e) {
  tpa_config config = e.config;
  config.max_vertices = VertexCount(e.mesh);
  config.max_triangles = TriangleCount(e.mesh);
  config.max_contacts = config.max_events = config.max_pieces = 1;
  config.max_cut_edges = 3;
  config.max_components = static_cast<uint32_t>(TopologyOf(e.mesh).components.size());
  return config;
}

class Growing {
 public:
  Growing(const tpa_config& config, const Mesh& mesh)
      : config_(config), arena_(std::make_unique<Arena>(config, mesh)) {}
  tpa_context* operator*() const { return **arena_; }
  uint32_t times() const { return times_; }

  // Repeats the call with larger limits until it succeeds.
  Called CallUntilDone(int number) {
    for (int tries = 0; tries < 100; ++tries) {
      const uint64_t before = DigestOf(**arena_);
      const Called called = Call(**arena_, number);
      if (called.status != TPA_E_LIMIT) return called;
      EXPECT_EQ(called.digest, before) << "a failure changed the state";
      Raise(called.issue);
      EXPECT_EQ(DigestOf(**arena_), called.digest) << "growth changed the state";
    }
    ADD_FAILURE() << "no end of limits";
    return {};
  }

 private:
  void Raise(const tpa_issue& issue) {
    uint32_t& limit = config_.*limit_fields.at(static_cast<size_t>(issue.limit - 1));
    EXPECT_EQ(limit, issue.available) << Text(issue);
    EXPECT_GT(issue.needed, issue.available) << Text(issue);
    limit = static_cast<uint32_t>(issue.needed);
    auto larger = std::make_unique<Arena>(config_);
    tpa_context* bigger = nullptr;
    tpa_issue grown;
    ASSERT_EQ(tpa_grow(**arena_, larger->block(), larger->size().bytes, &config_, &bigger, &grown), TPA_OK)
        << Text(grown);
    EXPECT_EQ(bigger, **larger);
    arena_ = std::move(larger);
    ++times_;
  }

  tpa_config config_;
  std::unique_ptr<Arena> arena_;
  uint32_t times_ = 0;
};

struct Seen {
  uint32_t grown = 0, events = 0, rolled_back = 0;
};

void PlayBoth(const Evolution& e, uint64_t seed, Seen& seen) {
  SCOPED_TRACE(e.name + ", seed " + std::to_string(seed));
  const Arena ample(e.config, e.mesh);
  Growing growing(LeastConfig(e), e.mesh);
  for (int number = 0; number < e.calls; ++number) {
    Prepare(*ample, e, number, seed);
    Prepare(*growing, e, number, seed);
    const Called expected = Call(*ample, number);
    ExpectSame(expected, growing.CallUntilDone(number), "call " + std::to_string(number));
    if (testing::Test::HasFailure()) return;
    seen.events += static_cast<uint32_t>(EventsOf(*ample).size());
    seen.rolled_back += expected.report.rolled_back_vertices;
  }
  seen.grown += growing.times();
}

TEST(Grow, GoesOnWithTheBitsOfAmpleLimits) {
  Seen seen;
  for (uint64_t seed = 1; seed <= 2; ++seed)
    for (const Evolution& e : Evolutions(seed)) PlayBoth(e, seed, seen);
  EXPECT_GT(seen.grown, 60u);
  EXPECT_GT(seen.events, 40u);
  EXPECT_GT(seen.rolled_back, 0u);
}

// ---------------------------------------------------------------- single calls

struct Block {
  explicit Block(const tpa_config& config) : arena(config) {}
  tpa_status Grow(const tpa_context* from, const tpa_config& config, tpa_issue* issue) {
    return tpa_grow(from, arena.block(), arena.size().bytes, &config, &context, issue);
  }
  Arena arena;
  tpa_context* context = nullptr;
};

TEST(Grow, CarriesEverythingAndLeavesTheOldContextAlone) {
  const Mesh m = Together({Sphere({}, 1, 4), Sphere({2.5, 0, 0}, 1, 4)});
  const Arena arena(ConfigFor(m), m);
  ASSERT_EQ(MoveSome(*arena, {1, 5}, {1, 2, 3, 4, 5, 6}), TPA_OK);
  const std::string block(arena.block(), arena.size().bytes);
  const tpa_config config = DefaultConfig(5000);
  Block larger(config);
  ASSERT_EQ(larger.Grow(*arena, config, nullptr), TPA_OK);
  EXPECT_EQ(std::string(arena.block(), arena.size().bytes), block);
  EXPECT_EQ(SavedFrom(larger.context), SavedFrom(*arena));
  EXPECT_TRUE(Observe(larger.context) == Observe(*arena));
  auto now = Sized<tpa_config>();
  ASSERT_EQ(tpa_config_of(larger.context, &now), TPA_OK);
  EXPECT_EQ(now.max_vertices, 5000u);
  const std::vector<tpa_memory_table> before = TablesOf(*arena), after = TablesOf(larger.context);
  for (size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(before[i].used, after[i].used) << before[i].name;
    EXPECT_EQ(before[i].peak, after[i].peak) << before[i].name;
  }
}

TEST(Grow, BetweenBlocksAtAnyAddresses) {
  const Mesh m = Together({Sphere({}, 1, 4), Sphere({2.5, 0, 0}, 1, 4)});
  const tpa_config config = ConfigFor(m);
  const Arena arena(config, m);
  ASSERT_EQ(MoveSome(*arena, {1, 5}, {1, 2, 3, 4, 5, 6}), TPA_OK);
  const size_t bytes = arena.size().bytes;
  std::vector<char> first(bytes + 128), second(bytes + 128);
  for (size_t off = 0; off < 64; ++off) {
    tpa_context *one = nullptr, *other = nullptr;
    ASSERT_EQ(tpa_grow(*arena, first.data() + off, bytes, &config, &one, nullptr), TPA_OK) << off;
    ASSERT_EQ(tpa_grow(one, second.data() + 7 * off % 64, bytes, &config, &other, nullptr), TPA_OK) << off;
    EXPECT_EQ(static_cast<void*>(one), first.data() + off);
    EXPECT_EQ(SavedFrom(other), SavedFrom(*arena)) << off;
    EXPECT_TRUE(Observe(other) == Observe(*arena)) << off;
    ASSERT_EQ(tpa_step(other, nullptr, nullptr, nullptr), TPA_OK) << off;
    ASSERT_EQ(tpa_step(one, nullptr, nullptr, nullptr), TPA_OK) << off;
    EXPECT_EQ(SavedFrom(other), SavedFrom(one)) << off;
  }
}

TEST(Grow, LimitsMayFallAsLongAsTheStateFits) {
  const Mesh m = Together({Sphere({}, 1, 3), Sphere({2.5, 0, 0}, 1, 3)});
  const Arena arena(ConfigFor(m), m);
  tpa_config config = ConfigFor(m);
  config.max_vertices = VertexCount(m);
  config.max_triangles = TriangleCount(m);
  config.max_components = 2;
  Block smaller(config);
  ASSERT_EQ(smaller.Grow(*arena, config, nullptr), TPA_OK);
  EXPECT_EQ(DigestOf(smaller.context), DigestOf(*arena));
  const auto expect_limit = [&](int32_t limit, uint32_t tpa_config::*field) {
    tpa_config less = config;
    const uint64_t needed = less.*field;
    --(less.*field);
    tpa_issue issue;
    EXPECT_EQ(smaller.Grow(*arena, less, &issue), TPA_E_LIMIT);
    EXPECT_EQ(issue.limit, limit);
    EXPECT_EQ(issue.needed, needed);
    EXPECT_EQ(issue.available, needed - 1);
  };
  expect_limit(TPA_LIMIT_VERTICES, &tpa_config::max_vertices);
  expect_limit(TPA_LIMIT_TRIANGLES, &tpa_config::max_triangles);
  expect_limit(TPA_LIMIT_COMPONENTS, &tpa_config::max_components);
  uint64_t digest;
  EXPECT_EQ(tpa_digest(smaller.context, &digest), TPA_E_CONTEXT) << "half a context remains";
}

// What an earlier, larger mesh has changed has no room in the smaller block.
TEST(Grow, IntoABlockForASmallerMeshThanBefore) {
  const Mesh large = Sphere({}, 1, 16), small = Sphere({}, 1, 1);
  for (bool is_loaded : {false, true}) {
    const Arena arena(ConfigFor(large), large);
    std::vector<double> targets = large.positions;
    for (double& x : targets) x *= 1.5;
    ASSERT_EQ(MoveAll(*arena, targets), TPA_OK);
    ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_OK);
    ASSERT_EQ(is_loaded ? Load(*arena, small) : tpa_reset(*arena), TPA_OK);
    Block smaller(DefaultConfig(VertexCount(small)));
    ASSERT_EQ(smaller.Grow(*arena, DefaultConfig(VertexCount(small)), nullptr), TPA_OK);
    EXPECT_EQ(SavedFrom(smaller.context), SavedFrom(*arena));
    ASSERT_EQ(Load(smaller.context, small), TPA_OK);
    EXPECT_EQ(tpa_step(smaller.context, nullptr, nullptr, nullptr), TPA_OK);
  }
}

TEST(Grow, OtherFieldsMayDiffer) {
  const Mesh m = Sphere({}, 1, 3);
  const Arena arena(ConfigFor(m), m);
  tpa_config config = ConfigFor(m);
  config.region = TPA_REGION_OUTSIDE;
  config.detect_mode = TPA_DETECT_VERTEX_HASH;
  Block other(config);
  ASSERT_EQ(other.Grow(*arena, config, nullptr), TPA_OK);
  auto contacts = Sized<tpa_contacts>();
  EXPECT_EQ(tpa_detect(other.context, nullptr, &contacts, nullptr), TPA_OK);
}

TEST(Grow, AnEmptyContext) {
  const Mesh m = Sphere({}, 1, 3);
  const Arena arena(DefaultConfig(10));
  const tpa_config config = ConfigFor(m);
  Block larger(config);
  ASSERT_EQ(larger.Grow(*arena, config, nullptr), TPA_OK);
  EXPECT_EQ(Load(larger.context, m), TPA_OK);
}

TEST(Grow, ForbiddenArguments) {
  const Mesh m = Sphere({}, 1, 3);
  const tpa_config config = ConfigFor(m);
  const Arena arena(config, m), other(config);
  const size_t size = other.size().bytes;
  tpa_context* context = nullptr;
  tpa_issue issue;
  const auto expect = [&](tpa_status status, int32_t argument, const char* text) {
    EXPECT_EQ(issue.status, status);
    EXPECT_EQ(issue.argument, argument);
    EXPECT_EQ(Text(issue), text);
  };
  tpa_grow(nullptr, other.block(), size, &config, &context, &issue);
  expect(TPA_E_CONTEXT, 0, "not a context of this library");
  tpa_grow(*arena, nullptr, size, &config, &context, &issue);
  expect(TPA_E_ARGUMENT, 2, "invalid argument: memory must not be NULL");
  tpa_grow(*arena, arena.block() + 64, size, &config, &context, &issue);
  expect(TPA_E_ARGUMENT, 2, "invalid argument: memory must lie apart from the block of the context");
  tpa_grow(*arena, arena.block() - 64, 128, &config, &context, &issue);
  expect(TPA_E_ARGUMENT, 2, "invalid argument: memory must lie apart from the block of the context");
  tpa_grow(*arena, other.block(), size, nullptr, &context, &issue);
  expect(TPA_E_ARGUMENT, 4, "invalid argument: config must not be NULL");
  tpa_grow(*arena, other.block(), size, &config, nullptr, &issue);
  expect(TPA_E_ARGUMENT, 5, "invalid argument: bigger must not be NULL");
  EXPECT_EQ(tpa_grow(*arena, other.block(), size - 1, &config, &context, &issue), TPA_E_ARENA);
  EXPECT_EQ(issue.needed, size);
  tpa_config tiny = config;
  tiny.max_vertices = 3;
  EXPECT_EQ(tpa_grow(*arena, other.block(), size, &tiny, &context, &issue), TPA_E_CONFIG);
  EXPECT_EQ(issue.argument, 3);
  EXPECT_EQ(context, nullptr);
}

}  // namespace
}  // namespace grow_test
