// SPDX-License-Identifier: MIT
// Identity, configuration and memory.
#include "api/api.h"

#include <string.h>

namespace tpa {

namespace {

constexpr u32 config_cookie = 0x54504131;  // "TPA1"

i32 check_config(const tpa_config& config, Limits& limits) {
  return config.cookie != config_cookie ? i32{field_cookie} : resolve_limits(config, limits);
}

}  // namespace

Context* context_of(tpa_context* c) {
  if (c == nullptr) return nullptr;
  Context* context = context_in(c);
  return context->cookie == context_cookie() ? context : nullptr;
}
const Context* context_of(const tpa_context* c) { return context_of(const_cast<tpa_context*>(c)); }

tpa_status lay_out_block(const tpa_config* config, i32 position, BlockLayout& layout, IssueSlot& slot) {
  if (!slot.environment_as_needed()) return slot.issue.status;
  if (!slot.read(position, config, layout.config)) {
    if (config == nullptr) return slot.issue.status;
    slot.issue.argument = field_struct_size;
    return slot.fail(TPA_E_CONFIG);
  }
  if (const i32 field = check_config(layout.config, layout.limits); field != 0) {
    slot.issue.argument = field;
    return slot.fail(TPA_E_CONFIG);
  }
  return lay_out(layout) ? tpa_status{TPA_OK} : slot.fail(TPA_E_OVERFLOW);
}

tpa_status check_block(size_t size, const BlockLayout& layout, IssueSlot& slot) {
  if (size >= layout.bytes) return TPA_OK;
  slot.issue.needed = layout.bytes;
  slot.issue.available = size;
  return slot.fail(TPA_E_ARENA);
}

bool read_exec(const tpa_exec* exec, i32 position, IssueSlot& slot, Exec& out) {
  if (exec == nullptr) return true;
  tpa_exec e;
  if (!slot.read(position, exec, e)) return false;
  if ((e.flags & ~u32{TPA_EXEC_KEEP}) != 0) {
    slot.argument(position, Subject::exec_flags, Rule::exec_flags);
    return false;
  }
  Meter& meter = slot.meter;
  meter.keeps = (e.flags & TPA_EXEC_KEEP) != 0;
  if (e.budget != 0) meter.budget = e.budget;
  meter.cancel = e.cancel;
  meter.progress = e.progress;
  out = {e.user, e.parallel_for, &meter};
  return true;
}

tpa_status require_clean(Workspace& w, const Exec& exec, tpa_issue& issue) {
  if (w.context.known_clean) return TPA_OK;
  detect_all(w, exec);
  if (has_stopped(exec.meter)) return fail_stopped(issue, *exec.meter);
  if (w.detection.found == 0) {
    w.context.known_clean = true;
    return TPA_OK;
  }
  return fail_tangled(issue, w.detection);
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
#if defined(TPA_COMMIT)
      ", commit " TPA_TEXT(TPA_COMMIT)
#endif
#if defined(TPA_WITHOUT_QUADRUPLES)
          ", without handles of four polygons"
#endif
          ", IEEE binary64, no contraction";
}

tpa_status tpa_config_init(tpa_config* config, size_t struct_size) {
  if (config == nullptr || check_struct_size(struct_size, growth<tpa_config>, sizeof(tpa_config)))
    return TPA_E_ARGUMENT;
  tpa_config c{};
  c.cookie = config_cookie;
  c.max_vertices = 65536;
  c.detect_mode = TPA_DETECT_COMPLETE;
  c.cell_size = 1;
  c.region = TPA_REGION_INSIDE;
  c.max_passes = 8;
  c.max_candidates = 64;
  c.smooth_iterations = 4;
  c.smooth_lambda = .6307;
  c.smooth_mu = -.6732;
  config->struct_size = static_cast<u32>(struct_size);
  write_struct(c, config);
  return TPA_OK;
}

tpa_status tpa_arena_query(const tpa_config* config, tpa_arena_size* size, tpa_issue* issue) {
  IssueSlot slot(issue);
  if (size == nullptr) return slot.argument(2, Subject::size, Rule::not_null);
  BlockLayout layout;
  if (const tpa_status s = lay_out_block(config, 1, layout, slot); s != TPA_OK) return s;
  size->bytes = static_cast<size_t>(layout.bytes);
  size->alignment = arena_alignment;
  return TPA_OK;
}

tpa_status tpa_init(void* memory, size_t size, const tpa_config* config, tpa_context** context, tpa_issue* issue) {
  IssueSlot slot(issue);
  if (memory == nullptr) return slot.argument(1, Subject::memory, Rule::not_null);
  if (context == nullptr) return slot.argument(4, Subject::context, Rule::not_null);
  BlockLayout layout;
  if (const tpa_status s = lay_out_block(config, 3, layout, slot); s != TPA_OK) return s;
  if (const tpa_status s = check_block(size, layout, slot); s != TPA_OK) return s;
  make_context(memory, layout);
  *context = static_cast<tpa_context*>(memory);
  return TPA_OK;
}

tpa_status tpa_reset(tpa_context* context) {
  Context* c = context_of(context);
  if (c == nullptr) return TPA_E_CONTEXT;
  forget_all(*c);
  return TPA_OK;
}

tpa_status tpa_memory_stats(const tpa_context* context, tpa_memory_table* tables, uint32_t capacity, uint32_t* count) {
  const Context* c = context_of(context);
  if (c == nullptr) return TPA_E_CONTEXT;
  if (count == nullptr || (tables == nullptr && capacity > 0)) return TPA_E_ARGUMENT;
  const u64 used[measure_count] = {0, c->vertex_count, c->face_count, 0, 0, c->event_count, c->component_count, 0, 0};
  const u64 limit[measure_count] = {0,
                                    c->limits.vertices,
                                    c->limits.triangles,
                                    c->limits.contacts,
                                    c->limits.cuts,
                                    c->limits.events,
                                    c->limits.components,
                                    c->limits.pieces,
                                    c->limits.substeps};
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
