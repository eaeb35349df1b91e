// SPDX-License-Identifier: MIT
#include "block/saved_state.h"

#include <stddef.h>
#include <string.h>

#include "block/issue.h"

namespace tpa {

namespace {

// Elements of tables are their numbers, one behind the other: first those of 32 bits, then those of 64.
static_assert(sizeof(Vec3) == 24 && sizeof(VertexOrigin) == 12 && sizeof(tpa_event) == 40 &&
              offsetof(tpa_event, position) == 16);

constexpr SavedArrayInfo infos[saved_arrays] = {
#define TPA_SAVED_INFO(name, words, wides, count) {table_##name, words, wides, count_of_##count},
    TPA_SAVED_TABLES(TPA_SAVED_INFO) TPA_SAVED_SETS(TPA_SAVED_INFO)
#undef TPA_SAVED_INFO
};

constexpr Measure measure_of_count[saved_counts] = {
#define TPA_SAVED_MEASURE(name, field, measure) Measure::measure,
    TPA_SAVED_COUNTS(TPA_SAVED_MEASURE)
#undef TPA_SAVED_MEASURE
};

// Hashes the stream, and writes it where there is memory.
struct StateSink {
  u8* to;
  Hash64 hash;

  void put(u32 word) {
    hash.add(word);
    if (to == nullptr) return;
    for (u32 i = 0; i < 4; ++i) *to++ = static_cast<u8>(word >> 8 * i);
  }
  void put(u64 wide) {
    put(static_cast<u32>(wide));
    put(static_cast<u32>(wide >> 32));
  }
  void put(f64 number) {
    u64 wide;
    memcpy(&wide, &number, sizeof wide);
    put(wide);
  }
  void put_element(const SavedArrayInfo& info, const void* element) {
    const u8* from = static_cast<const u8*>(element);
    for (u32 i = 0; i < info.words; ++i, from += sizeof(u32)) {
      u32 word;
      memcpy(&word, from, sizeof word);
      put(word);
    }
    for (u32 i = 0; i < info.wides; ++i, from += sizeof(u64)) {
      u64 wide;
      memcpy(&wide, from, sizeof wide);
      put(wide);
    }
  }
};

void put_array(const Context& c, u32 array, u32 count, StateSink& sink) {
  const SavedArrayInfo& info = infos[array];
  switch (array) {
    case saved_targets:
      for (u32 v : open_targets(c)) sink.put(v);
      return;
    case saved_target:
      for (u32 v : open_targets(c)) sink.put_element(info, table_data<Vec3>(c, table_target) + v);
      return;
    case saved_rolled_back:
      for (u32 v : open_rolled_back(c)) sink.put(v);
      return;
    default:
      for (u64 i = 0; i < count; ++i) sink.put_element(info, table_data<u8>(c, info.table) + i * info.element_bytes());
  }
}

u32 limit_of(const Limits& l, Measure measure) {
  switch (measure) {
    case Measure::vertices: return l.vertices;
    case Measure::triangles: return l.triangles;
    case Measure::events: return l.events;
    case Measure::components: return l.components;
    default: return none;
  }
}

}  // namespace

const SavedArrayInfo& saved_array_info(u32 array) { return infos[array]; }

u64 place_saved_state(const u32* count, u64* offset) {
  u64 bytes = 0;
  SavedHeader header{};
  for_each_number(header, [&](auto& number) { bytes += sizeof number; });
  for (u32 a = 0; a < saved_arrays; ++a) {
    if (offset != nullptr) offset[a] = bytes;
    bytes += count[infos[a].count] * infos[a].element_bytes();
  }
  return bytes + saved_hash_bytes;
}

void count_elements(const Context& c, u32* count) {
#define TPA_SAVED_COUNT(name, field, measure) count[count_of_##name] = c.field;
  TPA_SAVED_COUNTS(TPA_SAVED_COUNT)
#undef TPA_SAVED_COUNT
}

bool elements_fit(const u32* count, const Limits& limits, tpa_issue& issue) {
  for (u32 m = 1; m < measure_count; ++m) {
    const u32 limit = limit_of(limits, static_cast<Measure>(m));
    u32 needed = 0;
    for (u32 i = 0; i < saved_counts; ++i)
      if (measure_of_count[i] == static_cast<Measure>(m)) needed = max_of(needed, count[i]);
    if (needed <= limit) continue;
    fail_limit(issue, static_cast<i32>(m), needed, limit);
    return false;
  }
  return true;
}

void adopt_counts(Context& c, const u32* count, u64 epoch, bool loaded) {
#define TPA_SAVED_COUNT(name, field, measure) c.field = count[count_of_##name];
  TPA_SAVED_COUNTS(TPA_SAVED_COUNT)
#undef TPA_SAVED_COUNT
  c.target_count = 0;
  c.epoch = epoch;
  c.longest_edge_epoch = unknown_epoch;
  c.loaded = loaded;
  c.near_faces_stand = false;
  Workspace w = open(c);
  note_mapped(w.edit, w.old_to_new);
  note_peak(c, Measure::vertices, c.vertex_count);
  note_peak(c, Measure::triangles, c.face_count);
  note_peak(c, Measure::events, c.event_count);
}

u64 bytes_of_state(const Context& c) {
  u32 count[saved_counts];
  count_elements(c, count);
  return place_saved_state(count, nullptr);
}

u64 write_state(const Context& c, u8* to) {
  SavedHeader header{saved_magic, saved_version, {}, c.loaded ? 1u : 0u, bytes_of_state(c), c.epoch, c.config};
  count_elements(c, header.count);
  StateSink sink{to, {}};
  for_each_number(header, [&](auto& number) { sink.put(number); });
  for (u32 a = 0; a < saved_arrays; ++a) put_array(c, a, header.count[infos[a].count], sink);
  const u64 hash = sink.hash.value();
  sink.put(hash);
  return hash;
}

}  // namespace tpa
