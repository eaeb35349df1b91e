// SPDX-License-Identifier: MIT
// contact: pairs of faces that meet, and how detection (section 3) collects them.
#pragma once

#include "base/sort.h"

namespace tpa {

struct Contact {
  u32 a, b;  // faces, a < b
  friend constexpr bool operator<(Contact p, Contact q) { return p.key() < q.key(); }
  constexpr u64 key() const { return u64{a} << 32 | b; }
};

// Calls visit(f) for both faces of a pair.
template <class Pair, class Visit>
inline void for_both(const Pair& c, Visit visit) {
  visit(c.a);
  visit(c.b);
}

// Marks of vertices for a detection: a corner of a face in contact changes its mark from 1 to 2. So faces in contact
// are known even where their pairs have no room.
struct CornerMarks {
  static constexpr u8 watched = 1, touching = 2;
  const u32* corner = nullptr;  // of the mesh
  u8* vertex = nullptr;         // per vertex

  // Tasks may meet at a vertex, and store the same number.
  void touch(u32 f) const {
    for (u32 h = 3 * f; h < 3 * f + 3; ++h)
      if (__atomic_load_n(vertex + corner[h], __ATOMIC_RELAXED) == watched)
        __atomic_store_n(vertex + corner[h], touching, __ATOMIC_RELAXED);
  }
};

struct Detection {
  Stack<Contact> pairs;  // sorted; if found > capacity, any `capacity` of the pairs
  u64 found = 0;         // number of all pairs
  CornerMarks marks{};   // or nullptr
};

// Arrays of the tasks of a detection, too large for the stack of a caller's thread: a room for each run of for_runs().
struct TaskRooms {
  static constexpr u32 most = 32;
  static constexpr u64 bytes = 40960;  // of a room
  u8* memory = nullptr;                // aligned to arena_alignment
  u32 count = 0;

  template <class Room>
  Room& room(u32 run) const {
    static_assert(sizeof(Room) <= bytes);
    return *reinterpret_cast<Room*>(memory + run * bytes);
  }
};
// Rooms for a mesh: about one for each chunk of a complete detection.
constexpr u32 task_rooms(u32 faces) { return min_of(faces / 2560 + 1, TaskRooms::most); }

// Collects pairs from several threads. The order of arrival depends on the threads; finish() sorts the pairs.
struct ContactSink {
  Detection& out;
  // The number of pairs in two words, since Cortex-M cannot add to 64 bits atomically. When `low` wraps round, new
  // pairs overwrite old ones; by then there are too many for the pairs to matter.
  u32 low = 0, high = 0;

  void add(u32 f, u32 g) {
    if (out.marks.vertex != nullptr) {
      out.marks.touch(f);
      out.marks.touch(g);
    }
    const u32 at = __atomic_fetch_add(&low, u32{1}, __ATOMIC_RELAXED);
    if (at == none) __atomic_fetch_add(&high, u32{1}, __ATOMIC_RELAXED);
    if (at < out.pairs.capacity) out.pairs.data[at] = {min_of(f, g), max_of(f, g)};
  }
  void finish() {
    out.found = u64{high} << 32 | low;
    out.pairs.size = static_cast<u32>(min_of(out.found, u64{out.pairs.capacity}));
    sort_in_place(out.pairs.data, out.pairs.size);
  }
};

}  // namespace tpa
