// SPDX-License-Identifier: MIT
// commands: the subcommands of the tool. Each returns the exit code: 0 done, 1 the answer is "no", 2 bad usage or input
// (after one line on stderr with cause and place).
#pragma once

#include <cstddef>
#include <string>

#include "tool/arguments.h"
#include "tool/json.h"
#include "tool/result.h"
#include "tool/segment/balloon.h"
#include "tool/topology.h"

namespace tool {

int run_segment(int count, const char* const* words);
int run_detect(int count, const char* const* words);
int run_resolve(int count, const char* const* words);
int run_validate(int count, const char* const* words);
int run_evolve(int count, const char* const* words);
int run_handles(int count, const char* const* words);

// The options --max-vertices and --max-bytes, for every command with a mesh to load.
Status read_bounds(const Arguments& arguments, SurfaceBounds& bounds);

// Prints the message of the failure, and returns 2.
int refuse(const Status& status);

// Writes to the file, or to standard output for "-". An empty path writes nothing.
Status write_json(const std::string& path, const JsonWriter& json);

// The first keys of every report on a mesh.
void describe_mesh(JsonWriter& json, const TriangleMesh& mesh);

// A progress line on stderr, for runs over a second when it is a terminal.
class Progress {
 public:
  explicit Progress(bool quiet);
  ~Progress();
  void show(const std::string& line);

 private:
  bool wanted_;
  bool shown_ = false;
  double start_, last_;
};

}  // namespace tool
