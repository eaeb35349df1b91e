// SPDX-License-Identifier: MIT
// blocks: contexts in blocks of their own, of exactly the size needed and at odd addresses, copies of them included.
#pragma once

#include <memory>

#include "topoadapt.h"

namespace fuzz {

// A structure of the interface, zero but for its size.
template <class T>
T Sized() {
  T s{};
  s.struct_size = sizeof s;
  return s;
}

// Memory at an address one above a multiple of the alignment.
class Block {
 public:
  Block() = default;
  Block(size_t bytes, size_t alignment);
  char* get() const { return start_; }
  size_t bytes() const { return bytes_; }

 private:
  struct Free {
    void operator()(char* p) const;
  };
  std::unique_ptr<char, Free> memory_;
  char* start_ = nullptr;
  size_t bytes_ = 0;
};

tpa_arena_size ArenaSize(const tpa_config& config);

struct Owner {
  Block block;
  tpa_context* context = nullptr;
};
Owner Made(const tpa_config& config);
// A byte copy at another address.
Owner Copied(const Owner& o);

tpa_config ConfigOf(const tpa_context* context);
uint64_t DigestOf(const tpa_context* context);

}  // namespace fuzz
