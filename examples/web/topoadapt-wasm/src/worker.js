// SPDX-License-Identifier: MIT
// worker: a thread of a mesh. It sleeps within the module until a call of the library has tasks, and ends with its mesh.
function run({ module, memory, stack }) {
  const { exports } = new WebAssembly.Instance(module, { env: { memory } });
  exports.__stack_pointer.value = stack;
  exports.web_worker();
}

if (typeof WorkerGlobalScope === "function") self.onmessage = ({ data }) => run(data);
else import("node:worker_threads").then(({ workerData }) => run(workerData));
