// SPDX-License-Identifier: GPL-3.0-or-later
// What the figures are drawn with.

import { line, pathOf, s, text } from "../../page/parts/svg.js";

export { board, line, pathOf, round, s, text } from "../../page/parts/svg.js";

export const colourOf = (run, f) => run.header.faces[f]?.[2] ??
  run.header.background;

// The images of all faces, pale, scaled by `unit`, or where place() says.
export function ground(run, unit, place = ([x, y]) => [x * unit, y * unit]) {
  return s("path", { d: run.header.faces.map(([, , , , polygon]) =>
    pathOf(polygon.map(place))).join(""),
  fill: "none", stroke: "var(--ink)", "stroke-opacity": 0.25,
  "stroke-width": 0.7 });
}

export const middle = (points) => [0, 1].map((k) =>
  points.reduce((sum, p) => sum + p[k], 0) / points.length);

// Segments in the plane of X and Z: X to the right, the eye below. Returns where
// things lie and what is drawn.
export function section(run, segments, { left = 0, right, width, height, label,
  also = [] }) {
  const z = [...segments, ...also].flatMap(({ z0, z1 }) => [z0, z1]);
  const low = Math.min(...z), high = Math.max(...z);
  const px = (x) => (x - left) / (right - left) * width;
  const py = (value) => 14 + (height - 34) *
    (high > low ? (value - low) / (high - low) : 0.5);
  const drawn = segments.map((g) => [
    line(px(g.x0), py(g.z0), px(g.x1), py(g.z1), { "stroke-width": 5,
      stroke: "var(--paper)" }),
    line(px(g.x0), py(g.z0), px(g.x1), py(g.z1), { "stroke-width": 3,
      stroke: colourOf(run, g.face) }),
    label ? text(px(g.x0) + 4, py(g.z0) - 5, label(g.face),
      { "text-anchor": "start" }) : null]);
  return { px, py, drawn };
}
