// SPDX-License-Identifier: GPL-3.0-or-later
// What the tests of a priority list ask about: the plane of a piece, the line that
// separates two images. And what stands at a piece that bears a marker.
import { hasOutcome } from "../data/run.js";
import { planeLook } from "./solids.js";

// Test 4 asks about the plane of Q, test 5 about that of P, test 6 about a line.
export function testLook(run, e) {
  const whose = hasOutcome(e, "both-planes") ? [e.a, e.b]
    : hasOutcome(e, "plane-of-divider") ? [e.b] : [planeAsked(e)].filter(Boolean);
  if (whose.length) return whose.flatMap((s) => planeLook(run, { face: s.ids[0] })
    .map((shape) => ({ ...shape, role: "ink", width: 1.2, dashed: s === e.b, fill: 0.06 })));
  const line = hasOutcome(e, "edge-between") ? separating(run, e) : null;
  return line ? [{ points: line.points, width: 2.5, dotted: true, role: "ink" }] : [];
}

// The subject whose plane decided the test, or null.
export const planeAsked = (e) => hasOutcome(e, "plane-of-q") ? e.b
  : hasOutcome(e, "plane-of-p") ? e.a : null;

// { points, of }: the line of an edge of P or Q ("P", "Q") that has the images on its two
// sides, drawn as far as these go; null: no edge's does.
export function separating(run, e) {
  const [p, q] = [e.a, e.b].map((s) => outlineOf(run, e, s));
  const found = edgeBetween(p, q), other = found ? null : edgeBetween(q, p);
  const [from, to] = found ?? other ?? [];
  if (!from) return null;
  const all = [...p, ...q], d = [to[0] - from[0], to[1] - from[1]];
  const shares = all.map(([x, y]) => ((x - from[0]) * d[0] + (y - from[1]) * d[1]) /
    (d[0] * d[0] + d[1] * d[1]));
  const at = (t) => [from[0] + t * d[0], from[1] + t * d[1]];
  return { points: [at(Math.min(...shares)), at(Math.max(...shares))],
    of: found ? "P" : "Q" };
}

const outlineOf = (run, e, { ids: [f, p] }) => run.outline(e.k, p, f) ??
  run.header.faces[f]?.[4] ?? [];

// The edge of p that has p on one side and q on the other.
function edgeBetween(p, q) {
  for (let k = 0; k < p.length; k++) {
    const from = p[k], to = p[(k + 1) % p.length];
    const length = Math.hypot(to[0] - from[0], to[1] - from[1]);
    if (length < 1e-6) continue;
    const side = ([x, y]) => ((to[0] - from[0]) * (y - from[1]) -
      (to[1] - from[1]) * (x - from[0])) / length;
    const [own, other] = [p.map(side), q.map(side)];
    const [low, high] = [Math.min, Math.max].map((of) => of(...own));
    if ((low > -NEAR && Math.max(...other) < NEAR) ||
        (high < NEAR && Math.min(...other) > -NEAR)) return [from, to];
  }
  return null;
}

const NEAR = 0.06; // samples: images are rounded

// A flag at each piece of the step that bears a marker. Halves bear none.
export function markerLooks(run, e) {
  if (!run.list?.ofPieces || e.kind === "split") return [];
  const of = [e.a, e.b].filter((s) => s.kind === "piece" && s.ids[0] >= 0);
  if (!of.length) return [];
  const { marked } = run.list.at(e.k + 1);
  return of.filter((s) => marked.has(s.ids[1])).map((s) => flagAt(run, outlineOf(run, e, s)));
}

const FLAG = 0.045; // of the picture's width

// The middle of what is seen of an outline, by the mean of its corners.
export function middleSeen(run, outline) {
  const inside = (x, most) => Math.min(most, Math.max(0, x));
  const points = outline.map(([x, y]) => [inside(x, run.width), inside(y, run.height)]);
  return [0, 1].map((c) => points.reduce((sum, p) => sum + p[c], 0) / (points.length || 1));
}

function flagAt(run, outline) {
  const [x, y] = middleSeen(run, outline);
  const s = FLAG * run.width;
  return { points: [[x, y], [x, y - 1.6 * s], [x + s, y - 1.2 * s], [x + 0.15 * s, y - 0.8 * s],
    [x + 0.15 * s, y]], closed: true, fill: 1, width: 1, role: "ink" };
}
