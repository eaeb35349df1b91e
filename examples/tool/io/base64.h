// SPDX-License-Identifier: MIT
// base64: bytes as the text that pages and XML files of meshes carry them in (RFC 4648).
#pragma once

#include <string>
#include <string_view>

namespace tool {

std::string base64(std::string_view bytes);

// Appends the bytes of a text, with blanks between digits passed over. Several encoded pieces may follow each other.
// False on any other character and on a piece cut off.
bool from_base64(std::string_view text, std::string& bytes);

}  // namespace tool
