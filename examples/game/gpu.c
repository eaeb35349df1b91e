/* SPDX-License-Identifier: MIT */
#include "gpu.h"

#include <stdlib.h>
#include <string.h>

static int make_buffer(GpuBuffer* buffer, size_t bytes) {
  buffer->bytes = calloc(bytes, 1);
  buffer->capacity = buffer->bytes == NULL ? 0 : bytes;
  return buffer->bytes != NULL;
}

int gpu_start(Gpu* gpu, uint32_t most_vertices, uint32_t most_triangles) {
  memset(gpu, 0, sizeof *gpu);
  return make_buffer(&gpu->vertices, most_vertices * sizeof(GpuVertex)) &&
         make_buffer(&gpu->triangles, most_triangles * 3 * sizeof(uint32_t));
}

void gpu_end(Gpu* gpu) {
  free(gpu->vertices.bytes);
  free(gpu->triangles.bytes);
}

int gpu_copy(Gpu* gpu, GpuBuffer* buffer, size_t offset, const void* data, size_t bytes) {
  if (offset > buffer->capacity || bytes > buffer->capacity - offset) return 0;
  memcpy(buffer->bytes + offset, data, bytes);
  gpu->bytes_copied += bytes;
  ++gpu->copies;
  return 1;
}
