// SPDX-License-Identifier: GPL-3.0-or-later
// The numbers that a step compares: depths, places on a row, boxes, distances of
// the eye to a plane. They are found again from the scene, in doubles.
import { fragmentAt } from "./fragments.js";
import { boxOf } from "../looks/boxes.js";
import { equationOf, planeOfCell } from "../looks/solids.js";
import { planeAsked, separating } from "../looks/tests.js";
import { closeness, projection } from "./projection.js";
import { hasOutcome } from "./run.js";
import { searchAt } from "./stretches.js";

const NEARER = new Set(["nearer", "in front"]);
const FARTHER = new Set(["farther", "behind"]);

// { words, a, b, less }: "4.31 deep against 5.02"; a and b are the numbers, where
// there are two, and `less` what the outcome says of them: true, a < b; false,
// a > b; null, nothing. null: the step compares no numbers that are known here.
export function numbersOf(run, e) {
  const found = FINDERS.map((find) => find(run, e)).find(Boolean);
  return found ?? null;
}

export function numberWords(run, e) {
  const found = numbersOf(run, e);
  return !found || contradicts(found) ? "" : found.words;
}

// Whether the numbers are not as the outcome says.
export const contradicts = ({ a, b, less, isOpen }) => isOpen ||
  (less !== null && less !== undefined &&
    (less ? a > b + tolerance(a, b) : a < b - tolerance(a, b)));
const tolerance = (a, b) => 1e-6 * Math.max(1, Math.abs(a), Math.abs(b));

// --- Words ---

// As many digits as tell two numbers apart.
export function told(...numbers) {
  const different = new Set(numbers.map((x) => x.toPrecision(9))).size;
  for (let digits = 2; digits < 7; digits++) {
    const words = numbers.map((x) => x.toFixed(digits));
    if (new Set(words).size === different || digits === 6) return words;
  }
}

function twoDepths(a, b, less = null) {
  const [p, q] = told(a, b);
  return { words: `${p} deep against ${q}`, a, b, less };
}

const lessOf = (outcome) => NEARER.has(outcome) ? true
  : FARTHER.has(outcome) ? false : null;

// --- Depths of faces ---

// (face, x, y) -> how deep the face's plane is there.
function depthsOf(run) {
  if (!run.depthAt) {
    const near = closeness(run), { parallel } = run.header.view;
    run.depthAt = (f, x, y) => {
      const c = f >= 0 && run.header.faces[f][3].length ? near(f)?.(x, y) : null;
      return c === null || c === undefined ? null : parallel ? -c : 1 / c;
    };
  }
  return run.depthAt;
}

// Whether all are depths of points before the eye: a plane beyond its horizon has none.
const isDeep = (run, depths) => depths.every((d) => d !== null &&
  (d > 0 || run.header.view.parallel));

const faceOf = ({ kind, ids }) => kind === "face" || kind === "piece" ? ids[0] : -1;

// At one sample, or at both ends of a stretch of a row.
function depthsInWindow(run, e) {
  const { window: w, outcome } = e;
  const [f, g] = [faceOf(e.a), faceOf(e.b)];
  if (!w || w.height !== 1 || f < 0 || g < 0 || e.kind === "accept" ||
      run.kind.windows !== "samples") return null;
  const at = depthsOf(run), y = w.y + 0.5;
  if (w.width === 1) {
    const [a, b] = [at(f, w.x + 0.5, y), at(g, w.x + 0.5, y)];
    return isDeep(run, [a, b]) ? twoDepths(a, b, lessOf(outcome)) : null;
  }
  const ends = [w.x + 0.5, w.x + w.width - 0.5];
  const [a, b] = [f, g].map((face) => ends.map((x) => at(face, x, y)));
  if (!isDeep(run, [...a, ...b])) return null;
  const [p, q, r, s] = told(...a, ...b);
  return { words: `${p} to ${q} deep against ${r} to ${s}`, less: null };
}

// Of the halves of two segments that a logarithmic search compares; a single sample
// that they do not decide is compared by itself.
function depthsOfStretches(run, e) {
  const found = e.window ? searchAt(run, e.k) : null;
  if (!found) return null;
  if (found.half) return { words: halfWords(run, e, found.half), less: null };
  const depth = (q) => run.header.view.parallel ? -q : 1 / q;
  const [f, g] = found.two.map(({ q0, q1 }) => [depth(q0), depth(q1)]);
  const ranges = [f, g].map((two) => [Math.min(...two), Math.max(...two)]);
  const isApart = ranges[0][1] < ranges[1][0] || ranges[1][1] < ranges[0][0];
  if (!isDeep(run, ranges.flat()) || (!isApart && e.window.width === 1 &&
    !hasOutcome(e, "undecided"))) return null;
  const [p, q, r, s] = told(...ranges.flat());
  const less = lessOf(e.outcome);
  return { words: `${p} to ${q} deep against ${r} to ${s}${priceWords(found)}`,
    a: less ? ranges[0][1] : ranges[0][0], b: less ? ranges[1][0] : ranges[1][1],
    less: less ?? null, isOpen: hasOutcome(e, "undecided") && isApart };
}

// Which half of a segment is kept, and why.
function halfWords(run, { b }, { which, middle, side, split }) {
  if (side === null) return `no half holds all columns: they are divided at ${
    split}`;
  const end = side === "left" ? "up to" : "from";
  return `${which ? `no half of it holds all columns; of ${run.faceName(b.ids[0])} ` : ""}` +
    `the ${side} half is kept, ${end} column ${middle}`;
}

// What the answer costs, where halves were needed.
const priceWords = ({ comparisons, divisions }) => divisions
  ? `; comparison number ${comparisons} of this pair` : "";

// Over a window of more rows: at its corner samples, or at the first of them.
function depthsInSquare(run, e) {
  const w = e.window, [f, g] = [faceOf(e.a), faceOf(e.b)];
  if (!w || w.height < 2 || f < 0 || g < 0 || e.kind !== "compare" ||
      e.a.kind === "piece" || run.kind.windows !== "samples") return null;
  const at = depthsOf(run);
  const corners = [[w.x, w.y], [w.x + w.width - 1, w.y], [w.x, w.y + w.height - 1],
    [w.x + w.width - 1, w.y + w.height - 1]];
  const both = corners.map(([i, j]) => [f, g].map((face) =>
    at(face, i + 0.5, j + 0.5)));
  if (!isDeep(run, both.flat())) return null;
  const range = (c) => [Math.min, Math.max].map((of) => of(...both.map((d) => d[c])));
  const [p, q, r, s] = told(...range(0), ...range(1));
  const less = lessOf(e.outcome);
  const [a, b] = both.sort(([a0, b0], [a1, b1]) => (less ? -1 : 1) *
    ((a0 - b0) - (a1 - b1)))[0];
  const found = { a, b, less, words: less === null
    ? `at the corners ${p} to ${q} deep against ${r} to ${s}`
    : `at the corner where that is closest ${twoDepths(a, b).words}` };
  if (!contradicts(found)) return found;
  // Of two surrounders, the one that is nearer at the first corner is critical.
  const first = twoDepths(...corners.slice(0, 1).flatMap(([i, j]) => [f, g].map((face) =>
    at(face, i + 0.5, j + 0.5))), less);
  return { ...first, words: `at the first corner ${first.words}` };
}

// The nearest and the farthest corner of a face or piece.
function reachOf(run, e, { kind, ids: [f, p] }) {
  const see = run.see ??= projection(run.header.view);
  if (f < 0) return null;
  const outline = kind === "piece" ? run.outline(e.k, p, f) : null;
  const at = depthsOf(run);
  const depths = outline ? outline.map(([x, y]) => at(f, x, y))
    : run.header.faces[f][3].map((v) => see(run.trace.points[v])?.[2] ?? null);
  return !depths.length || depths.includes(null) ? null
    : [Math.min(...depths), Math.max(...depths)];
}

// The painter's sorts go by farthest points; test 1 is of depths, too.
function farthest(run, e) {
  const { key } = e.counter;
  const isSort = key === "face-sort";
  if (!isSort && !(key === "list-test" && hasOutcome(e, "extents"))) return null;
  const [p, q] = [reachOf(run, e, e.a), reachOf(run, e, e.b)];
  if (!p || !q) return null;
  if (isSort) {
    const [a, b] = told(p[1], q[1]);
    const less = { "goes first": false, "goes later": true }[e.outcome] ?? null;
    return { words: `its farthest point ${a} deep against ${b}`, a: p[1], b: q[1],
      less };
  }
  const [a, b] = told(p[0], q[1]);
  return { words: `P begins ${a} deep, Q ends ${b} deep`, less: null };
}

// Tests 4 and 5: how far the corners of the one lie on their side of the plane of the
// other. Of a piece that was cut, the corners are not known.
function cornersAndPlane(run, e) {
  const whose = planeAsked(e);
  if (!whose) return null;
  const other = whose === e.a ? e.b : e.a;
  const [f, g] = [other.ids[0], whose.ids[0]];
  if (run.outline(e.k, other.ids[1], f) || run.header.view.parallel) return null;
  const { normal, offset } = equationOf(run, { face: g });
  const side = (p) => normal.reduce((sum, x, c) => sum + x * p[c], -offset);
  const eye = side(run.header.view.eye);
  // Positive on the side where they are said to be.
  const sign = (eye < 0 ? -1 : 1) * (whose === e.b ? -1 : 1);
  const far = run.header.faces[f][3].map((v) => sign * side(run.trace.points[v]));
  const [least, most] = [Math.min(...far), Math.max(...far)];
  const [p, q] = told(Math.max(0, least), most);
  return { words: `by ${p} to ${q} at its corners`, a: 0, b: least, less: true };
}

// Test 6: the line between the two images.
function lineBetween(run, e) {
  const line = hasOutcome(e, "edge-between") ? separating(run, e) : null;
  return line && { words: `the dotted line, along an edge of ${line.of}`, less: null };
}

// Test 6 on one row: from where to where each image is on it.
function placesOfImages(run, e) {
  if (e.counter.key !== "list-row") return null;
  const [p, q] = [e.a, e.b].map((s) => stretchesOn(imageOf(run, e, s), e.window.y + 0.5));
  const words = [p, q].every((of) => of.length)
    ? `columns ${p.join(", ")} against ${q.join(", ")}` : "one of them is not on this row";
  return { words, less: null };
}

const imageOf = (run, e, { ids: [f, p] }) => run.outline(e.k, p, f) ??
  run.header.faces[f][4];

function stretchesOn(outline, y) {
  const at = outline.map((p, k) => onRow([p, outline[(k + 1) % outline.length]], y, true))
    .filter((x) => x !== null).sort((a, b) => a - b);
  return at.slice(1).flatMap((x, k) => k % 2 ? [] : [reach(at[k], x)]);
}

// --- Edges ---

// The images of both ends, not rounded; null for one that is not in the picture.
const ends = (run, { ids }) => {
  const see = run.see ??= projection(run.header.view);
  return ids.slice(0, 2).map((v) => run.header.vertices[v]
    ? see(run.trace.points[v]) : null);
};

// Where an edge crosses a row. isWithin: only between its ends.
function onRow([from, to], y, isWithin = false) {
  if (!from || !to || from[1] === to[1]) return null;
  if (isWithin && (from[1] > y) === (to[1] > y)) return null;
  return from[0] + (to[0] - from[0]) * (y - from[1]) / (to[1] - from[1]);
}

function placesOnRow(run, e) {
  const w = e.window;
  if (e.a.kind !== "edge" || e.b.kind !== "edge" || w?.height !== 1) return null;
  const [a, b] = [e.a, e.b].map((s) => onRow(ends(run, s), w.y + 0.5));
  if (a === null || b === null || Math.abs(a - b) < 1e-9) return null;
  const [p, q] = told(a, b);
  return { words: `column ${p} against ${q}`, less: null };
}

// Where the images of two edges cross, how deep each is.
function crossing(run, e) {
  if (e.a.kind !== "edge" || e.b.kind !== "edge" || e.window ||
      lessOf(e.outcome) === null) return null;
  const [[a, b], [c, d]] = [ends(run, e.a), ends(run, e.b)];
  if (!a || !b || !c || !d) return null;
  const r = [b[0] - a[0], b[1] - a[1]], s = [d[0] - c[0], d[1] - c[1]];
  const det = r[0] * s[1] - r[1] * s[0];
  if (Math.abs(det) < 1e-9) return null;
  const [x, y] = [c[0] - a[0], c[1] - a[1]];
  const [t, u] = [(x * s[1] - y * s[0]) / det, (x * r[1] - y * r[0]) / det];
  const [p, q] = [depthOn(run, e.a, t), depthOn(run, e.b, u)];
  // The outcome is about the other edge.
  return p && q ? { ...twoDepths(q, p, lessOf(e.outcome)) } : null;
}

// How deep an edge is, at a share t of its image.
function depthOn(run, { ids: [p, q] }, t) {
  const see = run.see ??= projection(run.header.view);
  const [a, b] = [p, q].map((v) => see(run.trace.points[v])?.[2]);
  if (!a || !b) return null;
  return run.header.view.parallel ? a + t * (b - a)
    : 1 / (1 / a + t * (1 / b - 1 / a));
}

// A vertex and the plane of a face before or behind it.
function vertexAndFace(run, e) {
  if (e.a.kind !== "vertex" || e.b.kind !== "face") return null;
  const see = run.see ??= projection(run.header.view);
  const at = see(run.trace.points[e.a.ids[0]] ?? run.header.view.eye);
  const plane = at && depthsOf(run)(e.b.ids[0], at[0], at[1]);
  if (!plane || plane < 0) return null;
  const [p, q] = told(at[2], plane);
  return { words: `the vertex ${p} deep, the plane ${q}`, a: plane, b: at[2],
    less: e.outcome === "hides" ? true : null };
}

// --- The eye and a plane ---

function eyeAndPlane(run, e) {
  const { key } = e.counter;
  const plane = key === "back-face-cull" ? { face: e.a.ids[0] }
    : key === "inter-cluster" ? planeOfCell(run, e.number, e.b.ids[0]) : null;
  if (!plane || (plane.face !== undefined && !run.header.faces[plane.face][3].length))
    return null;
  const { normal, offset } = equationOf(run, plane);
  const side = normal.reduce((sum, x, k) => sum + x * run.header.view.eye[k], -offset);
  if (run.header.view.parallel) return null;
  // A face is looked at from either of its sides: the step does not say from which.
  if (key === "back-face-cull") return { words: `the eye is ${told(Math.abs(side))[0]} ${
    hasOutcome(e, "front") ? "before" : "behind"} this side of its plane`, less: null };
  const word = side < 0 ? "behind its plane" : "before its plane";
  return { words: `the eye is ${told(Math.abs(side))[0]} ${word}`, a: 0, b: side,
    less: { "in front": true, behind: false }[e.outcome] ?? null };
}

// --- Boxes ---

const reach = (low, high) => `${low.toFixed(1)} to ${high.toFixed(1)}`;

function boxes(run, e) {
  if (!hasOutcome(e, "boxes") && !hasOutcome(e, "extents")) return null;
  const [p, q] = [boxOf(run, e, e.a), boxOf(run, e, e.b)];
  if (!p || !q) return null;
  const inX = /in X/.test(e.outcome) || p.x1 < q.x0 || q.x1 < p.x0;
  if (inX && !/in Y/.test(e.outcome))
    return { words: `columns ${reach(p.x0, p.x1)} against ${reach(q.x0, q.x1)}`,
      less: null };
  const inY = /in Y/.test(e.outcome) || p.y1 < q.y0 || q.y1 < p.y0;
  return inY ? { words: `rows ${reach(p.y0, p.y1)} against ${reach(q.y0, q.y1)}`,
    less: null } : null;
}

// --- Edges and volumes ---

// The share of the fragment that the volume hides, from the edge's first end on.
function hiddenPart(run, e) {
  const at = e.counter.key === "edge-volume" ? fragmentAt(run, e.k) : null;
  if (!at?.hidden) return null;
  const fragment = at.from < 0.005 && at.to > 0.995 ? ""
    : `; the fragment is ${shareWords(at.from, at.to)}`;
  return { words: `it hides ${shareWords(...at.hidden)} of the edge${fragment}`, less: null };
}

// "all", "the first 55 %", "what lies between 25 % and 70 %".
function shareWords(from, to) {
  const [p, q] = [from, to].map((t) => Math.round(100 * Math.min(1, Math.max(0, t))));
  if (!p && q === 100) return "all";
  return !p ? `the first ${q} %` : q === 100 ? `the last ${100 - p} %`
    : `what lies between ${p} % and ${q} %`;
}

// --- The pyramid ---

// What a cell of the pyramid holds: the farthest depth painted in it so far.
function cellDepth(run, e) {
  if (!/-read$/.test(e.counter.key ?? "") || !e.window || !run.kind.holdsFaces)
    return null;
  const ids = run.painting.at(e.k), at = depthsOf(run), w = e.window;
  let most = 0;
  for (let j = Math.max(0, w.y); j < Math.min(run.height, w.y + w.height); j++)
    for (let i = Math.max(0, w.x); i < Math.min(run.width, w.x + w.width); i++) {
      const f = ids[j * run.width + i];
      const depth = f >= 0 ? at(f, i + 0.5, j + 0.5) : null;
      if (depth === null) return { words: "the entry is still infinitely deep",
        less: null };
      most = Math.max(most, depth);
    }
  return { words: `the entry is ${told(most)[0]} deep`, less: null };
}

const FINDERS = [farthest, cornersAndPlane, lineBetween, placesOfImages, hiddenPart, cellDepth,
  depthsOfStretches, depthsInWindow, depthsInSquare, placesOnRow, crossing, vertexAndFace, eyeAndPlane, boxes];
