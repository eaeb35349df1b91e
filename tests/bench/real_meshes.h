// SPDX-License-Identifier: MIT
// real_meshes: meshes that people have, and generated ones like them: parts from CAD, decimated scans, sculpts. All
// generated ones are closed and manifold; one and the same on every machine, but for the scans, which CGAL decimates.
#pragma once

#include "meshes.h"

namespace bench {

// A plate of cells by cells squares with a round hole in each: fans of needles from the corners of the squares to the
// rims of the holes.
Mesh PlateWithHoles(int cells, int sides);
// A gear: caps of `teeth` times 20 corners, joined to a shaft hole of 24 corners.
Mesh Gear(int teeth);
// A box with rounded corners and filleted edges, `corners` to a loop. Each cap is a fan about one corner, its needles
// up to 10,000 times as long as wide.
Mesh FilletedBox(int corners);
// A flat ring, each side cut into concentric bands of 1000, 600, 240, 90 and 24 corners.
Mesh Washer();
// A turned part: shafts of one band between finely rounded shoulders, `around` corners each.
Mesh TurnedPart(int around);
// A sphere with creases where its height has a kink, and bands of triangles pinched to a tenth of their width.
Mesh Sculpt(int levels);
// Turned about an oblique axis, so that no plane is along an axis and no corner exactly in its plane.
Mesh Tilted(Mesh m);

// Files of the folders `meshes` and `field` in `<shared>/data` with at least 1000 triangles; none if absent. Then the
// generated ones with `only` in their names.
std::vector<NamedMesh> FilesIn(const std::string& shared);
std::vector<NamedMesh> RealMeshes(const std::string& only);

#ifdef BENCH_CGAL
// Edges collapsed in the order of their quadric errors (Lindstrom and Turk 1998) until this share of them is left.
Mesh DecimatedWithCgal(const Mesh& mesh, double share);
#endif

}  // namespace bench
