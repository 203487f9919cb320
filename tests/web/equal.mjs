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
    return [`${error.status}: ${error.text}`, 0, ""];
  }
};
// The sum of its coordinates, as tests/web/hashes has it.
function sumOf({ segments = [], polygons }) {
  const all = segments.flatMap((s) => [s.t0, s.t1, ...s.from, ...s.to])
    .concat(...(polygons?.xy ?? []));
  return all.reduce((sum, x, k) => sum + (1 + k % 7) * x, 0);
}
const drawing = (request) => {
  const answer = core.draw(scene, request);
  const { counts = [] } = core.draw(scene, { ...request, counts: true });
  return [answer.hash, sumOf(answer), counts.join()];
};

for (const line of readFileSync(0, "utf8").split("\n").filter(Boolean)) {
  const [name, algorithm, wanted, sum, counts] = line.split("\t");
  if (scene?.name !== name) {
    if (scene) core.close(scene);
    scene = core.open({ name });
  }
  const [got, added, counted] = said(() => drawing({ algorithm, m: size, n: size }));
  drawn += 1;
  const isSame = got === wanted && counted === counts &&
    added === Number(sum);
  if (isSame) continue;
  differing += 1;
  console.log(`${name} ${algorithm}: ${got} ${added} ${counted}, not ` +
    `${wanted} ${sum} ${counts}`);
}
console.log(`${drawn} drawn, ${differing} differ`);
process.exitCode = differing ? 1 : 0;
