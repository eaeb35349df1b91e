// SPDX-License-Identifier: MIT
#include "support/field_meshes.h"

#include <stdexcept>

#include "support/tangles.h"

namespace support {

namespace {

std::vector<FieldFamily> TangleFieldFamilies() {
  std::vector<FieldFamily> families;
  for (const Family& f : TangleFamilies())
    families.push_back({std::string("tangle-") + f.name, [&f](Random& random) { return f.make(random).mesh; }, f.count,
                        3 * f.cells / 4, std::string(f.name) == "touching"});
  return families;
}

}  // namespace

const std::vector<FieldFamily>& FieldFamilies() {
  static const std::vector<FieldFamily> families = [] {
    std::vector<FieldFamily> all;
    for (const auto& part : {BoxFamilies(), OutlineFamilies(), SweepFamilies(), CopyFamilies(), TangleFieldFamilies()})
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }();
  return families;
}

const FieldFamily& FieldFamilyOf(const std::string& name) {
  for (const FieldFamily& f : FieldFamilies())
    if (f.name == name) return f;
  throw std::invalid_argument("no family of field meshes is called " + name);
}

Mesh MakeFieldMesh(const FieldFamily& family, uint64_t seed) {
  Random random(seed);
  return family.make(random);
}

}  // namespace support
