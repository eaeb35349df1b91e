/* SPDX-License-Identifier: MIT */
/* The same game without a bound on its work, played beside the one that has a budget: how far the two are apart. */
#ifndef GAME_TWIN_H
#define GAME_TWIN_H

#include "surface.h"

#define MOST_FRAMES_APART FRAMES_PER_SECOND

typedef struct {
  Surface surface;
  Gpu gpu;
  Story story;
  uint64_t dearest;     /* units of its dearest frame */
  uint32_t frames;      /* with other components or another genus than the game's */
  uint32_t row;         /* such frames in a row up to now */
  uint32_t longest_row; /* and the most of them */
  uint32_t frame_apart; /* the last frame of the longest row */
  double volume;        /* the largest difference of volumes in a frame, as a part of the twin's */
} Twin;

/* Returns 0 after a failure, which is printed. twin_end() frees in any case. */
int twin_start(Twin* twin, const World* world);
void twin_end(Twin* twin);
/* Plays a frame, and compares with the game, which has played it. Returns 0 after a failure, which is printed. */
int twin_frame(Twin* twin, const World* world, const Surface* game);
/* Prints what was found. Was the game late by a second at most, and is at the end what its twin is? */
int twin_agrees(const Twin* twin);

#endif
