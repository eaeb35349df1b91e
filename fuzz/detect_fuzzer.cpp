// SPDX-License-Identifier: MIT
// Detection in both modes against each pair of triangles with rationals: closed surfaces whose vertices lie anywhere on
// a small grid, so that nearly everything touches, is coplanar, or has no area. Scaled by powers of two, and moved as
// far as doubles are exact.
#include <cmath>

#include "blocks.h"
#include "bytes.h"
#include "grid_triangles.h"
#include "oracle/section_three.h"
#include "support/sample_meshes.h"
#include "target.h"
#include "tool/surface.h"

namespace fuzz {

namespace {

using namespace support;

uint64_t meshes = 0, pairs_found = 0, flat_triangles = 0, by_hash = 0, moved_meshes = 0;

Mesh Base(Bytes& in) {
  switch (in.Below(5)) {
    case 0: return Mesh{{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3}};
    case 1: return Sphere({0, 0, 0}, 1, 1);
    case 2: return Box({0, 0, 0}, {1, 1, 1}, 1);
    case 3: return Torus({0, 0, 0}, 2, 1, 4, 3);
    default: return Sphere({0, 0, 0}, 1, 2);
  }
}

// In their shapes, but for rounding.
Mesh Apart(Bytes& in, std::vector<Mesh> bodies) {
  for (Mesh& m : bodies) {
    const double shift[3] = {in.Below(24) + 16., in.Below(24) + 16., in.Below(24) + 16.};
    for (size_t i = 0; i < m.positions.size(); ++i) m.positions[i] = std::round(4 * m.positions[i] + shift[i % 3]);
  }
  return Together(bodies);
}

// Vertices of whole numbers.
Mesh OnGrid(Bytes& in) {
  std::vector<Mesh> bodies;
  const uint32_t count = 1 + in.Below(3);
  for (uint32_t i = 0; i < count; ++i) bodies.push_back(Base(in));
  if (in.Once(3)) return Apart(in, bodies);
  Mesh m = Together(bodies);
  const uint32_t sides[] = {2, 3, 5, 9, 64};
  const uint32_t side = sides[in.Below(5)];
  for (double& x : m.positions) x = static_cast<double>(in.Below(side));
  return m;
}

GridTriangle TriangleOf(const Mesh& m, uint32_t f) {
  GridTriangle t{};
  for (size_t i = 0; i < 3; ++i) {
    t.corner[i] = m.triangles[3 * f + i];
    for (size_t k = 0; k < 3; ++k) t.at[i][k] = static_cast<int64_t>(m.positions[3 * t.corner[i] + k]);
  }
  return t;
}

Pairs Expected(const Mesh& grid) {
  Pairs pairs;
  for (uint32_t f = 0; f < TriangleCount(grid); ++f)
    for (uint32_t g = f + 1; g < TriangleCount(grid); ++g)
      if (GridTrianglesMeet(TriangleOf(grid, f), TriangleOf(grid, g))) pairs.emplace_back(f, g);
  return pairs;
}

// Exact: whole numbers of at most 6 bits, moved by multiples of 2^20 or less.
struct Placing {
  double scale, shift[3];
  explicit Placing(Bytes& in) : scale(std::ldexp(1, static_cast<int>(in.Below(100)) - 50)) {
    const double far = std::ldexp(1, static_cast<int>(in.Below(21)));
    for (double& x : shift) x = in.Once(2) ? 0 : far * (static_cast<int>(in.Byte()) - 128);
  }
  Mesh Placed(const Mesh& grid) const {
    Mesh m = grid;
    for (size_t i = 0; i < m.positions.size(); ++i) m.positions[i] = scale * (m.positions[i] + shift[i % 3]);
    return m;
  }
};

Pairs Detected(tpa_context* context, bool& fits, uint64_t& needed) {
  auto contacts = Sized<tpa_contacts>();
  tpa_issue issue;
  const tpa_status status = tpa_detect(context, nullptr, &contacts, &issue);
  Demand(status == TPA_OK || (status == TPA_E_LIMIT && issue.limit == TPA_LIMIT_CONTACTS),
         "detection, or want of room");
  fits = status == TPA_OK;
  needed = issue.needed;
  Pairs pairs;
  for (uint32_t i = 0; fits && i < contacts.count; ++i) pairs.emplace_back(contacts.pairs[i].a, contacts.pairs[i].b);
  return pairs;
}

void Compare(const Owner& o, const Mesh& grid, const char* what) {
  const Pairs expected = Expected(grid);
  bool fits = false;
  uint64_t needed = 0;
  const Pairs found = Detected(o.context, fits, needed);
  Demand(fits ? found == expected : needed == expected.size(), what, ": ", fits ? found.size() : needed, " pairs of ",
         expected.size());
  auto v = Sized<tpa_validation>();
  const tpa_status status = tpa_validate(o.context, nullptr, &v, nullptr);
  Demand((status == TPA_OK) == fits && v.self_intersections == expected.size(), what, ": tpa_validate counts ",
         v.self_intersections, " of ", expected.size());
  pairs_found += expected.size();
}

void CompareHash(const tpa_config& config, const Mesh& grid, const Placing& placing) {
  tpa_config hashed = config;
  hashed.detect_mode = TPA_DETECT_VERTEX_HASH;
  const Owner o = Made(hashed);
  const Mesh m = placing.Placed(grid);
  const tpa_mesh_input input = tool::input_of(m);
  Demand(tpa_load(o.context, &input, nullptr) == TPA_OK, "a closed surface is taken");
  const Pairs expected = PairsBySectionThree(m, hashed.cell_size, [&](uint32_t f, uint32_t g) {
    return GridTrianglesMeet(TriangleOf(grid, f), TriangleOf(grid, g));
  });
  bool fits = false;
  uint64_t needed = 0;
  const Pairs found = Detected(o.context, fits, needed);
  Demand(fits ? found == expected : needed >= expected.size(), "section 3: ", found.size(), " pairs of ",
         expected.size());
  by_hash += found.size();
}

// A mesh free of contacts moves, all of it or in part, and its contacts are found anew.
void Move(Bytes& in, const Owner& o, Mesh grid, const Placing& placing) {
  for (int step = 0; step < 3 && in.size > 0; ++step) {
    for (uint32_t i = 1 + in.Below(in.Once(2) ? 2 : VertexCount(grid)); i > 0; --i) {
      double& x = grid.positions[in.Below(static_cast<uint32_t>(grid.positions.size()))];
      x = in.Once(2) ? in.Below(64) : std::min(63., x + in.Below(2));
    }
    const Mesh moved = placing.Placed(grid);
    auto move = Sized<tpa_move_input>();
    move.count = VertexCount(moved);
    move.position_type = TPA_FLOAT64;
    move.positions = moved.positions.data();
    Demand(tpa_move(o.context, &move, nullptr) == TPA_OK, "targets in range are taken");
    tpa_issue issue;
    auto report = Sized<tpa_report>();
    const tpa_status status = tpa_step(o.context, nullptr, &report, &issue);
    const Pairs expected = Expected(grid);
    if (status != TPA_OK) {
      Demand(status == TPA_E_LIMIT && !expected.empty(), "a step fails for want of room only");
      return;
    }
    Demand(report.contacts == expected.size(), "a step finds ", report.contacts, " pairs of ", expected.size());
    ++moved_meshes;
    if (!expected.empty() || report.vertices != VertexCount(grid)) return;
    Compare(o, grid, "after a step");
  }
}

}  // namespace

std::string Tally() {
  return tool::text_of(meshes, " meshes, ", pairs_found, " pairs, ", flat_triangles,
                       " triangles with corners in one place, ", by_hash, " pairs by the hash, ", moved_meshes,
                       " steps");
}

bool ReachedEnough(uint64_t inputs) {
  return pairs_found > 10 * inputs && by_hash > inputs && 8 * moved_meshes > inputs;
}

}  // namespace fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace fuzz;
  Bytes in{data, size};
  tpa_config config;
  Demand(tpa_config_init(&config, sizeof config) == TPA_OK, "a config to begin with");
  config.max_vertices = 256;
  config.max_contacts = in.Once(8) ? 1 + in.Below(64) : 8192;
  config.cell_size = std::ldexp(1, static_cast<int>(in.Below(100)) - 50 + static_cast<int>(in.Below(4)));
  const Placing placing(in);
  const Mesh grid = OnGrid(in), m = placing.Placed(grid);
  ++meshes;
  for (uint32_t f = 0; f < TriangleCount(grid); ++f) {
    const GridTriangle t = TriangleOf(grid, f);
    flat_triangles += t.at[0] == t.at[1] || t.at[1] == t.at[2] || t.at[2] == t.at[0] ? 1u : 0u;
  }
  const Owner o = Made(config);
  const tpa_mesh_input input = tool::input_of(m);
  Demand(tpa_load(o.context, &input, nullptr) == TPA_OK, "a closed surface is taken");
  Compare(o, grid, "of all triangles");
  if (in.Once(2)) config.cell_size = placing.scale * (1 + in.Below(4));
  CompareHash(config, grid, placing);
  if (Expected(grid).empty()) Move(in, o, grid, placing);
  return 0;
}
