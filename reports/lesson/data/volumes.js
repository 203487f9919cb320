// SPDX-License-Identifier: GPL-3.0-or-later
// The convex volumes of solids. A concave solid has several, its parts.

// The planes of volume v, { normal, offset } each, normals outward; null: it is flat.
export function planesOf(run, v) {
  run.volumePlanes ??= new Map();
  if (!run.volumePlanes.has(v)) run.volumePlanes.set(v, outward(run, v));
  return run.volumePlanes.get(v);
}

function outward(run, v) {
  const { volumes, sides } = run.trace.structure;
  const faces = volumes?.[v] ?? [];
  if (faces.length < 4 || sides?.[v]?.length !== faces.length) return null;
  return faces.map((f, k) => {
    const { normal, offset } = frontOf(run, f);
    return sides[v][k] < 0 ? { normal, offset }
      : { normal: normal.map((x) => -x), offset: -offset };
  });
}

// The plane of a face, its normal on the side from which the corners run
// counterclockwise.
function frontOf(run, f) {
  const points = run.header.faces[f][3].map((p) => run.trace.points[p]);
  const normal = [0, 0, 0];
  points.forEach((p, k) => {
    const q = points[(k + 1) % points.length];
    for (let c = 0; c < 3; c++) {
      const [d, e] = [(c + 1) % 3, (c + 2) % 3];
      normal[c] += (p[d] - q[d]) * (p[e] + q[e]);
    }
  });
  const length = Math.hypot(...normal) || 1;
  const unit = normal.map((x) => x / length);
  return { normal: unit, offset: unit.reduce((sum, x, c) => sum + x * points[0][c], 0) };
}

// The images of the sides of volume v, if it is a part of a solid that was divided.
export function partOf(run, v) {
  run.partsOfSolids ??= new Map(run.trace.structure.parts);
  return run.partsOfSolids.get(v) ?? [];
}

export const isPart = (run, v) => partOf(run, v).length > 0;
