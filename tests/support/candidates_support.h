// SPDX-License-Identifier: MIT
// candidates_support: loops in positions of several kinds, the library's candidates for them, hindered faces, and a
// check of every promise of a handle, without any code of the library.
#pragma once

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "triangulate/candidates.h"

namespace candidates_support {

using tpa::Vec3;
using Loops = std::vector<std::vector<Vec3>>;
using Faces = std::vector<tpa::FaceCorners>;

size_t Mu(const Loops& loops);
// Half the sum over all face edges; polygon edges count a half, the same for all candidates.
double Length(const Loops& loops, const Faces& faces);
// Half the lengths of the loops' edges.
double LoopEdges(const Loops& loops);
// Empty when the faces are a consistent handle or cap.
std::string WhyNotConsistent(const Loops& loops, const Faces& faces);

struct Search {
  Loops points;
  std::vector<tpa::Loop> loops;
  std::vector<tpa::u64> scratch;
  tpa::CandidateSearch search;

  explicit Search(Loops p, tpa::CandidateOptions options = {});
  bool Next(Faces& faces);
};

enum class Positions { random, tied, symmetric };

struct Maker {
  std::mt19937 engine;
  explicit Maker(unsigned seed) : engine(seed) {}
  double Unit() { return static_cast<double>(engine()) / 4294967296.0; }
  // Loops about the corners of a regular polygon; ties by coordinates on a coarse grid, or exact symmetry.
  Loops Make(const std::vector<int>& sides, Positions positions);
};
constexpr Positions all_positions[] = {Positions::random, Positions::tied, Positions::symmetric};

// Some faces that may not be used; every fifth or so.
bool IsFree(void*, const tpa::FaceCorners& f);
bool AreFree(const Faces& faces);

// A share of the faces is not free; counts how often it is asked.
struct Hindrance {
  unsigned percent;
  size_t asked = 0;
};
bool IsFreeOf(const Hindrance& h, size_t a, size_t b, size_t c);
bool AskHindrance(void* caller, const tpa::FaceCorners& f);

}  // namespace candidates_support
