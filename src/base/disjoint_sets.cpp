#include "base/disjoint_sets.h"

namespace tpa {

u32 find_set(u32* parent, u32 i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

void join_sets(u32* parent, u32 a, u32 b) {
  a = find_set(parent, a);
  b = find_set(parent, b);
  parent[max_of(a, b)] = min_of(a, b);
}

}  // namespace tpa
