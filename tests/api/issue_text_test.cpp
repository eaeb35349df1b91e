// SPDX-License-Identifier: MIT
// Messages name the argument or field at fault, and say what is wrong with it.
#include <cmath>
#include <functional>
#include <set>

#include "support/support.h"

namespace issue_text_test {
namespace {

using namespace support;

class IssueText : public testing::Test {
 protected:
  IssueText() : mesh(Sphere({0, 0, 0}, 1, 4)), arena(ConfigFor(mesh), mesh) {}

  // The message of a call that fails; `issue` is the call's.
  std::string Said(tpa_status status) {
    EXPECT_LT(status, 0);
    EXPECT_EQ(issue.status, status);
    return Text(issue);
  }
  std::string Loaded(const std::function<void(tpa_mesh_input&)>& change) {
    tpa_mesh_input input = InputOf(mesh);
    change(input);
    return Said(tpa_load(*arena, &input, &issue));
  }
  std::string Exported(const std::function<void(tpa_mesh_output&)>& change) {
    std::vector<double> positions(mesh.positions.size());
    std::vector<uint32_t> triangles(mesh.triangles.size());
    auto output = Sized<tpa_mesh_output>();
    output.vertex_capacity = VertexCount(mesh);
    output.triangle_capacity = TriangleCount(mesh);
    output.position_type = TPA_FLOAT64;
    output.index_type = TPA_UINT32;
    output.positions = positions.data();
    output.triangles = triangles.data();
    change(output);
    return Said(tpa_export(*arena, &output, &issue));
  }
  std::string Moved(const std::function<void(tpa_move_input&)>& change) {
    const double positions[9] = {};
    const uint32_t vertices[3] = {2, 0, 1};
    auto move = Sized<tpa_move_input>();
    move.count = 3;
    move.position_type = TPA_FLOAT64;
    move.positions = positions;
    move.vertices = vertices;
    change(move);
    return Said(tpa_move(*arena, &move, &issue));
  }
  std::string Remeshed(const std::function<void(tpa_remesh_options&)>& change) {
    auto options = Sized<tpa_remesh_options>();
    options.iterations = 1;
    options.target_length = 1;
    change(options);
    return Said(tpa_remesh(*arena, &options, nullptr, nullptr, &issue));
  }

  Mesh mesh;
  Arena arena;
  tpa_issue issue{};
};

const std::string argument = "invalid argument: ";

TEST_F(IssueText, NamesFieldsOfTheConfig) {
  struct Case {
    std::string field, rule;
    std::function<void(tpa_config&)> change;
  };
  const std::vector<Case> cases = {
      {"cookie", "must be as tpa_config_init sets it", [](tpa_config& c) { c.cookie = 0; }},
      {"max_vertices", "must be 4 .. 2^29", [](tpa_config& c) { c.max_vertices = 3; }},
      {"max_triangles", "must be 0 or 4 .. 2^30 + 1024", [](tpa_config& c) { c.max_triangles = 3; }},
      {"max_contacts", "must be 0 or 1 .. 2^30", [](tpa_config& c) { c.max_contacts = UINT32_MAX; }},
      {"max_cut_edges", "must be 0 or 3 .. 2^28", [](tpa_config& c) { c.max_cut_edges = 2; }},
      {"max_events", "must be 0 or 1 .. 2^28", [](tpa_config& c) { c.max_events = UINT32_MAX; }},
      {"max_components", "must be 0 or 1 .. 2^28", [](tpa_config& c) { c.max_components = UINT32_MAX; }},
      {"max_pieces", "must be 0 or 1 .. 2^28", [](tpa_config& c) { c.max_pieces = UINT32_MAX; }},
      {"detect_mode", "must be TPA_DETECT_COMPLETE or TPA_DETECT_VERTEX_HASH",
       [](tpa_config& c) { c.detect_mode = 2; }},
      {"cell_size", "must be 2^-100 .. 2^100", [](tpa_config& c) { c.cell_size = 0; }},
      {"region", "must be TPA_REGION_INSIDE or TPA_REGION_OUTSIDE", [](tpa_config& c) { c.region = 2; }},
      {"max_passes", "must be 1 .. 64", [](tpa_config& c) { c.max_passes = 65; }},
      {"max_candidates", "must be 1 .. 256", [](tpa_config& c) { c.max_candidates = 257; }},
      {"smooth_iterations", "must be 0 .. 1000", [](tpa_config& c) { c.smooth_iterations = 1001; }},
      {"smooth_lambda", "must be 2^-20 .. 1", [](tpa_config& c) { c.smooth_lambda = 2; }},
      {"smooth_mu", "must be at least -1.5 and below -smooth_lambda", [](tpa_config& c) { c.smooth_mu = 0; }}};
  int position = 2;
  for (const Case& k : cases) {
    tpa_config config = DefaultConfig(100);
    k.change(config);
    tpa_arena_size size;
    EXPECT_EQ(Said(tpa_arena_query(&config, &size, &issue)), "invalid configuration: config." + k.field + " " + k.rule);
    EXPECT_EQ(issue.argument, position++) << k.field;
  }
  tpa_config config = DefaultConfig(100);
  config.struct_size = 12;
  tpa_arena_size size;
  EXPECT_EQ(Said(tpa_arena_query(&config, &size, &issue)),
            "invalid configuration: config.struct_size is 12, must be the sizeof of the structure, " +
                std::to_string(sizeof(tpa_config)) + " in this version");
}

TEST_F(IssueText, NamesArguments) {
  tpa_config config = DefaultConfig(100);
  tpa_arena_size size;
  tpa_context* context = nullptr;
  alignas(64) char block[64];
  EXPECT_EQ(Said(tpa_arena_query(nullptr, &size, &issue)), argument + "config must not be NULL");
  EXPECT_EQ(Said(tpa_arena_query(&config, nullptr, &issue)), argument + "size must not be NULL");
  EXPECT_EQ(Said(tpa_init(nullptr, 64, &config, &context, &issue)), argument + "memory must not be NULL");
  EXPECT_EQ(Said(tpa_init(block, 64, &config, nullptr, &issue)), argument + "context must not be NULL");
  EXPECT_EQ(Said(tpa_load(*arena, nullptr, &issue)), argument + "mesh must not be NULL");
  EXPECT_EQ(Said(tpa_export(*arena, nullptr, &issue)), argument + "mesh must not be NULL");
  EXPECT_EQ(Said(tpa_move(*arena, nullptr, &issue)), argument + "move must not be NULL");
  EXPECT_EQ(Said(tpa_detect(*arena, nullptr, nullptr, &issue)), argument + "contacts must not be NULL");
  EXPECT_EQ(Said(tpa_validate(*arena, nullptr, nullptr, &issue)), argument + "validation must not be NULL");
  EXPECT_EQ(Said(tpa_remesh(*arena, nullptr, nullptr, nullptr, &issue)), argument + "options must not be NULL");
  EXPECT_EQ(Said(tpa_smooth(*arena, nullptr, nullptr, nullptr, &issue)), argument + "options must not be NULL");
  auto report = Sized<tpa_report>();
  report.struct_size = 4;
  EXPECT_EQ(Said(tpa_step(*arena, nullptr, &report, &issue)),
            argument + "report.struct_size is 4, must be the sizeof of the structure, " +
                std::to_string(sizeof report) + " in this version");
  auto exec = Sized<tpa_exec>();
  exec.struct_size = 4;
  EXPECT_EQ(Said(tpa_step(*arena, &exec, nullptr, &issue)),
            argument + "exec.struct_size is 4, must be the sizeof of the structure, " + std::to_string(sizeof exec) +
                " in this version");
  struct {
    tpa_move_input known;
    uint32_t beyond[2];
  } longer = {Sized<tpa_move_input>(), {0, 7}};
  longer.known.struct_size = sizeof longer;
  EXPECT_EQ(Said(tpa_move(*arena, &longer.known, &issue)).find(argument + "move must be zero beyond the "), 0u)
      << Text(issue);
}

TEST_F(IssueText, NamesFieldsOfMeshes) {
  const std::string stride = " must be 0 or at least the bytes of three numbers";
  const std::string floats = " must be TPA_FLOAT32 or TPA_FLOAT64", indices = " must be TPA_UINT16 or TPA_UINT32";
  using In = tpa_mesh_input;
  EXPECT_EQ(Loaded([](In& m) { m.positions = nullptr; }), argument + "mesh.positions must not be NULL");
  EXPECT_EQ(Loaded([](In& m) { m.triangles = nullptr; }), argument + "mesh.triangles must not be NULL");
  EXPECT_EQ(Loaded([](In& m) { m.vertex_count = 3; }), argument + "mesh.vertex_count must be at least 4");
  EXPECT_EQ(Loaded([](In& m) { m.triangle_count = 3; }), argument + "mesh.triangle_count must be at least 4");
  EXPECT_EQ(Loaded([](In& m) { m.position_type = TPA_UINT16; }), argument + "mesh.position_type" + floats);
  EXPECT_EQ(Loaded([](In& m) { m.index_type = 0; }), argument + "mesh.index_type" + indices);
  EXPECT_EQ(Loaded([](In& m) { m.position_stride = 23; }), argument + "mesh.position_stride" + stride);
  EXPECT_EQ(Loaded([](In& m) { m.triangle_stride = 11; }), argument + "mesh.triangle_stride" + stride);
  using Out = tpa_mesh_output;
  EXPECT_EQ(Exported([](Out& m) { m.position_type = 9; }), argument + "mesh.position_type" + floats);
  EXPECT_EQ(Exported([](Out& m) { m.index_type = 9; }), argument + "mesh.index_type" + indices);
  EXPECT_EQ(Exported([](Out& m) { m.position_stride = 1; }), argument + "mesh.position_stride" + stride);
  EXPECT_EQ(Exported([](Out& m) { m.triangle_stride = 1; }), argument + "mesh.triangle_stride" + stride);
  const std::string limit = "limit reached: mesh.";
  EXPECT_EQ(Exported([](Out& m) { m.vertex_capacity = 5; }),
            limit + "vertex_capacity is 5, needs at least " + std::to_string(VertexCount(mesh)));
  EXPECT_EQ(Exported([](Out& m) { m.triangle_capacity = 6; }),
            limit + "triangle_capacity is 6, needs at least " + std::to_string(TriangleCount(mesh)));
}

TEST_F(IssueText, NamesFieldsOfMovesAndOptions) {
  using Move = tpa_move_input;
  EXPECT_EQ(Moved([](Move& m) { m.positions = nullptr; }), argument + "move.positions must not be NULL");
  EXPECT_EQ(Moved([](Move& m) { m.position_type = 0; }),
            argument + "move.position_type must be TPA_FLOAT32 or TPA_FLOAT64");
  EXPECT_EQ(Moved([](Move& m) { m.position_stride = 8; }),
            argument + "move.position_stride must be 0 or at least the bytes of three numbers");
  const std::string options = argument + "options.";
  using Options = tpa_remesh_options;
  EXPECT_EQ(Remeshed([](Options& o) { o.iterations = 0; }), options + "iterations must be 1 .. 100");
  EXPECT_EQ(Remeshed([](Options& o) { o.target_length = NAN; }), options + "target_length must be 2^-100 .. 2^100");
  EXPECT_EQ(Remeshed([](Options& o) { o.split_ratio = -1; }), options + "split_ratio must be above 0 and at most 10^6");
  EXPECT_EQ(Remeshed([](Options& o) { o.collapse_ratio = 1; }),
            options + "collapse_ratio must be above 0 and at most split_ratio / 1.5");
  EXPECT_EQ(Remeshed([](Options& o) { o.relaxation = 2; }), options + "relaxation must be 0 .. 1");
  auto smooth = Sized<tpa_smooth_options>();
  smooth.iterations = 1001;
  EXPECT_EQ(Said(tpa_smooth(*arena, &smooth, nullptr, nullptr, &issue)), options + "iterations must be 0 .. 1000");
  smooth.iterations = 1;
  smooth.reserved = 1;
  EXPECT_EQ(Said(tpa_smooth(*arena, &smooth, nullptr, nullptr, &issue)), options + "reserved must be 0");
}

TEST_F(IssueText, NamesPlaceAndVertexOfAList) {
  const std::string count = std::to_string(VertexCount(mesh));
  const uint32_t ids[3] = {2, 0, 12345};
  const std::string unknown = "unknown vertex id: place 2 of the list names vertex 12345 of " + count + " vertices";
  EXPECT_EQ(Moved([&](tpa_move_input& m) { m.vertices = ids; }), unknown);
  auto smooth = Sized<tpa_smooth_options>();
  smooth.count = 3;
  smooth.vertices = ids;
  EXPECT_EQ(Said(tpa_smooth(*arena, &smooth, nullptr, nullptr, &issue)), unknown);
  double positions[9] = {NAN};
  EXPECT_EQ(Moved([&](tpa_move_input& m) { m.positions = positions; }),
            "unusable coordinate: place 0 of the list, the target of vertex 2, has a coordinate that is not finite");
  positions[0] = 0;
  positions[7] = 0x1p-300;
  EXPECT_EQ(Moved([&](tpa_move_input& m) { m.positions = positions; }),
            "unusable coordinate: place 2 of the list, the target of vertex 1, has a coordinate of magnitude outside "
            "[2^-100, 2^100]");
  std::vector<double> broken = mesh.positions;
  broken[3 * 7 + 1] = INFINITY;
  EXPECT_EQ(Loaded([&](tpa_mesh_input& m) { m.positions = broken.data(); }),
            "unusable coordinate: vertex 7 has a coordinate that is not finite");
  std::vector<uint32_t> triangles = mesh.triangles;
  triangles[3 * 4 + 2] = 12345;
  EXPECT_EQ(Loaded([&](tpa_mesh_input& m) { m.triangles = triangles.data(); }),
            "unknown vertex id: triangle 4 names vertex 12345 of " + count + " vertices");
}

TEST_F(IssueText, EveryStatusHasANameOfItsOwn) {
  const std::string unknown = tpa_status_string(1);
  std::set<std::string> names;
  int statuses = 0;
  for (int32_t status = -100; status <= TPA_OK; ++status) {
    if (tpa_status_string(status) == unknown) continue;
    ++statuses;
    names.insert(tpa_status_string(status));
  }
  EXPECT_GE(statuses, 11);
  EXPECT_EQ(names.size(), static_cast<size_t>(statuses));
}

TEST(HandleCapacity, IsThatOfNumbersAndNothingIsWrittenBeyond) {
  const uint32_t sides[3] = {5, 4, 3};
  auto info = Sized<tpa_handle_info>();
  ASSERT_EQ(tpa_handle_describe(3, sides, &info), TPA_OK);
  const uint32_t needed = 3 * info.faces;
  for (uint32_t capacity : {needed, needed + 1, needed + 3}) {
    std::vector<uint32_t> faces(needed + 3, 99);
    EXPECT_EQ(tpa_handle_get(3, sides, 7, faces.data(), capacity), TPA_OK);
    EXPECT_NE(faces[needed - 1], 99u);
    EXPECT_EQ(faces[needed], 99u);
    faces.assign(needed + 3, 99);
    EXPECT_EQ(tpa_handle_generator(3, sides, 0, faces.data(), capacity, nullptr), TPA_OK);
    EXPECT_EQ(faces[needed], 99u);
  }
  for (uint32_t capacity : {0u, 3u, needed - 1}) {
    std::vector<uint32_t> faces(needed, 99);
    uint64_t orbit = 99;
    EXPECT_EQ(tpa_handle_get(3, sides, 7, faces.data(), capacity), TPA_E_ARGUMENT);
    EXPECT_EQ(tpa_handle_generator(3, sides, 0, faces.data(), capacity, &orbit), TPA_E_ARGUMENT);
    EXPECT_EQ(faces, std::vector<uint32_t>(needed, 99));
    EXPECT_EQ(orbit, 99u);
  }
}

}  // namespace
}  // namespace issue_text_test
