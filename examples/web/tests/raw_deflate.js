// SPDX-License-Identifier: MIT
// Streams of raw deflate for Node before 20.12; browsers have them.
import { Duplex } from "node:stream";
import { createDeflateRaw, createInflateRaw } from "node:zlib";

try {
  new CompressionStream("deflate-raw");
} catch {
  globalThis.CompressionStream = class {
    constructor() {
      return Duplex.toWeb(createDeflateRaw());
    }
  };
  globalThis.DecompressionStream = class {
    constructor() {
      return Duplex.toWeb(createInflateRaw());
    }
  };
}
