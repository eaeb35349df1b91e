// SPDX-License-Identifier: MIT
// Meshes as people have them: what the tool cleans, names and refuses. Each mesh is a box or a few with one fault put
// in, so that the right answer is known.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <random>
#include <set>

#include "support/faulty_meshes.h"

namespace mend_test {
namespace {

using namespace support;

// The surface of unit cubes at these places, with corners in common.
Polygons Cubes(const std::set<std::array<int, 3>>& places) {
  Polygons p;
  std::map<std::array<int, 3>, int> known;
  for (const auto& place : places)
    for (size_t axis = 0; axis < 3; ++axis)
      for (const int side : {0, 1}) {
        std::array<int, 3> beside = place;
        beside[axis] += 2 * side - 1;
        if (places.count(beside) != 0) continue;
        p.faces.emplace_back();
        for (const auto& [u, v] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
          std::array<int, 3> corner = place;
          corner[axis] += side;
          corner[(axis + 1) % 3] += u;
          corner[(axis + 2) % 3] += v;
          const auto [at, is_new] = known.try_emplace(corner, static_cast<int>(p.points.size()));
          if (is_new) p.points.push_back({double(corner[0]), double(corner[1]), double(corner[2])});
          p.faces.back().push_back(at->second);
        }
        if (side == 0) std::reverse(p.faces.back().begin(), p.faces.back().end());
      }
  return p;
}

// ---------------------------------------------------------------- parts inside out

TEST_F(Mend, APartInsideOutApartIsNamedAndTurned) {
  Polygons p = Box({0, 0, 0}, 2);
  p.Add(Box({5, 1, 2}, 1, true));
  const std::string file = Write("apart.off", Off(p));
  Names(file, {"component 1 ", "inside out", "(5,1,2) to (6,2,3)", "volume -1", "--turn-parts"});
  ExpectInReport("\"left_out\":1,");
  ExpectInReport("\"inside_out\":[{\"component\":1,\"box\":[[5,1,2],[6,2,3]],\"volume\":-1}]");
  EXPECT_EQ(Call("resolve " + file + " --out " + At("no.off") + " --png " + At("no.png")).exit_code, 1);
  for (const char* name : {"no.off", "no.png"}) EXPECT_FALSE(std::filesystem::exists(At(name))) << name;
  Resolves(file, " --turn-parts", {1, 8}, {"1 component turned"});
  ExpectInReport("\"left_out\":0,");
}

TEST_F(Mend, APartInsideOutOverlappingIsNamedAndTurned) {
  for (const double at : {1.0, 1.75, -0.5}) {
    Polygons p = Box({0, 0, 0}, 2);
    p.Add(Box({at, at, at}, 1.5, true));
    const std::string file = Write("overlap.off", Off(p));
    Names(file, {"component 1 ", "inside out", "volume -3.375"});
    const double common = std::pow(std::min(2.0, at + 1.5) - std::max(0.0, at), 3);
    Resolves(file, " --turn-parts", {8 + 3.375 - common}, {"1 component turned"});
  }
}

// A box inside out that crosses one face, with most of it inside, too: no outward part contains it.
TEST_F(Mend, APartThatLooksOutIsNoVoid) {
  Polygons p = Box({0, 0, 0}, 4);
  p.Add(Box({1, 1, 3.25}, 1, true));
  Names(Write("out.off", Off(p)), {"component 1 ", "inside out"});
}

// All corners of the bar lie in the two boxes at its ends.
TEST_F(Mend, ABarInsideOutBetweenTwoBodies) {
  Polygons p = Box({0, 0, 0}, 2), bar = Box({0, 0, 0}, 1, true);
  p.Add(Box({6, 0, 0}, 2));
  for (Point& q : bar.points) q = {1 + 6 * q[0], 0.5 + q[1], 0.5 + q[2]};
  p.Add(bar);
  const std::string file = Write("bar.off", Off(p));
  Names(file, {"component 2 ", "inside out", "(1,0.5,0.5) to (7,1.5,1.5)", "volume -6"});
  Resolves(file, " --turn-parts", {8 + 8 + 4}, {"1 component turned"});
}

TEST_F(Mend, VoidsStay) {
  Polygons p = Box({0, 0, 0}, 8);
  p.Add(Box({1, 1, 1}, 3, true));
  p.Add(Box({2, 2, 2}, 1));
  p.Add(Box({5, 5, 5}, 2, true));
  Resolves(Write("voids.off", Off(p)), "", {512, -27, 1, -8}, {});
  // Inside out in a void, nothing contains it.
  p.Add(Box({1.5, 1.5, 1.5}, 0.25, true));
  const std::string file = Write("in-void.off", Off(p));
  Names(file, {"component 4 ", "inside out"});
  Resolves(file, " --turn-parts", {512, -27, 1, -8, 0.015625}, {"1 component turned"});
}

// Voids whose faces lie in those of the body, turned in space so that nothing is exact; and a body within itself,
// turned.
TEST_F(Mend, VoidsThatTouchTheBodyStay) {
  for (int trial = 0; trial < 20; ++trial) {
    const double a = 0.1 + 0.3 * trial, b = 0.7 + trial;
    const auto turn = [&](Polygons p) {
      for (Point& q : p.points) {
        const Point r = {std::cos(a) * q[0] - std::sin(a) * q[1], std::sin(a) * q[0] + std::cos(a) * q[1], q[2]};
        q = {r[0], std::cos(b) * r[1] - std::sin(b) * r[2], std::sin(b) * r[1] + std::cos(b) * r[2]};
      }
      return p;
    };
    for (const Point& at : {Point{0, 0, 0}, Point{1, 0, 1}, Point{1, 1, 0}}) {
      Polygons p = turn(Box({0, 0, 0}, 3));
      p.Add(turn(Box(at, 1, true)));
      EXPECT_EQ(Call("validate " + Write("touching.off", Off(p))).err, "") << trial;
    }
    Polygons twice = turn(Box({0, 0, 0}, 3));
    twice.Add(turn(Box({0, 0, 0}, 3, true)));
    EXPECT_EQ(Call("validate " + Write("twice.off", Off(twice))).err, "") << trial;
  }
}

// A shell beside a body: the shell's void is turned along.
TEST_F(Mend, AShellInsideOutKeepsItsVoid) {
  Polygons p = Box({0, 0, 0}, 2);
  p.Add(Box({5, 0, 0}, 4, true));
  p.Add(Box({6, 1, 1}, 2));
  const std::string file = Write("shell.off", Off(p));
  Names(file, {"component 1 ", "inside out"});
  Resolves(file, " --turn-parts", {8, 64, -8}, {"2 components turned"});
}

// ---------------------------------------------------------------- cleaning

TEST_F(Mend, SoupsAreWelded) {
  const Polygons soup = Box({0, 0, 0}, 2).Soup();
  for (const std::string& file :
       {Write("soup.off", Off(soup)), Write("soup.obj", Obj(soup)), Write("soup.stl", Stl(soup))}) {
    Resolves(file, "", {8}, {"28 vertices welded"});
    ExpectInReport("\"welded\":28,");
    EXPECT_EQ(Call("detect " + file).out, "0 pairs\n");
  }
  Refuse("detect --as-is " + Write("soup.off", Off(soup)), {"soup.off", "--as-is", "28 vertices welded"});
  EXPECT_EQ(Call("detect --as-is " + Write("soup.stl", Stl(soup))).exit_code, 0);
  // 0 and -0 are one position.
  Polygons signs = soup;
  for (size_t i = 0; i < signs.points.size(); i += 2)
    for (double& x : signs.points[i])
      if (x == 0) x = -0.0;
  Resolves(Write("signs.off", Off(signs)), "", {8}, {"28 vertices welded"});
}

// Editors of text begin files with a mark of the order of bytes.
TEST_F(Mend, AMarkOfByteOrderIsPassedOver) {
  const Polygons p = Box({0, 0, 0}, 2);
  for (const std::string& file :
       {Write("marked.off", "\xEF\xBB\xBF" + Off(p)), Write("marked.obj", "\xEF\xBB\xBF" + Obj(p))})
    Resolves(file, "", {8}, {});
}

TEST_F(Mend, VerticesAndTrianglesWithoutUseGo) {
  Polygons p = Box({0, 0, 0}, 2);
  p.points.insert(p.points.begin(), {std::nan(""), 7, 7});
  p.points.push_back({9, 9, 9});
  for (auto& face : p.faces)
    for (int& v : face) ++v;
  const std::string loose = Write("loose.off", Off(p));
  Resolves(loose, "", {8}, {"2 vertices without a triangle"});
  ExpectInReport("\"unused_vertices\":2,");
  Refuse("validate --as-is " + loose, {"loose.off", "2 vertices without a triangle"});
  p = Box({0, 0, 0}, 2);
  p.faces.insert(p.faces.begin() + 3, {1, 1, 4});
  p.faces.push_back({2, 5, 2});
  const std::string twice = Write("twice.off", Off(p));
  Resolves(twice, "", {8}, {"2 triangles with a corner twice"});
  ExpectInReport("\"repeated_corners\":2,");
  // Numbers of triangles are those of the file.
  p.Add(Box({1, 1, 1}, 2));
  std::istringstream pairs(Call("detect --pairs " + Write("twice.off", Off(p))).out);
  int a = 0, b = 0, seen = 0;
  for (; pairs >> a >> b; ++seen) {
    EXPECT_TRUE(a < 14 && a != 3 && a != 13) << a;
    EXPECT_TRUE(b >= 14 && b < 26) << b;
  }
  EXPECT_GT(seen, 0);
}

TEST_F(Mend, FacesThereTwiceGoOnce) {
  const Polygons box = Box({0, 0, 0}, 2);
  Polygons p = box;
  for (const size_t f : {2u, 3u, 7u}) p.faces.push_back(box.faces[f]);  // two with a common edge, one alone
  p.faces.push_back(box.faces[7]);
  for (const std::string& file : {Write("doubled.off", Off(p)), Write("doubled.stl", Stl(p))}) {
    Resolves(file, "", {8}, {"4 faces upon another of the same corners left out"});
    ExpectInReport("\"doubled_faces\":4,\"turned_facets\":0,");
  }
  Refuse("detect --as-is " + At("doubled.off"), {"4 faces upon another"});
  // The copy that winds as the neighbours do stays, the first or the second.
  for (const bool first : {false, true}) {
    p = box;
    p.faces.push_back(box.faces[4]);
    std::reverse(p.faces[first ? 4 : 12].begin(), p.faces[first ? 4 : 12].end());
    Resolves(Write("opposite.off", Off(p)), "", {8}, {"1 face upon another"});
    ExpectInReport("\"turned_facets\":0,");
  }
  // Squares, from another corner on.
  Polygons cube = Cubes({{0, 0, 0}});
  for (const size_t f : {0u, 2u})
    cube.faces.push_back(cube.faces[f]),
        std::rotate(cube.faces.back().begin(), cube.faces.back().begin() + 1, cube.faces.back().end());
  Resolves(Write("squares.off", Off(cube)), "", {1}, {"2 faces upon another"});
  // A mesh there twice is in balance, and stays.
  p = box;
  p.faces.insert(p.faces.end(), box.faces.begin(), box.faces.end());
  Resolves(Write("twice.off", Off(p)), "", {8}, {"parted"});
  ExpectInReport("\"doubled_faces\":0,");
}

TEST_F(Mend, AMeshWithoutTrianglesIsRefused) {
  Polygons p;
  Refuse("detect " + Write("none.off", Off(p)), {"none.off", "no triangle"});
  p.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  p.faces = {{0, 1, 1}};
  Refuse("validate " + Write("line.off", Off(p)), {"line.off", "no triangle"});
}

// Boxes with a common edge, and with a common corner: by number, and by position.
TEST_F(Mend, FansArePartedAtEdgesAndCorners) {
  for (const Point& at : {Point{1, 1, 0}, Point{1, 1, 1}}) {
    Polygons p = Box({0, 0, 0}, 1);
    p.Add(Box(at, 1));
    Polygons shared;
    std::map<Point, int> known;
    for (const auto& face : p.faces) {
      shared.faces.emplace_back();
      for (const int v : face) {
        const Point& q = p.points[static_cast<size_t>(v)];
        const auto [place, is_new] = known.try_emplace(q, static_cast<int>(shared.points.size()));
        if (is_new) shared.points.push_back(q);
        shared.faces.back().push_back(place->second);
      }
    }
    const bool edge = at[2] == 0;
    ASSERT_EQ(shared.points.size(), edge ? 14u : 15u);
    for (const std::string& file : {Write("touch.off", Off(shared)), Write("touch.stl", Stl(p))}) {
      Resolves(file, "", {1, 1},
               {edge ? "fans parted at 1 edge" : "fans parted at corners", edge ? "2 vertices more" : "1 vertex more"});
      // Connected at the edge, they do not meet beyond it.
      EXPECT_EQ(Call("detect " + file).out, "0 pairs\n") << file;
    }
    Resolves(Write("apart.off", Off(p)), "", {1, 1}, {});
  }
}

// Six boxes round an edge, every second one solid, and boxes stacked face to face.
TEST_F(Mend, FansOfManyAndFacesBackToBack) {
  Polygons wheel;
  for (int i = 0; i < 3; ++i) {
    const auto at = [&](double turns, double z) {
      return Point{std::cos(2 * M_PI * turns), std::sin(2 * M_PI * turns), z};
    };
    Polygons wedge;
    const double from = i / 3.0, to = from + 1.0 / 6;
    wedge.points = {{0, 0, 0}, at(from, 0), at(to, 0), {0, 0, 1}, at(from, 1), at(to, 1)};
    wedge.faces = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}};
    wheel.Add(wedge);
  }
  const Ended spokes = Call("validate " + Write("wheel.stl", Stl(wheel)));
  EXPECT_EQ(spokes.out.rfind("3 components, genus 0", 0), 0u) << spokes.out;
  for (const char* word : {"fans parted at 1 edge", "4 vertices more"})
    EXPECT_NE(spokes.err.find(word), std::string::npos) << spokes.err;
  Polygons stack = Box({0, 0, 0}, 1);
  stack.Add(Box({1, 0, 0}, 1));
  Resolves(Write("stack.stl", Stl(stack)), "", {2}, {"welded"});
}

// Four cubes, two that touch along an edge, and four: both ends of the edge have one fan each, which passes twice.
TEST_F(Mend, ABodyThatTouchesItselfAlongAnEdgeIsParted) {
  std::set<std::array<int, 3>> places = {{0, 0, 1}, {1, 1, 1}};
  for (const int k : {0, 2})
    for (const int i : {0, 1})
      for (const int j : {0, 1}) places.insert({i, j, k});
  const std::string file = Write("itself.off", Off(Cubes(places)));
  Resolves(file, "", {10}, {"fans parted at 1 edge", "2 vertices more"});
  EXPECT_EQ(Call("detect " + file).out, "0 pairs\n");
}

TEST_F(Mend, CubesAtRandomAreParted) {
  std::mt19937 random(10);
  for (int trial = 0; trial < 12; ++trial) {
    std::set<std::array<int, 3>> places;
    const int n = 2 + trial % 3;
    for (int i = 0; i < n * n * n; ++i)
      if (random() % 10 < 4 + static_cast<unsigned>(trial) % 3) places.insert({i % n, i / n % n, i / n / n});
    Polygons p = Cubes(places);
    for (size_t f = p.faces.size(); f > 1; --f) std::swap(p.faces[f - 1], p.faces[random() % f]);
    const std::string file = Write("cubes.off", Off(p));
    const Ended run = Call("resolve " + file + " --out " + At("out.off"));
    ASSERT_EQ(run.exit_code, 0) << trial << ": " << run.err;
    Mesh m;
    ASSERT_TRUE(tool::read_mesh(At("out.off"), m).ok);
    EXPECT_TRUE(IsSound(m, file)) << trial;
    EXPECT_NEAR(TopologyOf(m).Volume(), static_cast<double>(places.size()), 0.01 * static_cast<double>(places.size()));
  }
}

// Triangles of both boxes lie upon each other, and wind the same way.
TEST_F(Mend, ABoxInsideOutFaceToFace) {
  for (const bool first : {false, true}) {
    Polygons p = Box({0, 0, 0}, 2, first);
    p.Add(Box({2, 0, 0}, 2, !first));
    const std::string file = Write("face.stl", Stl(p));
    Names(file, {"is inside out", "volume -8"});
    Resolves(file, " --turn-parts", {16}, {"1 component turned"});
  }
}

TEST_F(Mend, FacetsTheOtherWayRoundAreTurned) {
  std::mt19937 random(58);
  for (int trial = 0; trial < 10; ++trial) {
    Polygons p = Box({0, 0, 0}, 2);
    p.Add(Box({5, 0, 0}, 1));
    std::set<size_t> turned;
    while (turned.size() < 5) turned.insert(random() % 12);
    turned.insert(12 + random() % 12);
    for (const size_t f : turned) std::swap(p.faces[f][0], p.faces[f][1]);
    Resolves(Write("turned.off", Off(p)), "", {8, 1}, {"6 facets turned"});
    ExpectInReport("\"turned_facets\":6,");
  }
  // With as many on either side, the choice with the greater volume stays.
  for (const bool first : {false, true}) {
    Polygons half = Box({0, 0, 0}, 2);
    for (size_t f = 0; f < 6; ++f)
      std::reverse(half.faces[f + (first ? 0 : 6)].begin(), half.faces[f + (first ? 0 : 6)].end());
    Resolves(Write("half.off", Off(half)), "", {8}, {"6 facets turned"});
  }
  // A Klein bottle has no outside.
  Polygons klein;
  constexpr int n = 5;
  const auto id = [&](int i, int j) {
    const bool over = i == n;
    return (i % n) * n + ((over ? n - j : j) % n + n) % n;
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double u = 2 * M_PI * i / n, v = 2 * M_PI * j / n,
                   r = 2 + std::cos(u / 2) * std::sin(v) - std::sin(u / 2) * std::sin(2 * v);
      klein.points.push_back(
          {r * std::cos(u), r * std::sin(u), std::sin(u / 2) * std::sin(v) + std::cos(u / 2) * std::sin(2 * v)});
      klein.faces.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      klein.faces.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  Refuse("resolve " + Write("klein.off", Off(klein)) + " --out " + At("never.off"),
         {"klein.off", "no outside", "edges"});
}

TEST_F(Mend, NearVerticesAreNamedAndJoined) {
  Polygons p = Box({0, 0, 0}, 2);
  p.points.push_back({2, 2, 2.0000001});
  p.faces.back()[1] = p.faces.back()[1] == 7 ? 8 : p.faces.back()[1];
  for (int& v : p.faces[11]) v = v == 7 ? 8 : v;
  const std::string file = Write("near.off", Off(p));
  Refuse("resolve " + file + " --out " + At("never.off"),
         {"near.off", "1 hole", "vertex 7", "vertex 8", "--weld 1.1e-07"});
  Resolves(file, " --weld 1.1e-07", {8}, {"1 vertex joined"});
  ExpectInReport("\"joined\":1,");
  // Ids of .obj count from 1.
  Refuse("validate " + Write("near.obj", Obj(p)), {"vertex 8", "vertex 9", "--weld"});
  for (const char* bad : {"0", "-1", "x"}) Refuse("validate " + file + " --weld " + bad, {"--weld"});
}

// A soup whose corners are rounded apart.
TEST_F(Mend, ARoundedSoupIsJoined) {
  std::mt19937 random(1);
  Polygons p = Box({0, 0, 0}, 2).Soup();
  for (Point& q : p.points)
    for (double& x : q) x += 1e-9 * static_cast<double>(random() % 1000);
  const std::string file = Write("rounded.stl", Stl(p));
  Refuse("validate " + file, {"12 holes", "--weld"});
  Resolves(file, " --weld 1e-5", {8}, {"28 vertices joined"});
}

}  // namespace
}  // namespace mend_test
