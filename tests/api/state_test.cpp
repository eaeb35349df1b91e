// SPDX-License-Identifier: MIT
// tpa_save, tpa_restore, tpa_digest: runs that are restored go on with the same bits; the stream holds what the
// interface tells; config and targets are read back.
#include <cstring>
#include <memory>

#include "support/evolution.h"

namespace state_test {
namespace {

using namespace support;

// ---------------------------------------------------------------- runs

std::unique_ptr<Arena> RestoredInto(const tpa_config& config, const Bytes& bytes) {
  auto arena = std::make_unique<Arena>(config);
  tpa_issue issue;
  EXPECT_EQ(tpa_restore(**arena, bytes.data(), bytes.size(), &issue), TPA_OK) << Text(issue);
  return arena;
}

TEST(State, RewindsAndRunsAgain) {
  for (const Evolution& e : Evolutions(3)) {
    SCOPED_TRACE(e.name);
    const Arena arena(e.config, e.mesh);
    const Bytes start = SavedFrom(*arena);
    std::vector<Called> first;
    for (int round = 0; round < 2; ++round) {
      for (int number = 0; number < e.calls; ++number) {
        Prepare(*arena, e, number, 3);
        const Called called = Call(*arena, number);
        if (round == 0)
          first.push_back(called);
        else
          ExpectSame(first[static_cast<size_t>(number)], called, "call " + std::to_string(number));
      }
      ASSERT_EQ(tpa_restore(*arena, start.data(), start.size(), nullptr), TPA_OK);
      EXPECT_EQ(SavedFrom(*arena), start);
    }
  }
}

// Before each call the state moves to a context with other limits, with targets set.
TEST(State, GoesOnInOtherContexts) {
  size_t events = 0, rolled_back = 0;
  for (const Evolution& e : Evolutions(4)) {
    SCOPED_TRACE(e.name);
    const Arena arena(e.config, e.mesh);
    tpa_config larger = e.config;
    auto other = std::make_unique<Arena>(larger, e.mesh);
    for (int number = 0; number < e.calls; ++number) {
      Prepare(*arena, e, number, 4);
      Prepare(**other, e, number, 4);
      const Bytes bytes = SavedFrom(**other);
      EXPECT_EQ(bytes, SavedFrom(*arena));
      larger.max_vertices += 100;
      larger.max_contacts += 1000;
      larger.max_events += 70;  // from 0, the default
      other = RestoredInto(larger, bytes);
      EXPECT_TRUE(Observe(**other) == Observe(*arena));
      EXPECT_EQ(TargetsOf(**other), TargetsOf(*arena));
      EXPECT_EQ(SavedFrom(**other), bytes);
      const Called expected = Call(*arena, number);
      ExpectSame(expected, Call(**other, number), "call " + std::to_string(number));
      events += EventsOf(*arena).size();
      rolled_back += expected.report.rolled_back_vertices;
    }
  }
  EXPECT_GT(events, 20u);
  EXPECT_GT(rolled_back, 0u);
}

// ---------------------------------------------------------------- the stream

// A context after a step with events and vertices left behind, and with targets.
struct Busy {
  Evolution evolution = Find();
  Arena arena{evolution.config, evolution.mesh};
  Busy() {
    Prepare(*arena, evolution, 0, 1);
    EXPECT_EQ(Call(*arena, 0).status, TPA_OK);
    EXPECT_EQ(MoveSome(*arena, {7, 3, 11, 3}, {1, 2, 3, 9, 9, 9, 4, 5, 6, -7, -8, -9}), TPA_OK);
  }
  static Evolution Find() {
    for (const Evolution& e : Evolutions(1))
      if (e.name == "coinciding") return e;
    return {};
  }
};

// Reads a stream from its start.
struct Reader {
  const Bytes& bytes;
  size_t at = 0;
  uint64_t Wide() { return at += 8, NumberAt(bytes, at - 8, 8); }
  uint32_t Word() { return at += 4, static_cast<uint32_t>(NumberAt(bytes, at - 4, 4)); }
  double Real() {
    const uint64_t wide = Wide();
    double x;
    std::memcpy(&x, &wide, sizeof x);
    return x;
  }
  float Single() {
    const uint32_t word = Word();
    float x;
    std::memcpy(&x, &word, sizeof x);
    return x;
  }
};

std::vector<uint32_t> AncestorsOf(const tpa_context* context) {
  uint32_t count = 0;
  EXPECT_EQ(tpa_components(context, nullptr, 0, nullptr, &count, nullptr), TPA_OK);
  std::vector<tpa_component> components(count);
  EXPECT_EQ(tpa_components(context, components.data(), count, nullptr, &count, nullptr), TPA_OK);
  std::vector<uint32_t> before;
  for (const tpa_component& c : components) before.push_back(c.before);
  return before;
}

void ExpectHeader(Reader& in, const Busy& b, const tpa_mesh_view& view, uint32_t old_triangles) {
  const tpa_config& config = b.evolution.config;
  const uint32_t* rolled_back = nullptr;
  uint32_t rolled_back_count = 0;
  ASSERT_EQ(tpa_rolled_back(*b.arena, &rolled_back, &rolled_back_count), TPA_OK);
  EXPECT_EQ(std::string(in.bytes.begin(), in.bytes.begin() + 8), "TPASTATE");
  in.at = 8;
  EXPECT_EQ(in.Word(), 1u) << "version";
  EXPECT_EQ(in.Word(), view.vertex_count);
  EXPECT_EQ(in.Word(), view.triangle_count);
  EXPECT_EQ(in.Word(), OldToNewOf(*b.arena).size());
  EXPECT_EQ(in.Word(), old_triangles);
  EXPECT_EQ(in.Word(), 3u) << "targets";
  EXPECT_EQ(in.Word(), rolled_back_count);
  EXPECT_EQ(in.Word(), EventsOf(*b.arena).size());
  EXPECT_EQ(in.Word(), AncestorsOf(*b.arena).size());
  EXPECT_EQ(in.Word(), 1u) << "loaded";
  EXPECT_EQ(in.Wide(), in.bytes.size());
  EXPECT_EQ(in.Wide(), view.epoch);
  EXPECT_EQ(in.Word(), config.detect_mode);
  EXPECT_EQ(in.Real(), config.cell_size);
  EXPECT_EQ(in.Word(), config.region);
  EXPECT_EQ(in.Word(), config.max_passes);
  EXPECT_EQ(in.Word(), config.max_candidates);
  EXPECT_EQ(in.Word(), config.smooth_iterations);
  EXPECT_EQ(in.Real(), config.smooth_lambda);
  EXPECT_EQ(in.Real(), config.smooth_mu);
}

void ExpectMaps(Reader& in, const tpa_context* context, const tpa_mesh_view& view) {
  for (uint32_t v = 0; v < view.vertex_count; ++v) {
    const uint32_t edge = in.Word();
    ASSERT_LT(edge, 3 * view.triangle_count);
    EXPECT_EQ(view.triangles[edge], v);
  }
  for (const tpa_vertex_origin& o : VertexOriginsOf(context)) {
    EXPECT_EQ(in.Word(), o.parents[0]);
    EXPECT_EQ(in.Word(), o.parents[1]);
    EXPECT_EQ(in.Single(), o.weight);
  }
  for (uint32_t i = 0; i < 3 * view.triangle_count; ++i) EXPECT_EQ(in.Word(), view.triangles[i]);
  for (uint32_t f : TriangleOriginsOf(context)) EXPECT_EQ(in.Word(), f);
  for (uint32_t v : OldToNewOf(context)) EXPECT_EQ(in.Word(), v);
}

TEST(State, HoldsWhatTheInterfaceTells) {
  const Busy b;
  const Bytes bytes = SavedFrom(*b.arena);
  auto view = Sized<tpa_mesh_view>();
  ASSERT_EQ(tpa_view(*b.arena, &view), TPA_OK);
  auto triangles = Sized<tpa_triangle_map_view>();
  ASSERT_EQ(tpa_triangle_map(*b.arena, &triangles), TPA_OK);
  Reader in{bytes};
  ExpectHeader(in, b, view, triangles.old_count);
  for (uint32_t i = 0; i < 3 * view.vertex_count; ++i) EXPECT_EQ(in.Real(), view.positions[i]);
  ExpectMaps(in, *b.arena, view);
  for (const tpa_event& e : EventsOf(*b.arena)) {
    EXPECT_EQ(static_cast<int32_t>(in.Word()), e.type);
    EXPECT_EQ(in.Word(), e.amount);
    EXPECT_EQ(in.Word(), e.before);
    EXPECT_EQ(in.Word(), e.after);
    for (double x : e.position) EXPECT_EQ(in.Real(), x);
  }
  for (uint32_t before : AncestorsOf(*b.arena)) EXPECT_EQ(in.Word(), before);
  for (uint32_t v : {3u, 7u, 11u}) EXPECT_EQ(in.Word(), v);
  for (double x : {-7., -8., -9., 1., 2., 3., 4., 5., 6.}) EXPECT_EQ(in.Real(), x);
  const uint32_t* rolled_back = nullptr;
  uint32_t count = 0;
  ASSERT_EQ(tpa_rolled_back(*b.arena, &rolled_back, &count), TPA_OK);
  EXPECT_GT(count, 0u);
  for (uint32_t i = 0; i < count; ++i) EXPECT_EQ(in.Word(), rolled_back[i]);
  const uint64_t hash = Xxh64(bytes.data(), in.at);
  EXPECT_EQ(in.Wide(), hash);
  EXPECT_EQ(in.at, bytes.size());
  EXPECT_EQ(DigestOf(*b.arena), hash);
}

TEST(State, TheDigestSeesEachChange) {
  const Busy b;
  const uint64_t before = DigestOf(*b.arena);
  auto contacts = Sized<tpa_contacts>();
  auto validation = Sized<tpa_validation>();
  ASSERT_EQ(tpa_detect(*b.arena, nullptr, &contacts, nullptr), TPA_OK);
  ASSERT_EQ(tpa_validate(*b.arena, nullptr, &validation, nullptr), TPA_OK);
  EXPECT_EQ(DigestOf(*b.arena), before) << "a look changes nothing";
  ASSERT_EQ(MoveSome(*b.arena, {3}, {-7, -8, -9.5}), TPA_OK);
  EXPECT_NE(DigestOf(*b.arena), before) << "a target";
  ASSERT_EQ(MoveSome(*b.arena, {3}, {-7, -8, -9}), TPA_OK);
  EXPECT_EQ(DigestOf(*b.arena), before);
  ASSERT_EQ(tpa_drop_targets(*b.arena), TPA_OK);
  EXPECT_NE(DigestOf(*b.arena), before) << "no targets";
}

// Without a mesh there is a state, too.
TEST(State, AnEmptyContextIsSavedAndRestored) {
  const Mesh m = Sphere({}, 1, 3);
  Arena empty(ConfigFor(m)), full(ConfigFor(m), m);
  const Bytes bytes = SavedFrom(*empty);
  ASSERT_EQ(tpa_restore(*full, bytes.data(), bytes.size(), nullptr), TPA_OK);
  auto view = Sized<tpa_mesh_view>();
  EXPECT_EQ(tpa_view(*full, &view), TPA_E_STATE);
  EXPECT_EQ(SavedFrom(*full), bytes);
  EXPECT_EQ(Load(*full, m), TPA_OK);
  EXPECT_EQ(Load(*empty, m), TPA_OK);
  EXPECT_EQ(DigestOf(*full), DigestOf(*empty));
}

// With a mesh whose bodies are all gone, which is not the state without a mesh.
TEST(State, AnEmptiedMeshIsSavedAndRestoredAndGrows) {
  const Mesh m = Sphere({}, 1, 3);
  const Arena arena(ConfigFor(m), m), full(ConfigFor(m), m);
  std::vector<double> mirrored = m.positions;
  for (size_t i = 0; i < mirrored.size(); i += 3) mirrored[i] = -mirrored[i];
  ASSERT_EQ(MoveAll(*arena, mirrored), TPA_OK);
  for (int commit = 0; commit < 2; ++commit) {
    ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_OK);
    ASSERT_EQ(MeshOf(*arena).positions.size(), 0u);
    EXPECT_EQ(EventsOf(*arena).empty(), commit == 1);
    const Bytes bytes = SavedFrom(*arena);
    ASSERT_EQ(tpa_restore(*full, bytes.data(), bytes.size(), nullptr), TPA_OK);
    EXPECT_EQ(SavedFrom(*full), bytes);
    EXPECT_TRUE(Observe(*full) == Observe(*arena));
    tpa_config config = ConfigFor(m);
    config.max_vertices += 100;
    const Arena larger(config);
    tpa_context* grown = nullptr;
    ASSERT_EQ(tpa_grow(*arena, larger.block(), larger.size().bytes, &config, &grown, nullptr), TPA_OK);
    EXPECT_TRUE(Observe(grown) == Observe(*arena));
    EXPECT_EQ(SavedFrom(grown), bytes);
  }
}

// A tangle is saved like any mesh, and known to be one after the return.
TEST(State, ARestoredTangleIsATangle) {
  const Mesh m = Together({Sphere({0, 0, 0}, 1, 4), Sphere({1, 0.1, 0.2}, 1, 4)});
  const Mesh apart = Sphere({}, 1, 4);
  const Arena tangled(ConfigFor(m), m), clean(ConfigFor(m), apart);
  auto report = Sized<tpa_report>();
  ASSERT_EQ(tpa_step(*clean, nullptr, &report, nullptr), TPA_OK);
  const Bytes bytes = SavedFrom(*tangled);
  ASSERT_EQ(tpa_restore(*clean, bytes.data(), bytes.size(), nullptr), TPA_OK);
  EXPECT_EQ(tpa_step(*clean, nullptr, &report, nullptr), TPA_E_TANGLED);
}

// The vertex hash forgets the mesh before.
TEST(State, TheVertexHashLooksAtTheRestoredMesh) {
  const Mesh fine = Sphere({}, 0.1, 4), coarse = Together({Sphere({}, 1, 2), Sphere({0.9, 0.1, 0.2}, 1, 2)});
  tpa_config config = ConfigFor(Together({fine, coarse}));
  config.detect_mode = TPA_DETECT_VERTEX_HASH;
  config.cell_size = 0.3;
  const Arena arena(config, fine), fresh(config, coarse);
  const Bytes bytes = SavedFrom(*fresh);
  ASSERT_EQ(tpa_restore(*arena, bytes.data(), bytes.size(), nullptr), TPA_OK);
  auto expected = Sized<tpa_contacts>(), found = Sized<tpa_contacts>();
  ASSERT_EQ(tpa_detect(*fresh, nullptr, &expected, nullptr), TPA_OK);
  ASSERT_EQ(tpa_detect(*arena, nullptr, &found, nullptr), TPA_OK);
  EXPECT_GT(expected.count, 0u);
  EXPECT_EQ(PairsOf(found), PairsOf(expected));
}

// ---------------------------------------------------------------- arguments

TEST(State, SaysHowManyBytesAndWritesNoMore) {
  const Busy b;
  const Bytes whole = SavedFrom(*b.arena);
  size_t size = 0;
  tpa_issue issue;
  Bytes few(whole.size() - 1, 0xAB);
  EXPECT_EQ(tpa_save(*b.arena, few.data(), few.size(), &size, &issue), TPA_E_ARENA);
  EXPECT_EQ(size, whole.size());
  EXPECT_EQ(issue.needed, whole.size());
  EXPECT_EQ(issue.available, few.size());
  EXPECT_EQ(few, Bytes(few.size(), 0xAB));
  Bytes many(whole.size() + 5, 0xAB);
  EXPECT_EQ(tpa_save(*b.arena, many.data() + 1, many.size() - 1, &size, &issue), TPA_OK) << "at an odd address";
  EXPECT_EQ(Bytes(many.begin() + 1, many.end() - 4), whole);
  EXPECT_EQ(Bytes(many.end() - 4, many.end()), Bytes(4, 0xAB));
  EXPECT_EQ(tpa_restore(*b.arena, many.data() + 1, size, &issue), TPA_OK) << Text(issue);
}

TEST(State, ForbiddenArguments) {
  const Mesh m = Sphere({}, 1, 3);
  const Arena arena(ConfigFor(m), m);
  size_t size = 0;
  uint32_t count = 0;
  uint64_t digest = 0;
  tpa_issue issue;
  EXPECT_EQ(tpa_save(nullptr, nullptr, 0, &size, &issue), TPA_E_CONTEXT);
  EXPECT_EQ(tpa_save(*arena, nullptr, 1, &size, &issue), TPA_E_ARGUMENT);
  EXPECT_EQ(issue.argument, 2);
  EXPECT_EQ(tpa_save(*arena, nullptr, 0, nullptr, &issue), TPA_E_ARGUMENT);
  EXPECT_EQ(issue.argument, 4);
  EXPECT_EQ(tpa_restore(nullptr, &size, 1, &issue), TPA_E_CONTEXT);
  EXPECT_EQ(tpa_restore(*arena, nullptr, 1, &issue), TPA_E_ARGUMENT);
  EXPECT_EQ(Text(issue), "invalid argument: data must not be NULL");
  EXPECT_EQ(tpa_digest(nullptr, &digest), TPA_E_CONTEXT);
  EXPECT_EQ(tpa_digest(*arena, nullptr), TPA_E_ARGUMENT);
  EXPECT_EQ(tpa_targets(nullptr, nullptr, nullptr, 0, &count), TPA_E_CONTEXT);
  EXPECT_EQ(tpa_targets(*arena, nullptr, nullptr, 0, nullptr), TPA_E_ARGUMENT);
  EXPECT_EQ(tpa_drop_targets(nullptr), TPA_E_CONTEXT);
  EXPECT_EQ(tpa_config_of(nullptr, nullptr), TPA_E_CONTEXT);
  EXPECT_EQ(tpa_config_of(*arena, nullptr), TPA_E_ARGUMENT);
}

TEST(State, TellsItsConfigAndTargets) {
  const Mesh m = Sphere({}, 1, 3);
  tpa_config given = ConfigFor(m);
  given.max_passes = 5;
  const Arena arena(given, m);
  auto config = Sized<tpa_config>();
  ASSERT_EQ(tpa_config_of(*arena, &config), TPA_OK);
  EXPECT_EQ(std::memcmp(&config, &given, sizeof config), 0);
  tpa_arena_size size;
  EXPECT_EQ(tpa_arena_query(&config, &size, nullptr), TPA_OK);
  EXPECT_EQ(size.bytes, arena.size().bytes);

  EXPECT_EQ(TargetsOf(*arena), (Targets{}));
  ASSERT_EQ(MoveSome(*arena, {9, 2}, {1, 2, 3, 4, 5, 6}), TPA_OK);
  EXPECT_EQ(TargetsOf(*arena), (Targets{{2, 9}, {4, 5, 6, 1, 2, 3}}));
  uint32_t one[2] = {77, 77}, count = 0;
  EXPECT_EQ(tpa_targets(*arena, one, nullptr, 1, &count), TPA_OK);
  EXPECT_EQ(count, 2u);
  EXPECT_EQ(one[0], 2u);
  EXPECT_EQ(one[1], 77u);
  ASSERT_EQ(tpa_drop_targets(*arena), TPA_OK);
  EXPECT_EQ(TargetsOf(*arena), (Targets{}));
  ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_OK);
  EXPECT_EQ(MeshOf(*arena).positions, m.positions);
}

// ---------------------------------------------------------------- other configs

TEST(State, FieldsThatDecideResultsMustAgree) {
  const Mesh m = Sphere({}, 1, 3);
  const Bytes bytes = SavedFrom(*Arena(ConfigFor(m), m));
  const std::vector<std::pair<std::string, void (*)(tpa_config&)>> fields = {
      {"detect_mode", [](tpa_config& c) { c.detect_mode = TPA_DETECT_VERTEX_HASH; }},
      {"cell_size", [](tpa_config& c) { c.cell_size = 2; }},
      {"region", [](tpa_config& c) { c.region = TPA_REGION_OUTSIDE; }},
      {"max_passes", [](tpa_config& c) { c.max_passes = 9; }},
      {"max_candidates", [](tpa_config& c) { c.max_candidates = 65; }},
      {"smooth_iterations", [](tpa_config& c) { c.smooth_iterations = 5; }},
      {"smooth_lambda", [](tpa_config& c) { c.smooth_lambda = 0.5; }},
      {"smooth_mu", [](tpa_config& c) { c.smooth_mu = -0.7; }}};
  for (const auto& [name, change] : fields) {
    tpa_config config = ConfigFor(m);
    change(config);
    const Arena arena(config, m);
    const uint64_t before = DigestOf(*arena);
    tpa_issue issue;
    EXPECT_EQ(tpa_restore(*arena, bytes.data(), bytes.size(), &issue), TPA_E_CONFIG) << name;
    EXPECT_EQ(Text(issue), "invalid configuration: config." + name + " must be as in the saved state");
    EXPECT_EQ(DigestOf(*arena), before);
  }
}

TEST(State, LimitsThatAreTooSmallAreNamedAndEnough) {
  const Busy b;
  const Bytes bytes = SavedFrom(*b.arena);
  tpa_config config = b.evolution.config;
  config.max_vertices = config.max_triangles = 4;
  config.max_events = 1;
  std::vector<int32_t> raised;
  for (int tries = 0; tries < 10; ++tries) {
    const Arena arena(config);
    tpa_issue issue;
    const tpa_status status = tpa_restore(*arena, bytes.data(), bytes.size(), &issue);
    if (status == TPA_OK) {
      EXPECT_EQ(SavedFrom(*arena), bytes);
      break;
    }
    ASSERT_EQ(status, TPA_E_LIMIT) << Text(issue);
    raised.push_back(issue.limit);
    uint32_t* const limits[] = {nullptr, &config.max_vertices, &config.max_triangles, nullptr,
                                nullptr, &config.max_events};
    EXPECT_EQ(*limits[issue.limit], issue.available);
    *limits[issue.limit] = static_cast<uint32_t>(issue.needed);
  }
  EXPECT_EQ(raised, (std::vector<int32_t>{TPA_LIMIT_VERTICES, TPA_LIMIT_TRIANGLES, TPA_LIMIT_EVENTS}));
}

TEST(State, TheLimitOfComponentsIsNamed) {
  const Mesh m = Together({Sphere({}, 1, 2), Sphere({3, 0, 0}, 1, 2), Sphere({6, 0, 0}, 1, 2)});
  const Bytes bytes = SavedFrom(*Arena(ConfigFor(m), m));
  tpa_config config = ConfigFor(m);
  config.max_components = 2;
  const Arena arena(config, Sphere({}, 1, 2));
  const Observed before = Observe(*arena);
  tpa_issue issue;
  EXPECT_EQ(tpa_restore(*arena, bytes.data(), bytes.size(), &issue), TPA_E_LIMIT);
  EXPECT_EQ(issue.limit, TPA_LIMIT_COMPONENTS);
  EXPECT_EQ(issue.needed, 3u);
  EXPECT_EQ(issue.available, 2u);
  EXPECT_TRUE(Observe(*arena) == before);
  EXPECT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_OK);
}

}  // namespace
}  // namespace state_test
