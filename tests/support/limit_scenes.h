// SPDX-License-Identifier: MIT
// limit_scenes: random calls one after the other on one context, under limits of the caller's choice; and the limits of
// tpa_config by number.
#pragma once

#include <array>

#include "support/support.h"

namespace support {

// TPA_LIMIT_... is the place and one more.
inline constexpr std::array<uint32_t tpa_config::*, 7> limit_fields = {
    &tpa_config::max_vertices, &tpa_config::max_triangles,  &tpa_config::max_contacts, &tpa_config::max_cut_edges,
    &tpa_config::max_events,   &tpa_config::max_components, &tpa_config::max_pieces};
inline constexpr std::array<const char*, 7> limit_names = {"vertices", "triangles",  "contacts", "cut edges",
                                                           "events",   "components", "pieces"};
// Tables with the peaks of the limits.
inline constexpr std::array<const char*, 7> limit_tables = {"position", "corner",     "contact_pairs", "cuts",
                                                            "events",   "components", "scratch"};
inline constexpr std::array<uint32_t, 7> least_limits = {4, 4, 1, 3, 1, 1, 1};
using Limits7 = std::array<uint32_t, 7>;

std::vector<tpa_memory_table> TablesOf(const tpa_context* context);
tpa_config WithLimits(tpa_config config, const Limits7& limits);
// The peaks of a context, at least `least_limits`.
Limits7 PeaksOf(const tpa_context* context);

enum class CallKind { load, adapt, step, remesh, smooth, detect, validate };
inline constexpr std::array<const char*, 7> call_names = {"load",   "adapt",  "step",    "remesh",
                                                          "smooth", "detect", "validate"};

struct CallOf {
  CallKind kind;
  uint64_t seed;  // of targets and options, made for the mesh at hand
};

struct CallScene {
  std::string name;
  Mesh mesh;
  std::vector<CallOf> calls;  // tpa_load first
  double cell = 0;            // of the vertex hash; 0: complete detection
};

// A mesh with a tangle or without, and two to seven calls after its load.
CallScene RandomCallScene(uint64_t seed);
// A single call on a mesh.
CallScene SceneOf(std::string name, Mesh mesh, CallKind kind, uint64_t seed);
// The same by the vertex hash, with cells of a mean edge.
CallScene Hashed(CallScene scene);

// Limits that do not bind, written out.
tpa_config AmpleLimits(const CallScene& scene);

// Makes a call of a scene after the calls before. Appends results and report to `bytes`. exec may be NULL; tpa_load has
// none.
tpa_status MakeCall(tpa_context* context, const CallScene& scene, const CallOf& call, const tpa_exec* exec,
                    std::string& bytes, tpa_issue* issue);

struct CallEnded {
  tpa_status status;
  tpa_issue issue;
  std::string bytes;  // of everything observed after the call, and of its report
};
struct CallsEnded {
  std::vector<CallEnded> calls;  // up to the first that a limit fails
  bool failure_changed = false;  // a failure left other bytes than before
  Limits7 peaks;
  bool limited() const { return calls.back().status == TPA_E_LIMIT; }
};
CallsEnded Play(const CallScene& scene, const tpa_config& config);

}  // namespace support
