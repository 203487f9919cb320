// SPDX-License-Identifier: GPL-3.0-or-later
// The looks of volumes, of cubes and boxes, of planes, and of cells.
import { cellsOfRow, cornersOf, partOfRow, rowAcross } from "../data/grids.js";
import { squareOfCell } from "../data/own_words.js";
import { projection } from "../data/projection.js";
import { hasOutcome, windowOf } from "../data/run.js";
import { isPart, partOf } from "../data/volumes.js";
import { faceShapes } from "./faces.js";
import { texelLook } from "./texels.js";

// Whether the step is about whole bodies: its volumes are numbers of these.
export const isOfBody = (e) => hasOutcome(e, "body");

// The faces of a volume; of a body, where the step is about bodies. null: they are
// not known.
export function facesOfVolume(run, e, v) {
  const { bodies, volumes } = run.trace.structure;
  return (isOfBody(e) ? bodies : volumes)?.[v] ?? null;
}

export function volumeLook(run, e, { ids: [v] }) {
  const part = !isOfBody(e) && isPart(run, v) ? partShapes(run, v) : [];
  if (part.length) return part;
  const faces = facesOfVolume(run, e, v) ?? [];
  return faces.flatMap((f) => faceShapes(run, f, 0.1, 1.4));
}

// The sides of a part of a divided solid, also those that no face bounds.
const partShapes = (run, v) => partOf(run, v).filter((points) => points.length > 2)
  .map((points) => ({ points, closed: true, fill: 0.1, width: 1.4 }));

// Of an opening, the cell beyond it.
export function cubeLook(run, e, { ids: [node, instance] }) {
  const own = run.openings.has(`${node},${instance}`) ? -1 : instance;
  return wires(run.cubes.get(`${node},${own}`) ?? []);
}

// The part of the order of a grid that a row begins in, dashed, and the row; where both
// sides of the eye take turns, the row before it, dotted.
export function rowLook(run, e) {
  const [part, row] = [partOfRow(run, e), cellsOfRow(run, e)];
  const before = rowAcross(run, e);
  return [...boxAhead(run, part, { width: 2, role: "ink", dashed: true }),
    ...boxAhead(run, before && cellsOfRow(run, before), { width: 2.5, dotted: true }),
    ...boxAhead(run, row, { width: 2.5 })];
}

// The edges of a box of cells, as far as they lie before the eye.
function boxAhead(run, cells, look) {
  if (!cells) return [];
  const corners = cornersOf(run, cells);
  return edgesOfBox.map(([c, d]) => imageOf(run, [corners[c], corners[d]]).slice(0, 2))
    .filter((points) => points.length === 2).map((points) => ({ points, ...look }));
}

// The opening between two cells, and the cull box of the first one, thin.
export function openingLook(run, e) {
  const { kind, ids: [node, k] } = e.b;
  const points = kind === "cube" ? run.openings.get(`${node},${k}`) ?? [] : [];
  return points.length < 3 ? [] : [{ points, closed: true, width: 3.5, fill: 0.4 },
    ...cullBoxLook(run, e)];
}

// The window through which the cell is looked at: that of its last visit.
function cullBoxLook(run, { k, a: { ids: [cell] } }) {
  const { trace, header } = run;
  for (let c = k - 1; c >= 0; c--) {
    if (header.counters[trace.counter[c]].b !== "window" || trace.a0[c] !== cell) continue;
    const { x, y, width, height } = windowOf(trace, c) ?? { width: 0 };
    return width ? [{ closed: true, width: 1.2, role: "ink", points: [[x, y],
      [x + width, y], [x + width, y + height], [x, y + height]] }] : [];
  }
  return [];
}

// Of the corners of a box, the pairs with an edge between them.
const edgesOfBox = [0, 1, 2, 3, 4, 5, 6, 7].flatMap((c) => [c | 1, c | 2, c | 4]
  .filter((d) => d !== c).map((d) => [c, d]));

// The edges of a box, by the images of its corners.
const wires = (corners) => edgesOfBox.filter(([c, d]) => corners[c] && corners[d])
  .map(([c, d]) => ({ points: [corners[c], corners[d]], width: 2 }));

// A cell is a node of a tree of planes, or a square of a pyramid.
export function cellLook(run, e, { ids: [p, q, r] }) {
  const corners = run.kind.cornersOfCell?.(run, [p, q]);
  if (corners) return wires(corners);
  if (isRegion(run, [p, q])) return run.regionOf(p).map((points) => ({ points, closed: true, width: 0,
    fill: 0.45 }));
  const plane = planeOfCell(run, e.number, p);
  if (plane) return planeLook(run, plane);
  const square = squareOfCell(run, [p, q, r]);
  if (square) return squareLook(square);
  const texel = texelLook(run, p, q, r);
  if (texel) return texel;
  const level = run.pyramid?.of(e.number)
    ? run.pyramid.levels[run.pyramid.placeOf(p)] : null;
  if (level) {
    const [x, y, s] = [q * level.size, r * level.size, level.size];
    return [{ points: [[x, y], [x + s, y], [x + s, y + s], [x, y + s]], closed: true,
      width: 1.5, fill: 0.15 }];
  }
  return [];
}

// Whether a cell is a region of a visibility map, not a node of a tree of planes.
export const isRegion = (run, [, q]) => Boolean(run.regionOf) && q === 0;

const squareLook = ({ x, y, side }) => [{ closed: true, width: 2, fill: 0.3,
  points: [[x, y], [x + side, y], [x + side, y + side], [x, y + side]] }];

// The plane of a node: of a tree between clusters, or of a BSP tree.
export function planeOfCell(run, counter, node) {
  const { separators, nodes } = run.trace.structure;
  const isNode = run.header.counters[counter].key === "inter-cluster";
  if (separators && isNode) {
    const [face, axis, at] = separators[node] ?? [];
    return face === undefined ? null : face === null ? { axis, at } : { face };
  }
  return nodes && !separators && nodes[node] && !run.cubes.size &&
    !run.pyramid ? { face: nodes[node][0] } : null;
}

// --- A plane, as far as the scene goes ---

export function planeLook(run, plane) {
  const cut = imageOf(run, planeInBox(run, equationOf(run, plane)));
  return cut.length > 2 ? [{ points: cut, closed: true, fill: 0.3, width: 2 }] : [];
}

// normal . x = offset.
export function equationOf(run, { face, axis, at }) {
  if (face === undefined) return { normal: [0, 1, 2].map((k) => k === axis ? 1 : 0),
    offset: at };
  const [a, b, c] = threeCorners(run.header.faces[face][3].map((v) =>
    run.trace.points[v]));
  const normal = cross(minus(b, a), minus(c, a));
  const length = Math.hypot(...normal) || 1;
  return { normal: normal.map((x) => x / length), offset: dot(normal, a) / length };
}

const minus = (a, b) => a.map((x, k) => x - b[k]);
const dot = (a, b) => a.reduce((sum, x, k) => sum + x * b[k], 0);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0]];

// Three corners that span as much as any three with the first.
function threeCorners(points) {
  let best = points.slice(0, 3), most = -1;
  for (let p = 1; p < points.length; p++)
    for (let q = p + 1; q < points.length; q++) {
      const area = Math.hypot(...cross(minus(points[p], points[0]),
        minus(points[q], points[0])));
      if (area > most) [best, most] = [[points[0], points[p], points[q]], area];
    }
  return best;
}

// The box around all points of the scene, a little wider.
function sceneBox(run) {
  run.sceneBox ??= [0, 1, 2].map((k) => {
    let low = Infinity, high = -Infinity;
    for (const p of run.trace.points) {
      low = Math.min(low, p[k]);
      high = Math.max(high, p[k]);
    }
    const more = 0.04 * (high - low) + 1e-6;
    return [low - more, high + more];
  });
  return run.sceneBox;
}

// The corners of a plane's part in the box of the scene.
function planeInBox(run, { normal, offset }) {
  const box = sceneBox(run);
  const corner = (c) => [0, 1, 2].map((k) => box[k][c >> k & 1]);
  const found = [];
  for (let c = 0; c < 8; c++)
    for (const d of [c | 1, c | 2, c | 4]) {
      if (d === c) continue;
      const [p, q] = [corner(c), corner(d)];
      const [s, t] = [dot(normal, p) - offset, dot(normal, q) - offset];
      if ((s < 0) === (t < 0)) continue;
      found.push(p.map((x, k) => x + (q[k] - x) * s / (s - t)));
    }
  return around(found, normal);
}

// Points of a plane, in their order around the middle.
function around(points, normal) {
  if (points.length < 3) return points;
  const middle = [0, 1, 2].map((k) =>
    points.reduce((sum, p) => sum + p[k], 0) / points.length);
  const u = minus(points[0], middle), v = cross(normal, u);
  const angle = (p) => Math.atan2(dot(minus(p, middle), v) / (Math.hypot(...v) || 1),
    dot(minus(p, middle), u) / (Math.hypot(...u) || 1));
  return points.map((p) => [angle(p), p]).sort((a, b) => a[0] - b[0])
    .map(([, p]) => p);
}

// The image of what lies before the eye of a polygon of the world.
export function imageOf(run, points) {
  const { view } = run.header;
  const forward = minus(view.at, view.eye);
  const length = Math.hypot(...forward);
  const least = view.parallel ? -Infinity : Math.max(view.near, length / 50);
  const depth = (p) => dot(minus(p, view.eye), forward) / length - least;
  const kept = [];
  points.forEach((p, k) => {
    const q = points[(k + 1) % points.length];
    const [s, t] = [depth(p), depth(q)];
    if (s >= 0) kept.push(p);
    if ((s >= 0) !== (t >= 0))
      kept.push(p.map((x, c) => x + (q[c] - x) * s / (s - t)));
  });
  const see = projection(view);
  return kept.map((p) => see(p)).filter(Boolean).map(([x, y]) => [x, y]);
}
