// SPDX-License-Identifier: MIT
// wrong_calls: calls that must be refused, with the status that the header promises, and nothing changed.
#pragma once

#include <vector>

#include "blocks.h"
#include "bytes.h"

namespace fuzz {

// Restores a damaged copy of a saved state, possibly empty. True if the library took the copy, as a state like others.
bool DamageState(Bytes& in, const Owner& o, std::vector<uint8_t> state);
// NULL, foreign contexts, wrong sizes of structures.
void CallWrongly(Bytes& in, const Owner& o);
uint64_t WrongCalls();

}  // namespace fuzz
