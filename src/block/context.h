// SPDX-License-Identifier: MIT
// context: the content of the caller's block, table by table, and its state between calls. A Context keeps offsets and
// counts. A Workspace holds the pointers computed from them for the length of a call.
#pragma once

#include "base/arena.h"
#include "block/scratch.h"
#include "detect/detect_by_vertices.h"
#include "edit/remesh.h"
#include "mesh/component_volumes.h"
#include "topoadapt.h"

namespace tpa {

// The unit of a table's capacity, and its place in Context::peak. Numbered as TPA_LIMIT_...
enum class Measure : u8 {
  fixed = 0,
  vertices = 1,
  triangles = 2,
  contacts = 3,
  cuts = 4,
  events = 5,
  components = 6,
  pieces = 7,
  substeps = 8
};
inline constexpr u32 measure_count = 9;

// One line for each table: name, element type, elements for each unit of the measure, measure.
#define TPA_TABLES(X)                                 \
  X(position, Vec3, 1, vertices)                      \
  X(vertex_edge, u32, 1, vertices)                    \
  X(vertex_origin, VertexOrigin, 1, vertices)         \
  X(corner, u32, 3, triangles)                        \
  X(opposite, u32, 3, triangles)                      \
  X(face_origin, u32, 1, triangles)                   \
  X(old_to_new, u32, 1, vertices)                     \
  X(target, Vec3, 1, vertices)                        \
  X(targets, u32, 1, vertex_words)                    \
  X(journal_position, Vec3, 1, vertices)              \
  X(journal_vertex, OldVertex, 1, vertices)           \
  X(journal_face, OldFace, 1, triangles)              \
  X(touched_vertices, u32, 1, vertex_words)           \
  X(touched_faces, u32, 1, triangle_words)            \
  X(scratch, u8, 1, scratch_bytes)                    \
  X(vertex_owner, u32, 1, vertices)                   \
  X(face_owner, u32, 1, triangles)                    \
  X(claimed_vertices, u32, 1, vertex_words)           \
  X(claimed_faces, u32, 1, triangle_words)            \
  X(held_back, u32, 1, vertex_words)                  \
  X(in_contact, u32, 1, triangle_words)               \
  X(islands, Island, 1, contacts)                     \
  X(island_contacts, IslandContact, 1, contacts)      \
  X(star_proof, u8, 1, vertices)                      \
  X(contact_pairs, Contact, 1, contacts)              \
  X(cluster, u32, 1, vertices)                        \
  X(cuts, Cut, 1, cuts)                               \
  X(vertex_mark, u8, 1, vertices)                     \
  X(face_mark, u8, 1, triangles)                      \
  X(work_vertices, u32, 1, vertices)                  \
  X(marks, u8, 1, vertices)                           \
  X(component_label, u32, 1, vertices)                \
  X(component_node, u32, 2, components)               \
  X(components, Component, 1, components)             \
  X(known_volume, KnownVolume, 1, components)         \
  X(component_before, u32, 1, components)             \
  X(pending_events, tpa_event, 1, events)             \
  X(events, tpa_event, 1, events)                     \
  X(rolled_back, u32, 1, vertex_words)                \
  X(changed_vertices, u32, 1, vertex_words)           \
  X(changed_faces, u32, 1, triangle_words)            \
  X(block_volume, f64, 1, triangle_blocks)            \
  X(group_volume, f64, 1, triangle_groups)            \
  X(unsettled_vertices, u32, 1, vertex_words)         \
  X(unsettled_faces, u32, 1, triangle_words)          \
  X(unsettled_lengths, u32, 1, triangle_words)        \
  X(unsettled_flips, u32, 1, triangle_words)          \
  X(lengths_before, u32, 1, triangle_words)           \
  X(flips_before, u32, 1, triangle_words)             \
  X(kept, u8, 1, kept_bytes)                          \
  X(whole_origin, VertexOrigin, 1, advanced_vertices) \
  X(whole_map, u32, 1, advanced_vertices)             \
  X(whole_face_origin, u32, 1, advanced_triangles)    \
  X(goal, Vec3, 1, advanced_vertices)                 \
  X(left_behind, u32, 1, advanced_words)              \
  X(first_label, u32, 1, advanced_vertices)           \
  X(first_components, FirstComponent, 1, advanced_components)

enum TableId : u32 {
#define TPA_TABLE_ID(name, type, units, measure) table_##name,
  TPA_TABLES(TPA_TABLE_ID)
#undef TPA_TABLE_ID
      table_count
};

struct TableInfo {
  const char* name;
  u16 element_bytes;
  Measure measure;
};
// Static description of table `id`.
const TableInfo& table_info(u32 id);

inline constexpr u64 unknown_epoch = ~u64{0};

// Faces whose volumes are kept as one sum: of a block, and of all blocks of a group (results/region_volume.h).
inline constexpr u32 block_faces = 32, group_faces = 1024;
inline constexpr u64 blocks_of(u64 faces) { return (faces + block_faces - 1) / block_faces; }
inline constexpr u64 groups_of(u64 faces) { return (faces + group_faces - 1) / group_faces; }

// Contacts that end together (islands/island.h): a run in the list of contacts.
struct Island {
  u32 first = 0, count = 0;
  u32 joined = none;  // the island that it has become a part of
  u32 attempt = 0;    // number of the present attempt
  bool is_done = false;
  bool is_unfinished = false;  // the budget has ended before it was done
};
struct IslandContact {
  u32 a, b;  // as in Contact
  u32 island;
};

// A component before a tpa_advance.
struct FirstComponent {
  u32 id;
  i32 euler;
};

struct Context {
  u64 cookie;
  u64 bytes;  // of the caller's block
  tpa_config config;
  Limits limits;
  Table tables[table_count];
  u64 scratch[scratch_count];  // offsets within the scratch table
  u64 peak[measure_count];
  // Mesh
  u32 vertex_count, face_count;
  u64 epoch;
  f64 longest_edge;        // of the mesh at longest_edge_epoch
  u64 longest_edge_epoch;  // or unknown_epoch
  bool loaded;
  bool known_clean;       // the mesh is known to be free of contacts
  bool components_known;  // component_label and components describe the present mesh; always so between calls
  u32 component_count, component_nodes;
  u32 ancestor_count;  // of component_before; 0: each component was the same before the last commit
  u32 target_count;
  TreeShape tree;         // of the near faces
  bool near_faces_stand;  // `tree`, with its arrays in `scratch`, describes the present mesh
  bool unsettled_known;   // the unsettled vertices and faces tell where remeshing with these lengths would do anything
  f64 settled_split, settled_collapse;
  u32 measured_faces;  // block_volume and group_volume describe so many; 0: none
  // Results of the last commit
  u32 old_vertex_count, old_face_count;
  u32 event_count, rolled_back_count;
  bool all_changed;  // the whole mesh is new, as after tpa_load
};

// Names the layout of this build; snapshots of other builds are refused.
u64 context_cookie();

// Fields of tpa_config by position, for issues.
enum ConfigField : i32 {
  field_struct_size = 1,
  field_cookie,
  field_max_vertices,
  field_max_triangles,
  field_max_contacts,
  field_max_cut_edges,
  field_max_events,
  field_max_components,
  field_max_pieces,
  field_detect_mode,
  field_cell_size,
  field_region,
  field_max_passes,
  field_max_candidates,
  field_smooth_iterations,
  field_smooth_lambda,
  field_smooth_mu,
  field_max_substeps
};

// Checks a config and fills in derived limits. Returns 0, or the 1-based position of the field at fault.
i32 resolve_limits(const tpa_config& config, Limits& limits);

// The places of all tables behind the context, for a config with these limits.
struct BlockLayout {
  tpa_config config;
  Limits limits;
  Table tables[table_count];
  u64 bytes;  // of the caller's block: the tables, and what their alignment may skip
};

// The context in a block at this address. The tables are aligned, the block need not be.
inline Context* context_in(void* block) {
  u8* const memory = static_cast<u8*>(block);
  return reinterpret_cast<Context*>(memory + (0 - reinterpret_cast<uintptr_t>(memory)) % arena_alignment);
}
// Lays all tables out for `limits`, for tpa_arena_query and tpa_init alike. False on overflow.
bool lay_out(BlockLayout& layout);

// Makes a context without a mesh in a block of layout.bytes. O(bytes without scratch).
Context& make_context(void* block, const BlockLayout& layout);

inline void note_peak(Context& c, Measure what, u64 used) {
  u64& peak = c.peak[static_cast<u32>(what)];
  peak = max_of(peak, used);
}

struct Workspace {
  Context& context;
  Edit edit;
  NearFaces near_faces;
  FaceTree tree;
  Clusters clusters;
  Detection detection;
  Relocation relocation;
  Components before, after;  // after: labelled anew in the middle of a transaction
  Vec3* target;
  BitSet targets;  // the vertices with a target
  u8* marks;       // islands/attempt.h: between transactions zero except for vertices with a target
  u32* old_to_new;
  Stack<u32> work_vertices;
  BitSet rolled_back;  // published as a list
  Stack<tpa_event> pending_events;
  ClosingScratch closing;
  f64* cluster_area;
  Parts parts;
};

// The vertices with a target.
BitSet open_targets(const Context& c);
// The vertices that the last step left behind: a set, and between transactions also a list, in free memory of the
// journal. To list an empty set is O(1).
BitSet open_rolled_back(const Context& c);
const u32* rolled_back_list(const Context& c);
void list_rolled_back(Context& c);
void forget_rolled_back(Context& c);
// Drops all targets.
void forget_targets(Context& c);
// Forgets mesh, targets, maps and events. O(V).
void forget_all(Context& c);

// Keeps longest_edge up to date for the vertex hash. O(V) the first time after a commit.
void note_longest_edge(Context& c, const Mesh& m);

Scratch open_scratch(const Context& c);

// Memory beside the near faces, free between passes. Pre: note_longest_edge(), or the caller sets longest_edge.
VertexHash open_vertex_hash(const Context& c);

// Near faces with a tree outlast this call, as long as nothing else uses their memory or changes the mesh.
inline void keep_near_faces(Workspace& w) {
  w.context.near_faces_stand = w.near_faces.tree != nullptr;
  if (w.near_faces.tree != nullptr) w.context.tree = *w.near_faces.tree;
}

// Labels the components of the mesh as it is, in w.before. Moves do not change components, so labels last until the
// next event. `w.work_vertices` is scratch.
void know_components(Workspace& w);
// At the start of a call that edits: keeps what is known of volumes.
void keep_volumes(const Workspace& w);
// After a rollback: labels the components where edits made or removed any, and puts their volumes back.
void take_back_components(Workspace& w);

// Mesh and components, to be read.
Mesh open_mesh(const Context& c);
Components open_components(const Context& c);
// The vertices and faces that the last commit changed or made; of no meaning with all_changed.
BitSet open_changed_vertices(const Context& c);
BitSet open_changed_faces(const Context& c);
// Opened where it is used: a Workspace lies on the stack of every call.
Unsettled open_unsettled(const Context& c);
// In a commit: publishes Component::before of all components.
void note_ancestors(Workspace& w);

Workspace open(Context& c);
// Writes counts changed by a call back to the context, and labels the components if they are not known. Pairs with
// open() in every call that edits.
void close(Workspace& w);

// Notes the peaks of the slots in use, before holes are closed or edits taken back.
inline void note_elements_in_use(Workspace& w) {
  note_peak(w.context, Measure::vertices, w.edit.mesh.vertex_count);
  note_peak(w.context, Measure::triangles, w.edit.mesh.face_count);
}

template <class T>
T* table_data(const Context& c, TableId id) {
  return reinterpret_cast<T*>(const_cast<char*>(reinterpret_cast<const char*>(&c)) + c.tables[id].offset);
}

}  // namespace tpa
