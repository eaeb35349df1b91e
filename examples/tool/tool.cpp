// SPDX-License-Identifier: MIT
// The command-line tool `topoadapt`.
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstring>

#include "tool/commands.h"
#include "tool/io/files.h"
#include "topoadapt.h"

namespace tool {

namespace {

double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

constexpr const char* usage =
    "usage: topoadapt COMMAND ...\n"
    "  segment (--phantom NAME [--noise-seed N] | VOLUME) [--seed x,y,z] [--radius r] [--threshold T]\n"
    "          [--sigma S] [--bright] [--edge L] [--out M] [--json R] [--quiet]\n"
    "          NAME: cube-cavity, genus-3, torus-nested, cyst; VOLUME: .nii .nii.gz .nrrd .nhdr .mha .mhd\n"
    "  detect MESH [--mode complete|vertex-hash] [--cell l] [--pairs] [--json R]\n"
    "  resolve MESH --out M [--json R]\n"
    "  validate MESH [--json R]\n"
    "  evolve (SCENE [--seed N] [--renumber N] [--turn 0..23] [--steps N] [--stride K] [--no-substeps]\n"
    "          [--out M] [--json R] [--quiet] | --list)\n"
    "  handles SIDES SIDES [SIDES [SIDES]] [--list] [--json R]\n"
    "MESH, M: .obj .off .ply .stl; R: a file, or - for standard output\n"
    "all but handles: [--max-vertices N] [--max-bytes N], bounds for the library\n";

}  // namespace

Progress::Progress(bool quiet) : wanted_(!quiet && isatty(STDERR_FILENO) != 0), start_(seconds()), last_(start_) {}

Progress::~Progress() {
  if (shown_) std::fprintf(stderr, "\r\033[K");
}

void Progress::show(const std::string& line) {
  const double now = seconds();
  if (!wanted_ || now - start_ < 1 || now - last_ < 0.1) return;
  last_ = now;
  shown_ = true;
  std::fprintf(stderr, "\r\033[K%s", line.c_str());
  std::fflush(stderr);
}

}  // namespace tool

int main(int argc, char** argv) {
  using namespace tool;
  struct Command {
    const char* name;
    int (*run)(int, const char* const*);
  };
  constexpr Command commands[] = {{"segment", run_segment},   {"detect", run_detect}, {"resolve", run_resolve},
                                  {"validate", run_validate}, {"evolve", run_evolve}, {"handles", run_handles}};
  if (argc > 1 && std::strcmp(argv[1], "--version") == 0) {
    std::printf("%s\n", tpa_build_info());
    return 0;
  }
  if (argc > 1 && std::strcmp(argv[1], "--help") == 0) {
    std::fputs(usage, stdout);
    return 0;
  }
  for (const Command& c : commands)
    if (argc > 1 && std::strcmp(argv[1], c.name) == 0) return c.run(argc - 2, argv + 2);
  if (argc > 1) return refuse(failure("unknown command '", argv[1], "'; topoadapt --help lists the commands"));
  std::fputs(usage, stderr);
  return 2;
}
