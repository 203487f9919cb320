// SPDX-License-Identifier: GPL-3.0-or-later
// Edits that a hand makes. What it does on the picture becomes numbers of the world, on
// a grid, so that they stay short.
import { boundsOf } from "../scene/mesh.js";
import { axes, dot, minus, plus, rayThrough, short, unitAt } from "../views/camera.js";

const COLOURS = ["#c8553d", "#3d7dc8", "#4a9d5b", "#c8a23d", "#8a5bb5"];
export const colourOf = (n) => COLOURS[n % COLOURS.length];

// snap(x): the number on the grid of a scene's size; step: from one to the next.
export function gridOf(mesh) {
  const bounds = boundsOf(mesh.points);
  const step = 2 ** Math.floor(Math.log2((bounds.size || 1) / 512));
  return { step, bounds, snap: (x) => Math.round(x / step) * step };
}

// Moves what is at a point by shares of the picture's height: along the picture, or
// along the view.
export function moveEdit(target, { camera, at, x, y, isDeep, snap }) {
  const { forward, right, above } = axes(camera);
  const size = unitAt(camera, dot(minus(at, camera.eye), forward), 1);
  const d = isDeep ? forward.map((c) => -c * y * size)
    : plus(right.map((c) => c * x * size), above, -y * size);
  return ["move", target, ...d.map(snap)];
}

const STEP = Math.PI / 36; // 5 degrees

// Turns about the axis of the world that is most upright, or most to the right.
export function turnEdit(target, { camera, x, y }) {
  const { right, above } = axes(camera);
  const isSideways = Math.abs(x) >= Math.abs(y);
  const axis = isSideways ? above : right, k = mostOf(axis);
  const u = [0, 1, 2].map((c) => c === k ? Math.sign(axis[k]) : 0);
  const angle = Math.round((isSideways ? x : y) * Math.PI / STEP) * STEP;
  return ["turn", target, ...u, short(Math.tan(angle / 2))];
}

const mostOf = (v) => {
  const size = v.map(Math.abs);
  return size.indexOf(Math.max(...size));
};

// The axis along which one looks most: polygons stand across it.
export const acrossView = (camera) => mostOf(axes(camera).forward);

export function boxEdit({ bounds, snap, step }, colour) {
  const side = Math.max(step, snap(bounds.size / 8));
  return ["box", ...bounds.middle.map(snap), side, side, side, colour];
}

export function triangleEdit({ bounds, snap, step }, k, colour) {
  const r = Math.max(step, snap(bounds.size / 6));
  const corners = [[-r, -r], [r, -r], [0, r]].map(([a, b]) => {
    const p = bounds.middle.map(snap);
    p[(k + 1) % 3] += a;
    p[(k + 2) % 3] += b;
    return p;
  });
  return ["polygon", colour, ...corners.flat()];
}

// The point of a plane, x, y or z = place, under (x, y) of the picture; null: none.
export function cornerAt({ x, y }, { camera, size: [m, n] }, k, place, snap) {
  const { from, along } = rayThrough(camera, x * m, y * n, m, n);
  const t = (place - from[k]) / along[k];
  if (!(t > 0) || !Number.isFinite(t)) return null;
  const corner = plus(from, along, t).map(snap);
  corner[k] = place;
  return corner;
}
