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
    return [`${error.status}: ${error.text}`, ""];
  }
};
const drawing = (request) => {
  const answer = core.draw(scene, request);
  const { counts = [] } = core.draw(scene, { ...request, counts: true });
  return [answer.hash, counts.join()];
};

// Oracles count what is compared as they sort, and each library sorts in its own way.
const oracles = new Set(core.algorithms().filter((a) => a.isOracle).map((a) => a.name));
const isOracle = (algorithm) => oracles.has(algorithm);

for (const line of readFileSync(0, "utf8").split("\n").filter(Boolean)) {
  const [name, algorithm, wanted, counts] = line.split("\t");
  if (scene?.name !== name) {
    if (scene) core.close(scene);
    scene = core.open({ name });
  }
  const [got, counted] = said(() => drawing({ algorithm, m: size, n: size }));
  drawn += 1;
  if (got === wanted && (isOracle(algorithm) || counted === counts)) continue;
  differing += 1;
  console.log(`${name} ${algorithm}: ${got} ${counted}, not ${wanted} ${counts}`);
}
console.log(`${drawn} drawn, ${differing} differ`);
process.exitCode = differing ? 1 : 0;
