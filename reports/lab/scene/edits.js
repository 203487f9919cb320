// SPDX-License-Identifier: GPL-3.0-or-later
// Edits of a mesh. An edit is a list that an address can hold:
//
// ["move", target, dx, dy, dz]
// ["turn", target, ux, uy, uz, t]   about the middle, by an angle with tan(angle/2)
//                                   = t about the axis u. So all browsers compute
//                                   the same corners
// ["delete", target]
// ["box", x, y, z, dx, dy, dz, colour]     its middle and its sides
// ["polygon", colour, x, y, z, x, y, z, ...]
// ["paint", target, colour]         colours are "#rrggbb"
import { boundsOf, copyOf, facesOf, pointsOf } from "./mesh.js";

export function edited(mesh, edits) {
  const own = copyOf(mesh);
  for (const [name, ...given] of edits)
    if (Object.hasOwn(DOES, name)) DOES[name](own, ...given);
  return own;
}

const DOES = {
  move: (mesh, target, ...d) =>
    moved(mesh, target, (p) => p.map((x, k) => x + d[k])),
  turn: (mesh, target, ux, uy, uz, t) => {
    const about = boundsOf(pointsOf(mesh, facesOf(mesh, target))).middle;
    const turn = rotation([ux, uy, uz], t);
    moved(mesh, target, (p) => turn(p.map((x, k) => x - about[k]))
      .map((x, k) => x + about[k]));
  },
  delete: (mesh, target) => {
    for (const f of facesOf(mesh, target)) mesh.faces[f] = null;
  },
  box: (mesh, x, y, z, dx, dy, dz, colour) => {
    const corners = Array.from({ length: 8 }, (_, c) => [x + (c & 1 ? dx : -dx) / 2,
      y + (c & 2 ? dy : -dy) / 2, z + (c & 4 ? dz : -dz) / 2]);
    add(mesh, "box", corners, BOX, colour);
  },
  polygon: (mesh, colour, ...numbers) => {
    const corners = Array.from({ length: Math.floor(numbers.length / 3) },
      (_, k) => numbers.slice(3 * k, 3 * k + 3));
    add(mesh, "polygon", corners, [corners.map((_, k) => k)], colour);
  },
  paint: (mesh, target, colour) => {
    for (const f of facesOf(mesh, target))
      mesh.faces[f] = { ...mesh.faces[f], rgb: linear(colour) };
  },
};

// Sides of a box, counter-clockwise from outside; corner bits are x, y, z.
const BOX = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1],
  [4, 5, 7, 6]];

function add(mesh, name, corners, rings, colour) {
  const first = mesh.points.length, solid = mesh.solids.length;
  mesh.points.push(...corners);
  mesh.solids.push(`${name} ${solid}`);
  for (const ring of rings)
    mesh.faces.push({ ring: ring.map((c) => c + first), rgb: linear(colour), solid });
}

// Corners that other faces have, too, stay where they are for these.
function moved(mesh, target, how) {
  const own = new Set(facesOf(mesh, target)), others = new Set();
  mesh.faces.forEach((face, f) => face && !own.has(f) &&
    face.ring.forEach((p) => others.add(p)));
  const places = new Map();
  const placeOf = (p) => {
    if (!places.has(p)) {
      const to = how(mesh.points[p]);
      places.set(p, others.has(p) ? mesh.points.push(to) - 1 : p);
      mesh.points[places.get(p)] = to;
    }
    return places.get(p);
  };
  for (const f of own)
    mesh.faces[f] = { ...mesh.faces[f], ring: mesh.faces[f].ring.map(placeOf) };
}

// By Rodrigues' formula, with the cosine and the sine as quotients.
function rotation([x, y, z], t) {
  const c = (1 - t * t) / (1 + t * t), s = 2 * t / (1 + t * t), d = 1 - c;
  const rows = [[c + d * x * x, d * x * y - s * z, d * x * z + s * y],
    [d * x * y + s * z, c + d * y * y, d * y * z - s * x],
    [d * x * z - s * y, d * y * z + s * x, c + d * z * z]];
  return (p) => rows.map((row) => row[0] * p[0] + row[1] * p[1] + row[2] * p[2]);
}

// "#rrggbb" as linear numbers, of a few digits.
const linear = (colour) => [1, 3, 5].map((k) => {
  const c = parseInt(colour.slice(k, k + 2), 16) / 255;
  return Math.round(1e4 * (c <= 0.04045 ? c / 12.92
    : ((c + 0.055) / 1.055) ** 2.4)) / 1e4;
});
