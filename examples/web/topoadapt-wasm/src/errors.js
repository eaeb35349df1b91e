// SPDX-License-Identifier: MIT
import { structures, read } from "./layout.js";

const codes = [
  "OK",
  "E_ARGUMENT",
  "E_CONFIG",
  "E_OVERFLOW",
  "E_ARENA",
  "E_CONTEXT",
  "E_STATE",
  "E_LIMIT",
  "E_MESH",
  "E_TANGLED",
  "E_ENVIRONMENT",
  "E_BUDGET",
  "E_CANCELLED",
  "E_DATA",
];

/** A failed call. The mesh is bit for bit as before the call. */
export class TopoadaptError extends Error {
  constructor(message, issue) {
    super(message);
    this.name = "TopoadaptError";
    this.code = codes[-issue.status] ?? "E_UNKNOWN";
    Object.assign(this, issue);
  }
}

/** The error that the issue in a slot of the memory tells of. */
export function error_of(memory, slot, text_slot) {
  const at = memory.slot(slot);
  const issue = read(memory.data, structures.tpa_issue, at);
  memory.calls.tpa_issue_text(at, memory.slot(text_slot), 512);
  return new TopoadaptError(memory.text(memory.slot(text_slot)), issue);
}
