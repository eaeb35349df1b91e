// SPDX-License-Identifier: MIT
// mesh_on_failure: a failing test writes the meshes it judged, and says where. Arena (support.h) and LibraryMesh
// (library_mesh.h) hold a MeshOnFailure, so their tests need no guard of their own.
#pragma once

#include <functional>
#include <string>

#include "support/sample_meshes.h"

namespace support {

// Writes the mesh to a .ply in the folder of temporary files, named after the running test and `name`, and returns
// "mesh NAME written to PATH". Beyond a few meshes for each test none is written, since a loop may fail in each case.
std::string Written(const Mesh& m, const std::string& name);

// Writes a mesh at the end of its scope, if an expectation of the test has failed within, and prints the path.
class MeshOnFailure {
 public:
  MeshOnFailure(std::string name, Mesh mesh);
  // Asks for the mesh only after a failure, at the end of the scope.
  MeshOnFailure(std::string name, std::function<Mesh()> mesh);
  ~MeshOnFailure();
  MeshOnFailure(const MeshOnFailure&) = delete;
  MeshOnFailure& operator=(const MeshOnFailure&) = delete;

 private:
  std::string name_;
  std::function<Mesh()> mesh_;
  int results_before_;  // of the running test
};

}  // namespace support
