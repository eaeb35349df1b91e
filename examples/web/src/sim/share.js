// SPDX-License-Identifier: MIT
// share: scene, settings and inputs as the text of an address. The inputs make the same bits anywhere, so the mesh need
// not be told. Whole numbers are written as differences, seven bits in a byte, then deflated, then in base64.
import { idle } from "./world.js";
import { scenes } from "./scenes.js";

const kinds = ["none", "pull", "press", "carve", "grow", "action", "brush"];

/** The inputs of all frames so far; equal neighbours count once. */
export class Inputs {
  runs = [];
  frames = 0;

  add(input) {
    ++this.frames;
    const last = this.runs.at(-1);
    if (last !== undefined && equal(last.input, input)) ++last.count;
    else this.runs.push({ input, count: 1 });
  }

  *[Symbol.iterator]() {
    for (const { input, count } of this.runs) for (let i = 0; i < count; ++i) yield input;
  }
}

function equal(a, b) {
  return a.kind === b.kind && (a.at ?? []).every((x, i) => x === b.at[i]);
}

export async function address_of({ scene, settings, view, inputs, digest }) {
  const numbers = [];
  let last = [0, 0, 0, 0, 0, 0];
  for (const { input, count } of inputs.runs) {
    numbers.push(kinds.indexOf(input.kind), count);
    if (input.at === undefined) continue;
    input.at.forEach((x, i) => numbers.push(folded(x - last[i])));
    last = input.at;
  }
  const fields = new URLSearchParams({
    scene,
    ...settings,
    view: view.map((x) => x.toFixed(2)).join(),
    inputs: base64(await through(new CompressionStream("deflate-raw"), bytes_of(numbers))),
    digest: digest.toString(16),
  });
  return fields.toString();
}

/** The parts of an address; null without a scene. Throws for inputs that no page has written. */
export async function parse(text) {
  const fields = Object.fromEntries(new URLSearchParams(text));
  if (fields.scene === undefined) return null;
  const { scene, view, inputs, digest, ...settings } = fields;
  for (const [name, value] of Object.entries(settings)) settings[name] = setting(scenes[scene], name, value);
  return {
    scene,
    settings,
    view: view?.split(",").map(Number) ?? null,
    inputs: inputs === undefined ? new Inputs() : await inputs_of(inputs),
    digest: digest ?? null,
  };
}

// A setting of a scene: a number of a sensible size, or the name of a variant.
function setting(scene, name, value) {
  if (scene?.variants?.name === name && Object.hasOwn(scene.variants.of, value)) return value;
  const number = Number(value);
  if (typeof scene?.settings[name] !== "number" || !(number >= 6 && number <= 60)) throw new Error("the address is damaged");
  return number;
}

async function inputs_of(text) {
  const numbers = numbers_of(await through(new DecompressionStream("deflate-raw"), unbase64(text)));
  const inputs = new Inputs();
  let last = [0, 0, 0, 0, 0, 0];
  for (let i = 0; i < numbers.length; ) {
    const kind = kinds[numbers[i]], count = numbers[i + 1];
    i += 2;
    let input = kind === "none" ? idle : { kind };
    if (kind !== "none" && kind !== "action") {
      last = last.map((x, k) => x + unfolded(numbers[i + k]));
      input = { kind, at: last };
      i += 6;
    }
    if (kind === undefined || !(count > 0) || last.some(Number.isNaN)) throw new Error("the address is damaged");
    inputs.runs.push({ input, count });
    inputs.frames += count;
  }
  return inputs;
}

// 0, -1, 1, -2 ... as 0, 1, 2, 3 ...
const folded = (x) => (x < 0 ? -2 * x - 1 : 2 * x);
const unfolded = (x) => (x % 2 === 1 ? -(x + 1) / 2 : x / 2);

function bytes_of(numbers) {
  const bytes = [];
  for (let x of numbers) {
    for (; x >= 128; x = Math.floor(x / 128)) bytes.push((x % 128) + 128);
    bytes.push(x);
  }
  return new Uint8Array(bytes);
}

function numbers_of(bytes) {
  const numbers = [];
  let x = 0, scale = 1;
  for (const byte of bytes) {
    x += (byte % 128) * scale;
    scale *= 128;
    if (byte >= 128) continue;
    numbers.push(x);
    x = 0;
    scale = 1;
  }
  return numbers;
}

async function through(stream, bytes) {
  const parts = new Blob([bytes]).stream().pipeThrough(stream);
  return new Uint8Array(await new Response(parts).arrayBuffer());
}

function base64(bytes) {
  const text = btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(""));
  return text.replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

function unbase64(text) {
  return Uint8Array.from(atob(text.replaceAll("-", "+").replaceAll("_", "/")), (letter) => letter.charCodeAt(0));
}
