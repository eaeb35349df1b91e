// SPDX-License-Identifier: MIT
// clean: from a file's polygons to a mesh that the library takes, as far as the way there leaves no choice.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tool/io/polygon_mesh.h"
#include "tool/json.h"
#include "tool/mend/holes.h"
#include "tool/result.h"

namespace tool {

struct CleanOptions {
  double weld = 0;    // vertices within this length become one; 0: only at one position
  uint64_t fill = 0;  // most edges of a hole to close; 0: none
};

// How many of each.
struct Cleaning {
  size_t tiny = 0;               // coordinates below 2^-100, now 0
  size_t welded = 0;             // vertices at the position of another
  size_t joined = 0;             // vertices near another, by --weld
  size_t repeated = 0;           // triangles and polygons with a corner twice
  size_t unused = 0;             // vertices without a triangle
  size_t doubled = 0;            // polygons upon one of the same corners
  size_t turned = 0;             // facets the other way round than their neighbours
  size_t parted = 0;             // edges of four triangles or more
  size_t copied = 0;             // vertices more, for fans apart
  size_t filled = 0, added = 0;  // holes, and their triangles
  size_t blocked = 0;            // holes short enough, without a cover that meets nothing

  bool is_nothing() const;
};

struct CleanMesh {
  TriangleMesh mesh;
  Cleaning cleaning;
  std::vector<uint32_t> source;         // of each triangle, the file's; n - 2 for a polygon of n corners
  std::vector<uint32_t> vertex_source;  // of each vertex, the file's, from 0
  int64_t first_vertex = 0;             // number of the first vertex in the file
  bool has_numbers = true;              // of vertices, in the file
  std::vector<Rim> rims;                // holes left
  size_t against = 0;                   // edges of two triangles that no turning makes run in two directions
  TriangleMesh joined;                  // before fans were parted, with the first triangles; empty if none were
};

// Cleans in this order: tiny coordinates, equal positions, near positions, repeated corners, doubles, cuts of polygons,
// facets, holes, fans, unused vertices. Closed parts keep vertices at equal positions apart. Fails on coordinates that
// the library does not take.
Status clean(const std::string& path, PolygonMesh&& polygons, const CleanOptions& options, CleanMesh& result);

// A line for each kind of cleaning.
std::vector<std::string> lines_of(const Cleaning& cleaning);
// The member "cleaned".
void describe(JsonWriter& json, const Cleaning& cleaning);
// The member "holes".
void describe_holes(JsonWriter& json, const CleanMesh& mesh);

// One line: how many holes, the first ten, and a remedy.
std::string line_of_holes(const CleanMesh& mesh);

}  // namespace tool
