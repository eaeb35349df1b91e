// SPDX-License-Identifier: MIT
// step_contacts: the contacts of a transaction, pass by pass (section 3). The first pass looks at the faces that moved,
// later passes at the faces round the last events.
#pragma once

#include "step/attempt.h"

namespace tpa {

// All contacts of the present mesh, into w.detection; the near faces stand afterwards. O(V + contacts).
void detect_all(Workspace& w, const Exec& exec);

// The contacts of the moved faces; of all faces in tpa_adapt. O(moved faces) while few vertices moved and the near
// faces stand, else O(V).
void detect_first(Attempt& a);

// The contacts of the faces round w.work_vertices, the vertices of the last events.
void detect_again(Attempt& a);

// False, with the issue filled in, for more contacts than max_contacts.
bool contacts_fit(Attempt& a);

}  // namespace tpa
