// SPDX-License-Identifier: MIT
// pieces: the loops that a handle joins, and those that get caps (section 5, steps 3 and 5). The paper joins the loops
// of a group with a cluster for each loop. Several loops round one cluster leave the choice: a ring in contact round a
// joint that widens wants a band, a pinched neck wants caps. The volume tells: the closure that changes the region less
// keeps it.
#pragma once

#include "cut/clusters.h"

namespace tpa {

// The loops of a group make one piece if each bounds another cluster. Loops that all bound the same cluster make a
// piece each (nested objects and pinched necks), but two make one piece if a band changes the volume clearly less.
// False for two such loops that both branch, for more than two if caps do not change the volume clearly less than
// a surface that joins all, and for a group with several clusters and more loops than clusters: the paper does not say
// how they belong together.
// Orders the loops by group. `cone`, per vertex, is scratch. O(members + cuts + loops log loops), and O(loops^2) within
// a group.
bool form_pieces(const Mesh& m, Clusters& r, f64* cone);

}  // namespace tpa
