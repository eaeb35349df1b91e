// SPDX-License-Identifier: MIT
// From a snapshot: the step with an event less one in which the same patch moves the other way and meets nothing, of
// the first of several runs, and of the least. Before each run the whole block is written, which leaves little of the
// code in caches, and of a large mesh little of the data.
//
// In a run of steps, as a program has them: a patch comes half the way to the other side in a first step, three
// quarters in a second, and meets it in a third; then comes the next one, where none has been near. The third step less
// the second is what the event costs. Before all of them it is found what moves, and renumbered after each event:
// between steps nobody looks through the whole mesh. What an event leaves to do is found by the first step of the next
// patch: the median of that less the second, and less what it is in a run without third steps ("after").
//
// The block lies on large pages.
#include "event_table.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "quantile.h"
#include "stepping.h"
#include "tool/scenes/sphere.h"

namespace bench {

namespace {

using tool::Point;
using tool::operator+, tool::operator-, tool::operator*;

constexpr double thickness = 2, patch = 4;  // in edges

struct Shell {
  Mesh mesh;
  double edge = 0;
  double bump = 0;  // how far it is pushed, in edges
};

Shell MakeShell(uint32_t vertices, double beyond) {
  const int parts = PartsFor(vertices / 2);
  Shell s;
  s.bump = thickness + beyond;
  s.mesh = tool::make_sphere({0, 0, 0}, 1, parts);
  s.edge = MeanEdge(s.mesh);
  Append(s.mesh, tool::make_sphere({0, 0, 0}, 1 - thickness * s.edge, parts), true);
  return s;
}

// The patch of the inner sphere round a direction, which goes out through the outer sphere, or in.
Move MoveOf(const tpa_mesh_view& view, const Shell& shell, const Point& direction, bool outwards) {
  Move m;
  const double edge = shell.edge;
  const Point top = (1 - thickness * edge) * direction;
  for (uint32_t v = 0; v < view.vertex_count; ++v) {
    const Point p{view.positions[3 * size_t{v}], view.positions[3 * size_t{v} + 1], view.positions[3 * size_t{v} + 2]};
    const double far = tool::length(p - top) / (patch * edge);
    if (far >= 1 || tool::length(p) > 1 - 0.75 * thickness * edge) continue;
    const double way = (outwards ? 1 : -1) * shell.bump * edge * (1 - far * far);
    const Point to = p + way * direction;
    m.vertices.push_back(v);
    m.targets.insert(m.targets.end(), to.begin(), to.end());
  }
  return m;
}

// So many edges of the way out.
Move PartOf(const tpa_mesh_view& view, const Shell& shell, const Move& whole, double edges) {
  const double share = edges / shell.bump;
  Move part = whole;
  for (size_t i = 0; i < part.targets.size(); ++i) {
    const double from = view.positions[3 * size_t{part.vertices[i / 3]} + i % 3];
    part.targets[i] = from + share * (whole.targets[i] - from);
  }
  return part;
}

// In the middle of a run a context knows what the steps before have told it; here a vertex moves in one, by a hair.
void Load(tpa_context* context, const Shell& shell) {
  tpa_issue issue{};
  const tpa_mesh_input input = InputOf(shell.mesh);
  Check(tpa_load(context, &input, &issue), "tpa_load", issue);
  const std::vector<double>& p = shell.mesh.positions;
  tpa_report report{};
  StepTime(context, {{0}, {p[0], p[1], p[2] * (1 - 1e-9)}}, report);
}

// ---------------------------------------------------------------- from a snapshot

// A processor that has run a step a few times knows its branches by heart.
struct RunTimes {
  double first, least;
};
RunTimes TimesOf(const Arena& arena, const std::vector<char>& snapshot, const Move& m, int repeats,
                 tpa_report& report) {
  RunTimes t{0, 1e30};
  for (int i = 0; i < repeats; ++i) {
    std::memcpy(arena.block.get(), snapshot.data(), snapshot.size());
    const double taken = StepTime(arena.context, m, report);
    if (i == 0) t.first = taken;
    t.least = std::min(t.least, taken);
  }
  return t;
}

// In microseconds, of each event.
struct SnapshotCosts {
  std::vector<double> quiets, firsts, leasts;
  uint32_t pierced = 0;
};
SnapshotCosts CostsFromSnapshot(const Arena& arena, const Shell& shell, uint64_t bytes, int events, int repeats) {
  Load(arena.context, shell);
  const char* const block = static_cast<const char*>(arena.block.get());
  const std::vector<char> snapshot(block, block + bytes);
  tool::Dice dice(1);
  SnapshotCosts c;
  for (int i = 0; i < events; ++i) {
    const Point direction = dice.direction();
    tpa_report report{};
    std::memcpy(arena.block.get(), snapshot.data(), snapshot.size());
    const tpa_mesh_view view = ViewOf(arena.context);
    const Move in = MoveOf(view, shell, direction, false), out = MoveOf(view, shell, direction, true);
    const RunTimes quiet = TimesOf(arena, snapshot, in, repeats, report);
    const RunTimes busy = TimesOf(arena, snapshot, out, repeats, report);
    c.pierced += report.handles[0];
    c.quiets.push_back(1e6 * quiet.least);
    c.firsts.push_back(1e6 * (busy.first - quiet.first));
    c.leasts.push_back(1e6 * (busy.least - quiet.least));
  }
  return c;
}

// ---------------------------------------------------------------- in a run

// Places whose patches are at least an edge from each other: so many, or as many as there is room for.
std::vector<Point> FindPlaces(const Shell& shell, tool::Dice& dice, size_t most) {
  constexpr double apart = 3 * patch;
  std::vector<Point> places;
  for (int misses = 0; misses < 1000 && places.size() < most;) {
    const Point p = dice.direction();
    const auto is_near = [&](const Point& q) { return tool::length(p - q) < apart * shell.edge; };
    if (std::any_of(places.begin(), places.end(), is_near)) {
      ++misses;
      continue;
    }
    places.push_back(p);
    misses = 0;
  }
  return places;
}

// As a program keeps lists of vertices up to date.
void Renumber(const tpa_context* context, std::vector<Move>& moves) {
  tpa_vertex_map_view map{};
  map.struct_size = sizeof map;
  Check(tpa_vertex_map(context, &map), "tpa_vertex_map", {});
  for (Move& m : moves)
    for (uint32_t& v : m.vertices) {
      v = map.old_to_new[v];
      if (v == TPA_NONE) Fail("an event that takes away what is to be moved later", {});
    }
}

// In microseconds, of each event.
struct RunCosts {
  std::vector<double> quiets, next;  // next: the first step less the second, but for those after a load
  std::vector<double> events;        // empty in a run without
  std::vector<double> contacts;      // how large they are: pairs of triangles that meet
  uint32_t pierced = 0;
  int loads = 0;
};
// The mesh is loaded anew where there is no room for more places.
RunCosts CostsInARun(const Arena& arena, const Shell& shell, size_t count, bool with_events) {
  tool::Dice dice(1);
  RunCosts c;
  std::vector<Move> waiting;  // the next one last
  while (c.quiets.size() < count) {
    const bool anew = waiting.empty();
    if (anew) Load(arena.context, shell);
    const tpa_mesh_view view = ViewOf(arena.context);
    if (anew) {
      ++c.loads;
      for (const Point& place : FindPlaces(shell, dice, count - c.quiets.size()))
        waiting.insert(waiting.begin(), MoveOf(view, shell, place, true));
    }
    const Move whole = std::move(waiting.back());
    waiting.pop_back();
    const Move parts[] = {PartOf(view, shell, whole, 0.5 * thickness), PartOf(view, shell, whole, 0.75 * thickness),
                          whole};
    double times[3]{};
    tpa_report report{};
    for (int i = 0; i < (with_events ? 3 : 2); ++i) {
      times[i] = 1e6 * StepTime(arena.context, parts[i], report);
      if (i < 2 && report.contacts > 0) Fail("a step that should meet nothing", {});
    }
    c.pierced += report.handles[0];
    if (!anew) c.next.push_back(times[0] - times[1]);
    c.quiets.push_back(times[1]);
    if (!with_events) continue;
    c.events.push_back(times[2] - times[1]);
    c.contacts.push_back(report.contacts);
    Renumber(arena.context, waiting);
  }
  return c;
}

// ---------------------------------------------------------------- table

void EventRow(uint32_t vertices, int events, int repeats, double beyond) {
  const Shell shell = MakeShell(vertices, beyond);
  tpa_config config = ConfigFor(shell.mesh);
  config.max_vertices += 4096;
  const Arena arena(config, Pages::large);
  tpa_issue issue = arena.issue;
  if (arena.context == nullptr) Fail("tpa_init", issue);
  tpa_arena_size size{};
  Check(tpa_arena_query(&config, &size, &issue), "tpa_arena_query", issue);
  SnapshotCosts s = CostsFromSnapshot(arena, shell, size.bytes, events, repeats);
  RunCosts r = CostsInARun(arena, shell, 200, true), none = CostsInARun(arena, shell, 200, false);
  std::printf("%9u %6d %7u %6.0f %6.0f %6.0f %6.0f %6.0f", VertexCount(shell.mesh), events, s.pierced,
              Quantile(s.quiets, 0.5), Quantile(s.firsts, 0.5), Quantile(s.firsts, 0.99), Quantile(s.leasts, 0.5),
              Quantile(s.leasts, 0.99));
  std::printf(" %6d %7u %8.0f %6.0f %6.0f %6.0f %6.0f\n", r.loads, r.pierced, Quantile(r.contacts, 0.5),
              Quantile(r.quiets, 0.5), Quantile(r.events, 0.5), Quantile(r.events, 0.99),
              Quantile(r.next, 0.5) - Quantile(none.next, 0.5));
  std::fflush(stdout);
}

}  // namespace

void EventTable(uint32_t least, uint32_t most, int repeats, double beyond) {
  std::printf("one event, %g edges beyond the other side, microseconds\n", beyond);
  std::printf("%24s %34s %51s\n", "", "from a snapshot", "in a run of 200");
  std::printf("%9s %6s %7s %6s %6s %6s %6s %6s %6s %7s %8s %6s %6s %6s %6s\n", "vertices", "events", "handles", "quiet",
              "first", "99 %", "least", "99 %", "loads", "handles", "contacts", "quiet", "event", "99 %", "after");
  struct Row {
    uint32_t vertices;
    int events;
  };
  for (const Row& row : {Row{2500, 200}, Row{10000, 200}, Row{40000, 100}, Row{160000, 50}, Row{640000, 20}})
    if (row.vertices >= least && row.vertices <= most) EventRow(row.vertices, row.events, repeats, beyond);
}

}  // namespace bench
