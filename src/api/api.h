// SPDX-License-Identifier: MIT
// api: argument checks, and nothing else; the files api*.cpp hold the only exported symbols.
#pragma once

#include "api/structs.h"
#include "base/float_environment.h"
#include "islands/contacts.h"
#include "step/transaction.h"

namespace tpa {

// The context behind a handle; nullptr for a context of another build.
Context* context_of(tpa_context* c);
const Context* context_of(const tpa_context* c);

// Around every call that computes: sets the floating-point environment, counts the work, and collects the issue,
// cleared at the start and copied to the caller's at the end. Callers may pass NULL.
class IssueSlot {
 public:
  explicit IssueSlot(tpa_issue* out) : out_(out) {}
  ~IssueSlot() {
    report_progress(meter);
    if (out_ != nullptr) *out_ = issue;
  }
  IssueSlot(const IssueSlot&) = delete;
  IssueSlot& operator=(const IssueSlot&) = delete;

  tpa_status fail(tpa_status status) {
    issue.status = status;
    return status;
  }
  // The context behind a handle; nullptr after a failure, also of the floating-point environment.
  Context* context(tpa_context* handle) {
    if (!environment_as_needed()) return nullptr;
    Context* c = context_of(handle);
    if (c == nullptr) fail(TPA_E_CONTEXT);
    return c;
  }
  const Context* context(const tpa_context* handle) { return context(const_cast<tpa_context*>(handle)); }
  [[nodiscard]] bool environment_as_needed() {
    if (!environment_.as_needed()) fail(TPA_E_ENVIRONMENT);
    return environment_.as_needed();
  }
  // Position of the argument at fault, counted from 1; `subject` is the argument or one of its fields.
  tpa_status argument(i32 position, Subject subject, Rule rule) {
    issue.argument = position;
    issue.defect = fault_number(subject, rule);
    return fail(TPA_E_ARGUMENT);
  }
  tpa_status argument(i32 position, Subject subject, const StructFault& f) {
    issue.element = f.element;
    issue.needed = f.needed;
    issue.available = f.available;
    return argument(position, subject, f.rule);
  }
  // A field of an argument that holds less than what there is to write.
  tpa_status capacity(i32 position, Subject subject, Rule rule, i32 limit, u64 needed, u64 available) {
    fail_limit(issue, limit, needed, available);
    issue.argument = position;
    issue.defect = fault_number(subject, rule);
    return TPA_E_LIMIT;
  }
  // A defect in a list of vertices, the second argument.
  tpa_status listed(const Defect& d, u64 vertices) {
    issue.argument = 2;
    return mesh(d, vertices);
  }
  // A defect of a mesh with so many vertices.
  tpa_status mesh(const Defect& d, u64 vertices) {
    issue.available = d.kind == TPA_DEFECT_INDEX_RANGE ? vertices : 0;
    issue.defect = d.kind;
    issue.element = d.element;
    issue.other = d.other;
    return fail(TPA_E_MESH);
  }

  // A structure of the caller; false after a failure, with the issue filled in.
  template <class T>
  [[nodiscard]] bool read(i32 position, const T* caller, T& to) {
    const StructFault f = read_struct(caller, to);
    if (f) argument(position, growth<T>.name, f);
    return !f;
  }
  // The same for a structure to be written.
  template <class T>
  [[nodiscard]] bool writable(i32 position, const T* caller) {
    const StructFault f = check_struct(caller);
    if (f) argument(position, growth<T>.name, f);
    return !f;
  }

  tpa_issue issue{};
  Meter meter;

 private:
  FloatEnvironment environment_;
  tpa_issue* out_;
};

// Reads the caller's threads; false after a failure, with the issue filled in.
[[nodiscard]] bool read_exec(const tpa_exec* exec, i32 position, IssueSlot& slot, Exec& out);

// Reads a caller's config, and lays out a block for it.
tpa_status lay_out_block(const tpa_config* config, i32 position, BlockLayout& layout, IssueSlot& slot);
// Fails unless the block is as large as the layout needs.
tpa_status check_block(size_t size, const BlockLayout& layout, IssueSlot& slot);

// Fails unless the mesh is free of contacts; detects them unless the answer is known.
tpa_status require_clean(Workspace& w, const Exec& exec, tpa_issue& issue);

}  // namespace tpa
