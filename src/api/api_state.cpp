// SPDX-License-Identifier: MIT
// The state of a context: carried into another block, saved, restored, hashed; config and targets read back; targets
// dropped.
#include <string.h>

#include "api/api.h"
#include "block/grow_context.h"
#include "block/restore_state.h"

namespace tpa {

namespace {

bool overlap(const void* a, u64 a_bytes, const void* b, u64 b_bytes) {
  const uintptr_t p = reinterpret_cast<uintptr_t>(a), q = reinterpret_cast<uintptr_t>(b);
  return p < q ? q - p < a_bytes : p - q < b_bytes;
}

}  // namespace

}  // namespace tpa

using namespace tpa;

extern "C" {

tpa_status tpa_grow(const tpa_context* context, void* memory, size_t size, const tpa_config* config,
                    tpa_context** bigger, tpa_issue* issue) {
  IssueSlot slot(issue);
  const Context* from = slot.context(context);
  if (from == nullptr) return slot.issue.status;
  if (memory == nullptr) return slot.argument(2, Subject::memory, Rule::not_null);
  if (overlap(memory, size, context, from->bytes)) return slot.argument(2, Subject::memory, Rule::apart);
  if (bigger == nullptr) return slot.argument(5, Subject::bigger, Rule::not_null);
  BlockLayout layout;
  if (const tpa_status s = lay_out_block(config, 4, layout, slot); s != TPA_OK) return s;
  if (const tpa_status s = check_block(size, layout, slot); s != TPA_OK) return s;
  if (!state_fits(*from, layout.limits, slot.issue)) return slot.issue.status;
  Context& to = make_context(memory, layout);
  if (const tpa_status s = carry_state(*from, to, slot.issue); s != TPA_OK) {
    to.cookie = 0;
    return s;
  }
  *bigger = static_cast<tpa_context*>(memory);
  return TPA_OK;
}

tpa_status tpa_save(const tpa_context* context, void* data, size_t capacity, size_t* size, tpa_issue* issue) {
  IssueSlot slot(issue);
  const Context* c = slot.context(context);
  if (c == nullptr) return slot.issue.status;
  if (data == nullptr && capacity > 0) return slot.argument(2, Subject::data, Rule::not_null);
  if (size == nullptr) return slot.argument(4, Subject::size, Rule::not_null);
  const u64 bytes = bytes_of_state(*c);
  *size = static_cast<size_t>(bytes);
  if (data == nullptr) return TPA_OK;
  if (capacity < bytes) {
    slot.issue.needed = bytes;
    slot.issue.available = capacity;
    return slot.fail(TPA_E_ARENA);
  }
  write_state(*c, static_cast<u8*>(data));
  return TPA_OK;
}

tpa_status tpa_restore(tpa_context* context, const void* data, size_t size, tpa_issue* issue) {
  IssueSlot slot(issue);
  Context* c = slot.context(context);
  if (c == nullptr) return slot.issue.status;
  if (data == nullptr) return slot.argument(2, Subject::data, Rule::not_null);
  const tpa_status status = restore_state(*c, static_cast<const u8*>(data), size, slot.issue);
  if (status == TPA_E_CONFIG) slot.issue.defect = fault_number(Subject::config, Rule::as_saved);
  return status;
}

tpa_status tpa_digest(const tpa_context* context, uint64_t* digest) {
  const Context* c = context_of(context);
  if (c == nullptr) return TPA_E_CONTEXT;
  if (digest == nullptr) return TPA_E_ARGUMENT;
  *digest = write_state(*c, nullptr);
  return TPA_OK;
}

tpa_status tpa_config_of(const tpa_context* context, tpa_config* config) {
  const Context* c = context_of(context);
  if (c == nullptr) return TPA_E_CONTEXT;
  if (check_struct(config)) return TPA_E_ARGUMENT;
  write_struct(c->config, config);
  return TPA_OK;
}

tpa_status tpa_targets(const tpa_context* context, uint32_t* vertices, double* positions, uint32_t capacity,
                       uint32_t* count) {
  const Context* c = context_of(context);
  if (c == nullptr) return TPA_E_CONTEXT;
  if (count == nullptr) return TPA_E_ARGUMENT;
  const Vec3* target = table_data<Vec3>(*c, table_target);
  u32 i = 0;
  for (u32 v : open_targets(*c)) {
    if (i == capacity) break;
    if (vertices != nullptr) vertices[i] = v;
    if (positions != nullptr) memcpy(positions + 3 * size_t{i}, target + v, sizeof(Vec3));
    ++i;
  }
  *count = c->target_count;
  return TPA_OK;
}

tpa_status tpa_drop_targets(tpa_context* context) {
  Context* c = context_of(context);
  if (c == nullptr) return TPA_E_CONTEXT;
  forget_targets(*c);
  return TPA_OK;
}

}  // extern "C"
