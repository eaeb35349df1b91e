// SPDX-License-Identifier: MIT
#include "tool/view/deflate.h"

#include <algorithm>
#include <cstdint>

#if TOOL_HAVE_ZLIB
#include <zlib.h>
#endif

namespace tool {

namespace {

uint32_t adler32_of(std::string_view bytes) {
  uint32_t a = 1, b = 0;
  for (const char c : bytes) {
    a = (a + static_cast<unsigned char>(c)) % 65521;
    b = (b + a) % 65521;
  }
  return b << 16 | a;
}

}  // namespace

std::string stored_stream(std::string_view bytes) {
  std::string out("\x78\x01", 2);
  size_t at = 0;
  do {
    const size_t size = std::min<size_t>(bytes.size() - at, 65535);
    out += at + size == bytes.size() ? '\x01' : '\0';
    for (const size_t word : {size, ~size}) {
      out += static_cast<char>(word & 255);
      out += static_cast<char>(word >> 8 & 255);
    }
    out += bytes.substr(at, size);
    at += size;
  } while (at < bytes.size());
  const uint32_t sum = adler32_of(bytes);
  for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(sum >> shift & 255);
  return out;
}

#if TOOL_HAVE_ZLIB

std::string zlib_stream(std::string_view bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string out(size, '\0');
  compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
            static_cast<uLong>(bytes.size()), 6);
  out.resize(size);
  return out;
}

#else

std::string zlib_stream(std::string_view bytes) { return stored_stream(bytes); }

#endif

}  // namespace tool
