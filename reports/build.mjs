// SPDX-License-Identifier: GPL-3.0-or-later
// node build.mjs SOURCES MODULES OUTPUT: puts the report's scripts, the parts of npm's
// packages that they use, and the licences of these into one classic script, since a
// page opened from disk may load no modules.
import { readFileSync, readdirSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";

const [sources, modules, output] = process.argv.slice(2).map((p) => resolve(p));
const { build } = createRequire(join(modules, "x"))("esbuild");

const options = {
  entryPoints: [join(sources, "main.js")],
  outfile: output,
  nodePaths: [modules],
  bundle: true, format: "iife", target: "es2020", minify: true,
  charset: "utf8", legalComments: "none", logLevel: "warning",
};
const { metafile } = await build({ ...options, write: false, metafile: true });
await build({ ...options, footer: { js: licences(metafile) } });

// The licences of all packages from which something was taken.
function licences({ outputs }) {
  const taken = new Set();
  for (const { inputs } of Object.values(outputs))
    for (const [path, { bytesInOutput }] of Object.entries(inputs)) {
      const name = /.*node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(path)?.[1];
      if (name && bytesInOutput) taken.add(name);
    }
  const texts = [...taken].sort().map((name) => {
    const folder = join(modules, name);
    const file = readdirSync(folder).find((f) => /^licen[cs]e/i.test(f));
    if (!file) throw new Error(`${name} comes without its licence`);
    return `${name}\n\n${readFileSync(join(folder, file), "utf8").trim()}`;
  });
  return `/*\n${texts.join("\n\n----\n\n").replaceAll("*/", "* /")}\n*/`;
}
