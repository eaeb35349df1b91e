// SPDX-License-Identifier: MIT
// balloon: the deformable model of Chen & Medioni (1995) that section 6 of the paper segments with, on the public
// interface alone. Small spheres inside the object inflate along their normals until they meet the object's border;
// springs between neighbours keep the mesh even. Topology is the library's business.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tool/events.h"
#include "tool/io/volume.h"
#include "tool/segment/object.h"
#include "tool/segment/thickness.h"
#include "tool/surface.h"

namespace tool {

// Lengths and places in millimetres.
struct BalloonOptions {
  std::vector<Point> seeds;  // centres of the initial balls
  double radius = 4;         // of the initial balls
  TriangleMesh first;        // in place of the balls, unless empty
  Threshold threshold;
  double edge_length = 1.7;  // as in the paper's meshes (table 1: area of the phantom / vertices)
  double edge_thin = 0;      // the shortest edges aimed at where the object is thin. 0: thin_fine of edge_length
  double edge_fine = 0;      // the shortest edges aimed at where voxels are left out. 0: least_fine of edge_length
  double coarseness = 1;     // edges are so many times longer while the balloon inflates; at rest they are refined to
                             // edge_length, and the balloon settles once more
  double speed = 0.38;       // k: edge lengths for each iteration where the image does not slow the balloon down
  double width = 0;          // w: grey values round T over which the speed falls to zero. 0: force_width (border.h)
  double noise = -1;         // standard deviation of grey values within the object. Below 0: measured (border.h)
  double tension = 0.25;     // g: part of the way to the mean of the neighbours
  uint32_t patience = 0;     // iterations for which touching parts go on through each other before they are
                             // joined: parts that overlap well join in one event, not corner by corner
  uint64_t most_iterations = 5000;
  int threads = 1;  // the result does not depend on them
};

// Thin parts begin with edges of this part of edge_length at least. What is left out then goes down to the second.
inline constexpr double thin_fine = 0.4, least_fine = 0.2;

// detect: steps without a contact (they move and detect); adapt: steps with contacts; evolve: the balloon's own forces.
struct BalloonSeconds {
  double total = 0, detect = 0, adapt = 0, remesh = 0, evolve = 0;
};

enum class Ended { at_rest, iterations, interrupted, limit };
const char* name_of(Ended ended);  // "at rest", "iterations", "interrupted", "limit"

struct BalloonResult {
  uint64_t iterations = 0;  // with those before a saved state
  Ended ended = Ended::at_rest;
  std::string limit;  // what the library says about an exceeded limit
  EventCounts events;
  BalloonSeconds seconds;
  double volume = 0;  // in mm3, after the last step
};

// What others do while the balloon inflates; each may be empty.
struct BalloonWatch {
  // Called after each iteration with the result so far. The volume in mm3.
  std::function<void(uint64_t iteration, uint32_t vertices, double at_rest_fraction, double volume)> progress;
  // Called before each iteration; ends the work if true.
  std::function<bool()> interrupted;
  // Called after each iteration; a failure is one of inflate. The surface holds the mesh.
  std::function<Status(uint64_t iteration)> frame;
};

// Bytes that a balloon goes on from as if never stopped. Fixed widths and little endian.
struct BalloonState {
  std::string bytes;
  bool livened = false;  // where edges are to be shorter than elsewhere, vertices at rest move on
};

// Inflates balls round the seeds or the first surface, or goes on from `resumed` if that holds bytes. The surface holds
// the mesh afterwards, as far as the work came: an exceeded limit is no failure once the balls are there. `left`
// receives the state to go on from, unless null. Fails if the library does, or if `resumed` is damaged. Precondition:
// the seeds lie in the object, and the width is positive.
Status inflate(const Volume& volume, const EdgeField& edges, const BalloonOptions& options, const BalloonWatch& watch,
               const BalloonState& resumed, Surface& surface, BalloonResult& result, BalloonState* left);

}  // namespace tool
