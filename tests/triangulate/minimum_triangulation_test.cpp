// SPDX-License-Identifier: MIT
// best_disc() against the plain program of Klincsek: all faces asked about, every side split at every corner, the first
// of the best taken. Both give the same faces, in the same order of sums, and so the same ties.
#include "triangulate/minimum_triangulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace minimum_triangulation_test {
namespace {

using tpa::Vec3;
using Face = std::array<tpa::u32, 3>;

constexpr double endless = std::numeric_limits<double>::infinity();

// A polygon; some faces are taken, and some chords are not allowed.
struct Problem {
  std::vector<Vec3> points;
  std::vector<tpa::u32> loop_of;  // empty: all chords are allowed
  unsigned percent = 0;           // of the faces that are taken
  size_t asked = 0;

  bool IsFree(size_t a, size_t b, size_t c) const {
    const uint64_t sum = (a + 1) * (b + 1) * (c + 1) * 31 + a + b + c;
    return (sum * 0x9e3779b97f4a7c15u >> 33) % 100 >= percent;
  }
  double Chord(size_t i, size_t j) const {
    if (j - i == 1 || (i == 0 && j + 1 == points.size())) return 0;
    if (!loop_of.empty() && loop_of[i] == loop_of[j]) return endless;
    return tpa::length(points[i] - points[j]);
  }
};

bool Ask(void* caller, const tpa::FaceCorners& f) {
  Problem& p = *static_cast<Problem*>(caller);
  ++p.asked;
  return p.IsFree(f.v[0], f.v[1], f.v[2]);
}

// Empty without any triangulation.
std::vector<Face> PlainDisc(const Problem& p) {
  const size_t n = p.points.size();
  std::vector<std::vector<double>> least(n, std::vector<double>(n, 0));
  std::vector<std::vector<size_t>> split(n, std::vector<size_t>(n, 0));
  for (size_t span = 2; span < n; ++span)
    for (size_t i = 0; i + span < n; ++i) {
      const size_t j = i + span;
      double best = endless;
      for (size_t k = i + 1; k < j; ++k) {
        if (!p.IsFree(i, k, j)) continue;
        const double cost = least[i][k] + least[k][j];
        if (cost < best) best = cost, split[i][j] = k;
      }
      least[i][j] = best + p.Chord(i, j);
    }
  std::vector<Face> faces;
  if (least[0][n - 1] == endless) return faces;
  std::vector<std::array<size_t, 2>> sides{{0, n - 1}};
  while (!sides.empty()) {
    const auto [i, j] = sides.back();
    sides.pop_back();
    if (j - i < 2) continue;
    const size_t k = split[i][j];
    faces.push_back({static_cast<tpa::u32>(i), static_cast<tpa::u32>(k), static_cast<tpa::u32>(j)});
    sides.push_back({i, k});
    sides.push_back({k, j});
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

std::vector<Face> BestDisc(Problem& p) {
  const tpa::u32 n = static_cast<tpa::u32>(p.points.size());
  std::vector<tpa::u32> corners(n);
  for (tpa::u32 i = 0; i < n; ++i) corners[i] = i;
  tpa::DiscNotes notes;
  std::vector<uint64_t> room(4 * size_t{n});
  tpa::Carver carver{reinterpret_cast<tpa::u8*>(room.data()), tpa::element_alignment};
  tpa::carve(carver, n, notes);
  EXPECT_LE(carver.bytes, room.size() * sizeof room[0]);
  tpa::Disc disc{p.points.data(), corners.data(), n, p.loop_of.empty() ? nullptr : p.loop_of.data(), nullptr, 0, {},
                 &notes};
  if (p.percent > 0) disc.filter = {Ask, &p};
  // Whatever lay there before, and not a byte more.
  const tpa::u64 bytes = p.percent > 0 ? tpa::filtered_disc_scratch_bytes(n) : tpa::disc_scratch_bytes(n);
  std::vector<double> scratch(bytes / sizeof(double), -1e99);
  EXPECT_EQ(bytes % sizeof(double), 0u);
  std::vector<tpa::FaceCorners> out(n - 2);
  std::vector<Face> faces;
  if (!tpa::best_disc(disc, reinterpret_cast<tpa::u8*>(scratch.data()), out.data())) return faces;
  for (const auto& f : out) faces.push_back({f.v[0], f.v[1], f.v[2]});
  std::sort(faces.begin(), faces.end());
  return faces;
}

// A narrow strip bent to a C with jagged rims, as surfaces leave it that meet along a crease.
std::vector<Vec3> Crescent(size_t n, std::mt19937& engine) {
  const auto unit = [&] { return static_cast<double>(engine()) / 4294967296.0; };
  std::vector<Vec3> points;
  for (size_t v = 0; v < n; ++v) {
    const double along = static_cast<double>(v) / static_cast<double>(n);
    const double t = 10 * std::abs(along - 0.5), side = along < 0.5 ? -1 : 1;
    const double r = 10 + side * (0.2 + 0.4 * unit());
    points.push_back({r * std::cos(t), r * std::sin(t), 0.3 * unit()});
  }
  return points;
}
// Corners of a coarse lattice, with many ties and some corners in one place.
std::vector<Vec3> Lattice(size_t n, std::mt19937& engine) {
  std::vector<Vec3> points;
  const auto below = [&](unsigned m) { return static_cast<double>(engine() % m); };
  for (size_t v = 0; v < n; ++v) {
    const double x = below(4), y = below(4);
    points.push_back({x, y, below(2)});
  }
  return points;
}

void ExpectPlain(Problem& p) {
  SCOPED_TRACE(std::to_string(p.points.size()) + " corners, " + std::to_string(p.percent) + " % taken" +
               (p.loop_of.empty() ? "" : ", in loops"));
  EXPECT_EQ(BestDisc(p), PlainDisc(p));
}

TEST(Disc, IsThePlainOne) {
  std::mt19937 engine(1);
  for (unsigned n : {3u, 4u, 5u, 6u, 7u, 8u, 9u, 10u, 13u, 14u, 15u, 16u, 40u, 96u})
    for (unsigned percent : {0u, 10u, 40u, 80u})
      for (int i = 0; i < 4; ++i) {
        Problem p{i % 2 == 0 ? Crescent(n, engine) : Lattice(n, engine), {}, percent};
        ExpectPlain(p);
      }
}

TEST(Disc, IsThePlainOneOfManyCorners) {
  std::mt19937 engine(2);
  for (unsigned n : {97u, 130u, 201u, 277u})
    for (unsigned percent : {0u, 1u, 10u})
      for (int i = 0; i < 2; ++i) {
        Problem p{i == 0 ? Crescent(n, engine) : Lattice(n, engine), {}, percent};
        ExpectPlain(p);
      }
  Problem longest{Crescent(tpa::longest_disc, engine), {}, 1};
  ExpectPlain(longest);
}

// Chords that are not allowed leave holes in the table.
TEST(Disc, IsThePlainOneBetweenLoops) {
  std::mt19937 engine(3);
  int some = 0;
  for (unsigned n : {4u, 7u, 12u, 33u, 64u, 150u})
    for (unsigned percent : {0u, 5u, 20u})
      for (int i = 0; i < 6; ++i) {
        Problem p{i % 2 == 0 ? Crescent(n, engine) : Lattice(n, engine), {}, percent};
        for (size_t v = 0; v < n; ++v) p.loop_of.push_back(static_cast<tpa::u32>(v * 5 / (2 * n)));
        // Two corners in one loop are mostly not joined, so the plain one has no edge twice.
        const std::vector<Face> want = PlainDisc(p);
        some += want.empty() ? 0 : 1;
        EXPECT_EQ(BestDisc(p), want) << n << ' ' << percent << ' ' << i;
      }
  EXPECT_GT(some, 50);
}

// A question costs a search in the mesh, so unnecessary questions count as errors.
TEST(Disc, AsksAboutFew) {
  std::mt19937 engine(4);
  Problem p{Crescent(277, engine), {}, 5};
  EXPECT_EQ(BestDisc(p), PlainDisc(p));
  EXPECT_LT(p.asked, 4 * p.points.size());
  EXPECT_GE(p.asked, p.points.size() - 2);
}

}  // namespace
}  // namespace minimum_triangulation_test
