// SPDX-License-Identifier: GPL-3.0-or-later
// node sample.mjs LIST DIR: writes a report's data in the form of `hsr report`,
// on the algorithms of LIST. The data are made up but always the same. They
// hold every status, peers, an unknown algorithm, and odd names.
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { deflateSync } from "node:zlib";

const [list, dir] = process.argv.slice(2);
const algorithms = [...JSON.parse(readFileSync(list, "utf8")).algorithms, {
  name: "newcomer", title: "An algorithm that nobody knows", authors: "A. Nonym",
  year: 2031, source: "unpublished", taxonomy: "image space",
  branch: "point sampling",
  sort_order: "XYZ", coherence: null, kind: "ids", known_wrong: false,
  visible_only: false, restrictions: ["TR"], counters: [], steps: [],
  sorts: [{ what: "faces", key: "X", method: "guess", often: "once" }],
}];
const ODD = "odd <b>&\"name'/50%";

// --- random numbers, always the same ---
let state = 1;
function chance() {
  state = Math.imul(state, 1664525) + 1013904223 >>> 0;
  return state / 2 ** 32;
}
const about = (x, spread = 0.1) => x * (1 + spread * (2 * chance() - 1));

// --- the cells ---
const place = (scene, view, width, height, faces, depth) =>
  ({ scene, view, width, height, faces, depth });
const places = [
  place("house", 1, 97, 61, 231, 3), place("house", 2, 97, 61, 231, 2.4),
  place("harbor", 1, 500, 500, 4998, 3.1),
  place("big-harbor", 1, 500, 500, 119126, 2.9),
  place(ODD, 1, 97, 61, 12, 2),
  ...[100, 1000, 10000].map((n) => place(`soup:${n}:7`, 1, 256, 256, n, n / 90)),
  ...[128, 256, 512, 1024].map((n) => place("twist", 1, n, n, 6295, 4)),
  ...[2, 4, 8, 16].map((n) => place(`layers:${n}`, 1, 256, 256, 1000, n)),
];
const peers = ["embree", "llvmpipe"];

function cellOf(where, { name, kind, counters = [] }, peer) {
  const { scene, view, width, height, faces } = where;
  const samples = width * height;
  const status = statusOf(name, where);
  const drawn = status === "ok" || status === "wrong";
  const base = 1e-8 * samples * (1 + (name.length % 5)) +
    2e-7 * faces ** (1 + (name.length % 3) / 4);
  const timed = status === "ok" || (peer && drawn);
  return {
    place: places.indexOf(where), algorithm: name, peer, kind, threads: 1, status,
    mismatches: status === "wrong" ? (peer ? 17 : 341) : drawn ? 0 : null,
    compared: drawn ? samples : null,
    reason: { refused: "NP: face 17 goes through face 4",
      timeout: "longer than 60 s", crash: "signal 11",
      memory: "more than 2048 MB" }[status] ?? null,
    adapted: name === "romney" ? ["triangulate"] : [],
    ...drawn && !peer && counters.length && { counts: [namesOf(counters),
      ...counters.map((c, k) => Math.round(about(faces * (k + 1) * 9)))] },
    ...timed && timesOf(name, base),
  };
}

// The number of a list of counters' names.
const counterLists = [];
function namesOf(counters) {
  const names = counters.map((c) => c.name);
  const there = counterLists.findIndex((list) => `${list}` === `${names}`);
  return there < 0 ? counterLists.push(names) - 1 : there;
}

function statusOf(name, { scene, view, faces }) {
  if (name === "painter" && scene === "house" && view === 1) return "wrong";
  if (name === "embree") return "wrong";
  if (name === "newcomer" && faces > 100000) return "crash";
  if (name === "raycast" && faces > 100000) return "timeout";
  if (name === "schumacker" && scene.startsWith("soup")) return "refused";
  if (name === "oracle" && faces > 100000) return "memory";
  return "ok";
}

function timesOf(name, base) {
  const median = about(base);
  const value = median / base;
  return {
    seconds: [median, 0.97 * median, 1.04 * median, 0.96 * median],
    ratio: [value, 0.95 * value, 1.05 * value],
    phases: { import: about(1e-3), adapt: about(1e-4), prepare: about(2e-4),
      shade: about(8e-3) },
    peak_kb: Math.round(about(31000)),
  };
}

const drawing = algorithms.filter((a) => a.name !== "null" &&
  a.name !== "line-oracle");
const cells = places.flatMap((where) => [
  ...drawing.map((a) => cellOf(where, a, false)),
  ...peers.map((name) => cellOf(where, { name, kind: "ids" }, true))]);

// --- figures computed from them ---
function growthOf(measure, over, x, chosen) {
  return drawing.map(({ name, steps = [] }) => {
    const points = places.filter(chosen).map((where) => {
      const cell = cells.find((c) => c.algorithm === name &&
        places[c.place] === where);
      const y = measure === "seconds" ? cell.seconds?.[0]
        : steps.length && about(40 * where.faces);
      return y && { scene: where.scene, view: where.view, width: where.width,
        height: where.height, x: x(where), y };
    }).filter(Boolean);
    const e = about(1, 0.4);
    return { algorithm: name, measure, of: "a ladder", over, exponent: e,
      low: e - 0.1, high: e + 0.1, points };
  }).filter((g) => g.points.length > 1);
}

const soups = (p) => p.scene.startsWith("soup");
const growth = [
  ...growthOf("seconds", "faces", (p) => p.faces, soups),
  ...growthOf("seconds", "samples", (p) => p.width * p.height,
    (p) => p.scene === "twist"),
  ...growthOf("seconds", "depth", (p) => p.depth,
    (p) => p.scene.startsWith("layers")),
  ...growthOf("comparisons", "faces", (p) => p.faces, soups),
];
const geometric = drawing.map(({ name }, k) => {
  const ratio = name === "zbuffer-fast" ? 1 : 1 + k / 3;
  return { algorithm: name, cells: places.length, ratio, low: 0.9 * ratio,
    high: 1.1 * ratio };
});

// --- the tables of 1974 ---
const environments = places.filter((p) => ["house", "harbor", "big-harbor"]
  .includes(p.scene) && p.view === 1)
  .map(({ scene, view, width, height }) => ({ scene, view, width, height }));
const faces = [100, 2500, 60000];
const powers = (c, e) => faces.map((f) => Math.round(c * f ** e));
const symbols = [["F_t", "faces in all"], ["F_r", "relevant faces"],
  ["E_s", "relevant edges, shared ones once"], ["D_c", "depth complexity"]];
const measuredSymbols = { F_t: [231, 4998, 119126], F_r: [105, 2472, 59512],
  E_s: [293, 7341, 130112], D_c: [2.871, 3.104, null] };
const ratios = (a, b) => a.map((x, k) => x === null || !b[k] ? null : x / b[k]);

const table3 = algorithms.flatMap((a) => a.steps.map((step, k) => {
  const { price } = step.terms[0];
  const predicted = step.formula === null ? [null, null, null]
    : powers(price * 20, 1 + k / 4);
  const measured = powers(price * about(20, 0.5), 1 + k / 4);
  if (a.name === "roberts") measured[2] = null;
  return { algorithm: a.name, group: a.name, step: step.label,
    formula: step.formula, terms: step.terms,
    paper: step.formula === null ? null : powers(price * 19, 1 + k / 4),
    predicted, measured, ratio: ratios(measured, predicted), once: k > 7,
    growth: { measured: 1 + k / 4, low: 0.9 + k / 4, high: 1.1 + k / 4,
      predicted: step.formula === null ? null : 1 + k / 4 } };
}));
const stepping = algorithms.filter((a) => a.steps.length);
const total = (name, field, k) => table3.filter((r) => r.algorithm === name)
  .reduce((sum, r) => sum + (r[field]?.[k] ?? 0), 0);
const totals = (name, field) => faces.map((_, k) => total(name, field, k));

const tables = {
  schema: "hsr-tables/1", environments,
  table1: symbols.map(([symbol, meaning]) => ({ symbol, meaning })),
  table2: symbols.map(([symbol], k) => ({ symbol,
    rule: k === 1 ? "given" : k === 3 ? null : "2 F_r", paper: faces,
    rule_of_measured: faces, measured: measuredSymbols[symbol],
    ratio: ratios(measuredSymbols[symbol], faces) })),
  table3,
  summary: environments.map(({ scene }, k) => ({ scene,
    columns: stepping.map(({ name }) => ({ algorithm: name,
      steps: table3.filter((r) => r.algorithm === name).map((r) => ({
        step: r.step, predicted: r.predicted[k], measured: r.measured[k] })),
      predicted: total(name, "predicted", k), paper: total(name, "paper", k),
      measured: total(name, "measured", k) })) })),
  table7: stepping.map(({ name }) => ({ algorithm: name,
    paper: totals(name, "paper"), predicted: totals(name, "predicted"),
    measured: totals(name, "measured") })),
  figure29a: algorithms.filter((a) => a.sorts.length)
    .map(({ name, restrictions }) => ({ algorithm: name, restrictions })),
  figure29b: algorithms.filter((a) => a.sorts.length).map((a) => ({
    algorithm: a.name, sort_order: a.sort_order ?? null,
    coherence: a.coherence ?? null, sorts: a.sorts })),
  sorting_orders: [...new Set(algorithms.map((a) => a.sort_order))]
    .filter(Boolean).map((order) => ({ order, algorithms: algorithms
      .filter((a) => a.sort_order === order).map((a) => a.name) })),
  greene: [
    { table: "Depth complexity", source: "1995, figure 3.8",
      what: "naive z-buffer: depth tests", paper: 83.7, ours: 30.1,
      ratio: 0.36, reason: "back faces are not compared" },
    { table: "Overhead", source: "", what: "not measured", paper: null,
      ours: null, ratio: null, reason: null }],
  conclusions: [
    { section: "VI", claim: "Watkins' depth search grows with the square root " +
      "of the faces", verdict: "borne out",
    evidence: "exponent 0.42 [0.38, 0.46], predicted 0.5" },
    { section: "VII", claim: "Roberts' grows with the square of the faces",
      verdict: "not borne out", criterion: "exponent: 1.75 to 2.25",
      evidence: "exponent 1.31 [1.28, 1.35]" },
    { section: "IX", claim: "Frame coherence pays", verdict: "not measured",
      evidence: null }],
};

const views = places.map(({ scene, view, width, height, faces: F_r }, k) => ({
  record: "view", run: "5a", scene, scene_hash: "0f", view, width, height,
  table1: { ...Object.fromEntries(symbols.map(([s]) =>
    [s, measuredSymbols[s][Math.min(k, 2)]])), F_r } }));

// --- the house, pixel by pixel: a floor and two boxes that overlap; the
//     painter has the wrong one in front ---
const W = 97, H = 61;
const inside = (i, j, [i0, j0, i1, j1]) =>
  i0 <= i && i <= i1 && j0 <= j && j <= j1;
const A = [10, 10, 50, 50], B = [40, 20, 80, 55], FLOOR = [0, 40, 96, 60];
const COLOURS = { "-1": [225, 232, 240], 0: [150, 160, 140], 1: [190, 90, 60],
  2: [70, 110, 170] };

function truth(i, j) {
  if (inside(i, j, B)) return [2, 2.5 + i / 64];
  if (inside(i, j, A)) return [1, 3.5];
  return inside(i, j, FLOOR) ? [0, 5] : [-1, Infinity];
}

const pixels = Array.from({ length: W * H }, (_, k) =>
  truth(k % W, Math.floor(k / W)));
const overlap = pixels.map((_, k) => [k, 1, 3.5]).filter(([k]) =>
  inside(k % W, Math.floor(k / W), A) && inside(k % W, Math.floor(k / W), B));

function runs(ids) {
  const list = [];
  for (const id of ids)
    if (list.at(-2) === id) list[list.length - 1] += 1;
    else list.push(id, 1);
  return list;
}

const probe = {
  width: W, height: H, ids: runs(pixels.map(([id]) => id)),
  depth: Buffer.from(Float32Array.from(pixels, ([, t]) => t).buffer)
    .toString("base64"),
  objects: [["floor", 0, 1], ["box <A>", 1, 1], ["box B", 2, 6]],
  differences: Object.fromEntries(drawing.filter((a) => a.kind === "ids")
    .map(({ name }) => [name, name === "painter" ? overlap : []])),
};

const painted = (id) => id === "house-1"; // where the painter is wrong
const picture = (id, scene, view) => ({
  key: id, scene, view, width: W, height: H, picture: `pictures/${id}.png`,
  probe: `probe/${id}.js`,
  entries: drawing.map(({ name, kind }) => ({ algorithm: name, kind,
    status: name === "painter" && painted(id) ? "wrong" : "ok",
    mismatches: name === "painter" && painted(id) ? 341 : 0,
    work: kind === "ids" && name !== "oracle" ? `work/${id}.png` : null,
    drawing: kind === "segments" ? `drawings/${id}.svg` : null,
    difference: name === "painter" && painted(id) ? `difference/${id}.png`
      : null })) });

// --- files ---
function write(path, bytes) {
  mkdirSync(dirname(join(dir, path)), { recursive: true });
  writeFileSync(join(dir, path), bytes);
}

// The check sum of a PNG file's chunk.
function crc32(bytes) {
  let sum = ~0;
  for (const byte of bytes) {
    sum ^= byte;
    for (let k = 0; k < 8; k++) sum = sum >>> 1 ^ (sum & 1 ? 0xedb88320 : 0);
  }
  return ~sum >>> 0;
}

function png(colour) {
  const rows = Buffer.concat(Array.from({ length: H }, (_, j) => Buffer.from([0,
    ...Array.from({ length: W }, (_, i) => colour(i, j)).flat()])));
  const chunk = (name, data) => {
    const body = Buffer.concat([Buffer.from(name, "latin1"), data]);
    const length = Buffer.alloc(4), sum = Buffer.alloc(4);
    length.writeUInt32BE(data.length);
    sum.writeUInt32BE(crc32(body));
    return Buffer.concat([length, body, sum]);
  };
  const head = Buffer.alloc(13);
  head.writeUInt32BE(W, 0);
  head.writeUInt32BE(H, 4);
  head.set([8, 2], 8); // eight bits, red green blue
  return Buffer.concat([Buffer.from("\x89PNG\r\n\x1a\n", "latin1"),
    chunk("IHDR", head), chunk("IDAT", deflateSync(rows)),
    chunk("IEND", Buffer.alloc(0))]);
}

for (const id of ["house-1", "house-2", "odd-1"]) {
  const own = painted(id) ? probe
    : { ...probe, differences: { ...probe.differences, painter: [] } };
  write(`probe/${id}.js`,
    `hsrProbe(${JSON.stringify(id)}, ${JSON.stringify(own)});\n`);
  write(`pictures/${id}.png`, png((i, j) => COLOURS[truth(i, j)[0]]));
  write(`work/${id}.png`, png((i, j) => Array(3).fill(
    (truth(i, j)[0] + 1) * 60 + (i + j) % 9)));
  write(`drawings/${id}.svg`, `<svg xmlns="http://www.w3.org/2000/svg" ` +
    `width="${W}" height="${H}"><path d="M10 10H50V50H10Z" fill="none" ` +
    `stroke="#000"/></svg>\n`);
}
write("errors/1-1.png", png((i, j) => Array(3).fill((i + j) % 256)));
write("difference/house-1.png", png((i, j) => inside(i, j, A) &&
  inside(i, j, B) ? [255, 0, 0] : [40, 40, 40]));
write("data.js", `window.hsr = ${JSON.stringify({
  schema: "hsr-report/2", title: "A made-up report",
  headers: [{ schema: "hsr-bench/1", record: "header", run: "5a",
    date: "2026-11-21T12:00:00Z", command: ["hsr", "bench", "house", "harbor"],
    version: "0.1.0", commit: "82d8f52", code: "0123abcd",
    compiler: "gcc 12.2.0", flags: "-O3 -g", seed: 1, starts: 2, repetitions: 9,
    timeout: 60, memory_mb: 2048,
    machine: { cpu: "A made-up processor", cores: 2, threads: 2,
      memory_kb: 8062000, caches: [{ level: 1, kb: 48 }, { level: 2, kb: 2048 }],
      os: "Linux 6.1 x86_64", governor: null, load: [0.1, 0.2, 0.3] } }],
  algorithms, kinds: [{ name: "ids", meaning: "the visible face of every sample",
    places: "samples" }, { name: "segments", meaning: "every edge in intervals",
    places: "edges" }],
  views, places: places.map(({ scene, view, width, height }) =>
    ({ scene, view, walk: 1, width, height })), counters: counterLists, cells,
  baseline: "zbuffer-fast", growth, geometric, tables,
  left_out: [{ scene: "big-harbor", view: 1, drawings: 30, why: "no time" }],
  errors: [{ schema: "hsr-errors/1", scene: "house", view: 1, width: W, height: H,
    filter: "box", pictures: [
      { picture: "zbuffer-fast", samples: 4, mean: 0.0014, largest: 0.0312, x: 5, y: 7,
        over: 0.0125, where: "errors/1-1.png" },
      { picture: "a-buffer", samples: null, mean: 3e-4, largest: 0.058, x: 2,
        y: 9, over: 0.001, where: null }] },
  { schema: "hsr-errors/1", scene: ODD, view: 1, width: W, height: H,
    filter: "tent", pictures: [] }],
  pictures: [picture("house-1", "house", 1), picture("house-2", "house", 2),
    picture("odd-1", ODD, 1)],
})};\n`);
