// step_contacts: the contacts of a transaction, pass by pass (section 3). The first pass looks at the faces that moved,
// later passes at the faces round the last events.
#pragma once

#include "step/attempt.h"

namespace tpa {

// All contacts of the mesh as it is, into w.detection; the near faces stand afterwards. O(V + contacts).
void detect_all(Workspace& w, const Exec& exec);

// The contacts of the faces that moved; of all faces in tpa_adapt. Where few vertices moved and the near faces stand,
// O(faces that moved), else O(V).
void detect_first(Attempt& a);

// The contacts of the faces round w.work_vertices, the vertices of the last events.
void detect_again(Attempt& a);

// The contacts of faces that were in contact before faces were halved, and of the faces round w.work_vertices, the
// vertices that halving made.
void detect_after_halving(Attempt& a);

// False, with the issue filled in, where there are more contacts than max_contacts.
bool contacts_fit(Attempt& a);

}  // namespace tpa
