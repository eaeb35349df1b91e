// SPDX-License-Identifier: MIT
#include <itkCommand.h>
#include <itkImage.h>
#include <itkMultiThreaderBase.h>
#include <itkThresholdSegmentationLevelSetImageFilter.h>
#include <time.h>

#include <algorithm>
#include <cmath>

#include "level_set.h"

namespace bench {

namespace {

using Image = itk::Image<float, 3>;
using Filter = itk::ThresholdSegmentationLevelSetImageFilter<Image, Image>;

Image::Pointer ImageOf(const tool::Volume& volume) {
  const auto image = Image::New();
  Image::RegionType region;
  region.SetSize({static_cast<itk::SizeValueType>(volume.nx), static_cast<itk::SizeValueType>(volume.ny),
                  static_cast<itk::SizeValueType>(volume.nz)});
  image->SetRegions(region);
  image->Allocate();
  std::copy(volume.values.begin(), volume.values.end(), image->GetBufferPointer());
  return image;
}

// Distance from the seed's ball, negative inside.
Image::Pointer BallOf(const tool::Volume& volume, const tool::BalloonOptions& options) {
  const auto image = ImageOf(volume);
  float* to = image->GetBufferPointer();
  for (int z = 0; z < volume.nz; ++z)
    for (int y = 0; y < volume.ny; ++y)
      for (int x = 0; x < volume.nx; ++x) {
        const double d[3] = {x - options.seeds[0][0], y - options.seeds[0][1], z - options.seeds[0][2]};
        *to++ = static_cast<float>(std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) - options.radius);
      }
  return image;
}

// Where the level set passes between two neighbours, by linear interpolation: the vertices of marching cubes.
void CollectCrossings(const tool::Volume& volume, const float* level, std::vector<double>& points) {
  const int size[3] = {volume.nx, volume.ny, volume.nz};
  for (int z = 0; z < size[2]; ++z)
    for (int y = 0; y < size[1]; ++y)
      for (int x = 0; x < size[0]; ++x) {
        const int at[3] = {x, y, z};
        const double here = static_cast<double>(level[volume.index(x, y, z)]);
        for (int k = 0; k < 3; ++k) {
          if (at[k] + 1 == size[k]) continue;
          const double there = static_cast<double>(level[volume.index(x + (k == 0), y + (k == 1), z + (k == 2))]);
          if ((here < 0) == (there < 0)) continue;
          for (int i = 0; i < 3; ++i) points.push_back(at[i] + (i == k ? here / (here - there) : 0));
        }
      }
}

double Now() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

constexpr uint32_t look_interval = 25, looks_at_rest = 4, most_iterations = 5000;

// Looks at the surface now and then, and stops the filter when it is at rest.
struct Watch {
  const tool::Volume& volume;
  Filter& filter;
  double most_seconds;
  double start = Now(), aside = 0;  // the time that looking took
  std::vector<LevelSetResult> looks;
  std::vector<double> voxels;  // inside

  void Look() {
    const uint32_t iteration = static_cast<uint32_t>(filter.GetElapsedIterations());
    const double begin = Now();
    const bool is_last = begin - start - aside > most_seconds;
    if (iteration % look_interval != 0 && !is_last) return;
    looks.push_back({begin - start - aside, false, iteration, {}, {}});
    const float* level = filter.GetOutput()->GetBufferPointer();
    CollectCrossings(volume, level, looks.back().points);
    looks.back().level.assign(level, level + volume.values.size());
    if (looks.size() > looks_at_rest + 1) looks[looks.size() - looks_at_rest - 2].level = {};
    voxels.push_back(
        static_cast<double>(std::count_if(level, level + volume.values.size(), [](float x) { return x < 0; })));
    if (is_last || AtRest()) filter.SetNumberOfIterations(iteration);
    aside += Now() - begin;
  }
  bool AtRest() const {
    return voxels.size() > looks_at_rest &&
           std::fabs(voxels.back() - voxels[voxels.size() - 1 - looks_at_rest]) < 0.001 * voxels.back();
  }
  LevelSetResult Result() const {
    if (looks.empty()) return {};
    LevelSetResult result = looks[AtRest() ? looks.size() - 1 - looks_at_rest : looks.size() - 1];
    result.at_rest = AtRest();
    return result;
  }
};

}  // namespace

LevelSetResult SegmentWithItk(const tool::Volume& volume, const tool::BalloonOptions& options, const GreyWindow& window,
                              double most_seconds) {
  itk::MultiThreaderBase::SetGlobalMaximumNumberOfThreads(1);
  const auto feature = ImageOf(volume), ball = BallOf(volume, options);
  const auto filter = Filter::New();
  filter->SetInput(ball);
  filter->SetFeatureImage(feature);
  filter->SetUpperThreshold(window.upper);
  filter->SetLowerThreshold(window.lower);
  // As in the example of the ITK Software Guide, but for the criterion, by which parts of slow speed would stay behind.
  filter->SetPropagationScaling(1.0);
  filter->SetCurvatureScaling(1.0);
  filter->SetMaximumRMSError(0);
  filter->SetNumberOfIterations(most_iterations);
  filter->SetIsoSurfaceValue(0);
  Watch watch{volume, *filter, most_seconds};
  const auto command = itk::SimpleMemberCommand<Watch>::New();
  command->SetCallbackFunction(&watch, &Watch::Look);
  filter->AddObserver(itk::IterationEvent(), command);
  filter->Update();
  return watch.Result();
}

}  // namespace bench
