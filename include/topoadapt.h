/* SPDX-License-Identifier: MIT */
/* topoadapt: topology changes of moving triangle meshes, in fixed memory.
 *
 * The caller deforms a closed triangle mesh: an active contour, a fluid, a sculpting tool, a game. Where the mesh runs
 * into itself, topoadapt merges, splits, opens handles and frees nested objects. The result is closed, consistently
 * oriented, 2-manifold and free of self-intersections, judged with exact predicates. The method follows "A robust and
 * efficient method for topology adaptations in deformable models"; sections cited below are sections of this paper.
 * P1 to P7 are the guarantees in README.md. docs/guide.md shows each task, docs/architecture.md the source.
 *
 * The common case, after tpa_config_init, tpa_arena_query and tpa_init:
 *
 *     tpa_load(ctx, &mesh, &issue);                     once
 *     tpa_move(ctx, &targets, &issue);                  each step: the wanted positions of vertices
 *     tpa_step(ctx, NULL, &report, &issue);             each step: move, detect, adapt, check, commit
 *
 * RULES FOR ALL FUNCTIONS
 * Memory     The library never allocates. A context lives in one block; the caller hands the block over and frees it.
 *            The context holds offsets, never pointers: a byte copy of the block, at an address of the same alignment,
 *            is a snapshot and a context in its own right, for the same build of the library.
 * Stack      At most 16 KiB for a call, or for a task on a thread of the caller, in every optimized build. Nothing
 *            recurses. The caller's parallel_for, memcpy and the like are not counted.
 * Threads    Contexts are independent; there is no global state. At any time a context has either one writer (a
 *            function with a non-const context) or any number of readers.
 * Errors     A function that can fail returns a tpa_status: TPA_OK or one of the negative TPA_E_ values, and never
 *            asserts, aborts or throws. A failure leaves mesh, maps and events bit for bit as before (P1).
 *            `issue` may be NULL. Otherwise a failure writes there all that is known: element, limit, size needed;
 *            success writes TPA_OK and zeros.
 * Versions   Structures that may grow begin with `struct_size`; the caller sets this field to the sizeof of the
 *            structure (tpa_config_init does so for tpa_config). New fields come at the end; zero in a field means the
 *            behaviour before the field came. So callers may have been compiled with an older header, whose
 *            structures are shorter: fields that a structure lacks are read as zero and not written. Or with a newer
 *            header: bytes unknown to the library must be zero in input, and become zero in output. A struct_size
 *            below that of version 0.1, above 4096 or not a multiple of 4 is refused. Structures without struct_size
 *            never change, nor do the numbers of statuses, events and other constants.
 * Determinism  Equal calls on equal states give equal bits, on every platform, compiler, optimisation level and
 *            thread count (P6).
 * Environment  Each call that computes, and each task on the caller's threads, sets the floating-point environment that
 *            it needs: rounding to nearest, no traps, subnormal numbers kept. At its end the caller's environment is
 *            back, exception flags included. The library can set it on x86, AArch64, ARM, RISC-V and s390x;
 *            WebAssembly and software floating-point have no other. Elsewhere calls fail with TPA_E_ENVIRONMENT
 *            unless rounding is to nearest and subnormal numbers are kept; the caller's threads must be alike.
 * Limits  A limit of the config fails a call or does not matter: every set of limits with which a call succeeds gives
 *            the same bits. tpa_issue.needed is enough for the rest of the island, the connected set of contacts, that
 *            met the limit: a caller who raises the limit to it and repeats the call meets the same limit at most once
 *            more in that island, and then in islands that want more yet. This holds since no island uses more than,
 *            each time and 64 more: 4 times the contacts of its first detection; 2 times the cut edges, and the new
 *            vertices and triangles, of its first pass in the paper's way; 2 times (tpa_step: 4 times) the pieces and 2
 *            times (tpa_step: 8 times) the new vertices and triangles of its first exact cut; a tpa_remesh no more than
 *            1.5 times the vertices and triangles after its first splits. Where more would be wanted, tpa_step cuts
 *            exactly instead of in the paper's way, then keeps vertices at their old positions; tpa_adapt counts
 *            contacts as unresolved; tpa_remesh leaves edges long. tpa_advance may meet a limit anew in each sub-step.
 * Work       Calls that take a tpa_exec count their work in units (tpa_exec.progress). A unit takes some 10 to 60 ns on
 *            a desktop processor. The count depends on state, config and arguments; not on time, threads, addresses,
 *            compilers or optimization. (Processors without vector registers may count some per cent otherwise.) A
 *            budget that suffices does not change a bit; a call that would spend more ends with TPA_E_BUDGET, before
 *            anything is committed. Bounds in units, for T triangles, n pairs in contact and the room of the config:
 *              detection   D = O(T + a log a), with a <= T^2 / 2 pairs of triangles whose boxes meet; as a rule
 *                          D = 5 T + 10 n
 *              exact cut   E = O(n log n + p^2 + g T), with p <= max_pieces and g <= p connected groups of pieces;
 *                          as a rule O(p log p)
 *              handles     H = O(c T + s c^3 + c^2 T), with c <= max_cut_edges and s = max_candidates; as a rule O(c)
 *              tpa_detect, tpa_validate  D
 *              tpa_adapt   (max_passes + 2) (D + E)
 *              tpa_step    10 (max_passes + 2) (D + E + H); as a rule D alone, or D + H
 *              tpa_advance for each sub-step that of tpa_step and O(V + T)
 *              tpa_smooth  O(iterations T + V D); as a rule O(iterations T) + D
 *              tpa_remesh  O(iterations T^2) + D, T at the end; as a rule at most 40 for a triangle and sweep, 100 for
 *                          an operation. Operations at a vertex with k triangles look at O(k) of them.
 *            All other calls are O(T log T) or less, but for tpa_carry_faces, and count nothing.
 * Coordinates  IEEE doubles, finite, each either zero or of magnitude within [2^-100, 2^100], the range of exact
 *            predicates. The unit is the caller's.
 * Orientation  Triangles are counter-clockwise seen from outside (see tpa_config.region).
 * Ids        Vertices are 0 .. vertex_count-1, triangles 0 .. triangle_count-1, without holes. A commit (a
 *            successful tpa_adapt, tpa_step, tpa_advance, tpa_remesh, tpa_smooth) discards targets, replaces maps and
 *            events. All but tpa_smooth may renumber, as told by tpa_vertex_map and tpa_triangle_map.
 * Empty      A mesh whose last component dies is empty: calls succeed and do nothing. tpa_load takes no empty mesh.
 * Pointers   A pointer handed out stays valid until the next call with a non-const context.
 */
#ifndef TOPOADAPT_H
#define TOPOADAPT_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* TPA_BUILD: the library itself is compiled. TPA_SHARED: as a shared library, or for programs on Windows that link a
 * DLL. Without TPA_SHARED the functions stay hidden in a shared object that links the library: a plugin exports none of
 * them. (WebAssembly modules export by linker flags.) */
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
  TPA_E_ARGUMENT = -1, /* a forbidden NULL, a struct_size or bytes that are no version's, a value out of range */
  TPA_E_CONFIG = -2,   /* a config not filled by tpa_config_init, or with a value out of range */
  TPA_E_OVERFLOW = -3, /* a size beyond the address space */
  TPA_E_ARENA = -4,    /* the block is too small (issue.needed: bytes) or misaligned (issue.needed: alignment) */
  TPA_E_CONTEXT = -5,  /* not a context of this version and build */
  TPA_E_STATE = -6,    /* no mesh is loaded: tpa_events, tpa_rolled_back and the calls on state need none */
  TPA_E_LIMIT = -7,    /* a limit of the config is reached: issue.limit names it, issue.needed says how much */
  TPA_E_MESH = -8,     /* no closed oriented 2-manifold, or an unusable coordinate or id: issue.defect and .element */
  TPA_E_TANGLED = -9,  /* the call needs a mesh free of self-intersections; issue.element and .other name a pair of
                          triangles (zeros above max_contacts pairs), issue.needed counts the pairs */
  TPA_E_ENVIRONMENT = -10, /* the floating-point environment is not as needed, and this platform has no way to set it */
  TPA_E_BUDGET = -11,      /* tpa_exec.budget is spent: issue.available repeats it, issue.needed says how much is
                              enough, where that is known */
  TPA_E_CANCELLED = -12,   /* tpa_exec.cancel became nonzero */
  TPA_E_DATA = -13 /* tpa_restore: no saved state, of a newer version, or damaged: issue.element is the offset of the
                      first byte that cannot be trusted */
};

/* Defects of a mesh. A failure reports the first defect in the order of this list. */
enum tpa_defect {
  TPA_DEFECT_NONE = 0,
  TPA_DEFECT_NOT_FINITE = 1,          /* vertex `element` has a NaN or infinite coordinate; tpa_move: its target, at
                                         place `other` of the list */
  TPA_DEFECT_MAGNITUDE = 2,           /* likewise with a coordinate outside the exact range */
  TPA_DEFECT_INDEX_RANGE = 3,         /* triangle `element`, or place `element` in the list of ids of
                                         tpa_move or tpa_smooth, names an unknown vertex `other`;
                                         issue.available: vertices that exist */
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
  int32_t defect;     /* TPA_DEFECT_... with TPA_E_MESH; with an argument at fault a number by which tpa_issue_text
                         names the field and what is wrong with it; else 0 */
  int32_t limit;      /* TPA_LIMIT_... with TPA_E_LIMIT, else 0 */
  int32_t argument;   /* 1-based position of the argument at fault, with TPA_E_CONFIG of the config field, else 0 */
  uint64_t element;   /* id of the element at fault, or 0 */
  uint64_t other;     /* second id, or 0 */
  uint64_t needed;    /* a sufficient amount (bytes, elements), or 0. See Limits above */
  uint64_t available; /* the amount at hand, or 0 */
} tpa_issue;

/* English name of a status, never NULL, also for numbers that are not statuses. Static storage. O(1). */
TPA_API const char* tpa_status_string(tpa_status status);

/* Writes a line of English about the issue into text[0..size-1], always terminated if size > 0, cut off at the end of
 * the buffer. Returns the length of the whole line without the terminator; 0 for issue == NULL. O(length). */
TPA_API size_t tpa_issue_text(const tpa_issue* issue, char* text, size_t size);

/* Version of the linked library: major << 16 | minor << 8 | patch. */
TPA_API uint32_t tpa_version(void);

/* Version and compiler of the linked library, and its commit where the build knew it ("commit" and 12 digits, "-dirty"
 * with changes), in a line. Static storage, never NULL. */
TPA_API const char* tpa_build_info(void);

/* ---------------------------------------------------------------- configuration and memory */

enum tpa_detect_mode {
  TPA_DETECT_COMPLETE = 0,   /* finds every pair of intersecting triangles, by a tree of boxes over the faces */
  TPA_DETECT_VERTEX_HASH = 1 /* section 3, a hash of 2 * max_vertices slots: finds the intersecting triangles at
                                vertices of one cell that no edges within the cell connect, and misses all others */
};

enum tpa_region {
  TPA_REGION_INSIDE = 0, /* triangles wind outward round the object: winding number 0 outside, 1 inside */
  TPA_REGION_OUTSIDE = 1 /* the mesh bounds the outside of the object: a closed surface winds inward round a void */
};

typedef struct tpa_config {
  uint32_t struct_size;   /* set by tpa_config_init */
  uint32_t cookie;        /* set by tpa_config_init; a config without it is refused */
  uint32_t max_vertices;  /* at any moment, also within a call. 4 .. 2^29. Default 65536 */
  uint32_t max_triangles; /* likewise. 0: 2 * max_vertices + 1024, enough for genus up to 256. At most 2^30 + 1024.
                             Default 0 */
  uint32_t max_contacts; /* intersecting pairs that a pass (see max_passes) can hold. 0: max_vertices / 2 + 1024, but at
                            most max_vertices / 4 + 8192. Default 0 */
  uint32_t max_cut_edges;  /* edges that a pass can cut (section 5, local refinement), at least 3. 0: max_vertices / 4 +
                              1024, but at most max_vertices / 8 + 4096 and max_vertices / 16 + 66560. Default 0 */
  uint32_t max_events;     /* events of a commit. 0: max_vertices / 128 + 256. Default 0 */
  uint32_t max_components; /* connected components of the mesh between calls. 0: max_vertices / 32 + 1024, but at most
                              max_vertices / 3 + 1, the most possible. Default 0 */
  uint32_t max_pieces;  /* triangles into which an exact cut (docs/exact-cut.md) may divide the faces in contact, those
                           within the region included; as many seam points as half of that. 0: 4 * max_contacts +
                           1024, at most 2^28. Default 0 */
  uint32_t detect_mode; /* TPA_DETECT_... of tpa_detect. All other calls detect completely in either mode. Default
                           TPA_DETECT_COMPLETE */
  double cell_size;     /* l of equation (1) for TPA_DETECT_VERTEX_HASH, in the unit of the coordinates; > 0, within the
                           range of coordinates. About the length of an edge: shorter cells miss more, and detection is
                           quadratic in the vertices of a cell. Default 1, a voxel (section 3) */
  uint32_t region;      /* TPA_REGION_... Default TPA_REGION_INSIDE */
  uint32_t max_passes;  /* rounds of detection and connection, in the paper's way; rounds of exact cuts. 1 .. 64.
                           Default 8 */
  uint32_t max_candidates;    /* handles or caps tested for each contact, the shortest first (section 5, step 6), before
                                 the contact is cut exactly (docs/guide.md). 1 .. 256. Default 64 */
  uint32_t smooth_iterations; /* Taubin smoothing after an event in the paper's way: rounds of (lambda, mu).
                                 0 .. 1000. Default 4 */
  double smooth_lambda;       /* Taubin 1995: 2^-20 <= lambda <= 1. Default .6307 */
  double smooth_mu;           /* Taubin 1995: -1.5 <= mu < -lambda, so that the pass band 1/lambda + 1/mu is positive.
                                 Default -.6732 */
  uint32_t max_substeps;      /* sub-steps of a tpa_advance. 0 and 1: a single one, and no memory for more; from 2 on,
                                 whatever the number, some 180 bytes for each vertex. At most 2^20. Default 0 */
  uint32_t reserved;          /* 0 */
} tpa_config;

/* Fills struct_size bytes of *config with defaults. struct_size: the caller's sizeof(tpa_config).
 * TPA_E_ARGUMENT for NULL or a size that is no version's. O(1). */
TPA_API tpa_status tpa_config_init(tpa_config* config, size_t struct_size);

typedef struct tpa_arena_size {
  size_t bytes;     /* size of the block for tpa_init with this config */
  size_t alignment; /* of the block, in bytes: a power of two */
} tpa_arena_size;

/* Memory for a config. tpa_init uses the same layout routine, so the two cannot disagree.
 * TPA_E_CONFIG (issue.argument: position of the field), TPA_E_OVERFLOW. O(1). */
TPA_API tpa_status tpa_arena_query(const tpa_config* config, tpa_arena_size* size, tpa_issue* issue);

/* Makes a context in memory[0..size-1]; *context receives the address of memory. The block stays the caller's; there is
 * nothing to destroy: free the block after the last call. TPA_E_ARENA names the bytes or the alignment needed.
 * O(bytes of tpa_arena_query). */
TPA_API tpa_status tpa_init(void* memory, size_t size, const tpa_config* config, tpa_context** context,
                            tpa_issue* issue);

/* Forgets the mesh, targets, maps and events; keeps the config. O(V). */
TPA_API tpa_status tpa_reset(tpa_context* context);

typedef struct tpa_memory_table {
  const char* name; /* static storage */
  uint64_t bytes;   /* size within the block */
  uint64_t used;    /* elements in use now */
  uint64_t peak;    /* most elements ever in use or wanted since tpa_init: as a limit, enough for the same calls */
  uint64_t limit;   /* capacity in elements */
} tpa_memory_table;

/* The tables of the block, in address order. *count receives their number, also above capacity (the length of tables[];
 * tables may be NULL if capacity is 0). used, peak and limit count the elements of the limit that sizes the table;
 * those of table "scratch", of max_pieces. Contacts, cut edges and pieces are in use within a call only. O(number of
 * tables). */
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
  uint32_t position_stride; /* bytes from a vertex to the next, at least x y z; 0: tightly packed */
  uint32_t triangle_stride; /* bytes from a triangle to the next, at least three indices; 0: tightly packed */
  const void* positions;    /* any alignment; read during the call only */
  const void* triangles;    /* any alignment; read during the call only */
} tpa_mesh_input;

/* Replaces the mesh by a copy of the given mesh. Accepts any closed, consistently oriented 2-manifold, in any number of
 * components, tangled or not: each edge has exactly two triangles, with opposite directions along it, and the triangles
 * at each vertex form a single fan. Everything else is TPA_E_MESH with the first defect. TPA_E_LIMIT beyond the limits
 * of the config. Clears targets, maps and events. Expected O(V). */
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
                                (i + 1) % 3; opposites[h] is the same edge's half-edge in the other triangle */
} tpa_mesh_view;

/* The present mesh, without a copy. Set view->struct_size first. TPA_E_STATE without a mesh. O(1). */
TPA_API tpa_status tpa_view(const tpa_context* context, tpa_mesh_view* view);

typedef struct tpa_mesh_output {
  uint32_t struct_size;
  uint32_t vertex_capacity;   /* of positions, in vertices */
  uint32_t triangle_capacity; /* of triangles, in triangles */
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

/* Copies the mesh out. Always writes the counts. TPA_E_LIMIT for a capacity too small; no element is written then.
 * O(V). */
TPA_API tpa_status tpa_export(const tpa_context* context, tpa_mesh_output* mesh, tpa_issue* issue);

typedef struct tpa_move_input {
  uint32_t struct_size;
  uint32_t count;           /* vertices to move */
  uint32_t position_type;   /* TPA_FLOAT32 or TPA_FLOAT64 */
  uint32_t position_stride; /* bytes; 0: tightly packed */
  const void* positions;    /* count targets */
  const uint32_t* vertices; /* count ids, the last of equal ids wins; NULL for 0 .. count-1 */
} tpa_move_input;

/* Sets targets for the next tpa_step or tpa_advance. Vertices without a target stay. A later call adds targets and
 * overwrites older ones; any commit and tpa_load discard all. TPA_E_MESH names the first vertex with a target out of
 * range or not finite, or the first unknown id, and no target changes. O(count). */
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
/* How a call is carried out: the caller's threads, and a bound on the work. NULL instead of a tpa_exec means serial and
 * without a bound. Neither changes the bits of a result.
 * parallel_for calls task(data, i) once for each i in 0 .. count-1, in any order, on any threads, and returns after the
 * last task has returned. Neighbouring indices work on neighbouring memory: give each thread a run of indices, the same
 * in every call (examples/pool.c). A task never calls public functions of the library. */
typedef struct tpa_exec {
  uint32_t struct_size;
  uint32_t flags; /* of tpa_exec_flags; read by tpa_step, tpa_advance, tpa_adapt, tpa_remesh, tpa_smooth */
  void* user;
  void (*parallel_for)(void* user, uint32_t count, void (*task)(void* data, uint32_t index), void* data);
  /* NULL: serial */
  uint64_t budget;       /* units of work that the call may spend; more is TPA_E_BUDGET. 0: no bound */
  const int32_t* cancel; /* NULL, or a flag that the call reads now and then, and that any thread may set: nonzero ends
                            the call with TPA_E_CANCELLED */
  uint64_t* progress;    /* NULL, or receives the units spent so far, now and then, and at the end of every
                            call whose arguments are accepted */
} tpa_exec;

typedef struct tpa_contact {
  uint32_t a, b; /* triangle ids, a < b */
} tpa_contact;

typedef struct tpa_contacts {
  uint32_t struct_size;
  uint32_t count;
  const tpa_contact* pairs; /* sorted by a, then b */
} tpa_contacts;

/* All pairs of triangles that meet anywhere but in a common vertex or edge (section 3; mode from the config). Touching
 * counts as meeting; neighbours with two corners in one place meet as well. TPA_E_LIMIT above max_contacts pairs, with
 * their number in issue.needed (an upper bound in mode TPA_DETECT_VERTEX_HASH, for pairs found twice). The mesh stays
 * as it is; the context is not const, since its pairs and what it knows of the mesh change. Expected O(V + pairs), in
 * mode TPA_DETECT_VERTEX_HASH for cells of about an edge. */
TPA_API tpa_status tpa_detect(tpa_context* context, const tpa_exec* exec, tpa_contacts* contacts, tpa_issue* issue);

typedef struct tpa_validation {
  uint32_t struct_size;
  uint32_t components;         /* connected components */
  uint64_t self_intersections; /* pairs of triangles that meet beyond their common vertex or edge; exact */
  int64_t euler;               /* V - E + F over all components */
  int64_t genus;               /* sum of the components' genera */
  double volume;               /* enclosed, signed, with rounding errors of double precision */
  double area;                 /* likewise */
} tpa_validation;

/* Checks the whole mesh from its triangles alone, trusting no derived structure: closed, oriented, 2-manifold, and
 * counts self-intersections by complete detection. TPA_E_MESH for a mesh that is no closed manifold (no function of
 * this library makes such a mesh). TPA_E_LIMIT above max_contacts pairs, with validation filled in all the same.
 * Leaves the mesh, maps, events and targets alone. The context is not const: the work takes scratch memory of the
 * block, and the context remembers the answer. Expected O(V + pairs). */
TPA_API tpa_status tpa_validate(tpa_context* context, const tpa_exec* exec, tpa_validation* validation,
                                tpa_issue* issue);

typedef struct tpa_report {
  uint32_t struct_size;
  uint32_t passes;                   /* detect-and-connect rounds, of all components together */
  uint32_t contacts;                 /* intersecting pairs found at the start of the first pass */
  uint32_t groups;                   /* groups of colliding clusters (section 5), or of cut faces, treated */
  uint32_t handles[4];               /* handles inserted between 2, 3, 4, more polygons */
  uint32_t caps;                     /* polygons closed by a cap; two for each thin tunnel or handle that is cut */
  uint32_t removed_patches;          /* swallowed or inverted patches and components removed */
  uint32_t rolled_back_vertices;     /* tpa_step, tpa_advance: vertices kept at their old positions, listed by
                                        tpa_rolled_back */
  uint32_t unresolved;               /* tpa_adapt: intersecting pairs left, listed by a complete tpa_detect */
  uint32_t splits, collapses, flips; /* tpa_remesh: edges split, collapsed, flipped */
  uint32_t moved;                    /* tpa_smooth, tpa_remesh: vertices moved by smoothing */
  uint32_t vertices, triangles;      /* counts after the call */
  double approach; /* tpa_step, tpa_advance: a length, >= 0; no two points of the surface approached each other by more
                      on the ways of the step, or of a sub-step */
  /* The region is where the winding number of the moved mesh (tpa_adapt: of the given mesh) is 1 or more. */
  /* tpa_step, tpa_advance, tpa_adapt: volumes of the region, and of what the result encloses. */
  double region_before, region_after;
  /* tpa_step, tpa_advance, tpa_adapt: volumes of the region left out by the result, and enclosed by the result besides.
   * Sums over the islands of contacts. For exact cuts not less than the true volumes, but for vertices moved together;
   * in the paper's way counted at sample points. A step changes at each island at most one per cent of the volumes of
   * the components that meet there, or holds vertices back; larger only where a component turns inside out. */
  double region_lost, region_gained;
  /* tpa_step, tpa_advance, tpa_adapt: a length; no change of the region lies farther from triangles in contact. */
  double region_reach;
  uint32_t substeps;   /* tpa_advance: sub-steps made; else 0 */
  uint32_t unfinished; /* TPA_EXEC_KEEP: 0, or the budget ended before: islands of contacts that are held back or left
                          (1 where they are not known), sweeps, or rounds of smoothing not made or not ended */
} tpa_report;

/* One step of an evolution (sections 2 and 5): moves vertices to their targets (to the bit, but for the sign of zero),
 * detects contacts, adapts the topology, checks, commits. Needs and leaves a mesh free of self-intersections (P1;
 * TPA_E_TANGLED: call tpa_adapt once). A step goes the paper's way where each contact is a small thing, and cuts the
 * surface exactly, as tpa_adapt does, where the paper's way would change the region too much; close new vertices then
 * merge, and new tunnels and handles thinner than the triangles that were cut are closed. Either way fills voids
 * thinner than the triangles in contact (docs/exact-cut.md). Vertices round a contact without a permitted solution keep
 * their old positions (tpa_rolled_back). Contacts count at the end of the step: see report->approach for parts that may
 * have passed through each other on the way, and tpa_advance.
 * TPA_E_LIMIT names the limit to raise. Targets stay after a failure. exec and report may be NULL; set
 * report->struct_size first. Cost: detection expected O(V), or O(vertices with targets) for few of them after other
 * steps; adaptation O(touched surface), and for each loop of cut edges and each void O(triangles over a ray along x);
 * O(V) more if a component goes, or if the paper's way leaves a contact unresolved. */
TPA_API tpa_status tpa_step(tpa_context* context, const tpa_exec* exec, tpa_report* report, tpa_issue* issue);

/* A step in sub-steps. Vertices go to their targets in as many equal parts of their ways as keep the approach of each
 * sub-step below `thickness`, a length within the range of coordinates; each sub-step is a step as tpa_step makes it.
 * Parts of the object, and of the space around it, can only be crossed unseen where they are thinner. One sub-step is
 * tpa_step, bit for bit.
 * All sub-steps are one commit, from the mesh before the call to the mesh after it. Maps, tpa_changes and the events of
 * components compare these two; events of types 1 to 4 follow each other sub-step by sub-step; epoch grows by the
 * number of sub-steps. The report has sums; of approach and region_reach the greatest; of region_before and
 * region_after what the last sub-step and the sums of region_lost and region_gained tell. A vertex that arrives where a
 * sub-step takes it ends at its target, to the bit but for the sign of zero. All others go the rest of their ways from
 * where they are: vertices left behind or smoothed, and new vertices, with the ways of their parents. (So targets
 * follow their vertices through the maps.) tpa_rolled_back lists the vertices that any sub-step left behind, new ones
 * included; where it is not empty, report->approach may be thickness or more. TPA_E_LIMIT with TPA_LIMIT_SUBSTEPS:
 * issue->needed sub-steps, at most 2^52 of them, are more than tpa_config.max_substeps; other limits may fail the call
 * anew in each sub-step.
 * Failures in any sub-step leave all as before the call; errors, exec and report as for tpa_step. Cost: for each
 * sub-step that of tpa_step and O(V). */
TPA_API tpa_status tpa_advance(tpa_context* context, double thickness, const tpa_exec* exec, tpa_report* report,
                               tpa_issue* issue);

/* Resolves a tangled mesh: the result is the boundary of the region of winding number >= 1, by an exact cut of the
 * triangles in contact (docs/exact-cut.md): touching and coplanar triangles are ordinary cases. Where the region
 * touches itself in an edge or a vertex, its parts come apart by 2^-10 of an edge. Surfaces that coincide but for
 * rounding move by some 2^-30 of the largest coordinate first. All other vertices that stay keep their bits. Where
 * rounding makes ever more contacts, that connected set of contacts and the components in it stay as they were, and
 * report->unresolved counts the intersecting pairs of the mesh (P2); else it is 0. report->region_... tell volumes
 * (P3). Needs room: max_pieces of some 5 to 30 for each pair. Ignores and discards targets. Errors, exec and report as
 * for tpa_step, but never TPA_E_TANGLED. Expected O(V + n log n) in the pieces, and O(triangles over a ray) for each
 * connected group of them. */
TPA_API tpa_status tpa_adapt(tpa_context* context, const tpa_exec* exec, tpa_report* report, tpa_issue* issue);

typedef struct tpa_remesh_options {
  uint32_t struct_size;
  uint32_t iterations;   /* sweeps of split, collapse, flip, relax. 1 .. 100 */
  double target_length;  /* edge length aimed at; > 0, within the range of coordinates. Not read if lengths are given */
  double split_ratio;    /* edges longer than split_ratio * target_length are split. 0: 4/3 (Botsch & Kobbelt 2004) */
  double collapse_ratio; /* edges shorter than collapse_ratio * target_length are collapsed. 0: 4/5 (same source).
                            At most split_ratio / 1.5 */
  double relaxation;     /* tangential relaxation, in each sweep, of the vertices touched by an operation of the call
                            so far; 0 .. 1; 0: none */
  uint32_t count;        /* length of vertices */
  uint32_t reserved;     /* 0 */
  const uint32_t* vertices; /* NULL for the whole mesh, or the ids of a part of it: only edges between two of these
                               vertices are split, collapsed and flipped, and only these vertices move. New vertices
                               belong to the part. All other vertices keep their bits, all triangles without a
                               vertex of the part stay. Read during the call only */
  const float* lengths;     /* NULL, or for each vertex of the mesh, in order of ids, the edge length aimed at there in
                               place of target_length; > 0, within the range of coordinates. An edge aims at the mean of its
                               ends, and so does a new vertex. Read during the call only */
} tpa_remesh_options;

/* Splits long edges, collapses short edges, flips edges to even out angles, and relaxes vertices tangentially (Botsch &
 * Kobbelt 2004; future work in section 7). Each operation is checked beforehand: link condition, normals, exact
 * intersections, and the sign of the enclosed volume, so a component that is flat but for rounding stays as it is. A
 * collapse puts the vertex beside the middle of its edge, where the volume stays (Lindstrom & Turk 1998), but into the
 * middle beside hubs and folds. Topology never changes. Needs and leaves a mesh free of self-intersections
 * (TPA_E_TANGLED). TPA_E_MESH names the first unknown id, TPA_E_ARGUMENT the first vertex (issue->element) with a
 * length out of range. TPA_E_LIMIT for vertices or triangles; then, and after TPA_E_BUDGET and TPA_E_CANCELLED, targets
 * may be discarded. The context knows the triangles near changes since its last tpa_remesh, and those whose edges it
 * could not change because of triangles or volumes further away. With the same lengths, split_ratio and collapse_ratio,
 * a sweep looks at these alone, with the result of a look at the whole mesh. Expected O(these triangles) for a sweep
 * and O(1) for an operation; O(V) besides for the first operation of a call. Lengths for each vertex, other lengths or
 * ratios than in the last call, the first call after tpa_load, tpa_restore or tpa_grow, and a call after a failed one:
 * O(V) for the first sweep. */
TPA_API tpa_status tpa_remesh(tpa_context* context, const tpa_remesh_options* options, const tpa_exec* exec,
                              tpa_report* report, tpa_issue* issue);

typedef struct tpa_smooth_options {
  uint32_t struct_size;
  uint32_t iterations;      /* rounds of (lambda, mu). 0 .. 1000 */
  uint32_t count;           /* length of vertices */
  uint32_t reserved;        /* 0 */
  const uint32_t* vertices; /* ids to smooth, or NULL for all */
} tpa_smooth_options;

/* Taubin smoothing (Taubin 1995: two Laplacian passes of factors lambda > 0 and mu < -lambda, from the config).
 * Vertices keep their positions where a move would make an intersection; so does a whole component that might be turned
 * inside out. Needs and leaves a mesh free of self-intersections (TPA_E_TANGLED). TPA_E_MESH names the first unknown
 * id. Ids stay as they are. TPA_E_BUDGET and TPA_E_CANCELLED may discard targets. Expected O(V). */
TPA_API tpa_status tpa_smooth(tpa_context* context, const tpa_smooth_options* options, const tpa_exec* exec,
                              tpa_report* report, tpa_issue* issue);

/* ---------------------------------------------------------------- results of the last commit */

enum tpa_event_type {
  TPA_EVENT_HANDLE = 1,     /* `amount` polygons were joined by a handle (section 4) */
  TPA_EVENT_CAP = 2,        /* `amount` polygons of a piece were capped (nested objects, section 5) */
  TPA_EVENT_REMOVAL = 3,    /* `amount` vertices of swallowed or inverted patches or components were removed at once */
  TPA_EVENT_ROLLBACK = 4,   /* `amount` vertices kept their old positions: no permitted surface closes the polygons
                             * round `position`, or contacts came back there pass after pass */
  TPA_EVENT_MERGE = 5,      /* `amount` components, `before` among them, became component `after` */
  TPA_EVENT_SPLIT = 6,      /* component `before` came apart, and `after` is one of the `amount` pieces: an event for
                             * each piece, by id. Pieces of bodies that merged as well name the smallest of `before` */
  TPA_EVENT_GENUS_UP = 7,   /* genus grew by `amount`, of all components that `after` is one of */
  TPA_EVENT_GENUS_DOWN = 8, /* genus fell by `amount`, likewise */
  TPA_EVENT_DEATH = 10      /* component `before` is gone */
  /* 9 is no event: every component comes from one before, since new vertices have their parents there. */
};

/* A component is named by its smallest vertex id, before or after the commit. Components before and after that share
 * vertices, or parents of vertices, are related; `before` and `after` name the smallest of related ones. */
typedef struct tpa_event {
  int32_t type; /* TPA_EVENT_... */
  uint32_t amount;
  uint32_t before;    /* component id before the commit, or TPA_NONE */
  uint32_t after;     /* component id after the commit, or TPA_NONE */
  double position[3]; /* HANDLE, CAP: mean of the polygons' vertices; ROLLBACK: the first place without a solution, in
                       * the attempt that failed there; zeros for all others */
} tpa_event;

/* The events of the last commit: types 1 to 3 in the order of the work, handles and caps of a pass in the order of
 * their first contacts; then type 4 (tpa_advance: both for each sub-step); then the events of components by id. Writes
 * pointer and count. O(1). */
TPA_API tpa_status tpa_events(const tpa_context* context, const tpa_event** events, uint32_t* count);

typedef struct tpa_component {
  uint32_t id;     /* the smallest vertex id, as in tpa_event */
  uint32_t before; /* the smallest component before the last commit, in ids of that time, to which it is related; `id`
                      after tpa_load */
  uint32_t vertices, triangles;
  int32_t genus;
  uint32_t reserved; /* 0 */
  double volume;     /* enclosed, signed: negative where triangles wind inward, as round a void. With rounding errors of
                        double precision, relative to the component's size and not to its place */
  double area;       /* likewise */
  double box[6];     /* least x y z, greatest x y z of the vertices; exact */
} tpa_component;

/* The connected components of the present mesh, ascending by id. *count receives their number in any case;
 * components may be NULL if capacity is 0. labels, with room for an entry per vertex, receives the place in
 * components[] of each vertex; may be NULL. TPA_E_LIMIT if capacity is too small, and nothing but *count is written.
 * TPA_E_STATE without a mesh. O(V), or O(1) if only *count is wanted. */
TPA_API tpa_status tpa_components(const tpa_context* context, tpa_component* components, uint32_t capacity,
                                  uint32_t* labels, uint32_t* count, tpa_issue* issue);

/* The vertices (new ids, ascending) left at their old positions by the last tpa_step, or a sub-step of the last
 * tpa_advance. O(1). */
TPA_API tpa_status tpa_rolled_back(const tpa_context* context, const uint32_t** vertices, uint32_t* count);

/* The origin of a vertex, in ids before the commit. An old vertex has parents {id, TPA_NONE} and weight 1, wherever it
 * has moved. A new vertex has two parents, and lies near weight * parents[0] + (1 - weight) * parents[1], with old
 * vertices where they were before the commit, in a step at their targets unless rolled back: no farther than the
 * longest edge at the new vertex, or than the distance of the parents if that is longer. The weight is that of the
 * nearest point between the parents; interpolate attributes with it. Equal parents with weight 0 say that no such
 * origin is known: the parent is some old vertex, at no stated distance. (Along a seam of an exact cut all parents are
 * of the same side where these are near enough, so that the seam moves with one body.) */
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

/* How the last commit renumbered, removed and made vertices; the identity after tpa_load. Set map->struct_size first.
 * TPA_E_STATE without a mesh. O(1). */
TPA_API tpa_status tpa_vertex_map(const tpa_context* context, tpa_vertex_map_view* map);

typedef struct tpa_triangle_map_view {
  uint32_t struct_size;
  uint32_t old_count;
  uint32_t new_count;
  uint32_t reserved;       /* 0 */
  const uint32_t* origins; /* new_count ids: the triangle before the commit that the new triangle is, or is part of;
                              TPA_NONE for triangles of handles and caps */
} tpa_triangle_map_view;

/* How the last commit made triangles; the identity after tpa_load. Set map->struct_size first. TPA_E_STATE without a
 * mesh. O(1). */
TPA_API tpa_status tpa_triangle_map(const tpa_context* context, tpa_triangle_map_view* map);

typedef struct tpa_range {
  uint32_t first, count;
} tpa_range;

typedef struct tpa_change_list {
  uint32_t struct_size;
  uint32_t gap;                            /* ranges with at most so many unchanged elements between them become one */
  uint32_t vertex_capacity;                /* of vertices[]; 0: none wanted */
  uint32_t triangle_capacity;              /* of triangles[]; 0: none wanted */
  tpa_range* vertices;                     /* receives ranges of vertex ids, ascending */
  tpa_range* triangles;                    /* receives ranges of triangle ids, ascending */
  uint32_t vertex_ranges, triangle_ranges; /* out: ranges written */
  uint32_t changed_vertices, changed_triangles;  /* out: without gaps */
  uint32_t old_vertex_count, old_triangle_count; /* out: before the last commit */
  uint32_t vertex_count, triangle_count;         /* out: after */
} tpa_change_list;

/* Lists the parts of tpa_view to copy into arrays that still hold positions and triangles of before the last commit,
 * on a graphics processor for instance: all vertices with other position bits than the vertex of this id before, all
 * triangles with other corners or another first corner, and all new ids. Everything after tpa_load and tpa_restore.
 * Where ranges are more than the capacity, the gap doubles until they fit. Ids beyond the counts after are gone;
 * tpa_vertex_map tells which vertices were removed. Set changes->struct_size first. TPA_E_STATE without a mesh.
 * O(changes) for each gap. */
TPA_API tpa_status tpa_changes(const tpa_context* context, tpa_change_list* changes, tpa_issue* issue);

/* Carries attributes through the last commit: `floats` values (at least 1) for each vertex. before[] is in ids before
 * the commit; after[] receives the values in new ids, and must not overlap before[]. A vertex takes weight * parents[0]
 * + (1 - weight) * parents[1] of its origin, summed in double precision; where one parent has all the weight, its bits.
 * TPA_E_ARGUMENT for NULL or floats 0, TPA_E_STATE without a mesh. O(V * floats). */
TPA_API tpa_status tpa_carry_vertices(const tpa_context* context, const float* before, uint32_t floats, float* after);

/* The same for `doubles` values in double precision. */
TPA_API tpa_status tpa_carry_vertices_f64(const tpa_context* context, const double* before, uint32_t doubles,
                                          double* after);

/* Triangles take the bits of their origins: doubles as two floats. A triangle without an origin takes those of the
 * nearest triangle with one, across edges, and on the way always the lowest of the neighbours that are nearer; zeros in
 * a component without any origin. O(V * floats), and O(V) for each ring of triangles without an origin. */
TPA_API tpa_status tpa_carry_faces(const tpa_context* context, const float* before, uint32_t floats, float* after);

/* ---------------------------------------------------------------- state */

/* Carries the state of a context into memory[0..size-1], as a context of its own with another config; *bigger receives
 * the address of memory. Mesh, targets, maps, events, vertices left behind, epoch and peaks are as before, and later
 * calls give the bits that they would have given with the limits of `config` from the start. After TPA_E_LIMIT: raise
 * the limit, grow, call again. Limits may also fall. `context` stays as it is, and may be freed. Fields other than
 * limits may differ, and hold from now on. TPA_E_CONFIG, TPA_E_OVERFLOW, TPA_E_ARENA as for tpa_init; TPA_E_LIMIT if
 * the state does not fit; TPA_E_ARGUMENT if memory overlaps the block of `context`. After a failure the content of
 * memory is undefined. The next step detects in all faces once. O(V). */
TPA_API tpa_status tpa_grow(const tpa_context* context, void* memory, size_t size, const tpa_config* config,
                            tpa_context** bigger, tpa_issue* issue);

/* Writes the state of a context to data[0..capacity-1]: mesh, targets, maps, events, vertices left behind, epoch, and
 * the fields of the config that decide results; no limits, no peaks. The bytes are the same on every platform, and
 * equal for equal states. *size always receives their number. data may be NULL if capacity is 0: then nothing is
 * written. TPA_E_ARENA for a capacity too small, and data stays as it was. Some 44 bytes for each vertex, and 16 for
 * each triangle. O(V). */
TPA_API tpa_status tpa_save(const tpa_context* context, void* data, size_t capacity, size_t* size, tpa_issue* issue);

/* Replaces the state of a context by a saved state, of any platform. Later calls give the bits that they would have
 * given in the context of tpa_save, whatever the limits with which they succeed. All is checked before anything is
 * replaced: data of any content leave a sound context. The next call that needs a clean mesh detects
 * self-intersections. TPA_E_DATA for data that tpa_save has not written, byte for byte and to the last byte;
 * TPA_E_CONFIG if a field of the config that decides results is another one: detect_mode, cell_size, region,
 * max_passes, max_candidates, smooth_...; TPA_E_LIMIT names the limit to raise. data may have any alignment, and is
 * read during the call only. Expected O(V). */
TPA_API tpa_status tpa_restore(tpa_context* context, const void* data, size_t size, tpa_issue* issue);

/* A hash (XXH64) of the bytes that tpa_save writes, apart from the hash in their last 8 bytes, which is the same. Equal
 * states have equal digests, on every platform and for all limits; unequal states hardly ever do. O(V). */
TPA_API tpa_status tpa_digest(const tpa_context* context, uint64_t* digest);

/* The config of tpa_init or tpa_grow; tpa_arena_query tells the size of the block. Set config->struct_size first. O(1).
 */
TPA_API tpa_status tpa_config_of(const tpa_context* context, tpa_config* config);

/* The targets set since the last commit: ascending ids, and x y z of each. Writes the first `capacity` of them; *count
 * receives their number, also above capacity. vertices and positions may each be NULL. O(count). */
TPA_API tpa_status tpa_targets(const tpa_context* context, uint32_t* vertices, double* positions, uint32_t capacity,
                               uint32_t* count);

/* Drops all targets. O(count). */
TPA_API tpa_status tpa_drop_targets(tpa_context* context);

/* ---------------------------------------------------------------- the handle database (section 4) */

#define TPA_HANDLE_MAX_POLYGONS 4
#define TPA_HANDLE_MIN_SIDES 3
#define TPA_HANDLE_MAX_SIDES 15
/* Most faces of a handle of the database: sum of sides + 2 * polygons - 4. */
#define TPA_HANDLE_MAX_FACES 64

typedef struct tpa_handle_info {
  uint32_t struct_size;
  uint32_t generators; /* stored, modulo rotations of each polygon and exchanges of equal ones (section 4.2) */
  uint64_t handles;    /* distinct handles of all generators together */
  uint32_t faces;      /* of each handle: sum of sides + 2 * polygons - 4 */
  uint32_t complete;   /* 1: all consistent handles of least sum of squared vertex degrees, without edges inside a
                          polygon. 0: the 32 most even of more than 32 generators (least sum of squared strip lengths;
                          docs/handles.md) */
} tpa_handle_info;

/* The database's handles for `polygons` (2 .. 4) closed polygons with the given numbers of sides (3 .. 15 each, in any
 * order). Pure: needs no context. TPA_E_ARGUMENT outside these ranges. */
TPA_API tpa_status tpa_handle_describe(uint32_t polygons, const uint32_t* sides, tpa_handle_info* info);

/* The handle of number `index` (0 .. handles-1, in a fixed order). faces receives 3 vertex numbers for each face of
 * tpa_handle_info.faces; vertices are numbered from 0 through all polygons in the order given. The handle contains the
 * directed edges (i, i + 1) of each polygon: a hole of an outward oriented mesh is listed in this direction, with the
 * new faces on the left. capacity: numbers for which faces has room; 3 * TPA_HANDLE_MAX_FACES is always enough. Pure.
 * TPA_E_ARGUMENT outside the ranges, and for a capacity too small; faces stays as it was then. */
TPA_API tpa_status tpa_handle_get(uint32_t polygons, const uint32_t* sides, uint64_t index, uint32_t* faces,
                                  uint32_t capacity);

/* Generator `generator` (0 .. generators-1) in the same form. *orbit receives the number of distinct handles that the
 * group makes from this generator; orbit may be NULL. Pure. Errors as for tpa_handle_get. */
TPA_API tpa_status tpa_handle_generator(uint32_t polygons, const uint32_t* sides, uint32_t generator, uint32_t* faces,
                                        uint32_t capacity, uint64_t* orbit);

#ifdef __cplusplus
}
#endif

#endif /* TOPOADAPT_H */
