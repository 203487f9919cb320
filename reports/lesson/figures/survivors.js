// SPDX-License-Identifier: GPL-3.0-or-later
// What each of the ten algorithms has left to do after each cull and sort, on one
// scene: a row for each, a bar for each step of Table III in its order, as measured;
// a ring shows what the survey predicts. The scale is logarithmic.
import { count } from "../../page/data/format.js";
import { h } from "../../page/parts/dom.js";
import { saveSvg } from "../../page/parts/save.js";
import { formula } from "../../page/parts/symbols.js";
import { board, line, s, text } from "./drawing.js";

const LEFT = 92, STEP = 128, HIGH = 62, BAR = 34;

// survivors: as bench/lesson writes it.
export function survivorsFigure({ scene, algorithms, letters }) {
  const rows = algorithms.map((a) => ({ name: a.name, steps: a.costs.map((c) =>
    ({ label: c.label, predicted: c.predicted, measured: c.terms.reduce((sum, [n, f]) =>
      sum + f * a.counts[n], 0) })).filter((x) => x.measured || x.predicted) }));
  const most = Math.max(...rows.flatMap(({ steps }) => steps.flatMap((x) =>
    [x.measured, x.predicted ?? 0])));
  const size = (x) => x > 0 ? Math.max(1, BAR * Math.log10(x) / Math.log10(most)) : 0;
  const wide = LEFT + STEP * Math.max(...rows.map(({ steps }) => steps.length));
  const drawing = board(wide, HIGH * rows.length + 8, "The work of each step of the " +
    `ten algorithms on ${scene}, measured and predicted`,
  ...rows.flatMap((row, r) => rowShapes(row, HIGH * r, size)));
  drawing.setAttribute("width", wide);
  drawing.setAttribute("height", HIGH * rows.length + 8);
  const caption = `What is left after each cull and sort: ${scene}`;
  return h("section", { class: "survivors" }, h("h2", {}, "What is left after each " +
    "cull and sort"),
  h("p", {}, "Hidden-surface removal is sorting. Each algorithm goes from left to " +
    "right. A bar is the work of a step, weighed as in the survey’s Table III, on a " +
    "logarithmic scale; the ring is the survey’s prediction for this scene. A good " +
    "cull leaves little for the next step."),
  h("figure", { class: "taxonomy" }, h("div", { class: "scroll", tabindex: 0,
    role: "region", "aria-label": "The work of each step" }, drawing),
  h("figcaption", {}, `${caption}. `, saveSvg(caption, () => drawing, []))),
  lettersLine(letters));
}

function rowShapes({ name, steps }, top, size) {
  const foot = top + HIGH - 22;
  return [text(0, foot - 4, name, { "text-anchor": "start", "font-size": 13 }),
    ...steps.flatMap((step, k) => stepShapes(step, LEFT + STEP * k, foot, size))];
}

function stepShapes({ label, measured, predicted }, x, foot, size) {
  return [line(x, foot, x + STEP - 8, foot, { stroke: "var(--line)" }),
    s("rect", { x, y: foot - size(measured), width: 22, height: size(measured),
      fill: "var(--hue-0)" }),
    predicted ? s("circle", { cx: x + 11, cy: foot - size(predicted), r: 4,
      fill: "var(--paper)", stroke: "var(--hue-1)", "stroke-width": 2 }) : null,
    text(x + 28, foot - 4, count(measured), { "text-anchor": "start" }),
    predicted ? text(x + 28, foot - 18, count(predicted), { "text-anchor": "start",
      fill: "var(--hue-1)" }) : null,
    text(x, foot + 13, label, { "text-anchor": "start", "font-size": 9,
      fill: "var(--faint)" })].filter(Boolean);
}

// What is left of the faces and edges, as Table I has it.
function lettersLine(letters) {
  const of = (symbol) => letters.find(([name]) => name === symbol);
  const chain = (...symbols) => symbols.map(of).filter((l) => l && l[2] !== null)
    .map(([symbol, meaning, value], k) => [k ? " → " : "", h("abbr",
      { title: meaning }, formula(symbol)), ` ${count(value)}`]);
  return h("p", {}, "Measured here. Faces: ", chain("F_t", "F_r"), ". Edges: ",
    chain("E_t", "E_r", "E_s", "E_c"), ". Segments on a scan line: ",
    chain("S_l", "S_v"), ".");
}
