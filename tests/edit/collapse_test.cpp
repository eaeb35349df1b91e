// SPDX-License-Identifier: MIT
// Collapsing two vertices. The judge makes the mesh after the collapse, triangle by triangle, and looks at all of it: a
// manifold of the same topology, free of contacts, without a triangle turned too far?
#include "edit/collapse.h"

#include <algorithm>
#include <set>

#include "support/library_mesh.h"
#include "support/share.h"
#include "support/support.h"

namespace collapse_test {
namespace {

using namespace support;

struct Workbench : ArrangedMesh {
  using ArrangedMesh::ArrangedMesh;
  // Faces as corners in order, from the smallest on.
  std::set<std::array<uint32_t, 3>> Faces() const {
    std::set<std::array<uint32_t, 3>> out;
    for (uint32_t f = 0; f < e.mesh.face_count; ++f)
      if (tpa::face_lives(e.mesh, f)) out.insert(Turned({corners[3 * f], corners[3 * f + 1], corners[3 * f + 2]}));
    return out;
  }
  static std::array<uint32_t, 3> Turned(std::array<uint32_t, 3> v) {
    std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
    return v;
  }
};

tpa::Vec3 At(const Mesh& m, uint32_t v) {
  const Point p = PositionOf(m, v);
  return {p[0], p[1], p[2]};
}
tpa::Vec3 NormalAt(const Mesh& m, const std::array<uint32_t, 3>& v) {
  return tpa::area_normal(At(m, v[0]), At(m, v[1]), At(m, v[2]));
}

std::array<uint32_t, 3> CornersOf(const Mesh& m, uint32_t f) {
  return {m.triangles[3 * f], m.triangles[3 * f + 1], m.triangles[3 * f + 2]};
}

// The mesh after the collapse.
struct Judge {
  std::set<std::array<uint32_t, 3>> faces;
  bool twice = false;   // a triangle appears more than once
  bool turned = false;  // by 60 degrees or more
  bool flat = false;    // no judgement
  bool sound = false;
  double volume = 0;

  Judge(const Mesh& mesh, uint32_t goes, uint32_t stays, const tpa::Vec3& to) {
    Mesh after = mesh;
    const double place[3] = {to.x, to.y, to.z};
    std::copy(place, place + 3, after.positions.begin() + 3 * stays);
    after.triangles.clear();
    for (uint32_t f = 0; f < TriangleCount(mesh); ++f) {
      std::array<uint32_t, 3> v = CornersOf(mesh, f);
      const tpa::Vec3 p = NormalAt(mesh, v);
      std::replace(v.begin(), v.end(), goes, stays);
      if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;
      const tpa::Vec3 q = NormalAt(after, v);
      turned = turned || tpa::dot(p, q) <= 0.5 * tpa::length(p) * tpa::length(q);
      twice = twice || !faces.insert(Workbench::Turned(v)).second;
      after.triangles.insert(after.triangles.end(), v.begin(), v.end());
      flat = flat || tpa::length(q) < 1e-6;
    }
    // Vertices without triangles are left out.
    std::vector<uint32_t> number(VertexCount(mesh), tpa::none);
    Mesh compact;
    for (uint32_t& u : after.triangles) {
      if (number[u] == tpa::none) {
        number[u] = VertexCount(compact);
        const auto at = after.positions.begin() + 3 * u;
        compact.positions.insert(compact.positions.end(), at, at + 3);
      }
      u = number[u];
    }
    compact.triangles = after.triangles;
    if (twice || compact.triangles.empty() || flat) return;
    const Topology before = TopologyOf(mesh), now = TopologyOf(compact);
    volume = now.Volume();
    sound = now.defect.empty() && now.Genera() == before.Genera() && VertexCount(compact) + 1 == VertexCount(mesh) &&
            AllMeetingPairs(compact).empty();
  }
};

// A neighbour of v, or at times any other vertex.
uint32_t SomeNeighbour(const tpa::Mesh& m, uint32_t v, Random& random) {
  std::vector<uint32_t> ring;
  tpa::for_each_outgoing(m, v, [&](uint32_t h) { ring.push_back(tpa::head(m, h)); });
  if (random() % 8 != 0) return ring[random() % ring.size()];
  return (v + 1 + static_cast<uint32_t>(random() % (m.vertex_count - 1))) % m.vertex_count;
}

TEST(Collapse, HappensWhereTheMeshStaysSound) {
  Random random(1);
  const std::vector<Mesh> shapes = {
      Torus({0, 0, 0}, 1, 0.5, 15, 8), Torus({0, 0, 0}, 1, 0.4, 7, 4),
      Sphere({0, 0, 0}, 1, 1),         Sphere({0, 0, 0}, 1, 2),
      Sphere({0, 0, 0}, 1, 4),         Together({Sphere({0, 0, 0}, 1, 4), Sphere({2.02, 0.1, 0.1}, 1, 4)})};
  int done = 0, refused = 0, other = 0;
  for (int i = 0; i < Share(2000); ++i) {
    const Mesh& mesh = shapes[static_cast<size_t>(i) % shapes.size()];
    Workbench w(mesh);
    const auto stays = static_cast<uint32_t>(random() % VertexCount(mesh));
    const uint32_t goes = SomeNeighbour(w.m, stays, random);
    const double reach = i % 3 == 0 ? 0.3 : 0.02;
    const Point by = RandomPoint(random, -reach, reach);
    const tpa::Vec3 to = 0.5 * (At(mesh, goes) + At(mesh, stays)) + tpa::Vec3{by[0], by[1], by[2]};
    const Judge judge(mesh, goes, stays, to);
    if (judge.flat) continue;
    const auto faces_before = w.Faces();
    const tpa::Expected expected = i % 2 == 0 ? tpa::Expected::flat : tpa::Expected::bent;
    const bool collapsed = tpa::collapse(w.e, w.g, goes, stays, to, w.origins[stays], expected, w.marks.data());
    ASSERT_EQ(collapsed, judge.sound && !judge.turned) << i;
    ASSERT_EQ(w.Faces(), collapsed ? judge.faces : faces_before) << i;
    EXPECT_EQ(std::count(w.marks.begin(), w.marks.end(), 0), w.faces);
    // Living half-edges are linked in pairs, and vertices to living faces.
    for (uint32_t h = 0; h < 3 * w.faces; ++h) {
      if (!tpa::face_lives(w.e.mesh, tpa::face_of(h))) continue;
      const uint32_t k = w.opposite[h];
      ASSERT_TRUE(w.opposite[k] == h && tpa::tail(w.e.mesh, k) == tpa::head(w.e.mesh, h)) << i;
      const uint32_t from = w.vertex_edge[w.corners[h]];
      ASSERT_TRUE(tpa::face_lives(w.e.mesh, tpa::face_of(from)) && w.corners[from] == w.corners[h]) << i;
    }
    (collapsed ? done : judge.sound ? refused : other) += 1;
    tpa::rollback(w.e);
    ASSERT_EQ(w.Faces(), faces_before) << i;
  }
  EXPECT_GT(done, Least(400));
  EXPECT_GT(refused, Least(100));
  EXPECT_GT(other, Least(100));
}

// Where `stays` keeps its place, its own faces are as before, and only those that came from `goes` can meet anything:
// each other, its own faces, or others.
TEST(Collapse, OntoAVertexInItsPlaceHappensWhereTheMeshStaysSound) {
  Random random(3);
  int done = 0, turned = 0, meets = 0;
  const Mesh shapes[] = {Torus({0, 0, 0}, 1, 0.3, 12, 5),
                         Together({Sphere({0, 0, 0}, 1, 4), Sphere({0, 0, 0}, 1.05, 4)})};
  for (int i = 0; i < Share(4000); ++i) {
    const double noise = Uniform(random, 0, i % 2 == 0 ? 0.2 : 0.02);
    const Mesh mesh = Mapped(shapes[i % 2], [&](Point p) {
      for (double& x : p) x += Uniform(random, -noise, noise);
      return p;
    });
    if (!AllMeetingPairs(mesh).empty()) continue;
    Workbench w(mesh);
    const auto stays = static_cast<uint32_t>(random() % VertexCount(mesh));
    const uint32_t goes = SomeNeighbour(w.m, stays, random);
    const Judge judge(mesh, goes, stays, At(mesh, stays));
    if (judge.flat) continue;
    const bool collapsed =
        tpa::collapse(w.e, w.g, goes, stays, At(mesh, stays), w.origins[stays], tpa::Expected::bent, w.marks.data());
    ASSERT_EQ(collapsed, judge.sound && !judge.turned) << i;
    (collapsed ? done : judge.turned ? turned : meets) += 1;
  }
  EXPECT_GT(done, Least(400));
  EXPECT_GT(turned, Least(400));
  EXPECT_GT(meets, Least(40));
}

// The volume after the collapse.
double VolumeWith(const Mesh& mesh, uint32_t goes, uint32_t stays, const tpa::Vec3& to) {
  const auto at = [&](uint32_t v) { return v == goes || v == stays ? to : At(mesh, v); };
  double sum = 0;
  for (uint32_t f = 0; f < TriangleCount(mesh); ++f) {
    const auto v = CornersOf(mesh, f);
    sum += tpa::dot(at(v[0]), tpa::cross(at(v[1]), at(v[2])));
  }
  return sum / 6;
}

struct ExpectedPlace {
  tpa::Vec3 to;
  bool keeps_volume;
  bool in_doubt;  // the border of the ball over the edge
};

// The volume is linear in the place, so four volumes tell the nearest place to the middle with the volume of before. If
// it lies beyond the ball over the edge, the place is the middle.
ExpectedPlace PlaceOfCollapse(const Mesh& mesh, uint32_t goes, uint32_t stays) {
  const tpa::Vec3 a = At(mesh, goes), b = At(mesh, stays), middle = 0.5 * (a + b);
  const double at_middle = VolumeWith(mesh, goes, stays, middle), missing = TopologyOf(mesh).Volume() - at_middle;
  const auto slope = [&](double x, double y, double z) {
    return VolumeWith(mesh, goes, stays, middle + tpa::Vec3{x, y, z}) - at_middle;
  };
  const tpa::Vec3 g{slope(1, 0, 0), slope(0, 1, 0), slope(0, 0, 1)};
  const tpa::Vec3 way = missing / tpa::squared_length(g) * g;
  const double share = 2 * tpa::length(way) / tpa::length(b - a);
  const bool keeps = share <= 1;
  return {keeps ? middle + way : middle, keeps, !(std::fabs(share - 1) > 1e-6) || tpa::length(g) < 1e-6};
}

// Bodies as thin as vertices move.
TEST(Collapse, KeepsTheVolumeOrTurnsNoBodyInsideOut) {
  uint32_t done = 0, same_volume = 0, refused_for_that = 0;
  tpa::EdgeAims aims{};
  aims.split = 1e30;
  for (uint64_t seed = 1; seed <= Share(12000u); ++seed) {
    Random random(seed);
    const Mesh mesh = ThinBody(random);
    if (!AllMeetingPairs(mesh).empty()) continue;
    Workbench w(mesh);
    std::vector<uint32_t> labels(w.vertices), queue(w.vertices + 1);
    uint32_t nodes[4];
    tpa::Component list[2];
    tpa::Components c{labels.data(), nodes, 0, {list, 2, 0}};
    tpa::find_components(w.e.mesh, c, queue.data());
    tpa::VolumesOnDemand volumes{c};
    for (int i = 0; i < 20; ++i) {
      const auto stays = static_cast<uint32_t>(random() % w.vertices);
      const uint32_t goes = tpa::head(w.e.mesh, w.vertex_edge[stays]);
      const ExpectedPlace place = PlaceOfCollapse(mesh, goes, stays);
      const Judge judge(mesh, goes, stays, place.to);
      if (place.in_doubt || judge.flat || std::fabs(judge.volume) < 1e-12) continue;
      const double before = TopologyOf(mesh).Volume();
      const bool turns = (judge.volume < 0) != (before < 0), good = judge.sound && !judge.turned;
      const bool collapsed =
          tpa::collapse_short_edge(w.e, w.g, goes, stays, aims, w.marks.data(), volumes) == tpa::Collapse::done;
      ASSERT_EQ(collapsed, good && !turns) << "seed " << seed << ", " << i;
      refused_for_that += good && turns ? 1u : 0u;
      if (!collapsed) continue;
      ++done;
      EXPECT_LT(tpa::length(w.e.mesh.position[stays] - place.to), 1e-9) << "seed " << seed;
      EXPECT_NEAR(c.list[0].volume.sum, 6 * judge.volume, c.list[0].volume.doubt + 1e-14) << "seed " << seed;
      if (place.keeps_volume) {
        ++same_volume;
        EXPECT_NEAR(judge.volume, before, 1e-9 * std::fabs(before)) << "seed " << seed;
      }
      break;
    }
  }
  EXPECT_GT(done, Least(900u));
  EXPECT_GT(same_volume, Least(600u));
  EXPECT_GT(refused_for_that, Least(10u));
}

}  // namespace
}  // namespace collapse_test
