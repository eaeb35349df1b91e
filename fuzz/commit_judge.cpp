// SPDX-License-Identifier: MIT
#include "commit_judge.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

#include "blocks.h"
#include "oracle/commit_oracle.h"
#include "oracle/exact.h"
#include "oracle/mesh_oracle.h"
#include "region_judge.h"
#include "target.h"

namespace fuzz {

using namespace support;

Mesh MeshOf(const tpa_context* context) {
  auto view = Sized<tpa_mesh_view>();
  if (tpa_view(context, &view) != TPA_OK) return {};
  return {{view.positions, view.positions + 3 * size_t{view.vertex_count}},
          {view.triangles, view.triangles + 3 * size_t{view.triangle_count}}};
}

Targets TargetsOf(const tpa_context* context) {
  uint32_t count = 0;
  Demand(tpa_targets(context, nullptr, nullptr, 0, &count) == TPA_OK, "a context counts its targets");
  Targets t{std::vector<uint32_t>(count), std::vector<double>(3 * size_t{count})};
  Demand(tpa_targets(context, t.vertices.data(), t.positions.data(), count, &count) == TPA_OK, "targets are told");
  return t;
}

Before::Before(const tpa_context* context) : mesh(MeshOf(context)), moved(mesh) {
  const Targets t = TargetsOf(context);
  for (size_t i = 0; i < t.vertices.size(); ++i)
    for (size_t k = 0; k < 3; ++k) moved.positions[3 * size_t{t.vertices[i]} + k] = t.positions[3 * i + k];
  auto view = Sized<tpa_mesh_view>();
  if (tpa_view(context, &view) == TPA_OK) epoch = view.epoch;
}

// ---------------------------------------------------------------- the mesh

namespace {

void JudgeOpposites(const tpa_context* context) {
  auto view = Sized<tpa_mesh_view>();
  Demand(tpa_view(context, &view) == TPA_OK && view.reserved == 0, "a mesh to view");
  const auto head = [&](uint32_t h) { return view.triangles[h % 3 == 2 ? h - 2 : h + 1]; };
  for (uint32_t h = 0; h < 3 * view.triangle_count; ++h) {
    const uint32_t o = view.opposites[h];
    const bool is_opposite = o < 3 * view.triangle_count && view.opposites[o] == h && view.triangles[o] == head(h) &&
                             head(o) == view.triangles[h];
    if (!is_opposite) Demand(false, "opposites[", h, "] is the same edge in the other triangle");
  }
}

void JudgeExport(const tpa_context* context, const Mesh& m) {
  Mesh copy{std::vector<double>(m.positions.size()), std::vector<uint32_t>(m.triangles.size())};
  auto out = Sized<tpa_mesh_output>();
  out.position_type = TPA_FLOAT64;
  out.index_type = TPA_UINT32;
  out.vertex_capacity = VertexCount(m);
  out.triangle_capacity = TriangleCount(m);
  out.positions = copy.positions.data();
  out.triangles = copy.triangles.data();
  Demand(tpa_export(context, &out, nullptr) == TPA_OK, "a mesh to export");
  Demand(Differing(copy.positions, m.positions).empty() && copy.triangles == m.triangles, "the mesh is exported");
}

void JudgeComponents(const tpa_context* context, const Mesh& m, const Topology& topology) {
  uint32_t count = 0;
  Demand(tpa_components(context, nullptr, 0, nullptr, &count, nullptr) == TPA_OK, "components are counted");
  Demand(count == topology.components.size(), "components: ", count, " of ", topology.components.size());
  std::vector<tpa_component> list(count);
  std::vector<uint32_t> labels(VertexCount(m));
  Demand(tpa_components(context, list.data(), count, labels.data(), &count, nullptr) == TPA_OK, "and listed");
  const Labels names = LabelsOf(m);
  std::vector<double> size(count, 0);
  for (uint32_t i = 0; i < count; ++i) {
    const Component& c = topology.components[i];
    const tpa_component& told = list[i];
    Demand(told.id == c.smallest_vertex && told.vertices == c.vertices && told.triangles == c.triangles &&
               told.genus == c.genus && told.reserved == 0,
           "component ", i, " is as its triangles say");
    for (size_t k = 0; k < 3; ++k) size[i] = std::max(size[i], told.box[k + 3] - told.box[k]);
    double far = size[i];
    for (double x : told.box) far = std::max(far, std::fabs(x));
    // The oracle's rounding is relative to the place.
    Demand(std::fabs(told.volume - c.volume) <= 1e-12 * c.triangles * far * far * far, "volume of ", i);
  }
  std::vector<Point> low(count), high(count);
  std::vector<bool> is_met(count, false);
  for (uint32_t v = 0; v < VertexCount(m); ++v) {
    const uint32_t i = labels[v];
    Demand(i < count && list[i].id == names.of[v], "label of vertex ", v);
    const Point p = PositionOf(m, v);
    if (!is_met[i]) low[i] = high[i] = p;
    is_met[i] = true;
    for (size_t k = 0; k < 3; ++k) low[i][k] = std::min(low[i][k], p[k]), high[i][k] = std::max(high[i][k], p[k]);
  }
  for (uint32_t i = 0; i < count; ++i)
    for (size_t k = 0; k < 3; ++k)
      Demand(list[i].box[k] == low[i][k] && list[i].box[3 + k] == high[i][k], "box of component ", i);
}

}  // namespace

void JudgeMesh(const tpa_context* context, Judged& judged) {
  auto view = Sized<tpa_mesh_view>();
  if (tpa_view(context, &view) == TPA_E_STATE) return;
  const Mesh m = MeshOf(context);
  const Topology topology = TopologyOf(m);
  Demand(topology.defect.empty(), "a closed oriented 2-manifold, but: ", topology.defect);
  JudgeOpposites(context);
  JudgeExport(context, m);
  JudgeComponents(context, m, topology);
  ++judged.meshes;
}

// ---------------------------------------------------------------- commits

namespace {

struct Maps {
  tpa_vertex_map_view vertices = Sized<tpa_vertex_map_view>();
  tpa_triangle_map_view triangles = Sized<tpa_triangle_map_view>();
  const uint32_t* rolled_back = nullptr;
  uint32_t rolled_back_count = 0;
  const tpa_event* events = nullptr;
  uint32_t event_count = 0;
  explicit Maps(const tpa_context* context) {
    Demand(tpa_vertex_map(context, &vertices) == TPA_OK && tpa_triangle_map(context, &triangles) == TPA_OK &&
               tpa_rolled_back(context, &rolled_back, &rolled_back_count) == TPA_OK &&
               tpa_events(context, &events, &event_count) == TPA_OK,
           "maps to view");
  }
};

// A triangle without area is beyond the oracle on pairs.
bool HasFlatTriangle(const Mesh& m) {
  for (size_t f = 0; f < m.triangles.size(); f += 3) {
    bool is_flat = true;
    for (size_t i = 0; i < 3; ++i)
      is_flat = is_flat && Turn(PositionOf(m, m.triangles[f]), PositionOf(m, m.triangles[f + 1]),
                                PositionOf(m, m.triangles[f + 2]), i, (i + 1) % 3) == 0;
    if (is_flat) return true;
  }
  return false;
}

void JudgeMaps(const Mesh& before, const Mesh& after, const Maps& maps) {
  const tpa_vertex_map_view& v = maps.vertices;
  const tpa_triangle_map_view& t = maps.triangles;
  Demand(v.old_count == VertexCount(before) && v.new_count == VertexCount(after) && v.reserved == 0 &&
             t.old_count == TriangleCount(before) && t.new_count == TriangleCount(after) && t.reserved == 0,
         "maps are from the mesh before to the mesh after");
  for (uint32_t i = 0; i < v.new_count; ++i) {
    const tpa_vertex_origin& o = v.origins[i];
    const bool is_old = o.parents[1] == TPA_NONE;
    Demand(o.parents[0] < v.old_count && o.weight >= 0 && o.weight <= 1, "origin of vertex ", i);
    Demand(is_old ? o.weight == 1 && v.old_to_new[o.parents[0]] == i : o.parents[1] < v.old_count, "parents of vertex ",
           i);
  }
  for (uint32_t i = 0; i < v.old_count; ++i) {
    const uint32_t to = v.old_to_new[i];
    if (to == TPA_NONE) continue;
    Demand(to < v.new_count && v.origins[to].parents[0] == i && v.origins[to].parents[1] == TPA_NONE,
           "old_to_new and origins agree about vertex ", i);
  }
  for (uint32_t f = 0; f < t.new_count; ++f)
    Demand(t.origins[f] == TPA_NONE || t.origins[f] < t.old_count, "origin of triangle ", f);
}

// Vertices that no event touched (P4): where nothing happened, all of them.
void JudgePositions(const Deed& deed, const Before& before, const Mesh& after, const Maps& maps) {
  for (uint32_t i = 0; i < maps.rolled_back_count; ++i) {
    const uint32_t v = maps.rolled_back[i];
    Demand(v < VertexCount(after) && (i == 0 || maps.rolled_back[i - 1] < v), "vertices left behind, ascending");
  }
  const bool moves = deed.kind == DeedKind::step || deed.kind == DeedKind::advance;
  const bool is_untouched = maps.event_count == 0 && (moves || deed.kind == DeedKind::adapt);
  if (!is_untouched || maps.vertices.old_count != maps.vertices.new_count) return;
  const Mesh& expected = moves ? before.moved : before.mesh;
  if (after.triangles != expected.triangles) return;
  // As numbers: a vertex at 0 stays where its target is -0.
  if (maps.rolled_back_count == 0)
    Demand(expected.positions == after.positions, "without an event all vertices are where they went");
}

void JudgeOrigins(const Before& before, const Mesh& after, const Maps& maps, DeedKind kind, Judged& judged) {
  const std::vector<double> longest = LongestEdges(after);
  const std::set<uint32_t> rolled_back(maps.rolled_back, maps.rolled_back + maps.rolled_back_count);
  const auto places = [&](uint32_t id) -> std::vector<Point> {
    const Point from = PositionOf(before.mesh, id), to = PositionOf(before.moved, id);
    if (kind != DeedKind::step) return {from};
    const uint32_t now = maps.vertices.old_to_new[id];
    if (now == TPA_NONE) return {from, to};
    return {rolled_back.count(now) != 0 ? from : to};
  };
  for (uint32_t v = 0; v < maps.vertices.new_count; ++v) {
    const tpa_vertex_origin& o = maps.vertices.origins[v];
    // Cuts and smoothing move an old vertex by less than an edge.
    if (o.parents[1] == TPA_NONE && kind == DeedKind::step)
      Demand(Distance(places(o.parents[0])[0], PositionOf(after, v)) <= longest[v], "vertex ", v,
             " has arrived, or is named among those held back");
    if (o.parents[1] == TPA_NONE || (o.parents[0] == o.parents[1] && o.weight == 0)) continue;
    double least = HUGE_VAL;
    for (const Point& a : places(o.parents[0]))
      for (const Point& b : places(o.parents[1]))
        least = std::min(least, OffOrigin(a, b, static_cast<double>(o.weight), PositionOf(after, v), longest[v]));
    Demand(least <= 1 + 1e-9, "vertex ", v, " lies near its parents, at ", least, " of the bound");
    ++judged.made_vertices;
  }
}

void JudgeChanges(const tpa_context* context, const Mesh& before, const Mesh& after) {
  std::vector<tpa_range> vertices(VertexCount(after) + 1), triangles(TriangleCount(after) + 1);
  auto list = Sized<tpa_change_list>();
  list.vertex_capacity = static_cast<uint32_t>(vertices.size());
  list.triangle_capacity = static_cast<uint32_t>(triangles.size());
  list.vertices = vertices.data();
  list.triangles = triangles.data();
  Demand(tpa_changes(context, &list, nullptr) == TPA_OK, "changes are listed");
  const auto agree = [](const std::vector<tpa_range>& told, uint32_t count, const std::vector<uint32_t>& ids) {
    const auto ranges = Joined(ids, 0);
    bool is_same = ranges.size() == count;
    for (uint32_t i = 0; is_same && i < count; ++i)
      is_same = told[i].first == ranges[i].first && told[i].first + told[i].count - 1 == ranges[i].second;
    return is_same;
  };
  Demand(agree(vertices, list.vertex_ranges, Differing(before.positions, after.positions)), "changed vertices");
  Demand(agree(triangles, list.triangle_ranges, Differing(before.triangles, after.triangles)), "changed triangles");
  Demand(list.old_vertex_count == VertexCount(before) && list.vertex_count == VertexCount(after) &&
             list.old_triangle_count == TriangleCount(before) && list.triangle_count == TriangleCount(after),
         "counts before and after");
}

void JudgeCarried(const tpa_context* context, const Mesh& after, const Maps& maps) {
  std::vector<float> before(maps.vertices.old_count), now(maps.vertices.new_count);
  before.reserve(1), now.reserve(1);  // no NULL for an empty mesh
  for (size_t v = 0; v < before.size(); ++v) before[v] = static_cast<float>(v % 7) - 3;
  Demand(tpa_carry_vertices(context, before.data(), 1, now.data()) == TPA_OK, "attributes of vertices are carried");
  for (uint32_t v = 0; v < now.size(); ++v) {
    const tpa_vertex_origin& o = maps.vertices.origins[v];
    const double w = static_cast<double>(o.weight), a = static_cast<double>(before[o.parents[0]]);
    const double b = o.parents[1] == TPA_NONE ? a : static_cast<double>(before[o.parents[1]]);
    Demand(std::fabs(static_cast<double>(now[v]) - (w * a + (1 - w) * b)) <= 1e-6, "attribute of vertex ", v);
  }
  std::vector<float> of_faces(maps.triangles.old_count), carried(maps.triangles.new_count);
  of_faces.reserve(1), carried.reserve(1);
  for (size_t f = 0; f < of_faces.size(); ++f) of_faces[f] = static_cast<float>(f + 1);
  Demand(tpa_carry_triangles(context, of_faces.data(), 1, carried.data()) == TPA_OK, "attributes of faces are carried");
  std::vector<bool> has_origin;
  for (uint32_t f = 0; f < carried.size(); ++f) has_origin.push_back(maps.triangles.origins[f] != TPA_NONE);
  const std::vector<uint32_t> source = RowSources(has_origin, NeighboursOfTriangles(after));
  for (uint32_t f = 0; f < carried.size(); ++f)
    Demand(carried[f] == (source[f] == TPA_NONE ? 0 : of_faces[maps.triangles.origins[source[f]]]),
           "attribute of triangle ", f);
}

void JudgeEvents(const Mesh& before, const Mesh& after, const Maps& maps, Judged& judged) {
  Demand(ComponentEventsAmong(maps.events, maps.event_count) ==
             ExpectedComponentEvents(before, after, maps.vertices.origins),
         "the events of components are those of the meshes before and after");
  judged.events += maps.event_count;
}

// Vertices that the step left at their old places go back.
Mesh RolledBack(const Before& before, const Maps& maps) {
  Mesh m = before.moved;
  for (uint32_t i = 0; i < maps.rolled_back_count; ++i) {
    const tpa_vertex_origin& o = maps.vertices.origins[maps.rolled_back[i]];
    for (size_t c = 3 * size_t{o.parents[0]}; o.parents[1] == TPA_NONE && c < 3 * size_t{o.parents[0]} + 3; ++c)
      m.positions[c] = before.mesh.positions[c];
  }
  return m;
}

void JudgeRegion(const Deed& deed, const Before& before, const Mesh& after, const Maps& maps, const tpa_report& r,
                 const tpa_config& config, Judged& judged) {
  if (config.region != TPA_REGION_INSIDE) return;
  double size = 0;
  for (double x : before.moved.positions) size = std::max(size, std::fabs(x));
  if (size > 0x1p20 || size < 0x1p-20) return;  // beyond the judge's own precision
  const bool moves = deed.kind == DeedKind::step;
  const Mesh moved = moves ? RolledBack(before, maps) : before.mesh;
  const Mesh& aimed = moves ? before.moved : before.mesh;
  if (HasFlatTriangle(aimed) || HasFlatTriangle(moved)) return;  // beyond the oracle on pairs
  const std::string fault = RegionFault(aimed, moved, after, r, judged.points);
  Demand(fault.empty(), "the region of winding number 1 or more, but: ", fault);
  ++judged.regions;
}

// A commit of new numbers alone.
void JudgeOrder(const Mesh& before, const Mesh& after, const Maps& maps) {
  Demand(maps.vertices.old_count == maps.vertices.new_count && maps.triangles.old_count == maps.triangles.new_count &&
             maps.event_count == 0 && maps.rolled_back_count == 0,
         "new numbers make no elements and no events");
  const auto corner = [](const Mesh& m, uint32_t f, uint32_t i) { return m.triangles[3 * size_t{f} + i]; };
  for (uint32_t v = 0; v < maps.vertices.new_count; ++v)
    Demand(PositionOf(after, v) == PositionOf(before, maps.vertices.origins[v].parents[0]), "position of vertex ", v);
  for (uint32_t f = 0; f < maps.triangles.new_count; ++f)
    for (uint32_t i = 0; i < 3; ++i)
      Demand(corner(after, f, i) == maps.vertices.old_to_new[corner(before, maps.triangles.origins[f], i)], "corner ",
             i, " of triangle ", f);
}

}  // namespace

void JudgeCommit(const Deed& deed, const Before& before, const Outcome& o, bool is_proper, tpa_context* context,
                 Judged& judged) {
  const Mesh after = MeshOf(context);
  const Maps maps(context);
  const Before now(context);
  Demand(now.epoch > before.epoch, "the epoch grows with every commit");
  Demand(TargetsOf(context).vertices.empty(), "a commit discards targets");
  const bool is_load = deed.kind == DeedKind::load;
  const Mesh& start = is_load ? after : before.mesh;
  JudgeMaps(start, after, maps);
  JudgeCarried(context, after, maps);
  if (is_load) return;
  if (deed.kind == DeedKind::reorder) {
    JudgeOrder(before.mesh, after, maps);
    JudgeChanges(context, before.mesh, after);
    return;
  }
  Demand(o.report.vertices == VertexCount(after) && o.report.triangles == TriangleCount(after), "counts of the report");
  const Pairs pairs = AllMeetingPairs(after);
  judged.pairs += pairs.size();
  const size_t expected = deed.kind == DeedKind::adapt ? o.report.unresolved : 0;
  Demand(HasFlatTriangle(after) || pairs.size() == expected, pairs.size(), " pairs of triangles meet, ", expected,
         " as reported");
  Demand(o.report.rolled_back_vertices == maps.rolled_back_count, "vertices left behind are counted");
  JudgeEvents(before.mesh, after, maps, judged);
  JudgePositions(deed, before, after, maps);
  if (deed.kind != DeedKind::advance) JudgeOrigins(before, after, maps, deed.kind, judged);
  JudgeChanges(context, before.mesh, after);
  const bool has_region = is_proper && (deed.kind == DeedKind::step || deed.kind == DeedKind::adapt);
  if (has_region) JudgeRegion(deed, before, after, maps, o.report, ConfigOf(context), judged);
}

// ---------------------------------------------------------------- detection

void JudgeDetection(tpa_context* context, const Host& host, Judged& judged) {
  const Mesh m = MeshOf(context);
  const uint64_t digest = DigestOf(context);
  auto contacts = Sized<tpa_contacts>();
  auto validation = Sized<tpa_validation>();
  tpa_issue issue, other;
  tpa_status found = TPA_OK, valid = TPA_OK;
  Pairs told;
  {
    const support::Hosted hosted(host.environment);
    found = tpa_detect(context, nullptr, &contacts, &issue);
    for (uint32_t i = 0; found == TPA_OK && i < contacts.count; ++i)
      told.emplace_back(contacts.pairs[i].a, contacts.pairs[i].b);
    valid = tpa_validate(context, nullptr, &validation, &other);
  }
  Demand(DigestOf(context) == digest, "a look changes nothing");
  if (m.positions.empty() || HasFlatTriangle(m)) return;
  const Pairs pairs = AllMeetingPairs(m);
  judged.pairs += pairs.size();
  const tpa_config config = ConfigOf(context);
  const bool is_complete = config.detect_mode == TPA_DETECT_COMPLETE;
  if (found == TPA_OK) {
    const bool is_right =
        is_complete ? told == pairs : std::includes(pairs.begin(), pairs.end(), told.begin(), told.end());
    Demand(is_right, "the pairs of triangles that meet: ", told.size(), " of ", pairs.size());
  } else {
    Demand(found == TPA_E_LIMIT && issue.limit == TPA_LIMIT_CONTACTS && issue.needed > issue.available &&
               (!is_complete || issue.needed == pairs.size()),
           "tpa_detect fails for want of room only, and says how much: ", issue.needed, " for ", pairs.size());
  }
  Demand(valid == TPA_OK || (valid == TPA_E_LIMIT && other.limit == TPA_LIMIT_CONTACTS), "a sound mesh, always");
  const Topology topology = TopologyOf(m);
  Demand(validation.self_intersections == pairs.size() && validation.components == topology.components.size() &&
             validation.genus == topology.Genus(),
         "tpa_validate: ", validation.self_intersections, " pairs of ", pairs.size());
}

}  // namespace fuzz
