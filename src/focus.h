// focus: the faces near an event, their boxes in rows. An event asks hundreds of times what is near, always within
// the same few hundred faces; these are taken out of the grid once, edited here, and written back when it is over.
#pragma once

#include "box_rows.h"
#include "face_list.h"

namespace tpa {

struct Focus : FaceList {
  Box bounds = empty_box;  // all entered faces whose boxes meet this have a slot
  u8* state = nullptr;     // by slot
  BoxRow* box = nullptr;   // of slots; empty: the face is not entered
  BoxRow* row = nullptr;   // of what bounds rows of slots
  BoxRow* block = nullptr;  // of what bounds blocks of slots
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
inline Box box_at(const Focus& focus, u32 slot) {
  return box_at(focus.box[slot / BoxRow::size], slot % BoxRow::size);
}
inline bool is_entered(const Focus& focus, u32 slot) {
  const BoxRow& row = focus.box[slot / BoxRow::size];
  return row.low[0][slot % BoxRow::size] <= row.high[0][slot % BoxRow::size];
}

// A face that has no slot yet. False where there is no room.
bool add(Focus& focus, u32 f, const Box& box, u8 state);
// The same for many: then what bounds them has to be found before they are.
bool take_in(Focus& focus, u32 f, const Box& box, u8 state);
void bound_all(Focus& focus);
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
  for (u32 first = 0; BoxRow::block * first < focus.count; first += BoxRow::size)
    for (u32 near = boxes_meeting(focus.block[first / BoxRow::size], q); near != 0; near &= near - 1) {
      const u32 block = first + static_cast<u32>(__builtin_ctz(near));
      for (u64 met = boxes_meeting(focus.box + BoxRow::size * block, focus.row[block], q); met != 0; met &= met - 1) {
        const u32 slot = BoxRow::block * block + static_cast<u32>(__builtin_ctzll(met));
        if (hit(slot)) return focus.face[slot];
      }
    }
  return none;
}

}  // namespace tpa
