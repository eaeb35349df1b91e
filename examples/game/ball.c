/* SPDX-License-Identifier: MIT */
#include "ball.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SIDE (2 * BALL_PARTS + 1)

/* Vertices of lattice points with |x| + |y| + |z| = BALL_PARTS, by x, y, and whether z is negative. */
typedef uint32_t Ids[SIDE][SIDE][2];

static void add_vertices(Ids ids, double (*directions)[3]) {
  uint32_t count = 0;
  for (int x = -BALL_PARTS; x <= BALL_PARTS; ++x)
    for (int y = -BALL_PARTS; y <= BALL_PARTS; ++y) {
      const int z = BALL_PARTS - abs(x) - abs(y);
      const double length = sqrt((double)(x * x + y * y + z * z));
      uint32_t* id = ids[x + BALL_PARTS][y + BALL_PARTS];
      if (z < 0) continue;
      for (int below = 0; below < (z == 0 ? 1 : 2); ++below) {
        const double direction[3] = {x / length, y / length, (below ? -z : z) / length};
        memcpy(directions[count], direction, sizeof direction);
        id[below] = count++;
      }
      if (z == 0) id[1] = id[0];
    }
}

/* A triangle of one of the eight sides, whose signs are in `side`. */
static void add_triangle(Ids ids, int side, const int corners[3][3], uint32_t* triangle) {
  const int x = side & 1 ? -1 : 1, y = side & 2 ? -1 : 1, below = side & 4 ? 1 : 0;
  const int turned = (x < 0) ^ (y < 0) ^ below;
  for (int i = 0; i < 3; ++i) {
    const int* corner = corners[turned ? 2 - i : i];
    triangle[i] = ids[x * corner[0] + BALL_PARTS][y * corner[1] + BALL_PARTS][below];
  }
}

void ball_make(double (*directions)[3], uint32_t (*triangles)[3]) {
  static Ids ids;
  add_vertices(ids, directions);
  for (int side = 0; side < 8; ++side)
    for (int a = 0; a < BALL_PARTS; ++a)
      for (int b = 0; a + b < BALL_PARTS; ++b) {
        const int c = BALL_PARTS - 1 - a - b;
        const int up[3][3] = {{a + 1, b, c}, {a, b + 1, c}, {a, b, c + 1}};
        const int down[3][3] = {{a + 1, b + 1, c - 1}, {a, b + 1, c}, {a + 1, b, c}};
        add_triangle(ids, side, up, *triangles++);
        if (c > 0) add_triangle(ids, side, down, *triangles++);
      }
}
