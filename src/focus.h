// focus: the faces near an event, their boxes in lanes. An event asks hundreds of times what is near, always within
// the same few hundred faces; these are taken out of the grid once, edited here, and written back when it is over.
#pragma once

#include "box_hash.h"
#include "clusters.h"
#include "face_list.h"

namespace tpa {

// Of boxes side by side: nothing meets an empty one, and an empty one that is widened by a box becomes that.
void empty_lanes(const BoxLanes& lanes, u32 first, u32 count);
inline void set_lane(const BoxLanes& lanes, u32 i, const Box& box) {
TPA_UNROLL(3)
  for (u32 k = 0; k < 3; ++k) lanes.low[k][i] = box.low[k], lanes.high[k][i] = box.high[k];
}
inline void widen_lane(const BoxLanes& lanes, u32 i, const Box& box) {
TPA_UNROLL(3)
  for (u32 k = 0; k < 3; ++k) {
    lanes.low[k][i] = min_of(lanes.low[k][i], box.low[k]);
    lanes.high[k][i] = max_of(lanes.high[k][i], box.high[k]);
  }
}

// Which of the boxes in a block of eight rows, of eight boxes each, meet q: a bit for each box. They are noted before any
// is looked at, since where rows and boxes end that meet it is as good as random.
u64 block_meeting(const BoxLanes& boxes, const BoxLanes& rows, u32 block, const BroadBox& q);

struct Focus : FaceList {
  Box bounds = empty_box;  // all entered faces whose boxes meet this have a slot
  u8* state = nullptr;     // by slot
  BoxLanes box{};          // by slot; low above high: the face is not entered
  BoxLanes row{};          // by eight slots
  BoxLanes block{};        // by eight rows
};

// What the grid behind the focus does not know yet, and what it knows of.
enum : u8 { slot_changed = 1, slot_behind = 2 };

u64 focus_bytes(u64 faces);
Focus open_focus(u8* memory, u32 faces);

// No faces any more.
void clear(Focus& focus);
inline bool is_open(const Focus& focus) { return focus.count > 0; }
// The slot of a face, or none.
inline u32 slot_of(const Focus& focus, u32 f) { return is_open(focus) ? number_of(focus, f) : none; }
inline bool is_entered(const Focus& focus, u32 slot) { return focus.box.low[0][slot] <= focus.box.high[0][slot]; }
inline Box box_at(const Focus& focus, u32 slot) {
  Box b;
  for (u32 k = 0; k < 3; ++k) b.low[k] = focus.box.low[k][slot], b.high[k] = focus.box.high[k][slot];
  return b;
}

// A face that has no slot yet. False where there is no room.
bool add(Focus& focus, u32 f, const Box& box, u8 state);
void set_box(Focus& focus, u32 slot, const Box& box);
void take_out(Focus& focus, u32 slot);

inline bool contains(const Box& outer, const Box& inner) {
  return (outer.low[0] <= inner.low[0]) & (outer.low[1] <= inner.low[1]) & (outer.low[2] <= inner.low[2]) &
         (outer.high[0] >= inner.high[0]) & (outer.high[1] >= inner.high[1]) & (outer.high[2] >= inner.high[2]);
}

// Asks hit(slot) exactly once for each entered face with a slot whose box meets the query, until one answers true;
// returns that face, or none.
template <class Hit>
inline u32 find_focused(const Focus& focus, const BroadBox& q, Hit hit) {
  const ConstBoxLanes blocks = lanes_of(focus.block);
  for (u32 first = 0; 64 * first < focus.count; first += 4)
    for (u32 near = bits_of(lanes_meeting(blocks, first, q)); near != 0; near &= near - 1) {
      const u32 block = first + static_cast<u32>(__builtin_ctz(near));
      for (u64 met = block_meeting(focus.box, focus.row, block, q); met != 0; met &= met - 1) {
        const u32 slot = 64 * block + static_cast<u32>(__builtin_ctzll(met));
        if (hit(slot)) return focus.face[slot];
      }
    }
  return none;
}

}  // namespace tpa
