// support: what the tests on the public interface share. Meshes to try things on, a holder of an arena, and oracles
// that share no code with the library: exact arithmetic of their own, every pair of triangles, maps instead of
// half-edges.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "mesh_io.h"
#include "sphere.h"
#include "topoadapt.h"

namespace support {

using Mesh = tool::TriangleMesh;
using Point = std::array<double, 3>;
using Pairs = std::vector<std::pair<uint32_t, uint32_t>>;

inline uint32_t VertexCount(const Mesh& m) { return static_cast<uint32_t>(m.positions.size() / 3); }
inline uint32_t TriangleCount(const Mesh& m) { return static_cast<uint32_t>(m.triangles.size() / 3); }
inline Point PositionOf(const Mesh& m, size_t v) {
  return {m.positions[3 * v], m.positions[3 * v + 1], m.positions[3 * v + 2]};
}

// Each vertex moved to map(its position).
template <class Map>
Mesh Mapped(Mesh m, Map map) {
  for (size_t v = 0; v < VertexCount(m); ++v) {
    const Point p = map(PositionOf(m, v));
    std::copy(p.begin(), p.end(), m.positions.begin() + static_cast<std::ptrdiff_t>(3 * v));
  }
  return m;
}

// A structure of the interface, zero but for its size.
template <class T>
T Sized() {
  T s{};
  s.struct_size = sizeof s;
  return s;
}

// ---------------------------------------------------------------- meshes

Mesh Sphere(Point center, double radius, int parts);
// A ring round the z axis through `center`: `around` times `across` quadrilaterals, each cut in two.
Mesh Torus(Point center, double ring, double tube, int around, int across);
// A box with each side cut into n by n squares.
Mesh Box(Point low, Point high, int n);
// A closed tube with flat ends round the curve points[0 .. n-1]; `sides` vertices on each circle. The frames are
// square to the curve and keep `up` as well as they can.
Mesh Tube(const std::vector<Point>& points, const std::vector<double>& radii, int sides, Point up);
// One mesh of several components.
Mesh Together(const std::vector<Mesh>& parts);
Mesh Translated(Mesh m, Point by);

using Random = std::mt19937_64;
double Uniform(Random& random, double low, double high);
Point RandomPoint(Random& random, double low, double high);

// The same surface with vertices, triangles and first corners shuffled.
Mesh Renumbered(const Mesh& m, Random& random);
// Turned by one of the 24 rotations that permute the axes: exact.
Point QuarterTurned(Point p, int rotation);
Mesh QuarterTurned(Mesh m, int rotation);

// ---------------------------------------------------------------- oracles

// Sign of det(b - a, c - a, d - a): exact.
int Side(const Point& a, const Point& b, const Point& c, const Point& d);

// Every pair of triangles that meet outside of what they share, sorted: each with each. Triangles must not be
// degenerate.
Pairs AllMeetingPairs(const Mesh& m);
bool TrianglesMeet(const Mesh& m, uint32_t f, uint32_t g);

struct Component {
  uint32_t smallest_vertex, vertices, triangles;
  int64_t genus;
  double volume;
};

struct Topology {
  std::string defect;  // empty: closed, oriented, manifold
  std::vector<Component> components;  // by smallest vertex
  int64_t Genus() const;
  double Volume() const;
  // Genera in ascending order: what does not depend on the numbering.
  std::vector<int64_t> Genera() const;
};
Topology TopologyOf(const Mesh& m);

// Closed, oriented, manifold and free of self-intersections (P1).
testing::AssertionResult IsSound(const Mesh& m, const std::string& name);

// Writes the mesh of a failing test to a file and says where.
std::string Written(const Mesh& m, const std::string& name);

// ---------------------------------------------------------------- the library

tpa_config DefaultConfig(uint32_t max_vertices);
// Room for the mesh three times over.
tpa_config ConfigFor(const Mesh& m);

class Arena {
 public:
  explicit Arena(const tpa_config& config);
  // With the mesh loaded.
  Arena(const tpa_config& config, const Mesh& mesh);
  tpa_context* operator*() const { return context_; }
  char* block() const { return block_.get(); }
  const tpa_arena_size& size() const { return size_; }

 private:
  struct Free {
    void operator()(char* p) const;
  };
  tpa_arena_size size_{};
  std::unique_ptr<char, Free> block_;
  tpa_context* context_ = nullptr;
};

// Refers to the mesh.
tpa_mesh_input InputOf(const Mesh& mesh);
tpa_status Load(tpa_context* context, const Mesh& mesh, tpa_issue* issue = nullptr);
tpa_status MoveAll(tpa_context* context, const std::vector<double>& targets, tpa_issue* issue = nullptr);
Mesh MeshOf(const tpa_context* context);
std::vector<tpa_event> EventsOf(const tpa_context* context);
std::vector<tpa_vertex_origin> VertexOriginsOf(const tpa_context* context);
std::vector<uint32_t> OldToNewOf(const tpa_context* context);
std::vector<uint32_t> TriangleOriginsOf(const tpa_context* context);
Pairs PairsOf(const tpa_contacts& contacts);
std::string Text(const tpa_issue& issue);

// Everything that a failure must leave as it was: the bytes of view, maps, events and the list of rolled back vertices.
struct Observed {
  std::string bytes;
  bool operator==(const Observed&) const = default;
};
Observed Observe(const tpa_context* context);

}  // namespace support
