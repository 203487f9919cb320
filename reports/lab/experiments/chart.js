// SPDX-License-Identifier: GPL-3.0-or-later
// The chart of an experiment, with its numbers in a table.
import { count, seconds, whole } from "../../page/data/format.js";
import { looks } from "../../page/data/looks.js";
import { h } from "../../page/parts/dom.js";
import { figure, growthPlot } from "../../page/parts/plots.js";
import { saveCsv } from "../../page/parts/save.js";
import { plainName } from "../views/algorithms.js";
import { labelOf } from "./values.js";

// rows: [{ algorithm, x, y, predicted }]; x: its label; of: the scene; height: pixels.
export function chart(rows, { x, of, what, height }) {
  const show = what === "seconds" ? seconds : count;
  const names = [...new Set(rows.map((r) => r.algorithm))];
  const caption = `${labelOf(what)} of ${names.join(" and ")} over ${x}: ${of}`;
  const shown = rows.map((r) => ({ ...r, looks: looks(plainName(r.algorithm)) }));
  return figure({ caption: caption.charAt(0).toUpperCase() + caption.slice(1),
    draw: (width) => growthPlot(shown, `${x} →`, { label: `↑ ${labelOf(what)}`, show },
      width, height),
    keys: names.map((name) => ({ looks: looks(plainName(name)), label: name +
      (rows.some((r) => r.algorithm === name && r.predicted > 0) ? "; broad and pale: " +
        "what the survey predicts" : "") })),
    numbers: numbers(rows, ["algorithm", x, labelOf(what), "predicted by the survey"],
      show, caption) });
}

function numbers(rows, heads, show, caption) {
  const cells = rows.map((r) => [r.algorithm, r.x, r.y, r.predicted]);
  const row = ([name, x, ...values]) => h("tr", {}, h("th", { scope: "row" }, name),
    h("td", { class: "number" }, whole(x)),
    values.map((y) => h("td", { class: "number" }, show(y))));
  return h("details", { class: "numbers" }, h("summary", {}, "The numbers"),
    h("p", {}, "A dash: the survey has no formula for it."),
    saveCsv(caption, () => [heads, ...cells]),
    h("table", {}, h("thead", {}, h("tr", {}, heads.map((text) =>
      h("th", { scope: "col" }, text)))), h("tbody", {}, cells.map(row))));
}
