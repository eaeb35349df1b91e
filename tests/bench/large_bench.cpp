// SPDX-License-Identifier: MIT
// large_bench: meshes of millions of triangles. Seconds of processor time, the greatest memory of a process that does
// nothing else, the mesh given included, and exponents from one size to the next.
//
//   large_bench [--limit SECONDS] [TRIANGLES...]      default 2.5e6, 5e6 and 2e7 triangles, an hour for each row
//
// - A thin shell, one sphere within another: load, complete detection beside its peers, a step in which nothing meets,
//   and a step in which a thousand patches of the inner sphere pierce the outer one.
// - Two scans, spheres with noise of a tenth of an edge, that overlap: load and adapt, beside a union of both.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <exception>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>

#include "cutters.h"
#include "detectors.h"
#include "stepping.h"
#include "tool/scenes/sphere.h"

namespace {

using namespace bench;
using tool::Point;
using tool::operator+, tool::operator-, tool::operator*;

constexpr double thickness = 2, patch = 4, beyond = 0.1;  // in edges
constexpr size_t islands = 1000;

// ---------------------------------------------------------------- a process for each row

struct Row {
  double seconds = 0;
  uint64_t count = 0;  // of what the row finds
};

struct Options {
  unsigned limit = 3600;  // seconds
  std::vector<double> triangles;
};

// Prints a row; nothing is left of it.
void RunRow(const Options& o, const char* name, uint32_t triangles, const std::function<Row()>& work) {
  static std::map<std::string, std::pair<uint32_t, double>> before;  // by name: triangles and seconds
  int ends[2];
  if (pipe(ends) != 0) std::exit(2);
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) try {
      alarm(o.limit);
      const Row row = work();
      _exit(write(ends[1], &row, sizeof row) == sizeof row ? 0 : 3);
    } catch (const std::exception& e) {
      std::fprintf(stderr, "%s: %s\n", name, e.what());
      _exit(1);
    }
  close(ends[1]);
  Row row;
  const bool done = child > 0 && read(ends[0], &row, sizeof row) == sizeof row;
  close(ends[0]);
  int status = 0;
  rusage used{};
  wait4(child, &status, 0, &used);
  if (!done) {
    std::printf("%-34s %10u  %s\n", name, triangles,
                WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM ? "late" : "fails");
    return;
  }
  std::printf("%-34s %10u %9.3f s %7.0f ns a triangle %7.2f GB %9llu", name, triangles, row.seconds,
              1e9 * row.seconds / triangles, static_cast<double>(used.ru_maxrss) / (1 << 20),
              static_cast<unsigned long long>(row.count));
  if (const auto last = before.find(name); last != before.end())
    std::printf("  exponent %.2f", std::log(row.seconds / last->second.second) /
                                       std::log(static_cast<double>(triangles) / last->second.first));
  std::printf("\n");
  before[name] = {triangles, row.seconds};
}

// ---------------------------------------------------------------- the shell

struct Shell {
  Mesh mesh;
  double edge = 0;
};

Shell MakeShell(double triangles) {
  const int parts = PartsFor(static_cast<uint32_t>(triangles / 4));
  Shell s;
  s.mesh = tool::make_sphere({0, 0, 0}, 1, parts);
  s.edge = MeanEdge(s.mesh);
  Append(s.mesh, tool::make_sphere({0, 0, 0}, 1 - thickness * s.edge, parts), true);
  return s;
}

// Which of some places, apart from each other, is near a point.
class Places {
 public:
  Places(double reach, double apart) : reach_(reach) {
    tool::Dice dice(1);
    for (int misses = 0; places_.size() < islands && misses < 1000; ++misses) {
      const Point p = dice.direction();
      if (Near(p, apart) != nullptr) continue;
      cells_.emplace(Cell(p, {0, 0, 0}), places_.size());
      places_.push_back(p);
      misses = 0;
    }
  }
  const Point* Near(const Point& p, double within) const {
    for (int i = 0; i < 27; ++i) {
      const auto [first, last] = cells_.equal_range(Cell(p, {i % 3 - 1.0, i / 3 % 3 - 1.0, i / 9 - 1.0}));
      for (auto at = first; at != last; ++at)
        if (tool::length(places_[at->second] - p) < within) return &places_[at->second];
    }
    return nullptr;
  }
  size_t size() const { return places_.size(); }

 private:
  // Of a grid with cells of three reaches, which no place less than that apart is beyond.
  uint64_t Cell(const Point& p, const Point& step) const {
    uint64_t cell = 0;
    for (size_t k = 0; k < 3; ++k) {
      const double at = std::floor((p[k] + 2) / (3 * reach_)) + step[k];
      cell = cell << 21 | static_cast<uint64_t>(std::max(0.0, at));
    }
    return cell;
  }
  double reach_;
  std::vector<Point> places_;
  std::unordered_multimap<uint64_t, size_t> cells_;
};

// The patches of the inner sphere go out through the outer one, or in.
Move MoveOf(const Shell& s, bool outwards) {
  const Places places(patch * s.edge, 3 * patch * s.edge);
  Move m;
  for (uint32_t v = VertexCount(s.mesh) / 2; v < VertexCount(s.mesh); ++v) {
    const double* at = &s.mesh.positions[3 * size_t{v}];
    const Point p{at[0], at[1], at[2]}, direction = tool::unit(p);
    const Point* const place = places.Near(direction, patch * s.edge);
    if (place == nullptr) continue;
    const double far = tool::length(direction - *place) / (patch * s.edge);
    const double way = (outwards ? 1 : -1) * (thickness + beyond) * s.edge * (1 - far * far);
    const Point to = p + way * *place;
    m.vertices.push_back(v);
    m.targets.insert(m.targets.end(), to.begin(), to.end());
  }
  return m;
}

// ---------------------------------------------------------------- rows

Arena Load(const Mesh& mesh, tpa_config config, double& seconds) {
  Arena arena(config);
  if (arena.context == nullptr) Fail("tpa_init", arena.issue);
  const tpa_mesh_input input = InputOf(mesh);
  const double start = Now();
  Check(tpa_load(arena.context, &input, &arena.issue), "tpa_load", arena.issue);
  seconds = Now() - start;
  return arena;
}

tpa_config ConfigOfShell(const Shell& s) {
  tpa_config config = ConfigFor(s.mesh);
  config.max_vertices += 200 * islands;
  return config;
}

Row LoadShell(const Shell& s) {
  double seconds = 0;
  Load(s.mesh, ConfigOfShell(s), seconds);
  return {seconds, VertexCount(s.mesh)};
}

Row DetectInShell(const Shell& s) {
  double seconds = 0;
  const Arena arena = Load(s.mesh, ConfigOfShell(s), seconds);
  tpa_contacts contacts{};
  contacts.struct_size = sizeof contacts;
  tpa_issue issue{};
  const double start = Now();
  Check(tpa_detect(arena.context, nullptr, &contacts, &issue), "tpa_detect", issue);
  return {Now() - start, contacts.count};
}

Row StepOfShell(const Shell& s, bool outwards) {
  double seconds = 0;
  const Arena arena = Load(s.mesh, ConfigOfShell(s), seconds);
  tpa_report report{};
  const double taken = StepTime(arena.context, MoveOf(s, outwards), report);
  return {taken, report.handles[0]};
}

#if defined(BENCH_CGAL) || defined(BENCH_EMBREE)
Row DetectBy(Measured (*detector)(const Mesh&, int), const Mesh& mesh) {
  const Measured m = detector(mesh, 1);
  return {m.seconds, m.pairs.size()};
}
#endif

Mesh TwoScans(double triangles) {
  const int parts = PartsFor(static_cast<uint32_t>(triangles / 4));
  Mesh scans = tool::make_sphere({0, 0, 0}, 1, parts);
  Append(scans, tool::make_sphere({1.1, 0.13, 0.07}, 1, parts), false);
  return Noisy(std::move(scans), 0.1, 1);
}

Row AdaptScans(const Mesh& scans) {
  tpa_config config = ConfigFor(scans);
  config.max_vertices += config.max_vertices / 8;
  double seconds = 0;
  const Arena arena = Load(scans, config, seconds);
  tpa_issue issue{};
  tpa_report report{};
  report.struct_size = sizeof report;
  const double start = Now();
  Check(tpa_adapt(arena.context, nullptr, &report, &issue), "tpa_adapt", issue);
  return {seconds + Now() - start, report.contacts};
}

#ifdef BENCH_CGAL_CUT
Row CutBy(Cutter cutter, const Mesh& mesh) {
  const std::optional<Cut> cut = cutter(mesh);
  if (!cut) _exit(1);
  return {cut->seconds, TriangleCount(cut->mesh)};
}
#endif

void Table(double triangles, const Options& o) {
  {
    const Shell s = MakeShell(triangles);
    const uint32_t n = TriangleCount(s.mesh);
    RunRow(o, "shell: load", n, [&] { return LoadShell(s); });
    RunRow(o, "detect", n, [&] { return DetectInShell(s); });
#ifdef BENCH_EMBREE
    RunRow(o, "detect, Embree", n, [&] { return DetectBy(DetectWithEmbree, s.mesh); });
#endif
#ifdef BENCH_CGAL
    RunRow(o, "detect, CGAL", n, [&] { return DetectBy(DetectWithCgal, s.mesh); });
#endif
    RunRow(o, "step, nothing meets", n, [&] { return StepOfShell(s, false); });
    RunRow(o, "step, a thousand handles", n, [&] { return StepOfShell(s, true); });
  }
  const Mesh scans = TwoScans(triangles);
  const uint32_t n = TriangleCount(scans);
  RunRow(o, "two scans: load and adapt", n, [&] { return AdaptScans(scans); });
#ifdef BENCH_CGAL_CUT
  RunRow(o, "union, CGAL", n, [&] { return CutBy(UniteWithCgal, scans); });
  RunRow(o, "autorefine, CGAL", n, [&] { return CutBy(AutorefineWithCgal, scans); });
#endif
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  for (int i = 1; i < argc; ++i) {
    if (std::string_view(argv[i]) == "--limit" && i + 1 < argc)
      o.limit = static_cast<unsigned>(std::max(1, std::atoi(argv[++i])));
    else
      o.triangles.push_back(std::atof(argv[i]));
  }
  if (o.triangles.empty()) o.triangles = {2.5e6, 5e6, 2e7};
  for (const double triangles : o.triangles) Table(triangles, o);
}
