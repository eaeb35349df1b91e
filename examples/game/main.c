/* SPDX-License-Identifier: MIT */
/* A game's loop at 60 frames per second over surfaces that merge, split and are carved, within so much work for each
 * frame.
 *
 *     game [--frames N] [--budget UNITS] [--window] [--picture FILE.bmp]
 *
 * Without --window all frames follow each other at once. The end of the run is the same with and without. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "draw.h"
#include "surface.h"

typedef struct {
  uint32_t frames;
  uint64_t budget; /* units of work for a frame */
  int window;
  const char* picture; /* NULL: none */
} Options;

typedef struct {
  double* milliseconds; /* of processor time for each frame, drawing apart */
  double* units;
} Records;

/* ---------------------------------------------------------------- options */

static int usage(void) {
  fprintf(stderr, "game [--frames N] [--budget UNITS] [--window] [--picture FILE.bmp]\n");
  return 2;
}

static int read_number(const char* text, uint64_t* number) {
  char* end;
  *number = strtoull(text, &end, 10);
  return *text >= '0' && *text <= '9' && *end == 0;
}

static int read_options(int argc, char** argv, Options* options) {
  for (int i = 1; i < argc; ++i) {
    uint64_t number;
    if (strcmp(argv[i], "--window") == 0) {
      options->window = 1;
      continue;
    }
    if (i + 1 == argc) return 0;
    if (strcmp(argv[i], "--picture") == 0) {
      options->picture = argv[++i];
    } else if (strcmp(argv[i], "--frames") == 0 && read_number(argv[i + 1], &number) && number > 0 &&
               number < 100000000) {
      options->frames = (uint32_t)number;
      ++i;
    } else if (strcmp(argv[i], "--budget") == 0 && read_number(argv[i + 1], &number) && number > 0) {
      options->budget = number;
      ++i;
    } else {
      return 0;
    }
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
static int report(const Options* options, const Records* records, const Story* story, Surface* surface,
                  const Gpu* gpu) {
  tpa_validation now = {.struct_size = sizeof now};
  tpa_mesh_view view = {.struct_size = sizeof view};
  uint64_t digest = 0;
  const int shown = surface_is_shown(surface, gpu);
  tpa_validate(surface->context, NULL, &now, NULL);
  tpa_view(surface->context, &view);
  tpa_digest(surface->context, &digest);
  printf("%" PRIu32 " frames, budget %" PRIu64 " units each\n", options->frames, options->budget);
  print_spread("time/ms", records->milliseconds, options->frames, "%.2f");
  print_spread("units", records->units, options->frames, "%.0f");
  print_story(story);
  printf("%-10s %" PRIu32 " vertices, %" PRIu32 " components, genus %d, %d self-intersections, digest %016" PRIx64 "\n",
         "mesh", view.vertex_count, now.components, (int)now.genus, (int)now.self_intersections, digest);
  print_score(surface, view.vertex_count);
  printf("%-10s %.1f kB in %.1f copies for a frame, in place of %.1f kB; %s\n", "upload",
         (double)gpu->bytes_copied / options->frames / 1000, (double)gpu->copies / options->frames,
         (double)gpu->bytes_whole / options->frames / 1000,
         shown ? "the processor has the whole mesh" : "THE PROCESSOR HAS ANOTHER MESH");
  if (records->units[options->frames - 1] > (double)options->budget) printf("OVER BUDGET\n");
  return shown && now.self_intersections == 0 && records->units[options->frames - 1] <= (double)options->budget;
}

/* ---------------------------------------------------------------- the loop */

/* Returns the number of frames played: all, unless the window was closed; 0 after a failure. */
static uint32_t play(const Options* options, World* world, Surface* surface, Gpu* gpu, Records* records, Story* story,
                     Window* window) {
  for (uint32_t frame = 0; frame < options->frames; ++frame) {
    uint64_t units;
    const clock_t begin = clock();
    world_next(world);
    if (!surface_frame(surface, world, gpu, options->budget, &units, story)) return 0;
    records->milliseconds[frame] = 1000.0 * (double)(clock() - begin) / CLOCKS_PER_SEC;
    records->units[frame] = (double)units;
    if (options->window && !draw_frame(window, gpu, world)) return frame + 1;
  }
  return options->frames;
}

static int run(Options* options, Records* records) {
  World world;
  Surface surface;
  Gpu gpu;
  Story story = {0};
  Window* window = NULL;
  int good = gpu_start(&gpu, MOST_VERTICES, MOST_TRIANGLES);
  world_start(&world);
  good = surface_start(&surface, &world, &gpu) && good;
  if (good && options->window) good = (window = draw_open()) != NULL;
  if (good) options->frames = play(options, &world, &surface, &gpu, records, &story, window);
  good = good && options->frames > 0;
  if (good && options->picture != NULL) good = draw_picture(&gpu, &world, options->picture);
  good = good && report(options, records, &story, &surface, &gpu);
  draw_close(window);
  surface_end(&surface);
  gpu_end(&gpu);
  return good;
}

int main(int argc, char** argv) {
  Options options = {.frames = 10000, .budget = 200000};
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
