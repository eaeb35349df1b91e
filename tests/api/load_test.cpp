// SPDX-License-Identifier: MIT
// The mesh in and out: accepted input, refused input and its message, and state unchanged by a refusal.
#include <cmath>
#include <cstring>
#include <limits>

#include "support/support.h"

namespace load_test {
namespace {

using namespace support;

struct Expected {
  int32_t defect;
  uint64_t element, other;
};

// A context with an earlier mesh, events and maps, to be left alone by every refusal.
class Loading : public testing::Test {
 protected:
  Loading() : arena(DefaultConfig(2000)) {
    const Mesh two = Together({Sphere({0, 0, 0}, 1, 5), Sphere({1.5, 0.1, 0.2}, 1, 5)});
    EXPECT_EQ(Load(*arena, two), TPA_OK);
    EXPECT_EQ(tpa_adapt(*arena, nullptr, nullptr, nullptr), TPA_OK);
    EXPECT_FALSE(EventsOf(*arena).empty());
    before = Observe(*arena);
  }
  void Refuse(const Mesh& mesh, Expected e) {
    tpa_issue issue;
    EXPECT_EQ(Load(*arena, mesh, &issue), TPA_E_MESH);
    EXPECT_EQ(issue.status, TPA_E_MESH);
    EXPECT_EQ(issue.defect, e.defect) << Text(issue);
    EXPECT_EQ(issue.element, e.element) << Text(issue);
    EXPECT_EQ(issue.other, e.other) << Text(issue);
    EXPECT_EQ(Text(issue).find('\n'), std::string::npos);
    EXPECT_TRUE(Observe(*arena) == before);
  }
  Arena arena;
  Observed before;
  const Mesh sphere = Sphere({0, 0, 0}, 1, 3);
};

TEST_F(Loading, NotFinite) {
  for (double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                     -std::numeric_limits<double>::infinity()})
    for (size_t axis = 0; axis < 3; ++axis) {
      Mesh m = sphere;
      m.positions[3 * 7 + axis] = bad;
      m.positions[3 * 2] = 0x1p200;  // magnitude comes later in the list
      Refuse(m, {TPA_DEFECT_NOT_FINITE, 7, 0});
    }
}

TEST_F(Loading, Magnitude) {
  for (double bad : {0x1p101, -0x1p101, std::nextafter(0x1p100, INFINITY), 0x1p-101, -0x1.fffffp-101, 5e-324, 1e300}) {
    Mesh m = sphere;
    m.positions[3 * 11 + 1] = bad;
    Refuse(m, {TPA_DEFECT_MAGNITUDE, 11, 0});
  }
  for (double good : {0x1p100, -0x1p100, 0x1p-100, -0x1p-100, 0.0, -0.0}) {
    Mesh m = sphere;
    m.positions[3 * 11 + 1] = good;
    EXPECT_EQ(Load(*arena, m), TPA_OK) << good;
  }
}

TEST_F(Loading, IndexRange) {
  for (uint32_t bad : {VertexCount(sphere), 0xFFFFFFFFu, 0x80000000u}) {
    Mesh m = sphere;
    m.triangles[3 * 5 + 2] = bad;
    Refuse(m, {TPA_DEFECT_INDEX_RANGE, 5, bad});
  }
}

TEST_F(Loading, RepeatedVertex) {
  for (size_t i = 0; i < 3; ++i) {
    Mesh m = sphere;
    const uint32_t v = m.triangles[3 * 9 + i];
    m.triangles[3 * 9 + (i + 1) % 3] = v;
    Refuse(m, {TPA_DEFECT_REPEATED_VERTEX, 9, v});
  }
}

TEST_F(Loading, Orientation) {
  Mesh m = sphere;
  std::swap(m.triangles[3 * 9 + 1], m.triangles[3 * 9 + 2]);
  tpa_issue issue;
  ASSERT_EQ(Load(*arena, m, &issue), TPA_E_MESH);
  EXPECT_EQ(issue.defect, TPA_DEFECT_ORIENTATION);
  // The edge belongs to the turned triangle.
  int corners = 0;
  for (size_t i = 0; i < 3; ++i)
    corners += m.triangles[3 * 9 + i] == issue.element || m.triangles[3 * 9 + i] == issue.other ? 1 : 0;
  EXPECT_EQ(corners, 2) << Text(issue);
  EXPECT_TRUE(Observe(*arena) == before);
}

TEST_F(Loading, NonManifoldEdge) {
  // Two tetrahedra with edge 0 1 in common.
  Mesh m;
  m.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1};
  m.triangles = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2, 0, 1, 5, 0, 4, 1, 1, 4, 5, 0, 5, 4};
  tpa_issue issue;
  ASSERT_EQ(Load(*arena, m, &issue), TPA_E_MESH);
  EXPECT_EQ(issue.defect, TPA_DEFECT_NON_MANIFOLD_EDGE) << Text(issue);
  EXPECT_EQ(std::min(issue.element, issue.other), 0u);
  EXPECT_EQ(std::max(issue.element, issue.other), 1u);
  EXPECT_TRUE(Observe(*arena) == before);
}

TEST_F(Loading, BoundaryEdge) {
  Mesh m = sphere;
  const std::vector<uint32_t> gone(m.triangles.end() - 3, m.triangles.end());
  m.triangles.resize(m.triangles.size() - 3);
  tpa_issue issue;
  ASSERT_EQ(Load(*arena, m, &issue), TPA_E_MESH);
  EXPECT_EQ(issue.defect, TPA_DEFECT_BOUNDARY_EDGE) << Text(issue);
  for (uint64_t v : {issue.element, issue.other}) EXPECT_TRUE(v == gone[0] || v == gone[1] || v == gone[2]) << v;
  EXPECT_TRUE(Observe(*arena) == before);
}

TEST_F(Loading, NonManifoldVertex) {
  // Two tetrahedra with vertex 3 in common.
  Mesh m;
  m.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 2, 1, 0, 2, 0, 1, 2};
  m.triangles = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2, 4, 5, 6, 4, 3, 5, 5, 3, 6, 4, 6, 3};
  Refuse(m, {TPA_DEFECT_NON_MANIFOLD_VERTEX, 3, 0});
}

TEST_F(Loading, IsolatedVertex) {
  Mesh m = sphere;
  m.positions.insert(m.positions.end(), {3, 3, 3});
  Refuse(m, {TPA_DEFECT_ISOLATED_VERTEX, VertexCount(sphere), 0});
}

TEST_F(Loading, DefectsComeInTheOrderOfTheList) {
  Mesh m = sphere;
  m.positions.insert(m.positions.end(), {3, 3, 3});  // isolated
  std::swap(m.triangles[0], m.triangles[1]);         // orientation
  m.triangles[3 * 4] = m.triangles[3 * 4 + 1];       // repeated vertex
  Refuse(m, {TPA_DEFECT_REPEATED_VERTEX, 4, m.triangles[3 * 4]});
  m.triangles[3 * 6] = 1000000;
  Refuse(m, {TPA_DEFECT_INDEX_RANGE, 6, 1000000});
  m.positions[3 * 8] = 0x1p300;
  Refuse(m, {TPA_DEFECT_MAGNITUDE, 8, 0});
}

TEST_F(Loading, TooManyComponents) {
  const Mesh three = Together({sphere, Translated(sphere, {5, 0, 0}), Translated(sphere, {0, 5, 0})});
  tpa_config config = ConfigFor(three);
  config.max_components = 2;
  Arena narrow(config, sphere);
  const Observed loaded = Observe(*narrow);
  tpa_issue issue;
  ASSERT_EQ(Load(*narrow, three, &issue), TPA_E_LIMIT);
  EXPECT_EQ(issue.limit, TPA_LIMIT_COMPONENTS);
  EXPECT_EQ(issue.needed, 3u);
  EXPECT_EQ(issue.available, 2u);
  EXPECT_TRUE(Observe(*narrow) == loaded);
  config.max_components = 3;
  Arena fitting(config);
  EXPECT_EQ(Load(*fitting, three, &issue), TPA_OK);
}

TEST_F(Loading, TooManyVerticesOrTriangles) {
  const Mesh large = Sphere({0, 0, 0}, 1, 30);
  tpa_issue issue;
  ASSERT_EQ(Load(*arena, large, &issue), TPA_E_LIMIT);
  EXPECT_EQ(issue.limit, TPA_LIMIT_VERTICES);
  EXPECT_EQ(issue.needed, VertexCount(large));
  EXPECT_EQ(issue.available, 2000u);
  EXPECT_TRUE(Observe(*arena) == before);

  tpa_config config = ConfigFor(sphere);
  config.max_triangles = TriangleCount(sphere) - 1;
  Arena narrow(config);
  ASSERT_EQ(Load(*narrow, sphere, &issue), TPA_E_LIMIT);
  EXPECT_EQ(issue.limit, TPA_LIMIT_TRIANGLES);
  EXPECT_EQ(issue.needed, TriangleCount(sphere));
  config.max_triangles = TriangleCount(sphere);
  Arena fitting(config);
  EXPECT_EQ(Load(*fitting, sphere, &issue), TPA_OK);
}

TEST_F(Loading, UnknownTypesStridesAndSizes) {
  const auto refuse = [&](auto&& change) {
    tpa_mesh_input input = InputOf(sphere);
    change(input);
    tpa_issue issue;
    EXPECT_EQ(tpa_load(*arena, &input, &issue), TPA_E_ARGUMENT);
    EXPECT_EQ(issue.argument, 2);
    EXPECT_TRUE(Observe(*arena) == before);
  };
  refuse([](tpa_mesh_input& m) { m.struct_size = 0; });
  refuse([](tpa_mesh_input& m) { m.struct_size -= 8; });
  refuse([](tpa_mesh_input& m) { m.position_type = TPA_UINT32; });
  refuse([](tpa_mesh_input& m) { m.position_type = 0; });
  refuse([](tpa_mesh_input& m) { m.index_type = TPA_FLOAT32; });
  refuse([](tpa_mesh_input& m) { m.position_stride = 23; });
  refuse([](tpa_mesh_input& m) { m.triangle_stride = 11; });
  refuse([](tpa_mesh_input& m) { m.positions = nullptr; });
  refuse([](tpa_mesh_input& m) { m.triangles = nullptr; });
  refuse([](tpa_mesh_input& m) { m.vertex_count = 3; });
  refuse([](tpa_mesh_input& m) { m.triangle_count = 3; });
}

// ---------------------------------------------------------------- round trips

template <class Real, class Index>
void RoundTrip(uint32_t position_type, uint32_t index_type, uint32_t extra) {
  const Mesh sphere = Sphere({0, 0, 0}, 1, 4);
  const uint32_t vertices = VertexCount(sphere), triangles = TriangleCount(sphere);
  const uint32_t position_stride = static_cast<uint32_t>(3 * sizeof(Real)) + extra;
  const uint32_t triangle_stride = static_cast<uint32_t>(3 * sizeof(Index)) + extra;
  std::vector<char> p(size_t{position_stride} * vertices, '\x77'), t(size_t{triangle_stride} * triangles, '\x77');
  for (size_t v = 0; v < vertices; ++v)
    for (size_t i = 0; i < 3; ++i) {
      const Real x = static_cast<Real>(sphere.positions[3 * v + i]);
      std::memcpy(p.data() + v * position_stride + i * sizeof x, &x, sizeof x);
    }
  for (size_t f = 0; f < triangles; ++f)
    for (size_t i = 0; i < 3; ++i) {
      const Index x = static_cast<Index>(sphere.triangles[3 * f + i]);
      std::memcpy(t.data() + f * triangle_stride + i * sizeof x, &x, sizeof x);
    }
  Arena arena(ConfigFor(sphere));
  auto input = Sized<tpa_mesh_input>();
  input.vertex_count = vertices;
  input.triangle_count = triangles;
  input.position_type = position_type;
  input.index_type = index_type;
  input.position_stride = extra == 0 ? 0 : position_stride;
  input.triangle_stride = extra == 0 ? 0 : triangle_stride;
  input.positions = p.data();
  input.triangles = t.data();
  tpa_issue issue;
  ASSERT_EQ(tpa_load(*arena, &input, &issue), TPA_OK) << Text(issue);
  EXPECT_EQ(MeshOf(*arena).triangles, sphere.triangles);

  std::vector<char> p2(p.size(), '\x77'), t2(t.size(), '\x77');
  auto output = Sized<tpa_mesh_output>();
  output.vertex_capacity = vertices;
  output.triangle_capacity = triangles;
  output.position_type = position_type;
  output.index_type = index_type;
  output.position_stride = input.position_stride;
  output.triangle_stride = input.triangle_stride;
  output.positions = p2.data();
  output.triangles = t2.data();
  ASSERT_EQ(tpa_export(*arena, &output, &issue), TPA_OK) << Text(issue);
  EXPECT_EQ(output.vertex_count, vertices);
  EXPECT_EQ(output.triangle_count, triangles);
  EXPECT_EQ(p2, p);
  EXPECT_EQ(t2, t);
}

TEST(RoundTrips, EveryTypeWithAndWithoutStride) {
  for (uint32_t extra : {0u, 1u, 4u, 29u}) {  // 1: unaligned
    RoundTrip<double, uint32_t>(TPA_FLOAT64, TPA_UINT32, extra);
    RoundTrip<double, uint16_t>(TPA_FLOAT64, TPA_UINT16, extra);
    RoundTrip<float, uint32_t>(TPA_FLOAT32, TPA_UINT32, extra);
    RoundTrip<float, uint16_t>(TPA_FLOAT32, TPA_UINT16, extra);
  }
}

TEST(Export, AlwaysWritesTheCountsAndNothingElseWhereRoomIsShort) {
  const Mesh sphere = Sphere({0, 0, 0}, 1, 4);
  Arena arena(ConfigFor(sphere), sphere);
  std::vector<double> p(sphere.positions.size(), 7);
  std::vector<uint32_t> t(sphere.triangles.size(), 7);
  auto output = Sized<tpa_mesh_output>();
  tpa_issue issue;
  EXPECT_EQ(tpa_export(*arena, &output, &issue), TPA_OK);  // counts only
  EXPECT_EQ(output.vertex_count, VertexCount(sphere));
  EXPECT_EQ(output.triangle_count, TriangleCount(sphere));
  output.position_type = TPA_FLOAT64;
  output.index_type = TPA_UINT32;
  output.positions = p.data();
  output.triangles = t.data();
  const auto refuse = [&](uint32_t vertices, uint32_t triangles, int32_t limit, uint64_t needed) {
    output.vertex_capacity = vertices;
    output.triangle_capacity = triangles;
    output.vertex_count = output.triangle_count = 0;
    EXPECT_EQ(tpa_export(*arena, &output, &issue), TPA_E_LIMIT);
    EXPECT_EQ(issue.limit, limit);
    EXPECT_EQ(issue.needed, needed);
    EXPECT_EQ(output.vertex_count, VertexCount(sphere));
    EXPECT_EQ(output.triangle_count, TriangleCount(sphere));
    EXPECT_EQ(p, std::vector<double>(p.size(), 7));
    EXPECT_EQ(t, std::vector<uint32_t>(t.size(), 7));
  };
  refuse(VertexCount(sphere) - 1, TriangleCount(sphere), TPA_LIMIT_VERTICES, VertexCount(sphere));
  refuse(VertexCount(sphere), TriangleCount(sphere) - 1, TPA_LIMIT_TRIANGLES, TriangleCount(sphere));
}

TEST(View, OppositesRunTheOtherWay) {
  const Mesh torus = Torus({1, 2, 3}, 3, 1, 12, 8);
  Arena arena(ConfigFor(torus), torus);
  auto view = Sized<tpa_mesh_view>();
  ASSERT_EQ(tpa_view(*arena, &view), TPA_OK);
  const auto head = [&](uint32_t h) { return view.triangles[h - h % 3 + (h + 1) % 3]; };
  for (uint32_t h = 0; h < 3 * view.triangle_count; ++h) {
    const uint32_t k = view.opposites[h];
    ASSERT_LT(k, 3 * view.triangle_count);
    EXPECT_EQ(view.opposites[k], h);
    EXPECT_EQ(view.triangles[h], head(k));
    EXPECT_EQ(view.triangles[k], head(h));
  }
}

TEST(View, LoadMakesIdentityMapsAndANewEpoch) {
  const Mesh sphere = Sphere({0, 0, 0}, 1, 4);
  Arena arena(ConfigFor(sphere), sphere);
  auto view = Sized<tpa_mesh_view>();
  ASSERT_EQ(tpa_view(*arena, &view), TPA_OK);
  const uint64_t epoch = view.epoch;
  ASSERT_EQ(Load(*arena, sphere), TPA_OK);
  ASSERT_EQ(tpa_view(*arena, &view), TPA_OK);
  EXPECT_GT(view.epoch, epoch);
  const std::vector<uint32_t> old_to_new = OldToNewOf(*arena);
  const std::vector<tpa_vertex_origin> origins = VertexOriginsOf(*arena);
  ASSERT_EQ(old_to_new.size(), VertexCount(sphere));
  for (uint32_t v = 0; v < VertexCount(sphere); ++v) {
    EXPECT_EQ(old_to_new[v], v);
    EXPECT_EQ(origins[v].parents[0], v);
    EXPECT_EQ(origins[v].parents[1], TPA_NONE);
    EXPECT_EQ(origins[v].weight, 1.0f);
  }
}

TEST(Validate, CountsComponentsGenusAndVolume) {
  const Mesh m = Together({Box({0, 0, 0}, {2, 3, 4}, 3), Torus({10, 0, 0}, 3, 1, 24, 12)});
  Arena arena(ConfigFor(m), m);
  auto v = Sized<tpa_validation>();
  tpa_issue issue;
  ASSERT_EQ(tpa_validate(*arena, nullptr, &v, &issue), TPA_OK) << Text(issue);
  const Topology t = TopologyOf(m);
  EXPECT_EQ(t.Genera(), (std::vector<int64_t>{0, 1}));
  EXPECT_EQ(v.components, 2u);
  EXPECT_EQ(v.euler, 2);
  EXPECT_EQ(v.genus, 1);
  EXPECT_EQ(v.self_intersections, 0u);
  EXPECT_NEAR(v.volume, t.Volume(), 1e-9 * t.Volume());
  EXPECT_NEAR(t.components[0].volume, 24, 1e-12);
}

TEST(Validate, CountsEveryIntersectionAlsoThoseThatDoNotFit) {
  const Mesh m = Together({Sphere({0, 0, 0}, 1, 6), Sphere({0.7, 0.1, 0.2}, 1, 6)});
  const size_t pairs = AllMeetingPairs(m).size();
  ASSERT_GT(pairs, 10u);
  Arena arena(ConfigFor(m), m);
  auto v = Sized<tpa_validation>();
  ASSERT_EQ(tpa_validate(*arena, nullptr, &v, nullptr), TPA_OK);
  EXPECT_EQ(v.self_intersections, pairs);
  tpa_config config = ConfigFor(m);
  config.max_contacts = 5;
  Arena narrow(config, m);
  tpa_issue issue;
  v = Sized<tpa_validation>();
  EXPECT_EQ(tpa_validate(*narrow, nullptr, &v, &issue), TPA_E_LIMIT);
  EXPECT_EQ(issue.limit, TPA_LIMIT_CONTACTS);
  EXPECT_EQ(issue.needed, pairs);
  EXPECT_EQ(v.components, 2u);
}

TEST(Move, NamesTheFirstBadTargetAndChangesNone) {
  const Mesh sphere = Sphere({0, 0, 0}, 1, 4);
  Arena arena(ConfigFor(sphere), sphere);
  std::vector<double> targets = sphere.positions;
  for (double& x : targets) x *= 1.5;
  targets[3 * 6 + 1] = std::numeric_limits<double>::quiet_NaN();
  tpa_issue issue;
  EXPECT_EQ(MoveAll(*arena, targets, &issue), TPA_E_MESH);
  EXPECT_EQ(issue.defect, TPA_DEFECT_NOT_FINITE);
  EXPECT_EQ(issue.element, 6u);
  targets[3 * 6 + 1] = 0x1p-300;
  EXPECT_EQ(MoveAll(*arena, targets, &issue), TPA_E_MESH);
  EXPECT_EQ(issue.defect, TPA_DEFECT_MAGNITUDE);
  EXPECT_EQ(issue.element, 6u);
  auto move = Sized<tpa_move_input>();
  const uint32_t ids[2] = {0, VertexCount(sphere)};
  move.count = 2;
  move.position_type = TPA_FLOAT64;
  move.positions = sphere.positions.data();
  move.vertices = ids;
  EXPECT_EQ(tpa_move(*arena, &move, &issue), TPA_E_MESH);
  EXPECT_EQ(issue.defect, TPA_DEFECT_INDEX_RANGE);
  EXPECT_EQ(issue.other, VertexCount(sphere));
  ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_OK);
  EXPECT_EQ(MeshOf(*arena).positions, sphere.positions);
}

TEST(Move, LaterTargetsOverwriteEarlierOnesAndIdsPickVertices) {
  const Mesh sphere = Sphere({0, 0, 0}, 1, 4);
  Arena arena(ConfigFor(sphere), sphere);
  const uint32_t ids[3] = {3, 9, 3};
  auto move = Sized<tpa_move_input>();
  move.count = 3;
  move.position_type = TPA_FLOAT32;
  move.vertices = ids;
  std::vector<float> given;
  const auto at = [&](uint32_t v, double scale) {
    for (size_t i = 0; i < 3; ++i) given.push_back(static_cast<float>(scale * sphere.positions[3 * size_t{v} + i]));
  };
  at(3, 1.5), at(9, 1.01), at(3, 1.02);
  move.positions = given.data();
  ASSERT_EQ(tpa_move(*arena, &move, nullptr), TPA_OK);
  ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_OK);
  const Mesh moved = MeshOf(*arena);
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(moved.positions[3 * 9 + i], static_cast<double>(given[3 + i]));
    EXPECT_EQ(moved.positions[3 * 3 + i], static_cast<double>(given[6 + i]));
  }
  for (size_t v : {0u, 1u, 5u}) EXPECT_EQ(PositionOf(moved, v), PositionOf(sphere, v));
}

}  // namespace
}  // namespace load_test
