/* SPDX-License-Identifier: MIT */
/* Meshes of the scenes, by + - * / and roots alone. */
#ifndef TOPOADAPT_SCENE_MESHES_H
#define TOPOADAPT_SCENE_MESHES_H

#include <stdint.h>

#define MOST_VERTICES 6000
#define MOST_TRIANGLES 4000

struct mesh {
  uint32_t vertices, triangles;
  double position[3 * MOST_VERTICES];
  uint32_t triangle[3 * MOST_TRIANGLES];
};

/* The one mesh of the program, empty. */
struct mesh* clear_mesh(void);
void add_sphere(struct mesh* mesh, double x, double y, double z, double radius, int parts);
/* Square faces with parts x parts squares each. */
void add_box(struct mesh* mesh, double x0, double y0, double z0, double x1, double y1, double z1, int parts);
/* Round the z axis. `around` and `across` are even. */
void add_torus(struct mesh* mesh, double radius, double tube, int around, int across);
void turn_inside_out(struct mesh* mesh);

double squared_length(const double* v);
double length_of(const double* v);
/* The length is twice the area. */
void triangle_normal(const double* a, const double* b, const double* c, double* normal);

void seed_random(uint64_t seed);
/* -1 .. 1 */
double random_number(void);

#endif
