// SPDX-License-Identifier: GPL-3.0-or-later
// node assemble.mjs MODULES PAGE SCRIPT CORE STYLE... OUTPUT: puts all of the laboratory
// into one page. Of the folder CORE it takes the worker's script, which becomes one
// file, and hsr.wasm. Both are packed, as base64.
import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { gzipSync } from "node:zlib";

const [modules, page, script, core, ...rest] = process.argv.slice(2);
const { build } = createRequire(join(resolve(modules), "x"))("esbuild");
const output = rest.pop();
const text = (path) => readFileSync(path, "utf8");
const packed = (bytes) => gzipSync(bytes, { level: 9 }).toString("base64");
const worker = (await build({ entryPoints: [join(core, "worker.js")], bundle: true,
  format: "iife", target: "es2020", minify: true, charset: "utf8", write: false,
  external: ["node:*", "fs", "path", "module"], logLevel: "error",
  define: { "import.meta.url": '"blob:"' } })).outputFiles[0].text;
let html = text(page);
for (const [mark, what] of [["style", rest.map(text).join("\n")],
  ["core-script", packed(worker)], ["core-wasm", packed(readFileSync(join(core,
    "hsr.wasm")))],
  ["script", text(script).replaceAll("</script", "<\\/script")]]) {
  const parts = html.split(`<!--${mark}-->`);
  if (parts.length !== 2) throw new Error(`${page}: not one ${mark}`);
  html = parts.join(what);
}
writeFileSync(output, html);
