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

Status Surface::allocate() {
  tpa_issue issue;
  tpa_arena_size size;
  context_ = nullptr;
  bytes_ = 0;
  if (tpa_arena_query(&config_, &size, &issue) != TPA_OK) return failure(describe(issue));
  const size_t wanted = static_cast<size_t>(std::min<uint64_t>(size.bytes, bounds_.bytes));
  const size_t rounded = std::max<size_t>(1, (wanted + size.alignment - 1) / size.alignment) * size.alignment;
  block_.reset(std::aligned_alloc(size.alignment, rounded));
  if (block_ == nullptr) return failure("cannot allocate " + std::to_string(rounded) + " bytes");
  bytes_ = wanted;
  if (tpa_init(block_.get(), bytes_, &config_, &context_, &issue) != TPA_OK) return failure(describe(issue));
  return success();
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

Status Surface::reload(const TriangleMesh& mesh) {
  const tpa_mesh_input input = input_of(mesh);
  tpa_issue issue;
  return tpa_load(context_, &input, &issue) == TPA_OK ? success() : failure(describe(issue));
}

Status Surface::start(const tpa_config& config, const TriangleMesh& mesh) {
  config_ = config;
  config_.max_vertices = static_cast<uint32_t>(std::min<uint64_t>(config.max_vertices, bounds_.vertices));
  if (Status s = allocate(); !s) return s;
  return reload(mesh);
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

// Raises the limit of the issue, and takes a block of the new size. On failure the config is as before, the block gone.
Status Surface::grow(const tpa_issue& issue) {
  const tpa_config before = config_;
  const auto raise = [&](uint32_t& limit, uint64_t most) {
    if (issue.needed > most) return false;
    const uint64_t wanted = std::min(most, std::max(2 * issue.available, issue.needed + issue.needed / 4));
    limit = static_cast<uint32_t>(wanted);
    return true;
  };
  bool raised = false;
  switch (issue.limit) {
    case TPA_LIMIT_VERTICES: raised = raise(config_.max_vertices, bounds_.vertices); break;
    case TPA_LIMIT_TRIANGLES: raised = raise(config_.max_triangles, 1u << 30); break;
    case TPA_LIMIT_CONTACTS: raised = raise(config_.max_contacts, 1u << 30); break;
    case TPA_LIMIT_CUT: raised = raise(config_.max_cut_edges, 1u << 28); break;
    case TPA_LIMIT_EVENTS: raised = raise(config_.max_events, 1u << 28); break;
    case TPA_LIMIT_COMPONENTS: raised = raise(config_.max_components, 1u << 28); break;
    case TPA_LIMIT_PIECES: raised = raise(config_.max_pieces, 1u << 28); break;
    default: break;
  }
  Status s = raised ? allocate() : failure(describe(issue));
  if (!s) config_ = before;
  return s;
}

Status Surface::resume(const tpa_config& config, std::string_view state) {
  config_ = config;
  config_.max_vertices = static_cast<uint32_t>(std::min<uint64_t>(config.max_vertices, bounds_.vertices));
  Status room = allocate();
  at_limit_ = !room;
  while (room) {
    tpa_issue issue;
    const tpa_status status = tpa_restore(context_, state.data(), state.size(), &issue);
    if (status == TPA_OK) return success();
    if (status != TPA_E_LIMIT) return failure(describe(issue));
    room = grow(issue);
    at_limit_ = !room;
  }
  return room;
}

Status Surface::run(const std::function<tpa_status(tpa_context*, tpa_issue*)>& work) {
  at_limit_ = false;
  for (;;) {
    tpa_issue issue;
    const tpa_status status = work(context_, &issue);
    if (status == TPA_OK) return success();
    if (status != TPA_E_LIMIT) return failure(describe(issue));
    const TriangleMesh mesh = copy();
    if (Status s = grow(issue); !s) {
      at_limit_ = true;
      const Status back = allocate();
      return back && reload(mesh) ? s : back;
    }
    if (Status s = reload(mesh); !s) return s;
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
