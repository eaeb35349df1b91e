/* SPDX-License-Identifier: MIT */
#include "calls.h"

#include <string.h>

#define BLOCK_WORDS (UINT32_C(13) << 16)

static uint64_t blocks[2][BLOCK_WORDS];
double targets[3 * MOST_VERTICES];
tpa_context* context;

/* ---------------------------------------------------------------- digests */

/* FNV-1a, byte by byte, the lowest byte of a number first. */
uint64_t hash;

void add_number(uint64_t number, int bytes) {
  for (; bytes > 0; --bytes, number >>= 8) hash = (hash ^ (number & 255)) * UINT64_C(0x100000001b3);
}
static void add_double(double x) {
  uint64_t bits;
  memcpy(&bits, &x, sizeof bits);
  add_number(bits, 8);
}
void add_doubles(const double* x, size_t count) {
  while (count-- > 0) add_double(*x++);
}
void add_ids(const uint32_t* id, size_t count) {
  while (count-- > 0) add_number(*id++, 4);
}

static void add_maps(void) {
  tpa_vertex_map_view vertices = {0};
  tpa_triangle_map_view triangles = {0};
  uint32_t i;
  vertices.struct_size = sizeof vertices;
  triangles.struct_size = sizeof triangles;
  tpa_vertex_map(context, &vertices);
  tpa_triangle_map(context, &triangles);
  add_ids(vertices.old_to_new, vertices.old_count);
  add_ids(triangles.origins, triangles.new_count);
  for (i = 0; i < vertices.new_count; ++i) {
    add_ids(vertices.origins[i].parents, 2);
    add_double((double)vertices.origins[i].weight);
  }
}

void add_state(void) {
  tpa_mesh_view view = {0};
  const tpa_event* events;
  const uint32_t* kept;
  uint32_t count, i;
  view.struct_size = sizeof view;
  if (tpa_view(context, &view) != TPA_OK) return;
  add_doubles(view.positions, 3 * (size_t)view.vertex_count);
  add_ids(view.triangles, 3 * (size_t)view.triangle_count);
  tpa_events(context, &events, &count);
  for (i = 0; i < count; ++i) {
    add_number((uint64_t)(int64_t)events[i].type, 4);
    add_ids(&events[i].amount, 1);
    add_ids(&events[i].before, 1);
    add_ids(&events[i].after, 1);
    add_doubles(events[i].position, 3);
  }
  tpa_rolled_back(context, &kept, &count);
  add_ids(kept, count);
  add_maps();
}

static void add_report(const tpa_report* r) {
  add_ids(&r->passes, 3);
  add_ids(r->handles, 4);
  add_ids(&r->caps, 10);
  add_doubles(&r->approach, 1);
  add_doubles(&r->region_before, 2);
  add_doubles(&r->region_lost, 3);
}

/* ---------------------------------------------------------------- calls */

/* For each call that takes a tpa_exec. */
int counts_units = 1;
static uint64_t units;
static const tpa_exec work = {.struct_size = sizeof work, .progress = &units};
static void add_units(void) {
  if (counts_units) add_number(units, 8);
}

tpa_status status;
tpa_issue issue;

void note(tpa_status s) {
  add_number((uint64_t)(int64_t)s, 4);
  if (status == TPA_OK) status = s;
}

void* block(int i) { return blocks[i]; }

size_t block_bytes(void) { return sizeof blocks[0]; }

tpa_config config_for(const struct mesh* mesh) {
  tpa_config config;
  note(tpa_config_init(&config, sizeof config));
  config.max_vertices = 3 * mesh->vertices + 600;
  config.max_contacts = 5000;
  config.max_pieces = 20000;
  return config;
}

void load(const struct mesh* mesh, const tpa_config* config) {
  tpa_mesh_input input = {0};
  note(tpa_init(block(0), block_bytes(), config, &context, &issue));
  input.struct_size = sizeof input;
  input.vertex_count = mesh->vertices;
  input.triangle_count = mesh->triangles;
  input.position_type = TPA_FLOAT64;
  input.index_type = TPA_UINT32;
  input.positions = mesh->position;
  input.triangles = mesh->triangle;
  if (status == TPA_OK) note(tpa_load(context, &input, &issue));
}

void load_plainly(const struct mesh* mesh) {
  const tpa_config config = config_for(mesh);
  load(mesh, &config);
}

tpa_mesh_view view(void) {
  tpa_mesh_view v = {0};
  v.struct_size = sizeof v;
  tpa_view(context, &v);
  return v;
}

void detect(void) {
  tpa_contacts contacts = {0};
  uint32_t i;
  contacts.struct_size = sizeof contacts;
  note(tpa_detect(context, &work, &contacts, &issue));
  add_units();
  for (i = 0; i < contacts.count; ++i) {
    add_ids(&contacts.pairs[i].a, 1);
    add_ids(&contacts.pairs[i].b, 1);
  }
}

void adapt(void) {
  tpa_report report = {0};
  report.struct_size = sizeof report;
  note(tpa_adapt(context, &work, &report, &issue));
  add_units();
  add_report(&report);
  add_state();
}

void step(void) {
  tpa_move_input move = {0};
  tpa_report report = {0};
  move.struct_size = sizeof move;
  move.count = view().vertex_count;
  move.position_type = TPA_FLOAT64;
  move.positions = targets;
  report.struct_size = sizeof report;
  note(tpa_move(context, &move, &issue));
  note(tpa_step(context, &work, &report, &issue));
  add_units();
  add_report(&report);
  add_state();
}

void advance(double thickness) {
  const uint32_t count = view().vertex_count;
  tpa_move_input move = {0};
  tpa_report report = {0};
  move.struct_size = sizeof move;
  move.count = count;
  move.position_type = TPA_FLOAT64;
  move.positions = targets;
  note(tpa_move(context, &move, &issue));
  report.struct_size = sizeof report;
  note(tpa_advance(context, thickness, &work, &report, &issue));
  add_units();
  add_report(&report);
  add_ids(&report.substeps, 1);
  add_state();
}

void remesh(double length, uint32_t iterations) {
  tpa_remesh_options options = {0};
  tpa_report report = {0};
  options.struct_size = sizeof options;
  options.iterations = iterations;
  options.target_length = length;
  options.relaxation = 0.5;
  report.struct_size = sizeof report;
  note(tpa_remesh(context, &options, &work, &report, &issue));
  add_units();
  add_report(&report);
  add_state();
}

void smooth(uint32_t iterations, const uint32_t* vertices, uint32_t count) {
  tpa_smooth_options options = {0};
  tpa_report report = {0};
  options.struct_size = sizeof options;
  options.iterations = iterations;
  options.vertices = vertices;
  options.count = count;
  report.struct_size = sizeof report;
  note(tpa_smooth(context, &options, &work, &report, &issue));
  add_units();
  add_report(&report);
  add_state();
}

void validate(void) {
  tpa_validation v = {0};
  v.struct_size = sizeof v;
  note(tpa_validate(context, &work, &v, &issue));
  add_units();
  add_ids(&v.components, 1);
  add_number((uint64_t)(int64_t)v.genus, 8);
  add_number(v.self_intersections, 8);
  add_doubles(&v.volume, 2);
}
