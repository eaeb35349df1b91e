/* SPDX-License-Identifier: MIT */
/* Draws what the buffers of the graphics processor hold: with SDL 2 (draw_sdl.c), or not at all (draw_none.c). */
#ifndef GAME_DRAW_H
#define GAME_DRAW_H

#include "gpu.h"
#include "world.h"

typedef struct Window Window;

/* Is there something to draw with? Says so if not. */
int draw_is_possible(void);
/* NULL after a failure, which is printed. */
Window* draw_open(void);
/* Shows a frame when its sixtieth of a second has come. Returns 0 if the player closes the window. */
int draw_frame(Window* window, const Gpu* gpu, const World* world);
void draw_close(Window* window);
/* Writes a frame as a BMP image, without a screen; buffers of several games beside each other. Returns 0 after a
 * failure, which is printed. */
int draw_picture(const Gpu* const* gpus, int count, const World* world, const char* path);

#endif
