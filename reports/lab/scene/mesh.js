// SPDX-License-Identifier: GPL-3.0-or-later
// Faces of solids, as the reader edits them. A face and a solid keep their numbers
// through all edits; those that were deleted are null.
//
// { points: [[x, y, z]], faces: [{ ring: [point], rgb: [r, g, b], opacity: 0 to 1,
//   or undefined: opaque, solid }], solids: [name],
//   sides: [for a solid: 1 or 2, or undefined: one if it is closed, else two] }

// geometry: as core.geometry gives it.
export function meshOf({ xyz, ring, vertex, rgb, opacity, object, objects,
  oneSided }) {
  const points = [];
  for (let k = 0; k < xyz.length; k += 3)
    points.push([xyz[k], xyz[k + 1], xyz[k + 2]]);
  let at = 0;
  const faces = Array.from({ length: ring?.length ?? vertex.length / 3 }, (_, f) => {
    const corners = ring?.[f] ?? 3;
    at += corners;
    return { ring: Array.from(vertex.subarray(at - corners, at)),
      rgb: [rgb[3 * f], rgb[3 * f + 1], rgb[3 * f + 2]], opacity: opacity[f],
      solid: object[f] };
  });
  return { points, faces, solids: objects.slice(),
    sides: sidesOf(faces, objects.length, oneSided) };
}

// Only what does not follow from whether a solid is closed.
function sidesOf(faces, n, oneSided) {
  const open = openSolids(faces), sides = new Array(n);
  faces.forEach(({ solid }, f) => {
    const isOne = oneSided[f] === 1;
    if (isOne === open.has(solid)) sides[solid] = isOne ? 1 : 2;
  });
  return sides;
}

// The solids of which a side of a face has not exactly one that runs against it.
function openSolids(faces) {
  const edges = new Map(), open = new Set();
  const count = (p, q) => edges.get(p)?.get(q) ?? 0;
  for (const { ring } of faces)
    ring.forEach((p, k) => {
      const q = ring[(k + 1) % ring.length];
      if (!edges.has(p)) edges.set(p, new Map());
      edges.get(p).set(q, count(p, q) + 1);
    });
  for (const { ring, solid } of faces)
    ring.forEach((p, k) => {
      const q = ring[(k + 1) % ring.length];
      if (count(p, q) !== 1 || count(q, p) !== 1) open.add(solid);
    });
  return open;
}

export const copyOf = ({ points, faces, solids, sides }) =>
  ({ points: points.slice(), faces: faces.slice(), solids: solids.slice(),
    sides: sides.slice() });

// The numbers of the faces in the scene's order: solid by solid.
export function orderOf({ faces }) {
  const there = [];
  faces.forEach((face, f) => face && there.push(f));
  return there.sort((f, g) => faces[f].solid - faces[g].solid || f - g);
}

// A target is "f" and the number of a face, or "o" and that of a solid.
export function facesOf(mesh, target) {
  const number = Number(target.slice(1));
  if (target[0] === "f") return mesh.faces[number] ? [number] : [];
  const own = [];
  mesh.faces.forEach((face, f) => face?.solid === number && own.push(f));
  return own;
}

export function boundsOf(points) {
  const lo = [Infinity, Infinity, Infinity], hi = lo.map((x) => -x);
  for (const p of points)
    for (let k = 0; k < 3; k++) {
      lo[k] = Math.min(lo[k], p[k]);
      hi[k] = Math.max(hi[k], p[k]);
    }
  return { lo, hi, middle: lo.map((x, k) => (x + hi[k]) / 2),
    size: Math.hypot(...lo.map((x, k) => hi[k] - x)) };
}

export const pointsOf = (mesh, faces) =>
  [...new Set(faces.flatMap((f) => mesh.faces[f].ring))].map((p) => mesh.points[p]);
