// SPDX-License-Identifier: MIT
#include "support/evolution.h"

#include <cstring>

#include "support/field_shapes.h"
#include "support/tangle_shapes.h"

namespace support {

namespace {

Targets ForAll(const Mesh& m, std::vector<double> positions) {
  Targets out{{}, std::move(positions)};
  for (uint32_t v = 0; v < VertexCount(m); ++v) out.vertices.push_back(v);
  return out;
}

tpa_config Ample(const Mesh& m) {
  tpa_config config = DefaultConfig(8 * VertexCount(m) + 8000);
  config.max_contacts = config.max_cut_edges = 1 << 14;
  config.max_pieces = 1 << 18;
  return config;
}

Evolution OfScene(const Scene& s) {
  return {s.name, s.mesh, std::min(s.most_steps + 2, 8), Ample(s.mesh),
          [target = s.target](const Mesh& m, Random&) { return ForAll(m, TargetsOf(m, target)); }};
}

// Each vertex moves within so many mean edges.
Evolution Noise(const char* name, const Mesh& mesh, double edges) {
  return {name, mesh, 8, Ample(mesh),
          [=](const Mesh& m, Random& random) { return ForAll(m, ShakenTargets(m, edges * MeanEdgeOf(m), random)); }};
}

Evolution Coinciding() {
  Evolution e{"coinciding", Sphere({}, 1, 6), 1, {}, [](const Mesh& m, Random& random) {
                return ForAll(m, CoincidingTargets(m, random));
              }};
  e.config = Ample(e.mesh);
  e.config.max_passes = 1;
  return e;
}

// The part of one ball that is next to the other is pushed into it, and further each time.
Evolution Push() {
  const Mesh balls = Together({Sphere({-1.05, 0, 0}, 1, 9), Sphere({1.05, 0.03, 0.02}, 1, 9)});
  return {"push", balls, 8, Ample(balls), [](const Mesh& m, Random& random) {
            Targets out;
            for (uint32_t v = 0; v < VertexCount(m); ++v) {
              const Point p = PositionOf(m, v);
              if (p[0] < -0.17 || p[0] > 0 || p[1] * p[1] + p[2] * p[2] > 0.1) continue;
              out.vertices.push_back(v);
              const double way = Uniform(random, 0.05, 0.07);
              out.positions.insert(out.positions.end(), {p[0] + way, p[1], p[2]});
            }
            return out;
          }};
}

constexpr int call_of_remesh = 5, call_of_smooth = 6, call_of_adapt = 7;  // of eight

Random RandomOf(uint64_t seed, int number) { return Random(1000 * seed + static_cast<uint64_t>(number)); }

}  // namespace

std::vector<Evolution> Evolutions(uint64_t seed) {
  std::vector<Evolution> out;
  for (const Scene& s : {TwoSpheres(0, 5), Dumbbell(), ThreeSpindles()})
    out.push_back(OfScene(Turned(s, static_cast<int>(seed % 24))));
  const Mesh ball = Sphere({}, 1, 4), ring = Torus({}, 1, 0.4, 16, 8);
  out.push_back(Noise("ball-noise", ball, 0.3));
  out.push_back(Noise("ring-noise", ring, 0.3));
  out.push_back(Coinciding());
  out.push_back(Push());
  // By the vertex hash.
  Evolution hashed = out.front();
  hashed.name += "-hashed";
  hashed.config.detect_mode = TPA_DETECT_VERTEX_HASH;
  hashed.config.cell_size = MeanEdgeOf(hashed.mesh);
  out.push_back(hashed);
  return out;
}

void Prepare(tpa_context* context, const Evolution& e, int number, uint64_t seed) {
  if (number % 8 == call_of_remesh) return;
  Random random = RandomOf(seed, number);
  const Targets targets = e.targets(MeshOf(context), random);
  EXPECT_EQ(MoveSome(context, targets.vertices, targets.positions), TPA_OK);
}

Called Call(tpa_context* context, int number) {
  Called out{};
  out.report = Sized<tpa_report>();
  auto remesh = Sized<tpa_remesh_options>();
  remesh.iterations = 1;
  remesh.relaxation = 0.3;
  auto smooth = Sized<tpa_smooth_options>();
  smooth.iterations = 2;
  switch (number % 8) {
    case call_of_remesh:
      remesh.target_length = 0.9 * MeanEdgeOf(MeshOf(context));
      out.status = tpa_remesh(context, &remesh, nullptr, &out.report, &out.issue);
      break;
    case call_of_smooth: out.status = tpa_smooth(context, &smooth, nullptr, &out.report, &out.issue); break;
    case call_of_adapt: out.status = tpa_adapt(context, nullptr, &out.report, &out.issue); break;
    default: out.status = tpa_step(context, nullptr, &out.report, &out.issue);
  }
  out.digest = DigestOf(context);
  return out;
}

void ExpectSame(const Called& a, const Called& b, const std::string& what) {
  EXPECT_EQ(a.status, b.status) << what << ": " << Text(a.issue) << "; " << Text(b.issue);
  EXPECT_EQ(a.digest, b.digest) << what;
  EXPECT_EQ(std::memcmp(&a.report, &b.report, sizeof a.report), 0) << what << ": another report";
}

}  // namespace support
