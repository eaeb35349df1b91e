// SPDX-License-Identifier: MIT
#include "support/resolve_trial.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>

namespace support {

namespace {

double MeanEdge(const Mesh& m, const std::vector<uint32_t>& triangles) {
  double sum = 0;
  for (uint32_t f : triangles)
    for (size_t i = 0; i < 3; ++i) {
      const Point a = PositionOf(m, m.triangles[3 * f + i]), b = PositionOf(m, m.triangles[3 * f + (i + 1) % 3]);
      sum += std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
    }
  return triangles.empty() ? 0 : sum / (3 * static_cast<double>(triangles.size()));
}

std::vector<uint32_t> MeetingTriangles(const Mesh& m) {
  std::vector<uint32_t> triangles;
  for (const auto& [a, b] : AllMeetingPairs(m)) triangles.insert(triangles.end(), {a, b});
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  return triangles;
}

struct Target {
  Lattice lattice;
  Cells region;                                         // winding number >= 1
  Betti betti{}, coarse{}, thin{}, filled{}, eroded{};  // see Confidence
};

// Filled up to `filled` round the triangles in contact.
Betti FilledBetti(const Mesh& m, const std::vector<uint32_t>& meeting, const Lattice& lattice, Cells region,
                  double filled, double speck) {
  AddNear(m, meeting, filled, lattice, region);
  DropSpecks(speck, lattice, region);
  return BettiOf(region, lattice);
}

// Up to `eroded` taken away round the triangles in contact.
Betti ErodedBetti(const Mesh& m, const std::vector<uint32_t>& meeting, const Lattice& lattice, Cells region,
                  double eroded, double speck) {
  Cells near(lattice.Cells());
  AddNear(m, meeting, 2 * eroded, lattice, near);
  Erode(eroded, near, lattice, region);
  DropSpecks(speck, lattice, region);
  return BettiOf(region, lattice);
}

// Surfaces in contact leave wedges. A lattice sees chains of holes in wedges thinner than its cells, unless the wedges
// are filled by so many cells. To fill more would bridge gaps just as thin.
constexpr double least_cells = 1, most_cells = 1.5;

// Certainty of the answer: known if equal on two lattices. Doubtful if the answer changes with less of the wedges
// filled, or with half an edge more or less: contacts are resolved at the scale of the triangles, and smaller features,
// such as specks of half an edge, may go either way.
struct Confidence {
  bool known, doubtful;
};

Confidence FindTopology(const Mesh& m, const std::vector<uint32_t>& meeting, int coarse_cells, Target& target) {
  const double half_edge = 0.5 * MeanEdge(m, meeting), speck = std::pow(half_edge, 3);
  const Lattice coarse = LatticeRound(m, coarse_cells, half_edge);
  const Cells coarse_region = AtLeastOne(WindingNumbers(m, coarse));
  const double least = least_cells * target.lattice.step, most = most_cells * target.lattice.step;
  target.betti = FilledBetti(m, meeting, target.lattice, target.region, most, speck);
  target.thin = FilledBetti(m, meeting, target.lattice, target.region, least, speck);
  target.filled = FilledBetti(m, meeting, target.lattice, target.region, std::max(half_edge, most), speck);
  target.eroded = ErodedBetti(m, meeting, target.lattice, target.region, half_edge, speck);
  target.coarse = FilledBetti(m, meeting, coarse, coarse_region, most_cells * coarse.step, speck);
  const bool stands = target.thin == target.betti && target.filled == target.betti && target.eroded == target.betti;
  return {target.coarse == target.betti, !stands};
}

std::string TextOf(const std::vector<int64_t>& genera) {
  std::string text = "genera";
  for (int64_t g : genera) text += " " + std::to_string(g);
  return text;
}

// Each body is bounded by a surface of positive volume, each void by a surface of negative volume.
Betti BettiOf(const Topology& t) {
  Betti betti{0, t.Genus(), 0};
  for (const Component& c : t.components) ++(c.volume > 0 ? betti.bodies : betti.voids);
  return betti;
}

void JudgeTopology(const Family& family, const Tangle& tangle, const std::vector<uint32_t>& meeting,
                   const Topology& topology, Target& target, ResolveTrial& trial) {
  if (tangle.genera) {
    trial.expected = TextOf(*tangle.genera);
    trial.found = TextOf(topology.Genera());
  } else {
    const Confidence answer = FindTopology(tangle.mesh, meeting, 2 * family.cells / 3, target);
    trial.expected = Text(target.betti);
    trial.found = Text(BettiOf(topology));
    trial.oracle = trial.expected + "; coarser " + Text(target.coarse) + "; filled less " + Text(target.thin) +
                   "; filled " + Text(target.filled) + "; eroded " + Text(target.eroded);
    if (!answer.known || (answer.doubtful && trial.expected != trial.found)) return;
  }
  trial.topology = trial.expected == trial.found ? Verdict::right : Verdict::wrong;
}

void JudgeRegion(const Target& target, ResolveTrial& trial) {
  const std::vector<int16_t> winding = WindingNumbers(trial.result, target.lattice);
  const auto [least, most] = std::minmax_element(winding.begin(), winding.end());
  trial.winding_is_plain = *least >= 0 && *most <= 1;
  trial.volume = VolumeOf(target.region, target.lattice);
  const double share = 1 / std::max(trial.volume, std::pow(target.lattice.step, 3));
  trial.difference = share * VolumeOfDifference(target.region, AtLeastOne(winding), target.lattice);
  trial.volume_error = share * std::fabs(TopologyOf(trial.result).Volume() - trial.volume);
}

void Adapt(const Mesh& m, ResolveTrial& trial) {
  trial.report = Sized<tpa_report>();
  const Arena arena(GenerousConfig(m), m);
  const auto start = std::chrono::steady_clock::now();
  trial.status = tpa_adapt(*arena, nullptr, &trial.report, &trial.issue);
  trial.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  trial.result = MeshOf(*arena);
}

}  // namespace

tpa_config GenerousConfig(const Mesh& m) {
  tpa_config config = DefaultConfig(16 * VertexCount(m) + 1024);
  config.max_contacts = 64 * TriangleCount(m);
  config.max_cut_edges = 6 * TriangleCount(m);
  config.max_events = VertexCount(m) + 1024;
  config.max_passes = 64;
  return config;
}

ResolveTrial TryToResolve(const Family& family, const Tangle& tangle) {
  ResolveTrial trial;
  Adapt(tangle.mesh, trial);
  const Topology topology = TopologyOf(trial.result);
  trial.defect = topology.defect;
  if (!trial.defect.empty()) return trial;
  trial.meeting = AllMeetingPairs(trial.result).size();
  const bool asks_grid = !family.coarse && !tangle.genera;
  const std::vector<uint32_t> meeting = asks_grid ? MeetingTriangles(tangle.mesh) : std::vector<uint32_t>{};
  Target target{LatticeRound(tangle.mesh, family.cells, 0.5 * MeanEdge(tangle.mesh, meeting)), {}};
  target.region = AtLeastOne(WindingNumbers(tangle.mesh, target.lattice));
  if (!family.coarse) JudgeTopology(family, tangle, meeting, topology, target, trial);
  JudgeRegion(target, trial);
  return trial;
}

FarVertices FarFromContacts(const Mesh& before, const Mesh& after, double edges, int cells) {
  const std::vector<uint32_t> meeting = MeetingTriangles(before);
  const Lattice lattice = LatticeRound(before, cells);
  const Cells region = AtLeastOne(WindingNumbers(before, lattice));
  Cells near(lattice.Cells());
  AddNear(before, meeting, edges * MeanEdge(before, meeting), lattice, near);
  std::set<Point> kept;
  for (size_t v = 0; v < VertexCount(after); ++v) kept.insert(PositionOf(after, v));
  FarVertices far{0, 0};
  for (size_t v = 0; v < VertexCount(before); ++v) {
    const Point p = PositionOf(before, v);
    const auto cell = [&](size_t i) { return static_cast<int>((p[i] - lattice.low[i]) / lattice.step); };
    if (near[lattice.At(cell(0), cell(1), cell(2))] != 0) continue;
    int inside = 0;  // of the cells round the vertex
    for (int c = 0; c < 27; ++c)
      inside += region[lattice.At(cell(0) + c % 3 - 1, cell(1) + c / 3 % 3 - 1, cell(2) + c / 9 - 1)];
    if (inside == 0 || inside == 27) continue;
    ++far.all;
    far.lost += kept.count(p) == 0 ? 1u : 0u;
  }
  return far;
}

}  // namespace support
