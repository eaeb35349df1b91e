/* SPDX-License-Identifier: MIT */
#include "world.h"

#include <math.h>

static const double room[3] = {2.4, 1.5, 0.8}; /* half of its sides, for all hearts */
static const double ball_reach = 1;            /* of a heart; surfaces of a lone heart lie at 0.6 of it */
static const double brush_reach = 0.6;
static const double brush_force = 3;
static const double level = 0.25;
/* Parts of an edge. */
static const double fastest = 0.25;   /* of a surface, for a frame */
static const double trip_speed = 0.1; /* on average; at most half as much again */
static const double rest = 0.01;      /* shorter ways are none */

/* Uniform in -1 .. 1, by a linear congruence. */
static double throw_dice(World* world) {
  world->dice = world->dice * 1664525u + 1013904223u;
  return (double)(world->dice >> 8) / (1 << 23) - 1;
}

static double squared_distance(const double a[3], const double b[3]) {
  double sum = 0;
  for (int i = 0; i < 3; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

/* Along the trip, gently at both ends. */
static void travel(Traveller* t, uint32_t frame) {
  double part = frame < t->arrived ? (double)(frame - t->begun) / (t->arrived - t->begun) : 1;
  part = part * part * (3 - 2 * part);
  for (int i = 0; i < 3; ++i) t->at[i] = t->from[i] + part * (t->to[i] - t->from[i]);
}

/* Surfaces must be able to keep up. */
static void set_out(Traveller* t, uint32_t frame, double edge) {
  t->begun = frame;
  t->arrived = frame + 1 + (uint32_t)(sqrt(squared_distance(t->from, t->to)) / (trip_speed * edge));
}

/* A heart at rest goes to a place anywhere in the room. */
static void send_heart(World* world) {
  Traveller* heart = &world->hearts[world->frame / FRAMES_PER_SECOND % world->blobs];
  const double part = sqrt((double)world->blobs / HEARTS);
  if (world->frame < heart->arrived) return;
  for (int i = 0; i < 3; ++i) {
    heart->from[i] = heart->at[i];
    heart->to[i] = part * room[i] * throw_dice(world);
  }
  set_out(heart, world->frame, world->edge);
}

/* A stroke of the brush passes near some heart, from one side to the other. */
static void begin_stroke(World* world) {
  Traveller* brush = &world->brush;
  const Traveller* victim = &world->hearts[(world->dice >> 10) % world->blobs];
  double direction[3], norm = 0;
  for (int i = 0; i < 3; ++i) {
    direction[i] = throw_dice(world);
    norm += direction[i] * direction[i];
  }
  norm = sqrt(norm) + 0.001;
  for (int i = 0; i < 3; ++i) {
    const double beside = 0.25 * throw_dice(world);
    brush->from[i] = victim->at[i] + beside + 1.6 / norm * direction[i];
    brush->to[i] = victim->at[i] + beside - 1.6 / norm * direction[i];
  }
  set_out(brush, world->frame, world->edge);
}

void world_start(World* world, uint32_t blobs, double edge) {
  const World nothing = {.blobs = blobs, .edge = edge, .dice = 44};
  *world = nothing;
  for (uint32_t h = 0; h < blobs; ++h) {
    Traveller* heart = &world->hearts[h];
    heart->at[0] = 1.5 * (h % 4) - 2.25;
    heart->at[1] = h < 4 ? -0.75 : 0.75;
    for (int i = 0; i < 3; ++i) heart->from[i] = heart->to[i] = heart->at[i];
  }
}

void world_next(World* world) {
  ++world->frame;
  if (world->frame % FRAMES_PER_SECOND == 0) send_heart(world);
  if (world->frame % (6 * FRAMES_PER_SECOND) == 0) begin_stroke(world);
  for (uint32_t h = 0; h < world->blobs; ++h) travel(&world->hearts[h], world->frame);
  travel(&world->brush, world->frame);
}

/* Adds force * (1 - q)^3 with q = (distance / reach)^2, and the gradient. Returns the squared distance. */
static double add_ball(const double centre[3], double reach, double force, const double point[3], double* sum,
                       double gradient[3]) {
  const double squared = squared_distance(centre, point), rest_of = 1 - squared / (reach * reach);
  if (rest_of <= 0) return squared;
  *sum += force * rest_of * rest_of * rest_of;
  for (int i = 0; i < 3; ++i) gradient[i] -= 6 * force * rest_of * rest_of / (reach * reach) * (point[i] - centre[i]);
  return squared;
}

double world_way(const World* world, const double point[3], double way[3]) {
  uint32_t nearest = 0;
  double sum = 0, gradient[3] = {0, 0, 0}, least = HUGE_VAL, steepness = 0, length;
  for (uint32_t h = 0; h < world->blobs; ++h) {
    const double squared = add_ball(world->hearts[h].at, ball_reach, 1, point, &sum, gradient);
    if (squared >= least) continue;
    least = squared;
    nearest = h;
  }
  if (world->frame < world->brush.arrived) add_ball(world->brush.at, brush_reach, -brush_force, point, &sum, gradient);
  /* Far from all hearts: to the nearest. */
  if (sum < 0.01 && !world_carves(world, point))
    for (int i = 0; i < 3; ++i) gradient[i] = world->hearts[nearest].at[i] - point[i];
  for (int i = 0; i < 3; ++i) steepness += gradient[i] * gradient[i];
  steepness = sqrt(steepness);
  if (steepness == 0) return 0;
  length = (level - sum) / steepness;
  if (length > fastest * world->edge) length = fastest * world->edge;
  if (length < -fastest * world->edge) length = -fastest * world->edge;
  if (fabs(length) < rest * world->edge) return 0;
  for (int i = 0; i < 3; ++i) way[i] = length / steepness * gradient[i];
  return fabs(length);
}

int world_carves(const World* world, const double point[3]) {
  return world->frame < world->brush.arrived && squared_distance(world->brush.at, point) < brush_reach * brush_reach;
}
