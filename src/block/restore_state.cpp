// SPDX-License-Identifier: MIT
#include "block/restore_state.h"

#include <string.h>

#include "block/issue.h"
#include "block/marks.h"
#include "block/shadow_mesh.h"

namespace tpa {

namespace {

u32 read_word(const u8* p) { return u32{p[0]} | u32{p[1]} << 8 | u32{p[2]} << 16 | u32{p[3]} << 24; }
u64 read_wide(const u8* p) { return read_word(p) | u64{read_word(p + 4)} << 32; }

void read_number(const u8* p, u32& out) { out = read_word(p); }
void read_number(const u8* p, u64& out) { out = read_wide(p); }
void read_number(const u8* p, f64& out) {
  const u64 wide = read_wide(p);
  memcpy(&out, &wide, sizeof out);
}

f32 as_f32(u32 word) {
  f32 out;
  memcpy(&out, &word, sizeof out);
  return out;
}

struct SavedState {
  const u8* data;
  u64 size;
  SavedHeader header;
  u64 offset[saved_arrays];

  u32 count(SavedCount i) const { return header.count[i]; }
  u32 count_of(u32 array) const { return header.count[saved_array_info(array).count]; }
  u64 place(u32 array, u64 i) const { return offset[array] + i * saved_array_info(array).element_bytes(); }
  u32 word(u32 array, u64 i, u32 k = 0) const { return read_word(data + place(array, i) + 4 * k); }
  // Of elements without words.
  Vec3 point(u32 array, u64 i) const {
    Vec3 p;
    read_number(data + place(array, i), p.x);
    read_number(data + place(array, i) + 8, p.y);
    read_number(data + place(array, i) + 16, p.z);
    return p;
  }
  // As in the table.
  void copy_element(u32 array, u64 i, void* to) const {
    const SavedArrayInfo& info = saved_array_info(array);
    const u8* from = data + place(array, i);
    u8* out = static_cast<u8*>(to);
    for (u32 k = 0; k < info.words; ++k, from += 4, out += 4) {
      const u32 word = read_word(from);
      memcpy(out, &word, sizeof word);
    }
    for (u32 k = 0; k < info.wides; ++k, from += 8, out += 8) {
      const u64 wide = read_wide(from);
      memcpy(out, &wide, sizeof wide);
    }
  }
  void copy_array(u32 array, void* to) const {
    const u64 bytes = saved_array_info(array).element_bytes();
    for (u64 i = 0; i < count_of(array); ++i) copy_element(array, i, static_cast<u8*>(to) + i * bytes);
  }
};

// ---------------------------------------------------------------- the stream

u64 bytes_of_header() {
  u64 bytes = 0;
  SavedHeader header{};
  for_each_number(header, [&](auto& number) { bytes += sizeof number; });
  return bytes;
}

u64 hash_of(const u8* data, u64 size) {
  Hash64 hash;
  for (u64 i = 0; i + 4 <= size; i += 4) hash.add(read_word(data + i));
  return hash.value();
}

// Reads the header, and checks that the stream is whole.
tpa_status read_stream(SavedState& s, tpa_issue& issue) {
  const u64 least = bytes_of_header() + saved_hash_bytes;
  constexpr u64 place_of_version = 8, place_of_bytes = 12 + 4 * u64{saved_counts};
  if (s.size < least) return fail_data(issue, s.size, least, s.size);
  if (read_wide(s.data) != saved_magic) return fail_data(issue, 0, 0, 0);
  if (const u32 version = read_word(s.data + place_of_version); version != saved_version)
    return fail_data(issue, place_of_version, version, saved_version);
  u64 at = 0;
  for_each_number(s.header, [&](auto& number) {
    read_number(s.data + at, number);
    at += sizeof number;
  });
  if (s.size != s.header.bytes) return fail_data(issue, min_of(s.size, s.header.bytes), s.header.bytes, s.size);
  if (place_saved_state(s.header.count, s.offset) != s.size) return fail_data(issue, place_of_bytes, 0, 0);
  const u64 hashed = s.size - saved_hash_bytes;
  return hash_of(s.data, hashed) == read_wide(s.data + hashed) ? tpa_status{TPA_OK} : fail_data(issue, hashed, 0, 0);
}

// The position of the first field of the config that differs and decides results, or 0.
i32 differing_field(const tpa_config& a, const tpa_config& b) {
#define TPA_SAVED_FIELD(name) \
  if (a.name != b.name) return field_##name;
  TPA_SAVED_CONFIG(TPA_SAVED_FIELD)
#undef TPA_SAVED_FIELD
  return 0;
}

// ---------------------------------------------------------------- what it says

// A mesh has four vertices and faces at least, or all of its bodies are gone; without a mesh there is nothing.
bool counts_make_sense(const SavedState& s) {
  if (s.header.epoch > UINT64_MAX / 2 || s.header.loaded > 1) return false;
  const auto are_of_a_mesh = [&](SavedCount vertices, SavedCount faces) {
    return s.count(vertices) >= 4 && s.count(faces) >= 4;
  };
  const bool had_mesh = are_of_a_mesh(count_of_old_vertices, count_of_old_faces);
  if (s.count(count_of_vertices) > 0)
    return s.header.loaded == 1 && had_mesh && are_of_a_mesh(count_of_vertices, count_of_faces);
  for (u32 i = 0; i < saved_counts; ++i) {
    const bool is_of_before = i == count_of_old_vertices || i == count_of_old_faces || i == count_of_events;
    if (s.header.count[i] != 0 && !(s.header.loaded == 1 && had_mesh && is_of_before)) return false;
  }
  return true;
}

bool is_sound_origin(const SavedState& s, u32 v) {
  const u32 old = s.count(count_of_old_vertices);
  const u32 first = s.word(saved_vertex_origin, v, 0), second = s.word(saved_vertex_origin, v, 1);
  const f32 weight = as_f32(s.word(saved_vertex_origin, v, 2));
  if (first >= old) return false;
  if (second == none) return weight == 1 && s.word(saved_old_to_new, first) == v;
  return second < old && weight >= 0 && weight <= 1;
}

bool is_sound_new_number(const SavedState& s, u32 old) {
  const u32 v = s.word(saved_old_to_new, old);
  if (v == none) return true;
  return v < s.count(count_of_vertices) && s.word(saved_vertex_origin, v, 0) == old &&
         s.word(saved_vertex_origin, v, 1) == none;
}

bool is_sound_event(const SavedState& s, u32 i) {
  tpa_event event;
  s.copy_element(saved_events, i, &event);
  for (f64 x : event.position)
    if (!(abs_of(x) <= DBL_MAX)) return false;
  return event.type >= TPA_EVENT_HANDLE && event.type <= TPA_EVENT_DEATH;
}

// Is the element of an ascending list of vertices?
bool ascends(const SavedState& s, u32 list, u32 i) {
  return s.word(list, i) < s.count(count_of_vertices) && (i == 0 || s.word(list, i - 1) < s.word(list, i));
}

// Positions and corners are checked with the shadow mesh.
bool is_sound(const SavedState& s, const Mesh& shadow, u32 array, u32 i) {
  switch (array) {
    case saved_vertex_edge: {
      const u32 h = s.word(array, i);
      return h < 3 * shadow.face_count && shadow.corner[h] == i;
    }
    case saved_vertex_origin: return is_sound_origin(s, i);
    case saved_face_origin: return s.word(array, i) == none || s.word(array, i) < s.count(count_of_old_faces);
    case saved_old_to_new: return is_sound_new_number(s, i);
    case saved_events: return is_sound_event(s, i);
    case saved_component_before: return s.word(array, i) < s.count(count_of_old_vertices);
    case saved_targets:
    case saved_rolled_back: return ascends(s, array, i);
    case saved_target: {
      const Vec3 p = s.point(array, i);
      return in_exact_range(p.x) && in_exact_range(p.y) && in_exact_range(p.z);
    }
    default: return true;
  }
}

// The place of a defect of the mesh in the stream.
u64 place_of(const SavedState& s, const Defect& d) {
  switch (d.kind) {
    case TPA_DEFECT_NOT_FINITE:
    case TPA_DEFECT_MAGNITUDE: return s.place(saved_position, d.element);
    case TPA_DEFECT_INDEX_RANGE:
    case TPA_DEFECT_REPEATED_VERTEX: return s.place(saved_corner, d.element);
    default: return s.offset[saved_corner];
  }
}

// Reads the mesh into the shadow mesh, labels it, and checks everything. `components` is their number.
tpa_status check_contents(Context& c, const SavedState& s, Mesh& shadow, u32& components, tpa_issue& issue) {
  s.copy_array(saved_position, shadow.position);
  s.copy_array(saved_corner, shadow.corner);
  if (const Defect d = s.count(count_of_vertices) == 0 ? Defect{} : check_shadow_mesh(c, shadow); d.kind != 0)
    return fail_data(issue, place_of(s, d), 0, 0);
  for (u32 array = 0; array < saved_arrays; ++array)
    for (u32 i = 0; i < s.count_of(array); ++i)
      if (!is_sound(s, shadow, array, i)) return fail_data(issue, s.place(array, i), 0, 0);
  components = label_shadow_mesh(c, shadow);
  if (components > c.limits.components) return fail_limit(issue, TPA_LIMIT_COMPONENTS, components, c.limits.components);
  const u32 ancestors = s.count(count_of_ancestors);
  return ancestors == 0 || ancestors == components ? tpa_status{TPA_OK}
                                                   : fail_data(issue, s.offset[saved_component_before], 0, 0);
}

// ---------------------------------------------------------------- in place of the state

void take_over(Context& c, const SavedState& s) {
  for (u32 array = 0; array < saved_tables; ++array)
    s.copy_array(array, table_data<u8>(c, saved_array_info(array).table));
  adopt_counts(c, s.header.count, s.header.epoch, true);
  Workspace w = open(c);
  for (u32 i = 0; i < s.count(count_of_targets); ++i) set_target(w, s.word(saved_targets, i), s.point(saved_target, i));
  for (u32 i = 0; i < s.count(count_of_rolled_back); ++i) w.rolled_back.add(s.word(saved_rolled_back, i));
  list_rolled_back(c);
}

}  // namespace

tpa_status restore_state(Context& c, const u8* data, u64 size, tpa_issue& issue) {
  SavedState s{data, size, {}, {}};
  if (const tpa_status status = read_stream(s, issue); status != TPA_OK) return status;
  if (!counts_make_sense(s)) return fail_data(issue, 12, 0, 0);
  if (const i32 field = differing_field(s.header.config, c.config); field != 0) {
    issue.argument = field;
    return issue.status = TPA_E_CONFIG;
  }
  if (!elements_fit(s.header.count, c.limits, issue)) return issue.status;
  if (s.header.loaded == 0) {
    forget_all(c);
    c.epoch = s.header.epoch;
    return TPA_OK;
  }
  Mesh shadow = open_shadow_mesh(c, s.count(count_of_vertices), s.count(count_of_faces));
  u32 components = 0;
  if (const tpa_status status = check_contents(c, s, shadow, components, issue); status != TPA_OK) {
    drop_shadow_mesh(c);
    return status;
  }
  adopt_shadow_mesh(c, shadow, components);
  take_over(c, s);
  return TPA_OK;
}

}  // namespace tpa
