// SPDX-License-Identifier: MIT
// tpa_issue.needed is enough: from the least limits on, a caller who follows it repeats a call for each limit twice in
// an island at most, and ends with the results of ample limits, bit for bit.
#include <algorithm>
#include <map>

#include "support/field_meshes.h"
#include "support/limit_scenes.h"
#include "support/share.h"

namespace needed_test {
namespace {

using namespace support;

// Seldom do two islands of a scene meet the same limit.
constexpr uint64_t most_retries = 4;

struct Tally {
  std::array<std::array<uint64_t, most_retries + 1>, 7> by_retries{};  // [limit][retries of a call]
  uint64_t failures = 0;
};

// Raises one limit after the other. False if a limit that is enough was not.
bool Follow(const CallScene& scene, const CallsEnded& expected, tpa_config config, Tally& tally) {
  std::map<std::pair<size_t, size_t>, uint64_t> retries;  // by call and limit
  for (;;) {
    const CallsEnded ended = Play(scene, config);
    EXPECT_FALSE(ended.failure_changed);
    const size_t last = ended.calls.size() - 1;
    for (size_t i = 0; i < ended.calls.size() - (ended.limited() ? 1 : 0); ++i)
      if (ended.calls[i].bytes != expected.calls[i].bytes || ended.calls[i].status != expected.calls[i].status) {
        ADD_FAILURE() << "call " << i << ": other results";
        return false;
      }
    if (!ended.limited()) {
      for (const auto& [key, count] : retries) {
        ++tally.by_retries[key.second][count];
      }
      return true;
    }
    const tpa_issue& issue = ended.calls[last].issue;
    const size_t limit = static_cast<size_t>(issue.limit - 1);
    ++tally.failures;
    const uint64_t tries = ++retries[{last, limit}];
    if (issue.needed <= issue.available || issue.available != config.*limit_fields[limit] || tries > most_retries) {
      ADD_FAILURE() << call_names[static_cast<size_t>(scene.calls[last].kind)] << ", retry " << tries << ": "
                    << Text(issue);
      return false;
    }
    config.*limit_fields[limit] = static_cast<uint32_t>(issue.needed);
  }
}

void Try(const CallScene& scene, Tally& tally) {
  SCOPED_TRACE(scene.name);
  const MeshOnFailure given(scene.name, scene.mesh);
  const tpa_config ample = AmpleLimits(scene);
  const CallsEnded expected = Play(scene, ample);
  if (expected.limited()) return;
  Follow(scene, expected, WithLimits(ample, least_limits), tally);
  for (size_t limit = 0; limit < least_limits.size(); ++limit) {
    tpa_config one = ample;
    one.*limit_fields[limit] = least_limits[limit];
    Follow(scene, expected, one, tally);
  }
}

void Print(const Tally& tally) {
  std::cout << tally.failures << " failures; calls by retries 1, 2:";
  for (size_t limit = 0; limit < limit_names.size(); ++limit)
    std::cout << ' ' << limit_names[limit] << ' ' << tally.by_retries[limit][1] << ' ' << tally.by_retries[limit][2];
  std::cout << '\n';
}

TEST(Needed, IsEnoughInRandomCalls) {
  Tally tally;
  for (uint64_t seed = 1; seed <= Share(16u); ++seed) Try(RandomCallScene(seed), tally);
  Print(tally);
  EXPECT_GT(tally.failures, Least(190u));
}

// Ranges of seeds without the few whose calls take seconds each. In scene 1115 a step has several thin tunnels.
TEST(NeededLong, IsEnoughInRandomCalls) {
  Tally tally;
  for (uint64_t seed = 1071; seed <= 1165; ++seed) Try(RandomCallScene(seed), tally);
  Print(tally);
  EXPECT_GT(tally.failures, 1200u);
}

TEST(NeededLong, IsEnoughByTheVertexHash) {
  Tally tally;
  for (uint64_t seed = 1240; seed <= 1300; ++seed) Try(Hashed(RandomCallScene(seed)), tally);
  Print(tally);
  EXPECT_GT(tally.failures, 700u);
}

TEST(Needed, IsEnoughByTheVertexHash) {
  Tally tally;
  for (uint64_t seed = 106; seed <= 110; ++seed) Try(Hashed(RandomCallScene(seed)), tally);
  Print(tally);
  EXPECT_GT(tally.failures, 60u);
}

TEST(Needed, IsEnoughInTangles) {
  Tally tally;
  for (const char* family : {"boxes-grid", "boxes-near", "plates-stacked", "star-coarse", "outline-coarse",
                             "frame-coarse", "spring-coarse", "thread-coarse", "copies-turned", "noise-sphere-66"})
    Try(SceneOf(family, MakeFieldMesh(FieldFamilyOf(family), 1), CallKind::adapt, 0), tally);
  Print(tally);
  EXPECT_GT(tally.failures, 80u);
}

}  // namespace
}  // namespace needed_test
