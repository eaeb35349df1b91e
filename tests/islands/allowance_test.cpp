// SPDX-License-Identifier: MIT
// Allowances: whatever the limits, an attempt that is not stopped by them goes on or gives up at the same amounts, and
// a limit that is named suffices.
#include "islands/allowance.h"

#include "support/open_island.h"

namespace allowance_test {
namespace {

using namespace support;
using tpa::Outcome;

struct Asked {
  Outcome outcome;
  uint64_t needed, available;
  bool operator==(const Asked&) const = default;
};

Asked Ask(uint32_t attempt, uint64_t wanted, uint64_t allowed, uint64_t available) {
  OpenIsland island(Sphere({0, 0, 0}, 1, 2));
  tpa::Attempt a = island.Attempt(attempt, 1);
  const Outcome outcome = tpa::check_amount(a, TPA_LIMIT_PIECES, wanted, allowed, available);
  return {outcome, island.issue.needed, island.issue.available};
}

TEST(CheckedAmount, BeyondTheAllowanceGivesUpWhateverTheLimit) {
  for (uint64_t available : {0u, 10u, 11u, 1000u}) {
    EXPECT_EQ(Ask(papers_attempt, 11, 10, available).outcome, Outcome::blocked);
    EXPECT_EQ(Ask(cut_attempt, 11, 10, available).outcome, Outcome::excess);
  }
}

TEST(CheckedAmount, WithinTheAllowanceFailsTheCallAtTheLimitOnly) {
  EXPECT_EQ(Ask(cut_attempt, 10, 10, 10), (Asked{Outcome::clean, 0, 0}));
  EXPECT_EQ(Ask(cut_attempt, 10, 10, 9), (Asked{Outcome::limit, 10, 9}));
  // Enough for all that the island may still want.
  EXPECT_EQ(Ask(cut_attempt, 7, 10, 6), (Asked{Outcome::limit, 10, 6}));
}

TEST(CheckedAmount, IsKnownOnlyByTheWantsOfTheFirstTime) {
  EXPECT_EQ(Ask(cut_attempt, 10, tpa::not_known, 10), (Asked{Outcome::clean, 0, 0}));
  EXPECT_EQ(Ask(cut_attempt, 11, tpa::not_known, 10), (Asked{Outcome::limit, 11, 10}));
}

TEST(Contacts, OfLaterPassesAreAtMostFourTimesThoseOfTheFirst) {
  OpenIsland island(Sphere({0, 0, 0}, 1, 2));
  tpa::Attempt a = island.Attempt(cut_attempt, 1);
  const auto check = [&](uint64_t contacts) {
    island.w.detection.found = contacts;
    return tpa::check_contacts(a);
  };
  EXPECT_EQ(check(100), Outcome::clean);
  EXPECT_EQ(check(464), Outcome::clean);
  EXPECT_EQ(check(465), Outcome::excess);
}

// Slots of elements, relative to those before the island.
TEST(Elements, OfLaterPassesAreBoundByThoseOfTheFirst) {
  for (uint32_t attempt : {papers_attempt, cut_attempt}) {
    OpenIsland island(Sphere({0, 0, 0}, 1, 2));
    tpa::Attempt a = island.Attempt(attempt, 1);
    const uint64_t vertices = island.t.slots.vertices, faces = island.t.slots.faces;
    tpa::note_elements(a, vertices + 10, faces + 20);
    tpa::note_elements(a, vertices + 1000, faces + 1000);  // of a later pass
    const tpa::ElementAllowance& allowed =
        attempt == papers_attempt ? island.t.allowance.paper : island.t.allowance.cut;
    const uint64_t times = attempt == papers_attempt ? 2 : 8;
    EXPECT_EQ(allowed.vertices, vertices + times * 10 + 64);
    EXPECT_EQ(allowed.triangles, faces + times * 20 + 64);
    const uint32_t most = static_cast<uint32_t>(allowed.vertices - vertices);
    EXPECT_TRUE(tpa::has_free_vertices(island.w.edit, most));
    EXPECT_FALSE(tpa::has_free_vertices(island.w.edit, most + 1));
    // Within the limits, more than allowed is no matter of the limits.
    EXPECT_EQ(tpa::out_of_vertices(a), attempt == papers_attempt ? Outcome::blocked : Outcome::excess);
    EXPECT_EQ(tpa::out_of_triangles(a), attempt == papers_attempt ? Outcome::blocked : Outcome::excess);
  }
}

TEST(Elements, BeyondTheLimitFailTheCallWithEnough) {
  OpenIsland island(Sphere({0, 0, 0}, 1, 2));
  tpa::Attempt a = island.Attempt(cut_attempt, 1);
  const uint32_t limit = island.w.context.limits.vertices;
  tpa::note_elements(a, limit, island.t.slots.faces);
  EXPECT_EQ(tpa::out_of_vertices(a), Outcome::limit);
  EXPECT_EQ(island.issue.limit, TPA_LIMIT_VERTICES);
  EXPECT_EQ(island.issue.available, limit);
  EXPECT_EQ(island.issue.needed, island.t.allowance.cut.vertices);
  EXPECT_GT(island.issue.needed, limit);
  // With that limit, the attempt would give up in place of failing.
  EXPECT_EQ(tpa::out_of_pieces(a, island.w.context.limits.pieces), Outcome::excess);
  EXPECT_EQ(tpa::out_of_pieces(a, uint64_t{island.w.context.limits.pieces} + 1), Outcome::limit);
}

}  // namespace
}  // namespace allowance_test
