/* SPDX-License-Identifier: MIT */
/* Calls of the library in static memory, with a digest of all results, and of the units of work. */
#ifndef TOPOADAPT_SCENE_CALLS_H
#define TOPOADAPT_SCENE_CALLS_H

#include <stddef.h>

#include "meshes.h"
#include "topoadapt.h"

extern tpa_context* context;
extern double targets[3 * MOST_VERTICES]; /* of step() */
extern uint64_t hash;
extern tpa_status status; /* the first that is not TPA_OK */
extern tpa_issue issue;   /* of the last call */
extern int counts_units;  /* 1; with 0 units are no part of the digest */

void add_number(uint64_t number, int bytes);
void add_doubles(const double* x, size_t count);
void add_ids(const uint32_t* id, size_t count);
/* Mesh, events, maps and vertices left behind. */
void add_state(void);
void note(tpa_status s);

/* Block 0 or 1, and the bytes of a block. */
void* block(int i);
size_t block_bytes(void);
/* Room for three times the mesh, and for many contacts. */
tpa_config config_for(const struct mesh* mesh);
/* A new context with the mesh. */
void load(const struct mesh* mesh, const tpa_config* config);
void load_plainly(const struct mesh* mesh);
tpa_mesh_view view(void);
void detect(void);
void adapt(void);
/* A step to targets[]. */
void step(void);
/* The same in sub-steps. */
void advance(double thickness);
void remesh(double length, uint32_t iterations);
void smooth(uint32_t iterations, const uint32_t* vertices, uint32_t count);
void validate(void);

#endif
