// SPDX-License-Identifier: MIT
// Trial faces: the library is asked about the faces of an operation before they are made. The judge makes the faces, in
// a mesh of its own, and tries each new triangle with all others.
#include "detect/new_faces.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "detect/hub_stars.h"
#include "support/library_mesh.h"
#include "support/share.h"
#include "support/support.h"

namespace new_faces_test {
namespace {

using namespace support;

// The library's view of a mesh, with NearFaces.
struct Workbench : LibraryMesh, NearFacesWithMemory {
  std::vector<uint8_t> going;

  explicit Workbench(const Mesh& mesh)
      : LibraryMesh(mesh), NearFacesWithMemory(VertexCount(mesh), TriangleCount(mesh)), going(TriangleCount(mesh)) {
    Arrange(m);
  }
  static tpa::Vec3 At(const Point& p) { return {p[0], p[1], p[2]}; }
};

// Is one of the triangles in contact with any?
bool AnyMeets(const Mesh& m, const std::vector<uint32_t>& faces) {
  for (uint32_t f : faces)
    for (uint32_t other = 0; other < TriangleCount(m); ++other)
      if (other != f && TrianglesMeet(m, f, other)) return true;
  return false;
}

uint32_t CommonNeighbours(const tpa::Mesh& m, uint32_t a, uint32_t b) {
  uint32_t common = 0;
  tpa::for_each_outgoing(m, a, [&](uint32_t h) {
    tpa::for_each_outgoing(m, b, [&](uint32_t k) { common += tpa::head(m, h) == tpa::head(m, k); });
  });
  return common;
}

std::pair<uint32_t, uint32_t> AnyEdge(const Mesh& m, Random& random) {
  const size_t h = random() % m.triangles.size();
  return {m.triangles[h], m.triangles[h % 3 == 2 ? h - 2 : h + 1]};
}

// The faces round an edge alone, closed by a cone to a point far off; the ends of the edge come first.
Mesh StarOf(const Mesh& mesh, uint32_t a, uint32_t b) {
  std::vector<uint32_t> number(VertexCount(mesh), tpa::none);
  Mesh star;
  const auto id = [&](uint32_t v) {
    if (number[v] == tpa::none) {
      number[v] = VertexCount(star);
      star.positions.insert(star.positions.end(), mesh.positions.begin() + 3 * v, mesh.positions.begin() + 3 * v + 3);
    }
    return number[v];
  };
  id(a), id(b);
  std::map<std::pair<uint32_t, uint32_t>, bool> border;
  for (uint32_t f = 0; f < TriangleCount(mesh); ++f) {
    const uint32_t* v = mesh.triangles.data() + 3 * f;
    if (std::count(v, v + 3, a) + std::count(v, v + 3, b) == 0) continue;
    for (uint32_t i = 0; i < 3; ++i) {
      star.triangles.push_back(id(v[i]));
      const std::pair<uint32_t, uint32_t> edge{id(v[i]), id(v[(i + 1) % 3])}, other{edge.second, edge.first};
      if (!border.erase(other)) border[edge] = true;
    }
  }
  const uint32_t apex = VertexCount(star);
  star.positions.insert(star.positions.end(), {30, 20, 10});
  for (const auto& [edge, is_border] : border)
    star.triangles.insert(star.triangles.end(), {edge.second, edge.first, apex});
  return star;
}

struct Tally {
  int free = 0, not_free = 0;
};
void ExpectBoth(const Tally& tally, int least) {
  EXPECT_GT(tally.free, Least(least));
  EXPECT_GT(tally.not_free, Least(least));
}

// Contracts the edge from a to b, which moves to `to`: does the library foresee whether anything meets?
void TryCollapse(const Mesh& mesh, uint32_t a, uint32_t b, const Point& to, Random& random, Tally& tally) {
  Workbench w(mesh);
  Mesh after = mesh;
  std::copy(to.begin(), to.end(), after.positions.begin() + 3 * b);
  w.positions[b] = Workbench::At(to);
  std::vector<uint32_t> made;
  std::vector<tpa::FaceCorners> trials;
  after.triangles.clear();
  for (uint32_t f = 0; f < TriangleCount(mesh); ++f) {
    std::array<uint32_t, 3> v{mesh.triangles[3 * f], mesh.triangles[3 * f + 1], mesh.triangles[3 * f + 2]};
    w.going[f] = std::count(v.begin(), v.end(), a) + std::count(v.begin(), v.end(), b) > 0;
    std::replace(v.begin(), v.end(), a, b);
    if (std::count(v.begin(), v.end(), b) == 2) continue;
    if (w.going[f]) {
      std::rotate(v.begin(), std::find(v.begin(), v.end(), b), v.end());
      made.push_back(TriangleCount(after));
      trials.push_back({{v[0], v[1], v[2]}});
    }
    after.triangles.insert(after.triangles.end(), v.begin(), v.end());
  }
  // The judge knows no triangles without an area.
  for (const tpa::FaceCorners& t : trials)
    if (tpa::squared_length(tpa::normal_of(w.m, t)) < 1e-12) return;
  // In any order: a fan is found all the same.
  if (random() % 2 == 0) std::shuffle(trials.begin(), trials.end(), random);
  const bool free = !AnyMeets(after, made);
  // The expected surface decides on the first proof, not on the answer.
  const uint32_t count = static_cast<uint32_t>(trials.size());
  for (tpa::Expected expected : {tpa::Expected::flat, tpa::Expected::bent})
    EXPECT_EQ(tpa::trials_are_free(w.m, w.g, w.going.data(), trials.data(), count, expected), free)
        << Written(after, "collapse-" + std::to_string(a) + "-to-" + std::to_string(b));
  ++(free ? tally.free : tally.not_free);
}

void TryCollapse(const Mesh& mesh, uint32_t a, uint32_t b, const Point& to, bool alone, Random& random, Tally& tally) {
  if (CommonNeighbours(LibraryMesh(mesh).m, a, b) != 2) return;
  if (alone)
    TryCollapse(StarOf(mesh, a, b), 0, 1, to, random, tally);
  else
    TryCollapse(mesh, a, b, to, random, tally);
}

Mesh Shaken(const Mesh& m, double by, Random& random) {
  return Mapped(m, [&](Point p) {
    for (double& x : p) x += Uniform(random, -by, by);
    return p;
  });
}

TEST(Trial, AStarIsFreeWhereNoneOfItsFacesMeetsAny) {
  Random random(1);
  Tally tally;
  for (int i = 0; i < Share(2000); ++i) {
    const bool alone = i % 4 < 2;
    const double edge = 0.4, noise = edge * Uniform(random, 0, alone ? 1 : 0.5);
    const Mesh mesh = Shaken(i % 2 == 0 ? Torus({0, 0, 0}, 1, 0.5, 15, 8)
                                        : Together({Sphere({0, 0, 0}, 1, 4), Sphere({1.9, 0.1, 0.1}, 1, 4)}),
                             noise, random);
    const auto [a, b] = AnyEdge(mesh, random);
    Point to = PositionOf(mesh, b);
    const double reach = edge * (i % 3 == 0 ? 2 : 0.3);
    for (size_t c = 0; c < 3; ++c) to[c] = 0.5 * (to[c] + PositionOf(mesh, a)[c]) + Uniform(random, -reach, reach);
    TryCollapse(mesh, a, b, to, alone, random, tally);
  }
  ExpectBoth(tally, 100);
}

// Flat sides: the filters of the predicates see only zeros, or cannot tell a sign.
TEST(Trial, OnFlatSides) {
  Random random(2);
  Tally tally;
  const Mesh straight = Box({0, 0, 0}, {1, 1, 1}, 4);
  const auto turn = [](Point p) {
    return Point{0.36 * p[0] - 0.8 * p[1] + 0.48 * p[2], 0.48 * p[0] + 0.6 * p[1] + 0.64 * p[2],
                 0.6 * p[2] - 0.8 * p[0]};
  };
  for (int i = 0; i < Share(400); ++i) {
    const Mesh mesh = i % 2 == 0 ? straight : Mapped(straight, turn);
    const auto [a, b] = AnyEdge(mesh, random);
    Point to = PositionOf(mesh, b);
    const bool alone = i % 4 < 2;
    Point by{0, 0, 0};
    if (i % 3 != 0)
      for (double& x : by) x = 0.25 * static_cast<double>(random() % 3) - 0.25;
    if (i % 2 != 0) by = turn(by);
    for (size_t c = 0; c < 3; ++c) to[c] += by[c];
    TryCollapse(mesh, a, b, to, alone, random, tally);
  }
  ExpectBoth(tally, 30);
}

bool IsFree(const Workbench& w, const tpa::FaceCorners& trial) {
  return tpa::trials_are_free(w.m, w.g, nullptr, &trial, 1, tpa::Expected::bent);
}

// A triangle in space, with some corners of the mesh.
TEST(Trial, AFaceIsFreeWhereItMeetsNone) {
  Random random(3);
  Tally tally;
  for (int i = 0; i < Share(2000); ++i) {
    Mesh mesh = Shaken(Sphere({0, 0, 0}, 1, 4), 0.1, random);
    Workbench w(mesh);
    const uint32_t n = VertexCount(mesh);
    uint32_t v[3];
    for (uint32_t c = 0; c < 3; ++c) {
      // Some corners are those of the mesh.
      v[c] = random() % 2 == 0 ? static_cast<uint32_t>(random() % n) : n + c;
      const Point p = RandomPoint(random, -1.3, 1.3);
      mesh.positions.insert(mesh.positions.end(), p.begin(), p.end());
      w.positions.push_back(Workbench::At(p));
    }
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;
    w.m.position = w.positions.data();
    mesh.triangles.insert(mesh.triangles.end(), v, v + 3);
    const bool free = !AnyMeets(mesh, {TriangleCount(mesh) - 1});
    EXPECT_EQ(IsFree(w, {{v[0], v[1], v[2]}}), free) << Written(mesh, "face-" + std::to_string(i));
    ++(free ? tally.free : tally.not_free);
  }
  ExpectBoth(tally, 100);
}

// Adds a vertex to both.
uint32_t AddVertex(Mesh& mesh, Workbench& w, const Point& p) {
  mesh.positions.insert(mesh.positions.end(), p.begin(), p.end());
  w.positions.push_back(Workbench::At(p));
  w.m.position = w.positions.data();
  return VertexCount(mesh) - 1;
}

Point Beside(const Point& p, double by, Random& random) {
  Point beside = p;
  for (double& x : beside) x += Uniform(random, -by, by);
  return beside;
}

// Does the library see whether any of the faces meets another face or the mesh?
void TrySome(Mesh mesh, const Workbench& w, const std::vector<tpa::FaceCorners>& trials, const std::string& name,
             Tally& tally) {
  std::vector<uint32_t> made;
  for (const tpa::FaceCorners& t : trials) {
    if (tpa::squared_length(tpa::normal_of(w.m, t)) < 1e-12) return;
    made.push_back(TriangleCount(mesh));
    mesh.triangles.insert(mesh.triangles.end(), t.v, t.v + 3);
  }
  const bool free = !AnyMeets(mesh, made);
  const uint32_t n = static_cast<uint32_t>(trials.size());
  EXPECT_EQ(tpa::trials_are_free(w.m, w.g, nullptr, trials.data(), n, tpa::Expected::bent), free)
      << Written(mesh, name);
  ++(free ? tally.free : tally.not_free);
}

// Up to the most trial faces, in a row round the sphere, each with an edge of the face before.
TEST(Trial, AStripIsFreeWhereNoneOfItsFacesMeetsAny) {
  Random random(5);
  Tally tally;
  for (int i = 0; i < Share(2000); ++i) {
    Mesh mesh = Sphere({0, 0, 0}, 1, 4);
    Workbench w(mesh);
    const uint32_t faces = 1 + static_cast<uint32_t>(random() % tpa::largest_star), first = VertexCount(mesh);
    const double away = Uniform(random, 0, 0.2), noise = Uniform(random, 0, 0.1);
    for (uint32_t k = 0; k < faces + 2; ++k) {
      const double turn = 2 * 3.2 * k / (tpa::largest_star + 2), height = k % 2 == 0 ? 0 : 0.1;
      AddVertex(mesh, w, Beside({(1 + away) * std::cos(turn), (1 + away) * std::sin(turn), height}, noise, random));
    }
    std::vector<tpa::FaceCorners> trials;
    for (uint32_t k = first; k < first + faces; ++k) trials.push_back({{k, k + 1 + k % 2, k + 2 - k % 2}});
    TrySome(mesh, w, trials, "strip-" + std::to_string(i), tally);
  }
  ExpectBoth(tally, 100);
}

// The second and third corners go round; the faces begin with one vertex, or with two, and need not be a fan.
TEST(Trial, FacesRoundARingAreFreeWhereNoneMeetsAny) {
  Random random(6);
  Tally tally;
  for (int i = 0; i < Share(2000); ++i) {
    Mesh mesh = Sphere({0, 0, 0}, 1, 4);
    Workbench w(mesh);
    const uint32_t n = 3 + static_cast<uint32_t>(random() % 8), first = VertexCount(mesh);
    const double noise = Uniform(random, 0, 0.05);
    for (uint32_t k = 0; k < n; ++k) {
      const double turn = 2 * 3.14159265 * k / n;
      AddVertex(mesh, w, Beside({0.2 * std::cos(turn), 0.2 * std::sin(turn), 1.5}, noise, random));
    }
    const uint32_t apex[2] = {AddVertex(mesh, w, Beside({0, 0, 1.6}, noise, random)),
                              AddVertex(mesh, w, Beside({0, 0, 1.6}, noise, random))};
    std::vector<tpa::FaceCorners> trials;
    for (uint32_t k = 0; k < n; ++k) {
      const uint32_t begin = apex[i % 2 == 0 ? 0 : random() % 2];
      trials.push_back({{begin, first + k, first + (k + 1) % n}});
    }
    TrySome(mesh, w, trials, "ring-" + std::to_string(i), tally);
  }
  ExpectBoth(tally, 100);
}

// Two cones over a ring, of different heights, with a second ring half the way up each.
Mesh ConesWithRings(uint32_t valence) {
  Mesh m;
  m.positions = {0, 0, .5, 0, 0, -.8};
  const double radius[] = {1, .5, .5}, height[] = {0, .25, -.4};
  for (size_t ring = 0; ring < 3; ++ring)
    for (uint32_t i = 0; i < valence; ++i) {
      const double angle = 6.283185307179586 * i / valence;
      m.positions.insert(m.positions.end(),
                         {radius[ring] * std::cos(angle), radius[ring] * std::sin(angle), height[ring]});
    }
  for (uint32_t i = 0; i < valence; ++i) {
    const uint32_t a = 2 + i, b = 2 + (i + 1) % valence, c = a + valence, d = b + valence, e = c + valence,
                   f = d + valence;
    m.triangles.insert(m.triangles.end(), {0, c, d, c, a, b, c, b, d, 1, f, e, e, b, a, e, f, b});
  }
  return m;
}

// Vertices beside a hub move, one after the other, if the faces round them are free. The proof of the hub's star goes
// on from each to the next.
void MoveBesideHubs(uint64_t seed, Tally& tally) {
  Random random(seed);
  constexpr uint32_t valence = 90;
  Mesh mesh = ConesWithRings(valence);
  Workbench w(mesh);
  ASSERT_TRUE(w.tree.has_hubs);
  w.m.face_capacity = w.m.face_count;
  tpa::HubStars hubs;
  w.g.hubs = &hubs;
  for (int i = 0; i < 25; ++i) {
    const uint32_t v = 2 + valence + static_cast<uint32_t>(random() % (2 * valence));
    std::vector<tpa::FaceCorners> trials;
    std::vector<uint32_t> faces;
    tpa::for_each_outgoing(w.m, v, [&](uint32_t h) {
      trials.push_back({{v, tpa::head(w.m, h), tpa::apex(w.m, h)}});
      faces.push_back(tpa::face_of(h));
    });
    const auto n = static_cast<uint32_t>(trials.size());
    tpa::know_stars(hubs, w.m, nullptr, trials.data(), n);
    const Point old = PositionOf(mesh, v);
    const double by = i % 3 == 0 ? .02 : .9;
    for (size_t k = 0; k < 3; ++k) mesh.positions[3 * v + k] += Uniform(random, -by, by);
    const auto place = [&] { w.positions[v] = Workbench::At(PositionOf(mesh, v)); };
    place();
    for (const uint32_t f : faces) w.going[f] = 1;
    const bool free = tpa::trials_are_free(w.m, w.g, w.going.data(), trials.data(), n, tpa::Expected::flat);
    for (const uint32_t f : faces) w.going[f] = 0;
    ASSERT_EQ(free, !AnyMeets(mesh, faces)) << "seed " << seed << ", move " << i;
    ++(free ? tally.free : tally.not_free);
    if (free && i % 4 != 3) {
      for (const uint32_t f : faces) tpa::insert(w.g, w.m, f);
    } else {
      std::copy(old.begin(), old.end(), mesh.positions.begin() + 3 * v);
      place();
    }
  }
}

TEST(Trial, BesideHubsFacesAreFreeWhereNoneMeetsAny) {
  Tally tally;
  for (uint64_t seed = 1; seed <= Share(5u); ++seed) MoveBesideHubs(seed, tally);
  ExpectBoth(tally, 20);
}

// A flat ring between a rim of many corners and a shaft of few, thick but for a twentieth: two fans of coplanar needles
// at each corner of the shaft.
Mesh NeedleRing(uint32_t rim, uint32_t shaft) {
  Mesh m;
  const uint32_t sides[] = {rim, rim, shaft, shaft};
  const double radius[] = {1, 1, .2, .2}, height[] = {-.05, .05, .05, -.05};
  uint32_t first[4];
  for (size_t ring = 0; ring < 4; ++ring) {
    first[ring] = VertexCount(m);
    for (uint32_t i = 0; i < sides[ring]; ++i) {
      const double turn = 6.283185307179586 * i / sides[ring];
      m.positions.insert(m.positions.end(),
                         {radius[ring] * std::cos(turn), radius[ring] * std::sin(turn), height[ring]});
    }
  }
  for (size_t ring = 0; ring < 4; ++ring) {
    const uint32_t a = first[ring], b = first[(ring + 1) % 4], of_a = sides[ring], of_b = sides[(ring + 1) % 4];
    for (uint32_t i = 0, k = 0; i < of_a || k < of_b;) {
      const uint32_t from = a + i % of_a, to = b + k % of_b;
      if (k == of_b || (i < of_a && i * of_b <= k * of_a))
        m.triangles.insert(m.triangles.end(), {from, a + ++i % of_a, to});
      else
        m.triangles.insert(m.triangles.end(), {from, b + (k + 1) % of_b, to}), ++k;
    }
  }
  return m;
}

// The ends of an edge meet in its middle, at one of them, or beside, within the plane or off.
TEST(Trial, AmongCoplanarNeedlesFacesAreFreeWhereNoneMeetsAny) {
  Random random(7);
  Tally tally;
  const Mesh straight = NeedleRing(40, 4),
             tilted = Mapped(straight, [](Point p) {
               return Point{0.36 * p[0] - 0.8 * p[1] + 0.48 * p[2], 0.48 * p[0] + 0.6 * p[1] + 0.64 * p[2],
                            0.6 * p[2] - 0.8 * p[0]};
             });
  for (int i = 0; i < Share(100); ++i) {
    const Mesh& mesh = i % 2 == 0 ? straight : tilted;
    const auto [a, b] = AnyEdge(mesh, random);
    Point to = PositionOf(mesh, b);
    if (i % 3 != 0)
      for (size_t k = 0; k < 3; ++k) to[k] = 0.5 * (to[k] + PositionOf(mesh, a)[k]);
    if (i % 5 > 1) to = Beside(to, 0.3, random);
    TryCollapse(mesh, a, b, to, false, random, tally);
  }
  ExpectBoth(tally, 20);
}

// Two trial faces with a common corner on the line of an edge, seen along which the mesh lies beyond: the corner
// touches the edge, although all corners of the faces there are beyond or shared.
TEST(Trial, ACornerOnAnEdgeMeetsIt) {
  Mesh mesh = Mapped(Box({0, 0, 0}, {1, 1, 1}, 1), [](Point p) {
    return Point{p[0], 0.7 * (p[1] + p[2]), 0.7 * (p[1] - p[2])};
  });
  Workbench w(mesh);
  uint32_t a = 0, b = 0;
  for (uint32_t v = 0; v < VertexCount(mesh); ++v) {
    if (PositionOf(mesh, v) == Point{0, 0, 0}) a = v;
    if (PositionOf(mesh, v) == Point{1, 0, 0}) b = v;
  }
  const uint32_t p = AddVertex(mesh, w, {.5, -.5, 0});
  for (const double inward : {0., -.01}) {
    const uint32_t c = AddVertex(mesh, w, {.5, inward, 0});
    const tpa::FaceCorners trials[] = {{{p, c, a}}, {{p, b, c}}};
    EXPECT_EQ(tpa::trials_are_free(w.m, w.g, nullptr, trials, 2, tpa::Expected::bent), inward < 0) << inward;
  }
}

// Either way round: the trial face lies neither beside the plane nor beside the face.
TEST(Trial, AFaceWithTheCornersOfAnotherMeetsIt) {
  Random random(4);
  const Workbench w(Shaken(Sphere({0, 0, 0}, 1, 4), 0.1, random));
  for (uint32_t f = 0; f < w.m.face_count; ++f) {
    const uint32_t* v = w.m.corner + 3 * f;
    EXPECT_FALSE(IsFree(w, {{v[0], v[1], v[2]}})) << f;
    EXPECT_FALSE(IsFree(w, {{v[1], v[0], v[2]}})) << f;
  }
}

}  // namespace
}  // namespace new_faces_test
