/* topoadapt: topology changes of moving triangle meshes, in fixed memory.
 *
 * A closed triangle mesh is deformed by something else (an active contour, a fluid, a sculpting tool, a game).
 * Where it runs into itself, topoadapt merges, splits, opens handles and frees nested objects, and leaves a mesh
 * that is closed, consistently oriented, 2-manifold and free of self-intersections, judged with exact predicates.
 * The method is that of "A robust and efficient method for topology adaptations in deformable models"; the sections
 * cited below are its sections. docs/architecture.md tells how the source carries it out.
 *
 * The common case, after tpa_config_init, tpa_arena_query and tpa_init:
 *
 *     tpa_load(ctx, &mesh, &issue);                     once
 *     tpa_move(ctx, &targets, &issue);                  each step: where the vertices want to go
 *     tpa_step(ctx, NULL, &report, &issue);             each step: move, detect, adapt, check, commit
 *
 * RULES FOR ALL FUNCTIONS
 * Memory     The library never allocates. A context lives in one block that the caller hands over and frees. The
 *            context holds offsets, never pointers: a byte copy of the block, to an address of the same alignment,
 *            is a legal snapshot that can be used in its place.
 * Threads    Contexts are independent; there is no global state. A context may be used by one writer (functions
 *            that take a non-const context), or by many readers, at a time.
 * Errors     A function that can fail returns a tpa_status: TPA_OK or one of the negative TPA_E_ values. It never
 *            asserts, aborts or throws. After a failure the mesh, maps and events are bit for bit what they were.
 *            `issue`, where it is not NULL, receives what the failure knows: element, limit, size needed. It is
 *            also written on success (with status TPA_OK and zeros).
 * Versions   Structures that may grow start with `struct_size`, which the caller sets to the size that it was
 *            compiled with (tpa_config_init does so for tpa_config). Status and event numbers never change.
 * Determinism  Equal calls on equal states give equal bits, on every platform, compiler, optimisation level and
 *            thread count.
 * Coordinates  IEEE doubles, finite, and each either zero or of magnitude within [2^-100, 2^100]: in that range
 *            the predicates are exact. The unit is the caller's.
 * Orientation  Triangles are counter-clockwise seen from outside (see tpa_config.region).
 * Ids        Vertices are 0 .. vertex_count-1, triangles 0 .. triangle_count-1, without holes. A commit (a
 *            successful tpa_adapt, tpa_step, tpa_remesh, tpa_smooth) discards targets and replaces maps and events.
 *            All but tpa_smooth may renumber; tpa_vertex_map and tpa_triangle_map tell how.
 * Spans      A pointer handed out stays valid until the next call with a non-const context.
 */
#ifndef TOPOADAPT_H
#define TOPOADAPT_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#ifndef TPA_API
#if defined(_WIN32) && defined(TPA_SHARED)
#ifdef TPA_BUILD
#define TPA_API __declspec(dllexport)
#else
#define TPA_API __declspec(dllimport)
#endif
#elif defined(__GNUC__)
#define TPA_API __attribute__((visibility("default")))
#else
#define TPA_API
#endif
#endif

#define TPA_VERSION_MAJOR 0
#define TPA_VERSION_MINOR 1
#define TPA_VERSION_PATCH 0

/* "No such element", wherever an id is expected or returned. */
#define TPA_NONE UINT32_C(0xFFFFFFFF)

typedef struct tpa_context tpa_context;

/* ---------------------------------------------------------------- statuses and issues */

typedef int32_t tpa_status;
enum {
  TPA_OK = 0,
  TPA_E_ARGUMENT = -1, /* a NULL where none is allowed, a struct_size unknown to this version, a value out of range */
  TPA_E_CONFIG = -2,   /* the config was not filled by tpa_config_init, or holds a value out of range */
  TPA_E_OVERFLOW = -3, /* a size does not fit the address space */
  TPA_E_ARENA = -4,    /* the block is too small (issue.needed: bytes) or misaligned (issue.needed: alignment) */
  TPA_E_CONTEXT = -5,  /* not a context of this version and build */
  TPA_E_STATE = -6,    /* no mesh is loaded */
  TPA_E_LIMIT = -7,    /* a limit of the config is reached: issue.limit names it, issue.needed says how much */
  TPA_E_MESH = -8,     /* the mesh is not what tpa_load accepts: issue.defect and issue.element say what and where */
  TPA_E_TANGLED = -9   /* the call needs a mesh free of self-intersections; issue.element and .other name a pair of
                          triangles (zeros where there are more than max_contacts), issue.needed counts the pairs */
};

/* What is wrong with a mesh. The first defect found is reported, in the order of this list. */
enum {
  TPA_DEFECT_NONE = 0,
  TPA_DEFECT_NOT_FINITE = 1,      /* vertex `element` has a NaN or infinite coordinate */
  TPA_DEFECT_MAGNITUDE = 2,       /* vertex `element` has a coordinate outside the exact range */
  TPA_DEFECT_INDEX_RANGE = 3,     /* triangle `element` uses vertex `other`, which does not exist */
  TPA_DEFECT_REPEATED_VERTEX = 4, /* triangle `element` uses vertex `other` twice */
  TPA_DEFECT_ORIENTATION = 5, /* edge of vertices `element`, `other`: two triangles run through it in one direction */
  TPA_DEFECT_NON_MANIFOLD_EDGE = 6,   /* edge of vertices `element`, `other` has more than two triangles */
  TPA_DEFECT_BOUNDARY_EDGE = 7,       /* edge of vertices `element`, `other` has one triangle only */
  TPA_DEFECT_NON_MANIFOLD_VERTEX = 8, /* the triangles at vertex `element` form more than one fan */
  TPA_DEFECT_ISOLATED_VERTEX = 9      /* vertex `element` belongs to no triangle */
};

/* The limits of tpa_config, for tpa_issue.limit and tpa_memory_stats. */
enum {
  TPA_LIMIT_NONE = 0,
  TPA_LIMIT_VERTICES = 1,  /* tpa_config.max_vertices */
  TPA_LIMIT_TRIANGLES = 2, /* tpa_config.max_triangles */
  TPA_LIMIT_CONTACTS = 3,  /* tpa_config.max_contacts */
  TPA_LIMIT_CUT = 4,       /* tpa_config.max_cut_edges */
  TPA_LIMIT_EVENTS = 5,    /* tpa_config.max_events */
  TPA_LIMIT_COMPONENTS = 6 /* tpa_config.max_components */
};

typedef struct tpa_issue {
  tpa_status status;
  int32_t defect;     /* TPA_DEFECT_... with TPA_E_MESH, else 0 */
  int32_t limit;      /* TPA_LIMIT_... with TPA_E_LIMIT, else 0 */
  int32_t argument;   /* with TPA_E_ARGUMENT and TPA_E_CONFIG: 1-based position of the argument or config field */
  uint64_t element;   /* id of the element at fault, or 0 */
  uint64_t other;     /* second id, or 0 */
  uint64_t needed;    /* what would have been enough (bytes, elements), or 0. Of vertices and triangles, where they run
                         out amid the work: what was wanted at that point; more may be wanted after it */
  uint64_t available; /* what there was, or 0 */
} tpa_issue;

/* English name of a status, never NULL, also for numbers that are not statuses. Static storage. O(1). */
TPA_API const char* tpa_status_string(tpa_status status);

/* Writes one line of English about the issue into text[0..size-1], always terminated when size > 0, cut where it
 * does not fit. Returns the length of the whole line without the terminator. issue must not be NULL (returns 0). */
TPA_API size_t tpa_issue_text(const tpa_issue* issue, char* text, size_t size);

/* Version of the library that is linked: major << 16 | minor << 8 | patch. */
TPA_API uint32_t tpa_version(void);

/* One line about how the library was built (version, compiler). Static storage, never NULL. */
TPA_API const char* tpa_build_info(void);

/* ---------------------------------------------------------------- configuration and memory */

enum {
  TPA_DETECT_COMPLETE = 0,   /* finds every pair of intersecting triangles */
  TPA_DETECT_VERTEX_HASH = 1 /* section 3 to the letter: misses pairs whose triangles share no cell through a vertex */
};

enum {
  TPA_REGION_INSIDE = 0, /* the triangles wind outward round the object: kept is what has winding number 0 outside */
  TPA_REGION_OUTSIDE = 1 /* the mesh bounds the outside of the object: a closed surface winds inward round the void */
};

typedef struct tpa_config {
  uint32_t struct_size;    /* set by tpa_config_init */
  uint32_t cookie;         /* set by tpa_config_init; a config without it is refused */
  uint32_t max_vertices;   /* at any moment, also within a call. 4 .. 2^29. Default 65536 */
  uint32_t max_triangles;  /* 0: 2 * max_vertices + 1024, enough for genus up to 256. Default 0 */
  uint32_t max_contacts;   /* intersecting pairs that one pass can hold. 0: max_vertices / 2 + 1024, but at most
                              max_vertices / 4 + 8192. Default 0 */
  uint32_t max_cut_edges;  /* edges that one pass can cut (section 5, local refinement). 0: max_vertices / 4 + 1024, but
                              at most max_vertices / 8 + 4096 and max_vertices / 16 + 66560. The polygons that one
                              handle joins, or of one piece that is capped, have at most a fourth of it and 512
                              vertices together, or all of it where that is less; where a piece wants more, the call
                              fails and names this limit. Default 0 */
  uint32_t max_events;     /* events of one commit. 0: max_vertices / 128 + 256. Default 0 */
  uint32_t max_components; /* connected components of the mesh between calls. 0: max_vertices / 32 + 1024, but at most
                              max_vertices / 3 + 1, which is as many as there can be. Default 0 */
  uint32_t detect_mode; /* TPA_DETECT_... for tpa_detect. tpa_step and tpa_adapt always use TPA_DETECT_COMPLETE, since
                           their promise needs it. Default TPA_DETECT_COMPLETE */
  double cell_size;     /* l of equation (1) for TPA_DETECT_VERTEX_HASH, in the unit of the coordinates; > 0.
                           Default 1, a voxel (section 3). Complete detection derives its own from the triangles */
  uint32_t region;      /* TPA_REGION_... Default TPA_REGION_INSIDE */
  uint32_t max_passes;  /* detect-and-connect rounds for each component that is united with those before it; the first
                           are united at once. 1 .. 64. Default 8 */
  uint32_t max_candidates;    /* handles tested per contact, in order of edge length (section 5, step 6), before its
                                 polygons are joined triangle by triangle, capped, or rolled back; between two
                                 polygons, and of caps, the best as it is and then so many of free triangles. Between
                                 parts that meet a step first takes the shortest without a test, and tests only where
                                 its triangles meet something even when smoothed. 1 .. 256. Default 64 */
  uint32_t smooth_iterations; /* Taubin smoothing after an event: rounds of (lambda, mu). 0 .. 1000. Default 4 */
  double smooth_lambda;       /* Taubin 1995: 0 < lambda <= 1. Default .6307 */
  double smooth_mu;           /* Taubin 1995: -1.5 <= mu < -lambda, so that the pass band 1/lambda + 1/mu is positive.
                                 Default -.6732 */
} tpa_config;

/* Fills *config with defaults. struct_size is sizeof(tpa_config) as the caller knows it.
 * TPA_E_ARGUMENT for NULL or an unknown size. O(1). */
TPA_API tpa_status tpa_config_init(tpa_config* config, size_t struct_size);

typedef struct tpa_arena_size {
  size_t bytes;     /* size of the block that tpa_init needs for this config */
  size_t alignment; /* and its alignment, a power of two */
} tpa_arena_size;

/* How much memory a config needs. The same layout routine serves tpa_init, so the two cannot disagree.
 * TPA_E_CONFIG (issue.argument: position of the field), TPA_E_OVERFLOW. O(1). */
TPA_API tpa_status tpa_arena_query(const tpa_config* config, tpa_arena_size* size, tpa_issue* issue);

/* Makes a context in memory[0..size-1]. The block stays the caller's; there is nothing to destroy: free the block
 * when the context is not needed any more. TPA_E_ARENA names the bytes or the alignment needed. Cost: O(size).
 * On a system with large pages (Linux: madvise with MADV_HUGEPAGE) a block of some ten megabytes or more had better lie
 * on these: steps look at few places of many arrays. */
TPA_API tpa_status tpa_init(void* memory, size_t size, const tpa_config* config, tpa_context** context,
                            tpa_issue* issue);

/* Forgets the mesh, targets, maps and events; keeps the config. O(V). */
TPA_API tpa_status tpa_reset(tpa_context* context);

typedef struct tpa_memory_region {
  const char* name; /* static storage */
  uint64_t bytes;   /* size within the block */
  uint64_t used;    /* elements in use now */
  uint64_t peak;    /* most elements ever in use since tpa_init */
  uint64_t limit;   /* elements that fit */
} tpa_memory_region;

/* The regions of the block, in address order. *count receives their number, also where capacity (the length of
 * regions[], which may be NULL if 0) is smaller. O(regions). */
TPA_API tpa_status tpa_memory_stats(const tpa_context* context, tpa_memory_region* regions, uint32_t capacity,
                                    uint32_t* count);

/* ---------------------------------------------------------------- mesh in and out */

enum { TPA_FLOAT32 = 1, TPA_FLOAT64 = 2, TPA_UINT16 = 3, TPA_UINT32 = 4 };

typedef struct tpa_mesh_input {
  uint32_t struct_size;
  uint32_t vertex_count;    /* 4 .. max_vertices */
  uint32_t triangle_count;  /* 4 .. max_triangles */
  uint32_t position_type;   /* TPA_FLOAT32 or TPA_FLOAT64 */
  uint32_t index_type;      /* TPA_UINT16 or TPA_UINT32 */
  uint32_t position_stride; /* bytes from one vertex to the next; 0: tightly packed x y z */
  uint32_t triangle_stride; /* bytes from one triangle to the next; 0: tightly packed, three indices */
  const void* positions;    /* any alignment; read during the call only */
  const void* triangles;    /* any alignment; read during the call only */
} tpa_mesh_input;

/* Replaces the mesh by a copy of the given one. Accepted is any closed, consistently oriented 2-manifold, in any
 * number of components, tangled or not: each edge has exactly two triangles, which run through it in opposite
 * directions, and the triangles at each vertex form one fan. Everything else is TPA_E_MESH with the first defect.
 * TPA_E_LIMIT where it is larger than the config allows. Maps and events are cleared. Expected O(V). */
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
                                (i + 1) % 3; opposites[h] is the half-edge that runs the other way */
} tpa_mesh_view;

/* The mesh as it is, without a copy. Set view->struct_size first. O(1). */
TPA_API tpa_status tpa_view(const tpa_context* context, tpa_mesh_view* view);

typedef struct tpa_mesh_output {
  uint32_t struct_size;
  uint32_t vertex_capacity;   /* vertices that fit into positions */
  uint32_t triangle_capacity; /* triangles that fit into triangles */
  uint32_t position_type;     /* as in tpa_mesh_input; float32 is rounded to nearest */
  uint32_t index_type;        /* TPA_UINT16 needs vertex_count <= 65536 */
  uint32_t position_stride;
  uint32_t triangle_stride;
  uint32_t vertex_count;   /* out: always written */
  uint32_t triangle_count; /* out: always written */
  uint32_t reserved;       /* 0 */
  void* positions;         /* NULL if only the counts or triangles are wanted */
  void* triangles;         /* NULL if only the counts or positions are wanted */
} tpa_mesh_output;

/* Copies the mesh out. Writes the counts always; TPA_E_LIMIT, and no element, where a capacity is too small. O(V). */
TPA_API tpa_status tpa_export(const tpa_context* context, tpa_mesh_output* mesh, tpa_issue* issue);

typedef struct tpa_validation {
  uint32_t struct_size;
  uint32_t components;         /* connected components */
  uint64_t self_intersections; /* pairs of triangles that meet outside what they share; exact */
  int64_t euler;               /* V - E + F over all components */
  int64_t genus;               /* sum of the components' genera */
  double volume;               /* enclosed, signed, as computed in double precision */
  double area;
} tpa_validation;

/* Checks the whole mesh from its triangles alone, trusting no derived structure: closed, oriented, 2-manifold, and
 * counts self-intersections by complete detection. TPA_E_MESH if it is no closed manifold (which no function of this
 * library makes it). TPA_E_LIMIT (contacts) where there are more pairs than max_contacts; validation is then still
 * filled but for self_intersections, which is what was found. Expected O(V). */
struct tpa_exec;
TPA_API tpa_status tpa_validate(tpa_context* context, const struct tpa_exec* exec, tpa_validation* validation,
                                tpa_issue* issue);

typedef struct tpa_move_input {
  uint32_t struct_size;
  uint32_t count;           /* vertices to move */
  uint32_t position_type;   /* TPA_FLOAT32 or TPA_FLOAT64 */
  uint32_t position_stride; /* bytes; 0: tightly packed */
  const void* positions;    /* count targets */
  const uint32_t* vertices; /* their ids, each at most once meant (the last wins), or NULL for 0 .. count-1 */
} tpa_move_input;

/* Sets targets for the next tpa_step. Vertices without a target stay. A later call adds to, or overwrites, an earlier
 * one; any commit and tpa_load discard targets. TPA_E_MESH names the first vertex whose target is not finite or out
 * of range, or whose id does not exist; then no target is changed. O(count). */
TPA_API tpa_status tpa_move(tpa_context* context, const tpa_move_input* move, tpa_issue* issue);

/* ---------------------------------------------------------------- work */

/* The caller's threads. parallel_for must call task(data, i) once for each i in 0 .. count-1, in any order, on any
 * threads, and return when all have returned. NULL instead of a tpa_exec means serial. The results have the same
 * bits whatever it does. Tasks with indices near each other work on memory near each other, in one call and the next:
 * threads with a run of indices each, the same share every time, are quicker than those that take turns. The task never
 * calls back into the library's public functions. */
typedef struct tpa_exec {
  uint32_t struct_size;
  uint32_t reserved; /* 0 */
  void* user;
  void (*parallel_for)(void* user, uint32_t count, void (*task)(void* data, uint32_t index), void* data);
} tpa_exec;

typedef struct tpa_contact {
  uint32_t a, b; /* triangle ids, a < b */
} tpa_contact;

typedef struct tpa_contacts {
  uint32_t struct_size;
  uint32_t count;
  const tpa_contact* pairs; /* sorted by a, then b */
} tpa_contacts;

/* All pairs of triangles that meet anywhere but in the vertex or edge that they share (section 3; mode from the
 * config). Touching counts as meeting. TPA_E_LIMIT where there are more than max_contacts, with their number in
 * issue.needed (an upper bound of it with TPA_DETECT_VERTEX_HASH, which comes upon a pair more than once).
 * Expected O(V + pairs). */
TPA_API tpa_status tpa_detect(tpa_context* context, const tpa_exec* exec, tpa_contacts* contacts, tpa_issue* issue);

typedef struct tpa_report {
  uint32_t struct_size;
  uint32_t passes;                   /* detect-and-connect rounds, of all components together */
  uint32_t contacts;                 /* intersecting pairs that the first pass set out to resolve */
  uint32_t groups;                   /* contact groups treated */
  uint32_t handles[4];               /* handles inserted that join 2, 3, 4, more polygons */
  uint32_t caps;                     /* polygons closed by a cap */
  uint32_t removed_patches;          /* swallowed or inverted patches and components removed */
  uint32_t rolled_back_vertices;     /* tpa_step: vertices that stayed where they were; tpa_rolled_back lists them */
  uint32_t unresolved;               /* tpa_adapt: intersecting pairs left; tpa_detect lists them */
  uint32_t splits, collapses, flips; /* tpa_remesh: edges split, collapsed, flipped */
  uint32_t moved;                    /* tpa_smooth, tpa_remesh: vertices moved by smoothing */
  uint32_t vertices, triangles;      /* counts after the call */
  double approach; /* tpa_step: a length, >= 0. No two points of the surface came nearer to each other by
                      more than that on their ways to the targets */
} tpa_report;

/* One step of an evolution (sections 2 and 5): moves the vertices to their targets, detects, adapts the topology,
 * checks, commits. Afterwards the mesh is closed, oriented, 2-manifold and free of self-intersections. Where a contact
 * can be resolved in no permitted way, the vertices around it keep their old positions and are reported. Needs a mesh
 * that is free of self-intersections before (TPA_E_TANGLED: use tpa_adapt once). TPA_E_LIMIT names the limit to raise.
 * A component that the step makes or turns inside out and that then bounds nothing, or a void that is left of a body,
 * is removed (TPA_EVENT_REMOVAL, and TPA_EVENT_DEATH if it had been there). Triangles in contact are halved first where
 * all of a small or coarse component is in contact, or where more than a third of what is seen of it would be cut out,
 * as far as the limits of vertices, triangles, cut edges and contacts allow. Where a contact was cut out, vertices that
 * stay move by about half an edge. Few contacts want new vertices; edges that are cut in the middle are joined again to
 * about the lengths that they had. Contacts are looked for at the
 * end of the step: parts that pass through each other on the way and touch nothing there are not noticed. Parts that
 * are thicker than report->approach where they would meet cannot have done so; where some may be thinner, cut the step
 * into several.
 * Targets are kept on failure and discarded on success. exec and report may be NULL (report->struct_size set first).
 * Cost: expected O(V) to detect, or O(vertices with targets) where these are few and the last calls were steps too. To
 * adapt, O(size of the touched regions), and for each loop of cut edges and each void O(triangles that a ray from it
 * along x passes); O(V) more where a component is removed, or a contact cannot be resolved as the paper does. */
TPA_API tpa_status tpa_step(tpa_context* context, const tpa_exec* exec, tpa_report* report, tpa_issue* issue);

/* Resolves a mesh that is tangled already: the result is the boundary of the region of winding number >= 1 as far as
 * it can be resolved, at the scale of the triangles in contact; report->unresolved counts the intersecting pairs that
 * are left. Components that bound nothing, since they lie inside others or are inside out, are removed. Of components
 * that lie upon each other the larger stays. Triangles that others come through are cut half way to them; they are
 * halved where vertices of the boundary would go all the same, as far as the limits of vertices, triangles, cut edges
 * and contacts allow: give them room, twice the mesh or more, for heavy tangles. The mesh stays a closed oriented
 * 2-manifold always. Positions far from contacts keep their bits. A piece with more than 256 polygons gets caps only.
 * Cost as tpa_step, and for each component in contact with others its size. */
TPA_API tpa_status tpa_adapt(tpa_context* context, const tpa_exec* exec, tpa_report* report, tpa_issue* issue);

typedef struct tpa_remesh_options {
  uint32_t struct_size;
  uint32_t iterations;   /* sweeps of split, collapse, flip, relax. 1 .. 100 */
  double target_length;  /* edge length aimed at; > 0 */
  double split_ratio;    /* edges longer than split_ratio * target_length are split. 0: 4/3 (Botsch & Kobbelt 2004) */
  double collapse_ratio; /* edges shorter than collapse_ratio * target_length are collapsed. 0: 4/5 (same source).
                            At most split_ratio / 1.5 */
  double relaxation;     /* tangential relaxation of the vertices that an operation touched, 0 .. 1; 0: none */
} tpa_remesh_options;

/* Splits long edges, collapses short ones, flips edges where that evens out the angles, and relaxes vertices
 * tangentially (section 7 names this as future work; Botsch & Kobbelt 2004). Each operation is checked before it is
 * done: link condition, normals, exact intersections, and that it cannot turn its component inside out (so one that is
 * flat but for rounding stays as it is). Needs and leaves a mesh free of self-intersections (TPA_E_TANGLED).
 * TPA_E_LIMIT where vertices or triangles run out; targets are discarded then, too. Expected O(V) for the sweep, O(1)
 * for each operation. */
TPA_API tpa_status tpa_remesh(tpa_context* context, const tpa_remesh_options* options, const tpa_exec* exec,
                              tpa_report* report, tpa_issue* issue);

typedef struct tpa_smooth_options {
  uint32_t struct_size;
  uint32_t iterations;      /* rounds of (lambda, mu) */
  uint32_t count;           /* length of vertices */
  uint32_t reserved;        /* 0 */
  const uint32_t* vertices; /* ids to smooth, or NULL for all */
} tpa_smooth_options;

/* Taubin smoothing (Taubin 1995: two Laplacian passes of factors lambda > 0 and mu < -lambda, from the config).
 * A vertex whose move would make an intersection keeps its position, and so do all of a component that might be turned
 * inside out. Needs and leaves a mesh free of self-intersections (TPA_E_TANGLED). O(V). */
TPA_API tpa_status tpa_smooth(tpa_context* context, const tpa_smooth_options* options, const tpa_exec* exec,
                              tpa_report* report, tpa_issue* issue);

/* ---------------------------------------------------------------- results of the last commit */

enum {
  TPA_EVENT_HANDLE = 1,     /* `amount` polygons were joined by one handle (section 4); in tpa_adapt also
                             * by a surface that has handles itself, where they go round a tunnel */
  TPA_EVENT_CAP = 2,        /* `amount` polygons of one region were capped (nested objects, section 5) */
  TPA_EVENT_REMOVAL = 3,    /* `amount` vertices of swallowed or inverted patches or components were removed at once */
  TPA_EVENT_ROLLBACK = 4,   /* `amount` vertices kept their old positions: no permitted surface joins or closes the
                             * polygons   round `position`, or what met there went on meeting pass after pass */
  TPA_EVENT_MERGE = 5,      /* `amount` components became one with component `before`; it is now `after` */
  TPA_EVENT_SPLIT = 6,      /* component `before` came apart into `amount` components; the first is `after` */
  TPA_EVENT_GENUS_UP = 7,   /* genus grew by `amount` */
  TPA_EVENT_GENUS_DOWN = 8, /* genus fell by `amount` */
  TPA_EVENT_BIRTH = 9,      /* component `after` is new */
  TPA_EVENT_DEATH = 10      /* component `before` is gone */
};

/* A component is named by its smallest vertex id, before or after the commit. */
typedef struct tpa_event {
  int32_t type; /* TPA_EVENT_... */
  uint32_t amount;
  uint32_t before;    /* component id before the commit, or TPA_NONE */
  uint32_t after;     /* component id after the commit, or TPA_NONE */
  double position[3]; /* HANDLE, CAP: mean of the polygons' vertices; ROLLBACK: the first place that blocked, as in the
                       * attempt in which it did; zeros for all others */
} tpa_event;

/* The events of the last commit: those of regions (types 1 to 4) pass by pass, within a pass in the order of their
 * first contact, then those of components by id. Writes pointer and count. O(1). */
TPA_API tpa_status tpa_events(const tpa_context* context, const tpa_event** events, uint32_t* count);

/* The vertices (new ids, ascending) that the last tpa_step left at their old positions. O(1). */
TPA_API tpa_status tpa_rolled_back(const tpa_context* context, const uint32_t** vertices, uint32_t* count);

/* Where a vertex came from, in ids before the commit. A vertex that was there has parents {id, TPA_NONE} and weight 1.
 * A new one is (nearly) weight * parents[0] + (1 - weight) * parents[1]: interpolate attributes so. */
typedef struct tpa_vertex_origin {
  uint32_t parents[2];
  float weight; /* of parents[0]; 0 .. 1 */
} tpa_vertex_origin;

typedef struct tpa_vertex_map_view {
  uint32_t struct_size;
  uint32_t old_count;               /* vertices before the last commit */
  uint32_t new_count;               /* and after */
  uint32_t reserved;                /* 0 */
  const uint32_t* old_to_new;       /* old_count ids; TPA_NONE where the vertex was removed */
  const tpa_vertex_origin* origins; /* new_count */
} tpa_vertex_map_view;

/* How the last commit renumbered, removed and made vertices. Set map->struct_size first. O(1). */
TPA_API tpa_status tpa_vertex_map(const tpa_context* context, tpa_vertex_map_view* map);

typedef struct tpa_triangle_map_view {
  uint32_t struct_size;
  uint32_t old_count;
  uint32_t new_count;
  uint32_t reserved;       /* 0 */
  const uint32_t* origins; /* new_count ids of triangles before the commit that the new one is, or is part of;
                              TPA_NONE for triangles of handles and caps */
} tpa_triangle_map_view;

/* How the last commit made triangles. Set map->struct_size first. O(1). */
TPA_API tpa_status tpa_triangle_map(const tpa_context* context, tpa_triangle_map_view* map);

/* ---------------------------------------------------------------- the handle database (section 4) */

#define TPA_HANDLE_MAX_POLYGONS 4
#define TPA_HANDLE_MIN_SIDES 3
#define TPA_HANDLE_MAX_SIDES 15
/* Most faces of a handle of the database: sum of sides + 2 * polygons - 4. */
#define TPA_HANDLE_MAX_FACES 64

typedef struct tpa_handle_info {
  uint32_t struct_size;
  uint32_t generators; /* stored, modulo rotations of each polygon and exchanges of equal ones (section 4.2) */
  uint64_t handles;    /* distinct handles that they expand to */
  uint32_t faces;      /* of each handle: sum of sides + 2 * polygons - 4 */
  uint32_t complete;   /* 1: these are all consistent handles without edges inside a polygon that have the least sum
                          of squared vertex degrees. 0: the 32 most even ones of more than 32 generators (least sum of
                          squared strip lengths; docs/handles.md) */
} tpa_handle_info;

/* What the database holds for `polygons` (2 .. 4) closed polygons with the given numbers of sides (3 .. 15 each, in any
 * order). Pure: needs no context. TPA_E_ARGUMENT outside these ranges. */
TPA_API tpa_status tpa_handle_describe(uint32_t polygons, const uint32_t* sides, tpa_handle_info* info);

/* The handle of number `index` (0 .. handles-1, in a fixed order). faces receives 3 vertex numbers for each face; the
 * vertices of the polygons are numbered from 0 through all polygons in the order given. Each polygon is traversed so
 * that the handle contains the directed edges (i, i + 1): that is how a hole of an outward oriented mesh is listed
 * when the new faces lie on the left. Capacity: 3 * TPA_HANDLE_MAX_FACES numbers are always enough. Pure. */
TPA_API tpa_status tpa_handle_get(uint32_t polygons, const uint32_t* sides, uint64_t index, uint32_t* faces);

/* Generator `generator` (0 .. generators-1) in the same form, and the number of distinct handles that the group makes
 * of it. orbit may be NULL. Pure. */
TPA_API tpa_status tpa_handle_generator(uint32_t polygons, const uint32_t* sides, uint32_t generator, uint32_t* faces,
                                        uint64_t* orbit);

#ifdef __cplusplus
}
#endif

#endif /* TOPOADAPT_H */
