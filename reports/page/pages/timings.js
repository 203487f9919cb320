// SPDX-License-Identifier: GPL-3.0-or-later
// Every cell that was timed, and the ratios to the baseline.
import { digits, interval, seconds, where, whole } from "../data/format.js";
import { unique } from "../data/model.js";
import {
  algorithmColumn, placeColumns, timeColumns,
} from "../parts/columns.js";
import { h, section } from "../parts/dom.js";
import { chosen, filterForm } from "../parts/filters.js";
import { drawable, figure, keysByNumber, stripPlot } from "../parts/plots.js";
import { behind, table } from "../parts/table.js";

const FILTERS = ["view", "size", "class"];
const MOST_PLACES = 64; // that have looks of their own

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
  return [
    plot(report, cells),
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
            value: (c) => c.mismatches,
            show: (c) => `${whole(c.mismatches)} of ${whole(c.compared)}` },
          ...timeColumns(report, peers)] })) : null,
    means(report, new Set(cells.map((c) => c.algorithm))),
  ];
}

// A row for each algorithm, and a mark for each place. Places without looks of
// their own are left out, and what draws nothing: it would squeeze all others
// together.
function plot(report, cells) {
  const drawn = cells.filter((c) => report.draws(c.algorithm));
  const places = unique(drawn.map((c) => c.place));
  const shown = new Set(places.slice(0, MOST_PLACES));
  const { marks, missing } = drawable(drawn.filter((c) => shown.has(c.place)));
  if (!marks.length) return null;
  const rows = marks.map((c) => ({ ...c, ...c.seconds, thing: c.place,
    title: `${c.algorithm}\n${where(c)}\n${
      interval(c.seconds.value, c.seconds.low, c.seconds.high, seconds)}` }));
  const first = new Map([...marks].reverse().map((c) => [c.place, c]));
  const things = places.filter((p) => first.has(p));
  const left = places.length - things.length;
  return figure({
    caption: "Seconds a frame: a mark for each cell, a bar for its 95 % " +
      "interval. The algorithm with the least mean comes first." + (left
        ? ` ${left} more views are left out; the filters choose them.` : "") +
      missing,
    draw: (width) => stripPlot(rows, "seconds a frame →", width, seconds,
      { things }),
    keys: keysByNumber(things.map((p) => where(first.get(p)))) });
}

// Over all cells, whatever the filters choose, but only for algorithms shown.
function means(report, names) {
  const rows = report.geometric.filter((g) => names.has(g.algorithm));
  if (!rows.length) return null;
  const plotted = rows.filter((g) => report.draws(g.algorithm)).map((g) => ({
    ...g, value: g.ratio,
    title: `${g.algorithm}\n${interval(g.ratio, g.low, g.high)}` }));
  const column = (name, label) => ({ name, label, number: true,
    value: (g) => g[name] ?? null, show: (g) => digits(g[name]) });
  return section(`Beside ${report.baseline ?? "the baseline"}`, "means",
    h("p", {}, "Geometric means of the ratios over all cells that both " +
      "solved, whatever scenes are chosen above. Over 1 is slower."),
    figure({ caption: `Time of each algorithm, that of ${
      report.baseline ?? "the baseline"} being 1.`,
    draw: (width) => stripPlot(plotted, "ratio →", width, digits,
      { reference: 1 }),
    numbers: behind(table({ id: "means", caption: "Geometric means of ratios",
      rows, columns: [algorithmColumn,
        { name: "cells", label: "cells", number: true, value: (g) => g.cells },
        column("ratio", "ratio"), column("low", "at least"),
        column("high", "at most")] })) }));
}
