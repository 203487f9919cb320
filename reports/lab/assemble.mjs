// SPDX-License-Identifier: GPL-3.0-or-later
// node assemble.mjs MODULES PAGE EARLY SCRIPT CORE STYLE... OUTPUT: puts all of the
// laboratory into one page, in which the script EARLY comes before SCRIPT. Of the folder
// CORE it takes the client, which EARLY is made with, the worker's script, which becomes
// one file, and hsr.wasm. The latter two are packed by zopfli, as base64: what it packs
// is 4 % smaller than by zlib.
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";

const [modules, page, early, script, core, ...rest] = process.argv.slice(2);
const { build } = createRequire(join(resolve(modules), "x"))("esbuild");
const output = rest.pop();
const text = (path) => readFileSync(path, "utf8");
// In elements of 100,000 characters: Chromium 156 takes .6 s to read one element of two
// million, and .2 s to read twenty.
const packed = (path, name) => execFileSync("zopfli", ["-c", path],
  { maxBuffer: 1 << 26 }).toString("base64").match(/.{1,100000}/g).map((part) =>
  `<script type="text/plain" class="${name}">${part}</script>`).join("\n");
const bundle = { bundle: true, format: "iife", target: "es2020", minify: true,
  charset: "utf8", logLevel: "error" };
const scriptFile = join(core, "worker.min.js");
await build({ ...bundle, entryPoints: [join(core, "worker.js")], outfile: scriptFile,
  external: ["node:*", "fs", "path", "module"],
  define: { "import.meta.url": '"blob:"' } });
const { outputFiles: [{ text: earlyText }] } = await build({ ...bundle,
  entryPoints: [early], write: false,
  alias: { "hsr-client": resolve(core, "client.js") } });
const inPage = (code) => code.replaceAll("</script", "<\\/script");
let html = text(page);
for (const [mark, what] of [["style", rest.map(text).join("\n")],
  ["core-script", packed(scriptFile, "core-script")],
  ["core-wasm", packed(join(core, "hsr.wasm"), "core-wasm")],
  ["early", inPage(earlyText)], ["script", inPage(text(script))]]) {
  const parts = html.split(`<!--${mark}-->`);
  if (parts.length !== 2) throw new Error(`${page}: not one ${mark}`);
  html = parts.join(what);
}
writeFileSync(output, html);
