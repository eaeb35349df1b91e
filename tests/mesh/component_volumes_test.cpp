// SPDX-License-Identifier: MIT
// Volumes of components during edits, against integers of any size.
#include "mesh/component_volumes.h"

#include <gtest/gtest.h>

#include "oracle/volume_oracle.h"
#include "support/library_mesh.h"
#include "support/share.h"

namespace component_volumes_test {
namespace {

using namespace support;
using big_int::BigInt;
using tpa::u32;
using volume_oracle::Scaled;

testing::AssertionResult IsWithinDoubt(const tpa::Component& part, const BigInt& exact) {
  return volume_oracle::IsWithinDoubt(part.volume.sum, part.volume.doubt, exact);
}

// Two thin bodies and a sphere, each somewhere else.
struct Bodies {
  static Mesh Scattered(Random& random) {
    const double far = std::pow(10, Uniform(random, 0, 6));
    std::vector<Mesh> all{ThinBody(random), Sphere({0, 0, 0}, 0.1, 3), ThinBody(random)};
    for (Mesh& m : all) m = Translated(std::move(m), RandomPoint(random, -far, far));
    return Together(all);
  }
  explicit Bodies(Random& random) : mesh(Scattered(random)), label(mesh.m.vertex_count), node(64), list(64) {
    c.label = label.data();
    c.node = node.data();
    c.list = {list.data(), 64, 0};
    std::vector<u32> queue(mesh.m.vertex_count + 1);
    tpa::find_components(mesh.m, c, queue.data());
    tpa::measure_enclosed(mesh.m, c);
    for (u32 f = 0, i = 0; f <= mesh.m.face_count; ++f)
      if (f == mesh.m.face_count || (f > 0 && Of(f) != Of(f - 1))) end[i++] = f;
  }
  u32 Of(u32 f) const { return tpa::component_of(c, mesh.m.corner[3 * f]); }
  BigInt Exact(u32 i) const {
    const u32 first = i == 0 ? 0 : end[i - 1];
    return volume_oracle::SixVolumes(mesh.m, [&](u32 f) { return f >= first && f < end[i]; });
  }

  EditedMesh mesh;
  std::vector<u32> label, node;
  std::vector<tpa::Component> list;
  tpa::Components c;
  u32 end[3] = {};  // of each component's faces
};

TEST(Enclosed, IsMeasuredWithinItsDoubt) {
  for (uint64_t seed = 1; seed <= Share(300u); ++seed) {
    Random random(seed);
    const Bodies b(random);
    ASSERT_EQ(b.c.list.size, 3u) << "seed " << seed;
    for (u32 i = 0; i < 3; ++i) EXPECT_TRUE(IsWithinDoubt(b.c.list[i], b.Exact(i))) << "seed " << seed;
    EXPECT_GT(b.c.list[1].volume.sum, b.c.list[1].volume.doubt) << "seed " << seed;
  }
}

TEST(Enclosed, VolumesAreMeasuredWithinTheirDoubts) {
  for (uint64_t seed = 1; seed <= Share(300u); ++seed) {
    Random random(seed);
    Bodies b(random);
    tpa::measure_volumes(b.mesh.e, b.c);
    for (u32 i = 0; i < 3; ++i) EXPECT_TRUE(IsWithinDoubt(b.c.list[i], b.Exact(i))) << "seed " << seed;
    EXPECT_GT(b.c.list[1].volume.sum, b.c.list[1].volume.doubt) << "seed " << seed;
  }
}

// No two vertices are farther apart than the size of their component, in the sum of coordinates; some are half as far.
TEST(Enclosed, SizesBoundDistances) {
  for (uint64_t seed = 1; seed <= Share(20u); ++seed) {
    Random random(seed);
    Bodies b(random);
    const double scale = std::pow(2, Uniform(random, -30, 30));
    for (tpa::Vec3& p : b.mesh.positions) p = scale * p;
    tpa::measure_volumes(b.mesh.e, b.c);
    for (u32 i = 0; i < 3; ++i) {
      double farthest = 0;
      for (u32 v = 0; v < b.mesh.m.vertex_count; ++v)
        for (u32 w = 0; w < v; ++w)
          if (tpa::component_of(b.c, v) == i && tpa::component_of(b.c, w) == i)
            farthest = std::max(farthest, tpa::size_of(b.mesh.positions[v] - b.mesh.positions[w]));
      EXPECT_GE(b.c.list[i].size, (1 - 1e-9) * farthest) << "seed " << seed;
      EXPECT_LE(b.c.list[i].size, (2 + 1e-9) * farthest) << "seed " << seed;
    }
  }
}

// Two pyramids on a ring of n vertices; each top has n neighbours.
Mesh Bipyramid(u32 n) {
  Mesh m;
  m.positions = {0, 0, 1, 0, 0, -1};
  for (u32 i = 0; i < n; ++i) {
    const double turn = 2 * 3.14159265358979 * i / n;
    m.positions.insert(m.positions.end(), {std::cos(turn), std::sin(turn), 0});
    const u32 a = 2 + i, b = 2 + (i + 1) % n;
    m.triangles.insert(m.triangles.end(), {0, a, b, 1, b, a});
  }
  return m;
}

// Some vertices move, one after another, far or hardly at all.
TEST(Enclosed, WhatAMoveChangesIsWithinItsDoubt) {
  for (uint64_t seed = 1; seed <= Share(100u); ++seed) {
    Random random(seed);
    const double far = std::pow(10, Uniform(random, -2, 6)), reach = std::pow(10, Uniform(random, -9, 1));
    const Mesh m = Translated(seed % 2 == 0 ? Sphere({0, 0, 0}, 1, 3) : Bipyramid(60), RandomPoint(random, -far, far));
    EditedMesh mesh(m);
    const std::vector<tpa::Vec3> old = mesh.positions;
    std::vector<bool> moves(old.size());
    for (u32 v = 0; v < old.size(); ++v) {
      moves[v] = random() % 3 != 0;
      const Point by = RandomPoint(random, -reach, reach);
      if (moves[v]) mesh.positions[v] = old[v] + tpa::Vec3{by[0], by[1], by[2]};
    }
    for (u32 v = 0; v < old.size(); ++v) {
      if (!moves[v]) continue;
      const auto at = [&](u32 u, bool gone) {
        return Scaled(u < v || !moves[u] || (u == v && gone) ? mesh.positions[u] : old[u]);
      };
      BigInt exact;
      tpa::for_each_outgoing(mesh.m, v, [&](u32 h) {
        const u32 a = tpa::head(mesh.m, h), b = tpa::apex(mesh.m, h);
        exact = exact + big_int::det3(at(v, true), at(a, true), at(b, true)) -
                big_int::det3(at(v, false), at(a, false), at(b, false));
      });
      const tpa::SignedVolume change =
          tpa::change_by_move(mesh.m, v, old.data(), [&](u32 u) -> bool { return moves[u]; });
      EXPECT_TRUE(volume_oracle::IsWithinDoubt(change.sum, change.doubt, exact)) << "seed " << seed << " vertex " << v;
      EXPECT_LT(change.doubt, 1e-10 * reach * (1 + reach) * (1 + reach)) << "seed " << seed << " vertex " << v;
    }
  }
}

// Vertices move at random: components not collected have kept the sign, and know the volume after the moves.
TEST(Enclosed, WhatIsTurnedByMovesIsFound) {
  u32 turned_bodies = 0, kept_bodies = 0;
  for (uint64_t seed = 1; seed <= Share(600u); ++seed) {
    Random random(seed);
    Bodies b(random);
    const BigInt before[3] = {b.Exact(0), b.Exact(1), b.Exact(2)};
    const std::vector<tpa::Vec3> from = b.mesh.positions;
    std::vector<u32> vertices(b.mesh.m.vertex_count), turned_data(vertices.size());
    std::vector<uint8_t> mark(vertices.size());
    const double reach = std::pow(10, Uniform(random, -4, -0.5));
    for (u32 v = 0; v < vertices.size(); ++v) {
      vertices[v] = v;
      mark[v] = random() % 3 != 0;
      const Point by = RandomPoint(random, -reach, reach);
      if (mark[v] != 0) b.mesh.positions[v] = from[v] + tpa::Vec3{by[0], by[1], by[2]};
    }
    tpa::Stack<u32> turned{turned_data.data(), static_cast<u32>(turned_data.size()), 0};
    const tpa::Moves moves{{vertices.data(), static_cast<u32>(vertices.size())}, mark.data(), from.data()};
    tpa::find_turned(b.mesh.m, moves, b.c, turned);
    bool collected[3] = {};
    for (const u32 v : turned) collected[tpa::component_of(b.c, v)] = true;
    for (u32 i = 0; i < 3; ++i) {
      const BigInt now = b.Exact(i);
      EXPECT_TRUE(collected[i] || now.sign() == before[i].sign()) << "seed " << seed;
      EXPECT_TRUE(IsWithinDoubt(b.c.list[i], turned.empty() ? now : before[i])) << "seed " << seed;
      // Few are collected without need.
      (collected[i] ? turned_bodies : kept_bodies) += 1;
      if (collected[i] && now.sign() == before[i].sign()) {
        EXPECT_LT(std::fabs(b.c.list[i].volume.sum), 1e3 * b.c.list[i].volume.doubt) << "seed " << seed;
      }
    }
  }
  EXPECT_GT(turned_bodies, Least(50u));
  EXPECT_GT(kept_bodies, Least(500u));
}

TEST(Enclosed, AChangeThatTurnsIsTold) {
  Random random(1);
  Bodies b(random);
  for (u32 i = 0; i < 3; ++i) {
    const u32 v = b.c.list[i].id;
    const double six = b.c.list[i].volume.sum;
    EXPECT_TRUE(tpa::stays_outside_out(b.c, v, {-0.9 * six, 0}));
    EXPECT_FALSE(tpa::stays_outside_out(b.c, v, {-1.1 * six, 0}));
    EXPECT_FALSE(tpa::stays_outside_out(b.c, v, {-0.9 * six, 0.2 * std::fabs(six)}));
    tpa::note_change(b.c, v, {-0.9 * six, 0});
    EXPECT_FALSE(tpa::stays_outside_out(b.c, v, {-0.2 * six, 0}));
    EXPECT_TRUE(tpa::stays_outside_out(b.c, v, {-0.05 * six, 0}));
  }
}

// A flat body has no side, whichever side it had before.
TEST(Enclosed, AChangeThatFlattensIsTold) {
  for (const double six : {-6.0, 6.0}) {
    Random random(1);
    Bodies b(random);
    b.c.list[1].volume = {six, 0};
    EXPECT_TRUE(tpa::stays_outside_out(b.c, b.c.list[1].id, {-0.5 * six, 0}));
    EXPECT_FALSE(tpa::stays_outside_out(b.c, b.c.list[1].id, {-six, 0}));
  }
}

}  // namespace
}  // namespace component_volumes_test
