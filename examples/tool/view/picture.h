// SPDX-License-Identifier: MIT
// picture: a PNG of what a page shows: the mesh, and slices of the volume with the contour of the mesh.
#pragma once

#include "tool/view/page.h"

namespace tool {

// The bytes of the file. O(pixels + triangles of the frames shown).
std::string picture_of(const PageContent& content);

}  // namespace tool
