// SPDX-License-Identifier: GPL-3.0-or-later
// The looks of faces, of pieces of them, of edges and of vertices.

// The image of face f, or nothing if it is outside of the picture.
export function faceShapes(run, f, fill = 0.22, width = 2) {
  const polygon = run.header.faces[f]?.[4];
  return polygon?.length ? [{ points: polygon, closed: true, fill, width }] : [];
}

export const faceLook = (run, e, { ids: [f] }) => faceShapes(run, f);

// What is left of the face.
export function pieceLook(run, e, { ids: [f, p] }) {
  const left = run.outline(e.k, p, f);
  return left?.length ? [{ points: left, closed: true, fill: 0.22, width: 2 }]
    : faceShapes(run, f);
}

export function edgeLook(run, e, { ids: [p, q, f] }) {
  const [from, to] = [run.header.vertices[p], run.header.vertices[q]];
  return [...(f >= 0 ? faceShapes(run, f, 0, 1) : []),
    ...(from && to ? [{ points: [from, to], width: 3.5 }] : [])];
}

// The two faces that penetrate; the line is where they meet.
export const impliedLook = (run, e, { ids: [f, g] }) =>
  [...faceShapes(run, f, 0.1, 1), ...faceShapes(run, g, 0.1, 1)];

// A ring of twelve corners, whose size is of the screen: `ring`.
export function vertexLook(run, e, { ids: [v] }) {
  const at = run.header.vertices[v];
  return at ? [{ ring: at, points: [at], width: 2.5 }] : [];
}
