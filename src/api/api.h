// SPDX-License-Identifier: MIT
// api: argument checks, and nothing else; the files api*.cpp hold the only exported symbols.
#pragma once

#include "step/step_contacts.h"
#include "step/transaction.h"

namespace tpa {

// The issue of a call: cleared at its start, copied to the caller's at its end. Callers may pass NULL.
class IssueSlot {
 public:
  explicit IssueSlot(tpa_issue* out) : out_(out) {}
  ~IssueSlot() {
    if (out_ != nullptr) *out_ = issue;
  }
  IssueSlot(const IssueSlot&) = delete;
  IssueSlot& operator=(const IssueSlot&) = delete;

  tpa_status fail(tpa_status status) {
    issue.status = status;
    return status;
  }
  // Position of the argument at fault, counted from 1.
  tpa_status argument(i32 position) {
    issue.argument = position;
    return fail(TPA_E_ARGUMENT);
  }
  tpa_status mesh(const Defect& d) {
    issue.defect = d.kind;
    issue.element = d.element;
    issue.other = d.other;
    return fail(TPA_E_MESH);
  }

  tpa_issue issue{};

 private:
  tpa_issue* out_;
};

// The context behind a handle; nullptr for a context of another build.
Context* context_of(tpa_context* c);
const Context* context_of(const tpa_context* c);

// False for a tpa_exec of an unknown version.
bool read_exec(const tpa_exec* exec, Exec& out);

// Fails unless the mesh is free of contacts; detects them unless the answer is known.
tpa_status require_clean(Workspace& w, const Exec& exec, tpa_issue& issue);

// Does the caller's structure have the size of this version?
template <class T>
bool known_size(const T* s) {
  return s != nullptr && s->struct_size == sizeof(T);
}

}  // namespace tpa
