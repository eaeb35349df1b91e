/* SPDX-License-Identifier: MIT */
#include "twin.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define MOST_COMPONENTS 1000

typedef struct {
  uint32_t components;
  int64_t genus;
  double volume;
} Shape;

static Shape shape_of(const Surface* s) {
  static tpa_component components[MOST_COMPONENTS];
  Shape shape = {0, 0, 0};
  if (tpa_components(s->context, components, MOST_COMPONENTS, NULL, &shape.components, NULL) != TPA_OK) return shape;
  for (uint32_t c = 0; c < shape.components; ++c) {
    shape.genus += components[c].genus;
    shape.volume += components[c].volume;
  }
  return shape;
}

int twin_start(Twin* t, const World* world) {
  memset(t, 0, sizeof *t);
  return gpu_start(&t->gpu, MOST_VERTICES, MOST_TRIANGLES) && surface_start(&t->surface, world, &t->gpu);
}

void twin_end(Twin* t) {
  surface_end(&t->surface);
  gpu_end(&t->gpu);
}

int twin_frame(Twin* t, const World* world, const Surface* game) {
  uint64_t units;
  if (!surface_frame(&t->surface, world, &t->gpu, UINT64_MAX, &units, &t->story)) return 0;
  if (units > t->dearest) t->dearest = units;
  const Shape free = shape_of(&t->surface), bounded = shape_of(game);
  const double difference = fabs(bounded.volume - free.volume) / (fabs(free.volume) + 1e-12);
  if (difference > t->volume) t->volume = difference;
  if (bounded.components == free.components && bounded.genus == free.genus) {
    t->row = 0;
    return 1;
  }
  ++t->frames;
  if (++t->row <= t->longest_row) return 1;
  t->longest_row = t->row;
  t->frame_apart = world->frame;
  return 1;
}

int twin_agrees(const Twin* t) {
  printf("%-10s dearest frame %" PRIu64 " units, %" PRIu64 " merges, %" PRIu64 " splits\n", "unbounded", t->dearest,
         t->story.merges, t->story.splits);
  printf("%-10s %" PRIu32 " frames, %" PRIu32 " in a row at most, up to frame %" PRIu32 "; %" PRIu32
         " at the end; volume %.2f %% at most\n",
         "apart", t->frames, t->longest_row, t->frame_apart, t->row, 100 * t->volume);
  return t->longest_row <= MOST_FRAMES_APART && t->row == 0;
}
