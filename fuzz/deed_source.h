// SPDX-License-Identifier: MIT
// deed_source: meshes, configs and deeds out of a fuzzer's bytes. Meshes are small; many coordinates lie on coarse
// grids, where ties are common.
#pragma once

#include "bytes.h"
#include "deeds.h"

namespace fuzz {

// One to three bodies, closed, tangled or not.
Mesh MeshFrom(Bytes& in);
// Limits that are often just about enough, or not; other fields within their ranges.
tpa_config ConfigFrom(Bytes& in);
// Other limits.
void ChangeLimits(Bytes& in, tpa_config& config);
// A call for a context with this mesh (empty: without a mesh); few of them are to be refused.
Deed DeedFrom(Bytes& in, const Mesh& mesh);

}  // namespace fuzz
