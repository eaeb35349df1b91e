// open_cases: what is known to come out wrong, and is not mended yet. These cases have to come out clean all the same;
// a test says so when one of them comes out right, so that the list stays true (docs/scenes.md, docs/tangles.md).
#pragma once

#include <string>

namespace support {

// Commands as Play::Command() writes them, and tangles as "FAMILY SEED".
bool IsOpen(const std::string& name);

}  // namespace support
