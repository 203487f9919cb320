// SPDX-License-Identifier: GPL-3.0-or-later
// A step as a drawing in SVG: the picture, what the step names, and the sentence.
import { colourOf, KINDS, setPaper, kindColour } from "../data/kinds.js";
import { eventWords } from "../data/words.js";
import { looksOf } from "../looks/all.js";
import { markerLooks } from "../looks/tests.js";
import { momentsOf } from "../telling/moments.js";
import { offer } from "../../page/parts/save.js";
import { pathOf, round, s } from "../figures/drawing.js";
import { picture } from "./picture.js";

const SIDE = 480; // of the picture
const WORDS = 62; // letters of a line below it

export function saveStep(run, k, { outlines }) {
  const drawing = stepDrawing(run, k, outlines);
  offer(`${run.name}-${k}.svg`.replace(/[^\w.-]+/g, "-"), "image/svg+xml",
    new XMLSerializer().serializeToString(drawing));
}

// An SVG of step k on white paper; withWords: what is said stands below.
export function stepDrawing(run, k, outlines = true, withWords = true) {
  setPaper(true);
  const unit = SIDE / run.width, high = unit * run.height;
  const e = k > 0 && k <= run.trace.kept && k < run.n ? run.event(k - 1) : null;
  const lines = withWords ? textOf(run, k, e) : [];
  const drawing = s("svg", { xmlns: NAMES, viewBox: `0 0 ${SIDE} ${round(high) +
    (withWords ? 20 + 18 * lines.length : 0)}`, width: SIDE, "font-family": "sans-serif",
    role: "img", "aria-label": `Step ${k} of ${run.title}` },
  s("rect", { width: "100%", height: "100%", fill: colourOf("--paper") }),
  s("image", { href: painted(run, k), width: SIDE, height: round(high) }),
  outlines ? s("path", { d: run.header.faces.map(([, , , , polygon]) =>
    pathOf(scaled(polygon, unit))).join(""), fill: "none",
  stroke: colourOf("--ink"), "stroke-opacity": 0.22, "stroke-width": 0.8 }) : null,
  e ? marks(run, e, unit) : null,
  lines.map((line, n) => s("text", { x: 0, y: round(high) + 20 + 18 * n,
    "font-size": 13, "font-weight": n ? null : "bold", fill: colourOf("--ink") },
  line)));
  setPaper(false);
  return drawing;
}

const NAMES = s("svg", {}).namespaceURI;

const scaled = (points, unit) => points.map(([x, y]) => [x * unit, y * unit]);

function marks(run, e, unit) {
  const { a, b, where } = looksOf(run, e);
  const colour = e.kind in KINDS ? kindColour(e.kind) : colourOf("--ink");
  return [...b, ...a, ...where, ...markerLooks(run, e)].flatMap((shape) => {
    const own = shape.role === "ink" ? colourOf("--ink") : colour;
    if (shape.ring) return [s("circle", { cx: round(shape.ring[0] * unit),
      cy: round(shape.ring[1] * unit), r: 5, fill: "none", stroke: own,
      "stroke-width": 2.5 })];
    const d = pathOf(scaled(shape.points, unit), !shape.closed);
    const dash = shape.dotted ? "2 4" : shape.dashed ? "6 4" : null;
    return [shape.fill ? s("path", { d, fill: own, "fill-opacity":
      shape.fill * (shape.dashed ? 0.6 : 1) }) : null,
    shape.width ? s("path", { d, fill: "none", stroke: colourOf("--paper"),
      "stroke-opacity": 0.75, "stroke-width": shape.width + 2.5,
      "stroke-dasharray": dash }) : null,
    shape.width ? s("path", { d, fill: "none", stroke: own, "stroke-width":
      shape.width, "stroke-dasharray": dash }) : null].filter(Boolean);
  });
}

// What is painted so far, as an image; drawn twice as fine as it is shown.
function painted(run, k) {
  const canvas = document.createElement("canvas");
  canvas.width = 2 * SIDE;
  canvas.height = Math.round(canvas.width * run.height / run.width);
  picture(canvas, run).draw(k, { outlines: false, event: false });
  return canvas.toDataURL();
}

// The caption and the sentence, in lines.
function textOf(run, k, e) {
  const say = momentsOf(run).find((m) => m.k === k)?.say;
  const words = e ? eventWords(run, e) : k ? "" : "Before the first step";
  return [`${run.title}, step ${k}`, ...broken(say), ...broken(words)];
}

function broken(text) {
  const lines = [];
  for (const word of (text ?? "").split(" ").filter(Boolean)) {
    if (lines.length && lines.at(-1).length + word.length < WORDS)
      lines[lines.length - 1] += ` ${word}`;
    else lines.push(word);
  }
  return lines;
}
