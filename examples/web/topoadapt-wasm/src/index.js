// SPDX-License-Identifier: MIT
import { Memory } from "./memory.js";
import { Mesh, NONE } from "./mesh.js";

export { Mesh, NONE };
export { TopoadaptError } from "./errors.js";

/** Compiles the module. See index.d.ts. */
export async function load(source) {
  const module = source instanceof WebAssembly.Module ? source : await WebAssembly.compile(await bytes_of(source));
  return new Topoadapt(module);
}

async function bytes_of(source) {
  if (source instanceof ArrayBuffer || ArrayBuffer.isView(source)) return source;
  const response = source instanceof Response ? source : await fetch(source);
  return response.arrayBuffer();
}

class Topoadapt {
  #module;

  constructor(module) {
    this.#module = module;
    const memory = new Memory(module);
    const version = memory.calls.tpa_version();
    this.version = [version >> 16, (version >> 8) & 255, version & 255].join(".");
    this.buildInfo = memory.text(memory.calls.tpa_build_info());
  }

  mesh(options) {
    return new Mesh(this.#module, options);
  }
}
