// SPDX-License-Identifier: MIT
// What cleaning says about itself, and about what is left open.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "tool/mend/clean.h"
#include "tool/mend/exact.h"

namespace tool {

namespace {

constexpr size_t most_holes_named = 10;

std::string count_of(size_t count, const char* one, const char* many) {
  return text_of(count, " ", count == 1 ? one : many);
}

std::string place_of(const CleanMesh& c, uint32_t v) {
  const double* p = &c.mesh.positions[3 * size_t{v}];
  return text_of("(", p[0], ",", p[1], ",", p[2], ")");
}

std::string vertex_of(const CleanMesh& c, uint32_t v) {
  const std::string place = place_of(c, v);
  return c.has_numbers ? text_of("vertex ", c.vertex_source[v] + c.first_vertex, " ", place) : place;
}

struct RimBox {
  double low[3], high[3];
};

RimBox rim_box(const CleanMesh& c, const Rim& rim) {
  constexpr double far = std::numeric_limits<double>::infinity();
  RimBox box = {{far, far, far}, {-far, -far, -far}};
  for (const uint32_t v : rim)
    for (size_t axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(box.low[axis], c.mesh.positions[3 * size_t{v} + axis]);
      box.high[axis] = std::max(box.high[axis], c.mesh.positions[3 * size_t{v} + axis]);
    }
  return box;
}

std::string text_of_rim(const CleanMesh& c, const Rim& rim) {
  const RimBox b = rim_box(c, rim);
  return text_of(count_of(rim.size(), "edge", "edges"), " in the box (", b.low[0], ",", b.low[1], ",", b.low[2],
                 ") to (", b.high[0], ",", b.high[1], ",", b.high[2], "), one from ", vertex_of(c, rim[0]), " to ",
                 vertex_of(c, rim[1 % rim.size()]));
}

// The length with two digits, no less than the distance.
std::string length_beyond(double distance) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.1e", 1.1 * distance);
  double rounded = 0;
  std::sscanf(digits, "%lf", &rounded);
  return text_of(rounded);
}

std::string remedy_of(const CleanMesh& c) {
  const std::vector<NearPair> near = near_pairs(c.mesh, c.rims);
  if (!near.empty()) {
    double farthest = 0;
    for (const NearPair& pair : near) farthest = std::max(farthest, pair.distance);
    const std::string more = near.size() > 1 ? text_of(", and ", near.size() - 1, " more lie so") : "";
    return text_of("; ", vertex_of(c, near[0].one), " lies only ", near[0].distance, " from ",
                   vertex_of(c, near[0].other), more, ": --weld ", length_beyond(farthest), " joins them");
  }
  size_t longest = 0;
  for (const Rim& rim : c.rims) longest = std::max(longest, rim.size());
  if (longest > longest_loop) return text_of("; --fill closes holes of up to ", longest_loop, " edges");
  return c.cleaning.blocked > 0 ? "" : text_of("; --fill ", longest, " closes such holes");
}

}  // namespace

std::vector<std::string> lines_of(const Cleaning& n) {
  std::vector<std::string> lines;
  const auto add = [&](size_t count, const char* one, const char* many, const std::string& what) {
    if (count > 0) lines.push_back(count_of(count, one, many) + what);
  };
  add(n.tiny, "coordinate", "coordinates", " of magnitude below 2^-100 (7.9e-31) read as 0");
  add(n.welded, "vertex", "vertices", " welded to another at the same position");
  add(n.joined, "vertex", "vertices", " joined with another within --weld");
  add(n.repeated, "triangle", "triangles", " with a corner twice left out");
  add(n.unused, "vertex", "vertices", " without a triangle left out");
  add(n.doubled, "face", "faces", " upon another of the same corners left out");
  add(n.turned, "facet", "facets", " turned, to wind as those round them do");
  if (n.copied > 0)
    lines.push_back(
        text_of("fans parted at ",
                n.parted > 0 ? count_of(n.parted, "edge", "edges") + " of more than two triangles" : "corners",
                ", with ", count_of(n.copied, "vertex", "vertices"), " more"));
  if (n.filled > 0)
    lines.push_back(
        text_of(count_of(n.filled, "hole", "holes"), " filled by ", count_of(n.added, "triangle", "triangles")));
  return lines;
}

void describe(JsonWriter& json, const Cleaning& n) {
  json.key("cleaned").begin_object().member("tiny_coordinates", n.tiny).member("welded", n.welded);
  json.member("joined", n.joined).member("repeated_corners", n.repeated).member("unused_vertices", n.unused);
  json.member("doubled_faces", n.doubled);
  json.member("turned_facets", n.turned).member("parted_edges", n.parted).member("copied_vertices", n.copied);
  json.member("filled_holes", n.filled).member("filling_triangles", n.added).end_object();
}

void describe_holes(JsonWriter& json, const CleanMesh& c) {
  json.key("holes").begin_array();
  for (const Rim& rim : c.rims) {
    const RimBox b = rim_box(c, rim);
    json.begin_object().member("edges", rim.size()).key("box").begin_array();
    for (const double* end : {b.low, b.high}) json.begin_array().value(end[0]).value(end[1]).value(end[2]).end_array();
    json.end_array().key("edge").begin_array();
    for (size_t i = 0; i < 2; ++i) {
      const double* p = &c.mesh.positions[3 * size_t{rim[i % rim.size()]}];
      json.begin_array().value(p[0]).value(p[1]).value(p[2]).end_array();
    }
    json.end_array().end_object();
  }
  json.end_array();
}

std::string line_of_holes(const CleanMesh& c) {
  if (c.against > 0)
    return text_of("the mesh has no outside: whatever facets are turned, at ", count_of(c.against, "edge", "edges"),
                   " two wind against each other, as from ", vertex_of(c, c.rims[0][0]), " to ",
                   vertex_of(c, c.rims[0][1 % c.rims[0].size()]));
  std::string line = text_of("the mesh is open, with ", count_of(c.rims.size(), "hole", "holes"), ": ");
  for (size_t i = 0; i < std::min(most_holes_named, c.rims.size()); ++i)
    line += (i > 0 ? "; " : "") + text_of_rim(c, c.rims[i]);
  if (c.rims.size() > most_holes_named) line += text_of("; and ", c.rims.size() - most_holes_named, " more");
  if (c.cleaning.blocked > 0)
    line += text_of("; ", c.cleaning.blocked, " could not be filled without triangles that meet the mesh");
  return line + remedy_of(c);
}

}  // namespace tool
