// SPDX-License-Identifier: GPL-3.0-or-later
// Two algorithms, one property in each row; and their times on the same cells.
import { count, digits, interval, seconds, where } from "../data/format.js";
import { named, placeColumns } from "../parts/columns.js";
import { h } from "../parts/dom.js";
import { formula } from "../parts/symbols.js";
import { table } from "../parts/table.js";
import { descriptor, sorts, stepRows } from "./algorithm.js";

export function sideBySide(report, a, b) {
  const [left, right] = [a, b].map((x) => [...descriptor(report, x),
    ["Sorts", sorts(x)], ["Steps", stepList(report, x)]]);
  const rows = left.map(([term, x], k) => ({ term, x, y: right[k][1] }))
    .filter(({ x, y }) => x || y);
  const text = (x) => x?.textContent ?? x;
  return [
    table({ caption: `${a.title}, beside ${b.title}`, rows, look: "beside",
      columns: [{ name: "property", label: "of the algorithm", value: (r) => r.term },
        { name: a.name, label: named(a.name), value: (r) => r.x ?? "–",
          csv: (r) => text(r.x) },
        { name: b.name, label: named(b.name), value: (r) => r.y ?? "–",
          csv: (r) => text(r.y) }] }),
    timesBeside(report, a, b),
  ];
}

function stepList(report, a) {
  const rows = stepRows(report, a);
  const names = report.environments.map((e) => e.scene);
  if (!rows.length || !names.length)
    return a.steps?.length ? h("ol", { class: "sorts" }, a.steps.map((s) =>
      h("li", {}, h("b", {}, s.label),
        s.formula && [": ", formula(s.formula)]))) : null;
  return h("ol", { class: "sorts" }, rows.map((r) => h("li", {},
    h("b", {}, r.step), `: ${names.map((name, k) =>
      `${count(r.measured?.[k])} on ${name}`).join(", ")}`)));
}

function timesBeside(report, a, b) {
  const others = new Map(report.cellsOf(b.name).filter((c) => c.seconds)
    .map((c) => [`${c.threads} ${where(c)}`, c]));
  const rows = report.cellsOf(a.name).filter((c) => c.seconds)
    .map((c) => ({ ...c, other: others.get(`${c.threads} ${where(c)}`) }))
    .filter((r) => r.other);
  if (!rows.length) return null;
  const apart = (r) => r.seconds.low > r.other.seconds.high ||
    r.other.seconds.low > r.seconds.high;
  const quotient = (r) => r.seconds.value / r.other.seconds.value;
  return table({ id: "beside", rows,
    caption: `Seconds a frame of ${a.name} and ${b.name}`,
    columns: [...placeColumns,
      { name: "a", label: a.name, number: true,
        value: (r) => r.seconds.value, show: (r) => spread(r.seconds) },
      { name: "b", label: b.name, number: true,
        value: (r) => r.other.seconds.value,
        show: (r) => spread(r.other.seconds) },
      { name: "ratio", label: `${a.name} / ${b.name}`, number: true,
        value: quotient, show: (r) => [digits(quotient(r)),
          apart(r) ? null : " (intervals overlap)"] }] });
}

function spread({ value, low, high }) {
  return interval(value, low, high, seconds);
}
