// SPDX-License-Identifier: GPL-3.0-or-later
// An experiment: N grows, and what the chosen algorithms count is drawn over it,
// beside what the survey's formulas say.
import { whole } from "../../page/data/format.js";
import { h } from "../../page/parts/dom.js";
import { choice } from "../parts/choice.js";
import { algorithmSlots, plainName } from "../views/algorithms.js";
import { chart } from "./chart.js";
import { VARIED, varied } from "./ladders.js";
import { offered, predictedOf, valueOf } from "./values.js";

const BEGIN = 60; // where the slider is at first, of 200
const KEPT = 40; // values that a link holds

export function measure(lab, core, source) {
  const { state } = lab;
  const top = h("form", { class: "view-bar", "aria-label": "The experiment",
    onsubmit: (e) => e.preventDefault() });
  const slider = h("input", { type: "range", name: "n", min: 0, max: 200,
    "aria-label": "N", oninput: () => drag(valueAt(Number(slider.value))) });
  const at = h("output", {}), unit = h("span", {});
  const all = h("button", { type: "button", class: "main-act",
    onclick: () => sweep() }, "Measure all");
  const told = h("p", { class: "facts-of", role: "status" });
  const place = h("div", { class: "chart" });
  const element = h("div", { class: "measure" }, top,
    h("div", { class: "measure-line" }, slider, at, unit, all, h("button", { type: "button",
      class: "quiet", onclick: () => clear() }, "Clear")), told, place);
  let isOpen = false, experiment = null, points = [];
  let turn = 0; // of what measures; what has an older one ends
  let waiting = null; // the value that is measured next while one drags

  // --- Measuring ---

  async function one(value, algorithm, seat) {
    const { subject, ...view } = await experiment.at(value);
    const request = { algorithm, ...view, counts: true };
    return seat.ask(subject, async (client, id) => {
      const { counts } = await client.draw(id, request);
      // Times are of the build that does not count.
      const { seconds } = await client.draw(id, { ...request, counts: false });
      const costs = await client.predicted(id, request).catch(() => null);
      return { algorithm, x: value, counts, seconds: seconds.draw, costs };
    });
  }

  async function measured(value, mine) {
    for (const [p, algorithm] of state.a.entries()) {
      if (points.some((q) => q.x === value && q.algorithm === algorithm)) continue;
      try {
        const point = await one(value, algorithm, core.seats[p]);
        if (mine !== turn || !point) return;
        points.push(point);
      } catch (error) {
        if (mine !== turn) return;
        told.textContent = `${algorithm} at ${whole(value)}: ${error.text ??
          error.message}`;
      }
    }
    draw();
    noteValues();
  }

  async function sweep(values = experiment.values) {
    const mine = ++turn;
    waiting = null;
    for (const value of values) {
      if (mine !== turn || !isOpen) return;
      slider.value = placeOf(value);
      at.textContent = whole(value);
      await measured(value, mine);
    }
  }

  // One value after another, the latest one next.
  async function drag(value) {
    at.textContent = whole(value);
    const isBusy = waiting !== null;
    waiting = value;
    if (isBusy) return;
    const mine = ++turn;
    while (mine === turn && waiting !== null) {
      const next = waiting;
      await measured(next, mine);
      if (mine === turn && waiting === next) waiting = null;
    }
  }

  function noteValues() {
    const values = [...new Set(points.map((q) => q.x))].sort((a, b) => a - b);
    state.measure.values = values.slice(0, KEPT);
    lab.tell("measure");
  }

  const valueAt = (n) => Math.round(experiment.least *
    (experiment.most / experiment.least) ** (n / 200));
  const placeOf = (value) => 200 * Math.log(value / experiment.least) /
    Math.log(experiment.most / experiment.least);

  // --- What is shown ---

  const countersOf = (text) => core.algorithms.find((a) =>
    a.name === plainName(text))?.counters ?? [];

  function rows() {
    const { what } = state.measure;
    return points.map((q) => ({ algorithm: q.algorithm, x: q.x,
      y: valueOf(q, what, countersOf(q.algorithm)), predicted: predictedOf(q, what) }))
      .filter(({ y }) => y !== null)
      .sort((a, b) => a.x - b.x || a.algorithm.localeCompare(b.algorithm));
  }

  function draw() {
    if (!isOpen) return;
    const shown = rows();
    const height = Math.max(260, innerHeight - place.getBoundingClientRect().top - 110);
    place.replaceChildren(shown.some(({ y }) => y > 0) ? chart(shown, { height,
      x: experiment.label, of: experiment.of, what: state.measure.what })
      : h("p", { class: "empty" }, points.length ? "All of these are 0."
        : "Drag the slider, or measure all: the chart grows as you go."));
  }

  function showTop() {
    const whats = offered(state.a.flatMap(countersOf));
    if (!Object.hasOwn(whats, state.measure.what)) state.measure.what = "compare";
    top.replaceChildren(
      ...algorithmSlots(lab, core.algorithms.filter((a) => !a.drawsNothing),
        "measured"),
      choice("varied", VARIED, state.measure.by, (by) => {
        state.measure.by = by;
        begin();
        clear();
      }, "vary "),
      choice("what", whats, state.measure.what, (what) => {
        state.measure.what = what;
        draw();
        lab.tell("measure");
      }, "count "));
  }

  // --- Beginning ---

  function begin() {
    experiment = varied(state.measure.by, state, core, source);
    if (!experiment) state.measure.by = "size";
    experiment ??= varied("size", state, core, source);
    told.textContent = "";
    slider.value = BEGIN;
    unit.textContent = experiment.label;
    slider.setAttribute("aria-label", experiment.label);
    at.textContent = whole(valueAt(BEGIN));
    showTop();
  }

  function clear() {
    turn += 1;
    waiting = null;
    points = [];
    draw();
    noteValues();
  }

  // The values that a link holds are measured again.
  const again = () => sweep(state.measure.values.slice());

  lab.when("scene own edits camera view", () => {
    points = [];
    if (!isOpen) return;
    begin();
    clear();
  });
  lab.when("a", () => {
    points = points.filter((q) => state.a.includes(q.algorithm));
    if (!isOpen) return;
    showTop();
    draw();
    again();
  });
  return { element, sweep, points: () => points,
    open: () => {
      isOpen = true;
      begin();
      draw();
      again();
    },
    close: () => { isOpen = false; turn += 1; waiting = null; } };
}
