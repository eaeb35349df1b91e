// SPDX-License-Identifier: MIT
// base64: bytes as the text that pages and XML files of meshes carry them in (RFC 4648).
#pragma once

#include <string>
#include <string_view>

namespace tool {

std::string base64(std::string_view bytes);

}  // namespace tool
