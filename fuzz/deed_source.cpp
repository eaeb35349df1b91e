// SPDX-License-Identifier: MIT
#include "deed_source.h"

#include <cmath>
#include <limits>

#include "target.h"

namespace fuzz {

using namespace support;

// ---------------------------------------------------------------- meshes

namespace {

Mesh BodyFrom(Bytes& in) {
  Random random(in.Byte());
  switch (in.Below(6)) {
    case 0: return Sphere({0, 0, 0}, 0.25 + in.Below(16) / 8.0, 1);
    case 1: return Sphere({0, 0, 0}, 0.25 + in.Below(16) / 8.0, 2 + static_cast<int>(in.Below(2)));
    case 2: {
      Point high;
      for (double& x : high) x = 0.5 + in.Below(8) / 2.0;
      return Box({0, 0, 0}, high, 1 + static_cast<int>(in.Below(2)));
    }
    case 3: return Torus({0, 0, 0}, 1, 0.25 + in.Below(8) / 16.0, 5 + static_cast<int>(in.Below(4)), 4);
    case 4: return ThinBody(random);
    default:
      return Tube({{0, 0, -1}, {0, 0, 0}, {0, 0, 1}}, {.5, .25, .5}, 3 + static_cast<int>(in.Below(3)), {0, 1, 0});
  }
}

// A place, on a grid or anywhere.
Point PlaceFrom(Bytes& in, double reach) {
  const bool is_on_grid = in.Once(2);
  Point p;
  for (double& x : p) x = is_on_grid ? static_cast<int>(in.Below(9)) / 2.0 - 2 : in.Around(reach);
  return p;
}

}  // namespace

Mesh MeshFrom(Bytes& in) {
  std::vector<Mesh> bodies;
  const uint32_t count = 1 + in.Below(3);
  for (uint32_t i = 0; i < count; ++i) bodies.push_back(Translated(BodyFrom(in), PlaceFrom(in, 2)));
  Mesh m = Together(bodies);
  const uint32_t change = in.Below(8);
  const double size = std::ldexp(1, static_cast<int>(in.Below(8)) - 6);
  Random random(in.Byte());
  for (double& x : m.positions) {
    if (change == 1) x += Uniform(random, -size, size);
    if (change == 2) x = std::round(4 * x) / 4;
    if (change == 3) x = std::ldexp(x, 60);
    if (change == 4) x = std::ldexp(x, -60);
    if (x != 0 && std::fabs(x) < 0x1p-90) x = 0;
  }
  return in.Once(2) ? Renumbered(m, random) : m;
}

// ---------------------------------------------------------------- configs

namespace {

// 0, for the default, or a number up to `most` that is small more often than not.
uint32_t LimitFrom(Bytes& in, uint32_t least, uint32_t most) {
  if (in.Once(2)) return 0;
  const uint32_t bound = most >> in.Below(12);
  return bound <= least ? least : least + in.Below(bound - least);
}

}  // namespace

void ChangeLimits(Bytes& in, tpa_config& config) {
  config.max_vertices = 16 + 8 * in.Below(256);
  config.max_triangles = in.Once(4) ? 16 + 16 * in.Below(256) : 0;
  config.max_contacts = LimitFrom(in, 1, 4096);
  config.max_cut_edges = LimitFrom(in, 3, 2048);
  config.max_events = LimitFrom(in, 1, 256);
  config.max_components = LimitFrom(in, 1, 64);
  config.max_pieces = LimitFrom(in, 1, 1 << 15);
  config.max_substeps = LimitFrom(in, 1, 8);
}

tpa_config ConfigFrom(Bytes& in) {
  tpa_config config;
  Demand(tpa_config_init(&config, sizeof config) == TPA_OK, "a config to begin with");
  if (in.Once(2))
    ChangeLimits(in, config);
  else
    config.max_vertices = 1024 + 16 * in.Below(128);
  if (in.Once(3)) {
    config.detect_mode = TPA_DETECT_VERTEX_HASH;
    config.cell_size = std::ldexp(1, static_cast<int>(in.Below(8)) - 5);
  }
  config.region = in.Once(8) ? TPA_REGION_OUTSIDE : TPA_REGION_INSIDE;
  if (in.Once(2)) return config;
  config.max_passes = 1 + in.Below(8);
  config.max_candidates = 1 + in.Below(64);
  config.smooth_iterations = in.Below(8);
  config.smooth_lambda = 0.25 + in.Below(192) / 256.0;
  config.smooth_mu = -config.smooth_lambda - (1.5 - config.smooth_lambda) * (1 + in.Below(255)) / 256;
  return config;
}

// ---------------------------------------------------------------- deeds

namespace {

void SpoilNumber(Bytes& in, double& x) {
  const double bad[] = {std::numeric_limits<double>::quiet_NaN(), HUGE_VAL, -HUGE_VAL, 0x1p101, 0x1p-101,
                        std::numeric_limits<double>::denorm_min()};
  x = bad[in.Below(6)];
}

Deed MoveFrom(Bytes& in, const Mesh& mesh) {
  Deed d{DeedKind::move};
  const uint32_t vertices = VertexCount(mesh);
  if (vertices == 0) return d;
  const Point drift = PlaceFrom(in, 1), center = PositionOf(mesh, in.Below(vertices));
  const double reach = in.Once(2) ? 100 : 0.25 + in.Below(8) / 4.0, noise = in.Once(2) ? 0 : in.Below(32) / 64.0;
  const double scale = std::ldexp(1, static_cast<int>(in.Below(4)) - 2), grid = in.Once(4) ? 4 : 0;
  double size = 0;
  for (double x : mesh.positions) size = std::max(size, std::fabs(x));
  const double unit = size > 0x1p40 ? 0x1p60 : size < 0x1p-40 ? 0x1p-60 : 1;
  Random random(in.Byte());
  for (uint32_t v = 0; v < vertices; ++v) {
    const Point p = PositionOf(mesh, v);
    if (Distance(p, center) > reach * unit) continue;
    d.ids.push_back(v);
    for (size_t k = 0; k < 3; ++k) {
      double x = p[k] + unit * (scale * drift[k] + Uniform(random, -noise, noise));
      if (grid > 0) x = std::round(grid * x / unit) / grid * unit;
      d.positions.push_back(x != 0 && std::fabs(x) < 0x1p-90 ? 0 : x);
    }
  }
  d.count = static_cast<uint32_t>(d.ids.size());
  d.as_floats = in.Once(4);
  if (in.Once(16) && d.count > 0) d.ids[in.Below(d.count)] = vertices + in.Below(3);
  if (in.Once(16) && d.count > 0) SpoilNumber(in, d.positions[in.Below(3 * d.count)]);
  if (in.Once(8) && d.count == vertices) d.ids.clear();
  return d;
}

Deed LoadFrom(Bytes& in) {
  Deed d{DeedKind::load};
  d.mesh = MeshFrom(in);
  d.as_floats = in.Once(4);
  if (in.Once(16)) d.mesh.triangles[in.Below(static_cast<uint32_t>(d.mesh.triangles.size()))] = in.Byte();
  if (in.Once(16)) SpoilNumber(in, d.mesh.positions[in.Below(static_cast<uint32_t>(d.mesh.positions.size()))]);
  if (in.Once(32)) d.mesh.triangles.resize(d.mesh.triangles.size() - 3);
  return d;
}

double MeanEdge(const Mesh& m) {
  double sum = 0;
  for (size_t h = 0; h < m.triangles.size(); ++h)
    sum += Distance(PositionOf(m, m.triangles[h]), PositionOf(m, m.triangles[h % 3 == 2 ? h - 2 : h + 1]));
  return m.triangles.empty() ? 1 : sum / static_cast<double>(m.triangles.size());
}

Deed RemeshFrom(Bytes& in, const Mesh& mesh) {
  Deed d{DeedKind::remesh};
  d.iterations = 1 + in.Below(4);
  d.length = MeanEdge(mesh) * (0.5 + in.Below(64) / 32.0);
  if (VertexCount(mesh) > 300) d.length *= 2;  // meshes stay small, and calls quick
  d.relaxation = in.Once(2) ? in.Below(256) / 255.0 : 0;
  if (in.Once(4)) d.split_ratio = 1 + in.Below(64) / 64.0;
  if (in.Once(4)) d.collapse_ratio = in.Below(64) / 64.0;
  return d;
}

// Mostly a few sub-steps, for meshes of a size of one.
Deed AdvanceFrom(Bytes& in, const Mesh& mesh) {
  Deed d{DeedKind::advance};
  d.length = MeanEdge(mesh) * std::ldexp(1, static_cast<int>(in.Below(8)) - 2);
  if (in.Once(16)) SpoilNumber(in, d.length);
  return d;
}

Deed SmoothFrom(Bytes& in, const Mesh& mesh) {
  Deed d{DeedKind::smooth};
  d.iterations = in.Below(6);
  const uint32_t vertices = VertexCount(mesh);
  if (in.Once(2) || vertices == 0) return d;
  d.count = 1 + in.Below(16);
  for (uint32_t i = 0; i < d.count; ++i) d.ids.push_back(in.Below(vertices + (in.Once(32) ? 1 : 0)));
  return d;
}

}  // namespace

Deed DeedFrom(Bytes& in, const Mesh& mesh) {
  const uint32_t kind = in.Below(16);
  if (mesh.positions.empty() && kind < 14) return LoadFrom(in);
  switch (kind) {
    case 0:
    case 1:
    case 2: return MoveFrom(in, mesh);
    case 3:
    case 4:
    case 5:
    case 6: return in.Once(3) ? AdvanceFrom(in, mesh) : Deed{DeedKind::step};
    case 7:
    case 8:
    case 9: return Deed{DeedKind::adapt};
    case 10:
    case 11: return RemeshFrom(in, mesh);
    case 12: return SmoothFrom(in, mesh);
    case 13: return LoadFrom(in);
    case 14: return Deed{DeedKind::drop_targets};
    default:
      if (in.Once(4)) return Deed{DeedKind::reset};
      return Deed{in.Once(4) ? DeedKind::reorder : DeedKind::step};
  }
}

}  // namespace fuzz
