// SPDX-License-Identifier: MIT
// Findings lie in the build folder, wherever a target is started, unless its command names another place.
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  static std::string prefix = "-artifact_prefix=" TOPOADAPT_FUZZ_FOUND "/";
  static std::vector<char*> arguments(*argv, *argv + *argc);
  for (const char* argument : arguments)
    if (std::strncmp(argument, "-artifact_prefix=", 17) == 0) return 0;
  std::error_code ignored;  // libFuzzer says where it cannot write
  std::filesystem::create_directories(TOPOADAPT_FUZZ_FOUND, ignored);
  arguments.insert(arguments.begin() + 1, prefix.data());
  *argc = static_cast<int>(arguments.size());
  arguments.push_back(nullptr);
  *argv = arguments.data();
  return 0;
}
