// SPDX-License-Identifier: MIT
// render: a mesh on a canvas, shaded, with hidden surfaces left out.
#pragma once

#include "tool/io/mesh_io.h"
#include "tool/view/canvas.h"

namespace tool {

// Where from: rows to the right, up, towards the eye; the places shown lie round `middle`.
struct Camera {
  Point rows[3];
  Point middle{};
  double scale = 1;  // pixels for each unit of length, without perspective
};

// From the side and above, so that the vertices of all meshes fit a box of that size.
Camera fitting_camera(const std::vector<const TriangleMesh*>& meshes, double azimuth, double width, double height);

// Edges bent by more than 40 degrees are creases. Triangles with a mark are red, also through what lies before them,
// faintly.
void render(Canvas& canvas, const Box2& box, const Camera& camera, const TriangleMesh& mesh,
            const std::vector<uint8_t>& marks);

}  // namespace tool
