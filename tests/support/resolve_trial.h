// SPDX-License-Identifier: MIT
// resolve_trial: tpa_adapt on one tangled mesh, judged from outside.
#pragma once

#include "oracle/winding_grid.h"
#include "support/tangles.h"

namespace support {

enum class Verdict { right, wrong, not_judged };

struct ResolveTrial {
  tpa_status status = TPA_OK;
  tpa_issue issue{};
  tpa_report report{};
  Mesh result;
  std::string defect;  // of the result: empty if closed, oriented, manifold
  size_t meeting = 0;  // pairs of triangles of the result in contact
  Verdict topology = Verdict::not_judged;
  std::string expected, found;
  std::string oracle;            // by the grids
  bool winding_is_plain = true;  // the result has winding numbers 0 and 1 only
  double volume = 0;             // of the region of winding number >= 1 of the input, by the grid
  double volume_error = 0;       // of the result, as a share of `volume`
  double difference = 0;         // volume between the two regions, likewise
  double seconds = 0;
  bool Clean() const { return status == TPA_OK && defect.empty() && meeting == 0 && report.unresolved == 0; }
};

// Limits that do not bind.
tpa_config GenerousConfig(const Mesh& m);

ResolveTrial TryToResolve(const Family& family, const Tangle& tangle);

// Boundary vertices of the region further than so many mean edges of the contacts from all contacts, and how many of
// those the result lacks, bit for bit.
struct FarVertices {
  size_t all, lost;
};
FarVertices FarFromContacts(const Mesh& before, const Mesh& after, double edges, int cells);

}  // namespace support
