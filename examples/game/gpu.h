/* SPDX-License-Identifier: MIT */
/* Stands for a graphics processor: two buffers of fixed size that only take copies of ranges, as glBufferSubData or
 * vkCmdCopyBuffer do. Nothing else writes them; drawing reads nothing else. */
#ifndef GAME_GPU_H
#define GAME_GPU_H

#include <stddef.h>
#include <stdint.h>

typedef struct {
  float place[3], colour[3], texture[2];
} GpuVertex;

typedef struct {
  char* bytes;
  size_t capacity;
} GpuBuffer;

typedef struct {
  GpuBuffer vertices, triangles;         /* of GpuVertex, and of three indices each */
  uint32_t vertex_count, triangle_count; /* to draw */
  uint64_t bytes_copied, copies;         /* since gpu_start() */
  uint64_t bytes_whole;                  /* that copies of everything after each commit would have had */
} Gpu;

/* Returns 0 without memory. gpu_end() frees in any case. */
int gpu_start(Gpu* gpu, uint32_t most_vertices, uint32_t most_triangles);
void gpu_end(Gpu* gpu);
/* Copies into a buffer of the processor. A range beyond the end is a fault of the game: returns 0. */
int gpu_copy(Gpu* gpu, GpuBuffer* buffer, size_t offset, const void* data, size_t bytes);

#endif
