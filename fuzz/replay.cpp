// SPDX-License-Identifier: MIT
// Runs the fuzzing target without a fuzzer: over files (a corpus, a crash), or over pseudo-random inputs.
// replay [--random COUNT SEED] [FILE ...]
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);
extern uint64_t loaded_scenes, untangled_scenes, judged_points;

namespace {

// SplitMix64 (Steele, Lea & Flood 2014).
uint64_t next(uint64_t& state) {
  uint64_t z = state += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

// False where too few inputs got as far as moving about for the promises to have been asked.
bool run_random(uint64_t count, uint64_t seed) {
  for (uint64_t i = 0; i < count; ++i) {
    uint64_t state = seed + i;
    std::vector<uint8_t> bytes(next(state) % 4096);
    for (uint8_t& b : bytes) b = static_cast<uint8_t>(next(state));
    // Printed first, so that a crash names its input.
    std::fprintf(stderr, "\rseed %llu", static_cast<unsigned long long>(seed + i));
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
  }
  std::fprintf(stderr, "\n%llu scenes, %llu loaded, %llu untangled and moved about, %llu points judged\n",
               static_cast<unsigned long long>(count), static_cast<unsigned long long>(loaded_scenes),
               static_cast<unsigned long long>(untangled_scenes), static_cast<unsigned long long>(judged_points));
  return 10 * untangled_scenes >= 6 * count && judged_points >= 10 * count;
}

}  // namespace

int main(int argc, char** argv) {
  int at = 1;
  if (argc > 3 && std::strcmp(argv[1], "--random") == 0) {
    if (!run_random(std::strtoull(argv[2], nullptr, 10), std::strtoull(argv[3], nullptr, 10))) return 1;
    at = 4;
  }
  for (; at < argc; ++at) {
    std::ifstream file(argv[at], std::ios::binary);
    if (!file) {
      std::fprintf(stderr, "cannot read %s\n", argv[at]);
      return 2;
    }
    const std::vector<char> bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    LLVMFuzzerTestOneInput(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
  }
  return 0;
}
