// SPDX-License-Identifier: MIT
// Components that bound nothing: a step removes those that it turned inside out, and voids whose body it took. All
// others stay as they were, whatever happens elsewhere (P3').
#include <gtest/gtest.h>

#include "support/mesh_building.h"
#include "support/support.h"

namespace swallowed_test {
namespace {

using namespace support;

// A tetrahedron with three corners in the plane z = 0 and the fourth at this height, negative inside out.
Mesh Tetrahedron(double height) {
  Mesh m{{0, 0, 0, 1, 0, 0, 0, 1, 0, .25, .25, height}, {}};
  AddTriangle(m, 0, 2, 1);
  AddTriangle(m, 0, 1, 3);
  AddTriangle(m, 1, 2, 3);
  AddTriangle(m, 2, 0, 3);
  return m;
}

Mesh InsideOut(Mesh m) {
  for (size_t f = 0; f < TriangleCount(m); ++f) std::swap(m.triangles[3 * f], m.triangles[3 * f + 1]);
  return m;
}

Mesh Scaled(const Mesh& m, double by) {
  return Mapped(m, [&](const Point& p) { return support::Scaled(by, p); });
}

// What a step does to a body, with and without others far away that move.
struct Elsewhere {
  const char* name;
  Mesh before, after;
};

std::vector<Elsewhere> PlacesElsewhere() {
  const auto far = [](const Mesh& m) { return Translated(m, {0, 0, 500}); };
  const Mesh pair = far(Together({Sphere({0, 0, 0}, 1, 6), Sphere({2.2, 0, 0}, 1, 6)}));
  const Mesh met = far(Together({Sphere({0.15, 0, 0}, 1, 6), Sphere({2.05, 0, 0}, 1, 6)}));
  const Mesh turns = far(Sphere({0, 0, 0}, 1, 2));
  const Mesh fine = far(Sphere({0, 0, 0}, 1, 40));
  return {{"nothing", {}, {}},
          {"a pair that stays", pair, pair},
          {"a pair that merges", pair, met},
          {"a body that turns inside out", turns,
           Mapped(turns,
                  [](const Point& p) {
                    return Point{-p[0], -p[1], 1000 - p[2]};
                  })},
          {"a fine body", fine, fine},
          {"a fine body that moves", fine, Translated(fine, {0, 0, 1e-9})}};
}

// The positions of the vertices of `near` after a step, in their order; none if they are gone.
std::vector<double> NearAfter(const Mesh& near, const Mesh& moved, const Elsewhere& elsewhere) {
  const Mesh before = Together({near, elsewhere.before}), after = Together({moved, elsewhere.after});
  const Arena arena(ConfigFor(before), before);
  std::vector<uint32_t> vertices;
  std::vector<double> targets;
  for (uint32_t v = 0; v < VertexCount(before); ++v) {
    if (PositionOf(before, v) == PositionOf(after, v)) continue;
    vertices.push_back(v);
    for (double x : PositionOf(after, v)) targets.push_back(x);
  }
  if (!vertices.empty()) {
    EXPECT_EQ(MoveSome(*arena, vertices, targets), TPA_OK);
  }
  EXPECT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_OK) << elsewhere.name;
  const Mesh result = MeshOf(*arena);
  const std::vector<uint32_t> to = OldToNewOf(*arena);
  std::vector<double> positions;
  for (uint32_t v = 0; v < VertexCount(near); ++v)
    if (to[v] != TPA_NONE)
      for (double x : PositionOf(result, to[v])) positions.push_back(x);
  return positions;
}

void ExpectEverywhere(const Mesh& near, const Mesh& moved, const std::vector<double>& wanted) {
  for (const Elsewhere& elsewhere : PlacesElsewhere())
    EXPECT_EQ(NearAfter(near, moved, elsewhere), wanted) << elsewhere.name;
}

// ---------------------------------------------------------------- bodies that the caller loads inside out

TEST(IdleInsideOutBody, StaysWhateverHappensElsewhere) {
  for (double scale : {1e-6, 1.0, 1e2}) {
    const Mesh m = Scaled(InsideOut(Sphere({0, 0, 0}, 1, 2)), scale);
    ExpectEverywhere(m, m, m.positions);
  }
}

TEST(IdleInsideOutBody, StaysIfItIsThin) {
  for (double height : {-1e-3, -1e-9, -1e-14, -1e-17}) {
    const Mesh m = Tetrahedron(height);
    ExpectEverywhere(m, m, m.positions);
  }
}

// Its volume is certain beside the rounding of four faces, and not beside the rounding of all faces elsewhere.
TEST(ThinInsideOutBody, ThatMovesHasTheSameEndWhateverIsElsewhere) {
  for (double height : {-1e-3, -1e-9, -1e-11, -1e-12}) {
    const Mesh m = Tetrahedron(height), moved = Translated(m, {0x1p-10, 0, 0});
    ExpectEverywhere(m, moved, moved.positions);
  }
}

// Thinner than rounding, it has no side before it moves.
TEST(ThinInsideOutBody, GoesAsItMovesIfItsVolumeIsUncertain) {
  const Mesh m = Tetrahedron(-1e-14);
  ExpectEverywhere(m, Translated(m, {0x1p-10, 0, 0}), {});
}

TEST(IdleBodies, InsideEachOtherStayWhateverHappensElsewhere) {
  const Mesh nested = Together({Sphere({0, 0, 0}, 1, 2), Sphere({0, 0, 0}, .5, 2), InsideOut(Sphere({9, 0, 0}, 1, 2)),
                                Sphere({9, 0, 0}, .5, 2)});
  ExpectEverywhere(nested, nested, nested.positions);
}

// ---------------------------------------------------------------- bodies that a step turns inside out

TEST(Body, GoesIfAStepTurnsItInsideOut) {
  for (double scale : {1e-6, 1.0, 1e2})
    for (double to : {-1.0, -1e-6}) {
      const Mesh m = Scaled(Sphere({0, 0, 0}, 1, 2), scale);
      ExpectEverywhere(m, Scaled(m, to), {});
    }
}

TEST(Body, StaysAtAThousandthOfItsSize) {
  const Mesh m = Sphere({0, 0, 0}, 1, 2);
  ExpectEverywhere(m, Scaled(m, 1e-3), Scaled(m, 1e-3).positions);
}

TEST(Void, StaysWithItsBody) {
  const Mesh hollow = Together({Sphere({0, 0, 0}, 1, 4), InsideOut(Sphere({0, 0, 0}, .3, 2))});
  const Mesh moved = Together({Sphere({0, 0, 0}, 1.5, 4), InsideOut(Sphere({0, 0, 0}, .3, 2))});
  ExpectEverywhere(hollow, moved, moved.positions);
}

// The body passes through its void, from all sides to the other side.
TEST(Void, GoesIfItsBodyTurnsInsideOut) {
  const Mesh around = Sphere({0, 0, 0}, 1, 4), gap = InsideOut(Sphere({0, 0, 0}, .3, 2));
  ExpectEverywhere(Together({around, gap}), Together({Scaled(around, -1), gap}), {});
}

// First the body goes, then its void: each counts once.
TEST(Void, IsCountedApartFromItsBody) {
  const Mesh around = Sphere({0, 0, 0}, 1, 4), gap = InsideOut(Sphere({0, 0, 0}, .3, 2));
  const Mesh before = Together({around, gap});
  const Arena arena(ConfigFor(before), before);
  ASSERT_EQ(MoveAll(*arena, Together({Scaled(around, -1), gap}).positions), TPA_OK);
  auto report = Sized<tpa_report>();
  ASSERT_EQ(tpa_step(*arena, nullptr, &report, nullptr), TPA_OK);
  EXPECT_EQ(report.removed_patches, 2u);
  std::vector<uint32_t> removed;
  for (const tpa_event& event : EventsOf(*arena))
    if (event.type == TPA_EVENT_REMOVAL) removed.push_back(event.amount);
  EXPECT_EQ(removed, (std::vector<uint32_t>{VertexCount(around), VertexCount(gap)}));
}

// Outside of all bodies, with its own body left behind, a void is no matter of contacts.
TEST(Void, ThatJumpsOutOfItsBodyHasTheSameEndWhateverHappensElsewhere) {
  const Mesh around = Sphere({0, 0, 0}, 1, 4), gap = InsideOut(Sphere({0, 0, 0}, .3, 2));
  const Mesh moved = Together({around, Translated(gap, {5, 0, 0})});
  ExpectEverywhere(Together({around, gap}), moved, moved.positions);
}

}  // namespace
}  // namespace swallowed_test
