// SPDX-License-Identifier: MIT
// segment_peers: what segment_table.py needs of the C++ side: volumes as plain files, the voxels of the true object,
// ITK's level set, distances to the exact surface of a phantom.
//
//   segment_peers case PREFIX [--itk SECONDS] phantom NAME NOISE_SEED
//   segment_peers case PREFIX [--itk SECONDS] volume FILE SIGMA THRESHOLD I,J,K     bright objects; all lengths in
//   voxels
//     writes PREFIX.nrrd (grey values, smoothed), PREFIX.object (bytes: 1 in the object, 2 on its surface) and
//     PREFIX.level (floats)
//   segment_peers distance NAME MESH
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "level_set.h"
#include "tool/io/files.h"
#include "tool/io/volume_io.h"
#include "tool/segment/ball.h"
#include "tool/segment/segmentation.h"

namespace {

[[noreturn]] void Fail(const std::string& message) {
  std::fprintf(stderr, "segment_peers: %s\n", message.c_str());
  std::exit(2);
}
void Check(const tool::Status& status) {
  if (!status) Fail(status.message);
}

void Write(const std::string& path, const std::string& bytes) {
  if (!std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size())))
    Fail("cannot write " + path);
}

std::string FloatsOf(const std::vector<float>& values) {
  std::string bytes;
  for (const float x : values) tool::append_little_endian(bytes, x);
  return bytes;
}

struct Case {
  tool::Segmentation s;
  std::string object;  // a byte for each voxel: 1 inside, 2 on the surface, 0 outside
  bench::GreyWindow window{};
};

void MakePhantom(Case& c, const char* name, uint64_t noise_seed) {
  Check(tool::prepare_phantom(name, noise_seed, c.s));
  const tool::Volume& v = c.s.volume;
  for (int k = 0; k < v.nz; ++k)
    for (int j = 0; j < v.ny; ++j)
      for (int i = 0; i < v.nx; ++i) c.object += "\1\2\0"[1 + tool::side_of_object(c.s.phantom->shape, i, j, k)];
  const float threshold = static_cast<float>(c.s.options.threshold.value);
  c.window = {-threshold, threshold};  // the object's grey value is 0
}

// The component of voxels beyond the threshold round the seed; the window's middle is the greatest grey value there.
void MakeVolume(Case& c, const char* file, double sigma, double threshold, const tool::Point& seed) {
  Check(tool::read_volume(file, c.s.volume));
  tool::Volume& v = c.s.volume;
  Check(tool::smooth_gaussian(v, sigma * tool::mean_side(v)));
  v.to_world = tool::Affine();
  c.s.options.threshold = {threshold, true};
  c.s.options.seeds = {seed};
  tool::Object object;
  Check(tool::find_object(v, c.s.options.threshold, c.s.options.seeds, object));
  const float lower = static_cast<float>(threshold);
  float greatest = lower;
  for (size_t id = 0; id < v.values.size(); ++id) {
    const bool inside = object.mask[id] != 0;
    c.object += inside ? '\1' : '\0';
    if (inside) greatest = std::max(greatest, v.values[id]);
  }
  c.window = {lower, 2 * greatest - lower};
  c.s.options.radius = tool::fitting_radius(v, object, c.s.options.seeds, 4);
}

int RunCase(int argc, char** argv) {
  const std::string prefix = argv[2];
  const bool itk = std::strcmp(argv[3], "--itk") == 0;
  char** rest = argv + (itk ? 5 : 3);
  const int left = argc - (itk ? 5 : 3);
  Case c;
  if (left == 3 && std::strcmp(rest[0], "phantom") == 0) {
    MakePhantom(c, rest[1], std::strtoull(rest[2], nullptr, 10));
  } else if (left == 5 && std::strcmp(rest[0], "volume") == 0) {
    tool::Point seed{};
    if (std::sscanf(rest[4], "%lf,%lf,%lf", &seed[0], &seed[1], &seed[2]) != 3) Fail("no seed I,J,K");
    MakeVolume(c, rest[1], std::atof(rest[2]), std::atof(rest[3]), seed);
  } else {
    Fail("see the head of segment_peers.cpp");
  }
  const tool::Volume& v = c.s.volume;
  Write(prefix + ".nrrd", "NRRD0004\ntype: float\ndimension: 3\nsizes: " + std::to_string(v.nx) + " " +
                              std::to_string(v.ny) + " " + std::to_string(v.nz) +
                              "\nspacings: 1 1 1\nendian: little\nencoding: raw\n\n" + FloatsOf(v.values));
  Write(prefix + ".object", c.object);
  const tool::BalloonOptions& o = c.s.options;
  bench::LevelSetResult level;
#ifdef BENCH_ITK
  if (itk) level = bench::SegmentWithItk(v, o, c.window, std::atof(argv[4]));
#endif
  if (!level.level.empty()) Write(prefix + ".level", FloatsOf(level.level));
  std::printf(
      "{\"size\": [%d, %d, %d], \"seed\": [%.17g, %.17g, %.17g], \"radius\": %.17g, \"threshold\": %.17g, "
      "\"bright\": %s, \"itk_seconds\": %.3f, \"itk_iterations\": %u, \"itk_at_rest\": %s}\n",
      v.nx, v.ny, v.nz, o.seeds[0][0], o.seeds[0][1], o.seeds[0][2], o.radius, o.threshold.value,
      o.threshold.bright ? "true" : "false", level.seconds, level.iterations, level.at_rest ? "true" : "false");
  return 0;
}

int RunDistance(const char* name, const char* path) {
  tool::Phantom phantom;
  Check(tool::make_phantom(name, tool::default_noise_seed, phantom));
  tool::TriangleMesh mesh;
  Check(tool::read_mesh(path, mesh));
  double mean = 0, most = 0;
  for (size_t i = 0; i < mesh.positions.size(); i += 3) {
    const double* p = &mesh.positions[i];
    const double one = tool::distance_to_surface(phantom, p[0], p[1], p[2]);
    mean += one / (static_cast<double>(mesh.positions.size()) / 3);
    most = std::max(most, one);
  }
  std::printf("[%.6f, %.6f]\n", mean, most);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 5 && std::strcmp(argv[1], "case") == 0) return RunCase(argc, argv);
  if (argc == 4 && std::strcmp(argv[1], "distance") == 0) return RunDistance(argv[2], argv[3]);
  Fail("see the head of segment_peers.cpp");
}
