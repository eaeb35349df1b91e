// Loops for tests of the shortest handles, in positions of several kinds, and what is asked of all handles.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "base/vec3.h"
#include "support/handle_support.h"
#include "tool/scenes/elementary.h"

namespace shortest_support {

using handle_support::Face;
using handle_support::Handle;
using tpa::Vec3;

// Rounding of the enumeration's running sums, and of lengths that are compared.
inline constexpr double rounding = 1e-9;

struct Loops {
  std::vector<int> sides;
  std::vector<Vec3> points;
  std::vector<int> next, of;
  int mu = 0;

  void Add(const std::vector<Vec3>& loop) {
    const int n = static_cast<int>(loop.size());
    for (int v = 0; v < n; ++v) next.push_back(mu + (v + 1) % n), of.push_back(static_cast<int>(sides.size()));
    points.insert(points.end(), loop.begin(), loop.end());
    sides.push_back(n);
    mu += n;
  }
  double Distance(int a, int b) const {
    const Vec3 d = points[size_t(a)] - points[size_t(b)];
    return std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
  }
  // Half of an edge, which two triangles share; polygon edges count nothing.
  double Half(int a, int b) const { return of[size_t(a)] == of[size_t(b)] ? 0 : 0.5 * Distance(a, b); }
  int Faces() const { return mu + 2 * static_cast<int>(sides.size()) - 4; }
};

// Some faces that may not be used, whatever corner they begin with; every fifth or so.
inline bool IsFree(int a, int b, int c) {
  const unsigned sum = unsigned(a + 1) * unsigned(b + 1) * unsigned(c + 1) + unsigned(a + b + c);
  return (sum * 2654435761u >> 16) % 5 != 0;
}
template <class FaceOfVertices>
bool AskIsFree(void*, const FaceOfVertices& f) {
  return IsFree(int(f.v[0]), int(f.v[1]), int(f.v[2]));
}

inline double LengthOf(const Handle& handle, const Loops& loops) {
  double sum = 0;
  for (const Face& f : handle)
    for (size_t c = 0; c < 3; ++c) sum += loops.Half(f[c], f[(c + 1) % 3]);
  return sum;
}

// A handle that was found, and its length as the library has it.
struct Found {
  std::vector<Handle> handles;
  std::vector<double> lengths;
  bool complete = false;
};

// All that can be told of the handles without knowing the others: they are consistent, different, and in order.
inline void ExpectHandlesInOrder(const Found& found, const Loops& loops) {
  std::vector<Handle> seen;
  double last = 0;
  for (size_t i = 0; i < found.handles.size(); ++i) {
    const Handle& faces = found.handles[i];
    ASSERT_EQ(handle_support::WhyNotSphere(faces, loops.sides), "");
    ASSERT_FALSE(handle_support::HasChord(faces, loops.sides));
    EXPECT_NEAR(LengthOf(faces, loops), found.lengths[i], rounding * found.lengths[i]);
    EXPECT_GE(found.lengths[i], last);
    EXPECT_EQ(std::count(seen.begin(), seen.end(), faces), 0);
    seen.push_back(faces), last = found.lengths[i];
  }
}

// The first sixteen of all.
inline void ExpectSixteenInOrder(const Found& found, const Loops& loops) {
  SCOPED_TRACE(handle_support::Name(loops.sides));
  EXPECT_TRUE(found.complete);
  ASSERT_EQ(found.handles.size(), 16u);
  ExpectHandlesInOrder(found, loops);
}

enum class Positions { random, tied, symmetric, tiny, coincident };
inline constexpr Positions all_positions[] = {Positions::random, Positions::tied, Positions::symmetric, Positions::tiny,
                                              Positions::coincident};

// Loops about the corners of a regular polygon: moved at random, rounded to whole numbers, or neither; or all but
// the first one tiny, near one of its vertices; or all vertices of a loop but one at the same place.
inline Loops Make(const std::vector<int>& sides, Positions positions, unsigned seed) {
  std::mt19937 engine(seed);
  const auto unit = [&engine] { return static_cast<double>(engine()) / 4294967296.0; };
  constexpr double turn = 6.283185307179586;
  Loops loops;
  for (size_t l = 0; l < sides.size(); ++l) {
    std::vector<Vec3> loop;
    const double at = turn * static_cast<double>(l) / static_cast<double>(sides.size());
    for (int v = 0; v < sides[l]; ++v) {
      const double t = turn * v / sides[l];
      Vec3 p{2 * tool::cosine(at) + tool::cosine(t), 2 * tool::sine(at) - tool::sine(t), 0};
      if (positions == Positions::random) p = p + Vec3{unit(), unit(), unit()};
      if (positions == Positions::tied) p = {std::round(p.x + unit()), std::round(p.y + unit()), std::round(unit())};
      if (positions == Positions::tiny && l == 0) p = {3 * tool::cosine(t), -3 * tool::sine(t), 0};
      if (positions == Positions::tiny && l > 0)
        p = {3 + 0.1 * tool::cosine(t) + 0.3 * unit(), 0.1 * tool::sine(t) + 0.3 * (double(l) - 1), 0.2 * unit()};
      if (positions == Positions::coincident && v > 0) p = {2 * tool::cosine(at), 2 * tool::sine(at), 0};
      loop.push_back(p);
    }
    loops.Add(loop);
  }
  return loops;
}

inline constexpr tpa::u64 all_work = tpa::u64{1} << 40;

// The library's handles; by work, and with `filtered` of free faces only.
Found Find(const Loops& loops, tpa::u32 wanted, double limit, tpa::u64 work, bool filtered = false);

}  // namespace shortest_support
