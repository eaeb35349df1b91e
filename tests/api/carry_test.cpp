// SPDX-License-Identifier: MIT
// tpa_carry_vertices and tpa_carry_triangles against the maps, row by row.
#include <cmath>
#include <cstring>
#include <vector>

#include "oracle/commit_oracle.h"
#include "support/random_commits.h"
#include "support/share.h"

namespace carry_test {
namespace {

using namespace support;

using Rows = std::vector<float>;

// Numbers of any bits: infinite, tiny, not numbers.
Rows RandomRows(size_t count, Random& random) {
  Rows rows(count);
  for (float& x : rows) {
    const uint32_t bits = static_cast<uint32_t>(random());
    std::memcpy(&x, &bits, sizeof x);
    if (random() % 4 != 0) x = static_cast<float>(Uniform(random, -1, 1));
  }
  return rows;
}

bool SameBits(const float* a, const float* b, size_t count) { return std::memcmp(a, b, count * sizeof(float)) == 0; }

TEST(Carry, FollowsTheMaps) {
  size_t blended = 0, followed = 0, far = 0;
  for (uint64_t seed = 1; seed <= Share(20u); ++seed) {
    Random random(seed);
    PlayRandomCommits(seed, 6, [&](tpa_context* context, const RandomCommit& commit) {
      const Mesh after = MeshOf(context);
      const uint32_t floats = static_cast<uint32_t>(1 + random() % 4);
      const Rows before = RandomRows(size_t{floats} * VertexCount(commit.before), random);
      Rows now(size_t{floats} * VertexCount(after), 77);
      ASSERT_EQ(tpa_carry_vertices(context, before.data(), floats, now.data()), TPA_OK);
      const std::vector<tpa_vertex_origin> origins = VertexOriginsOf(context);
      for (uint32_t v = 0; v < origins.size(); ++v) {
        const tpa_vertex_origin& o = origins[v];
        const float *p = &before[size_t{floats} * o.parents[0]], *got = &now[size_t{floats} * v];
        if (o.parents[1] == TPA_NONE || o.parents[0] == o.parents[1] || o.weight == 1.0f) {
          ASSERT_TRUE(SameBits(p, got, floats)) << "vertex " << v;
          continue;
        }
        ++blended;
        const float* q = &before[size_t{floats} * o.parents[1]];
        for (uint32_t i = 0; i < floats; ++i) {
          const long double w = static_cast<long double>(o.weight);
          const long double right = w * static_cast<long double>(p[i]) + (1 - w) * static_cast<long double>(q[i]);
          const long double size =
              std::fabs(static_cast<long double>(p[i])) + std::fabs(static_cast<long double>(q[i]));
          if (!(size < 1e37L)) continue;  // infinite, or not numbers
          ASSERT_LE(std::fabs(static_cast<long double>(got[i]) - right), 0x1p-23L * size + 0x1p-149L) << "vertex " << v;
        }
      }
      const Rows faces = RandomRows(size_t{floats} * TriangleCount(commit.before), random);
      now.assign(size_t{floats} * TriangleCount(after), 77);
      ASSERT_EQ(tpa_carry_triangles(context, faces.data(), floats, now.data()), TPA_OK);
      const std::vector<uint32_t> from = TriangleOriginsOf(context);
      std::vector<bool> has_origin;
      for (uint32_t origin : from) has_origin.push_back(origin != TPA_NONE);
      const std::vector<std::set<uint32_t>> near = NeighboursOfTriangles(after);
      const std::vector<uint32_t> source = RowSources(has_origin, near);
      for (uint32_t f = 0; f < from.size(); ++f) {
        const Rows zeros(floats, 0);
        const float* right = source[f] == TPA_NONE ? zeros.data() : &faces[size_t{floats} * from[source[f]]];
        ASSERT_TRUE(SameBits(right, &now[size_t{floats} * f], floats)) << "triangle " << f;
        if (has_origin[f]) continue;
        ++followed;
        far += near[f].count(source[f]) == 0 ? 1u : 0u;
      }
    });
  }
  EXPECT_GT(blended, Least(1000u));
  EXPECT_GT(followed, Least(300u));
  EXPECT_GT(far, Least(5u));  // across more than one edge
}

// In double precision: the sum of two products is right but for three roundings, which single precision would not be.
TEST(Carry, KeepsDoublePrecision) {
  size_t blended = 0;
  for (uint64_t seed = 1; seed <= Share(10u); ++seed) {
    Random random(seed);
    PlayRandomCommits(seed, 6, [&](tpa_context* context, const RandomCommit& commit) {
      const uint32_t width = static_cast<uint32_t>(1 + random() % 4);
      std::vector<double> before(size_t{width} * VertexCount(commit.before));
      for (double& x : before) x = Uniform(random, -1, 1);
      std::vector<double> now(size_t{width} * VertexCount(MeshOf(context)), 77);
      ASSERT_EQ(tpa_carry_vertices_f64(context, before.data(), width, now.data()), TPA_OK);
      const std::vector<tpa_vertex_origin> origins = VertexOriginsOf(context);
      for (size_t v = 0; v < origins.size(); ++v) {
        const tpa_vertex_origin& o = origins[v];
        const bool single = o.parents[1] == TPA_NONE || o.parents[0] == o.parents[1];
        const long double w = single ? 1.0L : static_cast<long double>(o.weight);
        blended += w != 1 && w != 0;
        for (uint32_t i = 0; i < width; ++i) {
          const double p = before[size_t{width} * o.parents[0] + i];
          const double q = single ? p : before[size_t{width} * o.parents[1] + i];
          const double got = now[width * v + i];
          if (w == 1 || w == 0) {
            ASSERT_EQ(std::memcmp(&got, w == 1 ? &p : &q, sizeof got), 0) << "vertex " << v;
            continue;
          }
          const long double right = w * static_cast<long double>(p) + (1 - w) * static_cast<long double>(q);
          ASSERT_LE(std::fabs(static_cast<long double>(got) - right), 0x1p-51L) << "vertex " << v;
        }
      }
    });
  }
  EXPECT_GT(blended, Least(500u));
}

TEST(Carry, IsTheIdentityAfterALoad) {
  Random random(1);
  const Mesh m = Sphere({0, 0, 0}, 1, 3);
  const Arena arena(ConfigFor(m), m);
  const Rows before = RandomRows(5 * TriangleCount(m), random);
  Rows after(5 * VertexCount(m));
  ASSERT_EQ(tpa_carry_vertices(*arena, before.data(), 5, after.data()), TPA_OK);
  EXPECT_TRUE(SameBits(before.data(), after.data(), after.size()));
  after.resize(5 * TriangleCount(m));
  ASSERT_EQ(tpa_carry_triangles(*arena, before.data(), 5, after.data()), TPA_OK);
  EXPECT_TRUE(SameBits(before.data(), after.data(), after.size()));
}

TEST(Carry, RefusesWrongArguments) {
  const Mesh m = Sphere({0, 0, 0}, 1, 3);
  const Arena arena(ConfigFor(m));
  Rows rows(TriangleCount(m)), other = rows;
  for (auto* carry : {tpa_carry_vertices, tpa_carry_triangles}) {
    EXPECT_EQ(carry(nullptr, rows.data(), 1, other.data()), TPA_E_CONTEXT);
    EXPECT_EQ(carry(*arena, nullptr, 1, other.data()), TPA_E_ARGUMENT);
    EXPECT_EQ(carry(*arena, rows.data(), 0, other.data()), TPA_E_ARGUMENT);
    EXPECT_EQ(carry(*arena, rows.data(), 1, nullptr), TPA_E_ARGUMENT);
  }
  EXPECT_EQ(tpa_carry_vertices(*arena, rows.data(), 1, other.data()), TPA_E_STATE);
  std::vector<double> doubles(TriangleCount(m)), carried = doubles;
  EXPECT_EQ(tpa_carry_vertices_f64(nullptr, doubles.data(), 1, carried.data()), TPA_E_CONTEXT);
  EXPECT_EQ(tpa_carry_vertices_f64(*arena, nullptr, 1, carried.data()), TPA_E_ARGUMENT);
  EXPECT_EQ(tpa_carry_vertices_f64(*arena, doubles.data(), 0, carried.data()), TPA_E_ARGUMENT);
  EXPECT_EQ(tpa_carry_vertices_f64(*arena, doubles.data(), 1, nullptr), TPA_E_ARGUMENT);
  EXPECT_EQ(tpa_carry_vertices_f64(*arena, doubles.data(), 1, carried.data()), TPA_E_STATE);
}

}  // namespace
}  // namespace carry_test
