// SPDX-License-Identifier: MIT
// Runs a fuzzing target without a fuzzer: over files and folders of files (a corpus, a finding), or over pseudo-random
// inputs, and says what they reached.
// replay [--random COUNT SEED] [FILE | FOLDER ...]
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "random_bytes.h"
#include "target.h"

namespace {

// False where too few of many inputs got far enough for the promises to have been asked.
bool run_random(uint64_t count, uint64_t seed) {
  for (uint64_t i = 0; i < count; ++i) {
    const std::vector<uint8_t> bytes = fuzz::RandomBytes(seed + i);
    // Printed first, so that a crash names its input.
    std::fprintf(stderr, "\rseed %llu", static_cast<unsigned long long>(seed + i));
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
  }
  std::fprintf(stderr, "\n");
  return count < 10 || fuzz::ReachedEnough(count);
}

bool run_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::fprintf(stderr, "%s\n", path.string().c_str());
  if (!file) return false;
  const std::vector<char> bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  LLVMFuzzerTestOneInput(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
  return true;
}

// In the order of names. False for a file that cannot be read, or a folder without files.
bool run_all(const std::filesystem::path& path) {
  if (!std::filesystem::is_directory(path)) return run_file(path);
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(path)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return !files.empty() && std::all_of(files.begin(), files.end(), run_file);
}

}  // namespace

int main(int argc, char** argv) {
  int at = 1;
  bool is_done = true;
  if (argc > 3 && std::strcmp(argv[1], "--random") == 0) {
    is_done = run_random(std::strtoull(argv[2], nullptr, 10), std::strtoull(argv[3], nullptr, 10));
    at = 4;
  }
  for (; is_done && at < argc; ++at) is_done = run_all(argv[at]);
  std::fprintf(stderr, "%s\n", fuzz::Tally().c_str());
  return is_done ? 0 : 1;
}
