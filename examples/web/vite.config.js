// SPDX-License-Identifier: MIT
// The page is a single file with everything in it, which also opens from a disk. The licences of what it contains are
// its first lines.
import { readFileSync } from "node:fs";
import { defineConfig } from "vite";

function in_one_file() {
  return {
    name: "in-one-file",
    enforce: "post",
    generateBundle(_, bundle) {
      const page = bundle["index.html"];
      for (const [name, part] of Object.entries(bundle)) {
        if (part === page) continue;
        const text = part.code ?? part.source;
        const tag = part.type === "chunk" ? /<script type="module"[^>]*src="[^"]*"[^>]*><\/script>/
          : /<link rel="stylesheet"[^>]*>/;
        const inline = part.type === "chunk" ? `<script type="module">${text.replaceAll("</script", "<\\/script")}</script>`
          : `<style>${text}</style>`;
        if (!tag.test(page.source)) throw new Error(`no place for ${name}`);
        page.source = page.source.replace(tag, () => inline);
        delete bundle[name];
      }
      page.source = page.source.replace("<!doctype html>", (first) => `${first}\n<!--\n${licences()}-->`);
    },
  };
}

// A page in one file is never isolated, so module and worker of threads would be dead weight.
function without_threads() {
  const addresses = /new URL\("[^"]*(?:-threads\.wasm|worker\.js)", import\.meta\.url\)/g;
  return {
    name: "without-threads",
    enforce: "pre",
    transform(code, id) {
      if (id.endsWith("topoadapt-wasm/src/index.js")) return code.replace(addresses, "undefined");
    },
  };
}

function licences() {
  const of = { topoadapt: "topoadapt-wasm/LICENSE", "three.js": "node_modules/three/LICENSE" };
  return Object.entries(of).map(([name, file]) => `${name}\n\n${readFileSync(file, "utf8")}\n`).join("\n");
}

export default defineConfig({
  plugins: [without_threads(), in_one_file()],
  assetsInclude: ["**/*.wasm"],
  esbuild: { legalComments: "inline" },
  build: { target: "es2022", assetsInlineLimit: 2 ** 24, modulePreload: false, chunkSizeWarningLimit: 4096 },
});
