// SPDX-License-Identifier: GPL-3.0-or-later
// The part of a face that is inside of a clip polygon, or outside of it. The trace names
// only the faces: what other clip polygons have cut off is not taken away here.
const OF_PIECES = /^(pieces|depth comparisons|culled|penetrations)$/;

export function clippedLook(run, e) {
  if (run.header.algorithm.name !== "weiler-atherton" ||
      !OF_PIECES.test(e.counter.name)) return [];
  const [face, clip] = [e.a, e.b].map(({ ids: [f] }) => run.header.faces[f]?.[4] ?? []);
  if (clip.length < 3 || !isConvex(clip)) return [];
  const { inside, outside } = clipped(face, clip);
  return (e.outcome === "outside" ? outside : [inside])
    .filter((points) => points.length > 2)
    .map((points) => ({ points, closed: true, width: 0, fill: 0.55 }));
}

// Twice the area of the triangle of a, b and c, with its sign.
const turn = ([ax, ay], [bx, by], [cx, cy]) =>
  (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);

export function isConvex(points) {
  const turns = points.map((p, k) => turn(p, points[(k + 1) % points.length],
    points[(k + 2) % points.length])).filter((t) => Math.abs(t) > 1e-9);
  return turns.every((t) => t > 0) || turns.every((t) => t < 0);
}

// { inside, outside: [...] }: polygons of points.
export function clipped(face, clip) {
  const area = clip.reduce((sum, p, k) => sum + turn(clip[0], p,
    clip[(k + 1) % clip.length]), 0);
  const outside = [];
  let inside = face;
  clip.forEach((p, k) => {
    const q = clip[(k + 1) % clip.length];
    const side = (x) => (area < 0 ? -1 : 1) * turn(p, q, x);
    outside.push(half(inside, (x) => -side(x)));
    inside = half(inside, side);
  });
  return { inside, outside };
}

// What of a polygon is on the positive side.
function half(points, side) {
  const kept = [];
  points.forEach((p, k) => {
    const q = points[(k + 1) % points.length];
    const [s, t] = [side(p), side(q)];
    if (s >= 0) kept.push(p);
    if ((s > 0 && t < 0) || (s < 0 && t > 0))
      kept.push(p.map((x, c) => x + s / (s - t) * (q[c] - x)));
  });
  return kept;
}
