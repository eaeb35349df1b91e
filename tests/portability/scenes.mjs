// SPDX-License-Identifier: MIT
// node scenes.mjs MODULE: the lines of all scenes, played by a WebAssembly module that imports nothing.
import { readFileSync } from "node:fs";

const module = new WebAssembly.Module(readFileSync(process.argv[2]));
if (WebAssembly.Module.imports(module).length > 0) throw new Error("the module imports something");
const { memory, scene_count, scene_line } = new WebAssembly.Instance(module).exports;
for (let scene = 0; scene < scene_count(); ++scene) {
  const bytes = new Uint8Array(memory.buffer, scene_line(scene));
  console.log(new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0))));
}
