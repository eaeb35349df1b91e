// SPDX-License-Identifier: MIT
// field_meshes: closed, oriented meshes that run into themselves as meshes from the field do, by family and seed: boxes
// that share sides, outlines that cross themselves, springs with turns in each other, copies, noise. The tangles of
// tangles.h are families here too.
#pragma once

#include <cstdint>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "support/sample_meshes.h"

namespace support {

struct FieldFamily {
  std::string name;
  std::function<Mesh(Random&)> make;  // an empty mesh where files are absent
  uint32_t count;                     // in the long run, seeds 1 .. count
  int cells = 72;                     // of the coarser winding grid, along the longest side
  bool touches = false;               // the region may touch itself in edges or vertices
};

inline void PrintTo(const FieldFamily& family, std::ostream* out) { *out << family.name; }

const std::vector<FieldFamily>& FieldFamilies();
const FieldFamily& FieldFamilyOf(const std::string& name);
Mesh MakeFieldMesh(const FieldFamily& family, uint64_t seed);

// The parts of the list, by kind.
std::vector<FieldFamily> BoxFamilies();
std::vector<FieldFamily> OutlineFamilies();
std::vector<FieldFamily> SweepFamilies();
std::vector<FieldFamily> CopyFamilies();

}  // namespace support
