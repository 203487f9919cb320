// SPDX-License-Identifier: GPL-3.0-or-later
// Plots, all by Observable Plot. Each has its numbers in a folded table.
import * as Plot from "@observablehq/plot";
import { h, link } from "./dom.js";
import { count, digits, seconds, where } from "./format.js";
import { href } from "./address.js";
import { key, looks } from "./looks.js";
import { unique } from "./model.js";

// A plot in the width given, with a caption of one sentence, the meaning of its
// lines, and its table.
export function figure({ caption, draw, algorithms = [], numbers }) {
  const box = h("div", { class: "plot" });
  let drawn = 0;
  new ResizeObserver(([entry]) => {
    const width = Math.round(entry.contentRect.width);
    if (width === 0 || width === drawn) return;
    drawn = width;
    const plot = draw(Math.min(width, 900));
    plot.setAttribute("role", "img");
    plot.setAttribute("aria-label", caption);
    box.replaceChildren(plot);
  }).observe(box);
  return h("figure", {}, box, legend(algorithms),
    h("figcaption", {}, caption), numbers);
}

function legend(names) {
  return names.length ? h("ul", { class: "legend" }, names.map((name) =>
    h("li", {}, link(href("algorithm", name), key(name), name)))) : null;
}

// A number on an axis: 10K, not 10.0K.
const short = (show) => (x) => show(x).replace(/\.0+(?=\D|$)/, "");

const style = { background: "transparent", fontSize: "12px", overflow: "visible" };

// Seconds over something that grows, both logarithmic. points: { algorithm,
// ladder, x, seconds, low, high, scene, view, ... }.
export function sweepPlot(points, label, width) {
  const lines = unique(points.map((p) => p.algorithm)).flatMap((name) => {
    const { colour, symbol, dash } = looks(name);
    const own = points.filter((p) => p.algorithm === name)
      .sort((a, b) => a.x - b.x);
    return [
      Plot.line(own, { x: "x", y: "seconds", z: "ladder", stroke: colour,
        strokeDasharray: dash, strokeWidth: 1.5 }),
      Plot.ruleX(own.filter((p) => p.low > 0), { x: "x", y1: "low", y2: "high",
        stroke: colour, strokeWidth: 3, strokeOpacity: 0.5 }),
      Plot.dot(own, { x: "x", y: "seconds", symbol, fill: colour, r: 4 }),
    ];
  });
  return Plot.plot({
    width, height: Math.min(560, Math.max(340, 0.6 * width)), style,
    marginLeft: 52, marginRight: 16, marginBottom: 42,
    x: { type: "log", label, ticks: decades(points.map((p) => p.x), width - 70),
      tickFormat: short(count), grid: true, nice: false },
    y: { type: "log", label: "↑ seconds a frame", grid: true,
      ticks: decades(points.map((p) => p.seconds)), tickFormat: short(seconds) },
    marks: [...lines, Plot.tip(points, Plot.pointer({ x: "x", y: "seconds",
      title: (p) => `${p.algorithm}\n${where(p)}\n${seconds(p.seconds)} at ${
        count(p.x)}` }))],
  });
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
function marginFor(labels) {
  return 16 + 6.8 * Math.max(...labels.map((label) => label.length));
}

// A row for each algorithm: every cell's median as a dot, its interval as a bar.
export function stripPlot(rows, label, width, show, reference = null) {
  const names = unique(rows.map((r) => r.algorithm));
  const margin = marginFor(names);
  const marks = names.flatMap((name) => {
    const { colour, symbol } = looks(name);
    const own = rows.filter((r) => r.algorithm === name);
    return [
      Plot.ruleY(own.filter((r) => r.low > 0), { y: "algorithm", x1: "low",
        x2: "high", stroke: colour, strokeWidth: 4, strokeOpacity: 0.45 }),
      Plot.dot(own, { y: "algorithm", x: "value", symbol, fill: colour,
        r: 4 }),
    ];
  });
  return Plot.plot({
    width, height: 60 + 20 * names.length, style, marginLeft: margin,
    marginRight: 20, marginTop: 8, marginBottom: 40,
    x: { type: "log", label, grid: true, tickFormat: short(show),
      ticks: decades(rows.map((r) => r.value), width - margin - 20) },
    y: { label: null, domain: names, tickSize: 0 },
    marks: [
      reference === null ? null : Plot.ruleX([reference],
        { stroke: "currentColor", strokeDasharray: "3 3" }),
      Plot.gridY({ strokeOpacity: 0.06 }),
      marks,
      Plot.tip(rows, Plot.pointer({ x: "value", y: "algorithm",
        title: (r) => r.title })),
    ],
  });
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
    y: { label: null, domain: steps, tickSize: 0 },
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
