// SPDX-License-Identifier: MIT
// The memory of a context from step to step makes no difference: a copy without the memory does the same.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "block/context.h"
#include "support/library_mesh.h"
#include "support/share.h"
#include "support/step_scenes.h"
#include "support/tangle_shapes.h"

namespace step_memory_test {
namespace {

using namespace support;

// The number of components after, from the number before and the events.
int64_t ComponentsAfter(int64_t before, const std::vector<tpa_event>& events) {
  return before + ComponentsMade(events);
}

TEST(Memory, ComponentsAreKnownFromStepToStep) {
  // Remembered components make no difference: tpa_validate makes a copy forget them.
  size_t changes = 0;
  for (uint64_t seed = 1; seed <= Share(10u); ++seed) {
    Random random(seed);
    const Mesh m = Together({Sphere({0, 0, 0}, 1, 4), Torus({2.4, 0, 0}, 0.9, 0.35, 12, 6), Sphere({0, 2.2, 0}, 1, 4)});
    tpa_config config = DefaultConfig(4000);
    config.max_contacts = 10000;  // noise crumples fine faces
    config.max_pieces = 41000;
    Arena arena(config, m);
    for (int step = 0; step < 6; ++step) {
      const Mesh before = MeshOf(*arena);
      if (before.positions.empty()) break;
      const double size = step % 2 == 0 ? 0.002 : Uniform(random, 0.05, 0.3);
      std::vector<double> targets = before.positions;
      for (double& x : targets) x = (step % 2 == 0 ? 1 : 0.9) * x + Uniform(random, -size, size);
      ASSERT_EQ(MoveAll(*arena, targets), TPA_OK);
      Arena copy(config);
      std::memcpy(copy.block(), arena.block(), arena.size().bytes);
      auto validation = Sized<tpa_validation>();
      ASSERT_EQ(tpa_validate(*copy, nullptr, &validation, nullptr), TPA_OK);
      tpa_issue issue;
      for (tpa_context* context : {*arena, *copy})
        ASSERT_EQ(tpa_step(context, nullptr, nullptr, &issue), TPA_OK) << Text(issue);
      EXPECT_EQ(Observe(*arena), Observe(*copy)) << "seed " << seed << " step " << step;
      const auto parts = [](const Mesh& mesh) { return static_cast<int64_t>(TopologyOf(mesh).components.size()); };
      EXPECT_EQ(ComponentsAfter(parts(before), EventsOf(*arena)), parts(MeshOf(*arena)))
          << "seed " << seed << " step " << step;
      changes += EventsOf(*arena).empty() ? 0u : 1u;
      auto options = Sized<tpa_remesh_options>();
      options.iterations = 1;
      options.target_length = 0.4;
      if (Uniform(random, 0, 1) < 0.3) {
        ASSERT_EQ(tpa_remesh(*arena, &options, nullptr, nullptr, nullptr), TPA_OK);
      }
    }
  }
  EXPECT_GT(changes, Least<size_t>(15));
}

// The largest distance of vertices of a component, in the sum of coordinates: the largest extent along four directions.
double FarthestApart(const Mesh& m, const tpa::Components& components, uint32_t component) {
  double farthest = 0;
  for (const Point& way : {Point{1, 1, 1}, Point{1, 1, -1}, Point{1, -1, 1}, Point{1, -1, -1}}) {
    double low = 1e300, high = -1e300;
    for (uint32_t v = 0; v < VertexCount(m); ++v) {
      if (tpa::component_of(components, v) != component) continue;
      const Point p = PositionOf(m, v);
      const double at = way[0] * p[0] + way[1] * p[1] + way[2] * p[2];
      low = std::min(low, at), high = std::max(high, at);
    }
    farthest = std::max(farthest, high - low);
  }
  return farthest;
}

// Counts the known volumes of a context, and compares each with the mesh, within its doubt.
size_t KnownVolumes(tpa_context* context, const Mesh& m) {
  tpa::Context& c = *reinterpret_cast<tpa::Context*>(context);
  const Topology topology = TopologyOf(m);
  if (!c.components_known) return 0;
  const tpa::Workspace w = tpa::open(c);
  EXPECT_EQ(w.before.list.size, topology.components.size());
  size_t known = 0;
  for (uint32_t i = 0; i < w.before.list.size; ++i) {
    const tpa::Component& part = w.before.list[i];
    EXPECT_EQ(part.id, topology.components[i].smallest_vertex);
    EXPECT_EQ(2 - 2 * topology.components[i].genus, part.euler / 2);
    if (part.volume.doubt == tpa::unknown_volume) continue;
    // The sum of the oracle has an error as well.
    EXPECT_NEAR(part.volume.sum, 6 * topology.components[i].volume, part.volume.doubt + 1e-11);
    EXPECT_LT(part.volume.doubt, 1e-4);
    ++known;
    EXPECT_LE(FarthestApart(m, w.before, i), part.size);
  }
  return known;
}

// Does the context keep an arrangement? If so, compares it with the mesh.
bool KeepsArrangement(tpa_context* context) {
  tpa::Context& c = *reinterpret_cast<tpa::Context*>(context);
  if (!c.near_faces_stand) return false;
  tpa::Workspace w = tpa::open(c);
  tpa::resume(w.near_faces, w.edit.mesh, w.tree, c.tree);
  ExpectArranged(w.near_faces, w.edit.mesh);
  return true;
}

TEST(Memory, AFewThatMoveAreSeenAsInAFullDetection) {
  // A context keeps the arrangement of the mesh from step to step, through events and remeshing. A copy forgets, and
  // arranges anew.
  size_t quiet = 0, eventful = 0, most_contacts = 0, known_volumes = 0, stood = 0, kept = 0;
  const Mesh fine = Together({Sphere({0, 0, 0}, 1, 12), Torus({2.2, 0, 0}, 0.8, 0.25, 30, 12),
                              Sphere({0, 2.2, 0}, 1, 10), Sphere({0, 0, 0}, .7, 8)});
  // Coarse faces are halved as fine faces come through, and attempts are rolled back.
  const Mesh coarse = Together({fine, Box({-1, -1, -1.4}, {1, 1, -1.1}, 1), Box({-1.4, -1, -1}, {-1.1, 1, 1}, 1)});
  for (uint64_t seed = 1; seed <= Share(6u); ++seed) {
    Random random(seed);
    const bool plates = seed % 3 == 2;
    const Mesh m = Renumbered(plates ? coarse : fine, random);
    const tpa_config config = DefaultConfig(3 * VertexCount(m));
    Arena arena(config, m);
    for (int step = 0; step < (plates ? 15 : 30); ++step) {
      const Mesh before = MeshOf(*arena);
      const Point place = PositionOf(before, random() % VertexCount(before)), way = RandomPoint(random, -1, 1);
      const double reach = Uniform(random, .1, .4), size = step % 3 == 0 ? 1 : step % 3 == 1 ? .3 : .05;
      std::vector<uint32_t> vertices;
      std::vector<double> targets;
      for (uint32_t v = 0; v < VertexCount(before); ++v) {
        const Point p = PositionOf(before, v);
        const double far = Distance(p, place) / reach;
        if (far >= 1) continue;
        vertices.push_back(v);
        for (size_t k = 0; k < 3; ++k) targets.push_back(p[k] + (1 - far * far) * size * way[k]);
      }
      Arena copy(config);
      std::memcpy(copy.block(), arena.block(), arena.size().bytes);
      stood += reinterpret_cast<tpa::Context*>(*copy)->near_faces_stand ? 1u : 0u;
      reinterpret_cast<tpa::Context*>(*copy)->near_faces_stand = false;
      tpa_report reports[2] = {Sized<tpa_report>(), Sized<tpa_report>()};
      tpa_context* const contexts[2] = {*arena, *copy};
      for (int i = 0; i < 2; ++i) {
        ASSERT_EQ(MoveSome(contexts[i], vertices, targets), TPA_OK);
        ASSERT_EQ(tpa_step(contexts[i], nullptr, &reports[i], nullptr), TPA_OK);
      }
      EXPECT_EQ(reports[0].contacts, reports[1].contacts) << "seed " << seed << " step " << step;
      EXPECT_EQ(MeshOf(*arena).positions, MeshOf(*copy).positions) << "seed " << seed << " step " << step;
      EXPECT_EQ(MeshOf(*arena).triangles, MeshOf(*copy).triangles) << "seed " << seed << " step " << step;
      EXPECT_EQ(OldToNewOf(*arena), OldToNewOf(*copy)) << "seed " << seed << " step " << step;
      EXPECT_EQ(TriangleOriginsOf(*arena), TriangleOriginsOf(*copy)) << "seed " << seed << " step " << step;
      ASSERT_TRUE(IsSound(MeshOf(*arena), "few-seed-" + std::to_string(seed))) << "seed " << seed << " step " << step;
      known_volumes += KnownVolumes(*arena, MeshOf(*arena));
      kept += KeepsArrangement(*arena) ? 1u : 0u;
      ++(reports[0].contacts == 0 ? quiet : eventful);
      most_contacts = std::max<size_t>(most_contacts, reports[0].contacts);
      auto remesh = Sized<tpa_remesh_options>();
      remesh.iterations = 1;
      remesh.target_length = .2;
      if (random() % 8 == 0) {
        ASSERT_EQ(tpa_remesh(*arena, &remesh, nullptr, nullptr, nullptr), TPA_OK);
      }
    }
  }
  EXPECT_GT(stood, Least<size_t>(60));
  EXPECT_GT(kept, Least<size_t>(60));
  EXPECT_GT(quiet, Least<size_t>(20));
  EXPECT_GT(eventful, Least<size_t>(10));
  EXPECT_GT(most_contacts, Least<size_t>(30));
  EXPECT_GT(known_volumes, Least<size_t>(200));
}

// Moves vertices of the inner side of a shell, near a place, outwards, or inwards if `way` < 0. Did they meet anything?
bool PushOut(tpa_context* context, const Point& direction, double inner, double way) {
  const Mesh m = MeshOf(context);
  std::vector<uint32_t> vertices;
  std::vector<double> targets;
  for (uint32_t v = 0; v < VertexCount(m); ++v) {
    const Point p = PositionOf(m, v);
    const double far = Distance(p, Scaled(inner, direction)) / .3;
    if (far >= 1 || Distance(p, {0, 0, 0}) > inner + .01) continue;
    vertices.push_back(v);
    for (size_t k = 0; k < 3; ++k) targets.push_back(p[k] + (1 - far * far) * way * direction[k]);
  }
  auto report = Sized<tpa_report>();
  EXPECT_EQ(MoveSome(context, vertices, targets), TPA_OK);
  EXPECT_EQ(tpa_step(context, nullptr, &report, nullptr), TPA_OK);
  return report.contacts > 0;
}

TEST(Memory, VolumesOfThinBodiesAreKnown) {
  // Twenty thousand vertices, three million times as wide as thick. An error growing with the square of the number of
  // triangles might turn the sign of the volume.
  Mesh m = Sphere({0, 0, 0}, 1, 70);
  for (size_t at = 2; at < m.positions.size(); at += 3) m.positions[at] *= 3e-7;
  Arena arena(DefaultConfig(VertexCount(m)), m);
  std::vector<double> doubts;
  for (int step = 0; step < 3; ++step) {
    // Each time other places become a little thicker.
    const Mesh now = MeshOf(*arena);
    std::vector<uint32_t> vertices;
    std::vector<double> targets;
    for (uint32_t v = static_cast<uint32_t>(step); vertices.size() < 20; v += 3) {
      const Point p = PositionOf(now, v);
      vertices.push_back(v);
      targets.insert(targets.end(), {p[0], p[1], 1.01 * p[2]});
    }
    ASSERT_EQ(MoveSome(*arena, vertices, targets), TPA_OK);
    ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_OK);
    EXPECT_EQ(KnownVolumes(*arena, MeshOf(*arena)), 1u);
    const tpa::Component part = tpa::open(*reinterpret_cast<tpa::Context*>(*arena)).before.list[0];
    EXPECT_GT(part.volume.sum, 100 * part.volume.doubt);
    doubts.push_back(part.volume.doubt);
  }
  // Each move adds a change to the known volume, with a doubt. Measuring anew would give no larger a doubt than the
  // first time.
  EXPECT_LT(doubts[0], doubts[1]);
  EXPECT_LT(doubts[1], doubts[2]);
}

// Counts marks of faces and vertices, and members of clusters. Between calls there are none.
size_t MarksIn(const tpa::Workspace& w) {
  size_t marks = 0;
  for (uint32_t f = 0; f < w.edit.mesh.face_capacity; ++f) marks += w.relocation.face_mark[f] != 0 ? 1u : 0u;
  for (uint32_t v = 0; v < w.edit.mesh.vertex_capacity; ++v)
    marks +=
        (w.relocation.vertex_mark[v] | w.relocation.star[v] | w.marks[v]) != 0 || w.clusters.cluster[v] != tpa::none;
  return marks;
}

TEST(Memory, FacesThatFoldOntoThemselvesLeaveNoMarks) {
  // A corner moves onto the middle of the edge across. The faces round the corner touch the edge, but the face with
  // both is in no contact. A mark left behind would hide this face from the next step.
  const Mesh box = Box({0, 0, 0}, {4, 4, 4}, 4);
  const Mesh m = Together({box, Sphere({2, 2, 6}, .1, 3)});
  size_t contacts = 0, through = 0;
  for (size_t t = 0; t < TriangleCount(box); t += Stride())
    for (size_t k = 0; k < 3; ++k) {
      const auto corner = [&](size_t i) { return m.triangles[3 * t + (k + i) % 3]; };
      const Point middle = Scaled(.5, Sum(PositionOf(m, corner(1)), PositionOf(m, corner(2))));
      Arena arena(ConfigFor(m), m);
      ASSERT_EQ(MoveSome(*arena, {corner(0)}, {middle[0], middle[1], middle[2]}), TPA_OK);
      auto report = Sized<tpa_report>();
      ASSERT_EQ(tpa_step(*arena, nullptr, &report, nullptr), TPA_OK);
      contacts += report.contacts;
      ASSERT_EQ(MarksIn(tpa::open(*reinterpret_cast<tpa::Context*>(*arena))), 0u)
          << "triangle " << t << ", corner " << k;
      // On the side of the box below the ball, a spike of the ball goes through the folded faces.
      if (middle[2] < 4) continue;
      const Mesh now = MeshOf(*arena);
      uint32_t lowest = 0;
      for (uint32_t v = 0; v < VertexCount(now); ++v) {
        const bool of_ball = PositionOf(now, v)[2] > 5;
        if (of_ball && (lowest == 0 || PositionOf(now, v)[2] < PositionOf(now, lowest)[2])) lowest = v;
      }
      ASSERT_EQ(MoveSome(*arena, {lowest}, {middle[0] + .01, middle[1] + .02, 3}), TPA_OK);
      ASSERT_EQ(tpa_step(*arena, nullptr, &report, nullptr), TPA_OK);
      EXPECT_TRUE(IsSound(MeshOf(*arena), "folded")) << "triangle " << t << ", corner " << k;
      through += report.contacts > 0 ? 1u : 0u;
    }
  EXPECT_GT(contacts, 100u);
  EXPECT_GT(through, 10u);
}

TEST(Memory, EventsDoNotMakeComponentsLarger) {
  // With a size far too large no volume is certain, and all are measured anew.
  constexpr double inner = .85;
  const Mesh m = Together({Sphere({0, 0, 0}, 1, 16), Reversed(Sphere({0, 0, 0}, inner, 16))});
  Arena arena(DefaultConfig(2 * VertexCount(m)), m);
  uint32_t events = 0, known = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (double side : {-1., 1.})
      for (double beyond : {.18, -.02}) {
        // The other side is .15 away. The moves without contacts are elsewhere.
        Point direction = beyond > 0 ? Point{} : Point{.6, .6, .6};
        direction[static_cast<size_t>(axis)] = side;
        events += PushOut(*arena, Unit(direction), inner, beyond) ? 1u : 0u;
        const tpa::Workspace w = tpa::open(*reinterpret_cast<tpa::Context*>(*arena));
        for (uint32_t i = 0; i < w.before.list.size; ++i) {
          if (w.before.list[i].volume.doubt == tpa::unknown_volume) continue;
          ++known;
          EXPECT_LT(w.before.list[i].size, 4 * FarthestApart(MeshOf(*arena), w.before, i)) << axis << " " << side;
        }
      }
  EXPECT_EQ(events, 6u);
  EXPECT_GT(known, 10u);
}

}  // namespace
}  // namespace step_memory_test
