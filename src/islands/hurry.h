// SPDX-License-Identifier: MIT
// hurry: the end of the budget, in a call that keeps what is done (TPA_EXEC_KEEP). Islands that are done stay; all
// others are held back (tpa_step, tpa_advance), or left with their contacts (tpa_adapt). The units for that, for the
// gate and for the commit are set aside beforehand. They are estimates: where they do not suffice, the whole call holds
// back all vertices (step/transaction.cpp), with no work but the commit.
#pragma once

#include "islands/attempt.h"

namespace tpa {

// After the detection.
void set_end_aside(Transaction& t);
// After an island that is done: the gate will look at its faces.
void note_edited(Transaction& t);

// Before the gate: only the commit is still to come.
void set_commit_aside(Transaction& t);

// After a stop, with the present island taken back. False if the call has to end. From now on islands try nothing.
bool begin_to_hurry(Transaction& t);

// The islands that were not done before.
u32 count_unfinished(const Transaction& t);

}  // namespace tpa
