// SPDX-License-Identifier: GPL-3.0-or-later
// What an algorithm has counted in the picture, live, and what the survey predicts.
import { kindLook } from "../../lesson/data/kinds.js";
import { count, whole } from "../../page/data/format.js";
import { h } from "../../page/parts/dom.js";
import { formula } from "../../page/parts/symbols.js";

// lab.state.held has the counts that the reader holds.
export function countTable({ name, counters }, lab) {
  const cells = counters.map(rowOfCells), all = rowOfCells();
  const rows = counters.map((c, k) => {
    const { sign, hue } = kindLook(c.step);
    return h("tr", { title: c.meaning, hidden: true }, h("th", { scope: "row" },
      h("span", { class: "sign", "aria-hidden": "true",
        style: `color: var(--hue-${hue})` }, sign), c.name), cells[k]);
  });
  const head = h("thead", {}, h("tr", {}, ["", "now", "held", "ratio"].map((text) =>
    h("th", { scope: "col", class: "number" }, text))));
  const predicted = h("div", { class: "predicted" });
  const table = h("table", { class: "counters", hidden: true,
    "aria-label": `What ${name} has counted` }, head,
  h("tbody", {}, rows),
  h("tfoot", {}, h("tr", {}, h("th", { scope: "row" }, "all comparisons"), all)));
  const holder = h("button", { type: "button", class: "quiet hold", hidden: true,
    onclick: () => hold(!lab.state.held.has(name)) });
  let now = null;

  const hold = (is) => {
    const { held } = lab.state;
    if (is) held.set(name, now);
    else held.delete(name);
    lab.set({ held, holds: is && lab.state.holds });
    show(now);
  };

  // isWhole: not of a picture that moves, or comes before another.
  const show = (counts, isWhole) => {
    now = counts;
    if (isWhole && lab.state.holds && !lab.state.held.has(name)) return hold(true);
    const kept = lab.state.held.get(name);
    const old = kept?.length === counts.length ? kept : undefined;
    table.hidden = holder.hidden = false;
    head.hidden = !old;
    holder.textContent = old ? "Hold them no more" : "Hold these counts";
    holder.title = old ? "" : "See beside them what the next pictures count";
    counts.forEach((x, k) => {
      rows[k].hidden = !x && !old?.[k];
      fill(cells[k], x, old?.[k]);
    });
    fill(all, comparisons(counters, counts), old && comparisons(counters, old));
  };
  return { element: h("div", { class: "counted" }, table, holder, predicted), show,
    clear: () => {
      table.hidden = holder.hidden = true;
      predicted.replaceChildren();
    },
    predict: (costs) => predicted.replaceChildren(costs?.some((c) =>
      c.predicted !== null) ? costTable(costs) : "") };
}

const rowOfCells = () => [0, 1, 2].map(() => h("td", { class: "number" }));

// A count, the one that is held, and their ratio; undefined: none is held.
function fill([now, held, ratio], x, old) {
  now.textContent = whole(x);
  held.hidden = ratio.hidden = old === undefined;
  held.textContent = old === undefined ? "" : whole(old);
  ratio.textContent = old ? (x / old).toFixed(2) : "";
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
