// SPDX-License-Identifier: MIT
// The structures of layout.js lie as the compiler lays those of topoadapt.h.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { test } from "node:test";
import { structures } from "../topoadapt-wasm/src/layout.js";

const types = {
  int32_t: "i32", uint32_t: "u32", tpa_status: "i32", int64_t: "i64", uint64_t: "u64", double: "f64", float: "f32",
  size_t: "u32",
};

function layouts_of_compiler() {
  const names = Object.keys(structures);
  const source = `#include <topoadapt.h>\nint used[${names.map((name) => `sizeof(${name})`).join("+")}];`;
  const dump = execFileSync(process.env.CLANG ?? "clang",
    ["--target=wasm32", `-I${process.env.TOPOADAPT_INCLUDE ?? "../../include"}`, "-Xclang", "-fdump-record-layouts-complete", "-fsyntax-only", "-xc", "-"],
    { input: source, encoding: "utf8", cwd: new URL("..", import.meta.url) });
  const found = {};
  for (const text of dump.split("*** Dumping AST Record Layout")) {
    const name = /struct (tpa_\w+)/.exec(text)?.[1];
    if (name === undefined || found[name] !== undefined) continue;
    const fields = {};
    for (const [, offset, type, count, field] of text.matchAll(/^ +(\d+) \|   (\S[^\n]*?) ?(?:\[(\d+)\])? (\w+)$/gm))
      fields[field] = {
        type: type.includes("*") ? "pointer" : types[type], offset: Number(offset), count: Number(count ?? 0),
      };
    found[name] = { size: Number(/sizeof=(\d+)/.exec(text)[1]), fields };
  }
  return found;
}

test("structures lie as the compiler lays them", () => {
  const found = layouts_of_compiler();
  for (const [name, layout] of Object.entries(structures)) assert.deepEqual(layout, found[name], name);
});
