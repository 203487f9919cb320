// SPDX-License-Identifier: GPL-3.0-or-later
// What drawings are made of.

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
