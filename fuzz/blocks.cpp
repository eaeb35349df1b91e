// SPDX-License-Identifier: MIT
#include "blocks.h"

#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "target.h"

namespace fuzz {

void Block::Free::operator()(char* p) const { std::free(p); }

Block::Block(size_t bytes, size_t alignment) : bytes_(bytes) {
  memory_.reset(static_cast<char*>(std::aligned_alloc(alignment, bytes + alignment)));
  Demand(memory_ != nullptr, "memory for the fuzzer");
  start_ = memory_.get() + 1;
}

tpa_arena_size ArenaSize(const tpa_config& config) {
  tpa_arena_size size;
  Demand(tpa_arena_query(&config, &size, nullptr) == TPA_OK, "a valid config has a size");
  return size;
}

Owner Made(const tpa_config& config) {
  const tpa_arena_size size = ArenaSize(config);
  Owner o{Block(size.bytes, size.alignment)};
  Demand(tpa_init(o.block.get(), size.bytes, &config, &o.context, nullptr) == TPA_OK,
         "a block of the size asked for is enough");
  return o;
}

Owner Copied(const Owner& o) {
  const tpa_arena_size size = ArenaSize(ConfigOf(o.context));
  Demand(size.bytes <= o.block.bytes(), "the block of a context is as large as its config says");
  Owner copy{Block(size.bytes, size.alignment)};
  std::memcpy(copy.block.get(), o.context, size.bytes);
  copy.context = reinterpret_cast<tpa_context*>(copy.block.get());
  return copy;
}

tpa_config ConfigOf(const tpa_context* context) {
  auto config = Sized<tpa_config>();
  Demand(tpa_config_of(context, &config) == TPA_OK, "a context tells its config");
  return config;
}

uint64_t DigestOf(const tpa_context* context) {
  uint64_t digest = 0;
  Demand(tpa_digest(context, &digest) == TPA_OK, "a context has a digest");
  return digest;
}

}  // namespace fuzz
