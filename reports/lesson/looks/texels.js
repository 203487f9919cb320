// SPDX-License-Identifier: GPL-3.0-or-later
// Texels of a texture: in a small map of its level, and where they are in the picture.
import { cornersOf } from "../data/grids.js";
import { imageOf } from "./solids.js";

const INSET = 0.32; // of the picture's width: a map

// A texel in the map of its level.
export function texelLook(run, level, p, q) {
  const size = texturesOf(run).get(level);
  return size ? [mapLook(run, size, 0), boxIn(run, size, [p, q], { fill: 0.7, width: 2 })]
    : null;
}

// What was read for the pixel so far, or in the end: in the maps of their levels, side by
// side; and in the picture, the texels of the texture itself.
export function readLook(run, e) {
  if (!isOfTextures(run) || e.counter.a === "cell" && e.counter.key !== "texel-read")
    return [];
  const read = readFor(run, e);
  const levels = [...new Set(read.map(([level]) => level))];
  const isEnd = e.kind === "accept";
  return [...(isEnd ? levels.map((level, n) => mapLook(run, texturesOf(run).get(level), n))
    : []), ...read.filter(([level]) => isEnd || level === e.a.ids[0])
    .map(([level, ...at]) => boxIn(run, texturesOf(run).get(level), at, { fill: 0.35,
      width: 0.8 }, isEnd ? levels.indexOf(level) : 0)),
  ...read.filter(([level]) => level === 0 && run.trace.structure.numbered === "texels")
    .flatMap(([, ...at]) => inPicture(run, at))];
}

const isOfTextures = ({ trace: { structure: { numbered } } }) =>
  numbered === "texels" || numbered === "entries";

// [level, p, q] of each texel that was read for the pixel of event e, up to it.
export function readFor(run, e) {
  const { trace, header } = run, read = [];
  for (let k = e.k; k >= 0; k--) {
    const { key } = header.counters[trace.counter[k]];
    if (key === "texture-ray") break;
    if (key === "texel-read") read.push([trace.a0[k], trace.a1[k], trace.a2[k]]);
  }
  return read;
}

function mapLook(run, [across, down], n) {
  return boxOf(run, [across, down], [0, 0, across, down], { width: 1.2, role: "ink" }, n);
}

const boxIn = (run, size, [p, q], look, n = 0) =>
  boxOf(run, size, [p - size[2], q - size[3], 1, 1], look, n);

// Map number n is beside map n - 1.
function boxOf(run, size, [x, y, w, h], look, n) {
  const unit = INSET * run.width / Math.max(size[0], size[1]);
  const left = 1 + n * (INSET + 0.03) * run.width;
  return { points: [[x, y], [x + w, y], [x + w, y + h], [x, y + h]].map(([u, v]) =>
    [left + unit * u, 1 + unit * v]), closed: true, ...look };
}

// The middle of the layer there.
function inPicture(run, [p, q]) {
  const { bounds } = run.trace.structure;
  const across = bounds?.findIndex((along) => along.length === 2) ?? -1;
  if (across < 0) return [];
  const at = [p, q];
  const cell = [0, 1, 2].map((k) => k === across ? 0 : at.shift());
  if (cell.some((x, k) => x < 0 || x > bounds[k].length - 2)) return [];
  const corners = cornersOf(run, { low: cell, high: cell });
  const [u, v] = [0, 1, 2].filter((k) => k !== across).map((k) => 1 << k);
  const middle = (c) => corners[c].map((x, k) => (x + corners[c | 1 << across][k]) / 2);
  const points = imageOf(run, [0, u, u | v, v].map(middle));
  return points.length > 2 ? [{ points, closed: true, width: 1.2, fill: 0.15 }] : [];
}

// level -> how many texels it has along each axis, and the numbers of the first.
function texturesOf(run) {
  if (run.textures) return run.textures;
  const { trace, header } = run, levels = new Map();
  const isTexel = isOfTextures(run)
    ? header.counters.map(({ a }) => a === "cell") : [];
  for (let k = 0; k < trace.kept && isTexel.length; k++) {
    if (!isTexel[trace.counter[k]]) continue;
    const [l, p, q] = [trace.a0[k], trace.a1[k], trace.a2[k]];
    const [, , p0, q0, p1, q1] = levels.get(l) ?? [0, 0, p, q, p, q];
    const [pl, ql, ph, qh] = [Math.min(p0, p), Math.min(q0, q), Math.max(p1, p),
      Math.max(q1, q)];
    levels.set(l, [ph - pl + 1, qh - ql + 1, pl, ql, ph, qh]);
  }
  run.textures = levels;
  return levels;
}
