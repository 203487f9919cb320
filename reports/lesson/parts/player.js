// SPDX-License-Identifier: GPL-3.0-or-later
// Up to three runs of algorithms on one view, stepped through together. One of them
// leads; the others follow it.
import { h } from "../../page/parts/dom.js";
import { kindLook, KINDS } from "../data/kinds.js";
import { controls, LEVELS } from "./controls.js";
import { momentsOf } from "../telling/moments.js";
import { rateOf, STANDARD } from "../telling/pace.js";
import { questionsOf } from "../telling/questions.js";
import { panel } from "./panel.js";
import { quiz } from "./quiz.js";
import { saveStep } from "./save_step.js";

const isCalm = matchMedia("(prefers-reduced-motion: reduce)");

// What a player begins with; the address keeps some of it.
export const playerState = () => ({ k: [], lead: 0, level: "step", by: "share",
  speed: STANDARD, to: "", face: "", pixel: null, quiz: false, outlines: true,
  playing: false });

// state: as of playerState, which the player changes; changed(): called when it
// has. begin(runs) makes the elements that show these runs.
export function player(state, changed) {
  let panels = [], bar = null, question = null, owed = 0, before = 0;
  const note = h("p", { class: "note-line", role: "status" });
  const tell = (text) => { note.textContent = text; };

  // --- Where we are ---

  const leader = () => panels[state.lead].run;
  const bounded = (k, run) => Math.min(run.n, Math.max(0, Math.round(k)));

  // The step at which `run` is as far as the leader is at its step k.
  function following(run, k) {
    const lead = leader();
    if (k >= lead.n) return run.n;
    if (state.by === "share") return bounded(run.n * k / (lead.n || 1), run);
    const wanted = lead.painting.decided(k);
    let low = 0, high = run.n;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (run.painting.decided(middle) < wanted) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  function place(k) {
    const at = bounded(k, leader());
    state.k = panels.map(({ run }, p) => p === state.lead ? at
      : state.by === "apart" ? state.k[p] : following(run, at));
  }

  function show({ asked = null } = {}) {
    bar.step(now());
    panels.forEach((p, k) => p.show(state.k[k], { pixel: state.pixel,
      outlines: state.outlines, asked: k === state.lead ? asked : null }));
  }

  function go(k) {
    question.hide();
    tell("");
    place(k);
    show();
    if (state.quiz && now() >= leader().n && question.score().asked) {
      panels[state.lead].ask(question.element);
      question.result(questionsOf(leader()).length);
    }
    changed();
  }

  const now = () => state.k[state.lead];

  // One move forward or back.
  function moved(k, direction, level) {
    const run = leader();
    if (level === "whole") return direction > 0 ? run.n : 0;
    if (level === "moment") return nextMoment(run, k, direction);
    if (level === "unit")
      return direction > 0 ? run.nextUnit(k) : run.lastUnit(k);
    return bounded(k + direction, run);
  }

  function nextMoment(run, k, direction) {
    const all = momentsOf(run).map((m) => m.k);
    return direction > 0 ? all.find((m) => m > k) ?? run.n
      : all.filter((m) => m < k).at(-1) ?? 0;
  }

  function move(direction, level = state.level) {
    stop();
    if (question.open() && !question.isChosen()) return question.remind();
    if (question.open() && direction > 0) return question.goOn();
    const to = moved(now(), direction, level);
    if (!asks(now(), to)) go(to);
  }

  // --- Questions ---

  // Asks the first question on the way, if one is: the place is then the step before.
  function asks(from, to) {
    if (!state.quiz || state.level === "whole") return false;
    const next = questionsOf(leader()).find((q) => q.k > from && q.k <= to &&
      !question.isAnswered(q));
    if (!next) return false;
    place(next.k - 1);
    panels[state.lead].ask(question.element);
    show({ asked: next.k - 1 });
    question.ask(leader(), next);
    changed();
    return true;
  }

  // --- Playing ---

  const rate = () => rateOf(leader(), state.level, state.speed);
  const paceWords = () => rate() < 1 ? `${(1 / rate()).toFixed(1)} s a move`
    : rate() < 10 ? `${rate().toFixed(1)} moves a second`
      : `${Math.round(rate()).toLocaleString("en")} moves a second`;

  function stop() {
    if (!state.playing) return;
    state.playing = false;
    bar.playing(false);
    panels.forEach((p) => p.live(true));
  }

  function play() {
    if (state.playing) return stop();
    if (now() >= leader().n) place(0);
    state.playing = true;
    owed = 0;
    before = performance.now();
    bar.playing(true);
    panels.forEach((p) => p.live(false));
    requestAnimationFrame(frame);
  }

  // Where motion is not wanted, the picture changes at most once a second.
  function frame(time) {
    if (!state.playing) return;
    const passed = Math.max(0, time - before);
    if (isCalm.matches && passed < 1000) return void requestAnimationFrame(frame);
    before = time;
    owed += Math.min(passed, 1000) / 1000 * rate();
    let k = now();
    for (; owed >= 1 && k < leader().n; owed -= 1) {
      const to = moved(k, 1, state.level);
      if (asks(k, to)) return stop();
      k = to;
    }
    if (k !== now()) go(k);
    if (k >= leader().n) stop();
    else requestAnimationFrame(frame);
  }

  // --- Jumps ---

  function matcher() {
    const run = leader();
    const [what, name] = [state.to.slice(0, state.to.indexOf(":")),
      state.to.slice(state.to.indexOf(":") + 1)];
    const wanted = run.header.counters.map((c) =>
      what === "kind" ? c.kind === name : c.name === name);
    return (e) => wanted[run.trace.counter[e]];
  }

  function jump(direction, matches = matcher()) {
    stop();
    const run = leader();
    const k = direction > 0 ? run.after(Math.min(now(), run.trace.kept), matches)
      : run.before(now(), matches);
    if (k !== null) go(k);
    tell(k === null ? `There is none ${direction > 0 ? "after" : "before"} this step.`
      : "");
  }

  function jumpFace(direction) {
    const face = Number(state.face);
    if (state.face === "") return tell("Choose a face by its number first.");
    const run = leader();
    jump(direction, (e) => run.facesOf(e).includes(face));
  }

  // --- What the reader does ---

  const act = {
    start: () => { stop(); go(0); }, end: () => { stop(); go(leader().n); },
    goTo: (k) => { stop(); go(k); },
    back: () => move(-1), forward: () => move(1), move, play, jump, jumpFace,
    set: (changes) => {
      Object.assign(state, changes);
      if ("quiz" in changes) question.hide();
      bar.pace(paceWords(), state.speed);
      if ("by" in changes) place(now());
      show();
      changed();
    },
    nextLevel: () => {
      const all = Object.keys(LEVELS);
      act.set({ level: all[(all.indexOf(state.level) + 1) % all.length] });
      bar.level(state.level);
      tell(`Now a move is ${LEVELS[state.level]}.`);
    },
    save: () => saveStep(leader(), now(), state),
    toggleQuiz: () => {
      act.set({ quiz: !state.quiz });
      bar.quiz(state.quiz);
    },
    faster: (by) => act.set({ speed:
      Math.min(100, Math.max(0, state.speed + 5 * by)) }),
    leadNumber: (p) => { if (p < panels.length) lead(p); },
    pixel: (at) => {
      state.pixel = at;
      panels.forEach((p) => p.story(at));
      show();
      changed();
    },
  };

  function lead(p) {
    if (p === state.lead) return;
    state.lead = p;
    panels.forEach(({ element }, q) =>
      element.classList.toggle("leads", panels.length > 1 && q === p));
    state.to = bar.offer(leader(), state.to, state.face);
    bar.step(now());
    changed();
  }

  // --- The elements ---

  function begin(shown) {
    stop();
    state.lead = Math.min(state.lead, shown.length - 1);
    question = quiz((q) => go(q.k));
    panels = shown.map((run, p) => panel(run, { go: (k) => {
      stop();
      lead(p);
      go(k);
    }, lead: () => lead(p), pixel: act.pixel, pixelNow: () => state.pixel }));
    state.k = panels.map(({ run }, p) => bounded(state.k[p] ?? 0, run));
    bar = controls(act, state, panels.length > 1);
    panels[state.lead].element.classList.toggle("leads", panels.length > 1);
    return { bar: bar.element, note, question: question.element,
      legend: legend(panels.map(({ run }) => run)),
      panels: h("div", { class: `panels of-${panels.length}` },
        panels.map(({ element }) => element)) };
  }

  // Once the elements are in the page.
  function open() {
    tell("");
    state.to = bar.offer(leader(), state.to, state.face);
    bar.pace(paceWords(), state.speed);
    if (state.pixel) panels.forEach((p) => p.story(state.pixel));
    place(now());
    show();
    changed();
  }

  function end() {
    stop();
    panels = [];
  }

  // What keys do; nothing while there are no runs.
  const keyed = Object.fromEntries(Object.entries(act).map(([name, does]) =>
    [name, (...given) => panels.length ? does(...given) : undefined]));

  return { begin, open, end, go, stop, lead, act: keyed, focus: () => bar.focus(),
    show: () => panels.length && show() };
}

function legend(runs) {
  const own = new Set(runs.flatMap((run) =>
    run.header.counters.map((c) => c.kind)));
  return h("ul", { class: "legend kinds", "aria-label": "Kinds of steps" },
    Object.keys(KINDS).filter((kind) => own.has(kind)).map((kind) => {
      const { sign, hue } = kindLook(kind);
      return h("li", {}, h("span", { class: "sign", "aria-hidden": "true",
        style: `color: var(--hue-${hue})` }, sign), kind);
    }),
    h("li", { class: "faint" }, "solid: what the step is about; dashed: what it " +
      "is compared with"));
}
