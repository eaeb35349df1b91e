// SPDX-License-Identifier: MIT
// Memory: an instance of the module and the three parts of its memory behind the stack and the constants: slots for
// small structures, the block of the context, and arrays on their way in or out ("staged"), which last for one call.
import { read, structures, update, write } from "./layout.js";

const page = 65536;
const slot_bytes = 512;

export class Memory {
  #block;
  #block_end;
  #staged_end = 0;
  #data = null;

  constructor(module) {
    this.calls = new WebAssembly.Instance(module).exports;
    this.buffer_owner = this.calls.memory;
    this.first_slot = round_up(this.calls.__heap_base.value, 16);
    this.#block = this.#block_end = round_up(this.first_slot + 8 * slot_bytes, 16);
  }

  /** The buffer; growing detaches the one before. */
  get buffer() {
    return this.buffer_owner.buffer;
  }

  get data() {
    if (this.#data?.buffer !== this.buffer) this.#data = new DataView(this.buffer);
    return this.#data;
  }

  /** Address of a slot for a small structure: 0 .. 7. */
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
    return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
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
