// SPDX-License-Identifier: MIT
// Contacts of moved faces, against a test of every pair: one layer of surface and two close together, with proofs
// and without, in one thread and with chunks in any order.
#include "detect/detect_moved.h"

#include <algorithm>

#include "support/library_mesh.h"
#include "support/schedules.h"
#include "support/share.h"
#include "support/support.h"
#include "support/tangle_shapes.h"

namespace detect_moved_test {
namespace {

using namespace support;

// Two spheres, the inner one turned inside out. In a thin shell the faces of one sphere lie within the boxes of the
// other.
Mesh Shell(int parts, double thickness) {
  return Together({Sphere({0, 0, 0}, 1, parts), Reversed(Sphere({0, 0, 0}, 1 - thickness, parts))});
}

struct Moved {
  Mesh before, mesh;
  std::vector<bool> vertex;

  explicit Moved(const Mesh& m) : before(m), mesh(m), vertex(VertexCount(m)) {}
  // Moves the vertices within `reach` of a point: a bump outwards or inwards, and noise.
  void MoveRound(const Point& at, double reach, double way, double noise, Random& random) {
    for (uint32_t v = 0; v < VertexCount(mesh); ++v) {
      const Point p = PositionOf(mesh, v);
      double square = 0;
      for (size_t k = 0; k < 3; ++k) square += (p[k] - at[k]) * (p[k] - at[k]);
      if (square >= reach * reach) continue;
      vertex[v] = true;
      for (size_t k = 0; k < 3; ++k)
        mesh.positions[3 * v + k] += way * (1 - square / (reach * reach)) * at[k] + Uniform(random, -noise, noise);
    }
  }
};

struct Tally {
  size_t contacts = 0;
  int free = 0;
};

// Does detection find exactly the contacts of moved faces? Tries a new face tree and an old tree brought up to date,
// moved faces in random order, with and without room for groups.
void TryDetection(const Moved& moved, Random& random, Tally& tally, const std::string& name) {
  ArrangedMesh arranged(moved.mesh), followed(moved.before);
  std::vector<uint32_t> active;
  for (uint32_t f = 0; f < arranged.faces; ++f)
    if (moved.vertex[arranged.m.corner[3 * f]] || moved.vertex[arranged.m.corner[3 * f + 1]] ||
        moved.vertex[arranged.m.corner[3 * f + 2]])
      active.push_back(f);
  followed.positions = arranged.positions;
  tpa::reenter(followed.g, followed.e.mesh, {active.data(), static_cast<uint32_t>(active.size())});
  Pairs expected;
  for (const auto& pair : AllMeetingPairs(moved.mesh))
    if (std::binary_search(active.begin(), active.end(), pair.first) ||
        std::binary_search(active.begin(), active.end(), pair.second))
      expected.push_back(pair);
  std::shuffle(active.begin(), active.end(), random);
  std::vector<tpa::Contact> found(expected.size() + 1);
  std::vector<uint32_t> room(active.size());
  RoomsWithMemory memory(arranged.faces);
  std::vector<uint8_t> star(arranged.vertices);
  const auto n = static_cast<uint32_t>(active.size());
  for (ArrangedMesh* h : {&arranged, &followed})
    for (const bool in_chunks : {false, true})
      for (const uint32_t rooms : {n, 0u}) {
        for (uint32_t f : active) h->marks[f] = 1;
        std::fill(star.begin(), star.end(), uint8_t{0});
        tpa::Detection out{{found.data(), static_cast<uint32_t>(found.size())}, 0};
        const tpa::Exec exec{nullptr, in_chunks ? Backwards : nullptr};
        tpa::detect(h->e.mesh, h->g,
                    {h->marks.data(), {active.data(), n}, {room.data(), rooms}, star.data(), memory.rooms}, exec, out);
        Pairs pairs;
        for (const tpa::Contact& c : out.pairs) pairs.push_back({c.a, c.b});
        EXPECT_EQ(out.found, expected.size());
        EXPECT_EQ(pairs, expected) << "rooms for " << rooms << " of " << n << ", " << Written(moved.mesh, name);
      }
  tally.contacts += expected.size();
  tally.free += expected.empty();
}

TEST(DetectMoved, FindsAllContactsOfMovedFaces) {
  Random random(1);
  Tally tally;
  for (int i = 0; i < Share(200); ++i) {
    const Mesh shapes[] = {Sphere({0, 0, 0}, 1, 14), Shell(12, 0.1), Shell(8, 0.03), Torus({0, 0, 0}, 1, 0.25, 60, 20)};
    const Mesh mesh = RandomlyTurned(shapes[static_cast<size_t>(i) % std::size(shapes)], random);
    const double noise = i % 4 == 0 ? 0 : 0.04;
    Moved moved(mesh);
    for (int spots = i % 5 == 0 ? 12 : 1; spots > 0; --spots) {
      const double way = i % 3 == 0 ? 0.02 : Uniform(random, -0.5, 0.5);
      const double reach = i % 5 == 0 ? 0.3 : Uniform(random, 0.1, 1.2);
      moved.MoveRound(PositionOf(mesh, random() % VertexCount(mesh)), reach, way, noise, random);
    }
    TryDetection(moved, random, tally, "seed-1-mesh-" + std::to_string(i));
  }
  EXPECT_GT(tally.contacts, Least<size_t>(1000));
  EXPECT_GT(tally.free, Least(5));
}

// Beside a surface with faces up to 25 times smaller, more faces lie near a group than a list holds, so detection tries
// parts of the group; beside still smaller faces, each face by itself.
TEST(DetectMoved, BesideASurfaceOfSmallerFaces) {
  Random random(2);
  Tally tally;
  for (const auto& [coarse, fine] : {std::pair{8, 16}, {8, 24}, {8, 40}, {2, 40}})
    for (const double gap : {0.03, 0.003, -0.02}) {
      const Mesh mesh = Together({Sphere({0, 0, 0}, 1, coarse), Reversed(Sphere({0, 0, 0}, 0.97 - gap, fine))});
      Moved moved(mesh);
      moved.MoveRound({0.6, 0, 0.8}, 1, 0.001, 0, random);
      TryDetection(moved, random, tally, "parts-" + std::to_string(fine) + "-gap-" + std::to_string(gap));
    }
  EXPECT_GT(tally.contacts, 100u);
  EXPECT_GE(tally.free, 2);
}

}  // namespace
}  // namespace detect_moved_test
