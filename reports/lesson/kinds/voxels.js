// SPDX-License-Identifier: GPL-3.0-or-later
// Cubes of solids, each of a size in voxels.
import { projection } from "../data/projection.js";
import { PROGRESS } from "./shared/parts.js";

// [x, y, z] and size of each cube of a part, in voxels.
function cubesOf([, corner, size, low, high]) {
  const cubes = [];
  for (let bit = 0; bit < 64; bit++) {
    if (!((bit < 32 ? low >>> bit : high >>> (bit - 32)) & 1)) continue;
    cubes.push([corner[0] + size * (bit & 3), corner[1] + size * (bit >> 2 & 3),
      corner[2] + size * (bit >> 4)]);
  }
  return cubes;
}

function painting(run) {
  const { trace, accepts } = run;
  const { n, solids } = trace.answer;
  const at = (k) => trace.parts.slice(0, run.accepted(k));
  const final = () => {
    const out = new Int32Array(n[0] * n[1] * n[2]);
    for (let k = 0, place = 0; k < solids.length; k += 2)
      out.fill(solids[k], place, place += solids[k + 1]);
    return out;
  };
  const filled = (parts) => {
    const out = new Int32Array(n[0] * n[1] * n[2]);
    for (const part of parts)
      for (const [x, y, z] of cubesOf(part))
        for (let k = z; k < Math.min(z + part[2], n[2]); k++)
          for (let j = y; j < Math.min(y + part[2], n[1]); j++)
            for (let i = x; i < Math.min(x + part[2], n[0]); i++)
              out[(k * n[1] + j) * n[0] + i] = part[0];
    return out;
  };
  return { at, final,
    decided: (k) => accepts.length ? run.accepted(k) / accepts.length : 1,
    equal: () => {
      const answer = final();
      return filled(at(run.n)).every((s, k) => s === answer[k]);
    } };
}

function draw({ run, context }, parts) {
  const project = projection(run.header.view);
  const { lo, size } = run.trace.answer;
  const dots = [];
  for (const part of parts)
    for (const cube of cubesOf(part)) {
      const half = part[2] / 2;
      const at = project(cube.map((x, k) => lo[k] + (x + half) * size));
      if (!at) continue;
      const [x, y, depth, unit] = at;
      dots.push({ x, y, depth, solid: part[0],
        r: Math.max(0.6, 0.6 * unit * part[2] * size) });
    }
  dots.sort((a, b) => b.depth - a.depth);
  for (const { x, y, r, solid } of dots) {
    context.fillStyle = `hsl(${solid * 137 % 360} 45% 55%)`;
    context.fillRect(x - r, y - r, 2 * r, 2 * r);
  }
}

// Cell number k of a level of the pyramid; below the last level, a voxel.
function cornersOfCell(run, [level, k]) {
  const { n, lo, size } = run.trace.answer;
  const levels = Math.max(1, ...n.map((x) => Math.ceil(Math.log(x) / Math.log(4) - 1e-9)));
  const side = 4 ** (levels - level);
  const [across, down] = n.map((x) => Math.ceil(x / side));
  const at = [k % across, Math.floor(k / across) % down,
    Math.floor(k / across / down)];
  const see = projection(run.header.view);
  return Array.from({ length: 8 }, (_, c) => see(at.map((x, axis) =>
    lo[axis] + size * Math.min(n[axis], (x + (c >> axis & 1)) * side)))?.slice(0, 2));
}

const cellWords = ([level, k]) =>
  level ? `cell ${Math.max(k, 0)} of level ${level}` : "the cell of all space";

export const voxels = { name: "voxels", progress: PROGRESS, painting, draw, cornersOfCell,
  cellWords };
