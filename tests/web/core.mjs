// SPDX-License-Identifier: GPL-3.0-or-later
// node core.mjs FOLDER: the functions of core.js, each called once and more. Prints TAP.
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";

const folder = pathToFileURL(`${resolve(process.argv[2])}/`);
const { loadCore, HsrError } = await import(new URL("core.js", folder));
const core = await loadCore();

let n = 0;
function ok(good, name) {
  n += 1;
  console.log(`${good ? "ok" : "not ok"} ${n} - ${name}`);
}
const same = (got, wanted, name) => {
  const [a, b] = [got, wanted].map((x) => JSON.stringify(x));
  ok(a === b, a === b ? name : `${name}: ${a}, not ${b}`);
};
const error = (does) => {
  try {
    does();
    return null;
  } catch (e) {
    return e;
  }
};

// --- What there is ---

ok(/^\d+\.\d+\.\d+$/.test(core.version), "it has a version");
const house = core.builtins().find((b) => b.name === "house");
ok(house?.isThere === true && house.usage && house.about, "the house is built in");
ok(core.builtins().every((b) => typeof b.isThere === "boolean"),
  "every scene is there or not");
same(core.kinds()[0].name, "ids", "the first kind of answer is ids");
const algorithms = core.algorithms();
const named = (name) => algorithms.find((a) => a.name === name);
same([named("watkins").kind, named("watkins").year > 1960, named("watkins").isOracle,
  named("watkins").canTrace, named("oracle").isOracle, named("oracle").canTrace],
["ids", true, false, true, true, false], "watkins and the oracle are described");
ok(named("watkins").outline.length > 3 &&
  named("watkins").counters.every((c) => c.name && c.step && Array.isArray(c.outcomes)),
"watkins has an outline and counters");
ok(named("hzbuffer").options.some((o) => o.words.length), "hzbuffer has words to choose");

// --- Scenes ---

const scene = core.open({ name: "house" });
ok(scene.nFaces > 0 && scene.views.length > 0 && scene.views[0].eye.length === 3,
  "the house has faces and a camera");
const g = core.geometry(scene);
same([g.ring.length, g.rgb.length, g.object.length], [scene.nFaces, 3 * scene.nFaces,
  scene.nFaces], "its geometry has an entry for each face");
same([g.xyz.length, g.vertex.length], [3 * scene.nVertices,
  g.ring.reduce((a, b) => a + b)], "and vertices and corners");
ok(g.objects.length === scene.nObjects && g.object.every((o) => o < scene.nObjects),
  "and objects");
const sides = (name, what) =>
  [...new Set(core.geometry(core.open({ name, ...what })).oneSided)];
same([sides("house"), sides("house", { twoSided: true }), sides("one-sided").sort()],
  [[1], [0], [0, 1]], "and sides");
const view = { m: 64, n: 48, camera: scene.views[0] };
const drawn = core.draw(scene, { algorithm: "watkins", m: 64, n: 48, counts: true });

const arrays = core.openArrays({ name: "again", ...g });
same(core.draw(arrays, { algorithm: "watkins", ...view }).ids.length, 64 * 48,
  "a scene of these arrays can be drawn");
const cube = `v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n`;
const file = core.open({ name: "square.obj", bytes: new TextEncoder().encode(cube) });
same([file.name, file.nFaces, file.nVertices], ["square.obj", 1, 4], "a file can be opened");
same(error(() => core.open({ name: "bad.obj",
  bytes: new TextEncoder().encode("v 0 0\nf 1 2 3\n") }))?.status, 3,
"a file that is wrong is refused");
same(error(() => core.open({ name: "no-such-scene" })) instanceof HsrError, true,
  `a scene that is not there is an HsrError`);

// --- Answers ---

same([drawn.kind, drawn.m, drawn.n, drawn.ids.length, drawn.rgba.length,
  drawn.counts.length], ["ids", 64, 48, 3072, 12288, named("watkins").counters.length],
"an answer has ids, colours and counts");
ok(drawn.ids.some((id) => id < scene.nFaces) && /^[0-9a-f]{16}$/.test(drawn.hash),
  "with faces, and a hash");
const worked = core.draw(scene, { algorithm: "zbuffer", ...view, work: true });
same([worked.work.length, worked.work.reduce((a, b) => a + b, 0), drawn.work],
  [3072, worked.counts[0], undefined],
  "the work at the samples adds up, if it is asked for");
same(core.draw(scene, { algorithm: "newell", ...view }).hash, drawn.hash,
  "newell's answer is the same");
const part = core.draw(scene, { algorithm: "zbuffer", ...view, window: [8, 8, 24, 16] });
same([part.window, part.ids[8 * 64 + 8], part.ids[0]], [[8, 8, 24, 16],
  drawn.ids[8 * 64 + 8], 0xffffffff], "a window can be drawn");
const lines = core.draw(scene, { algorithm: "appel", ...view });
ok(lines.segments.length > 10 && lines.ids === undefined && lines.rgba === undefined &&
  lines.segments[0].from.length === 3, "a line drawing has segments");
const drawer = core.prepare(scene, { algorithm: "watkins", counts: true });
const [first, second] = [64, 64].map((m) => core.redraw(drawer, { ...view, m }));
same([first.hash, second.hash], [drawn.hash, drawn.hash], "a drawer draws again");
same(core.redraw(drawer, { m: 32, n: 32 }).ids.length, 1024, "also in another size");
core.release(drawer);
same(error(() => core.draw(scene, { algorithm: "watkin", ...view }))?.status, 2,
  "an algorithm that is not there is an error");
ok(error(() => core.draw(scene, { algorithm: "splat", ...view }))?.status === 6,
  "an algorithm for grids refuses the house");

// --- The judge ---

const good = core.judge(scene, view, drawn.ids);
same([good.compared, good.differing, good.places], [3072, 0, []], "the judge finds no fault");
const wrong = drawn.ids.slice();
wrong[100] = wrong[100] === 1 ? 2 : 1;
same([core.judge(scene, view, wrong).differing, core.judge(scene, view, wrong).places],
  [1, [100]], "and one that is there");
same(core.judgeAlgorithm(scene, { algorithm: "appel", ...view }).differing, 0,
  "a line drawing is judged");
const [at] = [...drawn.ids.keys()].filter((k) => drawn.ids[k] !== 0xffffffff);
const over = core.why(scene, view, at % 64, Math.floor(at / 64));
ok(over[0].face === drawn.ids[at] && over.every((f, k) => !k || f.depth >= over[k - 1].depth),
  "the faces over a sample come in order, the visible one first");
let firsts = 0;
for (let k = 0; k < 3072; k += 7)
  firsts += (core.why(scene, view, k % 64, Math.floor(k / 64))[0]?.face ?? 0xffffffff) ===
    drawn.ids[k];
same(firsts, Math.ceil(3072 / 7), "the first of them is what is seen, everywhere");

// --- Steps and the survey ---

const steps = core.steps(scene, { algorithm: "watkins", ...view }, { events: 1000 });
const length = new DataView(steps.buffer).getUint32(0, true);
const said = JSON.parse(new TextDecoder().decode(steps.subarray(4, 4 + length)));
same([said.schema, said.kept, said.header.counters.length], ["hsr-lesson/2", 1000,
  named("watkins").counters.length], "the steps of a run are told");
same(error(() => core.steps(scene, { algorithm: "oracle", ...view }))?.status, 2,
  "an oracle has none");
const table = core.table1(scene, view);
same(table.find(([symbol]) => symbol === "F_t")[2], scene.nFaces, "Table I is measured");
const costs = core.predicted(scene, { algorithm: "watkins", ...view });
ok(costs.length > 0 && costs.every((c) => c.label && c.measured >= 0),
  "Table III is predicted");

[arrays, file, scene].forEach(core.close);
console.log(`1..${n}`);
