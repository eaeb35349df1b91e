// SPDX-License-Identifier: MIT
// sanitizer_end: what a sanitizer calls when it ends a process, where there is a sanitizer.
#pragma once

#if defined(__ELF__)
extern "C" __attribute__((weak)) void __sanitizer_set_death_callback(void (*callback)());
#endif

namespace fuzz {

inline void AtSanitizerEnd(void (*callback)()) {
#if defined(__ELF__)
  if (__sanitizer_set_death_callback != nullptr) __sanitizer_set_death_callback(callback);
#else
  (void)callback;
#endif
}

}  // namespace fuzz
