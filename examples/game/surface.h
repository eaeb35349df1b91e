/* SPDX-License-Identifier: MIT */
/* The surfaces of all blobs: a context of topoadapt, attributes that follow it, and copies of what changed to the
 * graphics processor. */
#ifndef GAME_SURFACE_H
#define GAME_SURFACE_H

#include <topoadapt.h>

#include "gpu.h"
#include "world.h"

#define MOST_VERTICES 20000
#define MOST_TRIANGLES (2 * MOST_VERTICES)
#define FLOATS 5 /* of a vertex that follow: red, green, blue, u, v */

typedef struct {
  tpa_context* context;
  void* block;
  float *attributes, *before;      /* FLOATS for each vertex, now and before the last commit */
  uint8_t *owners, *owners_before; /* the heart for each vertex whose colour the vertex had first */
  double* targets;                 /* of the vertices that move; all positions for a load */
  uint32_t* corners;               /* of all triangles for a load */
  uint32_t* movers;                /* the vertices that move */
  GpuVertex* packed;               /* for a copy */
  uint32_t late_frames;            /* in a row up to now, with vertices held back for want of units */
} Surface;

/* All that has happened since the start. */
typedef struct {
  uint64_t merges, splits, genus_up, genus_down, deaths, left_behind;
  uint64_t revived;   /* balls for hearts that had lost their own */
  uint64_t held_back; /* frames that held vertices back for want of units */
  uint32_t latest;    /* the most such frames in a row */
  uint64_t put_off;   /* remeshings that went on in a later frame */
} Story;

/* A ball round each heart. Returns 0 after a failure, which is printed. surface_end() frees in any case. */
int surface_start(Surface* surface, const World* world, Gpu* gpu);
void surface_end(Surface* surface);
/* Follows the world for a frame, within `budget` units of work; *units receives those spent. Where the budget does not
 * suffice, vertices stay behind for a frame. Returns 0 after any other failure, which is printed. */
int surface_frame(Surface* surface, const World* world, Gpu* gpu, uint64_t budget, uint64_t* units, Story* story);
/* Do the buffers of the graphics processor hold the whole mesh, bit for bit? */
int surface_is_shown(Surface* surface, const Gpu* gpu);

#endif
