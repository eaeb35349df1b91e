// SPDX-License-Identifier: MIT
// Open meshes, soups, polygons with common corners, and the inputs beside the project.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "support/faulty_meshes.h"

namespace open_meshes_test {
namespace {

using namespace support;
namespace fs = std::filesystem;

// ---------------------------------------------------------------- open meshes

TEST_F(Mend, HolesAreDescribedAndFilled) {
  Polygons p = Box({0, 0, 0}, 2);
  p.faces.erase(p.faces.begin() + 2, p.faces.begin() + 4);  // a square
  p.faces.erase(p.faces.begin());                           // a triangle of the other side
  const std::string file = Write("holes.off", Off(p));
  const Ended refused = Call("resolve " + file + " --out " + At("never.off"));
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1);
  for (const char* word : {"holes.off", "open", "hole", "3 edges", "box (0,0,0) to (2,2,0)", "vertex ", "--fill"})
    EXPECT_NE(refused.err.find(word), std::string::npos) << word << ": " << refused.err;
  Resolves(file, " --fill 4", {8}, {" filled by 3 triangles"});
  ExpectInReport("\"filling_triangles\":3");
  // Shorter than asked for: one stays.
  Refuse("resolve " + file + " --fill 3 --out " + At("never.off"), {"holes.off", "1 hole", "4 edges", "--fill 4"});
  for (const char* bad : {"2", "385", "x"}) Refuse("validate " + file + " --fill " + bad, {"--fill"});
  // STL has no numbers.
  const Ended stl = Call("validate " + Write("holes.stl", Stl(p)));
  EXPECT_EQ(stl.exit_code, 2);
  EXPECT_EQ(stl.err.find("vertex"), std::string::npos) << stl.err;
  EXPECT_NE(stl.err.find("3 edges"), std::string::npos) << stl.err;
}

// An octahedron without two triangles that have but a corner in common.
TEST_F(Mend, HolesWithACommonCornerAreTwo) {
  Polygons p;
  p.points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  p.faces = {{2, 1, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (const std::string& file : {Write("corner.off", Off(p)), Write("corner.stl", Stl(p))}) {
    Refuse("resolve " + file + " --out " + At("never.off"), {"2 holes: ", "3 edges in the box (0,0,0) to (1,1,1)",
                                                             "3 edges in the box (-1,-1,0) to (0,0,1)", "--fill 3"});
    Resolves(file, " --fill 3", {4.0 / 3}, {"2 holes filled by 2 triangles"});
  }
  // Two bodies with a common corner, a hole at the corner in each.
  Polygons q = p;
  q.faces.insert(q.faces.end(), {{0, 2, 4}, {1, 3, 4}});
  Polygons other = q;
  for (Point& at : other.points) at[0] += 2;
  q.Add(other);
  for (auto& face : q.faces)
    for (int& v : face) v = v == 7 ? 0 : v;
  std::erase_if(q.faces, [](const auto& f) { return f == std::vector{0, 2, 4} || f == std::vector{0, 9, 10}; });
  const std::string file = Write("bodies.off", Off(q));
  Refuse("validate " + file, {"2 holes", "3 edges"});
  Resolves(file, " --fill 3", {4.0 / 3, 4.0 / 3}, {"2 holes filled by 2 triangles", "fans parted at corners"});
}

// Vertices on an edge, which the triangles on the other side pass over: a slit without area, exactly or up to rounding.
TEST_F(Mend, SlitsAreFilled) {
  for (const double aside : {0.0, 1e-7, -1e-7})
    for (const int vertices : {1, 3}) {
      Polygons p = Box({0, 0, 0}, 2);
      const auto at = std::find_if(p.faces.begin(), p.faces.end(), [](const auto& f) {
        return std::count(f.begin(), f.end(), 4) + std::count(f.begin(), f.end(), 7) == 2;
      });  // half of the upper square, at its diagonal
      std::rotate(at->begin(), std::find(at->begin(), at->end(), 4), at->end());
      if ((*at)[1] != 7) std::rotate(at->begin(), at->begin() + 2, at->end());
      const std::vector<int> face = *at;
      p.faces.erase(at);
      int last = face[0];
      for (int i = 1; i <= vertices; ++i) {
        const double t = i / (vertices + 1.0);
        const Point &a = p.points[static_cast<size_t>(face[0])], &b = p.points[static_cast<size_t>(face[1])];
        p.points.push_back({a[0] + t * (b[0] - a[0]) + aside, a[1] + t * (b[1] - a[1]) - aside, a[2]});
        p.faces.push_back({last, static_cast<int>(p.points.size()) - 1, face[2]});
        last = static_cast<int>(p.points.size()) - 1;
      }
      p.faces.push_back({last, face[1], face[2]});
      const std::string edges = std::to_string(vertices + 2), file = Write("slit.off", Off(p));
      Refuse("resolve " + file + " --out " + At("never.off"), {"1 hole", edges + " edges", "--fill " + edges});
      Resolves(file, " --fill " + edges, {8}, {"1 hole filled"});
    }
}

TEST_F(Mend, TenHolesAreNamedOfMany) {
  Polygons p;
  for (int i = 0; i < 12; ++i) {
    p.Add(Box({3.0 * i, 0, 0}, 2));
    p.faces.pop_back();
  }
  const Ended run = Call("validate " + Write("many.off", Off(p)));
  EXPECT_EQ(run.exit_code, 2);
  for (const char* word : {"12 holes", "and 2 more", "(29,0,0) to (29,2,2)"})
    EXPECT_NE(run.err.find(word), std::string::npos) << word << ": " << run.err;
  EXPECT_EQ(run.err.find("(32,0,0)"), std::string::npos) << run.err;
  Resolves(At("many.off"), " --fill 3", std::vector<double>(12, 8), {"12 holes filled by 12 triangles"});
}

// A cover through a body that stands in the hole would meet it.
TEST_F(Mend, AHoleIsNotFilledThroughTheMesh) {
  Polygons p = Box({0, 0, 0}, 4);
  p.faces.erase(p.faces.begin() + 2, p.faces.begin() + 4);  // the top
  p.Add(Box({1, 1, 3}, 2));
  Refuse("resolve " + Write("blocked.off", Off(p)) + " --fill 4 --out " + At("never.off"),
         {"1 hole", "could not be filled", "meet"});
  // A wavy rim, by the library's triangulation.
  Polygons bowl;
  constexpr int n = 40;
  for (int i = 0; i < n; ++i)
    bowl.points.push_back({std::cos(2 * M_PI * i / n), std::sin(2 * M_PI * i / n), 0.1 * std::cos(6 * M_PI * i / n)});
  bowl.points.push_back({0, 0, -2});
  for (int i = 0; i < n; ++i) bowl.faces.push_back({i, n, (i + 1) % n});
  for (auto& face : bowl.faces) std::swap(face[0], face[2]);
  for (auto& face : bowl.faces) std::swap(face[0], face[2]);
  const std::string file = Write("bowl.off", Off(bowl));
  const Ended run = Call("resolve " + file + " --fill 40 --turn-parts --out " + At("bowl-out.off"));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.err.find("1 hole filled by 38 triangles"), std::string::npos) << run.err;
  Mesh m;
  ASSERT_TRUE(tool::read_mesh(At("bowl-out.off"), m).ok);
  EXPECT_TRUE(IsSound(m, "bowl"));
}

// Pairs of random soups, with coordinates of few whole numbers, against the exact arithmetic of the tests.
TEST_F(Mend, DetectCountsPairsOfSoups) {
  for (const int grid : {3, 5, 1000})
    for (unsigned seed = 0; seed < 8; ++seed) {
      std::mt19937 random(seed);
      std::set<std::array<int, 3>> places;
      while (places.size() < 25)
        places.insert(
            {static_cast<int>(random()) % grid, static_cast<int>(random()) % grid, static_cast<int>(random()) % grid});
      Polygons p;
      for (const auto& q : places) p.points.push_back({1.0 * q[0], 1.0 * q[1], 1.0 * q[2]});
      std::set<std::set<int>> known;
      while (p.faces.size() < 14) {
        const std::vector<int> face = {static_cast<int>(random() % 25), static_cast<int>(random() % 25),
                                       static_cast<int>(random() % 25)};
        const std::set<int> corners(face.begin(), face.end());
        if (corners.size() == 3 && known.insert(corners).second) p.faces.push_back(face);
      }
      const std::string file = Write("soup.off", Off(p));
      Mesh m;
      ASSERT_TRUE(tool::read_mesh(file, m).ok);
      // A triangle without area is one pair, with itself.
      std::set<uint32_t> flat;
      for (uint32_t f = 0; f < 14; ++f) {
        const Point &a = p.points[m.triangles[3 * f]], &b = p.points[m.triangles[3 * f + 1]],
                    &c = p.points[m.triangles[3 * f + 2]];
        const auto minor = [&](size_t i, size_t j) {
          return (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]);
        };
        if (minor(0, 1) == 0 && minor(1, 2) == 0 && minor(2, 0) == 0) flat.insert(f);
      }
      Pairs expected;
      for (const auto& pair : AllMeetingPairs(m))
        if (flat.count(pair.first) + flat.count(pair.second) == 0) expected.push_back(pair);
      for (const uint32_t f : flat) expected.emplace_back(f, f);
      std::sort(expected.begin(), expected.end());
      const Ended run = Call("detect --quiet --pairs " + file);
      EXPECT_EQ(run.exit_code, expected.empty() ? 0 : 1) << run.err;
      std::istringstream text(run.out);
      Pairs listed;
      for (uint32_t a = 0, b = 0; text >> a >> b;) listed.emplace_back(a, b);
      EXPECT_EQ(listed, expected) << grid << " " << seed;
    }
}

// ---------------------------------------------------------------- polygons

// Two squares bent about different diagonals, with common opposite corners, closed by triangles.
TEST_F(Mend, PolygonsWithCommonOppositeCornersGetDifferentDiagonals) {
  Polygons p;
  p.points = {{-1, 0, 0}, {0, -1, 0.5}, {1, 0, 0}, {0, 1, 0.5}, {0, -1, -0.5}, {0, 1, -0.5}};
  p.faces = {{0, 1, 2, 3}, {0, 5, 2, 4}, {0, 4, 1}, {1, 4, 2}, {2, 5, 3}, {3, 5, 0}};
  for (int turn = 0; turn < 4; ++turn) {
    const std::string file = Write("quads.off", Off(p));
    const Ended run = Call("validate " + file);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.err, "");
    Mesh m;
    ASSERT_TRUE(tool::read_mesh(file, m).ok);
    EXPECT_TRUE(IsSound(m, "quads"));
    std::rotate(p.faces[0].begin(), p.faces[0].begin() + 1, p.faces[0].end());
  }
}

// A cube with a corner lifted: the top is bent, and the two cuts differ by h / 6. The shorter diagonal is taken,
// whichever corner comes first.
TEST_F(Mend, ABentFaceIsCutAlongTheShorterDiagonal) {
  for (const double h : {0.3, -0.3})
    for (int turn = 0; turn < 4; ++turn) {
      Polygons p;
      for (int k = 0; k < 8; ++k) p.points.push_back({double(k & 1), double(k >> 1 & 1), double(k >> 2)});
      p.points[7][2] += h;
      p.faces = {{4, 5, 7, 6}, {0, 2, 3, 1}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
      std::rotate(p.faces[0].begin(), p.faces[0].begin() + turn, p.faces[0].end());
      ASSERT_EQ(Call("resolve " + Write("bent.off", Off(p)) + " --out " + At("out.off")).exit_code, 0);
      Mesh m;
      ASSERT_TRUE(tool::read_mesh(At("out.off"), m).ok);
      EXPECT_NEAR(TopologyOf(m).Volume(), 1 + h / 6, 1e-12) << turn;
    }
}

// ---------------------------------------------------------------- the inputs beside the project

TEST_F(Mend, SharedInputs) {
  const std::string inputs = TOPOADAPT_SHARED_DATA "/inputs/";
  if (!fs::exists(inputs + "pinhole.off")) GTEST_SKIP() << "no inputs in " << inputs;
  Names(inputs + "inverted_part_apart.off", {"inside out"});
  Names(inputs + "inverted_part_overlap.off", {"inside out"});
  Resolves(inputs + "inverted_part_apart.off", " --turn-parts", {8, 1}, {"turned"});
  Resolves(inputs + "inverted_part_overlap.off", " --turn-parts", {10.375}, {"turned"});
  for (const char* name : {"soup_box.off", "soup_box.stl"}) Resolves(inputs + name, "", {8}, {"28 vertices welded"});
  Resolves(inputs + "isolated_vertex.off", "", {8}, {"1 vertex without"});
  Resolves(inputs + "repeated_corner.off", "", {8}, {"1 triangle with a corner twice"});
  Resolves(inputs + "touching_edge.stl", "", {1, 1}, {"parted"});
  Resolves(inputs + "two_turned_facets.off", "", {8}, {"2 facets turned"});
  Resolves(inputs + "quads_same_diagonal.off", "", {1}, {});
  Refuse("resolve --out " + At("never.off") + " " + inputs + "near_vertex.off", {"vertex 7", "vertex 8", "--weld"});
  Refuse("resolve --out " + At("never.off") + " " + inputs + "pinhole.off", {"1 hole", "3 edges", "--fill 3"});
  Resolves(inputs + "pinhole.off", " --fill 3", {8}, {"1 hole filled by 1 triangle"});
}

}  // namespace
}  // namespace open_meshes_test
