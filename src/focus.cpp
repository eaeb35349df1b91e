#include "focus.h"

#include <float.h>

namespace tpa {

void empty_lanes(const BoxLanes& lanes, u32 first, u32 count) {
  for (u32 k = 0; k < 3; ++k)
    for (u32 i = first; i < first + count; ++i) lanes.low[k][i] = FLT_MAX, lanes.high[k][i] = -FLT_MAX;
}

namespace {

// Which of the boxes at .. at + 7 meet q: a bit for each.
u32 row_meeting(const ConstBoxLanes& lanes, u32 at, const BroadBox& q) {
  return bits_of(lanes_meeting(lanes, at, q)) | bits_of(lanes_meeting(lanes, at + 4, q)) << 4;
}

}  // namespace

u64 block_meeting(const BoxLanes& boxes, const BoxLanes& rows, u32 block, const BroadBox& q) {
  const ConstBoxLanes all = lanes_of(boxes);
  u64 met = 0;
  for (u32 near = row_meeting(lanes_of(rows), 8 * block, q); near != 0; near &= near - 1) {
    const u32 row = static_cast<u32>(__builtin_ctz(near));
    met |= u64{row_meeting(all, 8 * (8 * block + row), q)} << 8 * row;
  }
  return met;
}

namespace {

// Some ten events at once, or the crease of a small mesh that runs into itself.
constexpr u32 most_slots = 2048;

u32 slots_for(u64 faces) {
  u32 n = 256;
  while (n < faces && n < most_slots) n *= 2;
  return n;
}

u64 cut(u8* memory, u64 faces, Focus& f) {
  f.capacity = slots_for(faces);
  Carver carver{memory};
  carver.take(f.face, f.capacity);
  carver.take(f.place, 2 * u64{f.capacity});
  carver.take(f.state, f.capacity);
  const auto take_lanes = [&](BoxLanes& lanes, u64 count) {
    for (u32 k = 0; k < 3; ++k) {
      carver.take(lanes.low[k], count);
      carver.take(lanes.high[k], count);
    }
  };
  take_lanes(f.box, f.capacity);
  take_lanes(f.row, f.capacity / 8);
  take_lanes(f.block, f.capacity / 64);
  return carver.bytes;
}

}  // namespace

u64 focus_bytes(u64 faces) {
  Focus f;
  return cut(nullptr, faces, f);
}

Focus open_focus(u8* memory, u32 faces) {
  Focus f;
  cut(memory, faces, f);
  return f;
}

void clear(Focus& f) {
  f.count = 0;
  f.bounds = empty_box;
}

bool add(Focus& f, u32 face, const Box& box, u8 state) {
  if (f.count == f.capacity) return false;
  if (f.count == 0) {
    set_places(f, 2 * f.capacity);
    empty_lanes(f.block, 0, f.capacity / 64);
  }
  // Rows and blocks are read as a whole.
  if (f.count % 64 == 0) empty_lanes(f.row, f.count / 8, 8);
  if (f.count % 8 == 0) empty_lanes(f.box, f.count, 8);
  const u32 slot = add(f, face);
  f.state[slot] = state;
  set_box(f, slot, box);
  return true;
}

// What bounds several slots is only ever widened: an event is short.
void set_box(Focus& f, u32 slot, const Box& box) {
  set_lane(f.box, slot, box);
  widen_lane(f.row, slot / 8, box);
  widen_lane(f.block, slot / 64, box);
}

void take_out(Focus& f, u32 slot) { empty_lanes(f.box, slot, 1); }

}  // namespace tpa
