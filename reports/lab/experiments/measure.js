// SPDX-License-Identifier: GPL-3.0-or-later
// An experiment: N grows, and what the chosen algorithms count is drawn over it,
// beside what the survey's formulas say.
import { KINDS } from "../../lesson/data/kinds.js";
import { count, seconds, whole } from "../../page/data/format.js";
import { looks } from "../../page/data/looks.js";
import { figure, growthPlot } from "../../page/parts/plots.js";
import { saveCsv } from "../../page/parts/save.js";
import { h } from "../../page/parts/dom.js";
import { choice } from "../editing/hand.js";
import { algorithmSlots, plainName } from "../views/algorithms.js";
import { VARIED, varied } from "./ladders.js";

const SPECIAL = { compare: "all comparisons", predicted:
  "the weighed steps of Table III", seconds: "the time to draw" };

export function measure(lab, core, source) {
  const { state } = lab;
  const top = h("form", { class: "view-bar", "aria-label": "The experiment",
    onsubmit: (e) => e.preventDefault() });
  const slider = h("input", { type: "range", name: "n", min: 0, max: 200,
    "aria-label": "N" });
  const at = h("output", {});
  const sweepAll = h("button", { type: "button", class: "main-act",
    onclick: () => sweep() }, "Measure all");
  const line = h("div", { class: "measure-line" }, slider, at, sweepAll,
    h("button", { type: "button", class: "quiet", onclick: () => clear() }, "Clear"));
  const told = h("p", { class: "facts-of", role: "status" });
  const chart = h("div", { class: "chart" });
  const element = h("div", { class: "measure" }, top, line, told, chart);
  let isOpen = false, points = [], experiment = null, turn = 0, waiting = null;

  // --- Measuring ---

  async function one(value, algorithm, p) {
    const { subject, ...view } = await experiment.at(value);
    const request = { algorithm, ...view, counts: true };
    return core.seats[p].ask(subject, async (client, id) => {
      const answer = await client.draw(id, request);
      const costs = await client.predicted(id, request).catch(() => null);
      return { algorithm, x: value, counts: answer.counts, seconds:
        answer.seconds.draw, costs };
    });
  }

  async function measured(value, mine) {
    for (const [p, algorithm] of state.a.entries()) {
      if (points.some((q) => q.x === value && q.algorithm === algorithm)) continue;
      try {
        const point = await one(value, algorithm, p);
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

  async function sweep() {
    const mine = ++turn;
    sweepAll.disabled = true;
    for (const value of experiment.values) {
      if (mine !== turn || !isOpen) break;
      slider.value = placeOf(value);
      at.textContent = whole(value);
      await measured(value, mine);
    }
    sweepAll.disabled = false;
  }

  // While the slider is dragged: one value after another, the latest next.
  async function drag(value) {
    at.textContent = whole(value);
    const isBusy = waiting !== null;
    waiting = value;
    if (isBusy) return;
    const mine = ++turn;
    sweepAll.disabled = false;
    while (mine === turn && waiting !== null) {
      const next = waiting;
      await measured(next, mine);
      if (waiting === next) waiting = null;
    }
    if (mine !== turn) waiting = null;
  }

  const noteValues = () => {
    const values = [...new Set(points.map((q) => q.x))].sort((a, b) => a - b);
    state.measure.values = values.slice(0, 40);
    lab.tell("measure");
  };

  const valueAt = (place) => Math.round(experiment.least *
    (experiment.most / experiment.least) ** (place / 200));
  const placeOf = (value) => 200 * Math.log(value / experiment.least) /
    Math.log(experiment.most / experiment.least);
  slider.addEventListener("input", () => drag(valueAt(Number(slider.value))));

  function clear() {
    turn += 1;
    waiting = null;
    points = [];
    draw();
    noteValues();
  }

  // --- The chart ---

  const known = (text) => core.algorithms.find((a) => a.name === plainName(text));

  // What is drawn of a point; null: it has none.
  function valueOf({ algorithm, counts, costs, seconds: time }) {
    const { what } = state.measure, { counters } = known(algorithm);
    if (what === "seconds") return time;
    if (what === "predicted") return sum(costs?.map((c) => c.measured));
    if (what.startsWith("counter:")) return sum(counts.filter((_, k) =>
      counters[k].name === what.slice(8)));
    return sum(counts.filter((_, k) => counters[k].step === what));
  }
  const sum = (all) => all?.length ? all.reduce((a, b) => a + (b ?? 0), 0) : null;
  const predictedOf = ({ costs }) => state.measure.what !== "predicted" ? null
    : sum(costs?.map((c) => c.predicted).filter((x) => x !== null));

  const rows = () => points.slice().sort((a, b) => a.x - b.x ||
    a.algorithm.localeCompare(b.algorithm)).map((q) => ({ algorithm: q.algorithm,
    looks: looks(plainName(q.algorithm)), x: q.x, y: valueOf(q),
    predicted: predictedOf(q) })).filter(({ y }) => y !== null);

  function draw() {
    if (!isOpen) return;
    const shown = rows(), show = state.measure.what === "seconds" ? seconds : count;
    const names = [...new Set(shown.map((r) => r.algorithm))];
    if (shown.length < 1) {
      chart.replaceChildren(h("p", { class: "empty" }, "Drag the slider, or measure " +
        "all: the chart grows as you go."));
      return;
    }
    const caption = `${labelOf(state.measure.what)} of ${names.join(", ")} over ${
      experiment.label.replace(" →", "")}, ${experiment.of}`;
    const heads = ["algorithm", experiment.label.replace(" →", ""), labelOf(
      state.measure.what), "predicted by the survey"];
    const cells = shown.map((r) => [r.algorithm, r.x, r.y, r.predicted]);
    chart.replaceChildren(figure({ caption,
      draw: (width) => growthPlot(shown, experiment.label, { label:
        `↑ ${labelOf(state.measure.what)}`, show }, width, Math.max(260,
        innerHeight - chart.getBoundingClientRect().top - 110)),
      keys: names.map((name) => ({ looks: looks(plainName(name)), label: name })),
      numbers: numbers(heads, cells, show, caption) }));
  }

  const numbers = (heads, cells, show, caption) => h("details", { class: "numbers" },
    h("summary", {}, "The numbers"), saveCsv(caption, () => [heads, ...cells]),
    h("table", {}, h("thead", {}, h("tr", {}, heads.map((text) =>
      h("th", { scope: "col" }, text)))), h("tbody", {}, cells.map((row) =>
      h("tr", {}, row.map((x, k) => h(k ? "td" : "th", { class: k ? "number" : null,
        scope: k ? null : "row" }, k === 0 ? x : k === 1 ? whole(x) : show(x))))))));

  const labelOf = (what) => SPECIAL[what] ?? (what.startsWith("counter:")
    ? what.slice(8) : `steps of the kind “${what}”`);

  // --- What is chosen ---

  function offered() {
    const own = state.a.map(known).flatMap((a) => a?.counters ?? []);
    const kinds = Object.keys(KINDS).filter((kind) => kind !== "compare" &&
      own.some((c) => c.step === kind));
    const names = [...new Set(own.map((c) => c.name))];
    return { ...SPECIAL, ...Object.fromEntries(kinds.map((k) => [k, labelOf(k)])),
      ...Object.fromEntries(names.map((n) => [`counter:${n}`, n])) };
  }

  function showTop() {
    const all = offered();
    if (!Object.hasOwn(all, state.measure.what)) state.measure.what = "compare";
    top.replaceChildren(
      ...algorithmSlots(lab, core.algorithms.filter((a) => !a.drawsNothing),
        "measured"),
      choice("varied", VARIED, state.measure.by, (by) => change({ by }), "vary "),
      choice("what", all, state.measure.what, (what) => {
        state.measure.what = what;
        draw();
        lab.tell("measure");
      }, "count "));
  }

  function change(changes) {
    Object.assign(state.measure, changes);
    begin();
    clear();
  }

  function begin() {
    experiment = varied(state.measure.by, state, core, source);
    if (!experiment) state.measure.by = "size";
    experiment ??= varied("size", state, core, source);
    told.textContent = "";
    slider.value = 60;
    at.textContent = whole(valueAt(60));
    showTop();
  }

  // The values that a link holds are measured again.
  async function again() {
    const mine = ++turn, values = state.measure.values.slice();
    for (const value of values) if (mine === turn && isOpen) await measured(value, mine);
  }

  lab.when("scene own edits camera view", () => {
    if (!isOpen) return void (points = []);
    begin();
    clear();
  });
  lab.when("a", () => {
    if (!isOpen) return;
    points = points.filter((q) => state.a.includes(q.algorithm));
    showTop();
    draw();
    again();
  });
  return { element, points: () => points, sweep,
    open: () => {
      isOpen = true;
      begin();
      draw();
      again();
    },
    close: () => { isOpen = false; turn += 1; } };
}
