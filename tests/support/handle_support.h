// SPDX-License-Identifier: MIT
// handle_support: the library's answers about handles, as the plain lists of oracle/handle_lists.h.
#pragma once

#include <set>
#include <vector>

#include "handles/handles.h"
#include "oracle/handle_lists.h"

namespace handle_support {

using namespace handle_lists;

Sides SidesOf(const tpa::HandleKey& key);
tpa::HandleKey Key(const Sides& sides);
// The keys of the database for k polygons, in `parts` portions of about equal work; in quick tests a stride of them.
std::vector<Sides> PortionOfKeys(int k, size_t part, size_t parts);

Handle Get(const tpa::HandleKey& key, tpa::u64 index);
Handle GetGenerator(const tpa::HandleKey& key, tpa::u32 g);
// All labelled handles of a key; they must be distinct.
std::set<Handle> Expand(const tpa::HandleKey& key);

}  // namespace handle_support
