// SPDX-License-Identifier: MIT
// transaction: an open transaction in the library's own rooms, rolled back in the end.
#pragma once

#include <cstring>

#include "api/api.h"

namespace support {

struct Transaction {
  tpa::Workspace w;

  explicit Transaction(tpa_context* context) : w(tpa::open(*tpa::context_of(context))) {
    w.relocation.detection = &w.detection;
    std::memset(w.marks, 0, w.edit.mesh.vertex_count);
    tpa::begin(w.edit);
    tpa::detect_all(w, {});
  }
  ~Transaction() {
    tpa::forget_clusters(w.clusters);
    tpa::rollback(w.edit);
    tpa::close(w);
  }
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
};

}  // namespace support
