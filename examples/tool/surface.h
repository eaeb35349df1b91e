// SPDX-License-Identifier: MIT
// surface: the library behind a small C++ holder. A Surface owns the block and takes a larger block when a limit is
// exceeded, so that a program free to allocate need not know sizes beforehand.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tool/io/mesh_io.h"
#include "tool/result.h"
#include "topoadapt.h"

namespace tool {

// A tpa_load view of the mesh, whose arrays stay in the mesh.
tpa_mesh_input input_of(const TriangleMesh& mesh);

// How far a Surface may grow.
struct SurfaceBounds {
  uint64_t vertices = uint64_t{1} << 29;
  uint64_t bytes = SIZE_MAX;
};

class Surface {
 public:
  // Before start(). Sizes beyond the bounds are refused with the library's own words.
  void bound(const SurfaceBounds& bounds) { bounds_ = bounds; }

  // The limits in the config are initial limits.
  Status start(const tpa_config& config, const TriangleMesh& mesh);

  // The same with a state that tpa_save has written.
  Status resume(const tpa_config& config, std::string_view state);

  // Another mesh.
  Status reload(const TriangleMesh& mesh);

  tpa_context* context() const { return context_; }
  tpa_mesh_view view() const;
  size_t arena_bytes() const { return block_.bytes; }
  size_t peak_bytes() const;

  // Calls `work`, which returns the status of a library function. On an exceeded limit: doubles the limit, moves to
  // a larger block (tpa_grow) and calls again. Where that fails, the mesh stays, and at_limit() is true.
  Status run(const std::function<tpa_status(tpa_context*, tpa_issue*)>& work);

  // Has the last run() or resume() failed at a limit or for want of memory?
  bool at_limit() const { return at_limit_; }

  TriangleMesh copy() const;

 private:
  struct Free {
    void operator()(void* p) const;
  };
  struct Block {
    std::unique_ptr<void, Free> memory;
    size_t bytes = 0;
  };

  Status start(const tpa_config& config);
  Status allocate(const tpa_config& config, Block& block) const;
  Status grow(const tpa_issue& issue);

  SurfaceBounds bounds_;
  tpa_config config_{};
  Block block_;
  tpa_context* context_ = nullptr;
  bool at_limit_ = false;
};

std::string describe(const tpa_issue& issue);

}  // namespace tool
