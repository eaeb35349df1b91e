// SPDX-License-Identifier: MIT
// step_scenes: meshes that move until they run into themselves, played step by step, with the library's answers at each
// step.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "support/support.h"

namespace support {

struct Scene {
  const char* name;
  Mesh mesh;
  std::function<Point(const Point&)> target;  // target of a vertex at p after one step
  int most_steps;
  std::vector<int64_t> genera;  // expected at the end
};

// Two balls on their way to an overlap of so much on either side.
Scene TwoSpheres(double overlap, int fineness = 6);
// A spindle along x, thin in the middle; the middle is pressed flat until its sides pass each other.
Scene Dumbbell();
// An open ring round z, about to close: angles grow away from pi.
Scene ClosingRing();
// Spindles that arrive at one point in one step.
Scene ThreeSpindles();
Scene FourInACross();
Scene FourTetrahedral();
std::vector<Scene> AllScenes();
// The same with everything turned.
Scene Turned(Scene s, int rotation);

std::vector<double> TargetsOf(const Mesh& m, const std::function<Point(const Point&)>& target);
// Noise up to so much along each axis.
// Shaken targets on a coarse lattice, turned: many faces lie upon each other but for rounding. With max_passes = 1 an
// exact cut often leaves contacts that only rounding made.
std::vector<double> CoincidingTargets(const Mesh& m, Random& random);
std::vector<double> ShakenTargets(const Mesh& m, double most, Random& random);

// The vertex maps of the last commit must fit together, and keep all vertices untouched by events (P4).
void ExpectConsistentMaps(tpa_context* context, const Mesh& before, const std::vector<double>& targets);

struct Played {
  Topology topology;
  std::vector<tpa_event> events;  // of all steps
  uint32_t rolled_back = 0;
  Mesh mesh;
};

// Steps until the scene has its expected topology, judging the mesh after every step. Without a config, with
// ConfigFor(s.mesh).
Played PlayToTheEnd(const Scene& s, const std::string& name, const tpa_config* config = nullptr);

// Sum of the amounts of one kind of event.
uint32_t Amount(const std::vector<tpa_event>& events, int32_t type);
// How many components more there are after the commit of these events.
int64_t ComponentsMade(const std::vector<tpa_event>& events);
bool Has(const std::vector<tpa_event>& events, int32_t type, uint32_t amount);

}  // namespace support
