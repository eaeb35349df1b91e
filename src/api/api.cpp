// SPDX-License-Identifier: MIT
// Identity, configuration and memory.
#include "api/api.h"

#include <string.h>

namespace tpa {

namespace {

constexpr u32 config_cookie = 0x54504131;  // "TPA1"

// Field positions as counted by resolve_limits.
enum : i32 { field_struct_size = 1, field_cookie = 2 };

i32 check_config(const tpa_config& config, Limits& limits) {
  if (config.struct_size != sizeof(tpa_config)) return field_struct_size;
  if (config.cookie != config_cookie) return field_cookie;
  return resolve_limits(config, limits);
}

tpa_status measure_arena(const tpa_config* config, Limits& limits, u64& bytes, Table* tables, IssueSlot& slot) {
  if (config == nullptr) return slot.argument(1);
  if (const i32 field = check_config(*config, limits); field != 0) {
    slot.issue.argument = field;
    return slot.fail(TPA_E_CONFIG);
  }
  return lay_out(limits, tables, bytes) ? tpa_status{TPA_OK} : slot.fail(TPA_E_OVERFLOW);
}

void forget_mesh(Context& c) {
  c.vertex_count = c.face_count = 0;
  c.loaded = c.known_clean = c.near_faces_stand = false;
  Workspace w = open(c);
  w.edit.journal.vertices.clear();
  w.edit.journal.faces.clear();
  c.old_vertex_count = c.old_face_count = 0;
  forget_rolled_back(c);
  c.event_count = c.component_count = 0;
  ++c.epoch;
}

bool aligned(const void* p) { return reinterpret_cast<uintptr_t>(p) % arena_alignment == 0; }

}  // namespace

Context* context_of(tpa_context* c) {
  Context* context = reinterpret_cast<Context*>(c);
  return context != nullptr && aligned(context) && context->cookie == context_cookie() ? context : nullptr;
}
const Context* context_of(const tpa_context* c) { return context_of(const_cast<tpa_context*>(c)); }

bool read_exec(const tpa_exec* exec, Exec& out) {
  if (exec == nullptr) return true;
  if (exec->struct_size != sizeof(tpa_exec) || exec->parallel_for == nullptr) return false;
  out = {exec->user, exec->parallel_for};
  return true;
}

tpa_status require_clean(Workspace& w, const Exec& exec, tpa_issue& issue) {
  if (w.context.known_clean) return TPA_OK;
  detect_all(w, exec);
  if (w.detection.found == 0) {
    w.context.known_clean = true;
    return TPA_OK;
  }
  issue = {};
  issue.status = TPA_E_TANGLED;
  // With more pairs than fit, the first pair is unknown; any fixed pair would depend on the thread count.
  if (w.detection.found <= w.detection.pairs.capacity) {
    issue.element = w.detection.pairs[0].a;
    issue.other = w.detection.pairs[0].b;
  }
  issue.needed = w.detection.found;
  return TPA_E_TANGLED;
}

}  // namespace tpa

using namespace tpa;

extern "C" {

uint32_t tpa_version(void) { return TPA_VERSION_MAJOR << 16 | TPA_VERSION_MINOR << 8 | TPA_VERSION_PATCH; }

const char* tpa_build_info(void) {
#define TPA_TEXT_OF(x) #x
#define TPA_TEXT(x) TPA_TEXT_OF(x)
  return "topoadapt " TPA_TEXT(TPA_VERSION_MAJOR) "." TPA_TEXT(TPA_VERSION_MINOR) "." TPA_TEXT(TPA_VERSION_PATCH)
#if defined(__clang__)
      ", clang " __clang_version__
#elif defined(__GNUC__)
      ", gcc " __VERSION__
#endif
      ", IEEE binary64, no contraction";
}

tpa_status tpa_config_init(tpa_config* config, size_t struct_size) {
  if (config == nullptr || struct_size != sizeof(tpa_config)) return TPA_E_ARGUMENT;
  memset(config, 0, sizeof *config);
  config->struct_size = sizeof(tpa_config);
  config->cookie = config_cookie;
  config->max_vertices = 65536;
  config->detect_mode = TPA_DETECT_COMPLETE;
  config->cell_size = 1;
  config->region = TPA_REGION_INSIDE;
  config->max_passes = 8;
  config->max_candidates = 64;
  config->smooth_iterations = 4;
  config->smooth_lambda = .6307;
  config->smooth_mu = -.6732;
  return TPA_OK;
}

tpa_status tpa_arena_query(const tpa_config* config, tpa_arena_size* size, tpa_issue* issue) {
  IssueSlot slot(issue);
  if (size == nullptr) return slot.argument(2);
  Limits limits;
  u64 bytes = 0;
  if (const tpa_status s = measure_arena(config, limits, bytes, nullptr, slot); s != TPA_OK) return s;
  size->bytes = static_cast<size_t>(bytes);
  size->alignment = arena_alignment;
  return TPA_OK;
}

tpa_status tpa_init(void* memory, size_t size, const tpa_config* config, tpa_context** context, tpa_issue* issue) {
  IssueSlot slot(issue);
  if (memory == nullptr) return slot.argument(1);
  if (context == nullptr) return slot.argument(4);
  Limits limits;
  Table tables[table_count];
  u64 bytes = 0;
  if (const tpa_status s = measure_arena(config, limits, bytes, tables, slot); s != TPA_OK) {
    if (s == TPA_E_ARGUMENT) slot.issue.argument = 3;
    return s;
  }
  if (size < bytes || !aligned(memory)) {
    slot.issue.needed = size < bytes ? bytes : arena_alignment;
    slot.issue.available = size < bytes ? size : reinterpret_cast<uintptr_t>(memory) % arena_alignment;
    return slot.fail(TPA_E_ARENA);
  }
  // Each stage fills its scratch itself, by far the largest table.
  const Table& scratch = tables[table_scratch];
  const u64 behind = scratch.offset + scratch.element_bytes * scratch.count;
  memset(memory, 0, static_cast<size_t>(scratch.offset));
  memset(static_cast<u8*>(memory) + behind, 0, static_cast<size_t>(bytes - behind));
  Context& c = *static_cast<Context*>(memory);
  c.bytes = bytes;
  c.config = *config;
  c.limits = limits;
  memcpy(c.tables, tables, sizeof tables);
  place_scratch(limits, c.scratch);
  memset(table_data<u32>(c, table_cluster), 0xFF, limits.vertices * sizeof(u32));
  c.cookie = context_cookie();
  *context = reinterpret_cast<tpa_context*>(&c);
  return TPA_OK;
}

tpa_status tpa_reset(tpa_context* context) {
  Context* c = context_of(context);
  if (c == nullptr) return TPA_E_CONTEXT;
  forget_targets(*c);
  forget_mesh(*c);
  return TPA_OK;
}

tpa_status tpa_memory_stats(const tpa_context* context, tpa_memory_table* tables, uint32_t capacity, uint32_t* count) {
  const Context* c = context_of(context);
  if (c == nullptr) return TPA_E_CONTEXT;
  if (count == nullptr || (tables == nullptr && capacity > 0)) return TPA_E_ARGUMENT;
  const u64 used[measure_count] = {0, c->vertex_count, c->face_count, 0, 0, c->event_count, c->component_count};
  const u64 limit[measure_count] = {0,
                                    c->limits.vertices,
                                    c->limits.triangles,
                                    c->limits.contacts,
                                    c->limits.cuts,
                                    c->limits.events,
                                    c->limits.components};
  *count = table_count;
  for (u32 i = 0; i < min_of(capacity, u32{table_count}); ++i) {
    const TableInfo& info = table_info(i);
    const u32 measure = static_cast<u32>(info.measure);
    const Table& r = c->tables[i];
    tables[i] = {info.name, r.element_bytes * r.count, used[measure], c->peak[measure], limit[measure]};
  }
  return TPA_OK;
}

}  // extern "C"
