// SPDX-License-Identifier: MIT
// film: a run in bounded memory, for pages and pictures: meshes now and then, numbers at each moment, events with their
// places. Beyond a bound, every other mesh or moment goes, and later ones are taken half as often.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tool/events.h"
#include "tool/io/affine.h"
#include "tool/io/mesh_io.h"

namespace tool {

struct FilmFrame {
  double time = 0;
  std::string name;  // in place of the time, if not empty
  TriangleMesh mesh;
  std::vector<uint8_t> marks;  // 1 for each triangle to stand out; empty: none does
  size_t triangles = 0;        // before the mesh was coarsened; 0: as it is
};

struct FilmMoment {
  double time = 0;
  long genus = 0;
  size_t components = 0, vertices = 0;
  double volume = 0;
};

// Changes of topology at a moment. Their counts are those of EventCounts.
struct FilmEvent {
  double time = 0;
  uint64_t merge = 0, split = 0, genus_up = 0, genus_down = 0, death = 0, rollback = 0;
  std::vector<Point> places;  // of handles and caps
};

struct Film {
  Affine map;  // takes places of the run to those shown
  std::vector<FilmFrame> frames;
  std::vector<FilmMoment> moments;
  std::vector<FilmEvent> events;
  size_t frame_stride = 1, moment_stride = 1;  // of the moments seen
  size_t seen = 0, events_left_out = 0;

  // A moment of a run, with the sums of all events up to it.
  void add(double time, const TriangleMesh& mesh, const EventCounts& counts);
  // A mesh by name, not of a run. `marks` as in FilmFrame.
  void add(const std::string& name, const TriangleMesh& mesh, std::vector<uint8_t> marks);
  // The last mesh, in full. Takes the place of a frame of that time.
  void end(double time, const TriangleMesh& mesh);

 private:
  EventCounts last_;
};

// Bounds of a film: the triangles of all frames, of one frame but the last, and of the last.
inline constexpr size_t most_film_triangles = 1200000, most_frame_triangles = 50000, most_last_triangles = 1000000;
inline constexpr size_t most_frames = 100, most_moments = 4096, most_events = 4096;

// The mesh with its vertices gathered in the cells of a grid, in at most so many triangles: a drawing, not a manifold.
TriangleMesh coarse_drawing(const TriangleMesh& mesh, size_t most_triangles);

}  // namespace tool
