// SPDX-License-Identifier: MIT
#include "support/thin_tunnels.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "oracle/exact.h"
#include "support/field_shapes.h"
#include "support/mesh_building.h"
#include "support/mixed_seed.h"
#include "support/resolve_trial.h"
#include "support/tangle_shapes.h"
#include "tool/scenes/elementary.h"

namespace support {

namespace {

// ---------------------------------------------------------------- bodies with a tunnel or handle of thickness t

// Where contacts may happen, all in the body's own frame: a place on its surface, and the unit normal there.
struct Place {
  Point at, normal;
};

struct Body {
  Mesh mesh;
  double edge = 0;        // length that the thickness is measured by
  Place near, far, over;  // over: at the mouth of the tunnel, or on the handle
  // Segments that lead through the tunnel, in pairs of ends; or points within the handle.
  std::vector<Point> segments, within;
};

using Lines = std::vector<double>;

using Index = std::array<int, 3>;

// Cells between the lines of a grid; the surface of the solid ones as a mesh.
class CellBody {
 public:
  CellBody(const std::array<Lines, 3>& lines, const std::function<bool(const Point&)>& solid)
      : lines_(lines), solid_(solid) {
    Index cell{};
    for (cell[2] = 0; cell[2] < Count(2); ++cell[2])
      for (cell[1] = 0; cell[1] < Count(1); ++cell[1])
        for (cell[0] = 0; cell[0] < Count(0); ++cell[0])
          if (IsSolid(cell)) AddSides(cell);
  }
  const Mesh& mesh() const { return mesh_; }

 private:
  int Count(size_t axis) const { return static_cast<int>(lines_[axis].size()) - 1; }
  double Line(size_t axis, int i) const { return lines_[axis][static_cast<size_t>(i)]; }

  bool IsSolid(const Index& cell) const {
    Point middle;
    for (size_t i = 0; i < 3; ++i) {
      if (cell[i] < 0 || cell[i] >= Count(i)) return false;
      middle[i] = 0.5 * (Line(i, cell[i]) + Line(i, cell[i] + 1));
    }
    return solid_(middle);
  }
  size_t Vertex(const Index& at) {
    const auto [place, added] = number_.emplace(at, number_.size());
    if (added) AddVertex(mesh_, {Line(0, at[0]), Line(1, at[1]), Line(2, at[2])});
    return place->second;
  }
  void AddSides(const Index& cell) {
    for (size_t axis = 0; axis < 3; ++axis)
      for (const int side : {0, 1}) {
        Index next = cell, corner = cell;
        next[axis] += side == 1 ? 1 : -1;
        corner[axis] += side;
        if (!IsSolid(next)) AddSide(corner, axis, side == 1);
      }
  }
  void AddSide(const Index& corner, size_t axis, bool outward) {
    size_t c[4];
    for (size_t i = 0; i < 4; ++i) {
      Index at = corner;
      at[(axis + 1) % 3] += i == 1 || i == 2 ? 1 : 0;
      at[(axis + 2) % 3] += i >= 2 ? 1 : 0;
      c[i] = Vertex(at);
    }
    AddQuad(mesh_, c[0], c[outward ? 1 : 3], c[2], c[outward ? 3 : 1]);
  }

  const std::array<Lines, 3>& lines_;
  const std::function<bool(const Point&)>& solid_;
  std::map<Index, size_t> number_;
  Mesh mesh_;
};

// A block with a slot of width t through it along z.
Body Slot(double t, Random&) {
  Body b;
  b.edge = 0.5;
  t *= b.edge;
  const std::array<Lines, 3> lines = {
      {{-1.5, -1, -0.5, 0, 0.5, 1, 1.5}, {-1, -0.5, -t / 2, t / 2, 0.5, 1}, {-0.5, 0, 0.5}}};
  b.mesh = CellBody(lines, [&](const Point& p) { return std::fabs(p[0]) > 1 || std::fabs(p[1]) > t / 2; }).mesh();
  b.near = {{0.1, t / 2 + 0.33, 0.5}, {0, 0, 1}};
  b.far = {{1.5, 0.25, 0.1}, {1, 0, 0}};
  b.over = {{0.1, 0.02, 0.5}, {0, 0, 1}};
  for (const double x : {-0.8, -0.3, 0.1, 0.4, 0.9})
    for (const double y : {-0.3, 0.02, 0.3}) b.segments.insert(b.segments.end(), {{x, y * t, -3}, {x, y * t, 3}});
  return b;
}

// A tube round a flat oval whose strands are t apart.
Body Oval(double t, Random& random) {
  Body b;
  b.edge = 0.3;
  t *= b.edge;
  const int sides = 2 * WholeIn(random, 3, 5);
  const double radius = 0.4, turn = Coin(random) ? 0.5 : 0, reach = radius * tool::cosine(2 * pi * turn / sides);
  const double bend = reach + t / 2;
  std::vector<std::vector<Point>> rings;
  const auto ring = [&](double x, double y, double angle) {
    rings.emplace_back();
    for (int k = 0; k < sides; ++k) {
      const double a = 2 * pi * (k + turn) / sides, out = radius * tool::cosine(a);
      rings.back().push_back({x + out * tool::cosine(angle), y + out * tool::sine(angle), radius * tool::sine(a)});
    }
  };
  constexpr int straight = 7, bent = 5;
  for (const int side : {1, -1}) {
    for (int i = 0; i < straight; ++i) ring(side * (-1 + 2.0 * i / straight), -side * bend, -side * pi / 2);
    for (int i = 0; i < bent; ++i) {
      const double a = -pi / 2 + pi * i / bent + (side < 0 ? pi : 0);
      ring(side + bend * tool::cosine(a), bend * tool::sine(a), a);
    }
  }
  b.mesh = Lofted(rings, true);
  b.near = {{0.1, bend, radius}, {0, 0, 1}};
  b.far = {{1 + bend + reach, 0.1, 0.05}, {1, 0, 0}};
  b.over = {{0.1, 0.02, 0.3}, {0, 0, 1}};
  for (const double x : {-0.8, -0.3, 0.1, 0.4, 0.9})
    for (const double y : {-0.3, 0.02, 0.3}) b.segments.insert(b.segments.end(), {{x, y * t, -3}, {x, y * t, 3}});
  return b;
}

// Two towers on a base, joined by a wire of t by t.
Body Wire(double t, Random&) {
  Body b;
  b.edge = 0.5;
  t *= b.edge;
  const double low = 0.6, high = low + t;
  const std::array<Lines, 3> lines = {
      {{-1.5, -1, -0.5, 0, 0.5, 1, 1.5}, {-0.5, -t / 2, t / 2, 0.5}, {-0.5, 0, low, high, 1.1}}};
  b.mesh = CellBody(lines, [&](const Point& p) {
             return p[2] < 0 || std::fabs(p[0]) > 0.5 || (std::fabs(p[1]) < t / 2 && p[2] > low && p[2] < high);
           }).mesh();
  b.near = {{-0.75, 0.05, 1.1}, {0, 0, 1}};
  b.far = {{1.5, 0.1, -0.2}, {1, 0, 0}};
  b.over = {{0.05, 0.02, high}, {0, 0, 1}};
  for (const double x : {-0.4, -0.1, 0.2, 0.45}) b.within.push_back({x, 0.01 * t, low + 0.49 * t});
  return b;
}

using Maker = Body (*)(double, Random&);
constexpr Maker makers[] = {Slot, Oval, Wire};
constexpr const char* shape_names[] = {"slot", "oval", "wire"};
enum Contact { at_near, at_far, over, apart };
constexpr const char* contact_names[] = {"near", "far", "over", "apart"};

// ---------------------------------------------------------------- scenes

constexpr double ball_radius = 0.3, ball_gap = 0.02;

// The body, one ball that moves, and one that waits where contacts happen apart from the body.
struct TunnelScene {
  Mesh mesh;
  std::vector<uint8_t> moves;  // of each vertex
  Point way;                   // of a step
  std::vector<Point> segments, within;
};

Mesh Ball(const Place& place, Random& random) {
  const Point middle = Sum(place.at, Scaled(ball_radius + ball_gap, place.normal));
  return Translated(RandomlyTurned(Sphere({}, ball_radius, WholeIn(random, 1, 4)), random), middle);
}

// All in one random rotation, points to look at included.
TunnelScene Turned(const Body& body, const Mesh& still, const Mesh& moving, const Point& way, Random& random) {
  TunnelScene s;
  s.mesh = Together({body.mesh, still, moving});
  const uint32_t count = VertexCount(s.mesh);
  s.moves.assign(count, 0);
  std::fill(s.moves.end() - VertexCount(moving), s.moves.end(), uint8_t{1});
  Mesh all = s.mesh;
  for (const auto* points : {&body.segments, &body.within})
    for (const Point& p : *points) AddVertex(all, p);
  AddVertex(all, way);
  all = RandomlyTurned(all, random);
  s.mesh.positions.assign(all.positions.begin(), all.positions.begin() + 3 * count);
  size_t at = count;
  for (size_t i = 0; i < body.segments.size(); ++i) s.segments.push_back(PositionOf(all, at++));
  for (size_t i = 0; i < body.within.size(); ++i) s.within.push_back(PositionOf(all, at++));
  s.way = PositionOf(all, at);
  return s;
}

TunnelScene SceneOf(const TunnelFamily& family, double thickness, Random& random) {
  Body body = makers[family.shape](thickness, random);
  // Faces of the handle itself are in contact there, and may change by more.
  if (family.contact == over) body.within.clear();
  Place place = family.contact == at_far ? body.far : family.contact == over ? body.over : body.near;
  Mesh still;
  if (family.contact == apart) {
    place = {{0.1, 4, 0.1}, {0, 1, 0}};
    still = Ball({place.at, Scaled(-1, place.normal)}, random);
  }
  const Mesh moving = Ball(place, random);
  return Turned(body, still, moving, Scaled(-Uniform(random, 0.03, 0.15), place.normal), random);
}

// ---------------------------------------------------------------- judgement

bool Meets(const Point& p, const Point& q, const Mesh& m, uint32_t f) {
  const Point t[3] = {PositionOf(m, m.triangles[3 * f]), PositionOf(m, m.triangles[3 * f + 1]),
                      PositionOf(m, m.triangles[3 * f + 2])};
  if (Side(t[0], t[1], t[2], p) * Side(t[0], t[1], t[2], q) > 0) return false;
  int left = 0, right = 0;
  for (size_t i = 0; i < 3; ++i) {
    const int side = Side(p, q, t[i], t[(i + 1) % 3]);
    left += side > 0, right += side < 0;
  }
  return left == 0 || right == 0;
}

bool IsFree(const Point& p, const Point& q, const Mesh& m) {
  for (uint32_t f = 0; f < TriangleCount(m); ++f)
    if (Meets(p, q, m, f)) return false;
  return true;
}

bool IsInside(const Point& p, const Mesh& m) {
  double turns = 0;
  for (size_t f = 0; f < TriangleCount(m); ++f) turns += SolidAngle(m, f, p);
  return turns > 0.5;
}

std::string FaultOfTunnel(const TunnelScene& s, const Mesh& m) {
  if (TopologyOf(m).Genus() < 1) return "no tunnel is left";
  size_t open = 0;
  for (size_t i = 0; i < s.segments.size(); i += 2) open += IsFree(s.segments[i], s.segments[i + 1], m) ? 1u : 0u;
  if (!s.segments.empty() && open == 0) return "the tunnel is closed";
  for (const Point& p : s.within)
    if (!IsInside(p, m)) return "the handle is cut";
  return "";
}

constexpr int steps = 3;

}  // namespace

const std::vector<TunnelFamily>& TunnelFamilies() {
  static const std::vector<TunnelFamily> families = [] {
    std::vector<TunnelFamily> all;
    for (int shape = 0; shape < 3; ++shape)
      for (int contact = 0; contact < 4; ++contact)
        all.push_back({std::string("thin-") + shape_names[shape] + "-" + contact_names[contact], shape, contact});
    return all;
  }();
  return families;
}

TunnelTrial PlayTunnel(const TunnelFamily& family, uint64_t seed) {
  Random random(MixedSeed(family.name, seed));
  TunnelTrial t;
  t.thickness = 0.03 * std::exp(Uniform(random, 0, 1) * std::log(0.5 / 0.03));
  const TunnelScene scene = SceneOf(family, t.thickness, random);
  const Arena arena(GenerousConfig(scene.mesh), scene.mesh);
  std::vector<uint8_t> moves = scene.moves;
  EXPECT_EQ(FaultOf(scene.mesh) + FaultOfTunnel(scene, scene.mesh), "") << family.name << " " << seed;
  for (int i = 0; i < steps; ++i) {
    std::vector<double> targets = MeshOf(*arena).positions;
    for (size_t k = 0; k < targets.size(); ++k) targets[k] += moves[k / 3] * scene.way[k % 3];
    const Step step = TakeStep(*arena, targets);
    t.met = t.met || step.report.contacts > 0;
    if (!Note(step, t.trial)) return t;
    t.reason = FaultOfTunnel(scene, step.result);
    t.is_closed = !t.reason.empty();
    // Once the ball has grown on, its surface drags the handle along, and may close it truly.
    if (t.is_closed || (t.met && family.contact == over)) return t;
    std::vector<uint8_t> next;
    for (const tpa_vertex_origin& origin : VertexOriginsOf(*arena)) next.push_back(moves[origin.parents[0]]);
    moves = next;
  }
  return t;
}

}  // namespace support
