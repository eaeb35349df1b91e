// SPDX-License-Identifier: MIT
#include "tool/surface.h"

#include <algorithm>
#include <cstdlib>

namespace tool {

void Surface::Free::operator()(void* p) const { std::free(p); }

std::string describe(const tpa_issue& issue) {
  char text[256];
  tpa_issue_text(&issue, text, sizeof text);
  return text;
}

Status Surface::allocate(const tpa_config& config, Block& block) const {
  tpa_issue issue;
  tpa_arena_size size;
  if (tpa_arena_query(&config, &size, &issue) != TPA_OK) return failure(describe(issue));
  block.bytes = static_cast<size_t>(std::min<uint64_t>(size.bytes, bounds_.bytes));
  block.memory.reset(std::malloc(std::max<size_t>(1, block.bytes)));
  return block.memory != nullptr ? success() : failure("cannot allocate " + std::to_string(block.bytes) + " bytes");
}

tpa_mesh_input input_of(const TriangleMesh& mesh) {
  tpa_mesh_input input{};
  input.struct_size = sizeof input;
  input.vertex_count = static_cast<uint32_t>(mesh.positions.size() / 3);
  input.triangle_count = static_cast<uint32_t>(mesh.triangles.size() / 3);
  input.position_type = TPA_FLOAT64;
  input.index_type = TPA_UINT32;
  input.positions = mesh.positions.data();
  input.triangles = mesh.triangles.data();
  return input;
}

Status Surface::start(const tpa_config& config) {
  config_ = config;
  config_.max_vertices = static_cast<uint32_t>(std::min<uint64_t>(config.max_vertices, bounds_.vertices));
  context_ = nullptr;
  if (Status s = allocate(config_, block_); !s) return s;
  tpa_issue issue;
  const tpa_status status = tpa_init(block_.memory.get(), block_.bytes, &config_, &context_, &issue);
  return status == TPA_OK ? success() : failure(describe(issue));
}

Status Surface::start(const tpa_config& config, const TriangleMesh& mesh) {
  Status s = start(config);
  return s ? reload(mesh) : s;
}

Status Surface::resume(const tpa_config& config, std::string_view state) {
  Status s = start(config);
  at_limit_ = !s;
  if (!s) return s;
  return run([&](tpa_context* c, tpa_issue* issue) { return tpa_restore(c, state.data(), state.size(), issue); });
}

Status Surface::reload(const TriangleMesh& mesh) {
  const tpa_mesh_input input = input_of(mesh);
  return run([&](tpa_context* c, tpa_issue* issue) { return tpa_load(c, &input, issue); });
}

tpa_mesh_view Surface::view() const {
  tpa_mesh_view view{};
  view.struct_size = sizeof view;
  tpa_view(context_, &view);
  return view;
}

TriangleMesh Surface::copy() const {
  const tpa_mesh_view v = view();
  TriangleMesh mesh;
  mesh.positions.assign(v.positions, v.positions + 3 * size_t{v.vertex_count});
  mesh.triangles.assign(v.triangles, v.triangles + 3 * size_t{v.triangle_count});
  return mesh;
}

// Raises the limit of the issue, and moves into a block of the new size. On failure all is as before.
Status Surface::grow(const tpa_issue& issue) {
  tpa_config config = config_;
  const auto raise = [&](uint32_t& limit, uint64_t most) {
    if (issue.needed > most) return false;
    const uint64_t wanted = std::min(most, std::max(2 * issue.available, issue.needed + issue.needed / 4));
    limit = static_cast<uint32_t>(wanted);
    return true;
  };
  bool raised = false;
  switch (issue.limit) {
    case TPA_LIMIT_VERTICES: raised = raise(config.max_vertices, bounds_.vertices); break;
    case TPA_LIMIT_TRIANGLES: raised = raise(config.max_triangles, 1u << 30); break;
    case TPA_LIMIT_CONTACTS: raised = raise(config.max_contacts, 1u << 30); break;
    case TPA_LIMIT_CUT: raised = raise(config.max_cut_edges, 1u << 28); break;
    case TPA_LIMIT_EVENTS: raised = raise(config.max_events, 1u << 28); break;
    case TPA_LIMIT_COMPONENTS: raised = raise(config.max_components, 1u << 28); break;
    case TPA_LIMIT_PIECES: raised = raise(config.max_pieces, 1u << 28); break;
    default: break;
  }
  if (!raised) return failure(describe(issue));
  Block block;
  if (Status s = allocate(config, block); !s) return s;
  tpa_context* bigger = nullptr;
  tpa_issue refusal;
  if (tpa_grow(context_, block.memory.get(), block.bytes, &config, &bigger, &refusal) != TPA_OK)
    return failure(describe(refusal));
  config_ = config;
  block_ = std::move(block);
  context_ = bigger;
  return success();
}

Status Surface::run(const std::function<tpa_status(tpa_context*, tpa_issue*)>& work) {
  for (;;) {
    tpa_issue issue;
    const tpa_status status = work(context_, &issue);
    at_limit_ = status == TPA_E_LIMIT;
    if (status == TPA_OK) return success();
    if (status != TPA_E_LIMIT) return failure(describe(issue));
    if (Status s = grow(issue); !s) return s;
  }
}

size_t Surface::peak_bytes() const {
  std::vector<tpa_memory_table> tables(128);
  uint32_t count = 0;
  if (tpa_memory_stats(context_, tables.data(), static_cast<uint32_t>(tables.size()), &count) != TPA_OK) return 0;
  size_t bytes = 0;
  for (uint32_t i = 0; i < std::min<uint32_t>(count, 128); ++i) {
    const tpa_memory_table& r = tables[i];
    bytes += r.limit == 0 ? r.bytes
                          : static_cast<size_t>(static_cast<double>(r.bytes) * static_cast<double>(r.peak) /
                                                static_cast<double>(r.limit));
  }
  return bytes;
}

}  // namespace tool
