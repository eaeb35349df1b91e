// fallback: what could not be connected is cut out more widely, or stays where it was, in a zone that grows.
#pragma once

#include "step/attempt.h"

namespace tpa {

// Next time no face of the piece's group is halved; or the piece takes the vertices just outside its loops along, only
// where they are `open` if some are; or all of them stay at their old positions.
void give_way(Attempt& a, const Piece& piece, Span<const u32> open);

// The same for all faces that are in contact still.
void give_way_at_contacts(Attempt& a);

// On the old mesh again: the newly frozen vertices take `rings` rings round them along.
void grow_frozen(Workspace& w, u32 rings);

}  // namespace tpa
