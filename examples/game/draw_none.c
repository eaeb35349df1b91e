/* SPDX-License-Identifier: MIT */
#include <stdio.h>

#include "draw.h"

int draw_is_possible(void) {
  fprintf(stderr, "game: built without SDL 2: no pictures\n");
  return 0;
}

Window* draw_open(void) { return NULL; }

int draw_frame(Window* window, const Gpu* gpu, const World* world) { return (void)window, (void)gpu, (void)world, 1; }

void draw_close(Window* window) { (void)window; }

int draw_picture(const Gpu* const* gpus, int count, const World* world, const char* path) {
  return (void)gpus, (void)count, (void)world, (void)path, 0;
}
