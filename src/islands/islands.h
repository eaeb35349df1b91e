// SPDX-License-Identifier: MIT
// islands: contacts that end together (docs/architecture.md). Contacts whose clusters touch, or meet, are of one island
// (section 5: the groups of colliding components). Each island has its own attempts, and a failed attempt is taken back
// alone. So an outcome depends on the faces that meet there, their surroundings and their components, and on nothing
// else. Rigid-body engines solve islands of bodies for the same reason.
#pragma once

#include "islands/attempt.h"

namespace tpa {

// Resolves the contacts in w.detection. Clean: no face that the transaction has moved or made meets another; in
// tpa_adapt, contacts of islands without a solution stay, and `unresolved` of the report counts them. Limit, stopped,
// and blocked, never expected since the mesh before a step is free of contacts: the transaction is to be rolled back,
// after forget_islands().
Outcome settle_islands(Transaction& t);

// Before the commit or the rollback: no element has an owner any more. O(claims of all islands).
void forget_islands(Transaction& t);

}  // namespace tpa
