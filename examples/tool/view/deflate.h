// SPDX-License-Identifier: MIT
// deflate: zlib streams (RFC 1950), for pages and pictures.
#pragma once

#include <string>
#include <string_view>

namespace tool {

// A zlib stream of the bytes; stored_stream in a build without zlib.
std::string zlib_stream(std::string_view bytes);
// A zlib stream that holds the bytes as they are.
std::string stored_stream(std::string_view bytes);

}  // namespace tool
