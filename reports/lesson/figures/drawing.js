// SPDX-License-Identifier: GPL-3.0-or-later
// What the figures are drawn with.

// SVG's namespace, as the browser has it: the page names no place on the network.
const NS = Object.assign(document.createElement("div"), { innerHTML: "<svg></svg>" })
  .firstChild.namespaceURI;

// An element of SVG; text for children, null for none.
export function s(name, attributes, ...children) {
  const element = document.createElementNS(NS, name);
  for (const [key, value] of Object.entries(attributes))
    if (value !== null && value !== undefined) element.setAttribute(key, value);
  element.append(...children.flat(2).filter((x) => x !== null));
  return element;
}

// A drawing of width × height units, in its own words.
export const board = (width, height, label, ...children) => s("svg",
  { viewBox: `0 0 ${round(width)} ${round(height)}`, role: "img",
    "aria-label": label, class: "figure" }, ...children);

export const round = (x) => Number(x.toFixed(2));
export const pathOf = (points, open) => points.length ? `M${points.map(([x, y]) =>
  `${round(x)} ${round(y)}`).join("L")}${open ? "" : "Z"}` : "";
export const text = (x, y, words, attributes = {}) => s("text",
  { x: round(x), y: round(y), "font-size": 11, "text-anchor": "middle",
    fill: "var(--ink)", ...attributes }, String(words));
export const line = (x1, y1, x2, y2, attributes = {}) => s("line",
  { x1: round(x1), y1: round(y1), x2: round(x2), y2: round(y2),
    stroke: "var(--ink)", ...attributes });

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
