// SPDX-License-Identifier: MIT
#include "tool/view/film.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "tool/topology.h"

namespace tool {

namespace {

TriangleMesh mapped(const Affine& map, TriangleMesh mesh) {
  for (size_t v = 0; v < mesh.positions.size(); v += 3) {
    const Point p = map({mesh.positions[v], mesh.positions[v + 1], mesh.positions[v + 2]});
    std::copy(p.begin(), p.end(), &mesh.positions[v]);
  }
  if (determinant(map) < 0) turn_round(mesh);
  return mesh;
}

FilmMoment measured(double time, const TriangleMesh& mesh) {
  FilmMoment m{time, 0, 0, mesh.positions.size() / 3, 0};
  for (const Part& p : parts_of(mesh)) {
    m.genus += p.genus;
    m.volume += p.volume;
    ++m.components;
  }
  return m;
}

FilmEvent difference(double time, const EventCounts& now, const EventCounts& before) {
  return {time,
          now.merge - before.merge,
          now.split - before.split,
          now.genus_up - before.genus_up,
          now.genus_down - before.genus_down,
          now.death - before.death,
          now.rollback - before.rollback,
          {now.places.begin() + static_cast<std::ptrdiff_t>(before.places.size()), now.places.end()}};
}

bool has_happened(const FilmEvent& e) {
  return e.merge + e.split + e.genus_up + e.genus_down + e.death + e.rollback > 0;
}

template <class Entry>
void drop_every_other(std::vector<Entry>& entries) {
  size_t kept = 0;
  for (size_t i = 0; i < entries.size(); i += 2) std::swap(entries[kept++], entries[i]);
  entries.resize(kept);
}

size_t triangles_of(const std::vector<FilmFrame>& frames) {
  size_t count = 0;
  for (const FilmFrame& f : frames) count += f.mesh.triangles.size() / 3;
  return count;
}

double area_of(const TriangleMesh& mesh) {
  const auto vertex = [&](size_t corner) {
    const double* p = &mesh.positions[3 * size_t{mesh.triangles[corner]}];
    return Point{p[0], p[1], p[2]};
  };
  double area = 0;
  for (size_t f = 0; f < mesh.triangles.size(); f += 3)
    area += length(cross(vertex(f + 1) - vertex(f), vertex(f + 2) - vertex(f))) / 2;
  return area;
}

// Cells of the given side that hold vertices: their means, and the triangles with corners in three of them.
TriangleMesh gathered(const TriangleMesh& mesh, const Point& low, double side) {
  std::unordered_map<uint64_t, uint32_t> cells;
  std::vector<uint32_t> cell_of(mesh.positions.size() / 3), count;
  TriangleMesh out;
  for (size_t v = 0; v < cell_of.size(); ++v) {
    uint64_t key = 0;
    for (size_t axis = 0; axis < 3; ++axis)
      key = key << 21 | static_cast<uint64_t>((mesh.positions[3 * v + axis] - low[axis]) / side);
    const auto [cell, is_new] = cells.emplace(key, static_cast<uint32_t>(count.size()));
    cell_of[v] = cell->second;
    if (is_new) {
      count.push_back(0);
      out.positions.insert(out.positions.end(), 3, 0.0);
    }
    ++count[cell->second];
    for (size_t axis = 0; axis < 3; ++axis)
      out.positions[3 * size_t{cell->second} + axis] += mesh.positions[3 * v + axis];
  }
  for (size_t i = 0; i < out.positions.size(); ++i) out.positions[i] /= count[i / 3];
  for (size_t f = 0; f < mesh.triangles.size(); f += 3) {
    const uint32_t a = cell_of[mesh.triangles[f]], b = cell_of[mesh.triangles[f + 1]],
                   c = cell_of[mesh.triangles[f + 2]];
    if (a != b && b != c && c != a) out.triangles.insert(out.triangles.end(), {a, b, c});
  }
  return out;
}

FilmFrame frame_of(double time, const TriangleMesh& mesh, const Affine& map, size_t most) {
  FilmFrame frame{time, {}, mapped(map, mesh), {}, 0};
  if (mesh.triangles.size() / 3 <= most) return frame;
  frame.triangles = mesh.triangles.size() / 3;
  frame.mesh = coarse_drawing(frame.mesh, most);
  return frame;
}

}  // namespace

TriangleMesh coarse_drawing(const TriangleMesh& mesh, size_t most_triangles) {
  if (mesh.triangles.size() / 3 <= most_triangles) return mesh;
  Point low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    low[i % 3] = std::min(low[i % 3], mesh.positions[i]);
    high[i % 3] = std::max(high[i % 3], mesh.positions[i]);
  }
  const double extent = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  // A plane meets some 1.5 cells for each square of a cell's side, and has two triangles for each vertex. A key of
  // gathered() has room for 2^20 cells along an axis.
  double side = std::max(std::sqrt(2.5 * area_of(mesh) / static_cast<double>(most_triangles)), extent / 0x1p20);
  for (; side < extent; side *= 1.15) {
    TriangleMesh coarse = gathered(mesh, low, side);
    if (coarse.triangles.size() / 3 <= most_triangles) return coarse;
  }
  return {};
}

void Film::add(double time, const TriangleMesh& mesh, const EventCounts& counts) {
  FilmEvent event = difference(time, counts, last_);
  last_ = counts;
  const bool changed = has_happened(event);
  if (changed) {
    for (Point& p : event.places) p = map(p);
    events.size() < most_events ? events.push_back(std::move(event)) : void(++events_left_out);
  }
  if (seen % moment_stride == 0 || changed) moments.push_back(measured(time, mesh));
  if (moments.size() > most_moments) {
    drop_every_other(moments);
    moment_stride *= 2;
  }
  if (seen % frame_stride == 0) frames.push_back(frame_of(time, mesh, map, most_frame_triangles));
  while (frames.size() > 2 && (frames.size() > most_frames || triangles_of(frames) > most_film_triangles)) {
    drop_every_other(frames);
    frame_stride *= 2;
  }
  ++seen;
}

void Film::add(const std::string& name, const TriangleMesh& mesh, std::vector<uint8_t> marks) {
  FilmFrame frame = frame_of(static_cast<double>(frames.size()), mesh, map, most_last_triangles);
  frame.name = name;
  // A coarser drawing has other triangles.
  if (frame.triangles == 0) frame.marks = std::move(marks);
  moments.push_back(measured(frame.time, mesh));
  frames.push_back(std::move(frame));
}

void Film::end(double time, const TriangleMesh& mesh) {
  if (!frames.empty() && frames.back().time == time) frames.pop_back();
  if (!moments.empty() && moments.back().time == time) moments.pop_back();
  frames.push_back(frame_of(time, mesh, map, most_last_triangles));
  moments.push_back(measured(time, mesh));
}

}  // namespace tool
