// SPDX-License-Identifier: MIT
// The snippet in the README of topoadapt-wasm, from a package that npm has packed and unpacked: in an empty folder in
// Node, and on a page in Chromium without a bundler.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { cpSync, existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { extname, join } from "node:path";
import { after, before, test } from "node:test";
import { no_chromium, open_browser } from "./browser.js";

const here = new URL("../topoadapt-wasm/", import.meta.url);
const no_threads = existsSync(new URL("topoadapt-threads.wasm", here)) ? undefined : "no topoadapt-threads.wasm";
const [, snippet] = /```js\n(.*?)```/s.exec(readFileSync(new URL("README.md", here), "utf8"));
// A tetrahedron, so that the snippet has something to grow.
const data = `const positions = new Float64Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]);
const triangles = new Uint32Array([0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3]);\n`;
const end = `console.log(JSON.stringify({ vertices: mesh.vertexCount, volume: mesh.components()[0].volume }));\n`;
const wanted = { vertices: 4, volume: 1.1 ** 3 / 6 };

let folder;
before(() => {
  folder = mkdtempSync(join(tmpdir(), "topoadapt-"));
  const name = execFileSync("npm", ["pack", "--silent", "--pack-destination", folder], { cwd: here, encoding: "utf8" });
  execFileSync("tar", ["-xzf", join(folder, name.trim()), "-C", folder]);
  mkdirSync(join(folder, "node_modules"));
  cpSync(join(folder, "package"), join(folder, "node_modules/topoadapt-wasm"), { recursive: true });
  writeFileSync(join(folder, "program.mjs"), snippet.replace(/(?<=^import .*\n)/m, data) + end);
});
after(() => rmSync(folder, { recursive: true }));

function check(line) {
  const { vertices, volume } = JSON.parse(line);
  assert.equal(vertices, wanted.vertices);
  assert.ok(Math.abs(volume - wanted.volume) < 1e-12, `${volume}`);
}

test("the snippet runs in Node, in an empty folder", () => {
  const output = execFileSync(process.execPath, ["program.mjs"], { cwd: folder, encoding: "utf8" });
  check(output.trim().split("\n").at(-1));
});

// Serves the folder, cross-origin isolated.
function serve() {
  const types = { ".html": "text/html", ".js": "text/javascript", ".mjs": "text/javascript", ".wasm": "application/wasm" };
  const server = createServer((request, response) => {
    const headers = { "Cross-Origin-Opener-Policy": "same-origin", "Cross-Origin-Embedder-Policy": "require-corp" };
    try {
      const body = readFileSync(join(folder, request.url));
      response.writeHead(200, { ...headers, "Content-Type": types[extname(request.url)] }).end(body);
    } catch {
      response.writeHead(404, headers).end();
    }
  });
  return new Promise((resolve) => server.listen(0, "127.0.0.1", () => resolve(server)));
}

// A page that knows the package by its name.
async function open() {
  const map = `<script type="importmap">{"imports": {"topoadapt-wasm": "/node_modules/topoadapt-wasm/src/index.js"}}</script>`;
  writeFileSync(join(folder, "page.html"), `<!doctype html><link rel="icon" href="data:,">${map}`);
  const server = await serve(), browser = await open_browser(), page = await browser.newPage();
  await page.goto(`http://127.0.0.1:${server.address().port}/page.html`);
  return { server, browser, page };
}

test("the snippet runs on a page", { skip: no_chromium }, async () => {
  const { server, browser, page } = await open(), lines = [];
  page.on("console", (message) => lines.push(message.text()));
  try {
    await page.evaluate(() => import("/program.mjs"));
    check(lines.at(-1));
  } finally {
    await browser.close();
    server.close();
  }
});

test("threads run on a page that is isolated", { skip: no_chromium ?? no_threads }, async () => {
  const { server, browser, page } = await open();
  try {
    const found = await page.evaluate(async () => {
      const { load } = await import("topoadapt-wasm");
      const library = await load({ threads: 3 });
      const mesh = library.mesh();
      mesh.load(new Float64Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]), new Uint32Array([0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3]));
      while (mesh.threads < library.threads) await new Promise((go) => setTimeout(go, 10));
      mesh.remesh(0.02, { iterations: 8 });
      mesh.move(mesh.positions.map((x) => 0.9 * x));
      mesh.step();
      const serial = (await load()).mesh();
      serial.load(new Float64Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]), new Uint32Array([0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3]));
      serial.remesh(0.02, { iterations: 8 });
      serial.move(serial.positions.map((x) => 0.9 * x));
      serial.step();
      const threads = [library.threads, mesh.threads];
      mesh.close();
      return { isolated: crossOriginIsolated, threads, same: mesh.digest() === serial.digest(), after: mesh.threads };
    });
    assert.deepEqual(found, { isolated: true, threads: [3, 3], same: true, after: 1 });
  } finally {
    await browser.close();
    server.close();
  }
});
