// SPDX-License-Identifier: MIT
// zip: whatever faces the caller refuses, a success is a surface with the loops as its rim.
#include "triangulate/advancing_front.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <vector>

#include "support/handle_support.h"
#include "support/point.h"
#include "support/share.h"

namespace {

using support::Least;
using support::pi;
using support::Share;

using tpa::u32;

struct Refusing {
  std::mt19937_64* random;
  double share;
  std::vector<tpa::FaceCorners> faces;
};

bool Place(void* caller, const tpa::FaceCorners& face) {
  auto& r = *static_cast<Refusing*>(caller);
  if (static_cast<double>((*r.random)() % 1000) < 1000 * r.share) return false;
  r.faces.push_back(face);
  return true;
}

void TakeBack(void* caller, u32 number) {
  auto& faces = static_cast<Refusing*>(caller)->faces;
  faces[number] = faces.back();
  faces.pop_back();
}

// Every edge of a loop is used once, forwards; every other edge once each way.
bool HasTheLoopsAsRim(const std::vector<u32>& sizes, const std::vector<tpa::FaceCorners>& faces) {
  std::map<std::pair<u32, u32>, int> used;
  for (const auto& f : faces)
    for (int i = 0; i < 3; ++i) ++used[{f.v[i], f.v[(i + 1) % 3]}];
  std::map<std::pair<u32, u32>, int> expected;
  for (u32 l = 0, first = 0; l < sizes.size(); first += sizes[l++])
    for (u32 i = 0; i < sizes[l]; ++i) expected[{first + i, first + (i + 1) % sizes[l]}] = 1;
  for (const auto& [edge, count] : used) {
    if (count != 1) return false;
    if (expected.erase(edge) == 0 && used.count({edge.second, edge.first}) == 0) return false;
  }
  return expected.empty();
}

// With a cap on each loop, is it one sphere without pinched vertices, or a surface with so many handles? Empty if so.
std::string WhyNotSphere(const std::vector<u32>& sizes, const std::vector<tpa::FaceCorners>& faces, int genus = 0) {
  handle_support::Handle handle;
  for (const auto& f : faces) handle.push_back({int(f.v[0]), int(f.v[1]), int(f.v[2])});
  return handle_support::WhyNotSphere(handle, {sizes.begin(), sizes.end()}, genus);
}

bool Zip(std::vector<tpa::Loop> loops, const tpa::FacePlacer& placer, std::vector<u32>* left = nullptr) {
  u32 vertices = 0;
  for (const tpa::Loop& loop : loops) vertices += loop.count;
  std::vector<tpa::Vec3> points;
  for (const tpa::Loop& loop : loops) points.insert(points.end(), loop.points, loop.points + loop.count);
  for (size_t l = 0, first = 0; l < loops.size(); first += loops[l++].count) loops[l].points = points.data() + first;
  std::vector<double> scratch(tpa::zip_scratch_bytes(vertices) / 8 + 1);
  std::vector<u32> room(vertices);
  tpa::Stack<u32> open{room.data(), vertices, 0};
  const bool closed =
      tpa::zip({loops.data(), static_cast<u32>(loops.size())},
               {reinterpret_cast<tpa::u8*>(scratch.data()), static_cast<u32>(8 * scratch.size())}, placer, open);
  if (left != nullptr) left->assign(room.begin(), room.begin() + open.size);
  return closed;
}

TEST(Zip, ASuccessIsASurfaceWithTheLoopsAsItsRim) {
  u32 successes = 0;
  for (uint64_t seed = 1; seed <= Share(6000u); ++seed) {
    std::mt19937_64 random(seed);
    const auto unit = [&] { return static_cast<double>(random() % 10000) / 10000; };
    std::vector<u32> sizes(1 + random() % 4);
    std::vector<std::vector<tpa::Vec3>> points;
    u32 vertices = 0;
    for (u32& n : sizes) {
      n = 3 + static_cast<u32>(random() % 9);
      vertices += n;
      points.emplace_back();
      for (u32 i = 0; i < n; ++i) points.back().push_back({unit(), unit(), unit()});
    }
    std::vector<tpa::Loop> loops;
    for (u32 l = 0; l < sizes.size(); ++l) loops.push_back({points[l].data(), sizes[l]});
    Refusing caller{&random, 0.2 * static_cast<double>(seed % 3), {}};
    std::vector<u32> left;
    if (!Zip(loops, {Place, TakeBack, &caller}, &left)) {
      EXPECT_TRUE(std::is_sorted(left.begin(), left.end())) << "seed " << seed;
      EXPECT_TRUE(left.empty() || left.back() < vertices) << "seed " << seed;
      continue;
    }
    EXPECT_TRUE(left.empty()) << "seed " << seed;
    ++successes;
    EXPECT_TRUE(HasTheLoopsAsRim(sizes, caller.faces)) << "seed " << seed;
    EXPECT_EQ(WhyNotSphere(sizes, caller.faces), "") << "seed " << seed;
  }
  EXPECT_GT(successes, Least(2000u));
}

// As many loops as a piece can have, spread over a sphere.
TEST(Zip, JoinsManyLoops) {
  constexpr u32 count = 256, sides = 30;
  const std::vector<u32> sizes(count, sides);
  std::vector<tpa::Vec3> points;
  for (u32 l = 0; l < count; ++l) {
    const double z = 1 - (2 * l + 1.0) / count, turn = 2.399963229728653 * l, r = std::sqrt(1 - z * z);
    const tpa::Vec3 axis{r * std::cos(turn), r * std::sin(turn), z}, x{-std::sin(turn), std::cos(turn), 0};
    const tpa::Vec3 y = tpa::cross(axis, x);
    for (u32 i = 0; i < sides; ++i) {
      const double a = -2 * pi * i / sides;
      points.push_back(axis + 0.04 * std::cos(a) * x + 0.04 * std::sin(a) * y);
    }
  }
  std::vector<tpa::Loop> loops;
  for (u32 l = 0; l < count; ++l) loops.push_back({&points[l * sides], sides});
  const u32 vertices = count * sides;
  for (double refused : {0.0, 0.3}) {
    std::mt19937_64 random(1);
    Refusing caller{&random, refused, {}};
    ASSERT_TRUE(Zip(loops, {Place, TakeBack, &caller}));
    EXPECT_EQ(caller.faces.size(), vertices + 2 * count - 4);
    EXPECT_TRUE(HasTheLoopsAsRim(sizes, caller.faces));
    EXPECT_EQ(WhyNotSphere(sizes, caller.faces), "");
  }
}

// A polygon some of whose faces are not free.
struct Sparse {
  u32 free[16][16];  // by the corners in ascending order; a bit for the third
  std::vector<tpa::FaceCorners> faces;

  bool IsFree(u32 a, u32 b, u32 c) const {
    u32 v[3] = {a, b, c};
    std::sort(v, v + 3);
    return (free[v[0]][v[1]] >> v[2] & 1) != 0;
  }
  static bool Place(void* caller, const tpa::FaceCorners& face) {
    auto& s = *static_cast<Sparse*>(caller);
    if (!s.IsFree(face.v[0], face.v[1], face.v[2])) return false;
    s.faces.push_back(face);
    return true;
  }
  static void TakeBack(void* caller, u32 number) {
    auto& faces = static_cast<Sparse*>(caller)->faces;
    faces[number] = faces.back();
    faces.pop_back();
  }
};

// Has the polygon from corner i to corner k a triangulation of free faces?
bool CanBeClosed(const Sparse& s, u32 i, u32 k) {
  if (k == i + 1) return true;
  for (u32 j = i + 1; j < k; ++j)
    if (s.IsFree(i, j, k) && CanBeClosed(s, i, j) && CanBeClosed(s, j, k)) return true;
  return false;
}

TEST(Zip, MostlyFindsWhatThereIs) {
  constexpr u32 n = 9;
  u32 exist = 0, found = 0;
  for (uint64_t seed = 1; seed <= Share(1000u); ++seed) {
    std::mt19937_64 random(seed);
    std::vector<tpa::Vec3> points(n);
    for (tpa::Vec3& p : points)
      for (double* x : {&p.x, &p.y, &p.z}) *x = static_cast<double>(random() % 10000) / 10000;
    Sparse caller{};
    for (auto& row : caller.free)
      for (u32& bits : row)
        for (u32 k = 0; k < 16; ++k) bits |= (random() % 100 < 45 ? 1u : 0u) << k;
    const bool exists = CanBeClosed(caller, 0, n - 1);
    const tpa::Loop loop{points.data(), n};
    const bool closed = Zip({loop}, {Sparse::Place, Sparse::TakeBack, &caller});
    EXPECT_FALSE(closed && !exists) << "seed " << seed;
    if (closed) {
      EXPECT_TRUE(HasTheLoopsAsRim({n}, caller.faces)) << "seed " << seed;
      EXPECT_EQ(WhyNotSphere({n}, caller.faces), "") << "seed " << seed;
    }
    exist += exists;
    found += closed;
  }
  std::printf("%u can be closed, %u were\n", exist, found);
  EXPECT_GT(exist, Least(100u));
  EXPECT_GE(found, 3 * exist / 4);
}

}  // namespace
