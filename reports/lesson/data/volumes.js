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

// Whether volume v is a part of a solid that was divided.
export function isPart(run, v) {
  run.partsOfSolids ??= partsOf(run.trace.structure);
  return run.partsOfSolids.has(v);
}

function partsOf({ bodies, volumes }) {
  const solid = (volumes ?? []).map((faces, v) => [faces ?? [], v])
    .filter(([faces]) => faces.length > 3);
  return new Set((bodies ?? []).flatMap((body) => {
    const of = new Set(body);
    const own = solid.filter(([faces]) => faces.every((f) => of.has(f)));
    return own.length > 1 ? own.map(([, v]) => v) : [];
  }));
}
