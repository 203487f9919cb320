// SPDX-License-Identifier: GPL-3.0-or-later
// Chooses which numbers are shown. Every choice is in the address, so that a page
// can be reloaded, kept and sent.
import { read, set } from "../data/address.js";
import { size, views } from "../data/format.js";
import { key, looks } from "../data/looks.js";
import { unique } from "../data/model.js";
import { h } from "./dom.js";

// The choices: for each its name in the address, its label, and the value of a
// record. A record is a cell or a point of a sweep.
const CHOICES = {
  scene: { label: "Scene", of: (r) => r.scene },
  view: { label: "Scene and view", of: (r) => `${r.scene}, view ${views(r)}` },
  size: { label: "Size", of: (r) => size(r) },
  status: { label: "Outcome", of: (r) => r.status },
  class: { label: "Class", of: (r, report) =>
    report.algorithm(r.algorithm).taxonomy },
};

// A form over the records; changed() is called after a choice.
export function filterForm(report, records, names, changed) {
  const { params } = read();
  const pick = (name) => {
    const { label, of } = CHOICES[name];
    const values = unique(records.map((r) => of(r, report))).filter(Boolean);
    const chosen = params.get(name);
    return h("label", {}, label,
      h("select", { name, onchange: (e) => {
        set({ [name]: e.target.value });
        changed();
      } },
      h("option", { value: "" }, "all"),
      values.map((value) => h("option",
        { value, selected: value === chosen }, value))));
  };
  return h("form", { class: "filters", "aria-label": "Filters",
    onsubmit: (e) => e.preventDefault() },
  names.map(pick), algorithmBoxes(report, records, changed));
}

function algorithmBoxes(report, records, changed) {
  const names = unique(records.map((r) => r.algorithm));
  const order = report.algorithms.filter((a) => names.includes(a.name));
  if (order.length < 2) return null;
  const summary = h("summary");
  const boxes = order.map(({ name }) => h("input",
    { type: "checkbox", name: "algorithm", value: name }));
  const chosen = chosenAlgorithms();
  for (const box of boxes) box.checked = chosen.has(box.value);
  const tell = () => {
    const n = chosenAlgorithms().size;
    summary.textContent = n ? `Algorithms: ${n} of ${order.length}`
      : "Algorithms: all";
  };
  const choose = () => {
    const on = boxes.filter((box) => box.checked).map((box) => box.value);
    set({ algorithms: on.join(",") });
    tell();
    changed();
  };
  tell();
  return h("details", { class: "choice" }, summary,
    h("fieldset", { onchange: choose },
      h("legend", {}, "Show only those ticked; if none is ticked, show all"),
      h("div", { class: "boxes" }, boxes.map((box) =>
        h("label", {}, box, key(looks(box.value)), box.value)))),
    h("button", { type: "button", onclick: () => {
      for (const box of boxes) box.checked = false;
      choose();
    } }, "Untick all"));
}

export function chosenAlgorithms() {
  return new Set((read().params.get("algorithms") ?? "").split(",")
    .filter(Boolean));
}

// The records that the address asks for.
export function chosen(report, records, names) {
  const { params } = read();
  const algorithms = chosenAlgorithms();
  return records.filter((r) =>
    (!algorithms.size || algorithms.has(r.algorithm)) &&
    names.every((name) => !params.get(name) ||
      CHOICES[name].of(r, report) === params.get(name)));
}
