// SPDX-License-Identifier: MIT
// Proofs that faces meet nothing of the surface round them. The judge tests all pairs ruled out by a proof.
#include "detect/cull_faces.h"

#include <algorithm>
#include <cmath>

#include "oracle/big_int.h"
#include "support/library_mesh.h"
#include "support/share.h"
#include "support/support.h"
#include "support/tangle_shapes.h"

namespace cull_faces_test {
namespace {

using namespace support;

// Faces reached from one face over edges, breadth first.
std::vector<uint32_t> ConnectedFaces(const tpa::Mesh& m, uint32_t face, size_t size) {
  std::vector<uint32_t> some{face};
  for (size_t i = 0; i < some.size() && some.size() < size; ++i)
    for (uint32_t h = 3 * some[i]; h < 3 * some[i] + 3 && some.size() < size; ++h)
      if (const uint32_t next = tpa::face_of(m.opposite[h]); std::find(some.begin(), some.end(), next) == some.end())
        some.push_back(next);
  return some;
}

bool HasArea(const LibraryMesh& l, uint32_t f) { return tpa::squared_length(tpa::face_normal(l.m, f)) > 1e-20; }

// The corners of a face in the view, without rounding, in units of 2^-320.
class ExactView {
 public:
  ExactView(const LibraryMesh& l, const tpa::Slant& view, uint32_t f) {
    using big_int::scaled;
    for (int i = 0; i < 3; ++i) {
      const tpa::Vec3 p = l.m.position[l.m.corner[3 * f + static_cast<uint32_t>(i)]];
      const big_int::BigInt z = scaled(p[view.axes.z]) - scaled(view.origin[2]);
      x_[i] = (scaled(p[view.axes.x]) - scaled(view.origin[0])) * scaled(1) - scaled(view.by_x) * z;
      y_[i] = (scaled(p[view.axes.y]) - scaled(view.origin[1])) * scaled(1) - scaled(view.by_y) * z;
    }
  }
  int Turn() const { return big_int::det2(x_[1] - x_[0], x_[2] - x_[0], y_[1] - y_[0], y_[2] - y_[0]).sign(); }
  bool IsWithin(const tpa::Octagon& r) const {
    bool within = true;
    for (uint32_t side = 0; side < 4; ++side)
      for (int i = 0; i < 3; ++i) within = within && !IsBelow(r, side, i) && !IsAbove(r, side, i);
    return within;
  }
  // Beyond one of r's sides?
  bool IsBeyond(const tpa::Octagon& r) const {
    for (uint32_t side = 0; side < 4; ++side)
      if ((IsBelow(r, side, 0) && IsBelow(r, side, 1) && IsBelow(r, side, 2)) ||
          (IsAbove(r, side, 0) && IsAbove(r, side, 1) && IsAbove(r, side, 2)))
        return true;
    return false;
  }

 private:
  big_int::BigInt At(uint32_t side, int i) const {
    return side == 0 ? x_[i] : side == 1 ? y_[i] : side == 2 ? x_[i] + y_[i] : x_[i] - y_[i];
  }
  bool IsBelow(const tpa::Octagon& r, uint32_t side, int i) const {
    return (At(side, i) - big_int::scaled(r.low[side / 2][side % 2]) * big_int::scaled(1)).sign() < 0;
  }
  bool IsAbove(const tpa::Octagon& r, uint32_t side, int i) const {
    return (At(side, i) - big_int::scaled(r.high[side / 2][side % 2]) * big_int::scaled(1)).sign() > 0;
  }

  big_int::BigInt x_[3], y_[3];
};

// The claims of a proof, made with rounded numbers, about S, R and faces aside.
void ExpectCertain(const LibraryMesh& l, const std::vector<uint32_t>& some, const tpa::Unfolded& u,
                   const std::string& name) {
  for (uint32_t i = 0; i < u.count; ++i) EXPECT_EQ(ExactView(l, u.view, u.face[i]).Turn(), u.view.axes.up) << name;
  for (uint32_t f : some) EXPECT_TRUE(ExactView(l, u.view, f).IsWithin(u.r)) << f << ' ' << name;
  for (uint32_t f = 0; f < l.m.face_count; f += 7)
    EXPECT_TRUE(!tpa::is_aside(l.m, u, f) || ExactView(l, u.view, f).IsBeyond(u.r)) << f << ' ' << name;
}

struct Tally {
  int proven = 0, refused = 0, in_contact = 0, aside = 0, in_s = 0;
};

void TryProof(const Mesh& mesh, const LibraryMesh& l, const std::vector<uint32_t>& some, Tally& tally,
              const std::string& name) {
  tpa::Unfolded u;
  const bool proven = tpa::are_unfolded(l.m, {some.data(), static_cast<uint32_t>(some.size())}, u);
  ++(proven ? tally.proven : tally.refused);
  if (proven && tally.proven % 5 == 0) ExpectCertain(l, some, u, name);
  std::vector<bool> is_in_p(TriangleCount(mesh));
  for (uint32_t f : some) is_in_p[f] = true;
  bool meets_p = false;
  for (uint32_t g = 0; g < TriangleCount(mesh); ++g) {
    const bool meets = HasArea(l, g) && std::any_of(some.begin(), some.end(), [&](uint32_t f) {
                         return f != g && HasArea(l, f) && TrianglesMeet(mesh, f, g);
                       });
    meets_p = meets_p || (is_in_p[g] && meets);
    if (!proven) continue;
    const bool aside = tpa::is_aside(l.m, u, g);
    if (is_in_p[g]) {
      EXPECT_TRUE(u.has(g)) << g;
      EXPECT_FALSE(aside) << g;
    }
    if (u.has(g) || aside) {
      EXPECT_FALSE(meets) << g << " of " << Written(mesh, name);
    }
    tally.aside += aside;
    tally.in_s += u.has(g);
  }
  tally.in_contact += meets_p;
}

void TryProofs(const Mesh& mesh, int proofs, Random& random, Tally& tally, const std::string& name) {
  const LibraryMesh l(mesh);
  for (int i = 0; i < proofs; ++i) {
    const auto face = static_cast<uint32_t>(random() % TriangleCount(mesh));
    const size_t size = 1 + random() % (i % 2 == 0 ? 12 : 60);
    std::vector<uint32_t> some = ConnectedFaces(l.m, face, size);
    // In random order, and with gaps.
    if (i % 3 == 0) std::shuffle(some.begin(), some.end(), random);
    if (i % 3 == 0) some.resize((some.size() + 1) / 2);
    TryProof(mesh, l, some, tally, name + "-" + std::to_string(i));
  }
}

TEST(CullFaces, ProvenFacesMeetNothingOfTheirNeighbourhood) {
  Random random(1);
  Tally tally;
  for (int i = 0; i < Share(60); ++i) {
    const Mesh shapes[] = {
        Sphere({0, 0, 0}, 1, 10),  Torus({0, 0, 0}, 1, 0.4, 30, 16),
        Bumpy(0.3, 10, random),    Dented(1, Uniform(random, 0, 2.2), 8),
        Trefoil(0.5, 0.35, 60, 8), Together({Sphere({0, 0, 0}, 1, 6), Sphere({1.5, 0.1, 0.2}, 1, 6)})};
    Mesh mesh = RandomlyTurned(shapes[static_cast<size_t>(i) % std::size(shapes)], random);
    if (i % 4 == 1) mesh = Noisy(mesh, 0.05, random);
    if (i % 4 == 3) mesh = Noisy(mesh, 0.4, random);
    TryProofs(mesh, 12, random, tally, "seed-1-mesh-" + std::to_string(i));
  }
  EXPECT_GT(tally.proven, Least(200));
  EXPECT_GT(tally.refused, Least(100));
  EXPECT_GT(tally.in_contact, Least(30));
  EXPECT_GT(tally.aside, Least(30000));
  EXPECT_GT(tally.in_s, Least(5000));
}

// Few different coordinates: faces touch each other and the border of R.
TEST(CullFaces, OnALattice) {
  Random random(2);
  Tally tally;
  for (int i = 0; i < Share(100); ++i) {
    const Mesh flat = Block({0, 0, 0}, {8, 8, 2}, {8, 8, 2});
    const Mesh mesh = Mapped(flat, [&](Point p) {
      for (size_t k = 0; k < 3; ++k)
        if (random() % 40 == 0) p[k] += static_cast<double>(random() % 3) - 1;
      return p;
    });
    TryProofs(mesh, 6, random, tally, "seed-2-mesh-" + std::to_string(i));
  }
  EXPECT_GT(tally.proven, Least(50));
  EXPECT_GT(tally.in_contact, Least(100));
}

TEST(CullFaces, ASmoothSurfaceIsProvenFromAnywhere) {
  Random random(3);
  const Mesh sphere = Sphere({0, 0, 0}, 1, 40);
  const LibraryMesh l(RandomlyTurned(sphere, random));
  for (int i = 0; i < Share(50); ++i) {
    const std::vector<uint32_t> some =
        ConnectedFaces(l.m, static_cast<uint32_t>(random() % l.m.face_count), tpa::most_unfolded);
    tpa::Unfolded u;
    EXPECT_TRUE(tpa::are_unfolded(l.m, {some.data(), static_cast<uint32_t>(some.size())}, u)) << i;
  }
}

// A bump with slopes of 45 degrees, turned at random. Seen along an axis, some side mostly turns away.
TEST(CullFaces, ASteepBumpIsProvenFromAnywhere) {
  Random random(5);
  const Mesh bump = Mapped(Sphere({0, 0, 0}, 1, 40), [](const Point& p) {
    const double square = p[0] * p[0] + p[1] * p[1];
    return p[2] > 0 && square < 0.04 ? Point{p[0], p[1], p[2] + 2.5 * (0.04 - square)} : p;
  });
  uint32_t top = 0;
  for (uint32_t v = 0; v < VertexCount(bump); ++v)
    if (PositionOf(bump, v)[2] > PositionOf(bump, top)[2]) top = v;
  for (int i = 0; i < Share(50); ++i) {
    const LibraryMesh l(RandomlyTurned(bump, random));
    const std::vector<uint32_t> some = ConnectedFaces(l.m, tpa::face_of(l.m.vertex_edge[top]), tpa::most_unfolded);
    tpa::Unfolded u;
    EXPECT_TRUE(tpa::are_unfolded(l.m, {some.data(), static_cast<uint32_t>(some.size())}, u)) << i;
    if (i % 10 == 0) ExpectCertain(l, some, u, "turn " + std::to_string(i));
  }
}

// A vertex right above the middle of an edge of the link, in a plane spanned by random whole numbers. Without rounding
// of the direction, the view along the normal would see the face at the edge edge-on.
TEST(CullFaces, WhereRoundingsDecide) {
  Random random(6);
  const auto whole = [&](int low, int high) {
    return static_cast<double>(low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1)));
  };
  int refused = 0;
  for (int i = 0; i < Share(2000); ++i) {
    const Point n{whole(-9, 9), whole(-9, 9), whole(1, 20)}, u{n[2], 0, -n[0]},
        v{n[1] * u[2] - n[2] * u[1], n[2] * u[0] - n[0] * u[2], n[0] * u[1] - n[1] * u[0]};
    const double high = whole(1, 9);
    const Point at{whole(-999, 999), whole(-999, 999), whole(-999, 999)};
    Mesh mesh = Mapped(Block({0, 0, 0}, {6, 6, 2}, {6, 6, 2}), [&](const Point& p) {
      Point q;
      for (size_t k = 0; k < 3; ++k) q[k] = at[k] + 2 * (p[0] * u[k] + p[1] * v[k] + p[2] * n[k]);
      return q;
    });
    const LibraryMesh flat(mesh);
    uint32_t raised = 0;  // a vertex inside the top side
    const auto is_amid = [&](uint32_t w) {
      bool amid = true;
      tpa::for_each_outgoing(flat.m, w, [&](uint32_t h) {
        const tpa::Vec3 normal = tpa::face_normal(flat.m, tpa::face_of(h)), up{n[0], n[1], n[2]};
        amid = amid && tpa::dot(normal, up) > 0 && tpa::squared_length(cross(normal, up)) == 0;
      });
      return amid;
    };
    do raised = static_cast<uint32_t>(random() % VertexCount(mesh));
    while (!is_amid(raised));
    const uint32_t h = flat.m.vertex_edge[raised];
    const Point a = PositionOf(mesh, tpa::head(flat.m, h)), b = PositionOf(mesh, tpa::apex(flat.m, h));
    for (size_t k = 0; k < 3; ++k) mesh.positions[3 * raised + k] = 0.5 * (a[k] + b[k]) + high * n[k];
    const LibraryMesh l(mesh);
    std::vector<uint32_t> star;
    tpa::for_each_outgoing(l.m, raised, [&](uint32_t g) { star.push_back(tpa::face_of(g)); });
    tpa::Unfolded proof;
    if (tpa::are_unfolded(l.m, {star.data(), static_cast<uint32_t>(star.size())}, proof))
      ExpectCertain(l, star, proof, "seed-6-mesh-" + std::to_string(i));
    else
      ++refused;
  }
  EXPECT_GT(refused, Least(1000));
}

// Every fifteenth face of a wide part of a sphere: more faces lie over R than the limit of S.
TEST(CullFaces, TooManyAreRefused) {
  const LibraryMesh l(Sphere({0, 0, 0}, 1, 100));
  const std::vector<uint32_t> wide = ConnectedFaces(l.m, 0, 2400);
  std::vector<uint32_t> some;
  for (size_t i = 0; i < wide.size(); i += 15) some.push_back(wide[i]);
  tpa::Unfolded u;
  EXPECT_FALSE(tpa::are_unfolded(l.m, {some.data(), static_cast<uint32_t>(some.size())}, u));
  EXPECT_EQ(u.count, tpa::Unfolded::most);
  some.resize(20);
  EXPECT_TRUE(tpa::are_unfolded(l.m, {some.data(), static_cast<uint32_t>(some.size())}, u));
}

// Two crossing surfaces with the same side up cover R twice.
TEST(CullFaces, NothingIsProvenOfFacesThatMeet) {
  Random random(4);
  int tried = 0;
  for (int i = 0; i < Share(20); ++i) {
    const Point by = RandomPoint(random, -0.1, 0.1);
    const Mesh mesh = RandomlyTurned(Together({Sphere({0, 0, 0}, 1, 8), Sphere(by, 1, 8)}), random);
    const LibraryMesh l(mesh);
    for (uint32_t f = 0; f < l.m.face_count / 2; f += 3)
      for (uint32_t g = l.m.face_count / 2; g < l.m.face_count; ++g) {
        const tpa::Vec3 nf = tpa::face_normal(l.m, f), ng = tpa::face_normal(l.m, g);
        const bool turned_alike = tpa::dot(nf, ng) > 0.9 * std::sqrt(tpa::squared_length(nf) * tpa::squared_length(ng));
        if (!turned_alike || !TrianglesMeet(mesh, f, g)) continue;
        std::vector<uint32_t> both = ConnectedFaces(l.m, f, 1 + random() % 10);
        const std::vector<uint32_t> others = ConnectedFaces(l.m, g, 1 + random() % 10);
        both.insert(both.end(), others.begin(), others.end());
        if (i % 2 == 0) std::swap(both.front(), both.back());
        tpa::Unfolded u;
        EXPECT_FALSE(tpa::are_unfolded(l.m, {both.data(), static_cast<uint32_t>(both.size())}, u)) << f << ' ' << g;
        ++tried;
      }
  }
  EXPECT_GT(tried, Least(500));
}

// A surface that winds round a vertex twice, as a spiral stair does, and crosses itself between end and beginning. The
// faces that close it below are far from the middle.
TEST(CullFaces, AStarThatGoesRoundTwiceIsRefused) {
  constexpr uint32_t n = 12;
  Mesh stair;
  const auto point = [&](double x, double y, double z) { stair.positions.insert(stair.positions.end(), {x, y, z}); };
  const auto face = [&](uint32_t a, uint32_t b, uint32_t c) {
    stair.triangles.insert(stair.triangles.end(), {a, b, c});
  };
  point(0, 0, 0);
  for (const double radius : {1.0, 5.0})
    for (uint32_t i = 0; i < n; ++i) {
      const double turn = 4 * 3.14159265358979 * i / n;
      point(radius * std::cos(turn), radius * std::sin(turn), 0.1 * i);
    }
  point(0, 0, -5);
  for (uint32_t i = 0; i < n; ++i) face(0, 1 + i, 1 + (i + 1) % n);
  for (uint32_t i = 0; i < n; ++i) {
    const uint32_t a = 1 + i, b = 1 + (i + 1) % n, c = a + n, d = b + n;
    face(a, c, d), face(a, d, b), face(2 * n + 1, d, c);
  }
  const LibraryMesh l(stair);
  const uint32_t top[n] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  tpa::Unfolded u;
  EXPECT_FALSE(tpa::are_unfolded(l.m, {top, n}, u));
  EXPECT_EQ(u.count, 6u);  // where the second turn begins
}

}  // namespace
}  // namespace cull_faces_test
