// SPDX-License-Identifier: MIT
// Loops round the tube of a torus and along its hole, against a flood over all faces.
#include "cut/short_loops.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "support/library_mesh.h"
#include "support/sample_meshes.h"

namespace short_loops_test {
namespace {

using namespace support;

constexpr int around = 24, across = 7;
constexpr double ring = 1, tube = 0.2;

// A mesh whose vertices are all new, in the hands of the search.
struct Searched : EditedMesh {
  explicit Searched(const Mesh& mesh)
      : EditedMesh(mesh),
        way(vertices),
        towards(vertices),
        near(vertices),
        marks(faces),
        heap(tpa::most_heap_entries),
        found_vertices(vertices),
        found_faces(faces) {
    for (uint32_t v = 0; v < vertices; ++v) origins[v] = {{v, v}, 0.5};
    s.way = way.data();
    s.towards = towards.data();
    s.near = near.data();
    s.face_mark = marks.data();
    s.heap = {heap.data(), static_cast<uint32_t>(heap.size()), 0};
    s.vertices = {found_vertices.data(), vertices, 0};
    s.faces = {found_faces.data(), faces, 0};
  }

  std::vector<double> way;
  std::vector<uint32_t> towards;
  std::vector<uint8_t> near, marks;
  std::vector<tpa::HeapEntry> heap;
  std::vector<uint32_t> found_vertices, found_faces;
  tpa::ShortLoopSearch s;
};

std::set<uint32_t> VerticesOf(const tpa::Mesh& m, const tpa::ShortLoop& loop) {
  std::set<uint32_t> vertices;
  for (uint32_t i = 0; i < loop.count; ++i) {
    EXPECT_EQ(tpa::head(m, loop.half_edge[i]), tpa::tail(m, loop.half_edge[(i + 1) % loop.count]));
    vertices.insert(tpa::tail(m, loop.half_edge[i]));
  }
  EXPECT_EQ(vertices.size(), loop.count);
  return vertices;
}

// All faces hang together without the edges of the loop.
bool LeavesOnePiece(const tpa::Mesh& m, const tpa::ShortLoop& loop) {
  std::set<uint32_t> cut;
  for (uint32_t i = 0; i < loop.count; ++i) cut.insert({loop.half_edge[i], m.opposite[loop.half_edge[i]]});
  std::vector<uint32_t> reached = {0};
  std::set<uint32_t> known = {0};
  for (size_t i = 0; i < reached.size(); ++i)
    for (uint32_t h = 3 * reached[i]; h < 3 * reached[i] + 3; ++h) {
      const uint32_t f = tpa::face_of(m.opposite[h]);
      if (cut.count(h) == 0 && known.insert(f).second) reached.push_back(f);
    }
  return reached.size() == m.face_count;
}

double LengthOf(const tpa::Mesh& m, const tpa::ShortLoop& loop) {
  double sum = 0;
  for (uint32_t i = 0; i < loop.count; ++i)
    sum += tpa::length(m.position[tpa::head(m, loop.half_edge[i])] - m.position[tpa::tail(m, loop.half_edge[i])]);
  return sum;
}

// The loops found from all vertices: their vertices, and their lengths. None is found from two vertices.
using Loops = std::map<std::set<uint32_t>, double>;
Loops AllLoops(Searched& given, const tpa::LoopLengths& longest) {
  const tpa::Mesh& m = given.e.mesh;
  Loops all;
  for (uint32_t v = 0; v < given.vertices; ++v) {
    tpa::ShortLoop loop;
    Loops from_here;
    for (uint32_t skipped = 0; tpa::find_short_loop(m, v, longest, skipped, given.s, loop); ++skipped) {
      EXPECT_TRUE(LeavesOnePiece(m, loop));
      if (longest.tunnel == 0) {
        EXPECT_NEAR(loop.thickness, LengthOf(m, loop) / longest.handle, 1e-12);
      }
      from_here[VerticesOf(m, loop)] = LengthOf(m, loop);
    }
    for (const auto& found : from_here) EXPECT_TRUE(all.insert(found).second) << "again, from " << v;
  }
  EXPECT_EQ(std::count(given.near.begin(), given.near.end(), 0), static_cast<long>(given.near.size()));
  EXPECT_EQ(std::count(given.marks.begin(), given.marks.end(), 0), static_cast<long>(given.marks.size()));
  return all;
}

double RoundTube() { return 2 * across * tube * std::sin(3.14159265358979 / across); }
tpa::LoopLengths Handles(double longest) { return {0, 0, longest}; }

TEST(ShortLoops, RoundAHandleAreFoundOnceEach) {
  Searched torus(Torus({0, 0, 0}, ring, tube, around, across));
  EXPECT_TRUE(AllLoops(torus, Handles(0.999 * RoundTube())).empty());
  const Loops loops = AllLoops(torus, Handles(1.001 * RoundTube()));
  EXPECT_EQ(loops.size(), static_cast<size_t>(around));
  for (const auto& [vertices, length] : loops) EXPECT_EQ(vertices.size(), static_cast<size_t>(across));
}

// The path to a vertex at the place of the first one has no length.
TEST(ShortLoops, MayHaveVerticesInOnePlace) {
  for (int from = 0; from < across; ++from) {
    Mesh m = Torus({0, 0, 0}, ring, tube, around, across);
    const auto to = static_cast<size_t>((from + 1) % across);
    std::copy_n(m.positions.begin() + static_cast<std::ptrdiff_t>(3 * to), 3, m.positions.begin() + 3 * from);
    Searched torus(m);
    EXPECT_GE(AllLoops(torus, Handles(1.001 * RoundTube())).size(), static_cast<size_t>(around));
  }
}

// The tube is wider on one side of the hole: by .7 to 1.3.
Mesh UnevenTorus() {
  Mesh m = Torus({0, 0, 0}, ring, tube, around, across);
  for (size_t i = 0; i < m.positions.size(); i += 3) {
    double* p = &m.positions[i];
    const double far = std::hypot(p[0], p[1]), wider = 1 + 0.3 * p[0] / far;
    for (int k = 0; k < 2; ++k) p[k] = ring * p[k] / far + wider * (p[k] - ring * p[k] / far);
    p[2] *= wider;
  }
  return m;
}

TEST(ShortLoops, AreNoLongerThanAsked) {
  Searched torus(UnevenTorus());
  const double half = RoundTube();
  const Loops narrow = AllLoops(torus, Handles(half)), all = AllLoops(torus, Handles(1.301 * half));
  EXPECT_GE(narrow.size(), 10u);
  EXPECT_GE(all.size(), narrow.size() + 10);
  for (const auto& [vertices, length] : narrow) EXPECT_LE(length, half);
  for (const auto& [vertices, length] : all) EXPECT_LE(length, 1.301 * half);
}

// Loops through the middle of the torus count as round a tunnel: not as handles, however long these may be.
TEST(ShortLoops, RoundATunnelLieOutside) {
  Searched torus(Torus({0, 0, 0}, ring, 0.8, 9, 30));
  EXPECT_TRUE(AllLoops(torus, Handles(3)).empty());
  const Loops loops = AllLoops(torus, {3, 3, 0});
  EXPECT_FALSE(loops.empty());
  for (const auto& [vertices, length] : loops) EXPECT_GE(vertices.size(), 9u);
}

TEST(ShortLoops, OfASphereAreNone) {
  Searched sphere(Sphere({0, 0, 0}, 1, 4));
  EXPECT_TRUE(AllLoops(sphere, {9, 9, 9}).empty());
}

}  // namespace
}  // namespace short_loops_test
