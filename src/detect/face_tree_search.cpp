// SPDX-License-Identifier: MIT
// The part of face_tree that serves all searches.
#include "detect/face_tree.h"

namespace tpa {

void face_tree_detail::search(const FaceTree& tree, const Box& query, u32 from, LeafVisitor visitor) {
  // Entries: level and node, in a single number.
  u64 stack[most_tree_levels * tree_branching];
  const auto entry = [](u32 level, u32 node) { return u64{level} << 32 | node; };
  u32 size = 0;
  const BroadBox q = broad(query);
  const ConstBoxLanes nodes = lanes_of(tree.node);
  if (tree.count > 0) stack[size++] = entry(tree.levels - 1, 0);
  while (size > 0) {
    const u64 last = stack[--size];
    const u32 level = static_cast<u32>(last >> 32), node = static_cast<u32>(last);
    // The node is the first of a row of eight siblings; boxes beyond the end are empty.
    const u32 at = tree.level_first[level] + node;
    u32 near = bits_of(lanes_meeting(nodes, at, q)) | bits_of(lanes_meeting(nodes, at + 4, q)) << 4;
    const u32 least = from >> tree_branching_bits * level;
    if (least > node) near &= 0xFFu << min_of(least - node, tree_branching);
    if (level == 0) {
      for (u32 rest = near; rest != 0; rest &= rest - 1)
        if (!visitor.visit(visitor.data, node + static_cast<u32>(__builtin_ctz(rest)))) return;
      continue;
    }
    while (near != 0) {
      const u32 i = 31 - static_cast<u32>(__builtin_clz(near));
      near ^= 1u << i;
      if (visitor.enters != nullptr && !visitor.enters(visitor.data, at + i)) continue;
      stack[size++] = entry(level - 1, tree_branching * (node + i));
    }
  }
}

}  // namespace tpa
