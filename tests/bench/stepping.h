// SPDX-License-Identifier: MIT
// stepping: what the benchmarks of steps have in common.
#pragma once

#include <time.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "arena.h"
#include "tool/scenes/points.h"

namespace bench {

// Processor time: the machine may be busy with other things.
inline double Now() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

[[noreturn]] inline void Fail(const char* what, const tpa_issue& issue) {
  char text[256];
  tpa_issue_text(&issue, text, sizeof text);
  std::fprintf(stderr, "step_bench: %s: %s\n", what, text);
  std::exit(2);
}

inline void Check(tpa_status status, const char* what, const tpa_issue& issue) {
  if (status != TPA_OK) Fail(what, issue);
}

// A sphere that make_sphere() cuts into n parts has 4 n^2 + 2 vertices.
inline int PartsFor(uint32_t vertices) { return static_cast<int>(std::lround(std::sqrt(vertices / 4.0))); }

inline double MeanEdge(const Mesh& m) {
  double sum = 0;
  for (size_t h = 0; h < m.triangles.size(); ++h) {
    const size_t next = h % 3 == 2 ? h - 2 : h + 1;
    const double *a = &m.positions[3 * size_t{m.triangles[h]}], *b = &m.positions[3 * size_t{m.triangles[next]}];
    sum += tool::length({b[0] - a[0], b[1] - a[1], b[2] - a[2]});
  }
  return sum / static_cast<double>(m.triangles.size());
}

inline void Append(Mesh& m, const Mesh& other, bool inward) {
  const uint32_t base = VertexCount(m);
  m.positions.insert(m.positions.end(), other.positions.begin(), other.positions.end());
  for (size_t t = 0; t < other.triangles.size(); t += 3)
    for (size_t i = 0; i < 3; ++i) m.triangles.push_back(base + other.triangles[t + (inward ? 2 - i : i)]);
}

inline tpa_mesh_view ViewOf(const tpa_context* context) {
  tpa_mesh_view view{};
  view.struct_size = sizeof view;
  tpa_view(context, &view);
  return view;
}

// Some vertices, and where they go.
struct Move {
  std::vector<uint32_t> vertices;
  std::vector<double> targets;
};

// Of tpa_step, in seconds.
inline double StepTime(tpa_context* context, const Move& m, tpa_report& report) {
  tpa_issue issue{};
  tpa_move_input move{};
  move.struct_size = sizeof move;
  move.count = static_cast<uint32_t>(m.vertices.size());
  move.position_type = TPA_FLOAT64;
  move.positions = m.targets.data();
  move.vertices = m.vertices.data();
  report.struct_size = sizeof report;
  Check(tpa_move(context, &move, &issue), "tpa_move", issue);
  const double start = Now();
  Check(tpa_step(context, nullptr, &report, &issue), "tpa_step", issue);
  return Now() - start;
}

}  // namespace bench
