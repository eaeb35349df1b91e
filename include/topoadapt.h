/* SPDX-License-Identifier: MIT */
/* topoadapt: topology changes of moving triangle meshes, in fixed memory. Method and sections cited are those of "A
 * robust and efficient method for topology adaptations in deformable models". README.md has the guarantees P1 to P8,
 * docs/guide.md each task. The common case, after tpa_config_init, tpa_arena_query and tpa_init:
 *
 *     tpa_load(ctx, &mesh, &issue);                     once
 *     tpa_move(ctx, &targets, &issue);                  each step: the wanted positions of vertices
 *     tpa_step(ctx, NULL, &report, &issue);             each step: move, detect, adapt, check, commit
 *
 * RULES FOR ALL FUNCTIONS
 * Memory     The library never allocates. A context is one block of the caller, without pointers: a byte copy at an
 *            address equal modulo tpa_arena_size.alignment is one, too, for the same build. Stack: at most 16 KiB.
 * Threads    Each context has one writer (a call with a non-const context) or any number of readers at a time.
 * Errors     A failure leaves mesh, maps and events bit for bit as before. `issue` may be NULL; a failure writes all
 *            that is known there, success TPA_OK and zeros.
 * Versions   Set `struct_size` to the sizeof of each structure that has one. Shorter and longer structures of other
 *            headers are taken; bytes unknown to the library must be 0 (docs/versioning.md).
 * Determinism  Equal calls on equal states give equal bits on every platform, with any number of threads (P6). A call
 *            sets rounding and traps as it needs, and puts those of the caller back (docs/porting.md).
 * Coordinates  IEEE doubles, each zero or of magnitude within [2^-100, 2^100], in a unit of the caller.
 * Ids        Vertices are 0 .. vertex_count-1, triangles 0 .. triangle_count-1. A commit, that is a successful
 *            tpa_adapt, tpa_step, tpa_advance, tpa_remesh or tpa_smooth, drops targets and replaces maps and events.
 * Empty      A mesh whose last component dies is empty: calls succeed and do nothing. tpa_load takes no empty mesh.
 * Pointers   Pointers handed out are valid until the next call with a non-const context.
 */
#ifndef TOPOADAPT_H
#define TOPOADAPT_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* TPA_BUILD compiles the library itself; TPA_SHARED makes it a shared library, or links a DLL on Windows. Without
 * TPA_SHARED a plugin that links the library exports none of its functions. */
#ifndef TPA_API
#if defined(_WIN32) && defined(TPA_SHARED) && defined(TPA_BUILD)
#define TPA_API __declspec(dllexport)
#elif defined(_WIN32) && defined(TPA_SHARED)
#define TPA_API __declspec(dllimport)
#elif defined(_WIN32) || !defined(__GNUC__)
#define TPA_API
#elif defined(TPA_BUILD) && !defined(TPA_SHARED) && !defined(__wasm__)
#define TPA_API __attribute__((visibility("hidden")))
#else
#define TPA_API __attribute__((visibility("default")))
#endif
#endif

#define TPA_VERSION_MAJOR 0
#define TPA_VERSION_MINOR 3
#define TPA_VERSION_PATCH 0

/* "No such element", in place of any id. */
#define TPA_NONE 0xFFFFFFFFu

typedef struct tpa_context tpa_context;

/* ---------------------------------------------------------------- statuses and issues */

typedef int32_t tpa_status;
enum tpa_status_code {
  TPA_OK = 0,
  TPA_E_ARGUMENT = -1, /* a forbidden NULL, a struct_size of no version, a value out of range */
  TPA_E_CONFIG = -2,   /* a config not filled by tpa_config_init, or with a value out of range */
  TPA_E_OVERFLOW = -3, /* a size beyond the address space */
  TPA_E_ARENA = -4,    /* the block is too small; issue.needed: bytes */
  TPA_E_CONTEXT = -5,  /* not a context of this version and build */
  TPA_E_STATE = -6,    /* no mesh is loaded: tpa_events, tpa_rolled_back and the calls on state need none */
  TPA_E_LIMIT = -7,    /* a limit of the config is reached: issue.limit names it, issue.needed says how much */
  TPA_E_MESH = -8,     /* no closed oriented 2-manifold, or an unusable coordinate or id: issue.defect and .element */
  TPA_E_TANGLED = -9,  /* the mesh intersects itself: issue.element and .other are triangles that meet (0 above
                          max_contacts pairs), issue.needed counts the pairs */
  TPA_E_ENVIRONMENT = -10, /* rounding and subnormal numbers cannot be set as needed (docs/porting.md) */
  TPA_E_BUDGET = -11,      /* tpa_exec.budget is spent; issue.needed is enough, or 0 */
  TPA_E_CANCELLED = -12,   /* tpa_exec.cancel became nonzero */
  TPA_E_DATA = -13         /* tpa_restore: no saved state; issue.element is the offset of the first bad byte */
};

/* Defects of a mesh. A failure reports the first one in this order. */
enum tpa_defect {
  TPA_DEFECT_NONE = 0,
  TPA_DEFECT_NOT_FINITE = 1,          /* vertex `element` has a NaN or infinite coordinate; tpa_move: its target, at
                                         index `other` of the list */
  TPA_DEFECT_MAGNITUDE = 2,           /* likewise: a coordinate outside the exact range */
  TPA_DEFECT_INDEX_RANGE = 3,         /* triangle `element`, or index `element` of a list of ids, names an unknown
                                         vertex `other`; issue.available vertices exist */
  TPA_DEFECT_REPEATED_VERTEX = 4,     /* triangle `element` uses vertex `other` twice */
  TPA_DEFECT_ORIENTATION = 5,         /* edge of vertices `element`, `other`: two triangles use the same direction */
  TPA_DEFECT_NON_MANIFOLD_EDGE = 6,   /* edge of vertices `element`, `other` has more than two triangles */
  TPA_DEFECT_BOUNDARY_EDGE = 7,       /* edge of vertices `element`, `other` has a single triangle */
  TPA_DEFECT_NON_MANIFOLD_VERTEX = 8, /* the triangles at vertex `element` form more than one fan */
  TPA_DEFECT_ISOLATED_VERTEX = 9      /* vertex `element` belongs to no triangle */
};

/* The limits of tpa_config, for tpa_issue.limit and tpa_memory_stats. */
enum tpa_limit {
  TPA_LIMIT_NONE = 0,
  TPA_LIMIT_VERTICES = 1,   /* tpa_config.max_vertices */
  TPA_LIMIT_TRIANGLES = 2,  /* tpa_config.max_triangles */
  TPA_LIMIT_CONTACTS = 3,   /* tpa_config.max_contacts */
  TPA_LIMIT_CUT = 4,        /* tpa_config.max_cut_edges */
  TPA_LIMIT_EVENTS = 5,     /* tpa_config.max_events */
  TPA_LIMIT_COMPONENTS = 6, /* tpa_config.max_components */
  TPA_LIMIT_PIECES = 7,     /* tpa_config.max_pieces */
  TPA_LIMIT_SUBSTEPS = 8    /* tpa_config.max_substeps */
};

typedef struct tpa_issue {
  tpa_status status;
  int32_t defect;     /* TPA_DEFECT_... with TPA_E_MESH; for tpa_issue_text with an argument at fault; else 0 */
  int32_t limit;      /* TPA_LIMIT_... with TPA_E_LIMIT, else 0 */
  int32_t argument;   /* 1-based position of the argument at fault, with TPA_E_CONFIG of the config field, else 0 */
  uint64_t element;   /* id of the element at fault, or 0 */
  uint64_t other;     /* second id, or 0 */
  uint64_t needed;    /* a sufficient amount (bytes, elements, units), or 0; limits: docs/limits.md */
  uint64_t available; /* the amount at hand, or 0 */
} tpa_issue;

/* English name of a status or of any other number, never NULL. Static storage. O(1). */
TPA_API const char* tpa_status_string(tpa_status status);

/* Writes a line of English about the issue into text[0..size-1], cut off and terminated there. Returns the length of
 * the whole line; 0 for issue == NULL. O(length). */
TPA_API size_t tpa_issue_text(const tpa_issue* issue, char* text, size_t size);

/* Version of the linked library: major << 16 | minor << 8 | patch. O(1). */
TPA_API uint32_t tpa_version(void);

/* Version, compiler and, where known, commit of the linked library, in a line. Static storage, never NULL. O(1). */
TPA_API const char* tpa_build_info(void);

/* ---------------------------------------------------------------- configuration and memory */

enum tpa_detect_mode {
  TPA_DETECT_COMPLETE = 0,   /* finds every pair of intersecting triangles, by a tree of boxes */
  TPA_DETECT_VERTEX_HASH = 1 /* section 3: finds pairs at vertices of one cell that no edges within the cell connect */
};

enum tpa_region {
  TPA_REGION_INSIDE = 0, /* triangles are counter-clockwise from outside the object: winding number 1 inside */
  TPA_REGION_OUTSIDE = 1 /* the object is outside; a closed surface winds inward round a void */
};

/* Limits decide the size of the block, and how large a call may grow; never the bits of a result (P6). 0 takes the
 * value in brackets, with V for max_vertices; default 0 unless stated. docs/limits.md tells how to choose. */
typedef struct tpa_config {
  uint32_t struct_size;   /* set by tpa_config_init */
  uint32_t cookie;        /* set by tpa_config_init; a config without it is refused */
  uint32_t max_vertices;  /* at any moment, also within a call. 4 .. 2^29. Default 65536 */
  uint32_t max_triangles; /* likewise [2 V + V / 16 + 64, but at most 2 V + 1024]. At most 2^30 + 1024 */
  uint32_t max_contacts; /* intersecting pairs at a time [V - 512, but at least V / 3 + 128 and at most V / 4 + 8192] */
  uint32_t max_cut_edges;  /* edges cut at a time (section 5, local refinement), at least 3 [V / 4 - 95, but at least
                              V / 6 + 80 and at most V / 8 + 4096 and V / 16 + 66560] */
  uint32_t max_events;     /* events of a commit [V / 16 + 16, but at most V / 128 + 256] */
  uint32_t max_components; /* connected components between calls [V / 32 + 1024, but at most V / 3 + 1] */
  uint32_t max_pieces;     /* triangles that an exact cut (docs/exact-cut.md) makes of faces in contact [with C for
                              max_contacts or its default, the larger: 4 C - 1100, but at least 2 C + 150 and at most
                              5 C / 4 + 8700] */
  uint32_t detect_mode; /* TPA_DETECT_... of tpa_detect; other calls detect completely. Default TPA_DETECT_COMPLETE */
  double cell_size;     /* l of equation (1) for TPA_DETECT_VERTEX_HASH: about an edge, a coordinate > 0. Default 1 */
  uint32_t region;      /* TPA_REGION_... Default TPA_REGION_INSIDE */
  uint32_t max_passes;  /* rounds at a contact, in the paper's way and of exact cuts. 1 .. 64. Default 8 */
  uint32_t max_candidates; /* handles or caps tested for each contact, the shortest first (section 5, step 6). 1 .. 256.
                              Default 64 */
  uint32_t smooth_iterations; /* rounds of (lambda, mu) after an event in the paper's way. 0 .. 1000. Default 4 */
  double smooth_lambda;       /* Taubin 1995: 2^-20 <= lambda <= 1. Default .6307 */
  double smooth_mu;           /* Taubin 1995: -1.5 <= mu < -lambda. Default -.6732 */
  uint32_t max_substeps; /* of a tpa_advance. 0, 1: a single one; else some 180 bytes more a vertex. At most 2^20 */
  uint32_t reserved;     /* 0 */
} tpa_config;

/* Fills struct_size bytes of *config with defaults. struct_size: the caller's sizeof(tpa_config).
 * TPA_E_ARGUMENT for NULL or a size that is no version's. O(1). */
TPA_API tpa_status tpa_config_init(tpa_config* config, size_t struct_size);

typedef struct tpa_arena_size {
  size_t bytes;     /* of the block for tpa_init with this config, at any address; a multiple of the alignment */
  size_t alignment; /* a power of two; byte copies of a block need addresses equal modulo it */
} tpa_arena_size;

/* Memory for a config. tpa_init uses the same layout routine, so the two cannot disagree.
 * TPA_E_CONFIG (issue.argument: position of the field), TPA_E_OVERFLOW. O(1). */
TPA_API tpa_status tpa_arena_query(const tpa_config* config, tpa_arena_size* size, tpa_issue* issue);

/* Makes a context in memory[0..size-1], at any address; *context receives the address of memory. The block stays the
 * caller's; there is nothing to destroy: free the block after the last call. TPA_E_ARENA names the bytes needed.
 * O(bytes of tpa_arena_query). */
TPA_API tpa_status tpa_init(void* memory, size_t size, const tpa_config* config, tpa_context** context,
                            tpa_issue* issue);

/* Forgets the mesh, targets, maps and events; keeps the config. O(V). */
TPA_API tpa_status tpa_reset(tpa_context* context);

typedef struct tpa_memory_table {
  const char* name; /* static storage */
  uint64_t bytes;   /* size within the block */
  uint64_t used;    /* elements in use now; contacts, cut edges and pieces within a call only */
  uint64_t peak;    /* most elements ever in use or wanted since tpa_init: as a limit, enough for the same calls */
  uint64_t limit;   /* of the config; of table "scratch" max_pieces */
} tpa_memory_table;

/* Lists the tables of the block, in address order, up to `capacity`; *count receives their number. tables may be NULL
 * if capacity is 0. O(tables). */
TPA_API tpa_status tpa_memory_stats(const tpa_context* context, tpa_memory_table* tables, uint32_t capacity,
                                    uint32_t* count);

/* ---------------------------------------------------------------- mesh in and out */

enum tpa_number_type { TPA_FLOAT32 = 1, TPA_FLOAT64 = 2, TPA_UINT16 = 3, TPA_UINT32 = 4 };

typedef struct tpa_mesh_input {
  uint32_t struct_size;
  uint32_t vertex_count;    /* 4 .. max_vertices */
  uint32_t triangle_count;  /* 4 .. max_triangles */
  uint32_t position_type;   /* TPA_FLOAT32 or TPA_FLOAT64 */
  uint32_t index_type;      /* TPA_UINT16 or TPA_UINT32 */
  uint32_t position_stride; /* bytes from a vertex to the next; 0: tightly packed */
  uint32_t triangle_stride; /* bytes from a triangle to the next; 0: tightly packed */
  const void* positions;    /* x y z of each vertex. Any alignment; read during the call only */
  const void* triangles;    /* three vertices, counter-clockwise from outside. Likewise */
} tpa_mesh_input;

/* Replaces the mesh by a copy of a closed, consistently oriented 2-manifold of any number of components, tangled or
 * not. Anything else is TPA_E_MESH with the first defect. TPA_E_LIMIT beyond the limits. Clears targets, maps and
 * events. Expected O(V). */
TPA_API tpa_status tpa_load(tpa_context* context, const tpa_mesh_input* mesh, tpa_issue* issue);

typedef struct tpa_mesh_view {
  uint32_t struct_size;
  uint32_t vertex_count;
  uint32_t triangle_count;
  uint32_t reserved;         /* 0 */
  uint64_t epoch;            /* grows with every commit; equal epochs mean equal ids */
  const double* positions;   /* 3 * vertex_count: x y z */
  const uint32_t* triangles; /* 3 * triangle_count: counter-clockwise from outside */
  const uint32_t* opposites; /* 3 * triangle_count: half-edge h = 3 * triangle + i runs from corner i to corner
                                (i + 1) % 3; opposites[h] is that of the other triangle */
} tpa_mesh_view;

/* The present mesh, without a copy. TPA_E_STATE without a mesh. O(1). */
TPA_API tpa_status tpa_view(const tpa_context* context, tpa_mesh_view* view);

typedef struct tpa_mesh_output {
  uint32_t struct_size;
  uint32_t vertex_capacity;
  uint32_t triangle_capacity;
  uint32_t position_type; /* as in tpa_mesh_input; float32 is rounded to nearest */
  uint32_t index_type;    /* TPA_UINT16 needs vertex_count <= 65536 */
  uint32_t position_stride;
  uint32_t triangle_stride;
  uint32_t vertex_count;   /* out: always written */
  uint32_t triangle_count; /* out: always written */
  uint32_t reserved;       /* 0 */
  void* positions;         /* or NULL */
  void* triangles;         /* or NULL */
} tpa_mesh_output;

/* Copies the mesh out. TPA_E_LIMIT for a capacity too small: only the counts are written then. O(V). */
TPA_API tpa_status tpa_export(const tpa_context* context, tpa_mesh_output* mesh, tpa_issue* issue);

typedef struct tpa_move_input {
  uint32_t struct_size;
  uint32_t count;           /* vertices to move */
  uint32_t position_type;   /* TPA_FLOAT32 or TPA_FLOAT64 */
  uint32_t position_stride; /* bytes; 0: tightly packed */
  const void* positions;    /* count targets, x y z */
  const uint32_t* vertices; /* count ids, the last of equal ids wins; NULL for 0 .. count-1 */
} tpa_move_input;

/* Sets targets for the next tpa_step or tpa_advance, beside those of earlier calls. Vertices without a target stay.
 * TPA_E_MESH names the first target or id at fault, and no target changes. O(count). */
TPA_API tpa_status tpa_move(tpa_context* context, const tpa_move_input* move, tpa_issue* issue);

/* ---------------------------------------------------------------- work */

enum tpa_exec_flags {
  /* At the end of the budget the call commits what is done, within the same budget, instead of failing: TPA_OK, and
   * report->unfinished is not 0. tpa_step and tpa_advance hold vertices back at contacts that were not reached, or all
   * vertices where the budget hardly holds the detection; tpa_adapt leaves such contacts unresolved; tpa_remesh and
   * tpa_smooth leave the rest to the next call, which goes on there. Where report->unfinished is 0, the bits are those
   * of a call without the flag. TPA_E_BUDGET remains for tpa_adapt before the contacts are known, and where the budget
   * does not hold a first look at the mesh (docs/realtime.md). */
  TPA_EXEC_KEEP = 1
};
/* Threads of the caller and a bound on the work; NULL for neither. Results have the same bits with and without.
 * parallel_for calls task(data, i) once for each i in 0 .. count-1, in any order, on any threads, and returns after the
 * last. Give each thread a run of indices, the same in every call (examples/pool.c). A task calls no public function.
 * Work counts in units of some 10 to 60 ns. Their number depends on config and calls alone, and is the same on every
 * platform; docs/realtime.md has bounds. */
typedef struct tpa_exec {
  uint32_t struct_size;
  uint32_t flags; /* of tpa_exec_flags; read by tpa_step, tpa_advance, tpa_adapt, tpa_remesh, tpa_smooth */
  void* user;
  void (*parallel_for)(void* user, uint32_t count, void (*task)(void* data, uint32_t index), void* data);
  /* NULL: serial */
  uint64_t budget;       /* units of work that the call may spend; more is TPA_E_BUDGET. 0: no bound */
  const int32_t* cancel; /* NULL, or a flag for any thread to set: nonzero ends the call with TPA_E_CANCELLED */
  uint64_t* progress;    /* NULL, or receives the units spent, now and then and at the end */
} tpa_exec;

typedef struct tpa_contact {
  uint32_t a, b; /* triangle ids, a < b */
} tpa_contact;

typedef struct tpa_contacts {
  uint32_t struct_size;
  uint32_t count;
  const tpa_contact* pairs; /* sorted by a, then b */
} tpa_contacts;

/* All pairs of triangles that meet anywhere but in a common vertex or edge (section 3), in the mode of the config.
 * Touching counts as meeting. TPA_E_LIMIT above max_contacts pairs, with issue.needed. Keeps the mesh, but uses scratch
 * memory of the context. Expected O(V + pairs). */
TPA_API tpa_status tpa_detect(tpa_context* context, const tpa_exec* exec, tpa_contacts* contacts, tpa_issue* issue);

typedef struct tpa_validation {
  uint32_t struct_size;
  uint32_t components;         /* connected components */
  uint64_t self_intersections; /* pairs of triangles, as tpa_detect finds them completely */
  int64_t euler;               /* V - E + F over all components */
  int64_t genus;               /* sum over all components */
  double volume;               /* enclosed, signed, rounded */
  double area;                 /* rounded */
} tpa_validation;

/* Checks the mesh from its triangles alone: closed, oriented, 2-manifold; counts self-intersections. TPA_E_MESH for
 * anything else. TPA_E_LIMIT above max_contacts pairs, with validation filled in. Keeps mesh, maps, events and targets,
 * but uses scratch memory. Expected O(V + pairs). */
TPA_API tpa_status tpa_validate(tpa_context* context, const tpa_exec* exec, tpa_validation* validation,
                                tpa_issue* issue);

/* The outcome of a call; fields of other calls are 0. The region is where the winding number of the moved mesh
 * (tpa_adapt: of the given mesh) is 1 or more. */
typedef struct tpa_report {
  uint32_t struct_size;
  uint32_t passes;                   /* rounds of detection and connection, of all islands together */
  uint32_t contacts;                 /* intersecting pairs at the start */
  uint32_t groups;                   /* groups of colliding clusters (section 5) or of cut faces */
  uint32_t handles[4];               /* made between 2, 3, 4, more polygons */
  uint32_t caps;                     /* polygons closed by a cap; two for each tunnel or handle cut */
  uint32_t removed_patches;          /* swallowed or inverted patches and components removed */
  uint32_t rolled_back_vertices;     /* tpa_step, tpa_advance: vertices of tpa_rolled_back */
  uint32_t unresolved;               /* tpa_adapt: intersecting pairs left */
  uint32_t splits, collapses, flips; /* tpa_remesh: of edges */
  uint32_t moved;                    /* tpa_smooth, tpa_remesh: vertices moved by smoothing */
  uint32_t vertices, triangles;      /* after the call */
  double approach; /* tpa_step, tpa_advance: a length; on the ways of a step, or sub-step, no two points
                      of the surface approached each other by more */
  double region_before, region_after; /* volumes of the region, and of what the result encloses */
  double region_lost, region_gained;  /* volumes by which the result falls short of the region, and exceeds it: sums
                                         over islands; estimates in the paper's way, else bounds (docs/exact-cut.md) */
  double region_reach;                /* a length; no such change lies farther from triangles in contact */
  uint32_t substeps;                  /* tpa_advance: sub-steps made */
  uint32_t unfinished;                /* TPA_EXEC_KEEP: islands, sweeps or rounds left when the budget ended; else 0 */
} tpa_report;

/* Moves vertices to their targets, to the bit but for the sign of zero; adapts the topology where the surface meets
 * itself (sections 2 and 5); checks and commits. Needs and leaves a mesh free of self-intersections (TPA_E_TANGLED:
 * call tpa_adapt once). Contacts count at the end of the move: see report->approach and tpa_advance. A contact of small
 * things is resolved in the paper's way, others by an exact cut (docs/exact-cut.md). An island of contacts changes at
 * most one per cent of the components that meet, unless one turns inside out. Vertices at contacts without such a
 * solution keep their old positions (tpa_rolled_back). TPA_E_LIMIT names the limit. Targets stay after a failure. exec
 * and report may be NULL. Expected O(V), after other steps O(vertices with targets + touched surface)
 * (docs/realtime.md). */
TPA_API tpa_status tpa_step(tpa_context* context, const tpa_exec* exec, tpa_report* report, tpa_issue* issue);

/* tpa_step in sub-steps: equal parts of all ways, as many as keep the approach of each below `thickness`, a length > 0.
 * Only parts thinner than that can pass each other unseen. All sub-steps are one commit. Vertices rolled back or
 * smoothed, and new ones with the ways of their parents, go on from where they are in the next sub-step. With a single
 * sub-step the bits are those of tpa_step. The report has sums, but the greatest approach and region_reach;
 * region_before is region_after with the sums taken back. epoch grows by the number of sub-steps. TPA_LIMIT_SUBSTEPS
 * names issue->needed sub-steps; another limit may fail the call once in each sub-step. Errors as for tpa_step. O(V)
 * and a tpa_step for each sub-step. */
TPA_API tpa_status tpa_advance(tpa_context* context, double thickness, const tpa_exec* exec, tpa_report* report,
                               tpa_issue* issue);

/* Resolves a tangled mesh by an exact cut (docs/exact-cut.md): the result bounds the region of winding number 1 or
 * more, to the rounding of its seams. Vertices away from contacts keep their bits. Parts that touch come apart by 2^-10
 * of an edge; surfaces that coincide but for rounding first move by some 2^-30 of the largest coordinate. Where
 * rounding makes ever more contacts, the components there stay as they were, and report->unresolved counts the pairs
 * (P2). Needs max_pieces of some 5 to 30 for each pair. Ignores and drops targets. Errors as for tpa_step, but never
 * TPA_E_TANGLED. Expected O(V + n log n) in the n pieces. */
TPA_API tpa_status tpa_adapt(tpa_context* context, const tpa_exec* exec, tpa_report* report, tpa_issue* issue);

typedef struct tpa_remesh_options {
  uint32_t struct_size;
  uint32_t iterations;   /* sweeps of split, collapse, flip, relax. 1 .. 100 */
  double target_length;  /* of edges; > 0, a coordinate. Not read if lengths are given */
  double split_ratio;    /* longer edges than split_ratio * target_length are split. 0: 4/3 (Botsch & Kobbelt 2004) */
  double collapse_ratio; /* shorter ones are collapsed, likewise. 0: 4/5. At most split_ratio / 1.5 */
  double relaxation;     /* tangential, of vertices touched in the call. 0 .. 1; 0: none */
  uint32_t count;        /* of vertices[] */
  uint32_t reserved;     /* 0 */
  const uint32_t* vertices; /* NULL for the whole mesh, or ids of a part: only edges within the part change, and new
                               vertices belong to it. Read during the call only */
  const float* lengths; /* NULL, or the target length at each vertex by id; an edge aims at the mean of its ends. Read
                           during the call only */
} tpa_remesh_options;

/* Splits long edges, collapses short ones, flips edges to even out angles, relaxes vertices (Botsch & Kobbelt 2004);
 * flips in place of splits where that makes a long edge short enough; collapses keep the volume (Lindstrom & Turk
 * 1998). Topology never changes. Needs and leaves a mesh free of self-intersections (TPA_E_TANGLED). TPA_E_MESH names
 * an unknown id, TPA_E_ARGUMENT the first vertex with a length out of range, TPA_E_LIMIT vertices or triangles; a
 * failure may drop targets. Expected O(V) in the first sweep, and O(changes) in later ones and in later calls with
 * equal lengths and ratios, without `lengths`. */
TPA_API tpa_status tpa_remesh(tpa_context* context, const tpa_remesh_options* options, const tpa_exec* exec,
                              tpa_report* report, tpa_issue* issue);

typedef struct tpa_smooth_options {
  uint32_t struct_size;
  uint32_t iterations;      /* rounds of (lambda, mu). 0 .. 1000 */
  uint32_t count;           /* of vertices[] */
  uint32_t reserved;        /* 0 */
  const uint32_t* vertices; /* ids to smooth, or NULL for all */
} tpa_smooth_options;

/* Taubin smoothing (Taubin 1995) with the factors of the config. Vertices stay where a move would make an intersection,
 * components where it might turn them inside out. Keeps ids. Needs and leaves a mesh free of self-intersections
 * (TPA_E_TANGLED). TPA_E_MESH names an unknown id. A failure may drop targets. Expected O(V) for each round. */
TPA_API tpa_status tpa_smooth(tpa_context* context, const tpa_smooth_options* options, const tpa_exec* exec,
                              tpa_report* report, tpa_issue* issue);

/* Renumbers vertices along a curve through space (Morton 1966), and triangles by their least vertex, so that near ones
 * lie near in memory: a commit of new numbers alone. A second call changes nothing. Drops targets. Where operations
 * have scattered a mesh larger than the caches, tpa_step and tpa_remesh take half the time afterwards
 * (docs/performance.md). The next tpa_remesh looks at all triangles. TPA_E_STATE without a mesh. O(V). */
TPA_API tpa_status tpa_reorder(tpa_context* context, tpa_issue* issue);

/* ---------------------------------------------------------------- results of the last commit */

enum tpa_event_type {
  TPA_EVENT_HANDLE = 1,     /* `amount` polygons were joined by a handle (section 4) */
  TPA_EVENT_CAP = 2,        /* `amount` polygons were capped (nested objects, section 5) */
  TPA_EVENT_REMOVAL = 3,    /* `amount` vertices of swallowed or inverted parts were removed */
  TPA_EVENT_ROLLBACK = 4,   /* `amount` vertices kept their old positions (tpa_rolled_back) */
  TPA_EVENT_MERGE = 5,      /* `amount` components, `before` among them, became `after` */
  TPA_EVENT_SPLIT = 6,      /* `before` came apart; `after` is one of `amount` pieces, each with an event, by id */
  TPA_EVENT_GENUS_UP = 7,   /* the sum of the genera of all components related to `after` grew by `amount` */
  TPA_EVENT_GENUS_DOWN = 8, /* it fell by `amount` */
  TPA_EVENT_DEATH = 10      /* `before` is gone */
};

/* A component is named by its smallest vertex id. Components before and after that share vertices, or parents of
 * vertices, are related; `before` and `after` name the smallest related ones. */
typedef struct tpa_event {
  int32_t type; /* TPA_EVENT_... */
  uint32_t amount;
  uint32_t before;    /* component id before the commit, or TPA_NONE */
  uint32_t after;     /* component id after the commit, or TPA_NONE */
  double position[3]; /* HANDLE, CAP: mean of the polygons' vertices; ROLLBACK: the first place; else zeros */
} tpa_event;

/* The events of the last commit: types 1 to 3 in the order of the work, type 4 (in each sub-step), then those of
 * components by id. O(1). */
TPA_API tpa_status tpa_events(const tpa_context* context, const tpa_event** events, uint32_t* count);

typedef struct tpa_component {
  uint32_t id;     /* the smallest vertex id, as in tpa_event */
  uint32_t before; /* the smallest related component before the last commit, in ids of that time */
  uint32_t vertices, triangles;
  int32_t genus;
  uint32_t reserved; /* 0 */
  double volume;     /* enclosed, negative where triangles wind inward; rounded by the component's size */
  double area;       /* likewise */
  double box[6];     /* least x y z, greatest x y z; exact */
} tpa_component;

/* The connected components, ascending by id. *count receives their number in any case; components may be NULL if
 * capacity is 0. labels may be NULL, or receives the index in components[] for each vertex. TPA_E_LIMIT for a capacity
 * too small; TPA_E_STATE without a mesh. O(V), O(1) for *count alone. */
TPA_API tpa_status tpa_components(const tpa_context* context, tpa_component* components, uint32_t capacity,
                                  uint32_t* labels, uint32_t* count, tpa_issue* issue);

/* The vertices that the last tpa_step, or any sub-step of the last tpa_advance, held back from their targets: new ids,
 * ascending. They are at their old positions, but for a small part of an edge where a cut has parted surfaces. O(1). */
TPA_API tpa_status tpa_rolled_back(const tpa_context* context, const uint32_t** vertices, uint32_t* count);

/* The origin of a vertex, in ids before the commit. An old vertex has parents {id, TPA_NONE} and weight 1. A new vertex
 * lies near weight * parents[0] + (1 - weight) * parents[1], at their targets in a step: no farther than the longer of
 * its longest edge and the parents' distance. Equal parents of weight 0 mean an unknown origin. */
typedef struct tpa_vertex_origin {
  uint32_t parents[2];
  float weight; /* of parents[0]; 0 .. 1 */
} tpa_vertex_origin;

typedef struct tpa_vertex_map_view {
  uint32_t struct_size;
  uint32_t old_count;               /* vertices before the last commit */
  uint32_t new_count;               /* vertices after */
  uint32_t reserved;                /* 0 */
  const uint32_t* old_to_new;       /* old_count ids; TPA_NONE for a removed vertex */
  const tpa_vertex_origin* origins; /* new_count */
} tpa_vertex_map_view;

/* How the last commit renumbered, removed and made vertices; the identity after tpa_load. TPA_E_STATE without a mesh.
 * O(1). */
TPA_API tpa_status tpa_vertex_map(const tpa_context* context, tpa_vertex_map_view* map);

typedef struct tpa_triangle_map_view {
  uint32_t struct_size;
  uint32_t old_count;
  uint32_t new_count;
  uint32_t reserved;       /* 0 */
  const uint32_t* origins; /* new_count ids before the commit, of which the triangles are all or a part; TPA_NONE for
                              handles and caps */
} tpa_triangle_map_view;

/* How the last commit made triangles; the identity after tpa_load. TPA_E_STATE without a mesh. O(1). */
TPA_API tpa_status tpa_triangle_map(const tpa_context* context, tpa_triangle_map_view* map);

typedef struct tpa_range {
  uint32_t first, count;
} tpa_range;

typedef struct tpa_change_list {
  uint32_t struct_size;
  uint32_t gap;                                  /* ranges with at most so many unchanged elements between them join */
  uint32_t vertex_capacity;                      /* of vertices[], or 0 */
  uint32_t triangle_capacity;                    /* of triangles[], or 0 */
  tpa_range* vertices;                           /* receives ranges of vertex ids, ascending */
  tpa_range* triangles;                          /* receives ranges of triangle ids, ascending */
  uint32_t vertex_ranges, triangle_ranges;       /* out: ranges written */
  uint32_t changed_vertices, changed_triangles;  /* out: without gaps */
  uint32_t old_vertex_count, old_triangle_count; /* out: before the last commit */
  uint32_t vertex_count, triangle_count;         /* out: after */
} tpa_change_list;

/* Ranges of tpa_view to copy into arrays that hold the mesh before the last commit: vertices with other position bits,
 * triangles with other corners, new ids. After tpa_load and tpa_restore all have changed. gap doubles until the ranges
 * fit. TPA_E_STATE without a mesh. O(changes) for each gap. */
TPA_API tpa_status tpa_changes(const tpa_context* context, tpa_change_list* changes, tpa_issue* issue);

/* Carries `width` values of each vertex through the last commit, from before[] in old ids to after[] in new ids; the
 * arrays must not overlap. A vertex takes the weighted mean of its parents, summed in double precision, or the bits of
 * its only parent. TPA_E_ARGUMENT for NULL or 0 values, TPA_E_STATE without a mesh. O(V * width). */
TPA_API tpa_status tpa_carry_vertices(const tpa_context* context, const float* before, uint32_t width, float* after);

/* The same in double precision. */
TPA_API tpa_status tpa_carry_vertices_f64(const tpa_context* context, const double* before, uint32_t width,
                                          double* after);

/* The same for triangles, which take the bits of their origins. A triangle without one takes those of the nearest
 * triangle across edges that has one; zeros where a component has none. O(V * width), and O(V) for each ring of such
 * triangles. */
TPA_API tpa_status tpa_carry_triangles(const tpa_context* context, const float* before, uint32_t width, float* after);

/* ---------------------------------------------------------------- state */

/* Makes a context in memory[0..size-1] with the state of `context` and another config, whose limits may be higher or
 * lower: after TPA_E_LIMIT raise the limit, grow, call again. Later calls give the bits that they would have given with
 * this config from the start. `context` stays, and may
 * be freed. Errors as for tpa_init; TPA_E_LIMIT if the state does not fit, TPA_E_ARGUMENT if the blocks overlap. A
 * failure leaves memory undefined. O(V), as the next step. */
TPA_API tpa_status tpa_grow(const tpa_context* context, void* memory, size_t size, const tpa_config* config,
                            tpa_context** bigger, tpa_issue* issue);

/* Writes mesh, targets, maps, events, held-back vertices, epoch and the fields of the config that decide results to
 * data[0..capacity-1]: the same bytes on every platform, some 44 a vertex and 16 a triangle. *size receives their
 * number; data may be NULL if capacity is 0. TPA_E_ARENA for a capacity too small, and data stays. O(V). */
TPA_API tpa_status tpa_save(const tpa_context* context, void* data, size_t capacity, size_t* size, tpa_issue* issue);

/* Replaces the state of a context by a saved state of any platform. All is checked first: data of any content leave a
 * sound context. TPA_E_DATA for bytes that tpa_save has not written; TPA_E_CONFIG for other values of detect_mode,
 * cell_size, region, max_passes, max_candidates, smooth_...; TPA_E_LIMIT names the limit. data may have any alignment,
 * and is read during the call only. Expected O(V). */
TPA_API tpa_status tpa_restore(tpa_context* context, const void* data, size_t size, tpa_issue* issue);

/* The hash (XXH64) of the bytes of tpa_save, without the hash in their last 8: equal states have equal digests, on
 * every platform and for all limits. O(V). */
TPA_API tpa_status tpa_digest(const tpa_context* context, uint64_t* digest);

/* The config of tpa_init or tpa_grow. O(1). */
TPA_API tpa_status tpa_config_of(const tpa_context* context, tpa_config* config);

/* The targets set since the last commit: the first `capacity` by ascending id, with x y z of each. *count receives the
 * number of all. vertices and positions may be NULL. O(count). */
TPA_API tpa_status tpa_targets(const tpa_context* context, uint32_t* vertices, double* positions, uint32_t capacity,
                               uint32_t* count);

/* Drops all targets. O(count). */
TPA_API tpa_status tpa_drop_targets(tpa_context* context);

/* ---------------------------------------------------------------- the handle database (section 4) */

#define TPA_HANDLE_MAX_POLYGONS 4
#define TPA_HANDLE_MIN_SIDES 3
#define TPA_HANDLE_MAX_SIDES 15
/* Most faces of a handle of the database. */
#define TPA_HANDLE_MAX_FACES 64

typedef struct tpa_handle_info {
  uint32_t struct_size;
  uint32_t generators; /* stored, modulo rotations of each polygon and exchanges of equal ones (section 4.2) */
  uint64_t handles;    /* distinct, of all generators */
  uint32_t faces;      /* of each handle: sum of sides + 2 * polygons - 4 */
  uint32_t complete;   /* 1: all handles of least sum of squared vertex degrees; 0: the 32 most even generators
                          (docs/handles.md) */
} tpa_handle_info;

/* The database's handles for `polygons` (2 .. 4) closed polygons of 3 .. 15 sides each, in any order; none for four in
 * a build without these (docs/porting.md). Pure: needs no context. TPA_E_ARGUMENT outside these ranges. */
TPA_API tpa_status tpa_handle_describe(uint32_t polygons, const uint32_t* sides, tpa_handle_info* info);

/* The handle `index` (0 .. handles-1), as 3 vertices for each face; vertices are numbered through all polygons from 0.
 * The handle has the directed edges (i, i + 1) of each polygon: list a hole with the new faces on the left. capacity:
 * of faces, in numbers; 3 * TPA_HANDLE_MAX_FACES is enough. Pure. TPA_E_ARGUMENT outside the ranges or capacity; faces
 * stays then. */
TPA_API tpa_status tpa_handle_get(uint32_t polygons, const uint32_t* sides, uint64_t index, uint32_t* faces,
                                  uint32_t capacity);

/* The same for generator `generator` (0 .. generators-1). *orbit receives the number of its distinct handles; may be
 * NULL. Pure. */
TPA_API tpa_status tpa_handle_generator(uint32_t polygons, const uint32_t* sides, uint32_t generator, uint32_t* faces,
                                        uint32_t capacity, uint64_t* orbit);

#ifdef __cplusplus
}
#endif

#endif /* TOPOADAPT_H */
