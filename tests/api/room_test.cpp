// SPDX-License-Identifier: MIT
// Limits fail a call or do not matter: the results are the same bits for every set of limits with which the calls
// succeed (P6), and they succeed from the peaks of tpa_memory_stats on.
#include <cstring>

#include "support/field_meshes.h"
#include "support/field_shapes.h"
#include "support/limit_scenes.h"
#include "support/share.h"
#include "support/step_scenes.h"

namespace room_test {
namespace {

using namespace support;

// ---------------------------------------------------------------- the property

class Room {
 public:
  explicit Room(const CallScene& scene) : scene_(scene), ample_(AmpleLimits(scene)), expected_(Play(scene, ample_)) {}
  bool succeeds() const { return !expected_.limited(); }

  // All limits at so many times their peaks.
  void HoldAll(uint32_t times) const {
    tpa_config config = ample_;
    for (size_t i = 0; i < limit_fields.size(); ++i) config.*limit_fields[i] = times * expected_.peaks[i];
    ExpectSame(Play(scene_, config), std::to_string(times) + " times all peaks");
  }
  // One limit at so many times its peak.
  void HoldOne(size_t limit, uint32_t times) const {
    tpa_config config = ample_;
    config.*limit_fields[limit] = times * expected_.peaks[limit];
    ExpectSame(Play(scene_, config), std::string(limit_names[limit]) + " of " +
                                         std::to_string(config.*limit_fields[limit]) + ", " + std::to_string(times) +
                                         " times the peak");
  }
  // One limit below its peak fails a call, and the calls before are as with ample limits.
  void FailBelow(size_t limit) const {
    if (expected_.peaks[limit] == least_limits[limit]) return;
    tpa_config config = ample_;
    config.*limit_fields[limit] = expected_.peaks[limit] - 1;
    const CallsEnded ended = Play(scene_, config);
    EXPECT_TRUE(ended.limited()) << limit_names[limit] << " of " << config.*limit_fields[limit] << " suffice";
    EXPECT_FALSE(ended.failure_changed) << limit_names[limit];
    for (size_t i = 0; i + 1 < ended.calls.size(); ++i)
      EXPECT_EQ(ended.calls[i].bytes, expected_.calls[i].bytes) << limit_names[limit] << ", call " << i;
  }

 private:
  void ExpectSame(const CallsEnded& ended, const std::string& what) const {
    if (ended.limited()) {
      const CallOf& call = scene_.calls[ended.calls.size() - 1];
      ADD_FAILURE() << what << ": " << call_names[static_cast<size_t>(call.kind)] << " fails, "
                    << Text(ended.calls.back().issue);
      return;
    }
    for (size_t i = 0; i < ended.calls.size(); ++i) {
      const CallEnded &now = ended.calls[i], &then = expected_.calls[i];
      EXPECT_TRUE(now.status == then.status && now.bytes == then.bytes) << what << ": other results of call " << i;
    }
  }

  const CallScene& scene_;
  tpa_config ample_;
  CallsEnded expected_;
};

// How often the peaks a limit is played at; the least alone under a sanitizer.
std::vector<uint32_t> Times() { return IsQuick() ? std::vector<uint32_t>{1} : std::vector<uint32_t>{1, 2, 16}; }

void Try(const CallScene& scene, uint32_t& played) {
  SCOPED_TRACE(scene.name);
  const MeshOnFailure given(scene.name, scene.mesh);
  const Room room(scene);
  if (!room.succeeds()) return;
  ++played;
  for (uint32_t times : Times()) room.HoldAll(times);
  for (size_t limit = 0; limit < limit_fields.size(); ++limit) {
    for (uint32_t times : Times()) room.HoldOne(limit, times);
    room.FailBelow(limit);
  }
}

TEST(Room, DoesNotChangeRandomCalls) {
  uint32_t played = 0;
  for (uint64_t seed = 1; seed <= (IsQuick() ? 3 : 8); ++seed) Try(RandomCallScene(seed), played);
  EXPECT_GE(played, IsQuick() ? 2u : 6u);
}

TEST(Room, DoesNotChangeAStep) {
  uint32_t played = 0;
  for (uint64_t seed = 1; seed <= (IsQuick() ? 1 : 2); ++seed) {
    Try(SceneOf("ball", Sphere({}, 1, 4), CallKind::step, seed), played);
    Try(SceneOf("ring", Torus({}, 1, .4, 24, 12), CallKind::step, seed), played);
    Try(SceneOf("slab", Box({-1, -1, -.1}, {1, 1, .1}, 6), CallKind::step, seed), played);
  }
  EXPECT_GE(played, IsQuick() ? 2u : 5u);
}

// Two shells with common noise, close to each other, so that many vertices meet the other shell on their ways.
Mesh Shells(uint64_t seed) {
  Random random(seed);
  Mesh outer = Sphere({}, 1, 5), inner = outer;
  for (size_t v = 0; v < VertexCount(outer); ++v) {
    const double r = Uniform(random, 0.98, 1.02);
    for (size_t i = 0; i < 3; ++i) {
      outer.positions[3 * v + i] *= r;
      inner.positions[3 * v + i] *= r - 0.004;
    }
  }
  return Together({outer, inner});
}

// The vertices that a call after tpa_load moves by smoothing.
uint32_t MovedBy(const CallScene& scene) {
  const std::string bytes = Play(scene, AmpleLimits(scene)).calls.back().bytes;
  tpa_report report;
  std::memcpy(&report, bytes.data(), sizeof report);
  return report.moved;
}

TEST(Room, DoesNotChangeWhichVerticesSmoothingPutsBack) {
  uint32_t played = 0;
  for (uint64_t seed = 1; played < 6; ++seed) {
    ASSERT_LT(seed, 20u);
    const Mesh shells = Shells(seed);
    if (!AllMeetingPairs(shells).empty()) continue;
    const CallScene smooth = SceneOf("shells", shells, CallKind::smooth, seed);
    const uint32_t moved = MovedBy(smooth);
    if (moved == 0 || moved > VertexCount(shells) / 4) continue;  // hardly a vertex meets the other shell
    Try(smooth, played);
    Try(SceneOf("shells", shells, CallKind::remesh, seed), played);
  }
}

// The hash has 2 * max_vertices slots, and finds the same contacts whatever their number.
TEST(Room, DoesNotChangeWhatTheVertexHashLeadsTo) {
  uint32_t played = 0;
  for (uint64_t seed = 106; seed <= 110; ++seed) Try(Hashed(RandomCallScene(seed)), played);
  for (const char* family : {"boxes-grid", "star-coarse", "spring-coarse", "noise-sphere-66"})
    Try(Hashed(SceneOf(family, MakeFieldMesh(FieldFamilyOf(family), 1), CallKind::adapt, 0)), played);
  EXPECT_GE(played, 5u);
}

TEST(Room, DoesNotChangeHowATangleIsResolved) {
  uint32_t played = 0;
  for (const char* family : {"boxes-grid", "boxes-near", "plates-stacked", "star-coarse", "outline-coarse",
                             "frame-coarse", "spring-coarse", "thread-coarse", "copies-turned", "noise-sphere-66"})
    Try(SceneOf(family, MakeFieldMesh(FieldFamilyOf(family), 1), CallKind::adapt, 0), played);
  EXPECT_EQ(played, 10u);
}

}  // namespace
}  // namespace room_test
