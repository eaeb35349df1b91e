#include "triangulate/four_best.h"

namespace tpa {

namespace {

constexpr u32 inner_corners = 12;

// Whole words, so that handles are as many as fit.
constexpr u32 apexes_of_a_handle(const ShortLoops& loops) { return (loops.first[4] + inner_corners + 3) / 4 * 4; }
u16* apexes_of(const ShortLoops& loops, const ShortHandles& handles, u32 place) {
  return handles.apex + u64{place} * apexes_of_a_handle(loops);
}

void keep_faces(const ShortLoops& loops, const HandleFace* face, u16* apex) {
  const u32 vertices = loops.first[4];
  u16* inner = apex + vertices;
  for (u32 f = 0; f < vertices + 4; ++f) {
    const u32(&v)[3] = face[f].v;
    const u32 loop[3] = {loop_of(loops, v[0]), loop_of(loops, v[1]), loop_of(loops, v[2])};
    u32 edge = 0;  // its first corner
    while (edge < 3 && loop[edge] != loop[(edge + 1) % 3]) ++edge;
    if (edge < 3) apex[v[edge]] = static_cast<u16>(v[(edge + 2) % 3]);
    for (u32 c = 0; edge == 3 && c < 3; ++c) *inner++ = static_cast<u16>(v[c]);
  }
}

}  // namespace

u64 short_handle_bytes(const ShortLoops& loops) {
  return sizeof(ShortHandle) + sizeof(u16) * apexes_of_a_handle(loops);
}

void lay_out_short_handles(Carver& carver, const ShortLoops& loops, u32 handles, ShortHandles& out) {
  carver.take(out.best, handles);
  carver.take(out.apex, u64{handles} * apexes_of_a_handle(loops));
}

void enter_handle(const ShortLoops& loops, f64 length, const HandleFace* face, ShortHandles& handles) {
  const Span<ShortHandle> best = handles.best;
  const bool full = handles.count == best.size;
  if (full && length >= best[handles.count - 1].length) return;
  const u32 place = full ? best[handles.count - 1].place : handles.count;
  u32 at = full ? handles.count - 1 : handles.count++;
  for (; at > 0 && length < best[at - 1].length; --at) best[at] = best[at - 1];
  best[at] = {length, place};
  keep_faces(loops, face, apexes_of(loops, handles, place));
}

void write_four(const ShortLoops& loops, const ShortHandles& handles, u32 number, HandleFace* out) {
  const u16* apex = apexes_of(loops, handles, handles.best[number].place);
  for (u32 l = 0; l < 4; ++l)
    for (u32 v = loops.first[l]; v < loops.first[l + 1]; ++v)
      *out++ = {{v, v + 1 == loops.first[l + 1] ? loops.first[l] : v + 1, *apex++}};
  for (u32 inner = 0; inner < 4; ++inner, apex += 3) *out++ = {{apex[0], apex[1], apex[2]}};
}

}  // namespace tpa
