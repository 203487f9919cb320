// SPDX-License-Identifier: GPL-3.0-or-later
// Plots, all by Observable Plot. Each has its numbers in a folded table.
import * as Plot from "@observablehq/plot";
import {
  count, digits, seconds, shortened, where,
} from "../data/format.js";
import { href } from "../data/address.js";
import { key, looks, looksByNumber } from "../data/looks.js";
import { unique } from "../data/model.js";
import { h, link } from "./dom.js";
import { saveSvg } from "./save.js";

// More marks than these would be slow, and nobody could tell them apart.
const MANY_MARKS = 3000;

// The marks that are drawn, and a sentence on those that are not.
export function drawable(marks) {
  return { marks: marks.slice(0, MANY_MARKS),
    missing: marks.length > MANY_MARKS ? ` Only the first ${MANY_MARKS} of ${
      marks.length} marks are drawn; the filters choose others.` : "" };
}

// A plot in the width given, with a caption, its legend, and its table. keys: the
// legend, [{ looks, label, to: an address or nothing }].
export function figure({ caption, draw, keys = [], numbers }) {
  const box = h("div", { class: "plot" });
  let drawn = 0;
  new ResizeObserver(([entry]) => {
    const width = Math.round(entry.contentRect.width);
    if (width === 0 || width === drawn) return;
    drawn = width;
    const plot = draw(Math.min(width, 900));
    for (const part of plot.querySelectorAll("[aria-label]"))
      part.removeAttribute("aria-label"); // Plot's names of marks say nothing
    plot.setAttribute("role", "img");
    plot.setAttribute("aria-label", caption);
    box.replaceChildren(plot);
  }).observe(box);
  return h("figure", {}, box, legend(keys), h("figcaption", {}, caption),
    h("p", { class: "more" }, saveSvg(caption,
      () => box.querySelector("svg"),
      keys.map((k) => ({ key: key(k.looks), label: k.label })))), numbers);
}

function legend(keys) {
  return keys.length ? h("ul", { class: "legend" },
    keys.map(({ looks: own, label, to }) => h("li", {}, to
      ? link(to, key(own), label) : [key(own), label]))) : null;
}

export function algorithmKeys(names) {
  return names.map((name) => ({ looks: looks(name), label: name,
    to: href("algorithm", name) }));
}

export function keysByNumber(names) {
  return names.map((name, k) => ({ looks: looksByNumber(k), label: name }));
}

// A number on an axis: 10K, not 10.0K.
const short = (show) => (x) => show(x).replace(/\.0+(?=\D|$)/, "");

const style = { background: "transparent", fontSize: "12px", overflow: "visible" };

// Lines through marks, both axes logarithmic. lines: [{ looks, points: [{ x, y,
// low, high, line, title }], behind }]; points of one `line` are joined. behind: those
// of a broad line behind them, in order.
function lines(all, x, y, width,
  height = Math.min(560, Math.max(340, 0.6 * width))) {
  const points = all.flatMap((l) => l.points);
  const marks = all.flatMap(({ looks: { colour, symbol, dash }, points: own,
    behind = [] }) => {
    const sorted = [...own].sort((a, b) => a.x - b.x);
    return [
      Plot.line(behind, { x: "x", y: "y", stroke: colour, strokeWidth: 6,
        strokeOpacity: 0.25 }),
      Plot.line(sorted, { x: "x", y: "y", z: "line", stroke: colour,
        strokeDasharray: dash, strokeWidth: 1.5 }),
      Plot.ruleX(sorted.filter((p) => p.low > 0), { x: "x", y1: "low",
        y2: "high", stroke: colour, strokeWidth: 3, strokeOpacity: 0.5 }),
      Plot.dot(sorted, { x: "x", y: "y", symbol, fill: colour, r: 4 }),
    ];
  });
  return Plot.plot({
    width, height, style,
    marginLeft: 52, marginRight: 16, marginBottom: 42,
    x: { type: "log", label: x, ticks: decades(points.map((p) => p.x), width - 70),
      tickFormat: short(count), grid: true, nice: false },
    y: { type: "log", label: y.label, grid: true,
      ticks: decades(points.map((p) => p.y)), tickFormat: short(y.show) },
    marks: [...marks, Plot.tip(points, Plot.pointer({ x: "x", y: "y",
      title: (p) => p.title }))],
  });
}

// What grows over x: a line for each algorithm and ladder. y: { label, show }.
export function sweepPlot(points, x, y, width) {
  return lines(unique(points.map((p) => p.algorithm)).map((name) => ({
    looks: looks(name), points: points.filter((p) => p.algorithm === name)
      .map((p) => ({ ...p, line: p.ladder, title: `${p.algorithm}\n${where(p)}\n${
        y.show(p.y)} at ${count(p.x)}` })) })), x, y, width);
}

// A line for each counter. points: { counter, x, y, place }.
export function countPlot(points, counters, width) {
  return lines(counters.map((counter, k) => ({ looks: looksByNumber(k),
    points: points.filter((p) => p.counter === counter).map((p) => ({ ...p,
      line: counter, title: `${counter}\n${p.place}\n${count(p.y)} at ${
        count(p.x)} faces` })) })),
  "relevant faces →", { label: "↑ counts", show: count }, width);
}

// What algorithms count as N grows, each over what is predicted of it. points:
// [{ algorithm, looks, x, y, predicted: or null }], above 0.
export function growthPlot(points, x, y, width, height) {
  const sorted = points.filter((p) => p.y > 0).sort((a, b) => a.x - b.x);
  return lines(unique(sorted.map((p) => p.algorithm)).map((name) => {
    const own = sorted.filter((p) => p.algorithm === name);
    return { looks: own[0].looks,
      behind: own.filter((p) => p.predicted > 0).map((p) => ({ x: p.x,
        y: p.predicted })),
      points: own.map((p) => ({ ...p, line: name, title: `${name}\n${y.show(p.y)} at ${
        count(p.x)}${p.predicted > 0 ? `\npredicted ${y.show(p.predicted)}` : ""}` })) };
  }), x, y, width, height);
}

// As many powers of ten as have room; if there are too few, steps between them.
function decades(values, width = 600) {
  const there = values.filter((v) => v > 0);
  const low = Math.min(...there), high = Math.max(...there);
  const room = Math.max(2, Math.floor(width / 50));
  const ticks = (steps, every = 1) => {
    const all = [];
    for (let e = Math.floor(Math.log10(low)); e <= Math.log10(high); e++)
      if (e % every === 0) all.push(...steps.map((s) => s * 10 ** e));
    return all.filter((t) => t >= 0.999 * low && t <= 1.001 * high);
  };
  const sparse = ticks([1]);
  if (sparse.length > room) return ticks([1], Math.ceil(sparse.length / room));
  return [sparse, ticks([1, 2, 5]), ticks([1, 1.5, 2, 3, 4, 5, 6, 7, 8])]
    .find((list) => list.length >= 3 && list.length <= room) ?? sparse;
}

// For labels on the left.
const LETTERS = 28;
const label = (name) => shortened(name, LETTERS);
function marginFor(labels) {
  return 16 + 6.8 * Math.min(LETTERS, Math.max(...labels.map((l) => l.length)));
}

// A row for each algorithm, the fastest first: a mark for each of its values,
// and a bar for the interval. `things` have looks: rows: { algorithm, value, low,
// high, thing, title }. Without things, algorithms have.
export function stripPlot(rows, x, width, show, { things, reference } = {}) {
  const names = byValue(rows);
  const margin = marginFor(names);
  const groups = things ? things.map((thing, k) => [looksByNumber(k),
    rows.filter((r) => r.thing === thing)])
    : names.map((name) => [looks(name),
      rows.filter((r) => r.algorithm === name)]);
  return Plot.plot({
    width, height: 60 + 20 * names.length, style, marginLeft: margin,
    marginRight: 20, marginTop: 8, marginBottom: 40,
    x: { type: "log", label: x, grid: true, tickFormat: short(show),
      ticks: decades(rows.map((r) => r.value), width - margin - 20) },
    y: { label: null, domain: names, tickSize: 0, tickFormat: label },
    marks: [
      reference ? Plot.ruleX([reference],
        { stroke: "currentColor", strokeDasharray: "3 3" }) : null,
      Plot.gridY({ strokeOpacity: 0.06 }),
      groups.map(([{ colour, symbol }, own]) => [
        Plot.ruleY(own.filter((r) => r.low > 0), { y: "algorithm", x1: "low",
          x2: "high", stroke: colour, strokeWidth: 4, strokeOpacity: 0.45 }),
        Plot.dot(own, { y: "algorithm", x: "value", symbol, fill: colour,
          r: 4 }),
      ]),
      Plot.tip(rows, Plot.pointer({ x: "value", y: "algorithm",
        title: (r) => r.title })),
    ],
  });
}

// The names by the mean of the logarithms of their values.
function byValue(rows) {
  const sums = new Map();
  for (const { algorithm, value } of rows) {
    const [sum, n] = sums.get(algorithm) ?? [0, 0];
    sums.set(algorithm, [sum + Math.log(value), n + 1]);
  }
  return [...sums].sort(([, [a, n]], [, [b, m]]) => a / n - b / m)
    .map(([name]) => name);
}

// The prediction (ring) and the measurement (filled): a row for each step, a
// field for each environment. rows: { environment, step, predicted, measured }.
export function stepPlot(rows, name, width) {
  const { colour } = looks(name);
  const pairs = rows.filter((r) => r.predicted > 0 && r.measured > 0);
  const steps = unique(rows.map((r) => r.step));
  const fields = unique(rows.map((r) => r.environment));
  const margin = marginFor(steps);
  const place = { y: "step", fy: "environment" };
  return Plot.plot({
    width, height: 70 + fields.length * 1.45 * 20 * steps.length, style,
    marginLeft: margin, marginRight: 20, marginTop: 24, marginBottom: 40,
    x: { type: "log", label: "comparisons →", grid: true, tickFormat: short(count),
      ticks: decades(rows.flatMap((r) => [r.predicted, r.measured]),
        width - margin - 20) },
    y: { label: null, domain: steps, tickSize: 0, tickFormat: label },
    fy: { label: null, domain: fields, axis: null, padding: 0.3 },
    marks: [
      Plot.gridY({ strokeOpacity: 0.06 }),
      Plot.text(fields, { fy: (d) => d, text: (d) => d, frameAnchor: "top-left",
        dx: 4 - margin, dy: -18, fontWeight: "bold" }),
      Plot.link(pairs, { ...place, x1: "predicted", x2: "measured",
        y1: "step", y2: "step", stroke: colour, strokeOpacity: 0.5 }),
      Plot.dot(rows.filter((r) => r.predicted > 0),
        { ...place, x: "predicted", r: 5, stroke: colour, strokeWidth: 1.5 }),
      Plot.dot(rows.filter((r) => r.measured > 0),
        { ...place, x: "measured", r: 4, fill: colour }),
      Plot.tip(pairs, Plot.pointer({ ...place, x: "measured", title: (r) =>
        `${r.step}, ${r.environment}\nmeasured ${count(r.measured)}, ` +
        `predicted ${count(r.predicted)}\nratio ${
          digits(r.measured / r.predicted)}` })),
    ],
  });
}
