// SPDX-License-Identifier: MIT
// decoder: packed bytes as the bytes that they stand for: gzip and zlib (RFC 1952, 1950), bzip2, hexadecimal digits.
// TOOL_HAVE_ZLIB and TOOL_HAVE_BZIP2 are 1 if the build found the libraries; messages name a missing library.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "tool/result.h"

namespace tool {

enum class Packing { none, deflate, bzip2, hex };
const char* name_of(Packing packing);  // for messages

// How files of that packing begin; `none` for plain bytes. Hexadecimal digits have no mark.
Packing packing_of(std::string_view first_bytes);
inline constexpr size_t longest_mark = 3;

class Decoder {
 public:
  // Up to `wanted` packed bytes; fewer only at the end.
  using Upstream = std::function<Status(void* bytes, size_t wanted, size_t& got)>;

  virtual ~Decoder() = default;
  // Up to `wanted` unpacked bytes; fewer only at the end. Fails on bytes damaged or cut off.
  virtual Status read(const Upstream& upstream, void* bytes, size_t wanted, size_t& got) = 0;
};

// `path` starts the messages. Fails, naming the library, in a build without it.
Status make_decoder(const std::string& path, Packing packing, std::unique_ptr<Decoder>& decoder);

}  // namespace tool
