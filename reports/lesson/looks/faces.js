// SPDX-License-Identifier: GPL-3.0-or-later
// The looks of faces, of pieces of them, of edges and of vertices.
import { fragmentAt } from "../data/fragments.js";
import { mergedFace } from "../data/lists.js";
import { imageOf } from "./solids.js";

// The image of face f, or nothing if it is outside of the picture.
export function faceShapes(run, f, fill = 0.22, width = 2) {
  const polygon = run.header.faces[f]?.[4];
  return polygon?.length ? [{ points: polygon, closed: true, fill, width }] : [];
}

// The piece that is painted, at a bead of its row.
export function mergedLook(run, e) {
  const face = mergedFace(run, e);
  return face < 0 || face === e.a.ids[0] ? []
    : faceShapes(run, face, 0.1, 2).map((shape) => ({ ...shape, dashed: true }));
}

export const faceLook = (run, e, { ids: [f] }) => faceShapes(run, f);

// What is left of the face.
export function pieceLook(run, e, { ids: [f, p] }) {
  const left = run.outline(e.k, p, f);
  return left?.length ? [{ points: left, closed: true, fill: 0.22, width: 2 }]
    : faceShapes(run, f);
}

export function edgeLook(run, e, { ids: [p, q, f] }) {
  const fragment = e.a.kind === "edge" && e.a.ids[0] === p && e.a.ids[1] === q
    ? fragmentLook(run, e, p, q) : null;
  if (fragment) return fragment;
  const [from, to] = [run.header.vertices[p], run.header.vertices[q]];
  return [...(f >= 0 ? faceShapes(run, f, 0, 1) : []),
    ...(from && to ? [{ points: [from, to], width: 3.5 }] : [])];
}

// The two faces that penetrate; the line is where they meet.
export const impliedLook = (run, e, { ids: [f, g] }) =>
  [...faceShapes(run, f, 0.1, 1), ...faceShapes(run, g, 0.1, 1)];

// The fragment at hand, broad; what a volume hides of it, dotted; the edge, thin.
function fragmentLook(run, e, p, q) {
  const at = fragmentAt(run, e.k);
  if (!at) return null;
  const [a, b] = [p, q].map((v) => run.trace.points[v]);
  const part = (from, to, look) => {
    const ends = to - from < 1e-6 ? [] : imageOf(run, [from, to].map((t) =>
      a.map((x, c) => x + t * (b[c] - x))));
    return ends.length < 2 ? [] : [{ points: ends.slice(0, 2), ...look }];
  };
  const broad = { width: 4.5 };
  if (!at.hidden || e.isAsked) return [...part(0, 1, { width: 1 }), ...part(at.from, at.to, broad)];
  return [...part(0, 1, { width: 1 }), ...part(at.from, at.hidden[0], broad),
    ...part(at.hidden[1], at.to, broad), ...part(...at.hidden, { width: 3, dotted: true,
      role: "ink" })];
}

// A ring of twelve corners, whose size is of the screen: `ring`.
export function vertexLook(run, e, { ids: [v] }) {
  const at = run.header.vertices[v];
  return at ? [{ ring: at, points: [at], width: 2.5 }] : [];
}
