// SPDX-License-Identifier: MIT
// Memory: an instance of the module and the parts of its memory behind the stack and the constants: slots for small
// structures, stacks of workers, the block of the context, and arrays on their way in or out ("staged"), which last for
// one call.
import { read, structures, update, write } from "./layout.js";

const page = 65536;
const slot_bytes = 512, slots = 9;
const stack_bytes = 65536;
const most_pages = 2 ** 14;  // as build-wasm.sh has it: 1 GiB

export class Memory {
  #block;
  #block_end;
  #staged_end = 0;
  #data = null;

  /** threads above 1: the module is that with shared memory. */
  constructor(module, threads, platform) {
    const needs_memory = WebAssembly.Module.imports(module).length > 0;
    // Enough for the constants; the rest is reserved when wanted.
    const memory = needs_memory ? new WebAssembly.Memory({ initial: 32, maximum: most_pages, shared: true }) : undefined;
    this.calls = new WebAssembly.Instance(module, needs_memory ? { env: { memory } } : {}).exports;
    this.buffer_owner = memory ?? this.calls.memory;
    this.first_slot = round_up(this.calls.__heap_base.value, 16);
    const stacks = round_up(this.first_slot + slots * slot_bytes, 16);
    this.#block = this.#block_end = stacks + (threads - 1) * stack_bytes;
    this.#reserve(this.#block);
    this.is_shared = needs_memory;
    this.workers = [];
    for (let i = 1; i < threads; ++i)
      this.workers.push(platform.start_worker({ module, memory, stack: stacks + i * stack_bytes }));
  }

  /** Ends the workers. */
  close() {
    for (const worker of this.workers.splice(0)) worker.terminate();
  }

  /** The buffer; growing detaches the one before. */
  get buffer() {
    return this.buffer_owner.buffer;
  }

  get data() {
    if (this.#data?.buffer !== this.buffer) this.#data = new DataView(this.buffer);
    return this.#data;
  }

  /** Address of a slot for a small structure: 0 .. 8. */
  slot(number) {
    return this.first_slot + number * slot_bytes;
  }

  put(slot, name, values = {}) {
    write(this.data, structures[name], this.slot(slot), values);
    return this.slot(slot);
  }

  set(slot, name, values) {
    update(this.data, structures[name], this.slot(slot), values);
  }

  get(slot, name) {
    return read(this.data, structures[name], this.slot(slot));
  }

  u32(at) {
    return this.data.getUint32(at, true);
  }

  text(at) {
    const bytes = new Uint8Array(this.buffer, at);
    return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
  }

  /** The address for a block of this size and alignment behind the present one; end_block accepts it. */
  room_for_block(bytes, alignment) {
    const at = round_up(this.#block_end, alignment);
    this.#reserve(at + bytes);
    return at;
  }

  /** Makes the bytes from `at` on the block. A context has no pointers, so the block moves down over the one before. */
  adopt_block(at, bytes, alignment) {
    const to = round_up(this.#block, alignment);
    new Uint8Array(this.buffer).copyWithin(to, at, at + bytes);
    this.#block_end = to + bytes;
    this.unstage();
    return to;
  }

  /** Forgets what is staged. */
  unstage() {
    this.#staged_end = round_up(this.#block_end, 16);
  }

  /** Address of room for an array behind the block. */
  stage(bytes) {
    const at = this.#staged_end;
    this.#reserve(at + bytes);
    this.#staged_end = round_up(at + bytes, 16);
    return at;
  }

  /** Address of a copy of an array; 0 for null. */
  stage_copy(array) {
    if (array === null) return 0;
    const at = this.stage(array.byteLength);
    new array.constructor(this.buffer, at, array.length).set(array);
    return at;
  }

  #reserve(end) {
    const missing = end - this.buffer.byteLength;
    if (missing > 0) this.buffer_owner.grow(Math.ceil(missing / page));
  }
}

export function round_up(value, alignment) {
  return Math.ceil(value / alignment) * alignment;
}
