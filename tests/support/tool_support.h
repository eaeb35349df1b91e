// SPDX-License-Identifier: MIT
// tool_support: the tool as a process, in a folder of the running test, and a reader of its reports. For tests with
// TOPOADAPT_TOOL_PATH, the tool's path.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "support/support.h"

namespace support {

struct Ended {
  int exit_code = -1;
  std::string out, err;
};

inline std::string Contents(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

class Tool : public testing::Test {
 protected:
  Tool() {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder = std::filesystem::temp_directory_path() /
             ("topoadapt-tool-test-" + std::string(info->name()) + "-" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
  }
  ~Tool() override { std::filesystem::remove_all(folder); }

  std::string At(const std::string& name) const { return (folder / name).string(); }
  std::string Write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder / name, std::ios::binary) << bytes;
    return At(name);
  }
  std::string Write(const std::string& name, const Mesh& m) const {
    const tool::Status s = tool::write_mesh(At(name), m);
    EXPECT_TRUE(s.ok) << s.message;
    return At(name);
  }

  Ended Call(const std::string& arguments) const {
    const std::string command = std::string("\"") + TOPOADAPT_TOOL_PATH + "\" " + arguments + " > \"" + At("stdout") +
                                "\" 2> \"" + At("stderr") + "\"";
    const int status = std::system(command.c_str());
    Ended run;
    run.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    run.out = Contents(At("stdout"));
    run.err = Contents(At("stderr"));
    return run;
  }

  // The tool's command with a bound on its memory. (Sanitizers reserve terabytes of addresses, so only single
  // allocations have a bound there.)
  static std::string WithinMemory(int megabytes) {
    const std::string most = std::to_string(megabytes), path = std::string("\"") + TOPOADAPT_TOOL_PATH + "\" ";
    return TOPOADAPT_SANITIZED ? "ASAN_OPTIONS=max_allocation_size_mb=" + most + " " + path
                               : "ulimit -v " + most + "000; " + path;
  }

  // Exit 2, nothing on stdout, and one line on stderr with all the words.
  void Refuse(const std::string& arguments, const std::vector<std::string>& words) const {
    const Ended run = Call(arguments);
    EXPECT_EQ(run.exit_code, 2) << arguments << "\n" << run.err;
    EXPECT_EQ(run.out, "") << arguments;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << arguments << "\n" << run.err;
    for (const std::string& word : words)
      EXPECT_NE(run.err.find(word), std::string::npos) << arguments << "\nlacks '" << word << "': " << run.err;
  }

  std::filesystem::path folder;
};

// A crude JSON reader: checks the grammar and collects the keys of the outermost object.
class JsonChecker {
 public:
  explicit JsonChecker(const std::string& text) : text_(text) {
    ok_ = Value(0);
    Space();
    ok_ = ok_ && at_ == text_.size();
  }
  bool ok() const { return ok_; }
  bool has(const std::string& key) const { return keys_.count(key) != 0; }

 private:
  void Space() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
  }
  bool Take(char c) {
    Space();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  bool String(std::string* out) {
    if (!Take('"')) return false;
    for (; at_ < text_.size() && text_[at_] != '"'; ++at_) {
      if (text_[at_] == '\\') ++at_;
      if (out != nullptr) *out += text_[at_];
    }
    return Take('"');
  }
  bool Value(int depth) {
    Space();
    if (at_ >= text_.size()) return false;
    if (text_[at_] == '"') return String(nullptr);
    if (text_[at_] == '{' || text_[at_] == '[') {
      const bool object = text_[at_++] == '{';
      const char end = object ? '}' : ']';
      if (Take(end)) return true;
      do {
        std::string key;
        if (object && !(String(&key) && Take(':'))) return false;
        if (depth == 0) keys_.insert(key);
        if (!Value(depth + 1)) return false;
      } while (Take(','));
      return Take(end);
    }
    for (const char* word : {"true", "false", "null"})
      if (text_.compare(at_, std::string(word).size(), word) == 0) return at_ += std::string(word).size(), true;
    char* after = nullptr;
    std::strtod(text_.c_str() + at_, &after);
    const auto length = static_cast<size_t>(after - (text_.c_str() + at_));
    at_ += length;
    return length > 0;
  }

  std::string text_;
  size_t at_ = 0;
  bool ok_ = false;
  std::set<std::string> keys_;
};

inline void ExpectKeys(const std::string& json, const std::vector<std::string>& keys) {
  const JsonChecker checker(json);
  EXPECT_TRUE(checker.ok()) << json;
  for (const std::string& key : keys) EXPECT_TRUE(checker.has(key)) << "lacks " << key << ": " << json;
}

}  // namespace support
