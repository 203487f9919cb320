// SPDX-License-Identifier: GPL-3.0-or-later
// Figures that put a few steps of a run beside one another, as they are marked in the
// picture: the results of the edge/volume test, how a face lies to a window (26), where
// an edge is hidden (10), and the pieces of a walk through a tree.
import { looksOf } from "../looks/all.js";
import { eventBy } from "../telling/moments.js";
import { board, colourOf, ground, line, middle, pathOf, round, s, text }
  from "./drawing.js";
import { eventsOf } from "./lists.js";

const SIDE = 180, GAP = 14, WORDS = 22;

// Small pictures of steps, [event, words] each, so many in a row. Each shows what is
// around its shapes.
function steps(run, all, label, across = 2) {
  const rows = Math.ceil(all.length / across);
  return board(across * (SIDE + GAP) - GAP, rows * (SIDE + WORDS + 8), label,
    all.map(([e, words, more], k) => s("g", { transform: `translate(${
      k % across * (SIDE + GAP)} ${Math.floor(k / across) * (SIDE + WORDS + 8)})` },
    small(run, e, k, more), text(SIDE / 2, SIDE + 15, words, { "font-size": 13 }))));
}

function small(run, e, k, more) {
  const { a, b, where } = looksOf(run, e);
  const shapes = [...b, ...a, ...where.filter(({ fill }) => !fill)];
  const at = fitted(shapes.flatMap(({ points }) => points), run);
  const clip = `small-${run.name}-${e.k}-${k}`;
  return [s("clipPath", { id: clip }, s("rect", { width: SIDE, height: SIDE })),
    s("g", { "clip-path": `url(#${clip})` }, ground(run, at.unit, at),
      shapes.map((shape) => drawn(shape, at)), more?.(at) ?? null),
    s("rect", { width: SIDE, height: SIDE, fill: "none", stroke: "var(--line)" })];
}

// Where points lie in a square that holds all of them, as far as they are in the picture.
function fitted(points, run) {
  const range = [0, 1].map((c) => {
    const most = c ? run.height : run.width;
    const own = points.map((p) => Math.min(most, Math.max(0, p[c])));
    return [Math.min(...own), Math.max(...own)];
  });
  const size = Math.max(8, ...range.map(([low, high]) => high - low)) * 1.3;
  const unit = SIDE / size;
  const from = range.map(([low, high]) => (low + high - size) / 2);
  return Object.assign((p) => from.map((low, c) => (p[c] - low) * unit), { unit });
}

function drawn({ points, closed, width, fill, dashed, dotted, role }, at) {
  const own = role === "ink" ? "var(--ink)" : "var(--hue-0)";
  return s("path", { d: pathOf(points.map(at), !closed), stroke: width ? own : "none",
    "stroke-width": width, "stroke-dasharray": dotted ? "2 4" : dashed ? "6 4" : null,
    fill: fill ? own : "none", "fill-opacity": fill });
}

// --- The four results of the edge/volume test ---

export function fourResults(run) {
  const results = [["hidden whole", "hidden whole"], ["untouched", "untouched"],
    ["one piece left", "one piece left"], ["two pieces left", "two pieces left"]];
  const found = results.map(([outcome, words]) => [eventBy(run, { of: "edge-volume",
    outcome, pick: "largest" }), words]).filter(([k]) => k !== null);
  return found.length < 2 ? null : steps(run, found.map(([k, words]) =>
    [run.event(k), words]), "An edge and a volume: what the volume leaves of it");
}

// --- 26: a face and a window ---

export function faceAndWindow(run) {
  const isLarge = (_, { window: w }) => w && w.width >= run.width / 16 &&
    w.width < run.width;
  const found = [["surrounder", "surrounds the window"],
    ["intersecter", "intersects it"], ["disjoint", "is disjoint from it"]]
    .map(([outcome, words]) => [eventBy(run, { of: "window-test", outcome,
      pick: "largest", where: isLarge }), words]).filter(([k]) => k !== null);
  return found.length < 2 ? null : steps(run, found.map(([k, words]) =>
    [run.event(k), words]), "How a face lies to a window", 3);
}

// --- 10: where an edge is hidden ---

export function appearances(run) {
  const changes = changesOf(run);
  const kinds = { farther: null, disappears: null, appears: null };
  for (const e of eventsOf(run, "plane-intersection")) {
    const at = crossingOf(run, e);
    if (!at || isShort(run, e.a) || isShort(run, e.b)) continue;
    const kind = e.outcome === "farther" ? "farther" : e.outcome === "nearer"
      ? changes(e.a, at) : null;
    if (kind && !kinds[kind]) kinds[kind] = [e, at];
  }
  const words = { farther: "the other edge is farther", disappears: "it disappears here",
    appears: "it appears here" };
  const found = Object.entries(kinds).filter(([, x]) => x);
  return found.length < 2 ? null : steps(run, found.map(([kind, [e, at]]) => [e,
    words[kind], (place) => named(run, e, at, place)]),
  "Two edges whose images cross, three times", 3);
}

const ends = (run, { ids }) => ids.slice(0, 2).map((v) => run.header.vertices[v]);

function isShort(run, edge) {
  const [p, q] = ends(run, edge);
  return Math.hypot(p[0] - q[0], p[1] - q[1]) < run.width / 12;
}

// Where the images of both edges cross; null: nowhere.
function crossingOf(run, { a, b }) {
  const [[p, q], [r, t]] = [ends(run, a), ends(run, b)];
  if (![p, q, r, t].every(Boolean)) return null;
  const [d, e] = [[q[0] - p[0], q[1] - p[1]], [t[0] - r[0], t[1] - r[1]]];
  const det = d[0] * e[1] - d[1] * e[0];
  if (Math.abs(det) < 1e-6) return null;
  const share = ((r[0] - p[0]) * e[1] - (r[1] - p[1]) * e[0]) / det;
  return share <= 0 || share >= 1 ? null : p.map((x, c) => x + share * d[c]);
}

const keyOf = ([p, q]) => `${Math.min(p, q)},${Math.max(p, q)}`;

// (edge, place) -> "disappears" or "appears", if it does there.
function changesOf(run) {
  const of = new Map();
  for (const part of run.trace.answer) {
    const key = keyOf(part[0].slice(1));
    of.set(key, [...of.get(key) ?? [], part]);
  }
  return ({ ids }, at) => {
    const parts = [...of.get(keyOf(ids)) ?? []].sort((x, y) => x[2] - y[2]);
    for (let k = 1; k < parts.length; k++) {
      const [x, y] = parts[k][6] ?? [];
      if (x === undefined || Math.hypot(x - at[0], y - at[1]) > 0.5) continue;
      return parts[k][1] > parts[k - 1][1] ? "disappears" : "appears";
    }
    return null;
  };
}

function named(run, e, at, place) {
  const [x, y] = place(at);
  const names = [...ends(run, e.a).map((p, k) => [p, "AB"[k]]),
    ...ends(run, e.b).map((p, k) => [p, "CD"[k]])];
  return [s("circle", { cx: round(x), cy: round(y), r: 3.5, fill: "var(--ink)" }),
    text(x + 8, y - 6, "I"), names.map(([p, name]) => text(place(p)[0] + 7,
      place(p)[1] - 5, name))];
}

// --- The pieces of a tree in their order ---

export function walk(run) {
  const unit = 380 / run.width;
  const pieces = [...eventsOf(run, "piece")].map((e) => ({ face: e.a.ids[0],
    at: (run.outline(e.k, e.a.ids[1], e.a.ids[0]) ?? run.header.faces[e.a.ids[0]][4])
      .map(([x, y]) => [x * unit, y * unit]) })).filter(({ at }) => at.length > 2);
  return board(380, run.height * unit, `${pieces.length} pieces in the order of the walk`,
    ...pieces.map(({ face, at }) => s("path", { d: pathOf(at), fill: colourOf(run, face),
      "fill-opacity": 0.75, stroke: "var(--ink)", "stroke-width": 1.2 })),
    ...pieces.map(({ at }, k) => {
      const [x, y] = middle(at);
      return [s("circle", { cx: round(x), cy: round(y), r: 11, fill: "var(--paper)",
        stroke: "var(--ink)" }), text(x, y + 4.5, k + 1, { "font-size": 13 })];
    }));
}

// --- Lines that repeat ---

// Where the faces of a row begin and end, from the left.
const ticksOf = (segments) => segments.flatMap(({ face, x0, x1 }) =>
  [{ x: x0, of: `${face} l` }, { x: x1, of: `${face} r` }])
  .sort((p, q) => p.x - q.x || (p.of < q.of ? -1 : 1));

const isSameOrder = (p, q) => p.length === q.length &&
  p.every((tick, k) => tick.of === q[k].of);

// segmentsOn(j): those of a row. Two pairs of rows: the ends of one are in the same
// order; in the other two of them have changed places.
export function repeatedLine(run, segmentsOn) {
  const reused = [...eventsOf(run, "line-reused")].map((e) => e.window.y);
  const rows = (j) => [j - 1, j].map((row) => ticksOf(segmentsOn(row)));
  const same = reused.map((j) => [j, rows(j)]).filter(([, [p, q]]) => isSameOrder(p, q))
    .sort(([, [p]], [, [q]]) => q.length - p.length)[0];
  const others = Array.from({ length: run.height - 1 }, (_, k) => k + 1)
    .filter((j) => !reused.includes(j)).map((j) => [j, rows(j)])
    .filter(([, [p, q]]) => p.length === q.length && !isSameOrder(p, q) &&
      new Set([...p, ...q].map((t) => t.of)).size === p.length);
  const other = others.sort(([, x], [, y]) => crossings(y) - crossings(x))[0];
  if (!same) return null;
  const pairs = [[same, "the same order: nothing is compared"],
    ...(other ? [[other, "ends have changed places: the nearest is searched"]] : [])];
  return board(560, 120 * pairs.length, "The ends of the faces on two neighboring rows",
    pairs.map(([[j, two], words], k) => s("g", { transform: `translate(0 ${120 * k})` },
      twoRows(run, j, two), text(4, 112, `${"ab"[k]}. rows ${j - 1} and ${j}: ${words}`,
        { "text-anchor": "start" }))));
}

// How far the ends that have changed places are apart.
function crossings([p, q]) {
  return p.reduce((sum, { of, x }, k) => sum + (q[k].of === of ? 0 : 1 +
    Math.abs(x - q.find((t) => t.of === of).x)), 0);
}

function twoRows(run, j, two) {
  const all = two.flat().map(({ x }) => x);
  const [low, high] = [Math.max(0, Math.min(...all) - 2), Math.max(...all) + 2];
  const px = (x) => (x - low) / (high - low) * 560;
  const [top, foot] = [22, 78];
  const ids = run.painting.at(run.n);
  const seen = [j - 1, j].flatMap((row, k) => Array.from({ length: run.width }, (_, i) => {
    const f = ids[row * run.width + i];
    return i < low || i > high ? null : s("rect", { x: round(px(i)), y: k ? foot : top - 12,
      width: round(px(i + 1) - px(i)), height: 12, fill: colourOf(run, f) });
  }));
  return [...seen, ...two[0].map(({ x, of }) => {
    const to = two[1].find((t) => t.of === of);
    return to ? line(px(x), top, px(to.x), foot, { "stroke-width": 1.2 }) : null;
  })];
}
