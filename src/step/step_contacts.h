// SPDX-License-Identifier: MIT
// step_contacts: the contacts of a transaction, pass by pass (section 3). The first pass looks at the faces that moved,
// later passes at the faces round the last events. In mode TPA_DETECT_VERTEX_HASH passes begin with the contacts that
// the vertex hash finds in the whole mesh; once it finds none, complete detection tells the contacts that it missed,
// and further passes detect completely.
#pragma once

#include "step/attempt.h"

namespace tpa {

// All contacts of the present mesh, into w.detection; the near faces stand afterwards. O(V + contacts).
void detect_all(Workspace& w, const Exec& exec);

// The contacts of the moved faces; of all faces in tpa_adapt. The near faces stand afterwards. O(moved faces) while few
// vertices moved and the near faces stand; else, and by the vertex hash, O(V).
void detect_first(Attempt& a);

// The contacts of the faces listed and marked in w.relocation. Clears the marks.
void detect_listed(Attempt& a);

// The contacts of the faces round w.work_vertices, the vertices of the last events.
void detect_again(Attempt& a);

// The contacts that the vertex hash missed: those of all faces changed by the transaction; of all faces in tpa_adapt.
// From here on the attempt detects completely. O(V).
void detect_missed(Attempt& a);

// Are the contacts known, and within limit and allowance (step/allowance.h)?
Outcome check_contacts(Attempt& a);

// Lists and marks the faces in contact.
void collect_in_contact(Workspace& w);

// The vertex hash finds parts of seams, but whoever treats a contact needs the whole seam. Adds the contacts of the
// faces in contact, and so on along the seams; detects completely after a few rounds. Returns check_contacts().
// O(contacts).
Outcome follow_seams(Attempt& a);

// Do the listed and marked faces meet nothing beyond the known contacts? Otherwise the contacts become those of all
// listed faces. Clears the marks. Pre: the faces in contact are listed.
bool listed_meet_no_more(Attempt& a);

}  // namespace tpa
