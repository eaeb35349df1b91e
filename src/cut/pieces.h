// SPDX-License-Identifier: MIT
// pieces: the loops that a handle joins, and those that get caps (section 5, steps 3 and 5). Of a group with several
// clusters, the paper joins the loops. Two loops round one cluster are closed by a band or by two caps: a ring in
// contact round a joint that widens wants the band, a pinched neck wants caps. The volume tells: the closure that
// changes the region less keeps it.
#pragma once

#include "cut/clusters.h"

namespace tpa {

// The loops of a group make one piece if each bounds another cluster. Loops that all bound the same cluster make a
// piece each (nested objects and pinched necks), but two of them make one piece if a band changes the volume less than
// caps. Orders the loops by group. False for a group with several clusters and more loops than clusters: the paper does
// not say how they belong together. `cone`, per vertex, is scratch. O(members + cuts + loops log loops).
bool form_pieces(const Mesh& m, Clusters& r, f64* cone);

}  // namespace tpa
