// SPDX-License-Identifier: GPL-3.0-or-later
// The pictures that turn: up to three algorithms side by side, or blinking.
import { h } from "../../page/parts/dom.js";
import { MOST } from "../state/lab.js";
import { another, plainName } from "./algorithms.js";
import { differences, verdictLine } from "./compare.js";
import { pacer } from "./pace.js";
import { stage } from "./stage.js";
import { workOf } from "./work.js";

const SHAPE = 4 / 3, MOST_COLUMNS = 1024, BLINK = 700;
const isCalm = matchMedia("(prefers-reduced-motion: reduce)");

// lab: the state; core: { algorithms, seats, judge }; source: the scene.
export function look(lab, core, source, over) {
  const { state } = lab;
  const box = h("div", { class: "stages" });
  const verdict = verdictLine(lab, core, source, () => shown());
  let stages = [], pacers = [], answers = [], stamp = 0, drawn = [], blinking = 0;
  let camera = null, isMoving = false, isOpen = false;

  // --- The stages ---

  const choose = (p) => (text) => lab.set({ a: state.a.map((x, k) =>
    k === p ? text : x) });
  const remove = (p) => state.a.length < 2 ? null
    : () => lab.set({ a: state.a.filter((_, k) => k !== p) });

  function build() {
    const open = stages.map((s) => s.element.querySelector(".options[open]") &&
      plainName(s.text));
    stages = state.a.map((text, p) => stage(core.algorithms, text,
      { choose: choose(p), remove: remove(p) }));
    stages.forEach((s, p) => {
      if (open[p] === plainName(s.text))
        s.element.querySelector(".options")?.setAttribute("open", "");
      over.attach(s.canvas, p);
    });
    pacers = stages.map(() => pacer());
    answers = stages.map(() => null);
    drawn = stages.map(() => -1);
    box.className = `stages of-${stages.length}${state.blink ? " blinks" : ""}`;
    box.replaceChildren(...stages.map((s) => s.element),
      stages.length < MOST ? h("button", { type: "button", class: "add-stage",
        onclick: () => lab.set({ a: [...state.a, another(state.a)] }) },
      "+ beside") : "");
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
    stages.forEach((s, p) => drawOne(s, p, subject, mine, moves));
    if (!camera) await cameraNow(info);
  }

  async function cameraNow(info) {
    const found = await info.catch(() => null);
    if (!found) return;
    camera = state.camera ?? found.views[Math.min(state.view, found.views.length - 1)];
    over.changed();
  }

  async function drawOne(s, p, subject, mine, moves) {
    const [m, n] = moves ? pacers[p].size(whole()) : whole();
    const request = { algorithm: s.text, m, n, counts: true,
      ...(state.camera ? { camera: state.camera } : { view: state.view }) };
    const began = performance.now();
    const late = setTimeout(() => s.element.classList.add("late"), 150);
    try {
      const answer = await (moves ? core.seats[p].redraw(subject, request)
        : core.seats[p].draw(subject, request));
      if (!answer || stages[p] !== s || drawn[p] > mine) return;
      pacers[p].took((performance.now() - began) / 1000);
      drawn[p] = mine;
      answers[p] = answer;
      s.show(answer, state.camera ?? await viewCamera(), !moves);
      if (!moves && mine === stamp) rested(s, p, subject, request);
    } catch (error) {
      if (stages[p] !== s) return;
      answers[p] = null;
      drawn[p] = mine;
      s.refuse(error);
    } finally {
      clearTimeout(late);
      if (!moves && mine === stamp && stages[p] === s) {
        s.element.classList.remove("late");
        settled();
      }
    }
  }

  async function viewCamera() {
    const { views } = await (await source.current()).info;
    return views[Math.min(state.view, views.length - 1)];
  }

  // What is asked once a picture rests.
  async function rested(s, p, subject, request) {
    over.changed();
    if (state.overlay === "work") await showWork(s, p, subject, request);
    const costs = await core.seats[p].after(subject, (client, id) =>
      client.predicted(id, request)).catch(() => null);
    if (costs && stages[p] === s) s.predict(costs);
  }

  async function showWork(s, p, subject, request) {
    const heat = await core.seats[p].after(subject, (client, id) =>
      workOf(client, id, request)).catch((error) => ({ words: error.text }));
    if (!heat || stages[p] !== s) return;
    s.over({ ...over.layers(), heat: heat.values ? heat : null });
    s.facts.append(heat.words ? `; ${heat.words}` : "");
  }

  // --- What differs ---

  const shown = () => stages.map((s, p) => ({ algorithm: s.algorithm, text: s.text,
    answer: drawn[p] === stamp ? answers[p] : null }));

  function settled() {
    const all = shown();
    if (all.some(({ answer }, p) => !answer && drawn[p] !== stamp)) return;
    verdict.show(all);
    overlay();
  }

  function overlay() {
    const base = over.layers();
    const first = answers.find((x) => x?.ids);
    stages.forEach((s, p) => {
      if (state.overlay === "work" && !isMoving) return;
      const mask = state.overlay === "differ" && first && answers[p]?.ids
        ? { m: first.m, places: differences(first, answers[p]) } : null;
      s.over({ ...base, mask });
    });
  }

  // --- Blinking ---

  function blink() {
    clearInterval(blinking);
    box.classList.toggle("blinks", state.blink && stages.length > 1);
    stages.forEach((s) => s.name(null));
    if (!state.blink || stages.length < 2 || !isOpen) return;
    let k = 0;
    const next = () => {
      k = (k + 1) % stages.length;
      if (answers[k]) stages[0].showOther(answers[k], camera);
      stages[0].name(stages[k].text);
    };
    next();
    blinking = setInterval(next, isCalm.matches ? 3 * BLINK : BLINK);
  }

  lab.when("a", () => { build(); draw(); blink(); });
  lab.when("scene own edits camera view", () => { camera = state.camera; draw(); });
  lab.when("size overlay", () => draw());
  lab.when("chosen", overlay);
  lab.when("blink", () => { build(); draw(); blink(); });

  return { element: h("div", { class: "look" }, verdict.element, box),
    open: () => { isOpen = true; build(); draw(); blink(); },
    close: () => { isOpen = false; clearInterval(blinking); },
    moving: (is) => { isMoving = is; if (!is) draw(); },
    camera: () => state.camera ?? camera, whole, overlay,
    answer: (p) => answers[p], shown,
    isSettled: () => isOpen && !isMoving && drawn.length > 0 &&
      drawn.every((at) => at === stamp),
    paint: () => stages.forEach((s) => s.paint()),
    rest: () => isOpen && draw() };
}
