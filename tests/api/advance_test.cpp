// SPDX-License-Identifier: MIT
// tpa_advance: bodies that pass through each other in one step meet in sub-steps; all sub-steps are one commit.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>

#include "oracle/commit_oracle.h"
#include "support/schedules.h"
#include "support/share.h"
#include "support/state_support.h"
#include "support/tangle_shapes.h"

namespace advance_test {
namespace {

using namespace support;

// ---------------------------------------------------------------- families of motions

using Motion = std::function<Point(size_t vertex, const Point& p)>;

// A motion that ends free of contacts, in which thin parts pass through others on the way.
struct Family {
  std::string name;
  Mesh mesh;
  double thickness;  // no part is thinner
  Motion motion;
  std::vector<double> Targets() const {
    std::vector<double> targets;
    for (size_t v = 0; v < VertexCount(mesh); ++v)
      for (double x : motion(v, PositionOf(mesh, v))) targets.push_back(x);
    return targets;
  }
};

Point Plus(const Point& p, const Point& q) { return {p[0] + q[0], p[1] + q[1], p[2] + q[2]}; }

// The first `first` vertices go one way, the others another.
Motion Apart(uint32_t first, Point way, Point others) {
  return [=](size_t v, const Point& p) { return Plus(p, v < first ? way : others); };
}

Family Balls(Random& random) {
  const Point off = {0, Uniform(random, -0.2, 0.2), Uniform(random, -0.2, 0.2)};
  const Mesh left = Sphere({-0.55, 0, 0}, 0.5, 5), right = Translated(Sphere({0.55, 0, 0}, 0.5, 4), off);
  return {"balls", Together({left, right}), 0.5, Apart(VertexCount(left), {1.1, 0, 0}, {-1.1, 0, 0})};
}

// A sheet flies through a ball.
Family Sheet(Random& random) {
  const Mesh ball = Sphere({0, 0, 0}, 0.4, 4);
  const double lean = Uniform(random, -0.1, 0.1);
  const Mesh sheet = Mapped(Slab(1.6, 1.6, 0.2, Uniform(random, 0.2, 0.3)), [=](const Point& p) {
    return Point{p[0], p[1], p[2] + lean * p[0] + 0.03 * p[1] + 0.64};
  });
  return {"sheet", Together({ball, sheet}), 0.2, Apart(VertexCount(ball), {}, {0, 0, -1.28})};
}

// Two plates change places.
Family Plates(Random& random) {
  const double edge = Uniform(random, 0.3, 0.45);
  const Mesh low = Slab(2, 2, 0.25, edge);
  const Mesh high = Translated(Slab(2, 2, 0.25, edge), {0.31, 0.22, 0.6});
  return {"plates", Together({low, high}), 0.25, Apart(VertexCount(low), {0, 0, 0.7}, {0, 0, -0.7})};
}

// A ball goes through the wall of a hollow ball, from inside to outside.
Family Wall(Random& random) {
  const Mesh ball = Sphere({0, 0, 0}, 0.2, 3);
  Mesh outer = Sphere({0, 0, 0}, 0.6, 6), inner = Sphere({0, 0, 0}, 0.4, 5);
  for (size_t i = 0; i < inner.triangles.size(); i += 3) std::swap(inner.triangles[i], inner.triangles[i + 1]);
  const double turn = Uniform(random, 0, 3);
  return {"wall", Together({ball, outer, inner}), 0.18,
          Apart(VertexCount(ball), {0.9 * std::cos(turn), 0.9 * std::sin(turn), 0.1}, {})};
}

std::vector<Family> Families(uint64_t seed) {
  Random random(seed);
  return {Balls(random), Sheet(random), Plates(random), Wall(random)};
}

// ---------------------------------------------------------------- calls

tpa_config Ample(const Mesh& m, uint32_t substeps) {
  tpa_config config = DefaultConfig(4 * VertexCount(m) + 2048);
  config.max_contacts = config.max_cut_edges = 1 << 14;
  config.max_pieces = 1 << 16;
  config.max_substeps = substeps;
  return config;
}

struct Advanced {
  tpa_status status = TPA_OK;
  tpa_report report = Sized<tpa_report>();
  tpa_issue issue{};
};

Advanced Advance(tpa_context* context, double thickness, const tpa_exec* exec = nullptr) {
  Advanced out;
  out.status = tpa_advance(context, thickness, exec, &out.report, &out.issue);
  return out;
}

// The same by public calls: steps of equal parts of the ways left, which follow their vertices through the maps.
// Returns the mesh, and the composed map.
struct Played {
  Mesh mesh;
  std::vector<uint32_t> old_to_new;
};
Played ByHand(const Family& family, uint32_t steps) {
  const Arena arena(Ample(family.mesh, 0), family.mesh);
  std::vector<double> goals = family.Targets();
  Played out{family.mesh, {}};
  for (uint32_t v = 0; v < VertexCount(family.mesh); ++v) out.old_to_new.push_back(v);
  for (uint32_t left = steps; left > 0; --left) {
    std::vector<double> targets = goals;
    if (left > 1)
      for (size_t i = 0; i < goals.size(); ++i) {
        const double p = out.mesh.positions[i];
        targets[i] = p + (1.0 / left) * (goals[i] - p);
      }
    EXPECT_EQ(MoveAll(*arena, targets), TPA_OK);
    EXPECT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_OK);
    out.mesh = MeshOf(*arena);
    std::vector<double> carried;
    for (const tpa_vertex_origin& o : VertexOriginsOf(*arena)) {
      const size_t v = carried.size() / 3, a = 3 * size_t{o.parents[0]}, b = 3 * size_t{o.parents[1]};
      const double* p = &out.mesh.positions[3 * v];
      const double weight = static_cast<double>(o.weight);
      const bool is_old = o.parents[1] == TPA_NONE;
      const bool arrived = is_old && std::equal(p, p + 3, &targets[a]);
      for (size_t i = 0; i < 3; ++i) {
        const double rest = goals[a + i] - targets[a + i];
        const double ways = is_old ? rest : weight * rest + (1 - weight) * (goals[b + i] - targets[b + i]);
        carried.push_back(arrived ? goals[a + i] : p[i] + ways);
      }
    }
    goals = carried;
    const std::vector<uint32_t> map = OldToNewOf(*arena);
    for (uint32_t& v : out.old_to_new) v = v == TPA_NONE ? v : map[v];
  }
  return out;
}

std::vector<int64_t> GeneraOf(const Mesh& m) {
  std::vector<int64_t> genera;
  for (const auto& c : TopologyOf(m).components) genera.push_back(c.genus);
  std::sort(genera.begin(), genera.end());
  return genera;
}

// ---------------------------------------------------------------- what passes through

TEST(Advance, SeesWhatPassesThroughInOneStep) {
  for (uint64_t seed = 1; seed <= Share(3u); ++seed)
    for (const Family& family : Families(seed)) {
      SCOPED_TRACE(family.name + ", seed " + std::to_string(seed));
      const Arena single(Ample(family.mesh, 0), family.mesh), arena(Ample(family.mesh, 1000), family.mesh);
      ASSERT_EQ(MoveAll(*single, family.Targets()), TPA_OK);
      auto report = Sized<tpa_report>();
      ASSERT_EQ(tpa_step(*single, nullptr, &report, nullptr), TPA_OK);
      EXPECT_EQ(report.contacts, 0u) << "a single step sees it";
      ASSERT_EQ(MoveAll(*arena, family.Targets()), TPA_OK);
      const Advanced a = Advance(*arena, family.thickness);
      ASSERT_EQ(a.status, TPA_OK) << Text(a.issue);
      EXPECT_GT(a.report.contacts, 0u);
      EXPECT_EQ(a.report.substeps, std::floor(report.approach / family.thickness) + 1);
      if (a.report.rolled_back_vertices == 0) {
        EXPECT_LT(a.report.approach, family.thickness);
      }
      const Mesh after = MeshOf(*arena);
      EXPECT_TRUE(IsSound(after, "advance"));
      const Played by_hand = ByHand(family, a.report.substeps);
      EXPECT_EQ(after.positions, by_hand.mesh.positions);
      EXPECT_EQ(after.triangles, by_hand.mesh.triangles);
      EXPECT_EQ(OldToNewOf(*arena), by_hand.old_to_new);
      EXPECT_FALSE(EventsOf(*arena).empty());
    }
}

// ---------------------------------------------------------------- one commit

// Maps, events and changes between the meshes before and after, by the oracle.
void ExpectOneCommit(const Mesh& before, const tpa_context* context) {
  const Mesh after = MeshOf(context);
  const std::vector<tpa_vertex_origin> origins = VertexOriginsOf(context);
  const std::vector<uint32_t> old_to_new = OldToNewOf(context);
  ASSERT_EQ(old_to_new.size(), VertexCount(before));
  ASSERT_EQ(origins.size(), VertexCount(after));
  size_t kept = 0;
  for (uint32_t v = 0; v < origins.size(); ++v) {
    ASSERT_LT(origins[v].parents[0], VertexCount(before));
    if (origins[v].parents[1] != TPA_NONE) {
      ASSERT_LT(origins[v].parents[1], VertexCount(before));
      continue;
    }
    ++kept;
    EXPECT_EQ(old_to_new[origins[v].parents[0]], v);
  }
  EXPECT_EQ(static_cast<size_t>(std::count(old_to_new.begin(), old_to_new.end(), TPA_NONE)),
            VertexCount(before) - kept);
  for (uint32_t f : TriangleOriginsOf(context)) EXPECT_TRUE(f == TPA_NONE || f < TriangleCount(before));
  const std::vector<tpa_event> events = EventsOf(context);
  EXPECT_EQ(ComponentEventsAmong(events.data(), static_cast<uint32_t>(events.size())),
            ExpectedComponentEvents(before, after, origins.data()));
  auto changes = Sized<tpa_change_list>();
  ASSERT_EQ(tpa_changes(context, &changes, nullptr), TPA_OK);
  EXPECT_EQ(changes.changed_vertices, Differing(before.positions, after.positions).size());
  EXPECT_EQ(changes.changed_triangles, Differing(before.triangles, after.triangles).size());
  EXPECT_EQ(changes.old_vertex_count, VertexCount(before));
  EXPECT_EQ(changes.old_triangle_count, TriangleCount(before));
}

TEST(Advance, IsOneCommit) {
  for (uint64_t seed = 1; seed <= Share(3u); ++seed)
    for (const Family& family : Families(seed)) {
      SCOPED_TRACE(family.name + ", seed " + std::to_string(seed));
      const Arena arena(Ample(family.mesh, 1000), family.mesh);
      ASSERT_EQ(MoveAll(*arena, family.Targets()), TPA_OK);
      ASSERT_EQ(Advance(*arena, family.thickness).status, TPA_OK);
      ExpectOneCommit(family.mesh, *arena);
      uint32_t targets = 1;
      ASSERT_EQ(tpa_targets(*arena, nullptr, nullptr, 0, &targets), TPA_OK);
      EXPECT_EQ(targets, 0u);
      // The state is sound, and another call goes on from it.
      const Bytes saved = SavedFrom(*arena);
      const Arena again(Ample(family.mesh, 0));
      tpa_issue issue;
      EXPECT_EQ(tpa_restore(*again, saved.data(), saved.size(), &issue), TPA_OK) << Text(issue);
      const Mesh before = MeshOf(*arena);
      if (before.triangles.empty()) continue;
      std::vector<double> back = before.positions;
      for (size_t i = 0; i < back.size(); ++i) back[i] *= 1 - 0.2 * static_cast<double>(i % 3);
      for (const Arena* each : {&arena, &again}) {
        ASSERT_EQ(MoveAll(**each, back), TPA_OK);
        ASSERT_EQ(tpa_step(**each, nullptr, nullptr, nullptr), TPA_OK);
      }
      EXPECT_EQ(SavedFrom(*arena), SavedFrom(*again));
    }
}

TEST(Advance, InOneSubstepIsAStep) {
  for (uint64_t seed = 1; seed <= Share(4u); ++seed) {
    Random random(seed);
    const Mesh m = Together({Sphere({-1.02, 0, 0}, 1, 6), Sphere({1.02, 0, 0}, 1, 5)});
    const Arena stepped(Ample(m, 0), m), advanced(Ample(m, 100), m), bare(Ample(m, 0), m);
    for (int step = 0; step < 3; ++step) {
      std::vector<double> targets = MeshOf(*stepped).positions;
      for (size_t i = 0; i < targets.size(); i += 3) targets[i] -= (targets[i] > 0 ? 0.05 : -0.05);
      for (double& x : targets) x += Uniform(random, -0.01, 0.01);
      auto report = Sized<tpa_report>();
      ASSERT_EQ(MoveAll(*stepped, targets), TPA_OK);
      ASSERT_EQ(tpa_step(*stepped, nullptr, &report, nullptr), TPA_OK);
      EXPECT_EQ(report.substeps, 0u);
      for (const Arena* each : {&advanced, &bare}) {
        ASSERT_EQ(MoveAll(**each, targets), TPA_OK);
        Advanced a = Advance(**each, std::nextafter(report.approach, HUGE_VAL));
        ASSERT_EQ(a.status, TPA_OK) << Text(a.issue);
        EXPECT_EQ(a.report.substeps, 1u);
        a.report.substeps = 0;
        EXPECT_EQ(std::memcmp(&a.report, &report, sizeof report), 0);
        EXPECT_TRUE(Observe(**each) == Observe(*stepped));
      }
    }
  }
}

// ---------------------------------------------------------------- vertices on their ways

TEST(Advance, VerticesThatMeetNothingArriveToTheBit) {
  const Mesh m = Sphere({0.1, 0.2, 0.3}, 1, 5);
  const Arena arena(Ample(m, 1000), m);
  Random random(3);
  std::vector<uint32_t> ids;
  std::vector<double> targets, expected = m.positions;
  for (uint32_t v = 0; v < VertexCount(m); v += 2) {
    ids.push_back(v);
    for (size_t i = 0; i < 3; ++i) {
      expected[3 * v + i] *= 1 + Uniform(random, 0.01, 0.3);
      targets.push_back(expected[3 * v + i]);
    }
  }
  ASSERT_EQ(MoveSome(*arena, ids, targets), TPA_OK);
  const Advanced a = Advance(*arena, 0.01);
  ASSERT_EQ(a.status, TPA_OK) << Text(a.issue);
  EXPECT_GT(a.report.substeps, 10u);
  EXPECT_EQ(a.report.contacts, 0u);
  EXPECT_EQ(MeshOf(*arena).positions, expected);
}

// A vertex that a sub-step left behind is listed, and is short of its target by the way it missed.
TEST(Advance, ListsVerticesLeftBehind) {
  uint32_t listed = 0;
  for (uint64_t seed = 1; seed <= 14; ++seed) {
    Random random(seed);
    const Mesh m = Sphere({}, 1, 4);
    const double noise = 0.3 + 0.05 * static_cast<double>(seed);
    tpa_config config = Ample(m, 1000);
    config.max_passes = 1;
    const Arena arena(config, m);
    std::vector<double> targets = m.positions;
    for (double& x : targets) x += Uniform(random, -noise, noise);
    ASSERT_EQ(MoveAll(*arena, targets), TPA_OK);
    const Advanced a = Advance(*arena, 0.2);
    ASSERT_EQ(a.status, TPA_OK) << Text(a.issue);
    ExpectOneCommit(m, *arena);
    const uint32_t* list = nullptr;
    uint32_t count = 0;
    ASSERT_EQ(tpa_rolled_back(*arena, &list, &count), TPA_OK);
    EXPECT_EQ(count, a.report.rolled_back_vertices);
    listed += count;
    const Mesh after = MeshOf(*arena);
    const std::vector<tpa_vertex_origin> origins = VertexOriginsOf(*arena);
    for (uint32_t i = 0; i < count; ++i) {
      const tpa_vertex_origin& o = origins[list[i]];
      if (o.parents[1] != TPA_NONE) continue;
      const double* to = &targets[3 * o.parents[0]];
      EXPECT_NE(PositionOf(after, list[i]), (Point{to[0], to[1], to[2]})) << "arrived";
    }
  }
  EXPECT_GT(listed, 0u);
}

// ---------------------------------------------------------------- failures

void ExpectFailure(const Family& family, uint32_t tpa_config::*field, uint32_t value, int32_t limit) {
  tpa_config config = Ample(family.mesh, 1000);
  config.*field = value;
  const Arena arena(config, family.mesh);
  ASSERT_EQ(MoveAll(*arena, family.Targets()), TPA_OK);
  const Observed before = Observe(*arena);
  auto changes = Sized<tpa_change_list>(), after = changes;
  ASSERT_EQ(tpa_changes(*arena, &changes, nullptr), TPA_OK);
  const Advanced a = Advance(*arena, family.thickness);
  EXPECT_EQ(a.status, TPA_E_LIMIT);
  EXPECT_EQ(a.issue.limit, limit) << Text(a.issue);
  EXPECT_EQ(a.issue.available, value);
  EXPECT_GT(a.issue.needed, value);
  EXPECT_TRUE(Observe(*arena) == before);
  ASSERT_EQ(tpa_changes(*arena, &after, nullptr), TPA_OK);
  EXPECT_EQ(std::memcmp(&changes, &after, sizeof changes), 0);
  // It goes on as if nothing had happened.
  const Arena larger(Ample(family.mesh, 1000)), fresh(Ample(family.mesh, 1000), family.mesh);
  tpa_context* grown = nullptr;
  const tpa_config ample = Ample(family.mesh, 1000);
  ASSERT_EQ(tpa_grow(*arena, larger.block(), larger.size().bytes, &ample, &grown, nullptr), TPA_OK);
  ASSERT_EQ(MoveAll(*fresh, family.Targets()), TPA_OK);
  const Advanced now = Advance(grown, family.thickness), expected = Advance(*fresh, family.thickness);
  ASSERT_EQ(now.status, TPA_OK) << Text(now.issue);
  EXPECT_EQ(std::memcmp(&now.report, &expected.report, sizeof now.report), 0);
  EXPECT_EQ(SavedFrom(grown), SavedFrom(*fresh));
}

TEST(Advance, FailuresLeaveAllAsBefore) {
  for (const Family& family : Families(2)) {
    SCOPED_TRACE(family.name);
    ExpectFailure(family, &tpa_config::max_substeps, 3, TPA_LIMIT_SUBSTEPS);
    ExpectFailure(family, &tpa_config::max_contacts, 1, TPA_LIMIT_CONTACTS);
    ExpectFailure(family, &tpa_config::max_events, 1, TPA_LIMIT_EVENTS);
    ExpectFailure(family, &tpa_config::max_cut_edges, 3, TPA_LIMIT_CUT);
    if (family.name == "wall") continue;  // needs no more vertices
    ExpectFailure(family, &tpa_config::max_vertices, VertexCount(family.mesh), TPA_LIMIT_VERTICES);
  }
}

// From the least limits on, whoever follows `needed` arrives, with the bits of ample limits.
TEST(Advance, GrowsFromTheLeastLimits) {
  const std::vector<Family> families = Families(4);
  for (size_t i = 0; i < families.size(); i += Stride(2)) {
    const Family& family = families[i];
    SCOPED_TRACE(family.name);
    const Arena ample(Ample(family.mesh, 1000), family.mesh);
    ASSERT_EQ(MoveAll(*ample, family.Targets()), TPA_OK);
    ASSERT_EQ(Advance(*ample, family.thickness).status, TPA_OK);
    tpa_config config = Ample(family.mesh, 0);
    config.max_vertices = VertexCount(family.mesh);
    config.max_triangles = TriangleCount(family.mesh);
    config.max_contacts = config.max_events = config.max_pieces = 1;
    config.max_cut_edges = 3;
    config.max_components = static_cast<uint32_t>(GeneraOf(family.mesh).size());
    uint32_t tpa_config::*const fields[] = {
        &tpa_config::max_vertices, &tpa_config::max_triangles,  &tpa_config::max_contacts, &tpa_config::max_cut_edges,
        &tpa_config::max_events,   &tpa_config::max_components, &tpa_config::max_pieces,   &tpa_config::max_substeps};
    std::unique_ptr<Arena> arena = std::make_unique<Arena>(config, family.mesh);
    ASSERT_EQ(MoveAll(**arena, family.Targets()), TPA_OK);
    int tries = 0;
    for (;; ++tries) {
      ASSERT_LT(tries, 100);
      const Advanced a = Advance(**arena, family.thickness);
      if (a.status == TPA_OK) break;
      ASSERT_EQ(a.status, TPA_E_LIMIT) << Text(a.issue);
      uint32_t& limit = config.*fields[a.issue.limit - 1];
      ASSERT_LT(limit, a.issue.needed) << Text(a.issue);
      limit = static_cast<uint32_t>(a.issue.needed);
      auto larger = std::make_unique<Arena>(config);
      tpa_context* grown = nullptr;
      ASSERT_EQ(tpa_grow(**arena, larger->block(), larger->size().bytes, &config, &grown, nullptr), TPA_OK);
      arena = std::move(larger);
    }
    EXPECT_GT(tries, 3);
    EXPECT_EQ(SavedFrom(**arena), SavedFrom(*ample));
  }
}

TEST(Advance, RefusesWhatIsNoThickness) {
  const Mesh m = Sphere({}, 1, 3);
  const Arena arena(Ample(m, 10), m);
  const Observed before = Observe(*arena);
  for (double thickness : {0.0, -1.0, std::nan(""), HUGE_VAL, 0x1p-101}) {
    const Advanced a = Advance(*arena, thickness);
    EXPECT_EQ(a.status, TPA_E_ARGUMENT);
    EXPECT_EQ(a.issue.argument, 2);
    EXPECT_EQ(Text(a.issue), "invalid argument: thickness must be 2^-100 .. 2^100");
  }
  EXPECT_TRUE(Observe(*arena) == before);
  const Arena empty(Ample(m, 10));
  EXPECT_EQ(Advance(*empty, 1).status, TPA_E_STATE);
  tpa_config config = Ample(m, (1u << 20) + 1);
  tpa_arena_size size;
  tpa_issue issue;
  EXPECT_EQ(tpa_arena_query(&config, &size, &issue), TPA_E_CONFIG);
  EXPECT_EQ(Text(issue), "invalid configuration: config.max_substeps must be 0 .. 2^20");
}

// Far from the origin sub-steps end where doubles are, not after equal parts of the ways.
TEST(Advance, BoundsTheApproachOfRoundedSubsteps) {
  const Mesh left = Translated(Sphere({-0.02, 0, 0}, 0.01, 3), {0x1p30, 0x1p30, 0x1p30});
  const Mesh m = Together({left, Translated(Sphere({0.02, 0, 0}, 0.01, 3), {0x1p30, 0x1p30, 0x1p30})});
  const Arena arena(Ample(m, 1000), m);
  std::vector<double> goals = m.positions;
  for (size_t i = 0; i < goals.size(); i += 3) goals[i] += i < left.positions.size() ? 1e-3 : -1e-3;
  ASSERT_EQ(MoveAll(*arena, goals), TPA_OK);
  const double thickness = 1e-4;
  const Advanced a = Advance(*arena, thickness);
  ASSERT_EQ(a.status, TPA_OK) << Text(a.issue);
  EXPECT_EQ(a.report.contacts, 0u);
  double most = 0;  // along x, in differences without rounding
  std::vector<double> at = m.positions;
  for (uint32_t part = a.report.substeps; part > 0; --part) {
    double forth = 0, back = 0;
    for (size_t i = 0; i < at.size(); i += 3) {
      const double to = part == 1 ? goals[i] : at[i] + (1.0 / part) * (goals[i] - at[i]);
      forth = std::max(forth, to - at[i]);
      back = std::max(back, at[i] - to);
      at[i] = to;
    }
    most = std::max(most, forth + back);
  }
  EXPECT_EQ(MeshOf(*arena).positions, goals);
  EXPECT_GT(most, 2e-3 / a.report.substeps);
  EXPECT_GE(a.report.approach, most);
  EXPECT_LT(a.report.approach, thickness);
  // Doubles lie too far apart here.
  ASSERT_EQ(MoveAll(*arena, m.positions), TPA_OK);
  EXPECT_EQ(Advance(*arena, 1e-6).issue.needed, uint64_t{1} << 52);
}

TEST(Advance, TheNumberOfSubstepsIsBounded) {
  const Mesh m = Sphere({}, 1, 3);
  const Arena arena(Ample(m, 100), m);
  std::vector<double> targets = m.positions;
  for (size_t i = 0; i < targets.size(); i += 3) targets[i] *= 2;
  ASSERT_EQ(MoveAll(*arena, targets), TPA_OK);
  Advanced a = Advance(*arena, 0.01);
  EXPECT_EQ(a.status, TPA_E_LIMIT);
  EXPECT_EQ(a.issue.limit, TPA_LIMIT_SUBSTEPS);
  EXPECT_NEAR(static_cast<double>(a.issue.needed), 201, 1);
  EXPECT_EQ(a.issue.available, 100u);
  a = Advance(*arena, 0x1p-90);
  EXPECT_EQ(a.issue.needed, uint64_t{1} << 52);
}

// ---------------------------------------------------------------- the same bits

TEST(Advance, DoesNotDependOnThreadsPlaceOrHistory) {
  for (const Family& family : Families(3)) {
    SCOPED_TRACE(family.name);
    const Arena plain(Ample(family.mesh, 1000), family.mesh);
    ASSERT_EQ(MoveAll(*plain, family.Targets()), TPA_OK);
    const Bytes targets_set = SavedFrom(*plain);
    const Advanced expected = Advance(*plain, family.thickness);
    ASSERT_EQ(expected.status, TPA_OK);
    const Bytes state = SavedFrom(*plain);
    for (const auto schedule : {Backwards, OnTwoThreads}) {
      tpa_config config = Ample(family.mesh, 12345);
      config.max_vertices *= 2;
      const Arena other(config);
      ASSERT_EQ(tpa_restore(*other, targets_set.data(), targets_set.size(), nullptr), TPA_OK);
      auto exec = Sized<tpa_exec>();
      exec.parallel_for = schedule;
      const Advanced a = Advance(*other, family.thickness, &exec);
      ASSERT_EQ(a.status, TPA_OK) << Text(a.issue);
      EXPECT_EQ(std::memcmp(&a.report, &expected.report, sizeof a.report), 0);
      EXPECT_EQ(SavedFrom(*other), state);
    }
  }
}

TEST(Advance, ABudgetOrACancellationLeavesAllAsBefore) {
  const Family family = Families(1)[0];
  const Arena arena(Ample(family.mesh, 1000), family.mesh);
  ASSERT_EQ(MoveAll(*arena, family.Targets()), TPA_OK);
  const Observed before = Observe(*arena);
  auto exec = Sized<tpa_exec>();
  uint64_t spent = 0;
  exec.progress = &spent;
  for (uint64_t budget = 1; budget < 1u << 22; budget *= 4) {
    exec.budget = budget;
    const Advanced a = Advance(*arena, family.thickness, &exec);
    if (a.status == TPA_OK) break;
    ASSERT_EQ(a.status, TPA_E_BUDGET) << Text(a.issue);
    ASSERT_TRUE(Observe(*arena) == before) << budget;
  }
  EXPECT_GT(spent, 1000u);
}

// Only the end of all sub-steps knows how much is enough.
TEST(Advance, ABudgetThatIsNamedSuffices) {
  const double thickness = 0.2;
  const Mesh m = Together({Sphere({-2, 0, 0}, 0.5, 3), Sphere({2, 0, 0}, 0.5, 3)});
  const Arena arena(Ample(m, 1000), m);
  std::vector<double> targets = m.positions;
  for (size_t i = 0; i < targets.size(); i += 3) targets[i] *= 0.6;
  ASSERT_EQ(MoveAll(*arena, targets), TPA_OK);
  const Bytes start = SavedFrom(*arena);
  auto exec = Sized<tpa_exec>();
  uint64_t whole = 0;
  exec.progress = &whole;
  ASSERT_EQ(Advance(*arena, thickness, &exec).status, TPA_OK);
  exec.progress = nullptr;
  const auto advance_within = [&](uint64_t budget) {
    EXPECT_EQ(tpa_restore(*arena, start.data(), start.size(), nullptr), TPA_OK);
    exec.budget = budget;
    return Advance(*arena, thickness, &exec);
  };
  EXPECT_EQ(advance_within(whole).status, TPA_OK);
  EXPECT_EQ(advance_within(whole - 1).issue.needed, whole + whole / 8 + 64);
  Random random(7);
  for (int i = 0; i < 200; ++i) {
    const uint64_t budget = 1 + random() % (whole - 1);
    const Advanced a = advance_within(budget);
    ASSERT_EQ(a.status, TPA_E_BUDGET) << budget;
    if (a.issue.needed != 0) {
      ASSERT_EQ(advance_within(a.issue.needed).status, TPA_OK) << budget;
    }
  }
}

}  // namespace
}  // namespace advance_test
