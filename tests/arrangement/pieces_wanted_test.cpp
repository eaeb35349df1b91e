// SPDX-License-Identifier: MIT
// The room for traces, foretold from contacts: pairs in one plane, on boxes with whole coordinates, against the normals
// of axes.
#include "arrangement/pieces_wanted.h"

#include <algorithm>
#include <set>

#include "support/library_mesh.h"
#include "support/support.h"

namespace pieces_wanted_test {
namespace {

using namespace support;

// All corners of both triangles have the same coordinate along an axis.
bool AreInOnePlane(const Mesh& m, uint32_t a, uint32_t b) {
  for (size_t axis = 0; axis < 3; ++axis) {
    std::set<double> levels;
    for (const uint32_t f : {a, b})
      for (size_t i = 0; i < 3; ++i) levels.insert(PositionOf(m, m.triangles[3 * f + i])[axis]);
    if (levels.size() == 1) return true;
  }
  return false;
}

// A pair in one plane has six traces, another pair two, and each face three sides; as many points at most. A room for n
// pieces has n / 2 + 8 points.
TEST(PiecesWanted, ForTracesDependOnPairsInOnePlane) {
  const Mesh m = Together({Box({0, 0, 0}, {2, 2, 2}, 2), Box({1, 0, 0}, {3, 2, 2}, 2), Box({0, 1, 1}, {3, 3, 3}, 3)});
  const LibraryMesh library(m);
  std::vector<tpa::Contact> contacts;
  std::set<uint32_t> faces;
  uint64_t flat = 0;
  for (const auto& [a, b] : AllMeetingPairs(m)) {
    contacts.push_back({a, b});
    faces.insert({a, b});
    flat += AreInOnePlane(m, a, b);
  }
  ASSERT_GT(flat, 50u);
  ASSERT_GT(contacts.size(), flat + 50);
  const auto count = static_cast<uint32_t>(faces.size());
  const uint64_t traces = 3 * faces.size() + 2 * contacts.size() + 4 * flat;
  EXPECT_EQ(tpa::pieces_for_traces(library.m, {contacts.data(), static_cast<uint32_t>(contacts.size())}, count),
            2 * (traces - 8));
}

}  // namespace
}  // namespace pieces_wanted_test
