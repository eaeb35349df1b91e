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

bool Zip(std::vector<tpa::Loop> loops, const tpa::FacePlacer& placer, std::vector<u32>* left = nullptr,
         tpa::Genus genus = tpa::Genus::any, tpa::Along along = tpa::Along::others) {
  u32 vertices = 0;
  for (const tpa::Loop& loop : loops) vertices += loop.count;
  std::vector<tpa::Vec3> points;
  for (const tpa::Loop& loop : loops) points.insert(points.end(), loop.points, loop.points + loop.count);
  for (size_t l = 0, first = 0; l < loops.size(); first += loops[l++].count) loops[l].points = points.data() + first;
  std::vector<double> scratch(tpa::zip_scratch_bytes(vertices) / 8 + 1);
  std::vector<u32> room(vertices);
  tpa::Stack<u32> open{room.data(), vertices, 0};
  const bool closed = tpa::zip({loops.data(), static_cast<u32>(loops.size())},
                               {reinterpret_cast<tpa::u8*>(scratch.data()), static_cast<u32>(8 * scratch.size())},
                               genus, along, placer, open);
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
    const bool plain = seed % 2 == 0;
    if (!Zip(loops, {Place, TakeBack, &caller}, &left, plain ? tpa::Genus::zero : tpa::Genus::any,
             seed % 4 < 2 ? tpa::Along::others : tpa::Along::all)) {
      EXPECT_TRUE(std::is_sorted(left.begin(), left.end())) << "seed " << seed;
      EXPECT_TRUE(left.empty() || left.back() < vertices) << "seed " << seed;
      continue;
    }
    EXPECT_TRUE(left.empty()) << "seed " << seed;
    ++successes;
    const int handles = plain ? 0 : static_cast<int>(caller.faces.size() + 4 - vertices - 2 * loops.size()) / 4;
    EXPECT_TRUE(HasTheLoopsAsRim(sizes, caller.faces)) << "seed " << seed;
    EXPECT_EQ(WhyNotSphere(sizes, caller.faces, handles), "") << "seed " << seed;
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

// Four patches of a torus with gaps between them: the surface that closes them has a handle itself.
TEST(Zip, LeavesTheTunnelThatLoopsGoRound) {
  constexpr u32 along = 20, around = 10;
  std::vector<u32> sizes;
  std::vector<tpa::Vec3> points;
  for (int patch = 0; patch < 4; ++patch) {
    const auto add = [&](u32 u, u32 v) {  // of a patch of along x around parts
      const double a = pi * (patch % 2 + 0.05 + 0.9 * u / along), b = pi * (patch / 2 + 0.1 + 0.8 * v / around);
      const double r = 1 + 0.4 * std::cos(b);
      points.push_back({r * std::cos(a), r * std::sin(a), 0.4 * std::sin(b)});
    };
    for (u32 v = 0; v < around; ++v) add(0, v);
    for (u32 u = 0; u < along; ++u) add(u, around);
    for (u32 v = around; v > 0; --v) add(along, v);
    for (u32 u = along; u > 0; --u) add(u, 0);
    sizes.push_back(2 * (along + around));
  }
  std::vector<tpa::Loop> loops;
  for (u32 l = 0; l < sizes.size(); ++l) loops.push_back({&points[l * sizes[0]], sizes[l]});
  std::mt19937_64 random(1);
  Refusing caller{&random, 0, {}};
  ASSERT_TRUE(Zip(loops, {Place, TakeBack, &caller}));
  EXPECT_TRUE(HasTheLoopsAsRim(sizes, caller.faces));
  EXPECT_EQ(WhyNotSphere(sizes, caller.faces, 1), "");
}

double Area(const std::vector<tpa::Vec3>& points, const std::vector<tpa::FaceCorners>& faces) {
  double sum = 0;
  for (const auto& f : faces)
    sum += tpa::length(tpa::cross(points[f.v[1]] - points[f.v[0]], points[f.v[2]] - points[f.v[0]])) / 2;
  return sum;
}

// Two stars with long arms, one above the other, as at the ends of a channel whose creases meet: the sides of an arm
// are nearer to each other than to the other star.
TEST(Zip, ClosesLoopsWhereTheyRunAlongThemselves) {
  constexpr double width = 0.2, arm = 3, apart = 2;
  constexpr u32 arms = 3, steps = 20;
  std::vector<tpa::Vec3> points;
  for (u32 star = 0; star < 2; ++star) {
    const auto add = [&](u32 n, double along, double across) {
      const double turn = (star == 0 ? 2 : -2) * pi * n / arms;
      const double y = star == 0 ? across : -across;
      points.push_back({along * std::cos(turn) - y * std::sin(turn), along * std::sin(turn) + y * std::cos(turn),
                        star == 0 ? 0 : apart});
    };
    for (u32 n = 0; n < arms; ++n) {
      for (u32 i = 1; i <= steps; ++i) add(n, arm * i / steps, -width / 2);
      for (u32 i = steps; i >= 1; --i) add(n, arm * i / steps, width / 2);
    }
  }
  const u32 count = 2 * arms * steps;
  std::mt19937_64 random(1);
  const auto area = [&](tpa::Along along) {
    Refusing caller{&random, 0, {}};
    EXPECT_TRUE(Zip({{points.data(), count}, {points.data() + count, count}}, {Place, TakeBack, &caller}, nullptr,
                    tpa::Genus::zero, along));
    EXPECT_TRUE(HasTheLoopsAsRim({count, count}, caller.faces));
    EXPECT_EQ(WhyNotSphere({count, count}, caller.faces), "");
    return Area(points, caller.faces);
  };
  // The walls between the stars; or the arms and a tube, no more than twice as wide.
  const double walls = 2 * arms * arm * apart, flat = 2 * arms * arm * width, tube = 2 * pi * width * apart;
  EXPECT_GT(area(tpa::Along::others), 0.8 * walls);
  EXPECT_LT(area(tpa::Along::all), flat + 2 * tube);
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
