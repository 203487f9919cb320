// SPDX-License-Identifier: GPL-3.0-or-later
// The survey's figures 12, 14, 25, 27 and 28, and those of Greene's pyramid, cubes
// and masks.
import { closeness, segmentsOn } from "../data/projection.js";
import { hasOutcome } from "../data/run.js";
import { h } from "../../page/parts/dom.js";
import { board, colourOf, ground, line, pathOf, round, s, section,
  text } from "./drawing.js";
import { eventsOf } from "./lists.js";

// --- 12 and 27: spans ---

// Where the spans of a row begin and end.
function spansOn(run, j) {
  const x = [];
  for (const k of run.accepts)
    if (run.trace.y[k] === j && run.trace.height[k] === 1)
      x.push(run.trace.x[k], run.trace.x[k] + run.trace.width[k]);
  return [...new Set(x)].sort((a, b) => a - b);
}

// The row on which the first run has most more spans than the second.
function tellingRow(runs) {
  let best = 0, most = -Infinity;
  for (let j = 0; j < runs[0].height; j++) {
    const n = runs.map((run) => spansOn(run, j).length);
    const value = (n[0] - (n[1] ?? 0)) * 100 + n[0];
    if (value > most) [best, most] = [j, value];
  }
  return best;
}

export function spans(runs) {
  const j = tellingRow(runs);
  const segments = segmentsOn(runs[0], j);
  const x = segments.flatMap(({ x0, x1 }) => [x0, x1]);
  const frame = { left: Math.max(0, Math.min(...x) - 3),
    right: Math.min(runs[0].width, Math.max(...x) + 3), width: 560, height: 170 };
  return board(560, 190 * runs.length, `The segments of row ${j} from above, and ` +
    `the spans of ${runs.map((run) => run.name).join(" and of ")}`,
  ...runs.map((run, k) => {
    const { px, drawn } = section(run, segments, frame);
    const cuts = spansOn(run, j);
    return s("g", { transform: `translate(0 ${190 * k})` },
      cuts.filter((c) => c >= frame.left && c <= frame.right).map((c) =>
        line(px(c), 4, px(c), 158, { "stroke-dasharray": "2 3",
          stroke: "var(--faint)" })), drawn,
      text(4, 174, `${"ab"[k]}. ${run.name}, row ${j}: ${cuts.length - 1} spans`,
        { "text-anchor": "start" }));
  }));
}

// --- 14: quantitative invisibility along an edge ---

export function alongAnEdge(run) {
  const of = new Map();
  for (const part of run.trace.answer)
    if (part[6] && part[7] && part[0][0] === run.trace.answer[0][0][0]) {
      const key = String(part[0]);
      of.set(key, [...of.get(key) ?? [], part]);
    }
  // The one of most changes, of which much is seen and much is hidden.
  const drawn = (list, isSeen) => list.filter((p) => (p[1] === 0) === isSeen)
    .reduce((sum, [, , , , , , [x, y], [u, v]]) => sum + Math.hypot(u - x, v - y), 0);
  const changes = (list) => list.length *
    Math.min(drawn(list, true), drawn(list, false));
  const parts = [...of.values()].reduce((a, b) => changes(b) > changes(a) ? b : a)
    .sort((a, b) => a[2] - b[2]);
  const unit = 250 / run.width;
  const at = ([x, y]) => [x * unit, y * unit];
  const colour = (n) => n ? "var(--hue-1)" : "var(--hue-2)";
  const most = Math.max(1, ...parts.map((p) => p[1]));
  const px = (t) => 300 + 230 * t, py = (n) => 200 - 130 * n / most;
  const edge = parts.map(([, n, , , , , from, to]) => line(...at(from), ...at(to),
    { stroke: colour(n), "stroke-width": 3.5,
      "stroke-dasharray": n ? "4 3" : null }));
  const steps = parts.map(([, n, t0, t1], k) => [
    line(px(t0), py(n), px(t1), py(n), { stroke: colour(n), "stroke-width": 3.5 }),
    k ? line(px(t0), py(parts[k - 1][1]), px(t0), py(n), { "stroke-width": 0.8 })
      : null, (t1 - t0) * 230 > 9 ? text(px((t0 + t1) / 2), py(n) - 7, n) : null]);
  return board(545, Math.max(250, unit * run.height), "An edge among the others, and " +
    "how many faces hide it along its length", ground(run, unit), ...edge,
  line(300, 200, 530, 200), line(300, 60, 300, 200), ...steps,
  text(292, 62, "λ", { "text-anchor": "end" }),
  text(415, 222, "from one end of the edge to the other"));
}

// --- 25: windows ---

export function windows(run) {
  const unit = 420 / run.width;
  const { x, y, width, height } = run.trace;
  const small = [], large = [];
  for (const k of run.accepts)
    (width[k] * height[k] === 1 ? small : large).push([x[k], y[k], width[k],
      height[k]]);
  const d = (list) => list.map(([i, j, w, t]) => `M${round(i * unit)} ${
    round(j * unit)}h${round(w * unit)}v${round(t * unit)}h${round(-w * unit)}Z`)
    .join("");
  return board(420, run.height * unit, `${large.length} windows and ${small.length
  } single samples`, ground(run, unit),
  s("path", { d: d(small), fill: "var(--hue-6)", "fill-opacity": 0.55 }),
  s("path", { d: d(large), fill: "none", stroke: "var(--hue-6)",
    "stroke-width": 0.8 }));
}

// --- 28: the logarithmic search ---

export function logarithmic(run) {
  const best = [...oneDivision(run)].reduce((x, y) =>
    !x || y.overlap > x.overlap ? y : x, null);
  if (!best) return null;
  const { two, divided, x, width, row } = best;
  const g = two[divided], other = two[1 - divided];
  const mid = (g.x0 + g.x1) / 2, zm = (g.z0 + g.z1) / 2;
  const halves = [{ ...g, x1: mid, z1: zm }, { ...g, x0: mid, z0: zm }];
  const { px, py, drawn } = section(run, two, { left: x - 1, right: x + width + 1,
    width: 260, height: 180 });
  const box = (q) => s("rect", { x: round(px(q.x0)), fill: "none",
    y: round(Math.min(py(q.z0), py(q.z1))), width: round(px(q.x1) - px(q.x0)),
    height: round(Math.abs(py(q.z0) - py(q.z1))), stroke: "var(--faint)",
    "stroke-dasharray": "2 3" });
  const names = () => [text(px(g.x0) - 2, py(g.z0) - 6, "A"),
    text(px(other.x1) + 2, py(other.z1) - 6, "B")];
  const again = () => drawn.map((parts) => parts.map((e) =>
    e?.cloneNode(true) ?? null));
  return board(560, 200, "Two segments whose depths overlap, and one of them divided " +
    "at its midpoint", ...again(), ...two.map(box), ...names(),
  text(130, 194, `a. row ${row}: the depths overlap`),
  s("g", { transform: "translate(290 0)" }, again(), [...halves, other].map(box),
    names(), line(px(mid), 6, px(mid), 168, { stroke: "var(--hue-6)",
      "stroke-dasharray": "4 3" }), text(130, 194, "b. A is divided")));
}

// First searches of a pair that one division decided, where their segments are.
function* oneDivision(run) {
  const near = closeness(run);
  const { counter, width } = run.trace;
  const search = run.counterOf("depth-search");
  const order = [search, run.counterOf("pair-divided"),
    run.counterOf("depth-division"), search];
  for (let k = 1; k + 3 < run.trace.kept; k++) {
    if (width[k] < 6 || order.some((c, p) => counter[k + p] !== c)) continue;
    const [e, next] = [run.event(k), run.event(k + 3)];
    const faces = [e.a.ids[0], e.b.ids[0]];
    if (hasOutcome(next, "undecided") || faces[0] < 0 || faces[1] < 0) continue;
    const { x, y } = e.window;
    const two = faces.map((f) => {
      const own = segmentsOn(run, y, near).find(({ face, x0, x1 }) =>
        face === f && x0 < x + width[k] && x1 > x);
      if (!own) return null;
      const [l, r] = [Math.max(own.x0, x), Math.min(own.x1, x + width[k])];
      return { face: f, x0: l, x1: r, z0: near(f)(l, y + 0.5),
        z1: near(f)(r, y + 0.5) };
    });
    if (!two[0] || !two[1]) continue;
    const range = two.map(({ z0, z1 }) => [Math.min(z0, z1), Math.max(z0, z1)]);
    const both = Math.min(range[0][1], range[1][1]) -
      Math.max(range[0][0], range[1][0]);
    const all = Math.max(range[0][1], range[1][1]) -
      Math.min(range[0][0], range[1][0]);
    yield { two, divided: faces.indexOf(run.event(k + 2).a.ids[0]), x, row: y,
      width: width[k], overlap: both / (all || 1) };
  }
}

// --- Greene: the pyramid, the cubes, the masks ---

export function pyramid(run) {
  const near = closeness(run);
  const { width: m, height: n } = run;
  const ids = run.painting.at(run.n);
  let level = Float64Array.from(ids, (f, k) => f < 0 ? 0
    : near(f)?.(k % m + 0.5, Math.floor(k / m) + 0.5) ?? 0);
  const some = level.filter((z) => z > 0);
  const low = some.reduce((a, b) => Math.min(a, b), Infinity);
  const high = some.reduce((a, b) => Math.max(a, b), 0);
  const canvases = [];
  for (let w = m, t = n; ; w = Math.ceil(w / 2), t = Math.ceil(t / 2)) {
    canvases.push(h("canvas", { width: w, height: t, role: "img",
      "aria-label": `Depths of ${w} × ${t} squares` }));
    const context = canvases.at(-1).getContext("2d");
    level.forEach((z, k) => {
      const grey = z ? Math.round(60 + 180 * (z - low) / (high - low || 1)) : 0;
      context.fillStyle = `rgb(${grey} ${grey} ${grey})`;
      context.fillRect(k % w, Math.floor(k / w), 1, 1);
    });
    if (w === 1 && t === 1) break;
    const [wide, tall] = [Math.ceil(w / 2), Math.ceil(t / 2)];
    const upper = new Float64Array(wide * tall).fill(Infinity);
    level.forEach((z, k) => {
      const up = Math.floor(Math.floor(k / w) / 2) * wide + Math.floor(k % w / 2);
      upper[up] = Math.min(upper[up], z);
    });
    level = upper;
  }
  return h("div", { class: "levels" }, canvases);
}

export function cubesVisited(run) {
  const unit = 420 / run.width;
  const drawn = { visible: [], hidden: [] };
  for (const { a, outcome } of eventsOf(run, "cube-tested"))
    drawn[outcome].push(run.cubes.get(`${a.ids[0]},${a.ids[1]}`));
  const wires = (cubes) => cubes.map((at) => [0, 1, 2, 3, 4, 5, 6, 7].map((c) =>
    [1, 2, 4].filter((bit) => !(c & bit)).map((bit) => at?.[c] && at[c | bit]
      ? pathOf([at[c], at[c | bit]].map(([x, y]) => [x * unit, y * unit]), true)
      : "").join("")).join("")).join("");
  return board(420, run.height * unit, `${drawn.visible.length} cubes visible, ${
    drawn.hidden.length} hidden`, ground(run, unit),
  s("path", { d: wires(drawn.visible), fill: "none", stroke: "var(--hue-2)",
    "stroke-width": 0.9 }),
  s("path", { d: wires(drawn.hidden), fill: "none", stroke: "var(--hue-1)",
    "stroke-width": 1.6 }));
}

// The cell of 8 × 8 samples in which a face covers some, and finds some covered.
export function masks(run) {
  const { trace } = run;
  const cells = [...eventsOf(run, "finest-cell")];
  const m = run.width;
  const written = new Int32Array(m * run.height).fill(-1); // by which event
  for (const k of run.accepts)
    for (let j = trace.y[k]; j < trace.y[k] + trace.height[k]; j++)
      for (let i = trace.x[k]; i < trace.x[k] + trace.width[k]; i++)
        written[j * m + i] = k;
  let best = null, most = 0;
  cells.forEach((e, c) => {
    const { x, y, width, height } = e.window;
    if (width !== 8 || height !== 8) return;
    const end = cells[c + 1]?.k ?? trace.kept;
    const state = Array.from({ length: 64 }, (_, s2) => {
      const k = written[(y + (s2 >> 3)) * m + x + s2 % 8];
      return k < e.k ? "before" : k < end && trace.a0[k] >= 0 ? "now" : "vacant";
    });
    const n = (what) => state.filter((q) => q === what).length;
    const value = Math.min(n("before"), n("now"), Math.max(1, n("vacant")));
    if (value > most) [best, most] = [{ e, state, face: faceNow(state, e) }, value];
  });
  function faceNow(state, e) {
    const s2 = state.indexOf("now");
    return trace.a0[written[(e.window.y + (s2 >> 3)) * m + e.window.x + s2 % 8]];
  }
  if (!best) return null;
  const { window: { x, y } } = best.e;
  const side = 28, looks = { before: "var(--line)", now: colourOf(run, best.face),
    vacant: "var(--paper)" };
  const grid = best.state.map((what, k) => s("rect", { x: k % 8 * side + 10,
    y: (k >> 3) * side + 10, width: side, height: side, fill: looks[what],
    stroke: "var(--faint)", "stroke-width": 0.6 }));
  const polygon = run.header.faces[best.face][4].map(([px, py]) =>
    [10 + (px - x) * side, 10 + (py - y) * side]);
  const key = [["before", "covered before: Cc"], ["now",
    "written now: W = Cv & Pc"], ["vacant", "still vacant"]].map(([what, words], k) => [
    s("rect", { x: 262, y: 40 + 26 * k, width: 16, height: 16, fill: looks[what],
      stroke: "var(--faint)" }),
    text(286, 53 + 26 * k, words, { "text-anchor": "start" })]);
  return board(470, 244, "A cell of 8 × 8 samples under a face’s mask",
    s("clipPath", { id: "cell" }, s("rect", { x: 10, y: 10, width: 8 * side,
      height: 8 * side })), ...grid,
    s("path", { d: pathOf(polygon), "clip-path": "url(#cell)", fill: "none",
      stroke: "var(--ink)", "stroke-width": 2 }), ...key,
    text(262, 150, `the cell at ${x}, ${y}; ${run.faceName(best.face)}`,
      { "text-anchor": "start" }));
}
