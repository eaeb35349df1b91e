/* SPDX-License-Identifier: MIT */
/* Scenes made in code; prints a line with a digest for each. Nothing but the public header and IEEE arithmetic,
 * in static memory: the same lines on every platform (expected.txt). Without SCENES_MAIN, scene_line() is all. */
#include "scenes.h"

#include <string.h>

#include "calls.h"

/* ---------------------------------------------------------------- motions */

/* Vertices move towards the plane x = 0, or away from it. */
static void close_in(double way) {
  const tpa_mesh_view v = view();
  uint32_t i;
  memcpy(targets, v.positions, 3 * sizeof(double) * v.vertex_count);
  for (i = 0; i < v.vertex_count; ++i) targets[3 * i] += targets[3 * i] < 0 ? way : -way;
}

/* Vertices move along their normals, by amount(position) each. */
static void inflate(double (*amount)(const double* p)) {
  const tpa_mesh_view v = view();
  uint32_t t, i;
  int k;
  memset(targets, 0, 3 * sizeof(double) * v.vertex_count);
  for (t = 0; t < v.triangle_count; ++t) {
    const uint32_t* c = v.triangles + 3 * (size_t)t;
    double n[3];
    triangle_normal(v.positions + 3 * (size_t)c[0], v.positions + 3 * (size_t)c[1], v.positions + 3 * (size_t)c[2], n);
    for (i = 0; i < 3; ++i)
      for (k = 0; k < 3; ++k) targets[3 * c[i] + (uint32_t)k] += n[k];
  }
  for (i = 0; i < v.vertex_count; ++i) {
    const double* p = v.positions + 3 * (size_t)i;
    const double length = length_of(targets + 3 * (size_t)i), by = length > 0 ? amount(p) / length : 0;
    for (k = 0; k < 3; ++k) targets[3 * i + (uint32_t)k] = p[k] + by * targets[3 * i + (uint32_t)k];
  }
}

static void jitter(struct mesh* mesh, double by) {
  uint32_t i;
  for (i = 0; i < 3 * mesh->vertices; ++i) mesh->position[i] += by * random_number();
}

static double grow(const double* p) {
  (void)p;
  return 0.04;
}
static double shrink_waist(const double* p) { return p[0] * p[0] < 0.25 ? -0.105 : 0; }

/* ---------------------------------------------------------------- phantoms: negative inside */

static double two_balls(const double* p) {
  const double u[3] = {p[0] - 0.55, p[1], p[2]}, w[3] = {p[0] + 0.55, p[1], p[2]};
  return 1 - 0.3 / (squared_length(u) + 0.01) - 0.3 / (squared_length(w) + 0.01);
}
static double ring(const double* p) {
  const double u[3] = {p[0], p[1], 0};
  const double d[3] = {length_of(u) - 0.7, p[2], 0};
  return length_of(d) - 0.28;
}
static double rounded_box(const double* p) {
  const double q = p[0] * p[0] * p[0] * p[0] + p[1] * p[1] * p[1] * p[1] + p[2] * p[2] * p[2] * p[2];
  return q - 0.6;
}
/* A thick shell: the balloon closes round its void. */
static double shell(const double* p) {
  const double d = length_of(p) - 0.75;
  return (d < 0 ? -d : d) - 0.22;
}

static double (*phantom)(const double* p);
static double towards_phantom(const double* p) {
  const double f = phantom(p);
  return f > 0.1 ? -0.06 : f < -0.1 ? 0.06 : -0.6 * f;
}

/* A balloon fills a phantom from a small sphere on the x axis. */
static void segment(double (*of)(const double*), double x, double length, int steps) {
  struct mesh* m = clear_mesh();
  tpa_config config;
  int i;
  phantom = of;
  add_sphere(m, x, 0, 0, 0.16, 3);
  config = config_for(m);
  config.max_vertices = 2600;
  load(m, &config);
  for (i = 0; i < steps && status == TPA_OK; ++i) {
    inflate(towards_phantom);
    step();
    remesh(length, 1);
  }
  validate();
}

/* ---------------------------------------------------------------- scenes */

static void two_spheres(struct mesh* m, double apart, int parts) {
  add_sphere(m, -apart / 2, 0, 0, 1, parts);
  add_sphere(m, apart / 2, 0.1, 0.05, 1, parts);
}

static void load_box(void) {
  struct mesh* m = clear_mesh();
  add_box(m, 0, 0, 0, 1, 2, 3, 3);
  load_plainly(m);
  validate();
  add_state();
}

static void detect_in_mode(uint32_t mode, double noise) {
  struct mesh* m = clear_mesh();
  tpa_config config;
  two_spheres(m, 1.3, 8);
  jitter(m, noise);
  config = config_for(m);
  config.detect_mode = mode;
  config.cell_size = 0.2;
  load(m, &config);
  detect();
}
static void detect_complete(void) { detect_in_mode(TPA_DETECT_COMPLETE, 0); }
static void detect_hash(void) { detect_in_mode(TPA_DETECT_VERTEX_HASH, 0); }
static void detect_noise(void) { detect_in_mode(TPA_DETECT_COMPLETE, 0.12); }
static void detect_noise_hash(void) { detect_in_mode(TPA_DETECT_VERTEX_HASH, 0.12); }

static void adapt_mesh(struct mesh* m) {
  load_plainly(m);
  detect();
  adapt();
  validate();
}
static void adapt_two(void) {
  struct mesh* m = clear_mesh();
  two_spheres(m, 1.3, 8);
  adapt_mesh(m);
}
static void adapt_chain(void) {
  struct mesh* m = clear_mesh();
  int i;
  for (i = 0; i < 4; ++i) add_sphere(m, 1.5 * i, 0.07 * i, 0, 1, 5);
  adapt_mesh(m);
}
static void adapt_nested(void) {
  struct mesh* m = clear_mesh();
  add_sphere(m, 0, 0, 0, 1, 5);
  add_sphere(m, 0.1, 0, 0, 0.5, 4);
  adapt_mesh(m);
}
static void adapt_crumpled(void) {
  struct mesh* m = clear_mesh();
  add_sphere(m, 0, 0, 0, 1, 7);
  jitter(m, 0.2);
  adapt_mesh(m);
}
static void adapt_coplanar(void) {
  struct mesh* m = clear_mesh();
  add_box(m, 0, 0, 0, 2, 2, 2, 3);
  add_box(m, 1, 0, 0, 3, 2, 2, 4);
  adapt_mesh(m);
}
static void adapt_touching(void) {
  struct mesh* m = clear_mesh();
  add_box(m, 0, 0, 0, 1, 1, 1, 2);
  add_box(m, 1, 0, 0, 2, 1, 1, 2);
  add_box(m, 1, 1, 0, 2, 2, 1, 2);
  adapt_mesh(m);
}
static void adapt_torus_box(void) {
  struct mesh* m = clear_mesh();
  add_torus(m, 1, 0.35, 20, 10);
  add_box(m, 0.2, -0.4, -0.5, 1.6, 0.45, 0.55, 3);
  adapt_mesh(m);
}
static void adapt_boxes(void) {
  struct mesh* m = clear_mesh();
  int i;
  for (i = 0; i < 8; ++i) {
    const double x = i & 1 ? 0.75 : 0, y = i & 2 ? 0.75 : 0, z = i & 4 ? 0.75 : 0;
    add_box(m, x, y, z, x + 1, y + 1, z + 1, 2);
  }
  adapt_mesh(m);
}
static void adapt_outside(void) {
  struct mesh* m = clear_mesh();
  tpa_config config;
  two_spheres(m, 1.6, 6);
  turn_inside_out(m);
  config = config_for(m);
  config.region = TPA_REGION_OUTSIDE;
  load(m, &config);
  adapt();
  validate();
}

static void approach_steps(struct mesh* m, double way, int steps) {
  int i;
  load_plainly(m);
  for (i = 0; i < steps && status == TPA_OK; ++i) {
    close_in(way);
    step();
  }
  validate();
}
static void merge_two(void) {
  struct mesh* m = clear_mesh();
  two_spheres(m, 2.2, 8);
  approach_steps(m, 0.05, 8);
}
static void merge_four(void) {
  struct mesh* m = clear_mesh();
  int i;
  for (i = 0; i < 4; ++i) add_sphere(m, i & 1 ? 1.15 : -1.15, i & 2 ? 1.3 : -1.3, 0.1 * i, 1, 5);
  approach_steps(m, 0.08, 5);
}
static void inflate_steps(struct mesh* m, double (*amount)(const double*), int steps) {
  int i;
  load_plainly(m);
  for (i = 0; i < steps && status == TPA_OK; ++i) {
    inflate(amount);
    step();
  }
  validate();
}
static void close_torus(void) {
  struct mesh* m = clear_mesh();
  add_torus(m, 1, 0.7, 28, 16);
  jitter(m, 0.02);
  inflate_steps(m, grow, 9);
}
static void split_waist(void) {
  struct mesh* m = clear_mesh();
  add_box(m, -2, -0.4, -0.4, 2, 0.4, 0.4, 8);
  jitter(m, 0.02);
  inflate_steps(m, shrink_waist, 4);
}
static void merge_voids(void) {
  struct mesh* m = clear_mesh();
  tpa_config config;
  int i;
  two_spheres(m, 2.3, 6);
  turn_inside_out(m);
  config = config_for(m);
  config.region = TPA_REGION_OUTSIDE;
  load(m, &config);
  for (i = 0; i < 5 && status == TPA_OK; ++i) {
    close_in(0.07);
    step();
  }
  validate();
}
static void random_steps(void) {
  struct mesh* m = clear_mesh();
  int i;
  uint32_t k;
  add_sphere(m, 0, 0, 0, 1, 6);
  load_plainly(m);
  for (i = 0; i < 4 && status == TPA_OK; ++i) {
    const tpa_mesh_view v = view();
    for (k = 0; k < 3 * v.vertex_count; ++k) targets[k] = v.positions[k] + 0.07 * random_number();
    step();
  }
  validate();
}
/* Floats and short indices, in strides. */
static void load_floats(void) {
  static float position[5 * 400];
  static uint16_t triangle[4 * 800];
  struct mesh* m = clear_mesh();
  tpa_mesh_input input = {0};
  tpa_config config;
  uint32_t i;
  add_sphere(m, 0.1, 0.2, 0.3, 1.7, 6);
  config = config_for(m);
  load(m, &config);
  for (i = 0; i < 3 * m->vertices; ++i) position[i / 3 * 5 + i % 3] = (float)m->position[i];
  for (i = 0; i < 3 * m->triangles; ++i) triangle[i / 3 * 4 + i % 3] = (uint16_t)m->triangle[i];
  input.struct_size = sizeof input;
  input.vertex_count = m->vertices;
  input.triangle_count = m->triangles;
  input.position_type = TPA_FLOAT32;
  input.index_type = TPA_UINT16;
  input.position_stride = 5 * sizeof(float);
  input.triangle_stride = 4 * sizeof(uint16_t);
  input.positions = position;
  input.triangles = triangle;
  note(tpa_load(context, &input, &issue));
  add_state();
}

static void remesh_sphere(double length) {
  struct mesh* m = clear_mesh();
  add_sphere(m, 0, 0, 0, 1, 8);
  load_plainly(m);
  remesh(length, 3);
  validate();
}
static void refine(void) { remesh_sphere(0.13); }
static void coarsen(void) { remesh_sphere(0.4); }
static void smooth_all(void) {
  struct mesh* m = clear_mesh();
  add_sphere(m, 0, 0, 0, 1, 8);
  jitter(m, 0.03);
  load_plainly(m);
  smooth(10, NULL, 0);
}
static void smooth_some(void) {
  uint32_t some[60], i;
  struct mesh* m = clear_mesh();
  add_sphere(m, 0, 0, 0, 1, 8);
  jitter(m, 0.03);
  load_plainly(m);
  for (i = 0; i < 60; ++i) some[i] = 3 * i + 1;
  smooth(6, some, 60);
}

static void segment_two(void) { segment(two_balls, 0.55, 0.16, 20); }
static void segment_ring(void) { segment(ring, 0.7, 0.15, 45); }
static void segment_box(void) { segment(rounded_box, 0, 0.2, 22); }
static void segment_shell(void) { segment(shell, 0.75, 0.17, 45); }

/* Goes on in another context as in the first: both must do the same. */
static void go_on_in(tpa_context* other) {
  tpa_context* const original = context;
  const uint64_t before = hash;
  uint64_t after;
  close_in(0.1);
  step();
  after = hash;
  hash = before;
  context = other;
  close_in(0.1);
  step();
  if (hash != after) note(TPA_E_STATE);
  context = original;
}

/* Two spheres after a step. */
static void begin_merge(struct mesh* m) {
  two_spheres(m, 2.1, 6);
  load_plainly(m);
  close_in(0.04);
  step();
}

/* A copy of the block is a context. */
static void snapshot(void) {
  begin_merge(clear_mesh());
  memcpy(block(1), block(0), block_bytes());
  go_on_in(block(1));
}

/* Another context takes a saved state. */
static void save_and_restore(void) {
  static unsigned char saved[UINT32_C(1) << 18];
  struct mesh* m = clear_mesh();
  tpa_context* other = NULL;
  tpa_config config;
  size_t size = 0, i;
  uint64_t digest = 0;
  begin_merge(m);
  note(tpa_save(context, saved, sizeof saved, &size, &issue));
  for (i = 0; i < size; ++i) add_number(saved[i], 1);
  note(tpa_digest(context, &digest));
  add_number(digest, 8);
  config = config_for(m);
  config.max_vertices += 100;
  note(tpa_init(block(1), block_bytes(), &config, &other, &issue));
  note(tpa_restore(other, saved, size, &issue));
  /* The other context knows nothing yet of its mesh. */
  counts_units = 0;
  go_on_in(other);
  counts_units = 1;
}

/* Some handles of the database. */
static void handles(void) {
  uint32_t sides[4], faces[3 * TPA_HANDLE_MAX_FACES], k, i;
  uint64_t index;
  for (k = 2; k <= 4; ++k)
    for (i = 0; i < 12; ++i) {
      tpa_handle_info info = {0};
      uint32_t p;
      info.struct_size = sizeof info;
      for (p = 0; p < k; ++p) sides[p] = 3 + (i * (p + 2) + p) % 13;
      note(tpa_handle_describe(k, sides, &info));
      add_ids(&info.generators, 1);
      add_number(info.handles, 8);
      for (index = 0; index < info.handles; index += 1 + info.handles / 5) {
        note(tpa_handle_get(k, sides, index, faces, 3 * TPA_HANDLE_MAX_FACES));
        add_ids(faces, 3 * (size_t)info.faces);
      }
    }
}

/* Balls that jump across each other. */
static void advance_two(void) {
  struct mesh* m = clear_mesh();
  tpa_config config;
  two_spheres(m, 2.4, 6);
  config = config_for(m);
  config.max_substeps = 64;
  load(m, &config);
  close_in(2.4);
  advance(0.7);
  close_in(-0.1);
  advance(10);
}

static void add_components(void) {
  static tpa_component components[16];
  static uint32_t labels[MOST_VERTICES];
  uint32_t count = 0, i;
  note(tpa_components(context, components, 16, labels, &count, &issue));
  for (i = 0; i < count; ++i) {
    add_ids(&components[i].id, 4);
    add_number((uint64_t)(int64_t)components[i].genus, 4);
    add_doubles(&components[i].volume, 8);
  }
  add_ids(labels, view().vertex_count);
}
static void add_changes(uint32_t gap) {
  static tpa_range ranges[2][64];
  tpa_change_list changes = {0};
  uint32_t i;
  changes.struct_size = sizeof changes;
  changes.gap = gap;
  changes.vertex_capacity = changes.triangle_capacity = 64;
  changes.vertices = ranges[0];
  changes.triangles = ranges[1];
  note(tpa_changes(context, &changes, &issue));
  add_ids(&changes.vertex_ranges, 8);
  for (i = 0; i < changes.vertex_ranges; ++i) add_ids(&ranges[0][i].first, 2);
  for (i = 0; i < changes.triangle_ranges; ++i) add_ids(&ranges[1][i].first, 2);
}
static void add_carried(void) {
  static float before[2 * 2 * MOST_VERTICES], after[2 * 2 * MOST_VERTICES];
  const tpa_mesh_view v = view();
  uint32_t i;
  for (i = 0; i < 4 * MOST_VERTICES; ++i) before[i] = (float)(i % 97) * 0.37f;
  note(tpa_carry_vertices(context, before, 2, after));
  for (i = 0; i < 2 * v.vertex_count; ++i) add_number((uint64_t)(int64_t)(after[i] * 4096), 8);
  note(tpa_carry_triangles(context, before, 1, after));
  for (i = 0; i < v.triangle_count; ++i) add_number((uint64_t)(int64_t)(after[i] * 4096), 8);
}
/* Results of a commit, here and in a larger block. */
static void results(void) {
  struct mesh* m = clear_mesh();
  tpa_config config;
  begin_merge(m);
  close_in(0.05);
  step();
  add_components();
  add_changes(0);
  add_changes(16);
  add_carried();
  config = config_for(m);
  config.max_vertices += 200;
  note(tpa_grow(context, block(1), block_bytes(), &config, &context, &issue));
  add_components();
  add_changes(4);
  add_carried();
  close_in(0.05);
  step();
  add_components();
}

static const struct {
  const char* name;
  void (*run)(void);
} scenes[] = {
    {"load box", load_box},
    {"load floats", load_floats},
    {"detect", detect_complete},
    {"detect by hash", detect_hash},
    {"detect noise", detect_noise},
    {"detect noise by hash", detect_noise_hash},
    {"adapt two", adapt_two},
    {"adapt chain", adapt_chain},
    {"adapt nested", adapt_nested},
    {"adapt crumpled", adapt_crumpled},
    {"adapt coplanar", adapt_coplanar},
    {"adapt touching", adapt_touching},
    {"adapt torus and box", adapt_torus_box},
    {"adapt boxes", adapt_boxes},
    {"adapt outside", adapt_outside},
    {"merge two", merge_two},
    {"merge four", merge_four},
    {"close torus", close_torus},
    {"split waist", split_waist},
    {"merge voids", merge_voids},
    {"random steps", random_steps},
    {"refine", refine},
    {"coarsen", coarsen},
    {"smooth", smooth_all},
    {"smooth some", smooth_some},
    {"segment two balls", segment_two},
    {"segment ring", segment_ring},
    {"segment box", segment_box},
    {"segment shell", segment_shell},
    {"snapshot", snapshot},
    {"save and restore", save_and_restore},
    {"handles", handles},
    {"advance", advance_two},
    {"results", results},
};

uint32_t scene_count(void) { return (uint32_t)(sizeof scenes / sizeof *scenes); }

/* ---------------------------------------------------------------- lines */

static char line[128];

static char* put(char* at, const char* text) {
  while (*text != 0) *at++ = *text++;
  return at;
}
static char* put_number(char* at, uint64_t number, uint32_t base, int digits) {
  char reversed[24];
  int n = 0;
  for (; number != 0 || n < digits; number /= base) reversed[n++] = "0123456789abcdef"[number % base];
  while (n > 0) *at++ = reversed[--n];
  return at;
}

const char* scene_line(uint32_t scene) {
  char* at = line;
  hash = UINT64_C(0xcbf29ce484222325);
  status = TPA_OK;
  context = NULL;
  seed_random(scene);
  scenes[scene].run();
  at = put(at, scenes[scene].name);
  at = put(at, ": ");
  if (context != NULL) at = put(put_number(at, view().vertex_count, 10, 1), " vertices, ");
  at = put_number(at, hash, 16, 16);
  at = put(at, status == TPA_OK ? "" : ", failed");
  *at = 0;
  return line;
}

#ifdef SCENES_MAIN
#include <stdio.h>
int main(void) {
  uint32_t i;
  for (i = 0; i < scene_count(); ++i) printf("%s\n", scene_line(i));
  return 0;
}
#endif
