// SPDX-License-Identifier: MIT
// deeds: calls that change the state of a context, with all of their arguments, so that they can be done again in
// another context, environment or order of tasks.
#pragma once

#include <string>
#include <vector>

#include "bytes.h"
#include "support/host_environment.h"
#include "support/sample_meshes.h"
#include "topoadapt.h"

namespace fuzz {

using support::Mesh;

// Who calls: floating-point environment, threads, and the header that the caller was compiled with.
struct Host {
  support::HostEnvironment environment{};
  enum { no_exec, no_tasks, forwards, backwards, shuffled, two_threads } tasks = no_tasks;
  uint32_t unknown_bytes = 0;  // at the end of each structure: of a newer header. A multiple of 4, at most 64
  bool asks_nothing = false;   // no report and no issue
  bool has_old_exec = false;   // a tpa_exec of version 0.1, which ends before the budget
  uint64_t budget = 0;
  uint32_t flags = 0;              // of the exec
  uint32_t cancels_at = TPA_NONE;  // in the parallel_for of this number; 0: before the call
};
Host HostFrom(Bytes& in);

enum class DeedKind { load, move, drop_targets, reset, reorder, adapt, step, advance, remesh, smooth };

struct Deed {
  explicit Deed(DeedKind k) : kind(k) {}
  DeedKind kind;
  Mesh mesh;                                                   // of load
  std::vector<uint32_t> ids;                                   // of move and smooth; empty: NULL
  std::vector<double> positions;                               // of move
  uint32_t count = 0;                                          // of move and smooth
  uint32_t iterations = 0;                                     // of remesh and smooth
  double length = 0;                                           // of remesh; the thickness of advance
  double split_ratio = 0, collapse_ratio = 0, relaxation = 0;  // of remesh
  bool as_floats = false;
};
bool IsWork(DeedKind kind);
bool IsCommit(DeedKind kind);
std::string NameOf(DeedKind kind);

struct Outcome {
  tpa_status status = TPA_OK;
  tpa_issue issue{};    // zeros from a host that asks for none
  tpa_report report{};  // likewise
  uint64_t digest = 0;
  uint64_t units = 0;  // of work
};
Outcome Do(const Deed& deed, tpa_context* context, const Host& host = {});
std::string Text(const Outcome& o);

}  // namespace fuzz
