// SPDX-License-Identifier: MIT
// topoadapt.hpp, as C++17 and as C++20: the bits of the C interface, growth, values that follow, conserved amounts.
#include <cmath>
#include <complex>
#include <functional>
#include <numeric>
#include <string>
#include <topoadapt.hpp>

#include "oracle/commit_oracle.h"
#include "support/state_support.h"

namespace mesh_hpp_test {
namespace {

using topoadapt::Error;
using topoadapt::Span;

static_assert(!std::is_copy_constructible_v<topoadapt::Mesh> && !std::is_copy_assignable_v<topoadapt::Mesh>);
static_assert(std::is_nothrow_move_constructible_v<topoadapt::Mesh>);
static_assert(std::is_nothrow_move_assignable_v<topoadapt::Mesh>);

// Two balls side by side.
support::Mesh TwoBalls() {
  return support::Together({support::Sphere({-1.3, 0, 0}, 1, 4), support::Sphere({1.3, 0.1, 0}, 1, 4)});
}

// A tube with a thin middle.
support::Mesh Dumbbell() {
  std::vector<support::Point> points;
  std::vector<double> radii;
  // A neck so thin and short that a cap at either side is little of the body.
  for (int i = -10; i <= 10; ++i) {
    points.push_back({(std::abs(i) > 5 ? 0.25 : 0.05) * i, 0, 0});
    radii.push_back(std::abs(i) > 5 ? 0.7 : 0.05 + 0.01 * std::abs(i));
  }
  return support::Tube(points, radii, 12, {0, 0, 1});
}

// All vertices by `distance` towards the plane x = 0.
std::vector<double> TargetsTowards(Span<const double> positions, double distance) {
  std::vector<double> targets(positions.begin(), positions.end());
  for (size_t i = 0; i < targets.size(); i += 3) targets[i] += targets[i] < 0 ? distance : -distance;
  return targets;
}

// The balls touch in the second step and are one body after it.
topoadapt::Mesh MergedBalls() {
  const support::Mesh balls = TwoBalls();
  topoadapt::Mesh mesh(balls.positions, balls.triangles);
  mesh.move(TargetsTowards(mesh.positions(), 0.4));
  mesh.step();
  return mesh;
}

// The thinnest part of the tube turned inside out: two bodies are left.
topoadapt::Mesh PartedDumbbell(topoadapt::Mesh mesh) {
  std::vector<double> targets(mesh.positions().begin(), mesh.positions().end());
  for (size_t i = 0; i < targets.size(); i += 3)
    if (std::fabs(targets[i]) < 0.01) targets[i + 1] *= -0.5, targets[i + 2] *= -0.5;
  mesh.move(targets);
  mesh.step();
  return mesh;
}

tpa_status StatusOf(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), error.issue().status);
    EXPECT_NE(std::string(error.what()), "");
    return error.status();
  }
  return TPA_OK;
}

// ---------------------------------------------------------------- the bits of the C interface

TEST(Hpp, StepsAsTheCInterfaceDoes) {
  const support::Mesh balls = TwoBalls();
  const support::Arena arena(topoadapt::make_config(4096), balls);
  topoadapt::Mesh mesh(balls.positions, balls.triangles, topoadapt::make_config(4096));
  EXPECT_EQ(mesh.digest(), support::DigestOf(*arena));
  for (int i = 0; i < 3; ++i) {
    const std::vector<double> targets = TargetsTowards(mesh.positions(), 0.2);
    ASSERT_EQ(support::MoveAll(*arena, targets), TPA_OK);
    tpa_report expected = support::Sized<tpa_report>();
    ASSERT_EQ(tpa_step(*arena, nullptr, &expected, nullptr), TPA_OK);
    mesh.move(targets);
    const tpa_report report = mesh.step();
    EXPECT_EQ(std::memcmp(&report, &expected, sizeof report), 0);
    EXPECT_EQ(mesh.digest(), support::DigestOf(*arena)) << "step " << i;

    const std::vector<tpa_event> events = support::EventsOf(*arena);
    ASSERT_EQ(mesh.events().size(), events.size());
    uint32_t place = 0, merges = 0;
    for (const tpa_event& e : mesh.events()) {
      EXPECT_EQ(std::memcmp(&e, &events[place++], sizeof e), 0);
      merges += e.type == TPA_EVENT_MERGE;
    }
    EXPECT_EQ(mesh.count_events(TPA_EVENT_MERGE), merges);

    ASSERT_EQ(tpa_remesh(
                  *arena,
                  [] {
                    static tpa_remesh_options o = support::Sized<tpa_remesh_options>();
                    o.iterations = 1, o.target_length = 0.3, o.relaxation = 0.5;
                    return &o;
                  }(),
                  nullptr, nullptr, nullptr),
              TPA_OK);
    mesh.remesh(0.3);
    EXPECT_EQ(mesh.digest(), support::DigestOf(*arena)) << "remeshing " << i;
    ASSERT_EQ(tpa_reorder(*arena, nullptr), TPA_OK);
    mesh.reorder();
    EXPECT_EQ(mesh.digest(), support::DigestOf(*arena)) << "order " << i;
  }
  EXPECT_EQ(mesh.validate().components, 1u);
  EXPECT_EQ(mesh.validate().self_intersections, 0u);
  EXPECT_EQ(mesh.detect().size(), 0u);
  EXPECT_EQ(mesh.growths(), 0u);
}

TEST(Hpp, TakesContainersOfNumbersAndOfTriples) {
  const support::Mesh ball = support::Sphere({0, 0, 0}, 1, 2);
  const uint64_t expected = topoadapt::Mesh(ball.positions, ball.triangles).digest();
  std::vector<std::array<double, 3>> points(support::VertexCount(ball));
  std::vector<std::array<uint16_t, 4>> corners(support::TriangleCount(ball));  // a fourth number is passed over
  for (size_t i = 0; i < ball.positions.size(); ++i) points[i / 3][i % 3] = ball.positions[i];
  for (size_t i = 0; i < ball.triangles.size(); ++i) corners[i / 3][i % 3] = static_cast<uint16_t>(ball.triangles[i]);
  EXPECT_EQ(topoadapt::Mesh(points, corners).digest(), expected);
  EXPECT_EQ(topoadapt::Mesh({ball.positions.data(), points.size()}, {ball.triangles.data(), corners.size()}).digest(),
            expected);
  std::vector<float> halves(ball.positions.size());
  for (size_t i = 0; i < halves.size(); ++i) halves[i] = std::round(4 * static_cast<float>(ball.positions[i])) / 4;
  std::vector<double> same(halves.begin(), halves.end());
  topoadapt::Mesh mesh(ball.positions, ball.triangles), other = mesh.clone();
  mesh.move(halves);
  other.move(same);
  EXPECT_EQ(mesh.digest(), other.digest());
  const std::vector<uint32_t> some = {3, 1};
  mesh.move(std::vector<float>{0, 0, 0.5f, 0.5f, 0, 0}, some);
  uint32_t count = 0;
  ASSERT_EQ(tpa_targets(mesh.context(), nullptr, nullptr, 0, &count), TPA_OK);
  EXPECT_EQ(count, support::VertexCount(ball));
  EXPECT_THROW(mesh.move(std::vector<float>(5)), std::invalid_argument);
  EXPECT_THROW(mesh.move(std::vector<float>(3), some), std::invalid_argument);
}

TEST(Hpp, TellsWhatIsWrongAndChangesNothing) {
  const support::Mesh ball = support::Sphere({0, 0, 0}, 1, 2);
  topoadapt::Mesh mesh(ball.positions, ball.triangles);
  const uint64_t digest = mesh.digest();
  std::vector<uint32_t> open(ball.triangles.begin(), ball.triangles.end() - 3);
  try {
    mesh.load(ball.positions, open);
    FAIL() << "an open mesh is loaded";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), TPA_E_MESH);
    EXPECT_EQ(error.issue().defect, TPA_DEFECT_BOUNDARY_EDGE);
    EXPECT_NE(std::string(error.what()).find("has only one triangle"), std::string::npos) << error.what();
  }
  EXPECT_EQ(StatusOf([&] { mesh.advance(-1); }), TPA_E_ARGUMENT);
  EXPECT_EQ(mesh.digest(), digest);
  topoadapt::Mesh empty(topoadapt::make_config());
  EXPECT_EQ(empty.vertex_count(), 0u);
  EXPECT_TRUE(empty.positions().empty());
  EXPECT_EQ(empty.components().size(), 0u);
  EXPECT_EQ(StatusOf([&] { empty.step(); }), TPA_E_STATE);
}

TEST(Hpp, MovesClonesAndSaves) {
  topoadapt::Mesh mesh = MergedBalls();
  const uint64_t digest = mesh.digest();
  topoadapt::Mesh other = std::move(mesh);
  EXPECT_EQ(other.digest(), digest);
  EXPECT_EQ(StatusOf([&] { mesh.step(); }), TPA_E_CONTEXT);  // NOLINT: moved from
  mesh = other.clone();
  other.remesh(0.5);
  EXPECT_NE(other.digest(), digest);
  EXPECT_EQ(mesh.digest(), digest);
  const std::vector<uint8_t> saved = mesh.save();
  topoadapt::Mesh small(topoadapt::make_config(4));
  small.restore(saved);  // grows
  EXPECT_EQ(small.digest(), digest);
  EXPECT_GT(small.growths(), 0u);
  EXPECT_EQ(StatusOf([&] { small.restore(Span<const uint8_t>(saved.data(), saved.size() - 1)); }), TPA_E_DATA);
}

// ---------------------------------------------------------------- growth

TEST(Hpp, GrowsToTheBitsOfAmpleRoom) {
  const support::Mesh balls = TwoBalls();
  tpa_config least = topoadapt::make_config(support::VertexCount(balls));
  least.max_triangles = support::TriangleCount(balls);
  least.max_contacts = least.max_events = least.max_pieces = least.max_components = 1;
  least.max_cut_edges = 3;
  topoadapt::Mesh ample(balls.positions, balls.triangles), little(balls.positions, balls.triangles, least);
  for (topoadapt::Mesh* mesh : {&ample, &little})
    for (int i = 0; i < 3; ++i) {
      mesh->move(TargetsTowards(mesh->positions(), 0.2));
      mesh->step();
      mesh->remesh(0.2);
    }
  EXPECT_EQ(little.digest(), ample.digest());
  EXPECT_EQ(ample.growths(), 0u);
  EXPECT_GE(little.growths(), 4u);
  tpa_config now = topoadapt::make<tpa_config>();
  ASSERT_EQ(tpa_config_of(little.context(), &now), TPA_OK);
  EXPECT_EQ(std::memcmp(&now, &little.config(), sizeof now), 0);
}

TEST(Hpp, GrowsNoFurtherThanAllowed) {
  const support::Mesh balls = TwoBalls();
  tpa_config least = topoadapt::make_config(support::VertexCount(balls));
  topoadapt::Mesh mesh(balls.positions, balls.triangles, least);
  tpa_arena_size size;
  ASSERT_EQ(tpa_arena_query(&least, &size, nullptr), TPA_OK);
  mesh.set_most_bytes(size.bytes);
  const uint64_t digest = mesh.digest();
  EXPECT_EQ(StatusOf([&] { mesh.remesh(0.1); }), TPA_E_LIMIT);
  EXPECT_EQ(mesh.digest(), digest);
  mesh.set_most_bytes(0);
  EXPECT_GT(mesh.remesh(0.1).splits, 0u);
}

// ---------------------------------------------------------------- values

struct Colour {
  float red, green, blue;
};
struct Grain {  // neither sums nor products
  double age;
  uint32_t material;
  char name[3];
};

TEST(Hpp, ValuesOfVerticesFollow) {
  topoadapt::Mesh mesh = MergedBalls();
  mesh.remesh(0.25);
  const std::vector<tpa_vertex_origin> origins = support::VertexOriginsOf(mesh.context());
  const uint32_t old_count = mesh.vertex_map().old_count;
  support::Random random(1);
  std::vector<double> doubles(old_count);
  std::vector<Colour> colours(old_count);
  std::vector<std::complex<double>> waves(old_count);
  std::vector<Grain> grains(old_count);
  for (uint32_t v = 0; v < old_count; ++v) {
    doubles[v] = support::Uniform(random, -1, 1);
    colours[v] = {static_cast<float>(doubles[v]), 1, static_cast<float>(v)};
    waves[v] = {doubles[v], -doubles[v]};
    grains[v] = {doubles[v], v, "ab"};
  }
  const std::vector<double> old_doubles = doubles;
  const std::vector<Colour> old_colours = colours;
  mesh.carry(doubles);
  mesh.carry_numbers<float>(colours);
  mesh.carry(waves);
  double corrected = 0;
  mesh.carry(
      grains,
      [](const Grain& a, const Grain& b, double weight) {
        Grain mixed = weight >= 0.5 ? a : b;
        mixed.age = weight * a.age + (1 - weight) * b.age;
        return mixed;
      },
      [&](Span<const Grain> before, Span<Grain> after) {
        EXPECT_EQ(before.size(), old_count);
        for (const Grain& g : before) corrected += g.age;
        double sum = 0;
        for (const Grain& g : after) sum += g.age;
        for (Grain& g : after) g.age += (corrected - sum) / static_cast<double>(after.size());
      });
  ASSERT_EQ(doubles.size(), origins.size());
  ASSERT_EQ(grains.size(), origins.size());
  uint32_t blended = 0;
  double sum = 0;
  for (uint32_t v = 0; v < origins.size(); ++v) {
    const tpa_vertex_origin& o = origins[v];
    const bool single = o.parents[1] == TPA_NONE || o.parents[1] == o.parents[0];
    const uint32_t first = o.parents[0], second = single ? first : o.parents[1];
    const double weight = single ? 1 : static_cast<double>(o.weight);
    blended += weight > 0 && weight < 1;
    const double expected = weight * old_doubles[first] + (1 - weight) * old_doubles[second];
    EXPECT_NEAR(doubles[v], expected, 1e-15);
    EXPECT_NEAR(waves[v].imag(), -expected, 1e-15);
    const double red = weight * static_cast<double>(old_colours[first].red) +
                       (1 - weight) * static_cast<double>(old_colours[second].red);
    EXPECT_NEAR(static_cast<double>(colours[v].red), red, 1e-7);
    EXPECT_EQ(colours[v].green, 1.0f);
    EXPECT_EQ(grains[v].material, weight >= 0.5 ? first : second);
    EXPECT_STREQ(grains[v].name, "ab");
    sum += grains[v].age;
  }
  EXPECT_GT(blended, 10u);
  EXPECT_NEAR(sum, corrected, 1e-12);
  // The next commit has other numbers.
  EXPECT_THROW(mesh.carry(doubles), std::invalid_argument);
}

TEST(Hpp, ValuesOfTrianglesFollow) {
  topoadapt::Mesh mesh = MergedBalls();
  const std::vector<uint32_t> from = support::TriangleOriginsOf(mesh.context());
  std::vector<Grain> grains(mesh.triangle_map().old_count);
  for (uint32_t t = 0; t < grains.size(); ++t) grains[t] = {0.5 * t, t, "xy"};
  mesh.carry_triangles(grains);
  std::vector<bool> has_origin;
  for (const uint32_t origin : from) has_origin.push_back(origin != TPA_NONE);
  const support::Mesh now = support::MeshOf(mesh.context());
  const std::vector<uint32_t> source = support::RowSources(has_origin, support::NeighboursOfTriangles(now));
  ASSERT_EQ(grains.size(), source.size());
  for (uint32_t t = 0; t < grains.size(); ++t) {
    ASSERT_NE(source[t], TPA_NONE);
    EXPECT_EQ(grains[t].material, from[source[t]]) << t;
    EXPECT_EQ(grains[t].age, 0.5 * from[source[t]]) << t;
  }
}

// ---------------------------------------------------------------- components

double Proportion(double owned, double part, double whole) { return whole == 0 ? 0 : owned * (part / whole); }

std::vector<double> VolumesOf(const topoadapt::Mesh& mesh) {
  std::vector<double> volumes;
  for (const tpa_component& c : mesh.components()) volumes.push_back(c.volume);
  return volumes;
}

TEST(Hpp, AccountsOfMergedBodiesAddUp) {
  const support::Mesh balls = support::Together({TwoBalls(), support::Sphere({0, 5, 0}, 1, 3)});
  topoadapt::Mesh mesh(balls.positions, balls.triangles);
  topoadapt::Accounts<double> charge(mesh, {1, 10, 100});
  EXPECT_EQ(charge.components().of_vertex(0).id, 0u);
  mesh.move(TargetsTowards(mesh.positions(), 0.4));
  mesh.step();
  ASSERT_EQ(mesh.count_events(TPA_EVENT_MERGE), 1u);
  charge.follow(mesh, VolumesOf(mesh), Proportion);
  EXPECT_EQ(charge.amounts(), (std::vector<double>{11, 100}));
  EXPECT_EQ(charge.lost(), 0);
  EXPECT_THROW(charge.follow(mesh, {1.0}, Proportion), std::invalid_argument);
}

TEST(Hpp, AccountsOfPiecesAreShared) {
  const support::Mesh body = Dumbbell();
  topoadapt::Mesh mesh(body.positions, body.triangles);
  topoadapt::Accounts<double> charge(mesh, {8});
  mesh = PartedDumbbell(std::move(mesh));
  ASSERT_EQ(mesh.components().size(), 2u);
  ASSERT_EQ(mesh.count_events(TPA_EVENT_SPLIT), 2u);
  const std::vector<double> volumes = VolumesOf(mesh);
  charge.follow(mesh, volumes, Proportion);
  ASSERT_EQ(charge.amounts().size(), 2u);
  for (size_t i = 0; i < 2; ++i) EXPECT_NEAR(charge.amounts()[i], 8 * volumes[i] / (volumes[0] + volumes[1]), 1e-12);
  EXPECT_NEAR(charge.total(), 8, 1e-12);
}

}  // namespace
}  // namespace mesh_hpp_test
