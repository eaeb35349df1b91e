// SPDX-License-Identifier: MIT
// seed_table: tables of families by seeds, right, refused or wrong, and the arguments that all such programs take:
//
//   PROGRAM [--list] [--reasons] [--write DIR] [FAMILY [FROM [TO]]]
//
// Seeds FROM .. TO (default: all of the long run; FROM alone: one seed) of a family, or of all. A * in FAMILY stands
// for any text. --reasons tells why a mesh is not right, on stderr. --write puts the meshes of wrong and refused seeds
// into a folder, as .off.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "support/region_trial.h"

namespace figures {

struct Arguments {
  std::string family = "*", folder;
  uint64_t from = 1, to = 0;  // to 0: all
  bool list = false, reasons = false;
  bool Asks(const std::string& name) const;
};

Arguments ReadArguments(int argc, char** argv);

using NamedMeshes = std::vector<std::pair<std::string, support::Mesh>>;
// Into the folder of --write, if given, as FAMILY-SEED and the name of each.
void WriteMeshes(const Arguments& arguments, const std::string& family, uint64_t seed, const NamedMeshes& meshes);

struct Result {
  support::Outcome outcome = support::Outcome::right;
  std::string reason;
  double seconds = 0;
  uint32_t vertices = 0;
  double extra = 0;  // of the table's column of its own, summed up
  NamedMeshes meshes;
};

class SeedTable {
 public:
  // `extra` heads a column with a mean over the meshes of a row.
  SeedTable(Arguments arguments, const char* extra);
  template <class Play>
  void Run(const std::string& family, uint32_t count, Play play) {
    Row row;
    const uint64_t to = arguments_.to > 0 ? arguments_.to : count;
    for (uint64_t seed = arguments_.from; seed <= to; ++seed) {
      const Result result = play(seed);
      if (result.vertices > 0) Add(family, seed, result, row);
    }
    Print(family, row);
  }
  // Prints the sums; is nothing wrong?
  bool End() const;

 private:
  struct Row {
    uint32_t meshes = 0, right = 0, refused = 0, wrong = 0, most_vertices = 0;
    double extra = 0;
    std::string refused_seeds, wrong_seeds;
    std::vector<double> seconds;
  };
  void Add(const std::string& family, uint64_t seed, const Result& result, Row& row) const;
  void Print(const std::string& family, Row& row);

  Arguments arguments_;
  Row sum_;
};

}  // namespace figures
