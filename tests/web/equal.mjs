// SPDX-License-Identifier: GPL-3.0-or-later
// node equal.mjs CORE [SIZE] <HASHES: draws in WebAssembly what tests/web/hashes drew
// natively, and prints each line that differs. CORE: the folder of core.js.
import { readFileSync } from "node:fs";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { differing } from "./differing.mjs";

const { loadCore } = await import(pathToFileURL(`${resolve(process.argv[2])}/core.js`));
const lines = readFileSync(0, "utf8").split("\n").filter(Boolean);
const { drawn, differ } = differing(await loadCore(), lines,
  Number(process.argv[3] ?? 128), (line) => console.log(line));
console.log(`${drawn} drawn, ${differ} differ`);
process.exitCode = drawn && !differ ? 0 : 1;
