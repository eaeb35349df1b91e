// SPDX-License-Identifier: MIT
// ledger: how much an island may change the region that the moved mesh bounds, and how much the paper's way has changed
// (docs/exact-cut.md). The bound depends on the faces in contact and on the components that meet, and on nothing else.
#pragma once

#include "islands/attempt.h"

namespace tpa {

// Before the first island is resolved: the volumes of all components before the step. O(V) if some are not known.
void know_volumes(Transaction& t);

// The ledger of an island, from its contacts in w.detection. Pre: know_volumes(). O(contacts).
Ledger open_ledger(const Transaction& t);

// The volume of the region that the present island has taken and added since the move, six times, and a bound on the
// distance of all changes from the faces in contact (t.met). Counted at the points of a grid over all that has changed,
// and of a finer one where the first cannot tell on which side of `bound` the volume lies: losses and gains do not
// cancel, and where the moved surface overlaps itself no region is lost. Needs the near faces of the resolved island,
// and claims of attempts in the paper's way. Overwrites work_vertices. O(claims + faces in the shadow of the grid along
// x, and faces in contact).
RegionChange measure_change(Transaction& t, f64 bound);

}  // namespace tpa
