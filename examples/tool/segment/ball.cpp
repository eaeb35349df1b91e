// SPDX-License-Identifier: MIT
#include "tool/segment/ball.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace tool {

namespace {

// Vertices for each square edge length of a surface of equilateral triangles.
constexpr double vertices_of_square = 1.1547;
// Faces of voxels in steps have half as much area again as the smooth surface that they stand for.
constexpr double smooth_part = 2.0 / 3;

Point point_of(const Index& v) { return {double(v.i), double(v.j), double(v.k)}; }

// Calls visit(voxel, distance) for the voxels whose centres lie within `radius` of `seed`.
template <class Visit>
void for_each_voxel_in_ball(const Volume& volume, const Point& seed, double radius, Visit visit) {
  const Affine to_index = inverse(volume.to_world);
  const Point middle = to_index(seed);
  const int size[3] = {volume.nx, volume.ny, volume.nz};
  int first[3], last[3];
  for (size_t k = 0; k < 3; ++k) {
    // The k-th index grows fastest along the gradient of the map.
    const double reach = radius * length({to_index.axes[0][k], to_index.axes[1][k], to_index.axes[2][k]});
    first[k] = static_cast<int>(std::clamp(std::ceil(middle[k] - reach), 0.0, double(size[k])));
    last[k] = static_cast<int>(std::clamp(std::floor(middle[k] + reach), -1.0, double(size[k] - 1)));
  }
  for (int k = first[2]; k <= last[2]; ++k)
    for (int j = first[1]; j <= last[1]; ++j)
      for (int i = first[0]; i <= last[0]; ++i) {
        const double away = length(volume.to_world(point_of({i, j, k})) - seed);
        if (away <= radius) visit(Index{i, j, k}, away);
      }
}

// Grey value, mask, two grids of distances, and the part of the edge: thickness.cpp.
constexpr double bytes_of_voxel = 4 + 1 + 2 * 4 + 1;

// Bytes that this process may take.
double memory_bound() {
  double bytes = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    bytes = std::min(bytes, static_cast<double>(limit.rlim_cur));
  return bytes;
}

// `what` starts the message about `vertices` of edges aimed at.
Status check_vertices(const std::string& what, double vertices, double memory, const SurfaceBounds& bounds) {
  const double most = static_cast<double>(bounds.vertices);
  if (!(vertices <= most))
    return failure(what, " takes some ", std::floor(vertices), " vertices, more than --max-vertices ", bounds.vertices);
  tpa_config config;
  tpa_config_init(&config, sizeof config);
  config.max_vertices = static_cast<uint32_t>(std::max(4.0, vertices));
  tpa_arena_size size{};
  tpa_issue issue;
  if (tpa_arena_query(&config, &size, &issue) != TPA_OK) return failure(what, ": ", describe(issue));
  if (static_cast<double>(size.bytes) > memory || size.bytes > bounds.bytes)
    return failure(what, " takes some ", std::floor(vertices), " vertices and ", size.bytes,
                   " bytes of memory, more than there are (--max-bytes and this machine allow ",
                   std::floor(std::min(memory, static_cast<double>(bounds.bytes))), ")");
  return success();
}

}  // namespace

BallFit fit_balls(const Volume& volume, const Threshold& threshold, const Object& object,
                  const std::vector<Point>& seeds, double radius) {
  BallFit fit;
  for (const Point& seed : seeds)
    for_each_voxel_in_ball(volume, seed, radius, [&](const Index& v, double) {
      const size_t id = volume.index(v.i, v.j, v.k);
      ++fit.voxels;
      if (object.mask[id] != 0) {
        ++fit.object;
      } else if (threshold.depth(static_cast<double>(volume.values[id])) > 0) {
        ++fit.foreign;
        fit.neighbour = v;
      }
    });
  return fit;
}

BallFit fit_start(const std::vector<uint8_t>& start, const Object& object) {
  BallFit fit;
  for (size_t id = 0; id < start.size(); ++id) {
    fit.voxels += start[id] != 0 ? 1u : 0u;
    fit.object += start[id] != 0 && object.mask[id] != 0 ? 1u : 0u;
  }
  return fit;
}

double fitting_radius(const Volume& volume, const Object& object, const std::vector<Point>& seeds, double most) {
  double radius = most;
  for (const Point& seed : seeds)
    for_each_voxel_in_ball(volume, seed, radius, [&](const Index& v, double away) {
      if (object.mask[volume.index(v.i, v.j, v.k)] == 0) radius = std::min(radius, away);
    });
  return std::max(radius, mean_side(volume));
}

Status check_memory(const Volume& volume) {
  const double needed = bytes_of_voxel * static_cast<double>(volume.voxels()), most = memory_bound();
  if (needed <= most) return success();
  return failure("a volume of ", volume.voxels(), " voxels takes ", std::floor(needed),
                 " bytes of memory, more than this machine allows, ", std::floor(most));
}

Status check_budget(const Volume& volume, const Border& border, const BalloonOptions& options,
                    const SurfaceBounds& bounds) {
  const double diagonal =
      length(volume.to_world({double(volume.nx), double(volume.ny), double(volume.nz)}) - volume.to_world({0, 0, 0}));
  if (options.radius > 0.5 * diagonal)
    return failure("--radius ", options.radius, " mm is more than half the diagonal of the volume, ", diagonal, " mm");
  if (options.edge_length > diagonal)
    return failure("--edge ", options.edge_length, " mm is more than the diagonal of the volume, ", diagonal, " mm");
  const double memory = memory_bound() - bytes_of_voxel * static_cast<double>(volume.voxels());
  const double edge = options.edge_length * options.coarseness;
  const double squares = 4 * pi * options.radius * options.radius / (edge * edge);
  const double ball = vertices_of_square * squares * static_cast<double>(options.seeds.size());
  const std::string edges = text_of("--edge ", options.edge_length, " mm: ");
  if (Status s = check_vertices(text_of(edges, "a ball of --radius ", options.radius), ball, memory, bounds); !s)
    return s;
  const double area = smooth_part * border.area;
  return check_vertices(text_of(edges, "the object"),
                        vertices_of_square * area / (options.edge_length * options.edge_length), memory, bounds);
}

}  // namespace tool
