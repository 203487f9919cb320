// SPDX-License-Identifier: GPL-3.0-or-later
// The face under the pointer, to be chosen. Rounded numbers are good enough here:
// no picture depends on it.
import { cross, dot, minus } from "../views/camera.js";

// ray: { from, along }. Returns { face, point } of the nearest face, or null.
export function pick(mesh, { from, along }) {
  let best = null, least = Infinity;
  mesh.faces.forEach((face, f) => {
    const t = face ? hit(face.ring.map((p) => mesh.points[p]), from, along) : null;
    if (t !== null && t > 0 && t < least) {
      least = t;
      best = f;
    }
  });
  return best === null ? null
    : { face: best, point: from.map((x, k) => x + least * along[k]) };
}

function hit(points, from, along) {
  const normal = normalOf(points);
  const slope = dot(normal, along);
  if (!slope) return null;
  const t = dot(normal, minus(points[0], from)) / slope;
  const at = from.map((x, k) => x + t * along[k]);
  const most = normal.map(Math.abs);
  const [u, v] = [[1, 2], [0, 2], [0, 1]][most.indexOf(Math.max(...most))];
  return isInside(points, at[u], at[v], u, v) ? t : null;
}

function normalOf(points) {
  let sum = [0, 0, 0];
  for (let k = 1; k + 1 < points.length; k++) {
    const n = cross(minus(points[k], points[0]), minus(points[k + 1], points[0]));
    sum = sum.map((x, c) => x + n[c]);
  }
  return sum;
}

function isInside(points, x, y, u, v) {
  let inside = false;
  for (let k = 0, l = points.length - 1; k < points.length; l = k++) {
    const [a, b] = [points[k], points[l]];
    if ((a[v] > y) !== (b[v] > y) &&
        x < (b[u] - a[u]) * (y - a[v]) / (b[v] - a[v]) + a[u]) inside = !inside;
  }
  return inside;
}
