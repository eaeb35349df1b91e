// SPDX-License-Identifier: MIT
#include "block/context.h"

#include <string.h>

#include "block/way_back.h"
#include "triangulate/candidates.h"

namespace tpa {

namespace {

enum class TableUnit : u8 {
  vertices,
  triangles,
  contacts,
  cuts,
  events,
  components,
  vertex_words,
  triangle_words,
  triangle_blocks,
  triangle_groups,
  scratch_bytes,
  // Of tpa_advance: nothing, unless it may make several sub-steps.
  kept_bytes,
  advanced_vertices,
  advanced_triangles,
  advanced_components,
  advanced_words
};

u64 elements(const Limits& l, TableUnit what) {
  switch (what) {
    case TableUnit::vertices: return l.vertices;
    case TableUnit::triangles: return l.triangles;
    case TableUnit::contacts: return l.contacts;
    case TableUnit::cuts: return l.cuts;
    case TableUnit::events: return l.events;
    case TableUnit::components: return l.components;
    case TableUnit::vertex_words: return bit_set_words(l.vertices);
    case TableUnit::triangle_words: return bit_set_words(l.triangles);
    case TableUnit::triangle_blocks: return blocks_of(l.triangles);
    case TableUnit::triangle_groups: return groups_of(l.triangles);
    case TableUnit::scratch_bytes: return place_scratch(l, nullptr);
    default: break;
  }
  if (l.substeps <= 1) return 0;
  switch (what) {
    case TableUnit::kept_bytes: return bytes_kept(l);
    case TableUnit::advanced_vertices: return l.vertices;
    case TableUnit::advanced_triangles: return l.triangles;
    case TableUnit::advanced_components: return l.components;
    default: return bit_set_words(l.vertices);
  }
}

struct TableRule {
  TableInfo info;
  u8 units;
  TableUnit count;
};

// Scratch stands for the pieces, in use within a call like all else there.
constexpr Measure measure_of(TableUnit c) {
  switch (c) {
    case TableUnit::vertices:
    case TableUnit::vertex_words: return Measure::vertices;
    case TableUnit::triangles:
    case TableUnit::triangle_words:
    case TableUnit::triangle_blocks:
    case TableUnit::triangle_groups: return Measure::triangles;
    case TableUnit::contacts: return Measure::contacts;
    case TableUnit::cuts: return Measure::cuts;
    case TableUnit::events: return Measure::events;
    case TableUnit::components: return Measure::components;
    case TableUnit::scratch_bytes: return Measure::pieces;
    default: return Measure::substeps;
  }
}

constexpr TableRule table_rules[table_count] = {
#define TPA_TABLE_RULE(name, type, units, measure) \
  {{#name, sizeof(type), measure_of(TableUnit::measure)}, units, TableUnit::measure},
    TPA_TABLES(TPA_TABLE_RULE)
#undef TPA_TABLE_RULE
};

// Half-edge numbers 3 F and slots 2 V must fit 32 bits.
constexpr u32 most_vertices = 1u << 29;
constexpr u64 most_triangles = (u64{1} << 30) + 1024;

bool resolve(u32 given, u64 otherwise, u64 least, u64 most, u32& out) {
  const u64 value = given == 0 ? otherwise : given;
  out = static_cast<u32>(value);
  return value >= least && value <= most;
}

// The defaults of limits. Seams grow more slowly than the mesh. The least terms fit small bodies (docs/limits.md).
u64 usual_triangles(u64 vertices) { return 2 * vertices + min_of<u64>(vertices / 16 + 64, 1024); }
u64 usual_contacts(u64 vertices) {
  return min_of(max_of(vertices / 3 + 128, vertices - min_of<u64>(vertices, 512)), vertices / 4 + 8192);
}
u64 usual_cuts(u64 vertices) {
  return min_of(min_of(max_of(vertices / 6 + 80, vertices / 4 - min_of<u64>(vertices / 4, 95)), vertices / 8 + 4096),
                vertices / 16 + 66560);
}
u64 usual_events(u64 vertices) { return min_of(vertices / 16 + 16, vertices / 128 + 256); }
u64 usual_components(u64 vertices) { return min_of(vertices / 3 + 1, vertices / 32 + 1024); }
u64 usual_pieces(u64 contacts) {
  return min_of(max_of(2 * contacts + 150, 4 * contacts - min_of<u64>(4 * contacts, 1100)), 5 * contacts / 4 + 8700);
}

bool in_range(f64 x, f64 low, f64 high) { return x >= low && x <= high; }

}  // namespace

const TableInfo& table_info(u32 id) { return table_rules[id].info; }

u64 context_cookie() {
  // Increases with each change of a table's content.
  constexpr u64 revision = 11;
  // "topoadap", mixed with numbers of the layout.
  return 0x746F706F61646170u ^ (u64{sizeof(Context)} << 40) ^ (u64{table_count} << 32) ^ (revision << 24) ^
         (u64{TPA_VERSION_MAJOR} << 16 | TPA_VERSION_MINOR << 8 | TPA_VERSION_PATCH);
}

i32 resolve_limits(const tpa_config& c, Limits& l) {
  l.vertices = c.max_vertices;
  if (c.max_vertices < 4 || c.max_vertices > most_vertices) return field_max_vertices;
  const u64 v = c.max_vertices;
  if (!resolve(c.max_triangles, usual_triangles(v), 4, most_triangles, l.triangles)) return field_max_triangles;
  if (!resolve(c.max_contacts, usual_contacts(v), 1, u64{1} << 30, l.contacts)) return field_max_contacts;
  if (!resolve(c.max_cut_edges, usual_cuts(v), 3, u64{1} << 28, l.cuts)) return field_max_cut_edges;
  if (!resolve(c.max_events, usual_events(v), 1, u64{1} << 28, l.events)) return field_max_events;
  if (!resolve(c.max_components, usual_components(v), 1, u64{1} << 28, l.components)) return field_max_components;
  if (!resolve(c.max_pieces, min_of(usual_pieces(max_of(u64{l.contacts}, usual_contacts(v))), u64{1} << 28), 1,
               u64{1} << 28, l.pieces))
    return field_max_pieces;
  if (!resolve(c.max_substeps, 1, 1, u64{1} << 20, l.substeps)) return field_max_substeps;
  if (c.detect_mode > TPA_DETECT_VERTEX_HASH) return field_detect_mode;
  if (!(c.cell_size > 0 && in_range(c.cell_size, smallest_magnitude, largest_magnitude))) return field_cell_size;
  if (c.region > TPA_REGION_OUTSIDE) return field_region;
  if (c.max_passes < 1 || c.max_passes > 64) return field_max_passes;
  if (c.max_candidates < 1 || c.max_candidates > most_candidates) return field_max_candidates;
  if (c.smooth_iterations > 1000) return field_smooth_iterations;
  if (!in_range(c.smooth_lambda, 0x1p-20, 1)) return field_smooth_lambda;
  if (!(c.smooth_mu < -c.smooth_lambda && in_range(c.smooth_mu, -1.5, 0))) return field_smooth_mu;
  return 0;
}

bool lay_out(BlockLayout& block) {
  const Limits& limits = block.limits;
  Layout layout;
  layout.place(sizeof(Context), 1);
  for (u32 i = 0; i < table_count; ++i) {
    u64 count = 0;
    layout.ok = layout.ok && checked_mul(table_rules[i].units, elements(limits, table_rules[i].count), count);
    // One element beyond the limit, for ends of ranges and for uncounted writes.
    block.tables[i] = layout.place(table_rules[i].info.element_bytes, count + 1);
  }
  layout.ok = layout.ok && checked_add(layout.bytes, arena_alignment, block.bytes);
  return layout.ok && block.bytes <= SIZE_MAX;
}

Context& make_context(void* block, const BlockLayout& layout) {
  Context& c = *context_in(block);
  u8* const memory = reinterpret_cast<u8*>(&c);
  // Each stage fills its scratch itself, by far the largest table.
  const Table& scratch = layout.tables[table_scratch];
  const u64 behind = scratch.offset + scratch.element_bytes * scratch.count;
  memset(memory, 0, static_cast<size_t>(scratch.offset));
  memset(memory + behind, 0, static_cast<size_t>(layout.bytes - arena_alignment - behind));
  c.bytes = layout.bytes;
  c.config = layout.config;
  c.limits = layout.limits;
  memcpy(c.tables, layout.tables, sizeof c.tables);
  place_scratch(c.limits, c.scratch);
  memset(table_data<u32>(c, table_cluster), 0xFF, c.limits.vertices * sizeof(u32));
  memset(table_data<u32>(c, table_vertex_owner), 0xFF, c.limits.vertices * sizeof(u32));
  memset(table_data<u32>(c, table_face_owner), 0xFF, c.limits.triangles * sizeof(u32));
  c.cookie = context_cookie();
  return c;
}

void forget_all(Context& c) {
  forget_targets(c);
  forget_rolled_back(c);
  Workspace w = open(c);
  w.edit.journal.vertices.clear();
  w.edit.journal.faces.clear();
  c.vertex_count = c.face_count = c.old_vertex_count = c.old_face_count = c.measured_faces = 0;
  c.loaded = c.known_clean = c.components_known = c.near_faces_stand = c.unsettled_known = false;
  c.event_count = c.component_count = c.ancestor_count = 0;
  ++c.epoch;
}

BitSet open_targets(const Context& c) { return open_bit_set(table_data<u32>(c, table_targets), c.limits.vertices); }

BitSet open_rolled_back(const Context& c) {
  return open_bit_set(table_data<u32>(c, table_rolled_back), c.limits.vertices);
}

namespace {

// Behind the memory of the shadow mesh.
u32* open_rolled_back_list(const Context& c) {
  static_assert(sizeof(OldVertex) >= 2 * sizeof(u32));
  return table_data<u32>(c, table_journal_vertex) + c.limits.vertices;
}

}  // namespace

void forget_rolled_back(Context& c) {
  if (c.rolled_back_count > 0) open_rolled_back(c).cut_off(0);
  c.rolled_back_count = 0;
}

const u32* rolled_back_list(const Context& c) { return open_rolled_back_list(c); }

void list_rolled_back(Context& c) {
  if (c.rolled_back_count == 0) return;
  u32* list = open_rolled_back_list(c);
  for (u32 v : open_rolled_back(c)) *list++ = v;
}

Scratch open_scratch(const Context& c) { return {table_data<u8>(c, table_scratch), c.scratch}; }

namespace {

template <class T>
Stack<T> stack(const Context& c, TableId id, u32 capacity) {
  return {table_data<T>(c, id), capacity, 0};
}

Journal open_journal(const Context& c) {
  Journal j;
  j.position = table_data<Vec3>(c, table_journal_position);
  j.vertex = table_data<OldVertex>(c, table_journal_vertex);
  j.face = table_data<OldFace>(c, table_journal_face);
  j.vertices = open_bit_set(table_data<u32>(c, table_touched_vertices), c.limits.vertices);
  j.faces = open_bit_set(table_data<u32>(c, table_touched_faces), c.limits.triangles);
  j.claims.vertex_owner = table_data<u32>(c, table_vertex_owner);
  j.claims.face_owner = table_data<u32>(c, table_face_owner);
  j.claims.vertices = open_bit_set(table_data<u32>(c, table_claimed_vertices), c.limits.vertices);
  j.claims.faces = open_bit_set(table_data<u32>(c, table_claimed_faces), c.limits.triangles);
  return j;
}

Clusters open_clusters(const Context& c, const Scratch& a) {
  Clusters r;
  r.cluster = table_data<u32>(c, table_cluster);
  r.walked = table_data<u8>(c, table_face_mark);  // zero whenever another stage uses the table
  r.group = a.group();
  r.group_number = a.group_number();
  r.stretches = a.stretches();
  r.taken_in = a.taken_in();
  r.members = {a.members(), c.limits.vertices};
  r.cuts = stack<Cut>(c, table_cuts, c.limits.cuts);
  r.middle = a.snapped_middle();
  r.loops = {a.loops(), most_loops(c.limits.cuts)};
  r.pieces = {a.pieces(), most_loops(c.limits.cuts)};
  return r;
}

Relocation open_relocation(const Context& c, const Scratch& a) {
  Relocation r;
  r.saved = a.saved_position();
  r.wanted = a.wanted_position();
  r.vertex_mark = table_data<u8>(c, table_vertex_mark);
  r.face_mark = table_data<u8>(c, table_face_mark);
  r.star = table_data<u8>(c, table_star_proof);
  r.rooms = {a.task_room(), task_rooms(c.limits.triangles)};
  r.faces = {a.face_list(), c.limits.triangles};
  r.vertices = {a.vertex_list(), c.limits.vertices};
  return r;
}

ClosingScratch open_closing(const Context& c, const Scratch& a) {
  const u32 corners = corners_of_piece(c.limits.cuts);
  ClosingScratch p;
  p.placed = {a.placed_faces(), 2 * corners};
  p.vertices = {a.loop_vertices(), corners};
  p.borders = {a.loop_borders(), corners};
  p.points = {a.loop_points(), corners};
  p.polygons = {a.polygons(), polygons_in_piece(c.limits.cuts)};
  p.search = {a.search(), static_cast<u32>(min_of<u64>(none, closing_scratch_bytes(corners)))};
  p.sewing = a.sew_table();
  return p;
}

// For use in the absence of clusters, whose memory is taken.
Parts open_parts(const Context& c, const Scratch& a) {
  const u32 components = c.limits.components;
  Parts p;
  p.part = table_data<u32>(c, table_cluster);
  p.following = a.following();
  p.list = {a.part_list(), most_parts(c.limits.vertices)};
  p.families = {a.families(), components};
  p.touched = {a.touched_components(), components};
  p.change = a.part_change();
  p.open = a.part_open();
  p.place = a.family_place();
  p.next_after = a.next_after();
  return p;
}

}  // namespace

void know_components(Workspace& w) {
  // Each step takes new nodes, at most as many as there can be components.
  const bool nodes_left = w.before.nodes <= w.before.list.capacity;
  if (!w.context.components_known || !nodes_left) {
    spend(w.near_faces.meter, w.edit.mesh.face_count);
    find_components(w.edit.mesh, w.before, w.work_vertices.data);
  }
  w.context.components_known = true;
}

void keep_volumes(const Workspace& w) {
  keep_volumes(w.before, table_data<KnownVolume>(w.context, table_known_volume));
}

void take_back_components(Workspace& w) {
  if (!w.context.components_known) find_components(w.edit.mesh, w.before, w.work_vertices.data);
  w.context.components_known = true;
  take_back_volumes(w.before, table_data<KnownVolume>(w.context, table_known_volume));
}

Mesh open_mesh(const Context& c) {
  Mesh m;
  m.position = table_data<Vec3>(c, table_position);
  m.vertex_edge = table_data<u32>(c, table_vertex_edge);
  m.vertex_origin = table_data<VertexOrigin>(c, table_vertex_origin);
  m.corner = table_data<u32>(c, table_corner);
  m.opposite = table_data<u32>(c, table_opposite);
  m.face_origin = table_data<u32>(c, table_face_origin);
  m.vertex_capacity = c.limits.vertices;
  m.face_capacity = c.limits.triangles;
  m.vertex_count = c.vertex_count;
  m.face_count = c.face_count;
  return m;
}

Components open_components(const Context& c) {
  return {table_data<u32>(c, table_component_label),
          table_data<u32>(c, table_component_node),
          c.component_nodes,
          {table_data<Component>(c, table_components), c.limits.components, c.component_count}};
}

BitSet open_changed_vertices(const Context& c) {
  return open_bit_set(table_data<u32>(c, table_changed_vertices), c.limits.vertices);
}

BitSet open_changed_faces(const Context& c) {
  return open_bit_set(table_data<u32>(c, table_changed_faces), c.limits.triangles);
}

Unsettled open_unsettled(const Context& c) {
  return {open_bit_set(table_data<u32>(c, table_unsettled_vertices), c.limits.vertices),
          open_bit_set(table_data<u32>(c, table_unsettled_faces), c.limits.triangles),
          open_bit_set(table_data<u32>(c, table_unsettled_lengths), c.limits.triangles),
          open_bit_set(table_data<u32>(c, table_unsettled_flips), c.limits.triangles),
          open_bit_set(table_data<u32>(c, table_lengths_before), c.limits.triangles),
          open_bit_set(table_data<u32>(c, table_flips_before), c.limits.triangles)};
}

Workspace open(Context& c) {
  const Scratch scratch = open_scratch(c);
  Workspace w{
      .context = c,
      .edit = {open_mesh(c), open_journal(c)},
      .near_faces = {},
      .tree = open_face_tree(scratch.face_tree(), c.limits.vertices, c.limits.triangles),
      .clusters = open_clusters(c, scratch),
      .detection = {stack<Contact>(c, table_contact_pairs, c.limits.contacts), 0},
      .relocation = open_relocation(c, scratch),
      .before = open_components(c),
      .after = {scratch.label_after(), scratch.after_node(), 0, {scratch.after_list(), most_parts(c.limits.vertices)}},
      .target = table_data<Vec3>(c, table_target),
      .targets = open_targets(c),
      .marks = table_data<u8>(c, table_marks),
      .old_to_new = table_data<u32>(c, table_old_to_new),
      .work_vertices = stack<u32>(c, table_work_vertices, c.limits.vertices),
      .rolled_back = open_rolled_back(c),
      .pending_events = stack<tpa_event>(c, table_pending_events, c.limits.events),
      .closing = open_closing(c, scratch),
      .cluster_area = scratch.cluster_area(),
      .parts = open_parts(c, scratch),
  };
  return w;
}

VertexHash open_vertex_hash(const Context& c) {
  const Scratch a = open_scratch(c);
  return {.head = a.vertex_head(),
          .slot = a.vertex_slot(),
          .link = a.vertex_link(),
          .order = a.vertex_order(),
          .marked = a.marked_slots(),
          .lower = a.lower_neighbour(),
          .slots = 2 * c.limits.vertices,
          .cell = c.config.cell_size,
          .longest_edge = c.longest_edge};
}

void forget_targets(Context& c) {
  u8* marks = table_data<u8>(c, table_marks);
  BitSet targets = open_targets(c);
  for (u32 v : targets) marks[v] = 0;
  targets.cut_off(0);
  c.target_count = 0;
}

void note_longest_edge(Context& c, const Mesh& m) {
  if (c.longest_edge_epoch == c.epoch) return;
  c.longest_edge = longest_edge(m);
  c.longest_edge_epoch = c.epoch;
}

void note_ancestors(Workspace& w) {
  u32* before = table_data<u32>(w.context, table_component_before);
  for (u32 i = 0; i < w.before.list.size; ++i) before[i] = w.before.list[i].before;
  w.context.ancestor_count = w.before.list.size;
}

void close(Workspace& w) {
  Context& c = w.context;
  const Mesh& m = w.edit.mesh;
  if (!c.components_known) find_components(m, w.before, w.work_vertices.data);
  c.components_known = true;
  c.vertex_count = m.vertex_count;
  c.face_count = m.face_count;
  list_rolled_back(c);
  c.component_count = w.before.list.size;
  c.component_nodes = w.before.nodes;
}

}  // namespace tpa
