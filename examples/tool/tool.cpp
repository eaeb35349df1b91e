// SPDX-License-Identifier: MIT
// The command-line tool `topoadapt`.
#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <new>
#include <stdexcept>

#include "tool/commands.h"
#include "tool/io/files.h"
#include "topoadapt.h"

namespace tool {

Progress::Progress(bool quiet)
    : wanted_(!quiet && isatty(STDERR_FILENO) != 0), start_(clock_seconds()), last_(start_) {}

Progress::~Progress() {
  if (shown_) std::fprintf(stderr, "\r\033[K");
}

void Progress::show(const std::string& line) {
  const double now = clock_seconds();
  if (!wanted_ || now - start_ < 1 || now - last_ < 0.1) return;
  last_ = now;
  shown_ = true;
  std::fprintf(stderr, "\r\033[K%s", line.c_str());
  std::fflush(stderr);
}

namespace {

bool asks_for_help(int count, const char* const* words) {
  for (int i = 0; i < count && std::strcmp(words[i], "--") != 0; ++i)
    if (std::strcmp(words[i], "--help") == 0) return true;
  return false;
}

// Lists and summaries that standard output has not taken are a failure, too. Memory beyond what was checked beforehand
// is refused like other bad input.
int run_command(int (*run)(int, const char* const*), int count, const char* const* words) {
  try {
    const int code = run(count, words);
    const bool written = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
    return written || code == 2 ? code : refuse(failure("standard output: writing failed"));
  } catch (const std::bad_alloc&) {
    return refuse(failure("not enough memory"));
  } catch (const std::length_error&) {
    return refuse(failure("not enough memory"));
  }
}

}  // namespace

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
    std::fputs(help_of(""), stdout);
    return 0;
  }
  for (const Command& c : commands)
    if (argc > 1 && std::strcmp(argv[1], c.name) == 0) {
      if (!asks_for_help(argc - 2, argv + 2)) return run_command(c.run, argc - 2, argv + 2);
      std::fputs(help_of(c.name), stdout);
      return 0;
    }
  if (argc > 1) return refuse(failure("unknown command '", argv[1], "'; topoadapt --help lists the commands"));
  std::fputs(help_of(""), stderr);
  return 2;
}
