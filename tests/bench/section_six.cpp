// SPDX-License-Identifier: MIT
// section_six: section 6 of the paper as a user would run it. Writes the phantoms as plain files, calls the tool with
// one set of options, and judges the meshes by topology and by distance to the true surface.
//
//   section_six TOOL FOLDER [SEEDS] [OPTIONS...]     noise seeds 1 to SEEDS (40); options for all calls of the tool
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "quantile.h"
#include "tool/io/files.h"
#include "tool/io/mesh_io.h"
#include "tool/segment/phantom.h"
#include "tool/topology.h"

namespace {

struct Run {
  bool right = false;  // the genera expected, and exit code 0
  double seconds = 0, vertices = 0, mean = 0, largest = 0;
};

[[noreturn]] void Fail(const tool::Status& status) {
  std::fprintf(stderr, "section_six: %s\n", status.message.c_str());
  std::exit(2);
}

void WriteVolume(const tool::Volume& volume, const std::string& path) {
  std::string bytes = "NRRD0004\ntype: float\ndimension: 3\nsizes: " + std::to_string(volume.nx) + " " +
                      std::to_string(volume.ny) + " " + std::to_string(volume.nz) +
                      "\nspacings: 1 1 1\nendian: little\nencoding: raw\n\n";
  for (const float grey : volume.values) tool::append_little_endian(bytes, grey);
  if (!std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size())))
    Fail(tool::failure("cannot write ", path));
}

std::vector<int> GeneraOf(const tool::TriangleMesh& mesh) {
  std::vector<int> genera;
  for (const tool::Part& part : tool::parts_of(mesh)) genera.push_back(static_cast<int>(part.genus));
  return genera;
}

Run Segment(const std::string& tool, const std::string& folder, const char* name, uint64_t seed,
            const std::string& options) {
  tool::Phantom phantom;
  if (const tool::Status s = tool::make_phantom(name, seed, phantom); !s) Fail(s);
  const std::string volume = folder + "/volume.nrrd", surface = folder + "/surface.ply";
  WriteVolume(phantom.volume, volume);
  char place[200];
  std::snprintf(place, sizeof place, " --seed %.17g,%.17g,%.17g --threshold %.17g ", phantom.seed[0], phantom.seed[1],
                phantom.seed[2], phantom.threshold);
  std::remove(surface.c_str());
  const std::string command = "\"" + tool + "\" segment \"" + volume + "\"" + place + options + " --quiet --out \"" +
                              surface + "\" > /dev/null";
  const auto begin = std::chrono::steady_clock::now();
  const int status = std::system(command.c_str());
  Run run;
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  tool::TriangleMesh mesh;
  if (!tool::read_mesh(surface, mesh)) return run;
  run.right = status == 0 && GeneraOf(mesh) == phantom.genera;
  run.vertices = static_cast<double>(mesh.positions.size() / 3);
  for (size_t i = 0; i < mesh.positions.size(); i += 3) {
    const double away =
        tool::distance_to_surface(phantom, mesh.positions[i], mesh.positions[i + 1], mesh.positions[i + 2]);
    run.mean += away / run.vertices;
    run.largest = std::max(run.largest, away);
  }
  if (!run.right) {
    std::printf("wrong: %s, noise seed %d, exit status %d, genera", name, static_cast<int>(seed), status);
    for (const int genus : GeneraOf(mesh)) std::printf(" %d", genus);
    std::printf("\n");
  }
  return run;
}

double Worst(const std::vector<Run>& runs, double Run::*value) {
  double worst = 0;
  for (const Run& run : runs) worst = std::max(worst, run.*value);
  return worst;
}

double Median(const std::vector<Run>& runs, double Run::*value) {
  std::vector<double> values;
  for (const Run& run : runs) values.push_back(run.*value);
  return bench::Quantile(values, 0.5);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: section_six TOOL FOLDER [SEEDS] [OPTIONS...]\n");
    return 2;
  }
  const int seeds = argc > 3 ? std::atoi(argv[3]) : 40;
  std::string options;
  for (int i = 4; i < argc; ++i) options += std::string(" ") + argv[i];
  std::printf("%-13s %8s %9s %8s %9s %9s\n", "phantom", "right", "vertices", "seconds", "mean", "largest");
  bool all = true;
  for (const char* name : {"cyst", "cube-cavity", "genus-3", "torus-nested"}) {
    std::vector<Run> runs;
    for (int seed = 1; seed <= seeds; ++seed)
      runs.push_back(Segment(argv[1], argv[2], name, static_cast<uint64_t>(seed), options));
    const auto right = std::count_if(runs.begin(), runs.end(), [](const Run& run) { return run.right; });
    all = all && right == seeds;
    std::printf("%-13s %4d/%-3d %9.0f %8.2f %9.3f %9.2f\n", name, static_cast<int>(right), seeds,
                Median(runs, &Run::vertices), Median(runs, &Run::seconds), Worst(runs, &Run::mean),
                Worst(runs, &Run::largest));
    std::fflush(stdout);
  }
  return all ? 0 : 1;
}
