// SPDX-License-Identifier: MIT
// paper_way: contacts as small things, resolved as in the paper (section 5, steps 1 to 7): the clusters of colliding
// vertices go, and handles and caps close what is left. Passes go on while new surfaces meet something.
#pragma once

#include "islands/attempt.h"

namespace tpa {

// Resolves the contacts in w.detection. Blocked where a contact is not small, where a piece stays open, or where the
// region changes by more than the ledger of the island allows.
Outcome go_papers_way(Attempt& a);

}  // namespace tpa
