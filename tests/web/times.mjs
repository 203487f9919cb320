// SPDX-License-Identifier: GPL-3.0-or-later
// node times.mjs CORE SCENE SIZE ALGORITHM...: the first and the least time of each to
// draw, in milliseconds, and the memory of the core.
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [folder, name, size, ...algorithms] = process.argv.slice(2);
const { loadCore } = await import(pathToFileURL(`${resolve(folder)}/core.js`));
const core = await loadCore();
const scene = core.open({ name });
const [m, n] = [Number(size), Number(size)];

for (const algorithm of algorithms) {
  const first = core.draw(scene, { algorithm, m, n }).seconds;
  const drawer = core.prepare(scene, { algorithm });
  let least = Infinity;
  const end = performance.now() + 1500;
  do least = Math.min(least, core.redraw(drawer, { m, n }).seconds.draw);
  while (performance.now() < end);
  core.release(drawer);
  console.log([algorithm, ...[first.draw + first.prepare, least].map((s) =>
    (1000 * s).toFixed(3)), core.memory()].join("\t"));
}
