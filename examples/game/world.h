/* SPDX-License-Identifier: MIT */
/* The rules of the game: hearts wander through a room, and a brush carves. Each heart makes a soft ball round itself;
 * surfaces follow the level of the sum. Blobs merge where balls meet, and split where hearts part. The brush takes from
 * the sum as long as it is there; wounds heal. Only + - * / and sqrt: the same game on every machine. */
#ifndef GAME_WORLD_H
#define GAME_WORLD_H

#include <stdint.h>

#define HEARTS 8 /* at most */
#define FRAMES_PER_SECOND 60

typedef struct {
  double at[3];            /* now */
  double from[3], to[3];   /* the trip */
  uint32_t begun, arrived; /* frames of the trip */
} Traveller;

typedef struct {
  Traveller hearts[HEARTS];
  uint32_t blobs;  /* hearts in use */
  double edge;     /* length of the edges of surfaces */
  Traveller brush; /* carves while it travels */
  uint32_t frame;
  uint32_t dice; /* of the next random number */
} World;

/* The room of eight hearts is some six wide, and smaller for fewer. */
void world_start(World* world, uint32_t blobs, double edge);
/* A frame further. */
void world_next(World* world);
/* The way of a surface's point in this frame, at most a part of an edge. Returns its length; 0 for a point at rest. */
double world_way(const World* world, const double point[3], double way[3]);
/* Does the brush touch the point? */
int world_carves(const World* world, const double point[3]);

#endif
