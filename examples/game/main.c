/* SPDX-License-Identifier: MIT */
/* A game's loop at 60 frames per second over surfaces that merge, split and are carved, within so much work for each
 * frame.
 *
 *     game [--frames N] [--budget UNITS] [--blobs N] [--edge LENGTH] [--twin] [--window] [--picture FILE.bmp]
 *
 * Without --window all frames follow each other at once. The end of the run is the same with and without. --twin plays
 * the same game without a bound beside it, and compares both in each frame; the picture shows it on the right. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "draw.h"
#include "surface.h"
#include "twin.h"

#define SHORTEST_EDGE 0.05 /* the tables of eight blobs hold such edges */
#define LONGEST_EDGE 0.2

typedef struct {
  uint32_t frames, blobs;
  uint64_t budget; /* units of work for a frame */
  double edge;     /* length of the edges of surfaces */
  int window, twin;
  const char* picture; /* NULL: none */
} Options;

typedef struct {
  double* milliseconds; /* of processor time for each frame, drawing apart */
  double* units;
} Records;

typedef struct {
  World world;
  Surface surface;
  Gpu gpu;
  Story story;
  Twin twin;
  Window* window;
} Game;

/* ---------------------------------------------------------------- options */

static int usage(void) {
  fprintf(stderr,
          "game [--frames N] [--budget UNITS] [--blobs N] [--edge LENGTH] [--twin] [--window] "
          "[--picture FILE.bmp]\n");
  return 2;
}

static int read_number(const char* text, uint64_t* number) {
  char* end;
  *number = strtoull(text, &end, 10);
  return *text >= '0' && *text <= '9' && *end == 0;
}

/* An option with a value. */
static int read_value(const char* name, const char* text, Options* options) {
  uint64_t number = 0;
  char* end = NULL;
  if (strcmp(name, "--picture") == 0) {
    options->picture = text;
    return 1;
  }
  if (strcmp(name, "--edge") == 0) {
    options->edge = strtod(text, &end);
    return *end == 0 && options->edge >= SHORTEST_EDGE && options->edge <= LONGEST_EDGE;
  }
  if (!read_number(text, &number) || number == 0) return 0;
  if (strcmp(name, "--frames") == 0) {
    options->frames = (uint32_t)number;
    return number < 100000000;
  }
  if (strcmp(name, "--blobs") == 0) {
    options->blobs = (uint32_t)number;
    return number <= HEARTS;
  }
  options->budget = number;
  return strcmp(name, "--budget") == 0;
}

static int read_options(int argc, char** argv, Options* options) {
  for (int i = 1; i < argc; ++i) {
    if (strcmp(argv[i], "--window") == 0)
      options->window = 1;
    else if (strcmp(argv[i], "--twin") == 0)
      options->twin = 1;
    else if (i + 1 == argc || !read_value(argv[i], argv[i + 1], options))
      return 0;
    else
      ++i;
  }
  return (!options->window && options->picture == NULL) || draw_is_possible();
}

/* ---------------------------------------------------------------- the report */

static int ascending(const void* a, const void* b) {
  const double x = *(const double*)a, y = *(const double*)b;
  return (x > y) - (x < y);
}

static void print_spread(const char* name, double* of_frames, uint32_t count, const char* format) {
  qsort(of_frames, count, sizeof *of_frames, ascending);
  printf("%-10s median ", name);
  printf(format, of_frames[count / 2]);
  printf(", 99 %% ");
  printf(format, of_frames[count - 1 - count / 100]);
  printf(", worst ");
  printf(format, of_frames[count - 1]);
  printf("\n");
}

/* Whose surface is it? */
static void print_score(const Surface* surface, uint32_t vertices) {
  uint32_t score[HEARTS] = {0};
  for (uint32_t v = 0; v < vertices; ++v) ++score[surface->owners[v]];
  printf("%-10s", "score");
  for (int h = 0; h < HEARTS; ++h) printf(" %u", (unsigned)score[h]);
  printf(" vertices\n");
}

static void print_story(const Story* t) {
  printf("%-10s %" PRIu64 " merges, %" PRIu64 " splits, genus up %" PRIu64 " down %" PRIu64 ", %" PRIu64
         " deaths, %" PRIu64 " revived, %" PRIu64 " vertices left behind\n",
         "events", t->merges, t->splits, t->genus_up, t->genus_down, t->deaths, t->revived, t->left_behind);
  printf("%-10s %" PRIu64 " frames held vertices back, %" PRIu32 " in a row at most; %" PRIu64
         " remeshings went on in a later frame\n",
         "short of", t->held_back, t->latest, t->put_off);
}

/* Returns whether all is as it must be. */
static int report(const Options* options, const Records* records, Game* game) {
  tpa_validation now = {.struct_size = sizeof now};
  tpa_mesh_view view = {.struct_size = sizeof view};
  uint64_t digest = 0;
  Surface* const surface = &game->surface;
  const Gpu* const gpu = &game->gpu;
  const int shown = surface_is_shown(surface, gpu);
  tpa_validate(surface->context, NULL, &now, NULL);
  tpa_view(surface->context, &view);
  tpa_digest(surface->context, &digest);
  printf("%" PRIu32 " frames, budget %" PRIu64 " units each\n", options->frames, options->budget);
  print_spread("time/ms", records->milliseconds, options->frames, "%.2f");
  print_spread("units", records->units, options->frames, "%.0f");
  print_story(&game->story);
  printf("%-10s %" PRIu32 " vertices, %" PRIu32 " components, genus %d, %d self-intersections, digest %016" PRIx64 "\n",
         "mesh", view.vertex_count, now.components, (int)now.genus, (int)now.self_intersections, digest);
  print_score(surface, view.vertex_count);
  printf("%-10s %.1f kB in %.1f copies for a frame, in place of %.1f kB; %s\n", "upload",
         (double)gpu->bytes_copied / options->frames / 1000, (double)gpu->copies / options->frames,
         (double)gpu->bytes_whole / options->frames / 1000,
         shown ? "the processor has the whole mesh" : "THE PROCESSOR HAS ANOTHER MESH");
  if (records->units[options->frames - 1] > (double)options->budget) printf("OVER BUDGET\n");
  const int agreed = !options->twin || twin_agrees(&game->twin);
  if (!agreed) printf("NOT WHAT THE TWIN IS\n");
  return shown && agreed && now.self_intersections == 0 &&
         records->units[options->frames - 1] <= (double)options->budget;
}

/* ---------------------------------------------------------------- the loop */

/* Returns the number of frames played: all, unless the window was closed; 0 after a failure. */
static uint32_t play(const Options* options, Game* game, Records* records) {
  for (uint32_t frame = 0; frame < options->frames; ++frame) {
    uint64_t units;
    const clock_t begin = clock();
    world_next(&game->world);
    if (!surface_frame(&game->surface, &game->world, &game->gpu, options->budget, &units, &game->story)) return 0;
    records->milliseconds[frame] = 1000.0 * (double)(clock() - begin) / CLOCKS_PER_SEC;
    records->units[frame] = (double)units;
    if (options->twin && !twin_frame(&game->twin, &game->world, &game->surface)) return 0;
    if (options->window && !draw_frame(game->window, &game->gpu, &game->world)) return frame + 1;
  }
  return options->frames;
}

static int draw_both(const Options* options, const Game* game) {
  const Gpu* const gpus[2] = {&game->gpu, &game->twin.gpu};
  return draw_picture(gpus, options->twin ? 2 : 1, &game->world, options->picture);
}

static int run(Options* options, Records* records) {
  static Game game;
  int good = gpu_start(&game.gpu, MOST_VERTICES, MOST_TRIANGLES);
  world_start(&game.world, options->blobs, options->edge);
  good = surface_start(&game.surface, &game.world, &game.gpu) && good;
  if (good && options->twin) good = twin_start(&game.twin, &game.world);
  if (good && options->window) good = (game.window = draw_open()) != NULL;
  if (good) options->frames = play(options, &game, records);
  good = good && options->frames > 0;
  if (good && options->picture != NULL) good = draw_both(options, &game);
  good = good && report(options, records, &game);
  draw_close(game.window);
  twin_end(&game.twin);
  surface_end(&game.surface);
  gpu_end(&game.gpu);
  return good;
}

int main(int argc, char** argv) {
  Options options = {.frames = 10000, .blobs = HEARTS, .budget = 250000, .edge = 0.11};
  Records records;
  int good;
  if (!read_options(argc, argv, &options)) return usage();
  records.milliseconds = calloc(options.frames, sizeof *records.milliseconds);
  records.units = calloc(options.frames, sizeof *records.units);
  good = records.milliseconds != NULL && records.units != NULL && run(&options, &records);
  free(records.units);
  free(records.milliseconds);
  return good ? 0 : 1;
}
