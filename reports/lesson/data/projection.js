// SPDX-License-Identifier: GPL-3.0-or-later
// Where points of the world are seen, and how deep faces lie behind the picture.

// world -> [x, y, depth, samples a unit], or null if it is not before the eye.
export function projection({ eye, at, up, fov, near, parallel, width, height }) {
  const minus = (a, b) => a.map((x, k) => x - b[k]);
  const dot = (a, b) => a.reduce((sum, x, k) => sum + x * b[k], 0);
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
    a[0] * b[1] - a[1] * b[0]];
  const unit = (a) => a.map((x) => x / Math.hypot(...a));
  const forward = unit(minus(at, eye));
  const right = unit(cross(forward, up));
  const above = cross(right, forward);
  return (point) => {
    const d = minus(point, eye);
    const depth = dot(d, forward);
    if (!parallel && depth <= Math.max(near, 1e-9)) return null;
    const half = parallel ? parallel / 2
      : depth * Math.tan(fov * Math.PI / 360);
    const unitSize = height / 2 / half;
    return [width / 2 + dot(d, right) * unitSize,
      height / 2 - dot(d, above) * unitSize, depth, unitSize];
  };
}

// face -> (x, y) -> 1/depth of its plane there; in parallel, minus the depth. Both
// are linear on the screen, and grow towards the eye. null: a face without depth.
export function closeness(run) {
  const { header, trace } = run;
  const see = projection(header.view);
  const known = new Map();
  return (f) => {
    if (!known.has(f)) known.set(f, planeOf(header.faces[f][3].map((v) =>
      see(trace.points[v])), header.view.parallel > 0));
    return known.get(f);
  };
}

// The plane through the first corner and those two that span most with it.
function planeOf(corners, parallel) {
  const at = corners.filter(Boolean).map(([x, y, depth]) =>
    [x, y, parallel ? -depth : 1 / depth]);
  let best = null, most = 1e-9;
  for (let p = 1; p < at.length; p++)
    for (let q = p + 1; q < at.length; q++) {
      const [ax, ay] = [at[p][0] - at[0][0], at[p][1] - at[0][1]];
      const [bx, by] = [at[q][0] - at[0][0], at[q][1] - at[0][1]];
      const area = ax * by - ay * bx;
      if (Math.abs(area) <= most) continue;
      most = Math.abs(area);
      const az = at[p][2] - at[0][2], bz = at[q][2] - at[0][2];
      best = [(az * by - bz * ay) / area, (ax * bz - bx * az) / area];
    }
  return best && ((x, y) =>
    at[0][2] + best[0] * (x - at[0][0]) + best[1] * (y - at[0][1]));
}

// Where faces lie on the line on which coordinate c is at: [{ face, from, to, q0, q1 }],
// by the other coordinate, and q as of closeness. held(u): the ends as they are wanted.
function stretchesOn(run, c, at, near, held = (u) => u) {
  return run.header.faces.flatMap(([face, , , , polygon]) => {
    const plane = near(face);
    const q = (u) => c ? plane(u, at) : plane(at, u);
    const ends = polygon.flatMap((p, k) => {
      const r = polygon[(k + 1) % polygon.length];
      return (p[c] > at) === (r[c] > at) ? []
        : [p[1 - c] + (at - p[c]) / (r[c] - p[c]) * (r[1 - c] - p[1 - c])];
    }).map(held).sort((u, v) => u - v);
    const stretches = [];
    for (let k = 0; plane && k + 1 < ends.length; k += 2)
      stretches.push({ face, from: ends[k], to: ends[k + 1], q0: q(ends[k]),
        q1: q(ends[k + 1]) });
    return stretches;
  });
}

// The segments of faces on row j: [{ face, x0, x1, z0, z1 }], z as of closeness.
export const segmentsOn = (run, j, near = closeness(run)) =>
  stretchesOn(run, 1, j + 0.5, near).map(({ face, from, to, q0, q1 }) =>
    ({ face, x0: from, x1: to, z0: q0, z1: q1 }));

// The segments of faces on column i: [{ face, y0, y1, q0, q1 }], within the picture; q
// as of closeness.
export const columnSegments = (run, i, near = closeness(run)) =>
  stretchesOn(run, 0, i + 0.5, near, (y) => Math.min(run.height, Math.max(0, y)))
    .filter(({ from, to }) => from < to)
    .map(({ face, from, to, q0, q1 }) => ({ face, y0: from, y1: to, q0, q1 }));

// Of faces: closeness(f) as above; deep(f, x, y), how deep its plane is there, or null;
// reach(f), its nearest and its farthest corner before the eye, or null.
export function depths(run) {
  const near = closeness(run), { parallel } = run.header.view;
  const see = projection(run.header.view);
  const deep = (f, x, y) => {
    const q = near(f)?.(x, y) ?? null;
    return q === null || (q <= 0 && !parallel) ? null : parallel ? -q : 1 / q;
  };
  const reach = (f) => {
    const own = run.header.faces[f][3].map((v) => see(run.trace.points[v])?.[2])
      .filter((d) => d !== undefined);
    return own.length ? [Math.min(...own), Math.max(...own)] : null;
  };
  return { closeness: near, deep, reach };
}
