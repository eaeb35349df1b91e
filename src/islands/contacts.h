// SPDX-License-Identifier: MIT
// contacts: the contacts of a transaction (section 3): of what moved, and then of what each island has changed. A
// transaction always detects completely, in both modes of detection.
#pragma once

#include "islands/attempt.h"

namespace tpa {

// All contacts of the present mesh, into w.detection; the near faces stand afterwards. O(V + contacts).
void detect_all(Workspace& w, const Exec& exec);

// The contacts of the moved faces; of all faces in tpa_adapt. The near faces stand afterwards. O(moved faces) while few
// vertices moved and the near faces stand; else O(V).
void detect_moved_faces(Transaction& t);

// The contacts of the faces listed and marked in w.relocation. Clears the marks.
void detect_listed(Workspace& w, const Exec& exec);

// The contacts of the faces round w.work_vertices, the vertices of the last events.
void detect_again(Workspace& w, const Exec& exec);

// The gate of commits without contacts (tpa_remesh, tpa_smooth): the contacts of all faces that the transaction has
// changed or bent. No operation on the way is believed.
void detect_edited(Workspace& w, const Exec& exec);

// Rolls the edit of a failed call back. Near faces that stood, or were made by the call, stand afterwards for the mesh
// before: the next call pays for nothing. Counts no units. O(edits), at most O(V).
void roll_back(Workspace& w);

// Makes the issue one of TPA_E_TANGLED, and returns the status. With more pairs than fit, the first pair is unknown;
// any fixed pair would depend on the thread count.
tpa_status fail_tangled(tpa_issue& issue, const Detection& d);

// Are the contacts known, and within limit and allowance (islands/allowance.h)?
Outcome check_contacts(Attempt& a);

// Notes the faces in contact in t.met. O(contacts).
void note_met(Transaction& t);

// Lists and marks the faces in contact.
void collect_in_contact(Workspace& w);

}  // namespace tpa
