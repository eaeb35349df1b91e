// SPDX-License-Identifier: MIT
// The stack of the calls of all scenes, by painting: a thread whose stack is known memory runs the scenes of
// tests/portability, and the bytes that have lost their colour are counted. The bound for all paths is
// stack_usage_test's.
#include <gtest/gtest.h>
#include <pthread.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

extern "C" {
#include "portability/scenes.h"
}

namespace stack_test {
namespace {

constexpr size_t kPainted = size_t{1} << 18, kLimit = 16384;
constexpr unsigned char kPaint = 0xA5;

struct SceneRun {
  uint32_t scene;
  const unsigned char* top;  // of the stack below which the scene works
  std::string line;
};

[[gnu::noinline]] void Play(SceneRun& run) { run.line = scene_line(run.scene); }

void* PlayOnThread(void* data) {
  SceneRun& run = *static_cast<SceneRun*>(data);
  unsigned char here;
  run.top = &here;
  Play(run);
  return nullptr;
}

// Bytes of stack below the thread's first function.
size_t StackOf(SceneRun& run) {
  std::vector<unsigned char> stack(kPainted + 64, kPaint);
  unsigned char* base = stack.data() + (64 - reinterpret_cast<uintptr_t>(stack.data()) % 64);
  pthread_attr_t attributes;
  pthread_t thread;
  EXPECT_EQ(pthread_attr_init(&attributes), 0);
  EXPECT_EQ(pthread_attr_setstack(&attributes, base, kPainted), 0);
  EXPECT_EQ(pthread_create(&thread, &attributes, PlayOnThread, &run), 0);
  EXPECT_EQ(pthread_join(thread, nullptr), 0);
  pthread_attr_destroy(&attributes);
  const unsigned char* deepest = std::find_if(base, base + kPainted, [](unsigned char c) { return c != kPaint; });
  return static_cast<size_t>(run.top - deepest);
}

TEST(Stack, OfAllScenes) {
  for (uint32_t scene = 0; scene < scene_count(); ++scene) {
    SceneRun run{scene, nullptr, {}};
    const size_t bytes = StackOf(run);
    EXPECT_LE(bytes, kLimit) << run.line;
    EXPECT_GE(bytes, 128u) << run.line;  // something was seen
    std::printf("%5zu bytes of stack: %s\n", bytes, run.line.c_str());
  }
}

}  // namespace
}  // namespace stack_test
