// SPDX-License-Identifier: GPL-3.0-or-later
// The looks of an algorithm, the same in every plot: one of eight colours that
// can be told apart without colour vision (style.css has their light and dark
// forms), one of nine symbols, and the symbol's dash. Where a plot has a row
// for each algorithm, scenes have looks instead.
import {
  symbol, symbolCircle, symbolSquare, symbolTriangle, symbolDiamond, symbolStar,
  symbolCross, symbolWye, symbolAsterisk,
} from "d3";

// d3's triangle, upside down.
const symbolTriangleDown = {
  draw(context, size) {
    const y = Math.sqrt(size / (Math.sqrt(3) * 3));
    context.moveTo(0, 2 * y);
    context.lineTo(Math.sqrt(3) * y, -y);
    context.lineTo(-Math.sqrt(3) * y, -y);
    context.closePath();
  },
};

const COLOURS = 8;
const SYMBOLS = [
  [symbolCircle, null], [symbolSquare, "7 3"], [symbolTriangle, "2 3"],
  [symbolDiamond, "9 3 2 3"], [symbolStar, "5 2"], [symbolCross, "1 2"],
  [symbolWye, "12 4"], [symbolTriangleDown, "4 2 1 2"],
  [symbolAsterisk, "8 2 2 2"],
];

// [colour, symbol]: relatives share a colour, neighbours in a plot do not.
const KNOWN = {
  watkins: [0, 0], "newell-watkins": [0, 1], "warnock-watkins": [0, 2],
  appel: [0, 3], "appel-visible": [0, 4],
  warnock: [1, 0], "warnock-vertices": [1, 1], "warnock-depth": [1, 2],
  roberts: [1, 3], tiling: [1, 4], "tiling-lazy": [1, 5],
  "tiling-merged": [1, 6], "tiling-solids": [1, 7],
  romney: [2, 0], loutrel: [2, 3],
  newell: [3, 0], "newell-frame-buffer": [3, 1], "newell-previous": [3, 2],
  "warnock-newell": [3, 3], "schumacker-newell": [3, 4],
  "schumacker-watkins": [6, 5], "schumacker-newell-watkins": [6, 8],
  yzx: [4, 0], painter: [4, 5],
  bouknight: [5, 0], galimberti: [5, 3],
  schumacker: [6, 0], "bsp-painter": [6, 1], "bsp-front": [6, 2],
  "warnock-edges": [6, 3],
  zbuffer: [7, 0], "zbuffer-fast": [7, 8], "hzbuffer-moving": [5, 8],
  raycast: [7, 1], hzbuffer: [7, 2], oracle: [7, 3],
  pbtf: [4, 1], ippbtf: [4, 2], "octree-order": [4, 3],
  btf: [2, 4], wbtf: [2, 5], vbuffer: [2, 6],
  splat: [0, 5], "splat-sheet": [0, 6], "splat-volume": [0, 7],
  "splat-xray": [2, 7], "splat-oracle": [6, 7],
  "texture-point": [5, 4], "texture-mipmap": [5, 5], "texture-table": [5, 6],
  "texture-convolve": [5, 7],
  "line-oracle": [7, 4], "voxel-oracle": [7, 7], null: [7, 5], clark: [7, 6],
  "area-oracle": [3, 5], "polygon-oracle": [3, 6], "transparent-oracle": [2, 2],
  "shadow-oracle": [6, 6],
  "error-bounded": [4, 6], "weiler-atherton": [4, 7], "a-buffer": [2, 1],
  "octree-raycast": [5, 1], "zz-buffer": [3, 7], meagher: [4, 4],
  naylor: [6, 4], pvs: [5, 2], "sort-stages": [4, 8],
};

// FNV-1a: an unknown name has the same looks in every report.
function hash(name) {
  let value = 0x811c9dc5;
  for (const c of new TextEncoder().encode(name))
    value = Math.imul(value ^ c, 0x01000193) >>> 0;
  return value;
}

function looksOf(colour, shape) {
  const [type, dash] = SYMBOLS[shape];
  return { colour: `var(--hue-${colour})`, symbol: type, dash };
}

export function looks(name) {
  const unknown = hash(name);
  return looksOf(...Object.hasOwn(KNOWN, name) ? KNOWN[name]
    : [unknown % COLOURS, (unknown >>> 8) % SYMBOLS.length]);
}

// Of the k-th thing of another list; the first 72 differ.
export function looksByNumber(k) {
  const row = Math.floor(k / COLOURS), column = k % COLOURS;
  return looksOf(column, (row + column) % SYMBOLS.length);
}

// The symbol on a piece of the line, as in a plot.
export function key({ colour, symbol: type, dash }) {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  const add = (tag, attributes) => {
    const element = document.createElementNS(svg.namespaceURI, tag);
    for (const [k, v] of Object.entries(attributes))
      if (v !== null) element.setAttribute(k, v);
    svg.append(element);
  };
  for (const [k, v] of Object.entries({ class: "key", viewBox: "-14 -7 28 14",
    width: 28, height: 14, "aria-hidden": "true" })) svg.setAttribute(k, v);
  add("line", { x1: -13, x2: 13, stroke: colour, "stroke-width": 1.5,
    "stroke-dasharray": dash });
  add("path", { d: symbol(type, 44)(), fill: colour });
  return svg;
}
