// SPDX-License-Identifier: MIT
#include "base/disjoint_sets.h"

namespace tpa {

u32 find_set(u32* parent, u32 i) {
  return find_set([parent](u32 k) -> u32& { return parent[k]; }, i);
}

void join_sets(u32* parent, u32 a, u32 b) {
  join_sets([parent](u32 k) -> u32& { return parent[k]; }, a, b);
}

}  // namespace tpa
