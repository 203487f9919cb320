// SPDX-License-Identifier: GPL-3.0-or-later
// What a step looks like over the picture: shapes in samples, which the canvas of
// the page and a saved drawing both take. A shape is { points, closed, dashed, dotted,
// width, fill, role }: `fill` is a strength from 0 to 1, `role` the colour: of the
// kind of step, or "ink".
import { boxLooks } from "./boxes.js";
import { clippedLook } from "./clipped.js";
import { faceLook, edgeLook, impliedLook, mergedLook, pieceLook, vertexLook } from "./faces.js";
import { cellLook, cubeLook, isRegion, openingLook, planeLook, rowLook, volumeLook }
  from "./solids.js";
import { testLook } from "./tests.js";
import { readLook } from "./texels.js";
import { bucketLook, halvedLook, windowLook } from "./windows.js";

const LOOKS = { face: faceLook, piece: pieceLook, edge: edgeLook,
  "implied edge": impliedLook, vertex: vertexLook, volume: volumeLook,
  cube: cubeLook, cell: cellLook };

// { a, b, where }: the shapes of both subjects, and of the place.
export function looksOf(run, e) {
  const isAccept = e.kind === "accept";
  const pieces = clippedLook(run, e);
  if (pieces) return pieces;
  const of = (s, isOther) => (LOOKS[s.kind]?.(run, e, s) ?? []).map((shape) =>
    ({ ...shape, dashed: isOther, ...(isAccept ? { fill: 0, width: 1.5 } : {}) }));
  return { a: of(e.a, false), b: of(e.b, true),
    where: [...windowLook(run, e), ...bucketLook(run, e), ...boxLooks(run, e),
      ...halves(run, e), ...partLook(run, e), ...nodeLook(run, e), ...testLook(run, e),
      ...halvedLook(run, e), ...openingLook(run, e), ...rowLook(run, e), ...mergedLook(run, e),
      ...readLook(run, e)] };
}

// The halves of a piece that is divided, and between them the line of the plane.
function halves(run, e) {
  if (e.kind !== "split" || e.a.kind !== "piece") return [];
  const two = run.children(e.k, e.a.ids[1]).filter(Boolean).map((points, k) =>
    ({ points, closed: true, width: 2.5, fill: k ? 0.15 : 0.5 }));
  const cut = run.cut(e.k, e.a.ids[1], e.a.ids[0]);
  return cut ? [...two, { points: cut, dashed: true, width: 2.5, role: "ink" }] : two;
}

// The plane of the node of a BSP tree at which the walk is.
export function nodeLook(run, e) {
  if (e.counter.key !== "piece" || !run.tree || !run.trace.structure.nodes) return [];
  const face = run.tree.nodes[run.tree.at(e.k + 1).now]?.face ?? -1;
  return face < 0 ? [] : planeLook(run, { face }).map((shape) => ({ ...shape,
    role: "ink", width: 1.2, dashed: true, fill: 0.08 }));
}

// What an accepted step adds to a line drawing.
function partLook(run, e) {
  const part = e.part && run.kind.partLine?.(e.part);
  return part ? [{ points: part.points, dashed: part.dashed, width: 3.5 }] : [];
}

// The subjects that a step names and that have no look, as "kind of subject": none,
// if the step is drawn. A subject that lies outside of the picture has none.
export function unseen(run, e) {
  const looks = looksOf(run, e);
  return ["a", "b"].filter((side) => {
    const s = e[side];
    return s.kind !== "nothing" && s.kind !== "window" && !isNowhere(run, s) &&
      !looks[side].length && !((/cell|cube/.test(s.kind)) && e.window);
  }).map((side) => e[side].kind);
}

// The background, an edge of no number, what lies outside of the picture.
function isNowhere(run, { kind, ids }) {
  const { faces, vertices } = run.header;
  if (kind === "face" || kind === "piece")
    return ids[0] < 0 || !faces[ids[0]]?.[4].length;
  if (kind === "vertex") return !vertices[ids[0]];
  if (kind === "edge")
    return ids[0] < 0 || !vertices[ids[0]] || !vertices[ids[1]];
  if (kind === "cube")
    return !run.cubes.get(`${ids[0]},${ids[1]}`)?.some(Boolean);
  if (kind === "cell") return isRegion(run, ids) && !run.regionOf(ids[0]).length;
  if (kind === "implied edge") return ids.slice(0, 2).every((f) =>
    !faces[f]?.[4].length);
  return false;
}
