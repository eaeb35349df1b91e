// SPDX-License-Identifier: MIT
// memory_table: bytes of the arena for each vertex of capacity at default limits, by region.
//
//   memory_table [VERTICES]      default 1e6
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "topoadapt.h"

int main(int argc, char** argv) {
  tpa_config config;
  tpa_config_init(&config, sizeof config);
  config.max_vertices = static_cast<uint32_t>(argc > 1 ? std::atof(argv[1]) : 1e6);
  tpa_arena_size size{};
  tpa_issue issue;
  tpa_context* context = nullptr;
  if (tpa_arena_query(&config, &size, &issue) != TPA_OK) return 2;
  void* const block = std::malloc(size.bytes);
  if (block == nullptr || tpa_init(block, size.bytes, &config, &context, &issue) != TPA_OK) return 2;
  uint32_t count = 0;
  tpa_memory_stats(context, nullptr, 0, &count);
  std::vector<tpa_memory_table> tables(count);
  tpa_memory_stats(context, tables.data(), count, &count);
  for (const tpa_memory_table& r : tables)
    std::printf("%-22s %8.2f\n", r.name, static_cast<double>(r.bytes) / config.max_vertices);
  std::printf("%-22s %8.2f bytes per vertex of %u\n", "all", static_cast<double>(size.bytes) / config.max_vertices,
              config.max_vertices);
  std::free(block);
}
