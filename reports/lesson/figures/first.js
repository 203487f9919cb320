// SPDX-License-Identifier: GPL-3.0-or-later
// Figures of the simple algorithms: the painter's order in depth, what the z-buffer
// keeps at a sample, and one ray from the side. The steps say what was painted,
// compared and hit, and in which order; depths are found again from the scene.
import { columnSegments, depths } from "../data/projection.js";
import { counterNamed } from "../telling/figures.js";
import { wrongSamples } from "../telling/wrong.js";
import { board, colourOf, line, round, s, text } from "./drawing.js";

const WIDE = 420;
const RIGHT = "var(--hue-2)", WRONG = "var(--hue-1)";
const left = { "text-anchor": "start" };

// --- The painter: the order in depth ---

const MOST_ROWS = 12, MOST_PAIRS = 12;

export function depthOrder(run) {
  const reach = depths(run).reach;
  const all = [...paintedFaces(run)].filter(([f]) => reach(f));
  const pairs = pairsOf(run).filter(({ two: [f, g] }) => reach(f) && reach(g) &&
    reach(f)[0] < reach(g)[1] && reach(g)[0] < reach(f)[1]).slice(0, MOST_PAIRS);
  const inPairs = new Set(pairs.flatMap(({ two }) => two));
  const shown = new Set(all.map(([f, many]) => ({ f, many: inPairs.has(f) ? Infinity
    : many })).sort((p, q) => q.many - p.many).slice(0, MOST_ROWS).map(({ f }) => f));
  const rows = all.map(([f]) => f).filter((f) => shown.has(f));
  if (!rows.length) return null;
  const marked = pairs.filter(({ two }) => two.every((f) => shown.has(f)));
  const [low, high] = [Math.min(...rows.map((f) => reach(f)[0])),
    Math.max(...rows.map((f) => reach(f)[1]))];
  const end = WIDE - 30 - 16 * marked.length;
  const px = (d) => 70 + (end - 70) * (high > low ? (d - low) / (high - low) : 0.5);
  const py = (f) => 44 + 30 * rows.indexOf(f);
  const foot = 44 + 30 * rows.length;
  const bars = rows.map((f) => {
    const [near, far] = reach(f), y = py(f);
    return [text(62, y + 4, `face ${f}`, { "text-anchor": "end", "font-size": 13 }),
      s("rect", { class: "interval", x: round(px(near)), y: y - 8,
        width: Math.max(1, round(px(far) - px(near))), height: 16,
        fill: colourOf(run, f), stroke: "var(--ink)" }),
      s("circle", { cx: round(px(far)), cy: y, r: 4.5, fill: "var(--ink)" })];
  });
  const brackets = marked.map(({ two, wrong }, k) => {
    const x = end + 20 + 16 * k;
    const [y0, y1] = two.map(py).sort((p, q) => p - q);
    const look = { stroke: wrong ? WRONG : RIGHT, "stroke-width": wrong ? 3 : 2,
      "stroke-dasharray": wrong ? "5 3" : null };
    return [s("g", { class: wrong ? "pair wrong" : "pair" }, line(x, y0, x, y1, look),
      line(x - 5, y0, x, y0, look), line(x - 5, y1, x, y1, look))];
  });
  return board(WIDE, foot + 66, `The depths of ${rows.length} faces in the order of ` +
    `painting; ${marked.length} pairs are marked, ${marked.filter((p) =>
      p.wrong).length} of them wrong`,
  text(70, 16, "◂ the eye", { ...left, "font-size": 13 }),
  text(8, 30, "painted first", { ...left, fill: "var(--faint)" }),
  text(8, foot + 1, "painted last", { ...left, fill: "var(--faint)" }),
  ...bars, ...brackets,
  line(px(low), foot + 6, px(high), foot + 6), text(px(low), foot + 22,
    `${low.toFixed(1)} deep`, { ...left, "font-size": 12 }),
  text(px(high), foot + 22, high.toFixed(1), { "text-anchor": "end",
    "font-size": 12 }),
  text(8, foot + 42, wordsOf(marked), { ...left, "font-size": 12.5 }),
  text(8, foot + 60, rows.length < all.length
    ? `Shown: ${rows.length} of ${all.length} painted faces` : "", { ...left,
    "font-size": 12.5 }));
}

function wordsOf(pairs) {
  const wrong = pairs.filter((p) => p.wrong);
  if (!wrong.length) return "No pair is painted in a wrong order";
  const [{ two: [f, g], wrong: many }] = wrong;
  return `Wrong: face ${g} over face ${f} at ${many} samples${wrong.length > 1
    ? `, and ${wrong.length - 1} other pairs` : ""}`;
}

// Face -> how many samples it painted, in the order of painting.
function paintedFaces(run) {
  const many = new Map();
  for (const k of run.accepts) {
    const f = run.trace.a0[k];
    if (f >= 0) many.set(f, (many.get(f) ?? 0) + run.trace.width[k] *
      run.trace.height[k]);
  }
  return many;
}

// The pairs that both painted some sample, the first painted first: [{ two, many,
// wrong }], how many these are, and how many of them are wrong in the end.
function pairsOf(run) {
  const { trace, width: m } = run;
  const at = new Map(), pairs = new Map();
  const pairOf = (f, g) => {
    const key = `${f},${g}`;
    if (!pairs.has(key)) pairs.set(key, { two: [f, g], many: 0, wrong: 0 });
    return pairs.get(key);
  };
  for (const k of run.accepts)
    for (let x = trace.x[k]; x < trace.x[k] + trace.width[k]; x++) {
      const place = trace.y[k] * m + x, before = at.get(place) ?? [];
      for (const f of before) pairOf(f, trace.a0[k]).many += 1;
      at.set(place, [...before, trace.a0[k]]);
    }
  const { deep } = depths(run);
  for (const place of wrongSamples(run).keys()) {
    const [x, y] = [place % m + 0.5, Math.floor(place / m) + 0.5];
    const faces = at.get(place), last = faces.at(-1);
    const nearest = faces.reduce((f, g) => deep(g, x, y) < deep(f, x, y) ? g : f);
    pairOf(nearest, last).wrong += 1;
  }
  return [...pairs.values()].sort((p, q) => q.wrong - p.wrong || q.many - p.many);
}

// --- The z-buffer: what is kept at a sample ---

const MOST_TESTS = 10; // of all samples that are shown

export function keptDepths(run) {
  const { deep } = depths(run);
  const shown = [];
  let slots = 0;
  for (const sample of samplesByWrites(run)) {
    if (shown.length === 3 || (shown.length && slots + sample.tests.length > MOST_TESTS))
      break;
    const tests = sample.tests.slice(0, MOST_TESTS).map((t) => ({ ...t,
      depth: deep(t.face, sample.i + 0.5, sample.j + 0.5) }));
    if (tests.some(({ depth }) => depth === null)) continue;
    shown.push({ ...sample, left: sample.tests.length - tests.length, tests });
    slots += tests.length + 1;
  }
  if (!shown.length) return null;
  const all = shown.flatMap(({ tests }) => tests.map(({ depth }) => depth));
  const [low, high] = [Math.min(...all), Math.max(...all)];
  const py = (d) => 66 + (high > low ? (high - d) / (high - low) : 0.5) * 110;
  const unit = (WIDE - 20) / (slots + 0.2);
  let at = 16;
  const panels = shown.map((sample) => {
    const own = keptAt(run, sample, at, unit, py);
    at += (sample.tests.length + 1) * unit;
    return own;
  });
  return board(WIDE, 258, shown.map(({ i, j, tests }) => `Sample ${i}, ${j}: ${
    tests.map(({ face, isNearer, depth }) => `face ${face}, ${depth.toFixed(2)} deep, ${
      isNearer ? "kept" : "refused"}`).join("; ")}`).join(". "),
  text(8, 14, "Far", { ...left, fill: "var(--faint)" }), ...panels,
  text(8, 206, "Near", { ...left, fill: "var(--faint)" }));
}

function keptAt(run, { i, j, tests, left: more }, from, unit, py) {
  const px = (k) => from + (k + 0.6) * unit;
  const path = [], points = [];
  let kept = null;
  tests.forEach(({ face, isNearer, depth }, k) => {
    const x = px(k), y = py(depth);
    path.push(...isNearer ? [kept === null ? `M${round(x)} 24` : `H${round(x)}`,
      `V${round(y)}`] : []);
    kept = isNearer ? depth : kept;
    points.push(s("circle", { class: isNearer ? "kept" : "refused", "data-depth": depth,
      cx: round(x), cy: round(y), r: 5.5, fill: isNearer ? colourOf(run, face)
        : "var(--paper)", stroke: isNearer ? "var(--ink)" : WRONG, "stroke-width": 2 }),
    text(x + 9, y + (isNearer ? 17 : -9), depth.toFixed(2), { "font-size": 12 }),
    text(x, 226, face, { "font-size": 13 }));
  });
  const end = px(tests.length - 0.4);
  return s("g", { class: "sample" },
    s("path", { d: `${path.join("")}H${round(end)}`, fill: "none", stroke: RIGHT,
      "stroke-width": 2.5 }), points,
    text(from + 0.2 * unit, 226, "face", { fill: "var(--faint)" }),
    text((from + end) / 2, 248, `sample ${i}, ${j}${more ? `, and ${more} more` : ""}`,
      { "font-size": 12.5 }));
}

// The samples with their comparisons, one for each history: those that are written
// most often come first, then those with most comparisons.
function samplesByWrites(run) {
  const c = counterNamed(run, "depth tests");
  const { trace } = run, of = new Map();
  for (let k = 0; k < trace.kept; k++) {
    if (trace.counter[k] !== c) continue;
    const key = `${trace.x[k]},${trace.y[k]}`;
    if (!of.has(key)) of.set(key, { i: trace.x[k], j: trace.y[k], tests: [] });
    of.get(key).tests.push({ face: trace.a0[k],
      isNearer: run.event(k).outcome === "nearer" });
  }
  const histories = new Map();
  const writes = ({ tests }) => tests.filter((t) => t.isNearer).length;
  for (const sample of of.values()) {
    const key = sample.tests.map((t) => `${t.face}${t.isNearer}`).join();
    histories.set(key, [...histories.get(key) ?? [], sample]);
  }
  return [...histories.values()].map((all) => all[all.length >> 1])
    .sort((p, q) => writes(q) - writes(p) || q.tests.length - p.tests.length);
}

// --- Ray casting: one ray from the side ---

const MOST_HITS = 6;

export function raySide(run) {
  const ray = tellingRay(run);
  if (!ray) return null;
  const { i, j, hits } = ray, { deep, closeness } = depths(run);
  const asked = new Set(run.trace.a0);
  const segments = columnSegments(run, i).filter(({ face }) => asked.has(face));
  const found = hits.map((face) => ({ face, depth: deep(face, i + 0.5, j + 0.5),
    q: closeness(face)(i + 0.5, j + 0.5) }));
  const q = [...segments.flatMap(({ q0, q1 }) => [q0, q1]), ...found.map((x) => x.q)];
  const [low, high] = [Math.min(...q), Math.max(...q)];
  const px = (x) => 100 + (high > low ? (high - x) / (high - low) : 0.5) *
    (WIDE - 140);
  const rows = segments.flatMap(({ y0, y1 }) => [y0, y1]).concat(j - 4, j + 5);
  const [top, foot] = [Math.min(...rows), Math.max(...rows)];
  const py = (y) => 34 + (y - top) / (foot - top) * 136, y = py(j + 0.5);
  const nearest = found.reduce((p, x) => x.q > p.q ? x : p);
  const lanes = lanesOf(found, (x) => px(x.q));
  return board(WIDE, 200 + 18 * found.length, `Column ${i} from the side, and the ray ` +
    `of sample ${i}, ${j}: ${found.length} hits, the nearest is face ${nearest.face}`,
  segments.map((g) => line(px(g.q0), py(g.y0), px(g.q1), py(g.y1),
    { stroke: colourOf(run, g.face), "stroke-width": 4 })),
  line(14, y, px(nearest.q), y, { "stroke-width": 2 }),
  line(px(nearest.q), y, WIDE - 8, y, { "stroke-dasharray": "3 4" }),
  s("circle", { cx: 12, cy: round(y), r: 4, fill: "var(--ink)" }),
  text(8, y + 18, "to the eye", left),
  found.map((x, k) => {
    const isNearest = x === nearest;
    return [s("circle", { class: isNearest ? "hit nearest" : "hit", "data-q": x.q,
      cx: round(px(x.q)), cy: round(y), r: 4.5, fill: isNearest ? RIGHT
        : "var(--paper)", stroke: isNearest ? RIGHT : "var(--ink)", "stroke-width": 2 }),
    text(px(x.q), y - 10 - 14 * lanes.get(x), k + 1, { "font-size": 13,
      stroke: "var(--paper)", "stroke-width": 4, "paint-order": "stroke",
      "font-weight": isNearest ? "bold" : null }),
    text(8, 204 + 18 * k, `${k + 1}: face ${x.face}, ${x.depth.toFixed(2)} deep${
      isNearest ? ": the nearest, shown" : ""}`, { ...left, "font-size": 13,
      "font-weight": isNearest ? "bold" : null })];
  }));
}

// How far up the number of each stands, so that none lies over another.
function lanesOf(found, at) {
  const lanes = new Map();
  const sorted = found.slice().sort((p, q) => at(p) - at(q));
  sorted.forEach((x, k) => lanes.set(x, k && at(x) - at(sorted[k - 1]) < 12
    ? lanes.get(sorted[k - 1]) + 1 : 0));
  return lanes;
}

// A ray with most hits, of which not the first is the nearest: { i, j, hits }, in the
// order in which the run asked.
function tellingRay(run) {
  const { trace } = run, of = new Map();
  const c = counterNamed(run, "surround tests"), d = counterNamed(run, "depth tests");
  for (let k = 0; k < trace.kept; k++) {
    if (trace.counter[k] !== c && trace.counter[k] !== d) continue;
    const key = `${trace.x[k]},${trace.y[k]}`;
    if (!of.has(key)) of.set(key, { i: trace.x[k], j: trace.y[k], hits: [], late: 0 });
    const ray = of.get(key), { outcome } = run.event(k);
    if (trace.counter[k] === c && outcome === "surrounds") ray.hits.push(trace.a0[k]);
    if (trace.counter[k] === d && outcome === "nearer" && trace.b0[k] >= 0) ray.late += 1;
  }
  const rays = [...of.values()].filter(({ hits }) => hits.length &&
    hits.length <= MOST_HITS);
  const value = ({ hits, late }) => 10 * Math.min(late, 1) + hits.length;
  const most = Math.max(...rays.map(value));
  const best = rays.filter((ray) => value(ray) === most);
  return best[best.length >> 1] ?? null;
}
