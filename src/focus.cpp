#include "focus.h"

#include "arena.h"

namespace tpa {

namespace {

// Some ten events at once, or the crease of a small mesh that runs into itself.
constexpr u32 most_slots = 2048;

u32 slots_for(u64 faces) {
  u32 n = 256;
  while (n < faces && n < most_slots) n *= 2;
  return n;
}

u32 blocks_of_rows(const Focus& f) {
  constexpr u32 slots = BoxRow::block * BoxRow::size;
  return (f.capacity + slots - 1) / slots;
}

u64 cut(u8* memory, u64 faces, Focus& f) {
  f.capacity = slots_for(faces);
  Carver carver{memory};
  carver.take(f.face, f.capacity);
  carver.take(f.place, 2 * u64{f.capacity});
  carver.take(f.state, f.capacity);
  carver.take(f.box, f.capacity / BoxRow::size + f.capacity / BoxRow::block + blocks_of_rows(f));
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
  f.row = f.box + f.capacity / BoxRow::size;
  f.block = f.row + f.capacity / BoxRow::block;
  return f;
}

void clear(Focus& f) {
  f.count = 0;
  f.bounds = empty_box;
}

bool take_in(Focus& f, u32 face, const Box& box, u8 state) {
  if (f.count == f.capacity) return false;
  if (f.count == 0) {
    set_places(f, 2 * f.capacity);
    for (u32 i = 0; i < blocks_of_rows(f); ++i) clear(f.block[i]);
  }
  // Rows are read as a whole.
  if (f.count % BoxRow::block == 0) clear(f.row[f.count / BoxRow::block]);
  if (f.count % BoxRow::size == 0) clear(f.box[f.count / BoxRow::size]);
  const u32 slot = add(f, face);
  f.state[slot] = state;
  set_box(f.box[slot / BoxRow::size], slot % BoxRow::size, box);
  return true;
}

bool add(Focus& f, u32 face, const Box& box, u8 state) {
  if (!take_in(f, face, box, state)) return false;
  set_box(f, f.count - 1, box);
  return true;
}

namespace {

// What bounds each row of so many boxes.
[[gnu::noinline]] void bound(const BoxRow* rows, u32 boxes, BoxRow* bounds) {
  for (u32 i = 0; BoxRow::size * i < boxes; ++i)
    set_box(bounds[i / BoxRow::size], i % BoxRow::size, bounds_of(rows[i]));
}

}  // namespace

void bound_all(Focus& f) {
  bound(f.box, f.count, f.row);
  bound(f.row, (f.count + BoxRow::size - 1) / BoxRow::size, f.block);
}

// What bounds several slots is only ever widened: an event is short.
void set_box(Focus& f, u32 slot, const Box& box) {
  const u32 row = slot / BoxRow::size, block = slot / BoxRow::block;
  set_box(f.box[row], slot % BoxRow::size, box);
  widen_box(f.row[block], row % BoxRow::size, box);
  widen_box(f.block[block / BoxRow::size], block % BoxRow::size, box);
}

void take_out(Focus& f, u32 slot) { set_box(f.box[slot / BoxRow::size], slot % BoxRow::size, empty_box); }

}  // namespace tpa
