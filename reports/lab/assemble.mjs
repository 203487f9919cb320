// SPDX-License-Identifier: GPL-3.0-or-later
// node assemble.mjs PAGE SCRIPT WORKER WASM STYLE... OUTPUT: puts all of the laboratory
// into one page. The worker's script and the core are packed, as base64.
import { readFileSync, writeFileSync } from "node:fs";
import { gzipSync } from "node:zlib";

const [page, script, worker, wasm, ...rest] = process.argv.slice(2);
const output = rest.pop();
const text = (path) => readFileSync(path, "utf8");
const packed = (path) => gzipSync(readFileSync(path), { level: 9 }).toString("base64");
let html = text(page);
for (const [mark, what] of [["style", rest.map(text).join("\n")],
  ["core-script", packed(worker)], ["core-wasm", packed(wasm)],
  ["script", text(script).replaceAll("</script", "<\\/script")]]) {
  const parts = html.split(`<!--${mark}-->`);
  if (parts.length !== 2) throw new Error(`${page}: not one ${mark}`);
  html = parts.join(what);
}
writeFileSync(output, html);
