// SPDX-License-Identifier: MIT
// open_island: a step that has moved its vertices and knows its contacts, in the library's own rooms, all of them one
// island. Rooms that decide what happens at a contact are called one by one; the step is rolled back in the end.
#pragma once

#include <array>
#include <map>

#include "api/api.h"
#include "islands/contacts.h"
#include "islands/handles_made.h"
#include "islands/islands.h"
#include "islands/ledger.h"
#include "islands/small_components.h"
#include "support/support.h"

namespace support {

class OpenIsland {
  static void MoveTo(const Arena& arena, const Mesh& from, const Mesh& to) {
    if (from.positions == to.positions) return;
    EXPECT_EQ(MoveAll(*arena, to.positions), TPA_OK);
  }
  static tpa_config Spacious(const Mesh& m) {
    tpa_config config = DefaultConfig(4 * VertexCount(m) + 1000);
    config.max_contacts = 20000;
    return config;
  }

 public:
  OpenIsland(const Mesh& from, const Mesh& to, tpa::Mode mode = tpa::Mode::step)
      : arena_(Spacious(from), from),
        w((MoveTo(arena_, from, to), tpa::open(*tpa::context_of(*arena_)))),
        t(w, mode, tpa::Extent::whole, exec_, report, issue) {
    w.relocation.detection = &w.detection;
    w.pending_events.clear();
    tpa::begin(w.edit);
    tpa::allow_slots(w.edit, w.edit.mesh.vertex_capacity, w.edit.mesh.face_capacity);
    if (t.is_step()) Move();
    tpa::detect_moved_faces(t);
    tpa::know_components(w);
    tpa::know_volumes(t);
    tpa::forget_joins(w.before);
    tpa::note_met(t);
    Own(w.detection.pairs.span());
  }
  explicit OpenIsland(const Mesh& still) : OpenIsland(still, still) {}
  // As before its contacts were divided into islands.
  void Undivide() {
    t.islands.clear();
    t.contacts.clear();
    tpa::Journal& j = w.edit.journal;
    j.claims.owner = j.resting_vertex = j.resting_face = tpa::none;
    t.changed = false;
  }
  OpenIsland(const OpenIsland&) = delete;
  ~OpenIsland() {
    tpa::forget_clusters(w.clusters);
    tpa::forget_islands(t);
    tpa::rollback(w.edit);
    w.near_faces.tree = nullptr;
    for (uint32_t v = 0; v < w.edit.mesh.vertex_count; ++v) w.marks[v] &= tpa::target_state;
    w.context.components_known = false;
    tpa::close(w);
  }

  // The mesh as it is now, without holes. `number`, if given, becomes the number of each slot there.
  Mesh Now(std::vector<uint32_t>* number = nullptr) const {
    const tpa::Mesh& m = w.edit.mesh;
    Mesh now;
    std::vector<uint32_t> at(m.vertex_count, tpa::none);
    for (uint32_t v = 0; v < m.vertex_count; ++v) {
      if (!tpa::vertex_lives(m, v)) continue;
      at[v] = VertexCount(now);
      now.positions.insert(now.positions.end(), {m.position[v].x, m.position[v].y, m.position[v].z});
    }
    for (uint32_t f = 0; f < m.face_count; ++f)
      for (uint32_t h = 3 * f; tpa::face_lives(m, f) && h < 3 * f + 3; ++h) now.triangles.push_back(at[m.corner[h]]);
    if (number != nullptr) *number = at;
    return now;
  }
  // Edits of the island. A component made has `origin` for all of its vertices, and the numbers of its slots.
  std::vector<uint32_t> Make(const Mesh& part, tpa::VertexOrigin origin) {
    std::vector<uint32_t> at;
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> half_edges;
    for (uint32_t v = 0; v < VertexCount(part); ++v) {
      const Point p = PositionOf(part, v);
      at.push_back(tpa::new_vertex(w.edit, {p[0], p[1], p[2]}, origin));
    }
    for (uint32_t f = 0; f < TriangleCount(part); ++f) {
      const uint32_t* v = part.triangles.data() + 3 * f;
      MakeFace({at[v[0]], at[v[1]], at[v[2]]}, half_edges);
    }
    Link(half_edges);
    return at;
  }
  std::vector<uint32_t> Make(const Mesh& part) { return Make(part, {{0, 0}, .5f}); }
  // Removes a component.
  void Remove(const std::vector<uint32_t>& vertices) {
    tpa::remove_component(w.edit, w.near_faces, {vertices.data(), static_cast<uint32_t>(vertices.size())});
  }
  // Puts a tube of six faces in the place of two faces.
  void Bridge(uint32_t f, uint32_t g) {
    const tpa::Mesh& m = w.edit.mesh;
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> half_edges;
    const auto open = [&](uint32_t face) {
      std::array<uint32_t, 3> corners{};
      for (uint32_t i = 0; i < 3; ++i) {
        const uint32_t h = 3 * face + i;
        corners[i] = m.corner[h];
        half_edges[{tpa::head(m, h), tpa::tail(m, h)}] = m.opposite[h];
        tpa::set_vertex_edge(w.edit, tpa::head(m, h), m.opposite[h]);
      }
      for (uint32_t h = 3 * face; h < 3 * face + 3; ++h) tpa::unlink(w.edit, m.opposite[h]);
      tpa::remove(w.near_faces, face);
      tpa::delete_face(w.edit, face);
      return corners;
    };
    const std::array<uint32_t, 3> a = open(f), b = open(g);
    for (uint32_t i = 0; i < 3; ++i) {
      const uint32_t k = (i + 1) % 3;
      MakeFace({a[i], a[k], b[(3 - i) % 3]}, half_edges);
      MakeFace({a[k], b[(3 - k) % 3], b[(3 - i) % 3]}, half_edges);
    }
    Link(half_edges);
  }
  tpa::Attempt Attempt(uint32_t number, double bound) { return tpa::Attempt(t, number, tpa::Ledger{bound}); }

 private:
  void Move() {
    for (uint32_t v : w.targets) {
      const bool there = w.target[v] == w.edit.mesh.position[v];
      tpa::set_state(w, v, tpa::target_state, there ? tpa::target_reached : tpa::target_taken);
      if (there) continue;
      tpa::set_position(w.edit, v, w.target[v]);
      ++t.moved;
    }
  }
  void MakeFace(const std::array<uint32_t, 3>& v, std::map<std::pair<uint32_t, uint32_t>, uint32_t>& half_edges) {
    const uint32_t f = tpa::new_face(w.edit, v[0], v[1], v[2], tpa::none);
    for (uint32_t i = 0; i < 3; ++i) {
      half_edges[{v[i], v[(i + 1) % 3]}] = 3 * f + i;
      tpa::set_vertex_edge(w.edit, v[i], 3 * f + i);
    }
    tpa::insert(w.near_faces, w.edit.mesh, f);
  }
  void Link(const std::map<std::pair<uint32_t, uint32_t>, uint32_t>& half_edges) {
    for (const auto& [edge, h] : half_edges)
      if (edge.first < edge.second) tpa::link(w.edit, h, half_edges.at({edge.second, edge.first}));
  }
  void Own(tpa::Span<const tpa::Contact> contacts) {
    tpa::Claims& claims = w.edit.journal.claims;
    t.islands.push({0, contacts.size, tpa::none, 0, false});
    for (const tpa::Contact& c : contacts) t.contacts.push({c.a, c.b, 0});
    t.slots = tpa::slots_of(w.edit.mesh);
    w.edit.journal.resting_vertex = t.slots.free_vertex;
    w.edit.journal.resting_face = t.slots.free_face;
    claims.owner = 0;
    t.changed = true;
  }

  Arena arena_;
  tpa::Exec exec_{};

 public:
  tpa_report report{};
  tpa_issue issue{};
  tpa::Workspace w;
  tpa::Transaction t;
};

inline constexpr uint32_t papers_attempt = 0, cut_attempt = 1;

}  // namespace support
