/* SPDX-License-Identifier: MIT */
#include <SDL.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "draw.h"

#define WIDTH 960
#define HEIGHT 600
#define SCALE 140.0f      /* points for a unit at the middle of the room */
#define DISTANCE 6.0f     /* of the eye from the middle */
#define CHECKERS 25.1327f /* 8 pi: checkers for each unit of a texture coordinate, times pi */
#define LATE_FRAMES 10    /* so many frames late, the clock starts anew */

struct Window {
  SDL_Window* window;
  SDL_Surface* canvas; /* of a picture, in place of a window */
  SDL_Renderer* renderer;
  Uint64 next_frame; /* when to show it, by SDL_GetPerformanceCounter */
};

typedef struct {
  float depth;
  uint32_t corners[3];
} Visible;

static void* fail(const char* what) {
  fprintf(stderr, "game: %s: %s\n", what, SDL_GetError());
  return NULL;
}

int draw_is_possible(void) { return 1; }

static Window* finish(Window* w) {
  if (w->renderer != NULL) return w;
  draw_close(w);
  return fail("no renderer");
}

Window* draw_open(void) {
  if (SDL_Init(SDL_INIT_VIDEO) != 0) return fail("no screen");
  Window* w = calloc(1, sizeof *w);
  if (w == NULL) return NULL;
  w->window = SDL_CreateWindow("topoadapt", SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, WIDTH, HEIGHT, 0);
  if (w->window != NULL) w->renderer = SDL_CreateRenderer(w->window, -1, 0);
  w->next_frame = SDL_GetPerformanceCounter();
  return finish(w);
}

void draw_close(Window* w) {
  if (w == NULL) return;
  SDL_DestroyRenderer(w->renderer);
  SDL_FreeSurface(w->canvas);
  SDL_DestroyWindow(w->window);
  free(w);
  SDL_Quit();
}

/* ---------------------------------------------------------------- a picture of the buffers */

static Uint8 shade(float colour, float light) { return (Uint8)(255 * colour * light); }

/* Sums of the normals of a vertex's triangles. */
static void add_normals(const Gpu* gpu, const GpuVertex* vertices, const uint32_t* triangles, float (*normals)[3]) {
  for (uint32_t t = 0; t < gpu->triangle_count; ++t, triangles += 3) {
    const float *a = vertices[triangles[0]].place, *b = vertices[triangles[1]].place, *c = vertices[triangles[2]].place;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const float part = (b[j] - a[j]) * (c[k] - a[k]) - (b[k] - a[k]) * (c[j] - a[j]);
      for (int corner = 0; corner < 3; ++corner) normals[triangles[corner]][i] += part;
    }
  }
}

/* Soft checkers show that texture coordinates follow the surface. They are looked up at the vertices: between balls
 * that have met, coordinates run from the end of one texture to the begin of another within a triangle, and pixel by
 * pixel all checkers between would be squeezed into a band. */
static float checker(const float texture[2]) {
  return 0.88f + 0.12f * sinf(CHECKERS * texture[0]) * sinf(CHECKERS * texture[1]);
}

/* The eye looks along -z, from DISTANCE before the middle; light comes from above on the left. */
static void project(const GpuVertex* v, const float normal[3], SDL_Vertex* out) {
  const float length = sqrtf(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]) + 1e-12f;
  const float towards = (-0.4f * normal[0] + 0.6f * normal[1] + 0.7f * normal[2]) / length;
  const float light = (towards > 0 ? 0.3f + 0.7f * towards / 1.01f : 0.3f) * checker(v->texture);
  const float scale = SCALE * DISTANCE / (DISTANCE - v->place[2]);
  out->position.x = WIDTH / 2 + scale * v->place[0];
  out->position.y = HEIGHT / 2 - scale * v->place[1];
  out->color.r = shade(v->colour[0], light);
  out->color.g = shade(v->colour[1], light);
  out->color.b = shade(v->colour[2], light);
  out->color.a = 255;
  out->tex_coord.x = out->tex_coord.y = 0;
}

static int far_first(const void* a, const void* b) {
  const float x = ((const Visible*)a)->depth, y = ((const Visible*)b)->depth;
  return (x > y) - (x < y);
}

/* The triangles that face the eye, the farthest first. */
static uint32_t sort_triangles(const Gpu* gpu, const GpuVertex* vertices, const uint32_t* triangles,
                               const SDL_Vertex* seen, Visible* visible) {
  uint32_t count = 0;
  for (uint32_t t = 0; t < gpu->triangle_count; ++t, triangles += 3) {
    const SDL_FPoint a = seen[triangles[0]].position, b = seen[triangles[1]].position, c = seen[triangles[2]].position;
    if ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) >= 0) continue;
    Visible* v = &visible[count++];
    v->depth = 0;
    for (int i = 0; i < 3; ++i) {
      v->corners[i] = triangles[i];
      v->depth += vertices[triangles[i]].place[2];
    }
  }
  qsort(visible, count, sizeof *visible, far_first);
  return count;
}

static void draw_triangles(const Window* w, const Gpu* gpu, SDL_Vertex* seen, float (*normals)[3], Visible* visible,
                           int* indices) {
  const GpuVertex* vertices = (const GpuVertex*)(const void*)gpu->vertices.bytes;
  const uint32_t* triangles = (const uint32_t*)(const void*)gpu->triangles.bytes;
  add_normals(gpu, vertices, triangles, normals);
  for (uint32_t v = 0; v < gpu->vertex_count; ++v) project(&vertices[v], normals[v], &seen[v]);
  const uint32_t count = sort_triangles(gpu, vertices, triangles, seen, visible);
  for (uint32_t i = 0; i < 3 * count; ++i) indices[i] = (int)visible[i / 3].corners[i % 3];
  SDL_RenderGeometry(w->renderer, NULL, seen, (int)gpu->vertex_count, indices, (int)(3 * count));
}

/* The brush as a cross. */
static void draw_brush(const Window* w, const World* world) {
  const float scale = SCALE * DISTANCE / (DISTANCE - (float)world->brush.at[2]);
  const float x = WIDTH / 2 + scale * (float)world->brush.at[0], y = HEIGHT / 2 - scale * (float)world->brush.at[1];
  if (!world_carves(world, world->brush.at)) return;
  SDL_SetRenderDrawColor(w->renderer, 200, 0, 0, 255);
  SDL_RenderDrawLineF(w->renderer, x - 12, y, x + 12, y);
  SDL_RenderDrawLineF(w->renderer, x, y - 12, x, y + 12);
}

static void clear(const Window* w) {
  SDL_SetRenderDrawColor(w->renderer, 245, 245, 240, 255);
  SDL_RenderClear(w->renderer);
}

static int draw(const Window* w, const Gpu* gpu, const World* world) {
  SDL_Vertex* seen = calloc(gpu->vertex_count + 1, sizeof *seen);
  float(*normals)[3] = calloc(gpu->vertex_count + 1, sizeof *normals);
  Visible* visible = calloc(gpu->triangle_count + 1, sizeof *visible);
  int* indices = calloc(3 * gpu->triangle_count + 1, sizeof *indices);
  const int good = seen != NULL && normals != NULL && visible != NULL && indices != NULL;
  if (good) draw_triangles(w, gpu, seen, normals, visible, indices);
  draw_brush(w, world);
  free(indices);
  free(visible);
  free(normals);
  free(seen);
  return good;
}

/* ---------------------------------------------------------------- the screen, and files */

/* Until the next sixtieth of a second. */
static void wait_for_frame(Window* w) {
  const Uint64 second = SDL_GetPerformanceFrequency(), length = second / FRAMES_PER_SECOND;
  Uint64 now = SDL_GetPerformanceCounter();
  while (now < w->next_frame) {
    SDL_Delay((Uint32)((w->next_frame - now) * 1000 / second) + 1);
    now = SDL_GetPerformanceCounter();
  }
  w->next_frame = now > w->next_frame + LATE_FRAMES * length ? now + length : w->next_frame + length;
}

int draw_frame(Window* w, const Gpu* gpu, const World* world) {
  SDL_Event event;
  while (SDL_PollEvent(&event))
    if (event.type == SDL_QUIT || (event.type == SDL_KEYDOWN && event.key.keysym.sym == SDLK_ESCAPE)) return 0;
  clear(w);
  draw(w, gpu, world);
  wait_for_frame(w);
  SDL_RenderPresent(w->renderer);
  return 1;
}

int draw_picture(const Gpu* const* gpus, int count, const World* world, const char* path) {
  Window* w = calloc(1, sizeof *w);
  int good = 1;
  if (w == NULL) return 0;
  w->canvas = SDL_CreateRGBSurfaceWithFormat(0, count * WIDTH, HEIGHT, 32, SDL_PIXELFORMAT_ARGB8888);
  if (w->canvas != NULL) w->renderer = SDL_CreateSoftwareRenderer(w->canvas);
  if ((w = finish(w)) == NULL) return 0;
  clear(w);
  for (int i = 0; i < count && good; ++i) {
    const SDL_Rect part = {i * WIDTH, 0, WIDTH, HEIGHT};
    SDL_RenderSetViewport(w->renderer, &part);
    good = draw(w, gpus[i], world);
  }
  SDL_RenderPresent(w->renderer);
  good = good && SDL_SaveBMP(w->canvas, path) == 0;
  if (!good) fail(path);
  draw_close(w);
  return good;
}
