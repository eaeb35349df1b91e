/* SPDX-License-Identifier: MIT */
#include "meshes.h"

#include <stddef.h>
#include <string.h>

static struct mesh mesh_of_scene;

struct mesh* clear_mesh(void) {
  mesh_of_scene.vertices = mesh_of_scene.triangles = 0;
  return &mesh_of_scene;
}

static uint64_t state;
void seed_random(uint64_t seed) { state = seed * UINT64_C(0x9e3779b97f4a7c15) + 1; }
double random_number(void) {
  state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
  return (double)(int32_t)(uint32_t)(state >> 32) / 2147483648.0;
}

double squared_length(const double* v) { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; }
/* The compiler's own root, since a platform may have no library: an instruction, or a call of sqrt(). */
double length_of(const double* v) { return __builtin_sqrt(squared_length(v)); }

void triangle_normal(const double* a, const double* b, const double* c, double* normal) {
  int i;
  for (i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    normal[i] = (b[j] - a[j]) * (c[k] - a[k]) - (b[k] - a[k]) * (c[j] - a[j]);
  }
}

/* The vertex at p, made when it is met for the first time since vertex `first`. */
static uint32_t vertex_at(struct mesh* mesh, uint32_t first, const double* p) {
  uint32_t v;
  for (v = first; v < mesh->vertices; ++v)
    if (memcmp(mesh->position + 3 * (size_t)v, p, 3 * sizeof *p) == 0) return v;
  memcpy(mesh->position + 3 * (size_t)v, p, 3 * sizeof *p);
  return mesh->vertices++;
}

static void add_triangle(struct mesh* mesh, uint32_t a, uint32_t b, uint32_t c) {
  uint32_t* t = mesh->triangle + 3 * (size_t)mesh->triangles++;
  t[0] = a, t[1] = b, t[2] = c;
}
/* a b c d counter-clockwise. */
static void add_square(struct mesh* mesh, const uint32_t* v) {
  add_triangle(mesh, v[0], v[1], v[2]);
  add_triangle(mesh, v[0], v[2], v[3]);
}

/* A face of a cube of -1 .. 1: `axis` is across it, on `side` 1 or -1. Corner of a square, in parts. */
static void point_of_cube(int axis, int side, int i, int j, int parts, double* p) {
  const double u = 2.0 * i / parts - 1, w = 2.0 * j / parts - 1;
  p[axis] = side;
  p[(axis + 1) % 3] = side > 0 ? u : w;
  p[(axis + 2) % 3] = side > 0 ? w : u;
  for (i = 0; i < 3; ++i) p[i] += 0.0; /* no -0 */
}

/* place: from a point of the cube to the vertex. */
static void add_cube(struct mesh* mesh, int parts, void (*place)(const double* at, const double* size, double* p),
                     const double* at, const double* size) {
  const uint32_t first = mesh->vertices;
  int face, i, j, k;
  for (face = 0; face < 6; ++face)
    for (i = 0; i < parts; ++i)
      for (j = 0; j < parts; ++j) {
        static const int corner[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        uint32_t v[4];
        for (k = 0; k < 4; ++k) {
          double p[3];
          point_of_cube(face / 2, face % 2 ? 1 : -1, i + corner[k][0], j + corner[k][1], parts, p);
          place(at, size, p);
          v[k] = vertex_at(mesh, first, p);
        }
        add_square(mesh, v);
      }
}

static void on_sphere(const double* at, const double* size, double* p) {
  const double scale = size[0] / length_of(p);
  int i;
  for (i = 0; i < 3; ++i) p[i] = at[i] + scale * p[i];
}
static void on_box(const double* at, const double* size, double* p) {
  int i;
  for (i = 0; i < 3; ++i) p[i] = at[i] + size[i] * (0.5 * p[i] + 0.5);
}

void add_sphere(struct mesh* mesh, double x, double y, double z, double radius, int parts) {
  const double at[3] = {x, y, z}, size[3] = {radius, 0, 0};
  add_cube(mesh, parts, on_sphere, at, size);
}
void add_box(struct mesh* mesh, double x0, double y0, double z0, double x1, double y1, double z1, int parts) {
  const double at[3] = {x0, y0, z0}, size[3] = {x1 - x0, y1 - y0, z1 - z0};
  add_cube(mesh, parts, on_box, at, size);
}

/* Point i of n on the unit circle, by its rational parameter: a half circle for each half of the points. */
static void on_circle(int i, int n, double* x, double* y) {
  const int half = n / 2;
  const double side = i < half ? 1 : -1, t = 2.0 * (i % half) / half - 1;
  *x = -side * 2 * t / (1 + t * t);
  *y = side * (1 - t * t) / (1 + t * t);
}

void add_torus(struct mesh* mesh, double radius, double tube, int around, int across) {
  const uint32_t first = mesh->vertices;
  int i, j;
  for (i = 0; i < around; ++i)
    for (j = 0; j < across; ++j) {
      double* p = mesh->position + 3 * (size_t)mesh->vertices++;
      double x, y, in, up;
      on_circle(i, around, &x, &y);
      on_circle(j, across, &in, &up);
      p[0] = (radius + tube * in) * x, p[1] = (radius + tube * in) * y, p[2] = tube * up;
    }
  for (i = 0; i < around; ++i)
    for (j = 0; j < across; ++j) {
      const int i1 = (i + 1) % around, j1 = (j + 1) % across;
      uint32_t v[4];
      v[0] = first + (uint32_t)(i * across + j);
      v[1] = first + (uint32_t)(i1 * across + j);
      v[2] = first + (uint32_t)(i1 * across + j1);
      v[3] = first + (uint32_t)(i * across + j1);
      add_square(mesh, v);
    }
}

void turn_inside_out(struct mesh* mesh) {
  uint32_t t;
  for (t = 0; t < mesh->triangles; ++t) {
    uint32_t* v = mesh->triangle + 3 * (size_t)t;
    const uint32_t b = v[1];
    v[1] = v[2], v[2] = b;
  }
}
