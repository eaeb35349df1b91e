// SPDX-License-Identifier: MIT
// Structures that grow: callers compiled with an older header hand in shorter ones, callers with a newer header longer
// ones.
#include <cstring>

#include "api/structs.h"
#include "support/support.h"
#include "user_of_0_1.h"

namespace growth_test {
namespace {

using namespace support;

TEST(Growth, AProgramOfVersion01RunsAsEver) {
  outcome_of_0_1 outcome{};
  const char* fault = run_user_of_0_1(&outcome);
  ASSERT_EQ(fault, nullptr) << fault;
  EXPECT_EQ(outcome.pairs, 0u);
  EXPECT_EQ(outcome.handles, 120u);  // section 4
  EXPECT_GT(outcome.vertices, 12u);
  EXPECT_EQ(outcome.triangles, 2 * outcome.vertices - 4);  // one body of genus 0
  EXPECT_GT(outcome.region_before, 2.0);
  EXPECT_NEAR(outcome.volume, outcome.region_before, 0.3 * outcome.region_before);
}

TEST(Growth, TheFirstSizesAreThoseOfVersion01) {
  const uint32_t first[structs_of_0_1] = {tpa::growth<tpa_config>.first_size,
                                          tpa::growth<tpa_mesh_input>.first_size,
                                          tpa::growth<tpa_mesh_view>.first_size,
                                          tpa::growth<tpa_mesh_output>.first_size,
                                          tpa::growth<tpa_validation>.first_size,
                                          tpa::growth<tpa_move_input>.first_size,
                                          tpa::growth<tpa_exec>.first_size,
                                          tpa::growth<tpa_contacts>.first_size,
                                          tpa::growth<tpa_report>.first_size,
                                          tpa::growth<tpa_remesh_options>.first_size,
                                          tpa::growth<tpa_smooth_options>.first_size,
                                          tpa::growth<tpa_vertex_map_view>.first_size,
                                          tpa::growth<tpa_triangle_map_view>.first_size,
                                          tpa::growth<tpa_handle_info>.first_size};
  for (int i = 0; i < structs_of_0_1; ++i) {
    EXPECT_LE(first[i], sizes_of_0_1[i]) << i;
    EXPECT_GT(first[i] + 8, sizes_of_0_1[i]) << i;  // padding at the end, on some 32-bit processors
  }
}

// Three versions of a structure, of which the middle one is today's.
struct First {
  uint32_t struct_size, a;
};
struct Today {
  uint32_t struct_size, a, b, c;
};
struct Later {
  uint32_t struct_size, a, b, c, d, e;
};
constexpr tpa::Growth first_of_three{sizeof(First), tpa::Subject::unnamed};

TEST(Growth, ShorterIsReadWithZeros) {
  Today today{1, 2, 3, 4};
  const First first{sizeof(First), 7};
  ASSERT_FALSE(tpa::read_bytes(&first, first_of_three, &today, sizeof today));
  EXPECT_EQ(today.struct_size, sizeof today);
  EXPECT_EQ(today.a, 7u);
  EXPECT_EQ(today.b, 0u);
  EXPECT_EQ(today.c, 0u);
}

TEST(Growth, LongerIsReadIfTheRestIsZero) {
  Today today{1, 2, 3, 4};
  Later later{sizeof(Later), 7, 8, 9, 0, 0};
  ASSERT_FALSE(tpa::read_bytes(&later, first_of_three, &today, sizeof today));
  EXPECT_EQ(today.struct_size, sizeof today);
  EXPECT_EQ(today.c, 9u);
  later.e = 1u << 24 | 1u;
  today = {1, 2, 3, 4};
  const tpa::StructFault fault = tpa::read_bytes(&later, first_of_three, &today, sizeof today);
  EXPECT_EQ(fault.rule, tpa::Rule::zeros_beyond);
  EXPECT_EQ(fault.element, offsetof(Later, e));
  EXPECT_EQ(fault.available, sizeof today);
  EXPECT_EQ(today.a, 2u);
}

TEST(Growth, ShorterIsWrittenAsFarAsItGoesAndLongerWithZeros) {
  const Today today{0, 7, 8, 9};
  Later room{sizeof(First), 1, 2, 3, 4, 5};
  tpa::write_bytes(&today, sizeof today, &room);
  EXPECT_EQ(room.struct_size, sizeof(First));
  EXPECT_EQ(room.a, 7u);
  EXPECT_EQ(room.b, 2u);
  room.struct_size = sizeof(Later);
  tpa::write_bytes(&today, sizeof today, &room);
  EXPECT_EQ(room.struct_size, sizeof(Later));
  EXPECT_EQ(room.c, 9u);
  EXPECT_EQ(room.d, 0u);
  EXPECT_EQ(room.e, 0u);
}

// ---------------------------------------------------------------- every structure of the interface

constexpr size_t more = 24;

// A later version: longer than today's.
template <class T>
struct Longer {
  T known{};
  unsigned char beyond[more + sizeof(uint64_t)];  // the last eight are beyond any version

  Longer() {
    std::memset(beyond, 0, sizeof beyond);
    known.struct_size = static_cast<uint32_t>(sizeof(T) + more);
  }
  unsigned char& at(size_t i) { return reinterpret_cast<unsigned char*>(this)[sizeof(T) + i]; }
};

template <class T, class Run>
void ExpectSizesRefused(T given, const Run& run, tpa_status refusal) {
  const uint32_t first = tpa::growth<T>.first_size;
  for (uint32_t size : {0u, 4u, first - 4, static_cast<uint32_t>(sizeof(T)) + 1, 4100u, UINT32_MAX}) {
    given.struct_size = size;
    EXPECT_EQ(run(&given), refusal) << size;
  }
}

// Run: status of a call with the structure.
template <class T, class Run>
void ExpectInputGrows(const T& given, const Run& run, tpa_status refusal = TPA_E_ARGUMENT) {
  ASSERT_EQ(run(&given), TPA_OK);
  ExpectSizesRefused(given, run, refusal);
  Longer<T> longer;
  const uint32_t size = longer.known.struct_size;
  longer.known = given;
  longer.known.struct_size = size;
  longer.at(more) = 1;
  EXPECT_EQ(run(&longer.known), TPA_OK);
  for (size_t i : {size_t{0}, size_t{5}, more - 1}) {
    longer.at(i) = 1;
    EXPECT_EQ(run(&longer.known), refusal) << i;
    longer.at(i) = 0;
  }
}

template <class T, class Run>
void ExpectOutputGrows(const Run& run) {
  T today = Sized<T>();
  ASSERT_EQ(run(&today), TPA_OK);
  ExpectSizesRefused(today, run, TPA_E_ARGUMENT);
  Longer<T> longer;
  const uint32_t size = longer.known.struct_size;
  std::memset(static_cast<void*>(&longer), 0xA5, sizeof longer);
  longer.known.struct_size = size;
  ASSERT_EQ(run(&longer.known), TPA_OK);
  EXPECT_EQ(longer.known.struct_size, size);
  for (size_t i = 0; i < more; ++i) EXPECT_EQ(longer.at(i), 0) << i;
  EXPECT_EQ(longer.at(more), 0xA5);
  longer.known.struct_size = today.struct_size;
  EXPECT_EQ(std::memcmp(&longer.known, &today, tpa::growth<T>.first_size), 0);
}

void Serially(void*, uint32_t count, void (*task)(void*, uint32_t), void* data) {
  for (uint32_t i = 0; i < count; ++i) task(data, i);
}

class Growing : public testing::Test {
 protected:
  Growing() : mesh(Sphere({0, 0, 0}, 1, 4)), arena(ConfigFor(mesh), mesh) {}
  Mesh mesh;
  Arena arena;
};

TEST_F(Growing, Config) {
  const auto query = [](const tpa_config* config) {
    tpa_arena_size size;
    return tpa_arena_query(config, &size, nullptr);
  };
  ExpectInputGrows(DefaultConfig(100), query, TPA_E_CONFIG);
  Longer<tpa_config> longer;
  std::memset(static_cast<void*>(&longer), 0xA5, sizeof longer);
  ASSERT_EQ(tpa_config_init(&longer.known, sizeof(tpa_config) + more), TPA_OK);
  EXPECT_EQ(longer.known.struct_size, sizeof(tpa_config) + more);
  EXPECT_EQ(longer.at(more - 1), 0);
  EXPECT_EQ(longer.at(more), 0xA5);
  EXPECT_EQ(query(&longer.known), TPA_OK);
  for (size_t size : {size_t{0}, size_t{4}, sizeof(tpa_config) + 1, size_t{4100}, SIZE_MAX})
    EXPECT_EQ(tpa_config_init(&longer.known, size), TPA_E_ARGUMENT) << size;
}

TEST_F(Growing, AContextOfALongerConfigIsAContextOfTodays) {
  Longer<tpa_config> longer;
  ASSERT_EQ(tpa_config_init(&longer.known, sizeof(tpa_config) + more), TPA_OK);
  longer.known.max_vertices = ConfigFor(mesh).max_vertices;
  tpa_config today = DefaultConfig(longer.known.max_vertices);
  Arena of_longer(longer.known), of_todays(today);
  ASSERT_EQ(of_longer.size().bytes, of_todays.size().bytes);
  ASSERT_EQ(Load(*of_longer, mesh), TPA_OK);
  ASSERT_EQ(Load(*of_todays, mesh), TPA_OK);
  EXPECT_TRUE(Observe(*of_longer) == Observe(*of_todays));
}

TEST_F(Growing, MeshesInAndOut) {
  ExpectInputGrows(InputOf(mesh), [&](const tpa_mesh_input* in) { return tpa_load(*arena, in, nullptr); });
  std::vector<double> positions(mesh.positions.size());
  auto output = Sized<tpa_mesh_output>();
  output.position_type = TPA_FLOAT64;
  output.vertex_capacity = VertexCount(mesh);
  output.positions = positions.data();
  ExpectInputGrows(output, [&](const tpa_mesh_output* out) {
    return tpa_export(*arena, const_cast<tpa_mesh_output*>(out), nullptr);
  });
  ExpectOutputGrows<tpa_mesh_view>([&](tpa_mesh_view* view) { return tpa_view(*arena, view); });
  ExpectOutputGrows<tpa_validation>([&](tpa_validation* v) { return tpa_validate(*arena, nullptr, v, nullptr); });
  ExpectOutputGrows<tpa_contacts>([&](tpa_contacts* c) { return tpa_detect(*arena, nullptr, c, nullptr); });
  auto move = Sized<tpa_move_input>();
  move.count = VertexCount(mesh);
  move.position_type = TPA_FLOAT64;
  move.positions = mesh.positions.data();
  ExpectInputGrows(move, [&](const tpa_move_input* in) { return tpa_move(*arena, in, nullptr); });
}

TEST_F(Growing, Work) {
  auto exec = Sized<tpa_exec>();
  exec.parallel_for = Serially;
  ExpectInputGrows(exec, [&](const tpa_exec* e) { return tpa_step(*arena, e, nullptr, nullptr); });
  ExpectOutputGrows<tpa_report>([&](tpa_report* r) { return tpa_step(*arena, nullptr, r, nullptr); });
  auto remesh = Sized<tpa_remesh_options>();
  remesh.iterations = 1;
  remesh.target_length = .5;
  ExpectInputGrows(remesh,
                   [&](const tpa_remesh_options* o) { return tpa_remesh(*arena, o, nullptr, nullptr, nullptr); });
  auto smooth = Sized<tpa_smooth_options>();
  smooth.iterations = 1;
  ExpectInputGrows(smooth,
                   [&](const tpa_smooth_options* o) { return tpa_smooth(*arena, o, nullptr, nullptr, nullptr); });
}

TEST_F(Growing, Results) {
  ExpectOutputGrows<tpa_vertex_map_view>([&](tpa_vertex_map_view* m) { return tpa_vertex_map(*arena, m); });
  ExpectOutputGrows<tpa_triangle_map_view>([&](tpa_triangle_map_view* m) { return tpa_triangle_map(*arena, m); });
  ExpectInputGrows(Sized<tpa_change_list>(), [&](const tpa_change_list* list) {
    return tpa_changes(*arena, const_cast<tpa_change_list*>(list), nullptr);
  });
  ExpectOutputGrows<tpa_config>([&](tpa_config* config) { return tpa_config_of(*arena, config); });
  const uint32_t sides[3] = {5, 4, 3};
  ExpectOutputGrows<tpa_handle_info>([&](tpa_handle_info* info) { return tpa_handle_describe(3, sides, info); });
}

}  // namespace
}  // namespace growth_test
