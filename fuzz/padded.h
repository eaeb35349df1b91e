// SPDX-License-Identifier: MIT
// padded: a structure of the interface as a caller with a newer header has it.
#pragma once

#include <cstdint>
#include <cstring>

#include "target.h"

namespace fuzz {

template <class T>
class Padded {
 public:
  // With zeros in fields unknown to the library.
  Padded(const T& value, uint32_t unknown_bytes) : unknown_(unknown_bytes) {
    std::memset(bytes_, 0, sizeof bytes_);
    std::memset(bytes_ + sizeof(T) + unknown_, 0xA5, most_ - unknown_);
    std::memcpy(bytes_, &value, sizeof(T));
    const auto size = static_cast<uint32_t>(sizeof(T) + unknown_);
    std::memcpy(bytes_, &size, sizeof size);
  }
  T* get() { return reinterpret_cast<T*>(bytes_); }
  // With this header's struct_size.
  T Value() const {
    for (uint32_t i = 0; i < most_; ++i)
      Demand(bytes_[sizeof(T) + i] == (i < unknown_ ? 0 : 0xA5), "zeros in fields unknown to the library");
    T value;
    std::memcpy(&value, bytes_, sizeof(T));
    Demand(value.struct_size == sizeof(T) + unknown_, "struct_size stays as the caller set it");
    value.struct_size = sizeof(T);
    return value;
  }

 private:
  static constexpr uint32_t most_ = 64;
  alignas(T) uint8_t bytes_[sizeof(T) + most_];
  uint32_t unknown_;
};

}  // namespace fuzz
