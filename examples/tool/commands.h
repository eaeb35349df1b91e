// SPDX-License-Identifier: MIT
// commands: the subcommands of the tool. Each returns the exit code: 0 done, 1 the answer is "no", 2 bad usage or input
// (after one line on stderr with cause and place).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

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

// The text that `topoadapt COMMAND --help` prints; null for another word.
const char* help_of(std::string_view command);

// What a command writes, and where to.
struct Outputs {
  std::string mesh, json;  // paths, empty if not wanted; json "-" is standard output
  bool quiet = false;      // neither notes nor progress

  bool summary_wanted() const { return json != "-"; }  // on standard output, which is the report's alone with "-"
};

// The options --out, --json and --quiet, as far as the command knows them. Fails if a file cannot be written.
Status read_outputs(const Arguments& arguments, Outputs& outputs);

// The options --max-vertices and --max-bytes, for every command with a mesh to load.
Status read_bounds(const Arguments& arguments, SurfaceBounds& bounds);

// A line on stderr that is no error.
void note(const Outputs& outputs, const std::string& line);

// Of a steady clock.
double clock_seconds();

// Prints the message of the failure, and returns 2.
int refuse(const Status& status);

// Writes to the file, or to standard output for "-". An empty path writes nothing.
Status write_json(const std::string& path, const JsonWriter& json);
// Opens an object that names the library: version; build with compiler, and commit where it is known.
void begin_report(JsonWriter& json);

// "1 component", "2 components".
std::string counted(uint64_t count, const char* one);

// The first keys of every report on a mesh.
// Genus and volume of components are null where the mesh is open.
void describe_mesh(JsonWriter& json, const TriangleMesh& mesh, bool is_closed = true);
// Members of "options": the options of all commands, as used.
void describe(JsonWriter& json, const SurfaceBounds& bounds);
void describe(JsonWriter& json, const Outputs& outputs);
// Bytes of the block, and of these ever used.
void describe_memory(JsonWriter& json, const Surface& surface);

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
