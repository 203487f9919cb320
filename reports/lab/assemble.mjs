// SPDX-License-Identifier: GPL-3.0-or-later
// node assemble.mjs MODULES PAGE SCRIPT CORE STYLE... OUTPUT: puts all of the laboratory
// into one page. Of the folder CORE it takes the worker's script, which becomes one file,
// and hsr.wasm. Both are packed by zopfli, as base64: what it packs is 4 % smaller than
// by zlib.
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";

const [modules, page, script, core, ...rest] = process.argv.slice(2);
const { build } = createRequire(join(resolve(modules), "x"))("esbuild");
const output = rest.pop();
const text = (path) => readFileSync(path, "utf8");
const packed = (path) => execFileSync("zopfli", ["-c", path],
  { maxBuffer: 1 << 26 }).toString("base64");
const scriptFile = join(core, "worker.min.js");
await build({ bundle: true, format: "iife", target: "es2020", minify: true,
  charset: "utf8", logLevel: "error", entryPoints: [join(core, "worker.js")],
  outfile: scriptFile, external: ["node:*", "fs", "path", "module"],
  define: { "import.meta.url": '"blob:"' } });
let html = text(page);
for (const [mark, what] of [["style", rest.map(text).join("\n")],
  ["core-script", packed(scriptFile)],
  ["core-wasm", packed(join(core, "hsr.wasm"))],
  ["script", text(script).replaceAll("</script", "<\\/script")]]) {
  const parts = html.split(`<!--${mark}-->`);
  if (parts.length !== 2) throw new Error(`${page}: not one ${mark}`);
  html = parts.join(what);
}
writeFileSync(output, html);
