// SPDX-License-Identifier: MIT
// schedules: ways to run the tasks of a parallel_for, for tests that results do not depend on the order of tasks.
#pragma once

#include <cstdint>
#include <thread>

namespace support {

using Task = void (*)(void* data, uint32_t index);

inline void Backwards(void*, uint32_t count, Task task, void* data) {
  for (uint32_t i = count; i-- > 0;) task(data, i);
}

inline void OnTwoThreads(void*, uint32_t count, Task task, void* data) {
  const auto half = [&](uint32_t first) {
    for (uint32_t i = first; i < count; i += 2) task(data, i);
  };
  std::thread other(half, 1);
  half(0);
  other.join();
}

}  // namespace support
