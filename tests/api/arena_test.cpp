// SPDX-License-Identifier: MIT
// The arena: its size is known beforehand, no other memory is ever taken, and a byte copy is a snapshot (P5).
#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <new>

#include "support/limit_scenes.h"
#include "support/state_support.h"

// ---------------------------------------------------------------- an ear on the heap

// Sanitizers bring an allocator of their own; counting tests below are then skipped.
#if defined(__SANITIZE_ADDRESS__)
#define HEARS_HEAP 0
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define HEARS_HEAP 0
#endif
#endif
#if !defined(HEARS_HEAP) && defined(__GLIBC__)
#define HEARS_HEAP 1
#elif !defined(HEARS_HEAP)
#define HEARS_HEAP 0
#endif

namespace arena_test {
namespace {
size_t heap_calls = 0;
}

#if HEARS_HEAP
extern "C" {
void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* p, size_t size);
void* __libc_memalign(size_t alignment, size_t size);
void __libc_free(void* p);

void* malloc(size_t size) { return ++heap_calls, __libc_malloc(size); }
void* calloc(size_t count, size_t size) { return ++heap_calls, __libc_calloc(count, size); }
void* realloc(void* p, size_t size) { return ++heap_calls, __libc_realloc(p, size); }
void* memalign(size_t alignment, size_t size) { return ++heap_calls, __libc_memalign(alignment, size); }
void* aligned_alloc(size_t alignment, size_t size) { return ++heap_calls, __libc_memalign(alignment, size); }
int posix_memalign(void** out, size_t alignment, size_t size) {
  ++heap_calls;
  *out = __libc_memalign(alignment, size);
  return *out == nullptr ? ENOMEM : 0;
}
void free(void* p) { ++heap_calls, __libc_free(p); }
}
#endif

namespace {

using namespace support;

constexpr size_t alignment_of_block = 64;

tpa_config SmallConfig() { return DefaultConfig(1000); }

tpa_arena_size SizeOf(const tpa_config& config) {
  tpa_arena_size size{};
  tpa_issue issue;
  EXPECT_EQ(tpa_arena_query(&config, &size, &issue), TPA_OK) << Text(issue);
  return size;
}

std::vector<char> BlockFor(const tpa_arena_size& size) { return std::vector<char>(size.bytes + 2 * size.alignment); }

char* Aligned(std::vector<char>& block, size_t alignment, size_t off_by = 0) {
  const size_t at = reinterpret_cast<uintptr_t>(block.data()) % alignment;
  return block.data() + (at == 0 ? 0 : alignment - at) + off_by;
}

// Two spheres and their targets: into each other.
struct Scene {
  Mesh mesh;
  std::vector<double> targets;
};

Scene TwoSpheres() {
  Scene s;
  s.mesh = Together({Sphere({0, 0, 0}, 1, 6), Sphere({2.2, 0.1, 0.05}, 1, 6)});
  s.targets = s.mesh.positions;
  for (size_t i = 0; i < s.targets.size(); i += 3) s.targets[i] += i < s.targets.size() / 2 ? 0.2 : -0.2;
  return s;
}

// ---------------------------------------------------------------- sizes

TEST(Arena, TheSizeAskedForIsEnoughAndOneByteLessIsNot) {
  for (uint32_t vertices : {4u, 5u, 100u, 1001u, 65536u}) {
    const tpa_config config = DefaultConfig(vertices);
    const tpa_arena_size size = SizeOf(config);
    std::vector<char> block = BlockFor(size);
    char* memory = Aligned(block, size.alignment);
    tpa_context* context = nullptr;
    tpa_issue issue;
    EXPECT_EQ(tpa_init(memory, size.bytes - 1, &config, &context, &issue), TPA_E_ARENA);
    EXPECT_EQ(context, nullptr);
    EXPECT_EQ(issue.status, TPA_E_ARENA);
    EXPECT_EQ(issue.needed, size.bytes);
    EXPECT_EQ(issue.available, size.bytes - 1);
    EXPECT_NE(Text(issue).find(std::to_string(size.bytes)), std::string::npos) << Text(issue);
    memory[size.bytes] = 'x';
    EXPECT_EQ(tpa_init(memory, size.bytes, &config, &context, &issue), TPA_OK);
    EXPECT_EQ(issue.status, TPA_OK);
    EXPECT_EQ(memory[size.bytes], 'x');
  }
}

TEST(Arena, LargerLimitsNeverNeedLess) {
  size_t last = 0;
  for (uint32_t vertices = 4; vertices < (1u << 26); vertices = 3 * vertices + 1) {
    const size_t bytes = SizeOf(DefaultConfig(vertices)).bytes;
    EXPECT_GT(bytes, last);
    last = bytes;
  }
}

TEST(Arena, DefaultLimitsAreThoseOfTheHeader) {
  const auto less = [](uint32_t a, uint32_t b) { return a > b ? a - b : 0u; };
  for (uint32_t v : {64u, 100u, 1000u, 3000u, 24560u, 24640u, 28600u, 28800u, 65536u, 999360u, 999680u}) {
    const tpa_config given = DefaultConfig(v);
    tpa_config spelled = given;
    spelled.max_triangles = 2 * v + std::min(v / 16 + 64, 1024u);
    spelled.max_contacts = std::min(std::max(v / 3 + 128, less(v, 512)), v / 4 + 8192);
    spelled.max_cut_edges = std::min({std::max(v / 6 + 80, less(v / 4, 95)), v / 8 + 4096, v / 16 + 66560});
    spelled.max_events = std::min(v / 16 + 16, v / 128 + 256);
    spelled.max_components = std::min(v / 3 + 1, v / 32 + 1024);
    const uint32_t c = spelled.max_contacts;
    spelled.max_pieces = std::min(std::max(2 * c + 150, less(4 * c, 1100)), 5 * c / 4 + 8700);
    const Arena by_default(given), by_hand(spelled);
    EXPECT_EQ(by_default.size().bytes, by_hand.size().bytes) << v;
    const std::vector<tpa_memory_table> ours = TablesOf(*by_default), theirs = TablesOf(*by_hand);
    for (size_t i = 0; i < ours.size(); ++i) EXPECT_EQ(ours[i].limit, theirs[i].limit) << v << ' ' << ours[i].name;
  }
}

// Smaller meshes take more for each vertex: some arrays have a part that does not depend on the mesh (docs/limits.md).
TEST(Arena, TakesFewBytesForAVertex) {
  for (const uint32_t v : {100000u, 300000u, 1000000u, 100000000u})
    EXPECT_LE(SizeOf(DefaultConfig(v)).bytes, 400 * size_t{v}) << v;
  for (const uint32_t v : {3000u, 10000u, 30000u, 65536u})
    EXPECT_LE(SizeOf(DefaultConfig(v)).bytes, 900 * size_t{v}) << v;
  EXPECT_LE(SizeOf(DefaultConfig(1000)).bytes, 715000u);
  EXPECT_LE(SizeOf(DefaultConfig(100)).bytes, 165000u);
}

TEST(Arena, EveryFieldOutOfRangeIsNamedByItsPosition) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  const auto expect = [](int position, auto&& change) {
    tpa_config config = SmallConfig();
    change(config);
    tpa_arena_size size;
    tpa_issue issue;
    EXPECT_EQ(tpa_arena_query(&config, &size, &issue), TPA_E_CONFIG) << position;
    EXPECT_EQ(issue.argument, position);
    alignas(64) char block[64];
    tpa_context* context = nullptr;
    EXPECT_EQ(tpa_init(block, sizeof block, &config, &context, &issue), TPA_E_CONFIG) << position;
    EXPECT_EQ(issue.argument, position);
  };
  expect(1, [](tpa_config& c) { c.struct_size = 0; });
  expect(1, [](tpa_config& c) { c.struct_size = offsetof(tpa_config, smooth_mu); });
  expect(2, [](tpa_config& c) { c.cookie = 0; });
  expect(2, [](tpa_config& c) { c.cookie ^= 1; });
  for (uint32_t bad : {0u, 3u, (1u << 29) + 1, UINT32_MAX}) expect(3, [&](tpa_config& c) { c.max_vertices = bad; });
  for (uint32_t bad : {1u, 3u, UINT32_MAX}) expect(4, [&](tpa_config& c) { c.max_triangles = bad; });
  expect(5, [](tpa_config& c) { c.max_contacts = UINT32_MAX; });
  for (uint32_t bad : {1u, 2u, UINT32_MAX}) expect(6, [&](tpa_config& c) { c.max_cut_edges = bad; });
  expect(7, [](tpa_config& c) { c.max_events = UINT32_MAX; });
  expect(8, [](tpa_config& c) { c.max_components = UINT32_MAX; });
  expect(9, [](tpa_config& c) { c.max_pieces = UINT32_MAX; });
  expect(10, [](tpa_config& c) { c.detect_mode = 2; });
  for (double bad : {0.0, -1.0, nan, infinity, 0x1p-101, 0x1p101})
    expect(11, [&](tpa_config& c) { c.cell_size = bad; });
  expect(12, [](tpa_config& c) { c.region = 2; });
  for (uint32_t bad : {0u, 65u}) expect(13, [&](tpa_config& c) { c.max_passes = bad; });
  for (uint32_t bad : {0u, 65536u}) expect(14, [&](tpa_config& c) { c.max_candidates = bad; });
  expect(15, [](tpa_config& c) { c.smooth_iterations = 1001; });
  expect(18, [](tpa_config& c) { c.max_substeps = (1u << 20) + 1; });
  for (double bad : {0.0, -.5, 1.01, nan}) expect(16, [&](tpa_config& c) { c.smooth_lambda = bad; });
  for (double bad : {-.6307, -.5, 0.0, .7, -1.51, nan}) expect(17, [&](tpa_config& c) { c.smooth_mu = bad; });
}

TEST(Arena, AConfigThatNobodyFilledIsRefused) {
  tpa_config config;
  std::memset(&config, 0xA5, sizeof config);
  tpa_arena_size size;
  tpa_issue issue;
  EXPECT_EQ(tpa_arena_query(&config, &size, &issue), TPA_E_CONFIG);
  EXPECT_EQ(tpa_config_init(nullptr, sizeof config), TPA_E_ARGUMENT);
  EXPECT_EQ(tpa_config_init(&config, sizeof config - 1), TPA_E_ARGUMENT);
  EXPECT_EQ(tpa_config_init(&config, 0), TPA_E_ARGUMENT);
}

TEST(Arena, TheLargestConfigFitsOrOverflowsButDoesNotWrap) {
  tpa_config config = DefaultConfig(1u << 29);
  config.max_triangles = 1u << 30;
  config.max_contacts = 1u << 30;
  config.max_cut_edges = 1u << 28;
  config.max_events = 1u << 28;
  config.max_components = 1u << 28;
  tpa_arena_size size{};
  tpa_issue issue;
  const tpa_status status = tpa_arena_query(&config, &size, &issue);
  if (sizeof(size_t) == 4) {
    EXPECT_EQ(status, TPA_E_OVERFLOW);
  } else {
    ASSERT_EQ(status, TPA_OK) << Text(issue);
    EXPECT_GT(size.bytes / (1u << 29), 200u);  // bytes for each vertex
  }
}

TEST(Arena, NullArgumentsAreNamed) {
  const tpa_config config = SmallConfig();
  const tpa_arena_size size = SizeOf(config);
  std::vector<char> block = BlockFor(size);
  char* memory = Aligned(block, alignment_of_block);
  tpa_arena_size out;
  tpa_context* context = nullptr;
  tpa_issue issue;
  const auto expect = [&](tpa_status status, int position) {
    EXPECT_EQ(status, TPA_E_ARGUMENT);
    EXPECT_EQ(issue.argument, position);
  };
  expect(tpa_arena_query(nullptr, &out, &issue), 1);
  expect(tpa_arena_query(&config, nullptr, &issue), 2);
  expect(tpa_init(nullptr, size.bytes, &config, &context, &issue), 1);
  expect(tpa_init(memory, size.bytes, nullptr, &context, &issue), 3);
  expect(tpa_init(memory, size.bytes, &config, nullptr, &issue), 4);
  EXPECT_EQ(tpa_init(memory, size.bytes, nullptr, &context, nullptr), TPA_E_ARGUMENT);  // an issue is not a must
}

TEST(Arena, WhatIsNoContextIsRefused) {
  std::vector<char> block(4096);
  auto* wrong = reinterpret_cast<tpa_context*>(Aligned(block, 64));
  auto* crooked = reinterpret_cast<tpa_context*>(Aligned(block, 64, 1));
  for (tpa_context* c : {static_cast<tpa_context*>(nullptr), wrong, crooked}) {
    auto view = Sized<tpa_mesh_view>();
    tpa_issue issue;
    uint32_t count;
    EXPECT_EQ(tpa_view(c, &view), TPA_E_CONTEXT);
    EXPECT_EQ(tpa_reset(c), TPA_E_CONTEXT);
    EXPECT_EQ(tpa_step(c, nullptr, nullptr, &issue), TPA_E_CONTEXT);
    EXPECT_EQ(issue.status, TPA_E_CONTEXT);
    EXPECT_EQ(tpa_memory_stats(c, nullptr, 0, &count), TPA_E_CONTEXT);
    EXPECT_EQ(Load(c, Sphere({0, 0, 0}, 1, 2), &issue), TPA_E_CONTEXT);
  }
}

TEST(Arena, CallsWithoutAMeshSaySo) {
  Arena arena(SmallConfig());
  auto view = Sized<tpa_mesh_view>();
  auto contacts = Sized<tpa_contacts>();
  auto validation = Sized<tpa_validation>();
  auto out = Sized<tpa_mesh_output>();
  auto vertices = Sized<tpa_vertex_map_view>();
  auto triangles = Sized<tpa_triangle_map_view>();
  auto smooth = Sized<tpa_smooth_options>();
  auto remesh = Sized<tpa_remesh_options>();
  remesh.iterations = 1;
  remesh.target_length = 1;
  tpa_issue issue;
  const auto check = [&](const Mesh* mesh, tpa_status expected) {
    if (mesh != nullptr) {
      ASSERT_EQ(Load(*arena, *mesh), TPA_OK);
    }
    EXPECT_EQ(tpa_view(*arena, &view), expected);
    EXPECT_EQ(tpa_detect(*arena, nullptr, &contacts, &issue), expected);
    EXPECT_EQ(tpa_step(*arena, nullptr, nullptr, &issue), expected);
    EXPECT_EQ(tpa_adapt(*arena, nullptr, nullptr, &issue), expected);
    EXPECT_EQ(tpa_validate(*arena, nullptr, &validation, &issue), expected);
    EXPECT_EQ(tpa_export(*arena, &out, &issue), expected);
    EXPECT_EQ(tpa_smooth(*arena, &smooth, nullptr, nullptr, &issue), expected);
    EXPECT_EQ(tpa_remesh(*arena, &remesh, nullptr, nullptr, &issue), expected);
    EXPECT_EQ(MoveAll(*arena, {1, 2, 3}, &issue), expected);
    EXPECT_EQ(tpa_vertex_map(*arena, &vertices), expected);
    EXPECT_EQ(tpa_triangle_map(*arena, &triangles), expected);
  };
  const Mesh sphere = Sphere({0, 0, 0}, 1, 3);
  check(nullptr, TPA_E_STATE);
  check(&sphere, TPA_OK);
  EXPECT_EQ(tpa_reset(*arena), TPA_OK);
  check(nullptr, TPA_E_STATE);
  EXPECT_TRUE(EventsOf(*arena).empty());
}

TEST(Arena, ResetForgetsTargets) {
  const Mesh sphere = Sphere({0, 0, 0}, 1, 3);
  Arena arena(ConfigFor(sphere), sphere);
  ASSERT_EQ(MoveAll(*arena, {5, 5, 5}), TPA_OK);
  ASSERT_EQ(tpa_reset(*arena), TPA_OK);
  ASSERT_EQ(Load(*arena, sphere), TPA_OK);
  ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_OK);
  EXPECT_EQ(MeshOf(*arena).positions, sphere.positions);
}

// ---------------------------------------------------------------- tables

TEST(Arena, StatisticsListTheTablesInOrderAndWithinTheBlock) {
  const Scene s = TwoSpheres();
  Arena arena(ConfigFor(s.mesh), s.mesh);
  ASSERT_EQ(MoveAll(*arena, s.targets), TPA_OK);
  ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_OK);
  uint32_t count = 0;
  ASSERT_EQ(tpa_memory_stats(*arena, nullptr, 0, &count), TPA_OK);
  ASSERT_GT(count, 0u);
  std::vector<tpa_memory_table> tables(count);
  uint32_t again = 0;
  ASSERT_EQ(tpa_memory_stats(*arena, tables.data(), count, &again), TPA_OK);
  EXPECT_EQ(again, count);
  // For each limit, one table at least tells the amount wanted.
  tpa_config resolved = ConfigFor(s.mesh);
  const uint32_t v = resolved.max_vertices;
  resolved.max_triangles = 2 * v + v / 16 + 64;
  resolved.max_contacts = v / 3 + 128;
  resolved.max_cut_edges = v / 6 + 80;
  resolved.max_events = v / 16 + 16;
  resolved.max_components = v / 3 + 1;
  for (const uint32_t limit : {resolved.max_vertices, resolved.max_triangles, resolved.max_contacts,
                               resolved.max_cut_edges, resolved.max_events, resolved.max_components})
    EXPECT_TRUE(std::any_of(tables.begin(), tables.end(), [&](const tpa_memory_table& r) {
      return r.limit == limit && r.peak > 0;
    })) << limit;
  uint64_t sum = 0;
  bool vertices = false;
  for (const tpa_memory_table& r : tables) {
    ASSERT_NE(r.name, nullptr);
    EXPECT_LE(r.used, r.peak) << r.name;
    EXPECT_LE(r.peak, std::max<uint64_t>(r.limit, r.peak)) << r.name;
    sum += r.bytes;
    if (std::string(r.name) == "position") {
      vertices = true;
      EXPECT_EQ(r.used, VertexCount(MeshOf(*arena)));
      EXPECT_GE(r.peak, VertexCount(s.mesh));
      EXPECT_EQ(r.limit, ConfigFor(s.mesh).max_vertices);
    }
  }
  EXPECT_TRUE(vertices);
  EXPECT_LE(sum, arena.size().bytes);
  EXPECT_GE(static_cast<double>(sum), 0.9 * static_cast<double>(arena.size().bytes));
  tpa_memory_table one{};
  EXPECT_EQ(tpa_memory_stats(*arena, &one, 1, &again), TPA_OK);
  EXPECT_EQ(again, count);
  EXPECT_EQ(std::string(one.name), tables[0].name);
  EXPECT_EQ(tpa_memory_stats(*arena, nullptr, 1, &again), TPA_E_ARGUMENT);
}

// ---------------------------------------------------------------- snapshots

std::string StepTwiceAndObserve(tpa_context* context, const Scene& s) {
  EXPECT_EQ(MoveAll(context, s.targets), TPA_OK);
  EXPECT_EQ(tpa_step(context, nullptr, nullptr, nullptr), TPA_OK);
  std::string seen = Observe(context).bytes;
  std::vector<double> further = MeshOf(context).positions;
  for (double& x : further) x *= 0.9;
  EXPECT_EQ(MoveAll(context, further), TPA_OK);
  EXPECT_EQ(tpa_step(context, nullptr, nullptr, nullptr), TPA_OK);
  return seen + Observe(context).bytes;
}

TEST(Snapshot, AByteCopyElsewhereGoesOnWithTheSameBits) {
  const Scene s = TwoSpheres();
  Arena arena(ConfigFor(s.mesh), s.mesh);
  ASSERT_EQ(MoveAll(*arena, {9, 9, 9}), TPA_OK);  // targets are part of the snapshot
  const tpa_arena_size& size = arena.size();
  std::vector<char> block = BlockFor(size);
  char* copy = Aligned(block, size.alignment, size.alignment);  // another address
  std::memcpy(copy, arena.block(), size.bytes);
  const std::string original = StepTwiceAndObserve(*arena, s);
  auto* snapshot = reinterpret_cast<tpa_context*>(copy);
  EXPECT_EQ(MeshOf(snapshot).positions, s.mesh.positions);
  EXPECT_EQ(StepTwiceAndObserve(snapshot, s), original);
}

TEST(Snapshot, RewindsAContext) {
  const Scene s = TwoSpheres();
  Arena arena(ConfigFor(s.mesh), s.mesh);
  const std::vector<char> before(arena.block(), arena.block() + arena.size().bytes);
  const std::string first = StepTwiceAndObserve(*arena, s);
  std::memcpy(arena.block(), before.data(), before.size());
  EXPECT_EQ(StepTwiceAndObserve(*arena, s), first);
}

// Observations and saved states of a run in a block so far from a multiple of the alignment; the bytes around it stay.
std::string RunInBlockAt(size_t off, const Scene& s) {
  const tpa_config config = ConfigFor(s.mesh);
  const tpa_arena_size size = SizeOf(config);
  EXPECT_EQ(size.bytes % size.alignment, 0u);
  std::vector<char> room(size.bytes + 2 * size.alignment, 'x');
  char* const block = Aligned(room, size.alignment, off);
  tpa_context* context = nullptr;
  EXPECT_EQ(tpa_init(block, size.bytes, &config, &context, nullptr), TPA_OK);
  EXPECT_EQ(static_cast<void*>(context), block);
  EXPECT_EQ(Load(context, s.mesh), TPA_OK);
  std::string seen = StepTwiceAndObserve(context, s);
  const Bytes saved = SavedFrom(context);
  EXPECT_EQ(tpa_reset(context), TPA_OK);
  EXPECT_EQ(tpa_restore(context, saved.data(), saved.size(), nullptr), TPA_OK);
  EXPECT_EQ(SavedFrom(context), saved);
  seen.append(saved.begin(), saved.end());
  seen += Observe(context).bytes;
  const auto is_untouched = [](char c) { return c == 'x'; };
  EXPECT_TRUE(std::all_of(room.data(), block, is_untouched));
  EXPECT_TRUE(std::all_of(block + size.bytes, room.data() + room.size(), is_untouched));
  return seen;
}

TEST(Arena, TakesBlocksAtAnyAddress) {
  const Scene s = TwoSpheres();
  const std::string aligned = RunInBlockAt(0, s);
  for (size_t off = 1; off < alignment_of_block; ++off) EXPECT_EQ(RunInBlockAt(off, s), aligned) << off;
}

TEST(Snapshot, AByteCopyWithAnotherAlignmentIsRefused) {
  const Scene s = TwoSpheres();
  Arena arena(ConfigFor(s.mesh), s.mesh);
  std::vector<char> block = BlockFor(arena.size());
  for (size_t off = 0; off < alignment_of_block; ++off) {
    char* copy = Aligned(block, alignment_of_block, off);
    std::memcpy(copy, arena.block(), arena.size().bytes);
    uint64_t digest = 0;
    EXPECT_EQ(tpa_digest(reinterpret_cast<tpa_context*>(copy), &digest), off == 0 ? TPA_OK : TPA_E_CONTEXT) << off;
  }
}

TEST(Snapshot, WhatWasInTheBlockBeforeDoesNotMatter) {
  const Scene s = TwoSpheres();
  const tpa_config config = ConfigFor(s.mesh);
  const tpa_arena_size size = SizeOf(config);
  std::string seen[2];
  for (int i = 0; i < 2; ++i) {
    std::vector<char> block(size.bytes + size.alignment, i == 0 ? '\0' : '\x5A');
    tpa_context* context = nullptr;
    ASSERT_EQ(tpa_init(Aligned(block, size.alignment), size.bytes, &config, &context, nullptr), TPA_OK);
    ASSERT_EQ(Load(context, s.mesh), TPA_OK);
    seen[i] = StepTwiceAndObserve(context, s);
  }
  EXPECT_EQ(seen[0], seen[1]);
}

// ---------------------------------------------------------------- no allocation

TEST(Heap, IsNotTouchedFromInitOn) {
#if !HEARS_HEAP
  GTEST_SKIP() << "no way to hear the heap here";
#endif
  const Scene s = TwoSpheres();
  const tpa_config config = ConfigFor(s.mesh);
  const tpa_arena_size size = SizeOf(config);
  std::vector<char> block = BlockFor(size);
  std::vector<double> positions(3 * size_t{config.max_vertices});
  std::vector<uint32_t> triangles(30 * size_t{config.max_vertices});
  auto out = Sized<tpa_mesh_output>();
  out.vertex_capacity = config.max_vertices;
  out.triangle_capacity = 10 * config.max_vertices;
  out.position_type = TPA_FLOAT64;
  out.index_type = TPA_UINT32;
  out.positions = positions.data();
  out.triangles = triangles.data();
  auto contacts = Sized<tpa_contacts>();
  auto validation = Sized<tpa_validation>();
  auto smooth = Sized<tpa_smooth_options>();
  smooth.iterations = 2;
  auto remesh = Sized<tpa_remesh_options>();
  remesh.iterations = 2;
  remesh.target_length = 0.25;
  remesh.relaxation = 0.5;
  auto stepped = Sized<tpa_report>(), adapted = Sized<tpa_report>(), remeshed = Sized<tpa_report>();
  // A deep overlap for tpa_adapt.
  Mesh tangled = s.mesh;
  for (size_t i = 0; i < tangled.positions.size() / 2; i += 3) tangled.positions[i] += 1;
  uint64_t handles = 0;
  uint32_t faces[3 * TPA_HANDLE_MAX_FACES];
  const uint32_t sides[3] = {5, 4, 3};
  auto info = Sized<tpa_handle_info>();
  char text[200];

  tpa_context* c = nullptr;
  tpa_issue issue;
  tpa_status status[12] = {};
  const size_t before = heap_calls;
  status[0] = tpa_init(Aligned(block, size.alignment), size.bytes, &config, &c, &issue);
  status[1] = Load(c, s.mesh, &issue);
  status[2] = MoveAll(c, s.targets, &issue);
  status[3] = tpa_step(c, nullptr, &stepped, &issue);
  status[4] = tpa_remesh(c, &remesh, nullptr, &remeshed, &issue);
  status[5] = tpa_smooth(c, &smooth, nullptr, nullptr, &issue);
  status[6] = tpa_detect(c, nullptr, &contacts, &issue);
  status[7] = tpa_export(c, &out, &issue);
  status[8] = Load(c, tangled, &issue);
  status[9] = tpa_adapt(c, nullptr, &adapted, &issue);
  status[10] = tpa_validate(c, nullptr, &validation, &issue);
  status[11] = tpa_handle_describe(3, sides, &info);
  for (handles = 0; handles < info.handles; ++handles)
    tpa_handle_get(3, sides, handles, faces, 3 * TPA_HANDLE_MAX_FACES);
  tpa_issue_text(&issue, text, sizeof text);
  const size_t calls = heap_calls - before;

  EXPECT_EQ(calls, 0u);
  for (size_t i = 0; i < 12; ++i) EXPECT_EQ(status[i], TPA_OK) << "call " << i;
  EXPECT_GE(stepped.groups, 1u) << "the step was to have an event";
  EXPECT_GE(adapted.groups, 1u);
  EXPECT_GT(remeshed.splits + remeshed.collapses + remeshed.flips, 0u);
  EXPECT_GT(heap_calls, 0u) << "the ear is deaf";
}

}  // namespace
}  // namespace arena_test
