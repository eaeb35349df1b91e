// SPDX-License-Identifier: MIT
// handle_lists: handles as plain lists of faces, and oracles upon them: the criterion of consistency, an advancing
// front that lists all consistent handles, and the symmetry of a handle.
#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace handle_lists {

using Face = std::array<int, 3>;
// Each face starting at its least corner, faces sorted: equal sets compare equal.
using Handle = std::vector<Face>;
using Sides = std::vector<int>;

// ---------------------------------------------------------------- keys

int Mu(const Sides& sides);
std::string Name(const Sides& sides);
// All keys of k sides from 3 on, longest first, with a given largest sum and side.
std::vector<Sides> Keys(int k, int largest_sum, int largest_side);

// The next vertex of each vertex on its polygon, and the polygon.
struct Polygons {
  std::vector<int> next, of;
};
Polygons PolygonsOf(const Sides& sides);

// ---------------------------------------------------------------- handles

Face Normal(Face f);
Handle Normal(Handle h);
std::string Print(const Handle& h);

int SumOfSquares(const Handle& h, int mu);
bool HasChord(const Handle& h, const Sides& sides);
// The handle and a cap on each polygon; the caps' own vertices are mu .. mu + k - 1.
Handle WithCaps(const Handle& h, const Sides& sides);
// Criterion 4.1 without homology: with a cap on every polygon, all links are one simple polygon, the surface is
// connected, and its Euler number is 2, or that of another genus. Empty when this holds.
std::string WhyNotSphere(const Handle& handle, const Sides& sides, int genus = 0);

// ---------------------------------------------------------------- symmetry

// Two handles of one key are equivalent (rotations of polygons, exchanges of polygons with equal sides) exactly when
// their codes are equal. The code lists the faces in the order of a walk from some polygon edge, for the edge with the
// least code. A symmetry that keeps orientation is known by its image of one polygon edge. So the edges with the least
// code count the symmetries of the handle.
struct Symmetry {
  std::vector<uint8_t> code;
  uint64_t stabiliser = 0;
};
Symmetry SymmetryOf(const Handle& h, const Sides& sides);
// Rotations and exchanges: the product of the sides and of the factorials of their multiplicities.
uint64_t GroupOrder(const Sides& sides);

// ---------------------------------------------------------------- all consistent handles

// Lists all consistent handles whose sum of squares is at most `limit`: the least directed edge without a face gets
// every possible face. Chords are allowed. Branches are cut only where the present faces cost too much: vertices have 3
// (mu + 2k - 4) corners in all, so the sum of squares is 9 mu + 42 (k - 2) plus twice the sum of (d - 3)(d - 4) / 2.
class AdvancingFront {
 public:
  AdvancingFront(Sides sides, int limit);
  void Run();
  std::set<Handle> found;

 private:
  bool PolygonEdge(int a, int b) const { return p_.next[size_t(a)] == b; }
  // The face of a directed edge is still missing: the edge is a polygon's, or its twin has been used.
  bool Missing(int a, int b) const;
  bool Allowed(int a, int b) const { return !used_[size_t(a)][size_t(b)] && !PolygonEdge(b, a); }
  void CountMissing(int a, int b, int sign);
  int Cost() const;
  void Put(Face f, int sign);

  Sides sides_;
  int limit_, mu_, faces_wanted_, allowance_;
  Polygons p_;
  std::vector<std::vector<char>> used_;
  std::vector<int> d_, missing_;  // faces at a vertex; directed edges at it that lack theirs
  Handle faces_;
};

}  // namespace handle_lists
