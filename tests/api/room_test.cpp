// SPDX-License-Identifier: MIT
// Limits fail a call or do not matter: the results are the same bits for every set of limits with which the call
// succeeds, down to the peaks of use (P6).
#include <algorithm>
#include <array>
#include <cstring>

#include "support/field_meshes.h"
#include "support/field_shapes.h"
#include "support/resolve_trial.h"
#include "support/step_scenes.h"
#include "support/support.h"
#include "support/tangle_shapes.h"

namespace {

using namespace support;

struct Given {
  Mesh mesh;
  std::vector<double> targets;  // of tpa_step; none for tpa_adapt
  double cell = 0;              // of the vertex hash; 0: complete detection
};

// ---------------------------------------------------------------- limits

constexpr std::array<uint32_t tpa_config::*, 7> limits = {
    &tpa_config::max_vertices, &tpa_config::max_triangles,  &tpa_config::max_contacts, &tpa_config::max_cut_edges,
    &tpa_config::max_events,   &tpa_config::max_components, &tpa_config::max_pieces};
constexpr size_t pieces_limit = 6;
// Tables whose peaks are those of the limits, in the same order; scratch memory holds the pieces.
constexpr std::array<const char*, 6> tables = {"position", "corner", "contact_pairs", "cuts", "events", "components"};
constexpr std::array<uint32_t, 7> least = {4, 4, 1, 3, 1, 1, 1};

tpa_config Generous(const Given& call) {
  tpa_config config = GenerousConfig(call.mesh);
  if (call.cell > 0) {
    config.detect_mode = TPA_DETECT_VERTEX_HASH;
    config.cell_size = call.cell;
  }
  config.max_triangles = 2 * config.max_vertices + 1024;
  config.max_components = config.max_vertices / 3;
  config.max_pieces = 4 * config.max_contacts + 1024;
  return config;
}

struct Ended {
  tpa_status status;
  tpa_issue issue;
  tpa_report report;
  Observed before, after;
  std::vector<tpa_memory_table> tables;
};

Ended Run(const tpa_config& config, const Given& call) {
  Ended out{};
  out.report = Sized<tpa_report>();
  const Arena arena(config);
  out.status = Load(*arena, call.mesh, &out.issue);
  if (out.status != TPA_OK) return out;
  if (!call.targets.empty()) {
    EXPECT_EQ(MoveAll(*arena, call.targets), TPA_OK);
  }
  out.before = Observe(*arena);
  out.status = call.targets.empty() ? tpa_adapt(*arena, nullptr, &out.report, &out.issue)
                                    : tpa_step(*arena, nullptr, &out.report, &out.issue);
  out.after = Observe(*arena);
  uint32_t count = 0;
  EXPECT_EQ(tpa_memory_stats(*arena, nullptr, 0, &count), TPA_OK);
  out.tables.resize(count);
  EXPECT_EQ(tpa_memory_stats(*arena, out.tables.data(), count, &count), TPA_OK);
  return out;
}

uint32_t PeakOf(const Ended& outcome, const char* table) {
  for (const tpa_memory_table& t : outcome.tables)
    if (std::string(t.name) == table) return static_cast<uint32_t>(t.peak);
  ADD_FAILURE() << "no table is called " << table;
  return 0;
}

// The least number of pieces with which the call succeeds, between `low`, which fails, and that of the config.
uint32_t LeastPieces(tpa_config config, const Given& call) {
  uint32_t low = 0, high = config.max_pieces;
  while (high - low > 1) {
    config.max_pieces = low + (high - low) / 2;
    (Run(config, call).status == TPA_OK ? high : low) = config.max_pieces;
  }
  return high;
}

// ---------------------------------------------------------------- the property

// The same bits, or a failure that names a limit and leaves everything alone. True if the call succeeds.
bool ExpectSame(const Ended& expected, const tpa_config& config, const Given& call, const std::string& what) {
  const Ended out = Run(config, call);
  if (out.status == TPA_OK) {
    EXPECT_TRUE(out.after == expected.after) << what << ": other results";
    EXPECT_EQ(std::memcmp(&out.report, &expected.report, sizeof out.report), 0) << what << ": another report";
    return true;
  }
  EXPECT_EQ(out.status, TPA_E_LIMIT) << what << ": " << Text(out.issue);
  EXPECT_TRUE(out.after == out.before) << what << ": a failure changed the mesh";
  return false;
}

class Room {
 public:
  Room(const Given& call, std::string name) : call_(call), name_(std::move(name)), generous_(Generous(call)) {
    expected_ = Run(generous_, call_);
    if (expected_.status != TPA_OK) return;
    for (size_t i = 0; i < tables.size(); ++i) peaks_[i] = std::max(least[i], PeakOf(expected_, tables[i]));
    peaks_[pieces_limit] = LeastPieces(generous_, call_);
  }
  bool succeeds() const { return expected_.status == TPA_OK; }

  // All limits at so many times their peaks: exactly the peaks may be too few, since a peak leaves out what is asked
  // for and not taken.
  bool Holds(uint32_t times) const {
    tpa_config config = generous_;
    for (size_t i = 0; i < limits.size(); ++i) config.*limits[i] = times * peaks_[i];
    return ExpectSame(expected_, config, call_, name_ + " at " + std::to_string(times) + " times the peaks");
  }
  // One limit at so many times its peak, or just below.
  bool HoldsOne(size_t limit, uint32_t times, uint32_t less) const {
    tpa_config config = generous_;
    config.*limits[limit] = std::max(times * peaks_[limit] - less, least[limit]);
    return ExpectSame(expected_, config, call_,
                      name_ + ", limit " + std::to_string(limit + 1) + " of " + std::to_string(config.*limits[limit]));
  }

 private:
  const Given& call_;
  std::string name_;
  tpa_config generous_;
  Ended expected_{};
  std::array<uint32_t, 7> peaks_{};
};

struct Counts {
  uint32_t played = 0, tight = 0;
};

void Try(const Given& call, const std::string& name, Counts& counts) {
  SCOPED_TRACE(name);
  const MeshOnFailure given(name, call.mesh);
  const Room room(call, name);
  if (!room.succeeds()) return;
  ++counts.played;
  counts.tight += room.Holds(1) ? 1u : 0u;
  for (uint32_t times : {2u, 4u, 16u}) room.Holds(times);
  for (size_t limit = 0; limit < limits.size(); ++limit) {
    for (uint32_t times : {1u, 2u, 4u, 16u}) room.HoldsOne(limit, times, 0);
    room.HoldsOne(limit, 1, 1);
  }
}

TEST(Room, DoesNotChangeHowATangleIsResolved) {
  Counts counts;
  for (const char* family : {"boxes-grid", "boxes-near", "plates-stacked", "star-coarse", "outline-coarse",
                             "frame-coarse", "spring-coarse", "thread-coarse", "copies-turned", "noise-sphere-66"})
    Try({MakeFieldMesh(FieldFamilyOf(family), 1), {}, 0}, family, counts);
  EXPECT_EQ(counts.played, 10u);
  EXPECT_GT(counts.tight, 0u) << "the peaks are never enough";
}

// Each vertex moves within so many mean edges.
Given Shaken(const Mesh& mesh, double edges, uint64_t seed) {
  Random random(seed);
  return {mesh, ShakenTargets(mesh, edges * MeanEdgeOf(mesh), random), 0};
}

Given BallsThatMeet(uint64_t seed) {
  Given balls{Together({Sphere({}, 1, 5), Sphere({2.2, 0.1, 0.05}, 1, 5)}), {}, 0};
  balls.targets = balls.mesh.positions;
  for (size_t i = 0; i < balls.targets.size() / 2; i += 3) balls.targets[i] += 0.3 * static_cast<double>(seed);
  return balls;
}

TEST(Room, DoesNotChangeAStep) {
  Counts counts;
  const Mesh ball = Sphere({}, 1, 4), ring = Torus({}, 1, 0.4, 16, 8), slab = Slab(2, 2, 0.5, 0.4);
  for (uint64_t seed : {uint64_t{1}, uint64_t{2}}) {
    const std::string number = "-" + std::to_string(seed);
    for (double edges : {0.2, 0.5, 1.0}) {
      Try(Shaken(ball, edges, seed), "ball" + number, counts);
      Try(Shaken(ring, edges, seed), "ring" + number, counts);
      Try(Shaken(slab, edges, seed), "slab" + number, counts);
    }
    Try(BallsThatMeet(seed), "balls" + number, counts);
  }
  EXPECT_GE(counts.played, 12u);
  EXPECT_GT(counts.tight, 0u) << "the peaks are never enough";
}

// The hash has 2 * max_vertices slots, and finds the same contacts whatever their number.
TEST(Room, DoesNotChangeWhatTheVertexHashLeadsTo) {
  Counts counts;
  for (const char* family : {"boxes-grid", "star-coarse", "spring-coarse", "noise-sphere-66"}) {
    const Mesh mesh = MakeFieldMesh(FieldFamilyOf(family), 1);
    Try({mesh, {}, MeanEdgeOf(mesh)}, std::string(family) + "-hashed", counts);
  }
  for (uint64_t seed : {uint64_t{1}, uint64_t{2}}) {
    Given balls = BallsThatMeet(seed), ball = Shaken(Sphere({}, 1, 4), 0.5, seed);
    balls.cell = MeanEdgeOf(balls.mesh);
    ball.cell = MeanEdgeOf(ball.mesh);
    Try(balls, "balls-hashed-" + std::to_string(seed), counts);
    Try(ball, "ball-hashed-" + std::to_string(seed), counts);
  }
  EXPECT_GE(counts.played, 6u);
}

}  // namespace
