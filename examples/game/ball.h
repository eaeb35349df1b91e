/* SPDX-License-Identifier: MIT */
/* A ball of even triangles: a divided octahedron, its points drawn out to the sphere. */
#ifndef GAME_BALL_H
#define GAME_BALL_H

#include <stdint.h>

#define BALL_PARTS 10 /* of an edge of the octahedron */
#define BALL_VERTICES (4 * BALL_PARTS * BALL_PARTS + 2)
#define BALL_TRIANGLES (8 * BALL_PARTS * BALL_PARTS)

/* Unit vectors to BALL_VERTICES points, and BALL_TRIANGLES triangles, counter-clockwise seen from outside. */
void ball_make(double (*directions)[3], uint32_t (*triangles)[3]);

#endif
