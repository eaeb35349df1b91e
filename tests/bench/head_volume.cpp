// SPDX-License-Identifier: MIT
// head_volume SIDE FILE.nrrd: a volume like a head, for the time of `topoadapt segment`: a skin, and in it a folded
// brain on a stem that joins both. Folds are some five voxels wide whatever the side. Gaussian noise of 4 %.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

namespace {

struct Place {
  double x, y, z;
};

double InEllipsoid(const Place& p, double a, double b, double c) {
  return (1 - std::hypot(p.x / a, p.y / b, p.z / c)) * (a + b + c) / 3;
}

// Above 0 within the folds, below 0 in the gaps between them: both sides of a gyroid.
double InFold(const Place& p, double scale) {
  const double w = 2 * 3.14159265358979323846 / std::max(16.0, 26 * scale);
  const double x = p.x + 4 * std::sin(p.y * w / 2.7), y = p.y + 4 * std::sin(p.z * w / 2.3),
               z = p.z + 4 * std::sin(p.x * w / 2.9);
  const double gyroid =
      std::sin(w * x) * std::cos(w * y) + std::sin(w * y) * std::cos(w * z) + std::sin(w * z) * std::cos(w * x);
  return std::fabs(gyroid) / w / 1.3 - 1.6;
}

// Depth within the head, in voxels.
double DepthAt(const Place& p, double s) {
  const double skin = InEllipsoid(p, 112 * s, 95 * s, 100 * s), skull = InEllipsoid(p, 104 * s, 87 * s, 92 * s);
  const double brain = InEllipsoid(p, 96 * s, 79 * s, 84 * s);
  const double folded = std::min(brain, std::max(InFold(p, s), brain - 22 * s));
  const double stem = std::min({22 * s - std::hypot(p.x, p.y), -p.z, skin});
  return std::max({folded, std::min(skin, -skull), stem});
}

}  // namespace

int main(int count, char** words) {
  const int side = count == 3 ? std::atoi(words[1]) : 0;
  std::FILE* file = side > 0 ? std::fopen(words[2], "wb") : nullptr;
  if (file == nullptr) return 2;
  std::mt19937 random(1);
  std::normal_distribution<float> noise(0, 40);
  std::vector<int16_t> greys;
  const double half = side / 2.0;
  for (int k = 0; k < side; ++k)
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i) {
        const double depth = DepthAt({i - half, j - half, k - half}, side / 256.0);
        const double grey = 1000 * std::clamp(0.5 + depth / 1.5, 0.0, 1.0) + static_cast<double>(noise(random));
        greys.push_back(static_cast<int16_t>(std::lround(grey)));
      }
  std::fprintf(file, "NRRD0004\ntype: short\ndimension: 3\nsizes: %d %d %d\nspacings: 1 1 1\n", side, side, side);
  std::fprintf(file, "encoding: raw\nendian: little\n\n");
  const bool written = std::fwrite(greys.data(), sizeof greys[0], greys.size(), file) == greys.size();
  return std::fclose(file) == 0 && written ? 0 : 1;
}
