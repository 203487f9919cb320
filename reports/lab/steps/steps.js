// SPDX-License-Identifier: GPL-3.0-or-later
// The player of hsr lesson on steps that are recorded now: of this scene, from this
// camera, in a picture that is small, or in a part of it.
import { runOf } from "../../lesson/data/run.js";
import { traceOf } from "../../lesson/data/trace.js";
import { player } from "../../lesson/parts/player.js";
import { h } from "../../page/parts/dom.js";
import { choice } from "../parts/choice.js";
import { sizeOf } from "../parts/view_bar.js";
import { algorithmSlots } from "../views/algorithms.js";

const SIZES = { "24x18": "24 × 18", "32x24": "32 × 24", "64x48": "64 × 48",
  "96x72": "96 × 72", "128x96": "128 × 96" };
const EVENTS = 300000; // that a run keeps

export function steps(lab, core, source) {
  const { state } = lab;
  const playing = player(state.play, () => lab.tell("play"));
  const top = h("form", { class: "view-bar", "aria-label": "What is stepped through",
    onsubmit: (e) => e.preventDefault() });
  const body = h("div", { class: "player" });
  const element = h("div", { class: "steps" }, top, body);
  let isOpen = false, wanted = 0, runs = [];

  // --- What is recorded ---

  async function record() {
    if (!isOpen) return;
    const mine = ++wanted;
    playing.end();
    showTop();
    body.classList.add("late");
    const [m, n] = sizeOf(state.steps);
    const { subject } = await source.current();
    const found = await Promise.all(state.a.map((algorithm, p) => {
      const request = { algorithm, m, n, window: state.window ?? undefined,
        ...(state.camera ? { camera: state.camera } : { view: state.view }) };
      return core.seats[p].ask(subject, (client, id) =>
        client.steps(id, request, { events: EVENTS }))
        .then(async (bytes) => bytes && runOf(await traceOf(bytes)))
        .catch((error) => ({ refused: error.text ?? error.message, algorithm }));
    }));
    if (mine !== wanted || !isOpen || found.some((run) => !run)) return;
    body.classList.remove("late");
    show(found);
  }

  function show(found) {
    runs = found.filter((run) => !run.refused);
    const refused = found.filter((run) => run.refused).map(({ refused: text,
      algorithm }) => h("p", { class: "refusal", role: "alert" },
      `${algorithm}: ${text}`));
    if (!runs.length) {
      body.replaceChildren(...refused);
      return;
    }
    const { bar, note, question, legend, panels } = playing.begin(runs);
    body.replaceChildren(...refused, bar, note, question, panels, legend);
    drawWindows(panels);
    playing.open();
  }

  // --- The part of the picture: dragged on a picture with Shift ---

  function drawWindows(panels) {
    panels.querySelectorAll(".picture").forEach((canvas) => {
      let from = null;
      const placeOf = (e) => {
        const box = canvas.getBoundingClientRect();
        const [m, n] = sizeOf(state.steps);
        return [Math.floor((e.clientX - box.left) / box.width * m),
          Math.floor((e.clientY - box.top) / box.height * n)];
      };
      canvas.addEventListener("pointerdown", (e) => {
        from = e.shiftKey ? placeOf(e) : null;
      });
      canvas.addEventListener("pointerup", (e) => {
        if (!from) return;
        const [i, j] = placeOf(e), [m, n] = sizeOf(state.steps);
        const bound = (x, most) => Math.max(0, Math.min(most, x));
        lab.set({ window: [bound(Math.min(i, from[0]), m - 1),
          bound(Math.min(j, from[1]), n - 1), bound(Math.max(i, from[0]) + 1, m),
          bound(Math.max(j, from[1]) + 1, n)] });
      });
    });
  }

  function windowField() {
    const [m, n] = sizeOf(state.steps), w = state.window;
    const isRow = w && w[3] === w[1] + 1 && w[0] === 0 && w[2] === m;
    const kind = !w ? "all" : isRow ? "row" : "part";
    const row = h("input", { type: "number", name: "row", min: 0, max: n - 1,
      "aria-label": "Row", value: w ? w[1] : n >> 1, hidden: kind !== "row",
      onchange: (e) => e.target.checkValidity() && lab.set({ window:
        [0, Number(e.target.value), m, Number(e.target.value) + 1] }) });
    return [choice("part", { all: "the picture", row: "one row",
      part: "a part (drag with Shift)" }, kind, (name) => lab.set({ window:
      name === "all" ? null : name === "row" ? [0, n >> 1, m, (n >> 1) + 1]
        : [m >> 2, n >> 2, 3 * m >> 2, 3 * n >> 2] }), "of "), row];
  }

  // --- What is chosen above ---

  function showTop() {
    top.replaceChildren(
      ...algorithmSlots(lab, core.algorithms.filter((a) => a.canTrace), "step"),
      choice("steps", { ...SIZES, [state.steps]: SIZES[state.steps] ?? state.steps },
        state.steps, (text) => lab.set({ steps: text, window: null }), "picture "),
      ...windowField());
  }

  lab.when("scene own edits camera view a steps window", (names) => {
    if (!names.includes("play")) {
      state.play.k = [];
      state.play.pixel = null;
    }
    record();
  });
  return { element, open: () => { isOpen = true; record(); },
    close: () => { isOpen = false; wanted += 1; playing.end(); },
    act: playing.act, show: playing.show, runs: () => runs, go: playing.go };
}
