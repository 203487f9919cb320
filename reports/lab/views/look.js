// SPDX-License-Identifier: GPL-3.0-or-later
// The pictures that turn: up to three algorithms side by side, or blinking.
import { h } from "../../page/parts/dom.js";
import { firstPictures } from "../state/asked.js";
import { MOST } from "../state/lab.js";
import { another, plainName } from "./algorithms.js";
import { blinking } from "./blink.js";
import { differences, reference, verdictLine } from "./compare.js";
import { pacer } from "./pace.js";
import { stage } from "./stage.js";
import { under } from "./under.js";
import { workOf } from "./work.js";

const SHAPE = 4 / 3, MOST_COLUMNS = 1024;
const PREVIEW = 40000; // samples

// lab: the state; core: as of core/connect.js; source: the scene; over: what is done on
// pictures, and lies over them: { attach(canvas), layers(), changed() }.
export function look(lab, core, source, over) {
  const { state } = lab;
  const box = h("div", { class: "stages" });
  const verdict = verdictLine(lab, core, source, () => shown());
  let stages = []; // as of stage(), with { pace, answer, drawn, heat }
  let stamp = 0; // of what is wanted; a stage has it as `drawn` when it is there
  let camera = null, isMoving = false, isOpen = false, still = () => {};

  // --- The stages ---

  const choose = (p) => (text) => lab.set({ a: state.a.map((x, k) =>
    k === p ? text : x) });
  const remove = (p) => state.a.length < 2 ? null
    : () => lab.set({ a: state.a.filter((_, k) => k !== p) });

  function build() {
    const open = stages.map((s) => s.areOptionsOpen() && plainName(s.text));
    stages = state.a.map((text, p) => Object.assign(stage(lab, core.algorithms, text,
      { choose: choose(p), remove: remove(p) }), { pace: pacer(), answer: null,
      drawn: -1 }));
    const first = firstPictures.splice(0);
    stages.forEach((s, p) => {
      if (first[p]) s.begin(first[p]);
      if (open[p] === plainName(s.text)) s.openOptions();
      over.attach(s.canvas);
      s.canvas.after(under(s.canvas, source, core.judge, () =>
        s.drawn === stamp ? s.answer : null, looked));
    });
    box.className = `stages of-${stages.length}${state.blink ? " blinks" : ""}`;
    box.replaceChildren(...stages.map((s) => s.element),
      stages.length < MOST ? h("button", { type: "button", class: "add-stage",
        onclick: () => lab.set({ a: [...state.a, another(state.a)] }) },
      "+ beside") : "");
  }

  function blink() {
    still();
    still = () => {};
    stages.forEach((s) => s.name(null));
    if (!state.blink || stages.length < 2 || !isOpen) return;
    still = blinking(stages.length, (k) => {
      if (stages[k].answer) stages[0].showOther(stages[k].answer, camera);
      stages[0].name(stages[k].text);
    });
  }

  // --- Drawing ---

  const room = () => {
    const wide = stages[0].canvas.clientWidth || 480;
    const m = Math.max(64, Math.min(MOST_COLUMNS,
      Math.round(wide * Math.min(2, devicePixelRatio || 1) / 8) * 8));
    return [m, Math.round(m / SHAPE)];
  };
  const whole = () => state.size ?? room();

  async function draw() {
    if (!isOpen) return;
    const mine = ++stamp, moves = isMoving;
    const { subject, info } = await source.current();
    if (mine !== stamp) return;
    stages.forEach((s, p) => drawOne(s, core.seats[p], subject, mine, moves));
    const found = state.camera ? null : await info.catch(() => null);
    if (mine !== stamp || !(state.camera ?? found)) return;
    camera = state.camera ??
      found.views[Math.min(state.view, found.views.length - 1)];
    if (!moves) over.changed();
  }

  const looked = () => state.camera ? { camera: state.camera } : { view: state.view };

  async function drawOne(s, seat, subject, mine, moves) {
    const [m, n] = moves ? s.pace.size(whole()) : whole();
    const request = { algorithm: s.text, m, n, counts: true, ...looked() };
    const from = state.camera, began = performance.now();
    const passed = () => (performance.now() - began) / 1000;
    const late = setTimeout(() => s.wait(), 300);
    try {
      if (!moves && !s.answer) await preview(s, seat, subject, request);
      const answer = await (moves ? seat.redraw : seat.draw)(subject, request);
      if (!stages.includes(s)) return;
      if (!answer && moves && passed() > 0.3) s.pace.took(passed(), passed());
      if (!answer) return;
      s.pace.took(passed(), answer.seconds.draw);
      Object.assign(s, { answer, drawn: mine, heat: null });
      s.show(answer, from ?? await viewCamera(), !moves);
    } catch (error) {
      if (!stages.includes(s)) return;
      Object.assign(s, { answer: null, drawn: mine });
      s.refuse(error);
    } finally {
      clearTimeout(late);
      if (s.drawn === stamp && !moves) rested(s, seat, subject, request);
    }
  }

  // A large picture that is the first one has a small one before it.
  async function preview(s, seat, subject, request) {
    const { m, n } = request;
    if (m * n < PREVIEW) return;
    const small = await seat.draw(subject, { ...request, m: m >> 2, n: n >> 2 });
    if (small && stages.includes(s)) s.show(small, state.camera ?? await viewCamera());
  }

  async function viewCamera() {
    const { views } = await (await source.current()).info;
    return views[Math.min(state.view, views.length - 1)];
  }

  // What is asked once a picture rests.
  async function rested(s, seat, subject, request) {
    settled();
    if (!s.answer) return;
    if (state.overlay === "work") await showWork(s, seat, subject, request);
    const costs = await seat.after(subject, (client, id) =>
      client.predicted(id, request)).catch(() => null);
    if (costs && stages.includes(s)) s.predict(costs);
  }

  async function showWork(s, seat, subject, request) {
    const heat = await seat.after(subject, (client, id) =>
      workOf(client, id, request)).catch((error) => ({ words: error.text }));
    if (!heat || !stages.includes(s)) return;
    s.heat = heat.values ? heat : null;
    s.tell(heat.words);
    overlay();
  }

  // --- What differs ---

  const shown = () => stages.map(({ algorithm, text, answer, drawn }) =>
    ({ algorithm, text, answer: drawn === stamp ? answer : null }));
  const isSettled = () => isOpen && !isMoving &&
    stages.every(({ drawn }) => drawn === stamp);

  function settled() {
    if (!isSettled()) return;
    verdict.show(shown());
    overlay();
  }

  function overlay() {
    const base = over.layers(), first = reference(stages)?.answer;
    for (const s of stages) {
      const mask = state.overlay === "differ" && first && s.answer?.ids
        ? { m: first.m, places: differences(first, s.answer) } : null;
      s.over({ ...base, mask, heat: s.heat });
    }
  }

  const again = () => { build(); draw(); blink(); };
  lab.when("a blink", () => isOpen && again());
  lab.when("scene own edits camera view size overlay", draw);
  lab.when("chosen", overlay);

  return { element: h("div", { class: "look" }, verdict.element, box),
    open: () => { isOpen = true; again(); },
    close: () => { isOpen = false; still(); },
    moving: (is) => {
      if (is === isMoving) return;
      isMoving = is;
      if (!is) draw();
    },
    camera: () => state.camera ?? camera, whole, overlay, shown, isSettled,
    paint: () => stages.forEach((s) => s.paint()) };
}
