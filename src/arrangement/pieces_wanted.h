// SPDX-License-Identifier: MIT
// pieces_wanted: how many pieces (tpa_config.max_pieces) an exact cut needs. The number is known once all facets are
// divided. Where room runs out, counts of what is known by then bound the number from above.
#pragma once

#include "arrangement/arrangement.h"
#include "detect/contact.h"

namespace tpa {

// The least room with which the same division succeeds. Pre: the facets are divided.
u64 pieces_used(const Arrangement& a);

// At least as many, unless the meter stops: from the crossings of traces, facet by facet. Once the crossings so far
// take more than `refused` pieces, a long count ends: in each further facet, traces that lie side by side along an axis
// count as crossing. So the result is above `refused` only if the whole count is. Pre: all traces are found, and no
// facet has its turn; map.work is scratch. O(t log t) in the traces of a facet, and O(t) for each trace that crosses a
// good part of it.
u64 most_pieces(Arrangement& a, u64 refused);

// Could the traces cross so often that the room for pieces is a small part of what is needed? O(facets).
bool is_crowded(const Arrangement& a);

// Enough to find all traces of the contacts, `faces` with area in contact at most. The usual division needs less.
// O(contacts).
u64 pieces_for_traces(const Mesh& m, Span<const Contact> contacts, u32 faces);

}  // namespace tpa
