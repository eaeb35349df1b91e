// SPDX-License-Identifier: MIT
#include <cstdio>
#include <cstdlib>

#include "arena.h"
#include "detectors.h"

namespace bench {

namespace {

void Say(const char* what, const tpa_issue& issue) {
  char text[256];
  tpa_issue_text(&issue, text, sizeof text);
  std::fprintf(stderr, "%s: %s\n", what, text);
}
[[noreturn]] void Fail(const char* what, const tpa_issue& issue) {
  Say(what, issue);
  std::exit(2);
}

}  // namespace

bool IsLoaded(const Mesh& mesh, const std::string& name) {
  Arena arena(ConfigFor(mesh));
  const tpa_mesh_input input = InputOf(mesh);
  if (arena.context != nullptr && tpa_load(arena.context, &input, &arena.issue) == TPA_OK) return true;
  Say((name + " is left out").c_str(), arena.issue);
  return false;
}

Measured DetectOurs(const Mesh& mesh, int repeats) {
  tpa_config config = ConfigFor(mesh);
  config.max_triangles = TriangleCount(mesh);
  config.max_contacts = 16 * TriangleCount(mesh);  // coincident bodies have many
  config.max_pieces = 4 * TriangleCount(mesh);
  Arena arena(config);
  tpa_issue& issue = arena.issue;
  tpa_context* const context = arena.context;
  if (context == nullptr) Fail("tpa_init", issue);
  const tpa_mesh_input input = InputOf(mesh);
  tpa_contacts contacts{};
  contacts.struct_size = sizeof contacts;
  Measured out;
  // Loaded anew each time: nothing is known from the run before.
  out.seconds = BestTime(
      repeats,
      [&] {
        if (tpa_load(context, &input, &issue) != TPA_OK) Fail("tpa_load", issue);
      },
      [&] {
        if (tpa_detect(context, nullptr, &contacts, &issue) != TPA_OK) Fail("tpa_detect", issue);
      });
  for (uint32_t i = 0; i < contacts.count; ++i) out.pairs.emplace_back(contacts.pairs[i].a, contacts.pairs[i].b);
  return out;
}

}  // namespace bench
