// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces that are cut by clip polygons, as the run has them when a step is about them:
// all earlier cuts are in their shapes.
import { hasOutcome } from "../data/run.js";

// What a step with a shape looks like: { a, b, where }; null: it has none.
export function clippedLook(run, e) {
  const own = e.shape ?? (e.kind === "accept" && run.kind.hasShapes ? e.part : null);
  if (!own) return null;
  const clip = e.b.kind === "face" ? shapeOfClip(run, e.k) : null;
  const fill = e.kind === "accept" ? 0 : hasOutcome(e, "cut-piece") ? 0.55 : 0.22;
  return { a: shapesOf(own, { fill, width: e.kind === "accept" ? 2.5 : 2 }),
    b: clip ? shapesOf(clip, { fill: 0.2, width: 2, dashed: true }) : [],
    where: whereLook(run, e, own, clip) };
}

// The boxes that are compared; what is behind, of a piece that is divided; the
// polygons of a new list.
function whereLook(run, e, own, clip) {
  if (hasOutcome(e, "boxes")) return [own, clip].filter(Boolean).map((shape, k) =>
    ({ points: boxAround(shape), closed: true, width: 1.2, role: "ink", dashed: k === 1 }));
  return (isCut(e) ? partsBehind(run, e.k) : e.kind === "subdivide" ? listOf(run, e.k)
    : []).flatMap((shape) => shapesOf(shape, { fill: 0.55, width: 1.2 }));
}

function boxAround([, [outer]]) {
  const [x, y] = [3, 4].map((c) => outer.map((side) => side[c]));
  const [left, right] = [Math.min(...x), Math.max(...x)];
  const [top, bottom] = [Math.min(...y), Math.max(...y)];
  return [[left, top], [right, top], [right, bottom], [left, bottom]];
}

const isCut = ({ counter: { key } }) => key === "plane-division";

// A shape is filled at once, with its holes; each of its cycles is a line.
function shapesOf([, cycles], { fill, ...look }) {
  const points = cycles.map((sides) => sides.map(([, , , x, y]) => [x, y]));
  return [{ points: bridged(points), closed: true, width: 0, fill, dashed: look.dashed },
    ...points.map((cycle) => ({ points: cycle, closed: true, ...look }))];
}

// The outer cycle, and from its first corner a way to each hole, around it and back.
// Holes run the other way round, so that they stay empty.
const bridged = ([outer, ...holes]) => [...outer, ...holes.flatMap((hole) =>
  [outer[0], ...hole, hole[0]]), ...(holes.length ? [outer[0]] : [])];

const keyAt = ({ trace, header }, k) => header.counters[trace.counter[k]].key;

// The clip polygon at hand.
function shapeOfClip(run, k) {
  for (let c = k; c >= 0; c--)
    if (keyAt(run, c) === "clip-polygon") return run.event(c).shape;
  return null;
}

// What is thrown away of a piece that is divided where two planes meet.
function partsBehind(run, k) {
  const parts = [];
  for (let c = k + 1; c < run.trace.kept && keyAt(run, c) === "piece-culled"; c++)
    parts.push(run.event(c).shape);
  return parts;
}

// The polygons of a list that is begun, but for its last one: the first of them is the
// next clip polygon, against which the others are examined.
function listOf(run, k) {
  const list = [];
  for (let c = k + 1; c < run.trace.kept; c++) {
    const key = keyAt(run, c), isClip = key === "clip-polygon";
    if (isClip || key === "examination") list.push(run.event(c).shape);
    if (key === "inside-list" || key === "piece-shown" || (isClip && list.length > 1)) break;
  }
  return list.filter(Boolean).slice(0, -1);
}

// --- Areas ---

// The area of a shape, in samples.
export const areaOf = ([, cycles]) => Math.abs(cycles.reduce((sum, sides) => sum +
  sides.reduce((turn, [, , , x, y], k) => {
    const [, , , u, v] = sides[(k + 1) % sides.length];
    return turn + x * v - u * y;
  }, 0), 0)) / 2;
