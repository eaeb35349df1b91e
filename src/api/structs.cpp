// SPDX-License-Identifier: MIT
#include "api/structs.h"

#include <string.h>

namespace tpa {

namespace {

// Every structure begins with it.
u32 size_of_caller(const void* caller) {
  u32 size;
  memcpy(&size, caller, sizeof size);
  return size;
}

}  // namespace

StructFault check_struct_size(u64 size, Growth g, u32 known) {
  if (size >= g.first_size && size <= largest_struct && size % sizeof(u32) == 0) return {};
  return {Rule::struct_size, 0, known, size};
}

StructFault check_struct(const void* caller, Growth g, u32 known) {
  if (caller == nullptr) return {Rule::not_null};
  return check_struct_size(size_of_caller(caller), g, known);
}

StructFault read_bytes(const void* caller, Growth g, void* to, u32 known) {
  if (const StructFault f = check_struct(caller, g, known)) return f;
  const u32 size = size_of_caller(caller);
  const u8* bytes = static_cast<const u8*>(caller);
  for (u32 i = known; i < size; ++i)
    if (bytes[i] != 0) return {Rule::zeros_beyond, i, 0, known};
  const u32 common = min_of(size, known);
  memcpy(to, caller, common);
  memset(static_cast<u8*>(to) + common, 0, known - common);
  memcpy(to, &known, sizeof known);
  return {};
}

void write_bytes(const void* from, u32 known, void* caller) {
  const u32 size = size_of_caller(caller);
  const u32 common = min_of(size, known);
  u8* to = static_cast<u8*>(caller);
  memcpy(to + sizeof size, static_cast<const u8*>(from) + sizeof size, common - sizeof size);
  memset(to + common, 0, size - common);
}

}  // namespace tpa
