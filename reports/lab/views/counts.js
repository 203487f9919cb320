// SPDX-License-Identifier: GPL-3.0-or-later
// What an algorithm has counted in the picture, live, and what the survey predicts.
import { kindLook } from "../../lesson/data/kinds.js";
import { count, whole } from "../../page/data/format.js";
import { h } from "../../page/parts/dom.js";
import { formula } from "../../page/parts/symbols.js";

export function countTable({ name, counters }) {
  const cells = counters.map(() => h("td", { class: "number" }));
  const rows = counters.map((c, k) => {
    const { sign, hue } = kindLook(c.step);
    return h("tr", { title: c.meaning, hidden: true }, h("th", { scope: "row" },
      h("span", { class: "sign", "aria-hidden": "true",
        style: `color: var(--hue-${hue})` }, sign), c.name), cells[k]);
  });
  const all = h("td", { class: "number" });
  const predicted = h("div", { class: "predicted" });
  const table = h("table", { class: "counters", hidden: true,
    "aria-label": `What ${name} has counted` },
  h("tbody", {}, rows),
  h("tfoot", {}, h("tr", {}, h("th", { scope: "row" }, "all comparisons"), all)));

  const show = (counts) => {
    table.hidden = false;
    counts.forEach((x, k) => {
      rows[k].hidden = !x;
      cells[k].textContent = whole(x);
    });
    all.textContent = whole(comparisons(counters, counts));
  };
  return { element: h("div", { class: "counted" }, table, predicted), show,
    clear: () => { table.hidden = true; predicted.replaceChildren(); },
    predict: (costs) => predicted.replaceChildren(costs?.some((c) =>
      c.predicted !== null) ? costTable(costs) : "") };
}

const comparisons = (counters, counts) => counters.reduce((sum, c, k) =>
  sum + (c.step === "compare" ? counts[k] : 0), 0);

// costs: [{ label, measured, predicted, formula }]
function costTable(costs) {
  return h("table", { class: "costs", "aria-label": "Steps of Table III" },
    h("thead", {}, h("tr", {}, ["step of Table III", "counted, weighed", "predicted"]
      .map((text, k) => h("th", { scope: "col", class: k ? "number" : null }, text)))),
    h("tbody", {}, costs.map((c) => h("tr", { title: c.formula ?? "" },
      h("th", { scope: "row" }, c.label, c.formula
        ? [h("br"), h("small", {}, formula(c.formula))] : null),
      h("td", { class: "number" }, count(c.measured)),
      h("td", { class: "number" }, count(c.predicted))))));
}
