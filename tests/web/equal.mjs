// SPDX-License-Identifier: GPL-3.0-or-later
// node equal.mjs CORE <HASHES: draws in WebAssembly what tests/web/hashes drew natively,
// and prints each line that differs. CORE: the folder of core.js.
import { readFileSync } from "node:fs";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";

const folder = resolve(process.argv[2]);
const { loadCore } = await import(pathToFileURL(`${folder}/core.js`));
const core = await loadCore();
const size = Number(process.argv[3] ?? 128);

let scene = null, drawn = 0, differing = 0;
const said = (does) => {
  try {
    return does();
  } catch (error) {
    if (error.isFatal) throw error;
    return `${error.status}: ${error.text}`;
  }
};
for (const line of readFileSync(0, "utf8").split("\n").filter(Boolean)) {
  const [name, algorithm, wanted] = line.split("\t");
  if (scene?.name !== name) {
    if (scene) core.close(scene);
    scene = core.open({ name });
  }
  const got = said(() => core.draw(scene, { algorithm, m: size, n: size }).hash);
  drawn += 1;
  if (got === wanted) continue;
  differing += 1;
  console.log(`${name} ${algorithm}: ${got}, not ${wanted}`);
}
console.log(`${drawn} drawn, ${differing} differ`);
process.exitCode = differing ? 1 : 0;
