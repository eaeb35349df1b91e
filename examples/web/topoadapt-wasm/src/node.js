// SPDX-License-Identifier: MIT
// node: the entry for Node, whose fetch reads no files, and whose workers are another class.
import { readFile } from "node:fs/promises";
import { Worker } from "node:worker_threads";
import { platform } from "./index.js";

export * from "./index.js";

const fetched = platform.bytes_of;
platform.is_isolated = () => true;
platform.bytes_of = (source) => {
  const is_file = source instanceof URL ? source.protocol === "file:" : /^file:/.test(source);
  return is_file ? readFile(new URL(source)) : fetched(source);
};
platform.start_worker = (message) => {
  const worker = new Worker(new URL("./worker.js", import.meta.url), { workerData: message });
  worker.unref();  // a program ends without telling its workers
  return worker;
};
