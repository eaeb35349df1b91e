// SPDX-License-Identifier: MIT
// workers: threads for the library (tpa_exec) and for loops of the tool. Nothing depends on their number.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "topoadapt.h"

namespace tool {

class Workers {
 public:
  // The calling thread is one of them. Where threads are not to be had, it is the only one.
  explicit Workers(int threads = 1);
  ~Workers();

  // For calls of the library; NULL for one thread.
  const tpa_exec* exec() const { return exec_.parallel_for == nullptr ? nullptr : &exec_; }

  // Calls work(i) once for each i below count, in any order.
  void for_each(uint32_t count, const std::function<void(uint32_t)>& work) const;

 private:
  struct Pool;
  std::unique_ptr<Pool> pool_;
  tpa_exec exec_{};
};

inline constexpr int most_threads = 256;

}  // namespace tool
