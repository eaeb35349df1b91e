// SPDX-License-Identifier: MIT
// segment_bench: the phantoms of the paper, segmented by the balloon of the examples and by ITK's level sets, from the
// same seed and to the same threshold. Prints seconds of processor time, and the distances of both surfaces to the true
// one in voxels; and how large the events of the balloon are: the pairs of triangles that a step begins with, for each
// of the contact groups that it treats.
//
//   segment_bench [--repeats N] [PHANTOM...]
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "level_set.h"
#include "quantile.h"
#include "tool/segment/segmentation.h"

namespace {

// Table 1 of the paper, on a processor of 3.5 GHz.
struct PaperTime {
  const char* phantom;
  double seconds;
};
constexpr PaperTime paper_times[] = {{"cyst", 3}, {"cube-cavity", 33}, {"genus-3", 14}, {"torus-nested", 6}};

struct Distances {
  double mean = 0, largest = 0;
};

Distances DistancesOf(const tool::Phantom& phantom, const std::vector<double>& points) {
  Distances d;
  for (size_t i = 0; i < points.size(); i += 3) {
    const double one = tool::distance_to_surface(phantom, points[i], points[i + 1], points[i + 2]);
    d.mean += one / (static_cast<double>(points.size()) / 3);
    d.largest = std::max(d.largest, one);
  }
  return d;
}

[[noreturn]] void Fail(const tool::Status& status) {
  std::fprintf(stderr, "segment_bench: %s\n", status.message.c_str());
  std::exit(2);
}

double Now() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void PrintEvents(const char* name, const std::vector<double>& contacts) {
  std::printf("%-13s %6zu %8.1f %8.1f %8.1f\n", name, contacts.size(), bench::Quantile(contacts, 0.5),
              bench::Quantile(contacts, 0.9), bench::Quantile(contacts, 1));
}

// `contacts`: of its events.
void Compare(const PaperTime& paper, int repeats, std::vector<double>& contacts) {
  tool::Segmentation s;
  if (tool::Status made = tool::prepare_phantom(paper.phantom, tool::default_noise_seed, s); !made) Fail(made);
  if (tool::Status made = tool::prepare_object(s); !made) Fail(made);
  double ours = 1e30;
  tool::TriangleMesh mesh;
  tool::BalloonResult result;
  for (int i = 0; i < repeats; ++i) {
    tool::Surface surface;
    result = {};
    const double start = Now();
    if (tool::Status done = tool::inflate(s.volume, s.edges, s.options, {}, {}, surface, result, nullptr); !done)
      Fail(done);
    ours = std::min(ours, Now() - start);
    mesh = surface.copy();
  }
  contacts = result.events.contacts;
  const Distances near = DistancesOf(*s.phantom, mesh.positions);
  std::printf("%-13s %6.2f %6.1f  %5.3f %5.2f", paper.phantom, ours, paper.seconds / ours, near.mean, near.largest);
  std::fflush(stdout);
#ifdef BENCH_ITK
  // The grey value of the object, 0, in the middle.
  const float threshold = static_cast<float>(s.options.threshold.value);
  const bench::LevelSetResult theirs = bench::SegmentWithItk(s.volume, s.options, {-threshold, threshold}, HUGE_VAL);
  const Distances d = DistancesOf(*s.phantom, theirs.points);
  std::printf("  %8.2f %6.1f  %5.3f %5.2f  %5u", theirs.seconds, theirs.seconds / ours, d.mean, d.largest,
              theirs.iterations);
#endif
  std::printf("\n");
}

}  // namespace

int main(int argc, char** argv) {
  int repeats = 3;
  std::vector<std::string_view> only;
  for (int i = 1; i < argc; ++i) {
    const std::string_view arg = argv[i];
    if (arg == "--repeats" && i + 1 < argc)
      repeats = std::max(1, std::atoi(argv[++i]));
    else
      only.push_back(arg);
  }
  std::printf("%-13s %6s %6s  %5s %5s", "phantom", "ours s", "/paper", "mean", "max");
#ifdef BENCH_ITK
  std::printf("  %8s %6s  %5s %5s  %5s", "ITK s", "/ours", "mean", "max", "iter.");
#endif
  std::printf("\n");
  std::vector<const char*> done;
  std::vector<std::vector<double>> contacts;
  for (const PaperTime& paper : paper_times) {
    if (!only.empty() && std::find(only.begin(), only.end(), paper.phantom) == only.end()) continue;
    done.push_back(paper.phantom);
    Compare(paper, repeats, contacts.emplace_back());
  }
  std::printf("\ncontacts of an event\n%-13s %6s %8s %8s %8s\n", "phantom", "events", "median", "90 %", "most");
  std::vector<double> all;
  for (size_t i = 0; i < done.size(); ++i) {
    PrintEvents(done[i], contacts[i]);
    all.insert(all.end(), contacts[i].begin(), contacts[i].end());
  }
  PrintEvents("all", all);
}
