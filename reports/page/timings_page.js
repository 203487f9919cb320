// SPDX-License-Identifier: GPL-3.0-or-later
// Every cell that was timed, and the ratios to the baseline.
import { h, link, section } from "./dom.js";
import { href } from "./address.js";
import { timeColumns } from "./algorithm_page.js";
import { chosen, filterForm, placeColumns } from "./filters.js";
import { digits, interval, seconds, where, whole } from "./format.js";
import { key } from "./looks.js";
import { figure, stripPlot } from "./plots.js";
import { behind, table } from "./table.js";

const FILTERS = ["view", "size", "class"];

export function timingsPage(report) {
  const timed = report.cells.filter((c) => c.seconds);
  const results = h("div");
  const update = () => results.replaceChildren(
    ...show(report, chosen(report, timed, FILTERS)).filter(Boolean));
  update();
  return { title: "How fast they are", body: [
    h("p", { class: "lead" }, "Seconds a frame, from the scene in memory to " +
      "the last face id, only for pictures that equal the oracle’s. Medians, " +
      "with 95 % intervals by bootstrap."),
    timed.length ? filterForm(report, timed, FILTERS, update)
      : h("p", {}, "Nothing was timed."),
    results,
  ] };
}

function show(report, cells) {
  if (!cells.length) return [h("p", {}, "These filters leave nothing.")];
  const modules = cells.filter((c) => !c.peer);
  const peers = cells.filter((c) => c.peer);
  const plotted = drawing(report, cells).map((c) => ({ ...c, ...c.seconds,
    value: c.seconds.median, title: `${c.algorithm}\n${where(c)}\n${
      interval(c.seconds.median, c.seconds.low, c.seconds.high, seconds)}` }));
  return [
    plotted.length ? figure({
      caption: "Seconds a frame: a mark for each cell, a bar for its 95 % interval.",
      draw: (width) =>
        stripPlot(plotted, "seconds a frame →", width, seconds) }) : null,
    modules.length ? section("The algorithms", "modules",
      table({ id: "modules", caption: "Seconds a frame of the algorithms",
        rows: modules, columns: [algorithmColumn, ...placeColumns,
          ...timeColumns(report, modules)] })) : null,
    peers.length ? section("Peers", "peers",
      h("p", {}, "Other people’s renderers, which need not draw the correct " +
        "picture. The number of samples that differ is beside their times."),
      table({ id: "peers", caption: "Seconds a frame of peers", rows: peers,
        columns: [algorithmColumn, ...placeColumns,
          { name: "mismatches", label: "samples that differ", number: true,
            value: (c) => c.mismatches ?? null,
            show: (c) => `${whole(c.mismatches)} of ${whole(c.compared)}` },
          ...timeColumns(report, peers)] })) : null,
    means(report, new Set(cells.map((c) => c.algorithm))),
  ];
}

// In the order of the algorithms, without the one that draws nothing: it would
// squeeze all others together.
function drawing(report, cells) {
  const names = report.algorithms.map((a) => a.name);
  return cells.filter((c) => report.draws(c.algorithm)).sort((a, b) =>
    names.indexOf(a.algorithm) - names.indexOf(b.algorithm));
}

const algorithmColumn = { name: "algorithm", label: "algorithm",
  value: (r) => r.algorithm,
  show: (r) => link(href("algorithm", r.algorithm), key(r.algorithm),
    r.algorithm) };

// Over all cells, whatever the filters choose, but only for algorithms shown.
function means(report, names) {
  const rows = report.geometric.filter((g) => names.has(g.algorithm));
  if (!rows.length) return null;
  const plotted = drawing(report, rows).map((g) => ({ ...g, value: g.ratio,
    title: `${g.algorithm}\n${interval(g.ratio, g.low, g.high)}` }));
  return section(`Beside ${report.baseline ?? "the baseline"}`, "means",
    h("p", {}, "Geometric means of the ratios over all cells that both " +
      "solved, whatever scenes are chosen above. Over 1 is slower."),
    figure({ caption: `Time of each algorithm, that of ${
      report.baseline ?? "the baseline"} being 1.`,
    draw: (width) => stripPlot(plotted, "ratio →", width, digits, 1),
    numbers: behind(table({ id: "means", caption: "Geometric means of ratios",
      rows, columns: [algorithmColumn,
        { name: "cells", label: "cells", number: true, value: (g) => g.cells },
        { name: "ratio", label: "ratio", number: true, value: (g) => g.ratio,
          show: (g) => digits(g.ratio) },
        { name: "low", label: "at least", number: true,
          value: (g) => g.low ?? null, show: (g) => digits(g.low) },
        { name: "high", label: "at most", number: true,
          value: (g) => g.high ?? null, show: (g) => digits(g.high) }] })) }));
}
