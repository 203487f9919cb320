// SPDX-License-Identifier: GPL-3.0-or-later
// A table in a box that scrolls if the table is too large. Its columns sort it;
// the order is in the address.
import { read, set } from "../data/address.js";
import { h } from "./dom.js";
import { saveCsv } from "./save.js";

const MANY = 100; // rows that are shown at first
const MORE = 10; // how many times as many are shown when more are asked for

// columns: { name, label, value(row): the key of sorting, show(row): what is
// shown (standard: the value), csv(row): what is saved (standard: the value),
// title(row), mark(row): a class of the cell, number: true if it is aligned as a
// number, whole: true if its lines are not broken, prose: true if it holds
// sentences, group: a heading over several columns, turned: true if its label
// runs upwards }. A table without an id is not sorted. look: a class.
export function table({ id, caption, columns, rows, look }) {
  const body = h("tbody");
  const heads = columns.map((column) => headOf(id, column, () => fill()));
  const count = h("span");
  const sorted = () => {
    const sort = id ? orderOf(id) : null;
    heads.forEach((head, k) => mark(head, columns[k], sort));
    return sort ? sortRows(rows, columns, sort) : rows;
  };
  let most = MANY;

  const fill = () => {
    const shown = sorted().slice(0, most);
    body.replaceChildren(...shown.map((row) => rowOf(columns, row)));
    count.replaceChildren(...shown.length < rows.length ? [
      `${shown.length} of ${rows.length} rows. `,
      h("button", { type: "button", onclick: () => { most *= MORE; fill(); },
        class: rows.length > most * MORE ? null : "all" },
      rows.length > most * MORE ? `Show ${most * MORE}` : "Show all"), " "]
      : []);
  };
  fill();

  return h("div", { class: "table" },
    h("div", { class: "scroll", tabindex: 0, role: "region",
      "aria-label": caption },
      h("table", { id: id && `${id}-table`, class: look },
        h("caption", {}, caption),
        h("thead", {}, groups(columns), h("tr", {}, heads)), body)),
    h("p", { class: "more" }, count,
      saveCsv(caption, () => csvRows(columns, sorted()))));
}

function csvRows(columns, rows) {
  const head = ({ group, label, name }) => [group,
    typeof label === "string" ? label : name].filter(Boolean).join(": ");
  return [columns.map(head), ...rows.map((row) =>
    columns.map((column) => (column.csv ?? column.value)(row)))];
}

function headOf(id, column, fill) {
  const attributes = { scope: "col", class: column.number ? "number" : null };
  const label = column.turned
    ? h("span", { class: "turned" }, column.label) : column.label;
  if (!id) return h("th", attributes, label);
  const turn = () => {
    const now = orderOf(id);
    const down = now?.name === column.name ? !now.down : false;
    set({ [`sort-${id}`]: (down ? "-" : "") + column.name });
    fill();
  };
  return h("th", attributes,
    h("button", { type: "button", onclick: turn }, label,
      h("span", { class: "arrow", "aria-hidden": "true" })));
}

function orderOf(id) {
  const text = read().params.get(`sort-${id}`);
  return text && { name: text.replace(/^-/, ""), down: text.startsWith("-") };
}

function mark(head, column, sort) {
  if (sort?.name === column.name)
    head.setAttribute("aria-sort", sort.down ? "descending" : "ascending");
  else head.removeAttribute("aria-sort");
}

const collator = new Intl.Collator("en", { numeric: true });

// Equal rows keep their order; rows without a value come last in both orders.
function sortRows(rows, columns, { name, down }) {
  const column = columns.find((c) => c.name === name);
  if (!column) return rows;
  const empty = (x) => x === null || x === undefined;
  const compare = (a, b) => typeof a === "number" && typeof b === "number"
    ? a - b : collator.compare(String(a), String(b));
  return rows.map((row) => [column.value(row), row])
    .sort(([a], [b]) => empty(a) || empty(b) ? empty(a) - empty(b)
      : down ? compare(b, a) : compare(a, b))
    .map(([, row]) => row);
}

function groups(columns) {
  if (!columns.some((c) => c.group)) return null;
  const runs = [];
  for (const { group = "" } of columns) {
    if (runs.at(-1)?.group === group) runs.at(-1).span += 1;
    else runs.push({ group, span: 1 });
  }
  return h("tr", { class: "groups" }, runs.map(({ group, span }) =>
    group ? h("th", { colspan: span, scope: "colgroup" }, group)
      : h("td", { colspan: span })));
}

function rowOf(columns, row) {
  return h("tr", {}, columns.map((column, k) =>
    h(k === 0 ? "th" : "td", {
      scope: k === 0 ? "row" : null,
      class: [["number", "whole", "prose"].find((kind) => column[kind]),
        column.mark?.(row)].filter(Boolean).join(" ") || null,
      title: column.title?.(row),
    }, (column.show ?? column.value)(row))));
}

// A plot's numbers, in a table that is folded at first.
export function behind(...children) {
  return folded("The numbers as a table", ...children);
}

export function folded(summary, ...children) {
  return h("details", { class: "behind" }, h("summary", {}, summary), children);
}
