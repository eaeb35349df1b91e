// SPDX-License-Identifier: MIT
import { Memory } from "./memory.js";
import { Mesh, NONE } from "./mesh.js";

export { Mesh, NONE };
export { TopoadaptError } from "./errors.js";

// Written out, so that bundlers see which files belong to the page.
const addresses = {
  serial: () => new URL("../topoadapt.wasm", import.meta.url),
  threaded: () => new URL("../topoadapt-threads.wasm", import.meta.url),
};

// How the platform reads files and starts workers: src/node.js has its own.
export const platform = {
  is_isolated: () => globalThis.crossOriginIsolated === true,
  bytes_of: async (source) => {
    const response = source instanceof Response ? source : await fetch(source);
    if (!response.ok) throw new Error(`${response.url || source}: ${response.status} ${response.statusText}`);
    return response.arrayBuffer();
  },
  start_worker: (message) => {
    const worker = new Worker(new URL("./worker.js", import.meta.url), { type: "module" });
    worker.postMessage(message);
    return worker;
  },
};

/** Compiles the module. See index.d.ts. */
export async function load(given = {}) {
  const { source, threads = 1 } = is_source(given) ? { source: given } : given;
  if (!Number.isInteger(threads) || threads < 1) throw new RangeError(`threads cannot be ${threads}`);
  const shared = threads > 1 && platform.is_isolated();
  const from = source ?? (shared ? addresses.threaded() : addresses.serial());
  const module = from instanceof WebAssembly.Module ? from : await WebAssembly.compile(await bytes_of(from));
  return new Topoadapt(module, shared ? threads : 1);
}

function is_source(given) {
  return typeof given === "string" || given instanceof URL || given instanceof ArrayBuffer || ArrayBuffer.isView(given) ||
    given instanceof WebAssembly.Module || (typeof Response === "function" && given instanceof Response);
}

function bytes_of(source) {
  return source instanceof ArrayBuffer || ArrayBuffer.isView(source) ? source : platform.bytes_of(source);
}

class Topoadapt {
  #module;

  constructor(module, threads) {
    this.#module = module;
    this.threads = threads;
    const memory = new Memory(module, 1, platform);
    const version = memory.calls.tpa_version();
    this.version = [version >> 16, (version >> 8) & 255, version & 255].join(".");
    this.buildInfo = memory.text(memory.calls.tpa_build_info());
  }

  mesh(options) {
    return new Mesh(new Memory(this.#module, this.threads, platform), options);
  }
}
