// Proofs that faces meet nothing of their sheet. The judge tries each of them with each face that it is said not to
// meet.
#include "unfolded.h"

#include <algorithm>
#include <cmath>

#include "library_mesh.h"
#include "share.h"
#include "support.h"
#include "tangle_shapes.h"

namespace {

using namespace support;

// Some that are reached from one over edges, the nearest first.
std::vector<uint32_t> Patch(const tpa::Mesh& m, uint32_t face, size_t size) {
  std::vector<uint32_t> patch{face};
  for (size_t i = 0; i < patch.size() && patch.size() < size; ++i)
    for (uint32_t h = 3 * patch[i]; h < 3 * patch[i] + 3 && patch.size() < size; ++h)
      if (const uint32_t next = tpa::face_of(m.opposite[h]); std::find(patch.begin(), patch.end(), next) == patch.end())
        patch.push_back(next);
  return patch;
}

bool HasArea(const LibraryMesh& l, uint32_t f) { return tpa::squared_length(tpa::face_normal(l.m, f)) > 1e-20; }

struct Tally {
  int proven = 0, refused = 0, in_contact = 0, aside = 0, of_sheet = 0;
};

void TryProof(const Mesh& mesh, const LibraryMesh& l, const std::vector<uint32_t>& patch, Tally& tally,
              const std::string& name) {
  tpa::Unfolded u;
  const bool proven = tpa::are_unfolded(l.m, {patch.data(), static_cast<uint32_t>(patch.size())}, u);
  ++(proven ? tally.proven : tally.refused);
  std::vector<bool> in_patch(TriangleCount(mesh));
  for (uint32_t f : patch) in_patch[f] = true;
  bool meets_patch = false;
  for (uint32_t g = 0; g < TriangleCount(mesh); ++g) {
    const bool meets = HasArea(l, g) && std::any_of(patch.begin(), patch.end(), [&](uint32_t f) {
      return f != g && HasArea(l, f) && TrianglesMeet(mesh, f, g);
    });
    meets_patch = meets_patch || (in_patch[g] && meets);
    if (!proven) continue;
    const bool aside = tpa::is_aside(l.m, u, g);
    if (in_patch[g]) {
      EXPECT_TRUE(u.has(g)) << g;
      EXPECT_FALSE(aside) << g;
    }
    if (u.has(g) || aside) {
      EXPECT_FALSE(meets) << g << " of " << Written(mesh, name);
    }
    tally.aside += aside;
    tally.of_sheet += u.has(g);
  }
  tally.in_contact += meets_patch;
}

void TryPatches(const Mesh& mesh, int patches, Random& random, Tally& tally, const std::string& name) {
  const LibraryMesh l(mesh);
  for (int i = 0; i < patches; ++i) {
    const auto face = static_cast<uint32_t>(random() % TriangleCount(mesh));
    const size_t size = 1 + random() % (i % 2 == 0 ? 12 : 60);
    std::vector<uint32_t> patch = Patch(l.m, face, size);
    // In any order, and with gaps.
    if (i % 3 == 0) std::shuffle(patch.begin(), patch.end(), random);
    if (i % 3 == 0) patch.resize((patch.size() + 1) / 2);
    TryProof(mesh, l, patch, tally, name + "-" + std::to_string(i));
  }
}

TEST(Unfolded, WhatIsProvenMeetsNothingOfItsSheet) {
  Random random(1);
  Tally tally;
  for (int i = 0; i < Share(60); ++i) {
    const Mesh shapes[] = {Sphere({0, 0, 0}, 1, 10), Torus({0, 0, 0}, 1, 0.4, 30, 16), Bumpy(0.3, 10, random),
                           Dented(1, Uniform(random, 0, 2.2), 8), Trefoil(0.5, 0.35, 60, 8),
                           Together({Sphere({0, 0, 0}, 1, 6), Sphere({1.5, 0.1, 0.2}, 1, 6)})};
    Mesh mesh = RandomlyTurned(shapes[static_cast<size_t>(i) % std::size(shapes)], random);
    if (i % 4 == 1) mesh = Noisy(mesh, 0.05, random);
    if (i % 4 == 3) mesh = Noisy(mesh, 0.4, random);
    TryPatches(mesh, 12, random, tally, "seed-1-mesh-" + std::to_string(i));
  }
  EXPECT_GT(tally.proven, Least(200));
  EXPECT_GT(tally.refused, Least(100));
  EXPECT_GT(tally.in_contact, Least(30));
  EXPECT_GT(tally.aside, Least(30000));
  EXPECT_GT(tally.of_sheet, Least(5000));
}

// Few coordinates, so that faces touch each other, and the border of what bounds them.
TEST(Unfolded, OnALattice) {
  Random random(2);
  Tally tally;
  for (int i = 0; i < Share(200); ++i) {
    const Mesh flat = Block({0, 0, 0}, {8, 8, 2}, {8, 8, 2});
    const Mesh mesh = Mapped(flat, [&](Point p) {
      for (size_t k = 0; k < 3; ++k)
        if (random() % 40 == 0) p[k] += static_cast<double>(random() % 3) - 1;
      return p;
    });
    TryPatches(mesh, 6, random, tally, "seed-2-mesh-" + std::to_string(i));
  }
  EXPECT_GT(tally.proven, Least(100));
  EXPECT_GT(tally.in_contact, Least(200));
}

TEST(Unfolded, ASmoothPatchIsProvenFromAnywhere) {
  Random random(3);
  const Mesh sphere = Sphere({0, 0, 0}, 1, 40);
  const LibraryMesh l(RandomlyTurned(sphere, random));
  for (int i = 0; i < Share(50); ++i) {
    const std::vector<uint32_t> patch =
        Patch(l.m, static_cast<uint32_t>(random() % l.m.face_count), tpa::most_unfolded);
    tpa::Unfolded u;
    EXPECT_TRUE(tpa::are_unfolded(l.m, {patch.data(), static_cast<uint32_t>(patch.size())}, u)) << i;
  }
}

// Every fifteenth face of a wide patch: more faces lie over what bounds them than are listed.
TEST(Unfolded, TooManyAreRefused) {
  const LibraryMesh l(Sphere({0, 0, 0}, 1, 100));
  const std::vector<uint32_t> wide = Patch(l.m, 0, 2400);
  std::vector<uint32_t> some;
  for (size_t i = 0; i < wide.size(); i += 15) some.push_back(wide[i]);
  tpa::Unfolded u;
  EXPECT_FALSE(tpa::are_unfolded(l.m, {some.data(), static_cast<uint32_t>(some.size())}, u));
  EXPECT_EQ(u.s.count, tpa::Unfolded::most);
  some.resize(20);
  EXPECT_TRUE(tpa::are_unfolded(l.m, {some.data(), static_cast<uint32_t>(some.size())}, u));
}

// Two sheets that cross, both seen from above: over what bounds faces of both there are two of them.
TEST(Unfolded, NothingIsProvenOfFacesThatMeet) {
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
        std::vector<uint32_t> both = Patch(l.m, f, 1 + random() % 10);
        const std::vector<uint32_t> others = Patch(l.m, g, 1 + random() % 10);
        both.insert(both.end(), others.begin(), others.end());
        if (i % 2 == 0) std::swap(both.front(), both.back());
        tpa::Unfolded u;
        EXPECT_FALSE(tpa::are_unfolded(l.m, {both.data(), static_cast<uint32_t>(both.size())}, u)) << f << ' ' << g;
        ++tried;
      }
  }
  EXPECT_GT(tried, Least(500));
}

// A sheet that goes round one of its vertices twice, as a spiral stair does, and crosses itself where its end meets its
// beginning. What closes it below is far from the middle.
TEST(Unfolded, AStarThatGoesRoundTwiceIsRefused) {
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
  EXPECT_EQ(u.s.count, 6u);  // where the second turn begins
}

}  // namespace
