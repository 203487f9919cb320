// SPDX-License-Identifier: GPL-3.0-or-later
// Columns that several tables have.
import { href } from "../data/address.js";
import {
  digits, exponent, interval, memory, seconds, size, views, where, whole,
} from "../data/format.js";
import { key, looks } from "../data/looks.js";
import { distinguishable, symbolOf, unique } from "../data/model.js";
import { h, link } from "./dom.js";

// The algorithm's name with its symbol, as a link to its page.
export function named(name) {
  return link(href("algorithm", name), key(looks(name)), name);
}

export const algorithmColumn = { name: "algorithm", label: "algorithm",
  value: (r) => r.algorithm, show: (r) => named(r.algorithm) };

// Where a cell was measured.
export const placeColumns = [
  { name: "scene", label: "scene", value: (r) => r.scene },
  { name: "view", label: "view", value: (r) => r.view, number: true,
    show: views, csv: views },
  { name: "size", label: "size", number: true, title: where,
    value: (r) => r.width * r.height, show: size, csv: size },
];

export function timeColumns(report, rows) {
  const phases = unique(rows.flatMap((r) => Object.keys(r.phases)));
  const time = (name, label, value, group) => ({ name, label, group,
    number: true, value, show: (r) => seconds(value(r)) });
  return [
    rows.some((r) => r.threads > 1) && { name: "threads", label: "threads",
      number: true, value: (r) => r.threads },
    time("median", "median", (r) => r.seconds.value),
    time("from", "from", (r) => r.seconds.low, "95 % interval"),
    time("to", "to", (r) => r.seconds.high, "95 % interval"),
    time("least", "least", (r) => r.seconds.least),
    rows.some((r) => r.ratio) && { name: "ratio",
      label: `to ${report.baseline ?? "baseline"}`, number: true,
      value: (r) => r.ratio?.value ?? null, show: ratio },
    rows.some((r) => r.peak_kb) && { name: "peak", label: "peak memory",
      number: true, value: (r) => r.peak_kb, show: (r) => memory(r.peak_kb) },
    ...phases.map((phase) => time(phase, phase, (r) => r.phases[phase] ?? null,
      "apart from the frame")),
  ].filter(Boolean);
}

function ratio({ ratio: r, algorithm }) {
  if (!r) return "–";
  if (r.to === algorithm) return "1";
  const note = r.low === null ? " too few starts"
    : distinguishable(r) ? null : " not distinguishable";
  return [interval(r.value, r.low, r.high),
    note && h("span", { class: "note" }, note)];
}

export function outcomeColumns(rows) {
  return [
    { name: "status", label: "outcome", value: (r) => r.status,
      show: (r) => `${symbolOf(r.status)} ${r.status}` },
    rows.some((r) => r.mismatches) && { name: "mismatches", label: "differing",
      number: true, value: (r) => r.mismatches,
      show: (r) => r.compared ? `${whole(r.mismatches)} of ${whole(r.compared)}`
        : whole(r.mismatches) },
    rows.some((r) => r.adapted.length) && { name: "adapted",
      label: "scene adapted", value: (r) => r.adapted.join(", ") },
    rows.some((r) => r.reason) && { name: "reason", label: "why",
      prose: true, value: (r) => r.reason, show: (r) => r.reason ?? "" },
  ].filter(Boolean);
}

// A number that may be missing, whole when it is pointed at.
export function number(name, label, value, show = digits) {
  return { name, label, number: true, value: (r) => value(r) ?? null,
    show: (r) => show(value(r)), title: (r) => {
      const x = value(r);
      return typeof x === "number" ? whole(x) : null;
    } };
}

// How a step's cost grows, as the paper predicts and as counted.
export const growthColumns = [
  { name: "predicted", label: "predicted", number: true,
    value: (r) => r.growth?.predicted ?? null,
    show: (r) => exponent(r.growth?.predicted) },
  { name: "measured", label: "measured", number: true,
    value: (r) => r.growth?.measured ?? null, show: (r) => interval(
      r.growth?.measured, r.growth?.low, r.growth?.high, exponent) },
].map((c) => ({ ...c, group: "grows as faces to the" }));
