// SPDX-License-Identifier: GPL-3.0-or-later
// The page of hsr lesson: up to three algorithms at work on one view, stepped
// through together. One of them leads; the others follow it.
import { read, set as setAddress } from "../page/data/address.js";
import { h } from "../page/parts/dom.js";
import { figures } from "./figures/all.js";
import { kindLook, KINDS, setPaper } from "./data/kinds.js";
import { closeness } from "./data/projection.js";
import { runOf } from "./data/run.js";
import { LESSONS } from "./data/survey.js";
import { readTrace } from "./data/trace.js";
import { eventWords } from "./data/words.js";
import { controls, keys, LEVELS, TOGETHER } from "./parts/controls.js";
import { panel } from "./parts/panel.js";
import { lessonIndex, lessonText } from "./parts/lesson.js";
import { isQuestion, quiz } from "./parts/quiz.js";

const MOST = 3; // algorithms side by side
const SLOWEST = 0.5, FASTEST = 50000; // moves a second
const main = document.querySelector("main");
const scripts = [...document.querySelectorAll("script.run")];
const texts = new Map(scripts.map((e) => [e.dataset.name, e.textContent]));
const scenes = new Map(scripts.map((e) => [e.dataset.name, e.dataset.scene]));
const survey = JSON.parse(document.querySelector("#survey")?.textContent ??
  "null"); // of the lessons; null: the page is of one scene
const names = [...texts.keys()];
const runs = new Map();
const isCalm = matchMedia("(prefers-reduced-motion: reduce)");

const state = { a: [], k: [], lead: 0, level: "step", by: "share", speed: 30,
  to: "", face: "", pixel: null, quiz: false, outlines: true, playing: false };
let panels = [], bar = null, question = null, owed = 0, before = 0;

async function runNamed(name) {
  if (!runs.has(name)) runs.set(name, runOf(await readTrace(texts.get(name))));
  return runs.get(name);
}

// --- The address ---

function readAddress() {
  const { params } = read();
  const one = (name, all, standard) => Object.hasOwn(all, params.get(name) ?? "")
    ? params.get(name) : standard;
  const number = (text) => Number.isFinite(Number(text)) ? Number(text) : 0;
  const asked = (params.get("a") ?? "").split(",").filter((x) => texts.has(x));
  state.a = asked.length ? [...new Set(asked)].slice(0, MOST)
    : survey ? [] : names.slice(0, 1);
  keepToOneScene();
  state.k = state.a.map((_, p) =>
    number((params.get("k") ?? "").split(",")[p] ?? 0));
  state.lead = Math.min(state.a.length - 1, Math.max(0,
    Math.floor(number(params.get("lead") ?? 0))));
  state.level = one("level", LEVELS, "step");
  state.by = one("by", TOGETHER, "share");
  state.speed = Math.min(100, Math.max(0, number(params.get("speed") ?? 30)));
  state.to = params.get("to") ?? "";
  state.face = params.get("face") ?? "";
  state.quiz = params.get("quiz") === "1";
  state.outlines = params.get("outlines") !== "0";
  const [i, j] = (params.get("at") ?? "").split(",").map(Number);
  state.pixel = Number.isInteger(i) && Number.isInteger(j) ? { i, j } : null;
}

// Only runs of one scene go side by side.
function keepToOneScene() {
  const scene = scenes.get(state.a[0]);
  state.a = state.a.filter((name) => scenes.get(name) === scene);
}

// Written when all rests: browsers limit the number of changes a second.
let waiting = 0;
function writeAddress() {
  clearTimeout(waiting);
  if (!panels.length) return;
  waiting = setTimeout(() => setAddress({ a: state.a.join(","),
    k: state.k.join(","), lead: state.lead || null,
    level: state.level === "step" ? null : state.level,
    by: state.by === "share" ? null : state.by, speed: state.speed,
    to: state.to, face: state.face, quiz: state.quiz ? 1 : null,
    outlines: state.outlines ? null : 0,
    at: state.pixel ? `${state.pixel.i},${state.pixel.j}` : null }), 200);
}

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

function show() {
  bar.step(now());
  panels.forEach((p, k) => p.show(state.k[k],
    { pixel: state.pixel, outlines: state.outlines }));
}

function go(k) {
  question.hide();
  place(k);
  show();
  writeAddress();
}

const now = () => state.k[state.lead];

// One move forward or back.
function moved(k, direction, level) {
  const run = leader();
  if (level === "whole") return direction > 0 ? run.n : 0;
  if (level === "unit")
    return direction > 0 ? run.nextUnit(k) : run.lastUnit(k);
  return bounded(k + direction, run);
}

function move(direction, level = state.level) {
  stop();
  if (question.open()) return;
  if (direction > 0 && state.quiz && level === "step" &&
      isQuestion(leader(), now())) question.ask(leader(), now());
  else go(moved(now(), direction, level));
}

// --- Playing ---

const rate = () => SLOWEST * (FASTEST / SLOWEST) ** (state.speed / 100);
const paceWords = () => rate() < 10 ? `${rate().toFixed(1)} moves a second`
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
    if (state.quiz && state.level === "step" && isQuestion(leader(), k)) {
      place(k);
      show();
      stop();
      return question.ask(leader(), k);
    }
    k = moved(k, 1, state.level);
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

const note = h("p", { class: "note-line", role: "status" });
const tell = (text) => { note.textContent = text; };

// --- What the reader does ---

const act = {
  start: () => { stop(); go(0); }, end: () => { stop(); go(leader().n); },
  goTo: (k) => { stop(); go(k); },
  back: () => move(-1), forward: () => move(1), move, play, jump, jumpFace,
  set: (changes) => {
    Object.assign(state, changes);
    if ("quiz" in changes && !state.quiz) question.hide();
    bar.pace(paceWords(), state.speed);
    if ("by" in changes) place(now());
    show();
    writeAddress();
  },
  nextLevel: () => {
    const all = Object.keys(LEVELS);
    state.level = all[(all.indexOf(state.level) + 1) % all.length];
    bar.level(state.level);
    tell(`A move is ${LEVELS[state.level]}.`);
    writeAddress();
  },
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
    writeAddress();
  },
};

function lead(p) {
  if (p === state.lead) return;
  state.lead = p;
  panels.forEach(({ element }, q) =>
    element.classList.toggle("leads", panels.length > 1 && q === p));
  state.to = bar.offer(leader(), state.to, state.face);
  bar.step(now());
  writeAddress();
}

// --- The page ---

function legend() {
  const own = new Set(panels.flatMap(({ run }) =>
    run.header.counters.map((c) => c.kind)));
  return h("ul", { class: "legend kinds", "aria-label": "Kinds of steps" },
    Object.keys(KINDS).filter((kind) => own.has(kind)).map((kind) => {
      const { sign, hue } = kindLook(kind);
      return h("li", {}, h("span", { class: "sign", "aria-hidden": "true",
        style: `color: var(--hue-${hue})` }, sign), kind);
    }),
    h("li", { class: "faint" }, "solid: what the step is about; dashed: what it " +
      "is put to"));
}

function chooser() {
  const choose = (p) => (e) => {
    const a = state.a.slice();
    if (e.target.value) a[p] = e.target.value;
    else a.splice(p, 1);
    state.a = [...new Set(a)];
    keepToOneScene();
    state.lead = 0;
    begin().catch(fail);
  };
  const slot = (p) => h("label", {}, p ? "beside" : "algorithm",
    h("select", { name: `algorithm-${p}`, onchange: choose(p) },
      p ? h("option", { value: "" }, "no other") : null,
      names.filter((name) => !p || scenes.get(name) === scenes.get(state.a[0]))
        .map((name) => h("option", { value: name,
        selected: state.a[p] === name }, name))));
  const same = names.filter((name) =>
    scenes.get(name) === scenes.get(state.a[0]));
  const slots = Math.min(MOST, same.length, state.a.length + 1);
  return h("div", { class: "filters chooser" },
    Array.from({ length: slots }, (_, p) => slot(p)));
}

function showIndex() {
  panels = [];
  main.replaceChildren(...lessonIndex(survey));
  document.title = "Hidden surfaces, step by step · hsr";
}

async function begin() {
  stop();
  if (!state.a.length) return showIndex();
  const shown = await Promise.all(state.a.map(runNamed));
  const { scene, view } = shown[0].header;
  question = quiz(() => go(now() + 1));
  panels = shown.map((run, p) => panel(run, { go: (k) => {
    stop();
    lead(p);
    go(k);
  }, lead: () => lead(p), pixel: act.pixel, pixelNow: () => state.pixel }));
  state.k = panels.map(({ run }, p) => bounded(state.k[p] ?? 0, run));
  bar = controls(act, state, panels.length > 1);
  panels[state.lead].element.classList.toggle("leads", panels.length > 1);
  main.replaceChildren(
    h("div", { class: "top" }, h("div", {},
      h("h1", { tabindex: -1 }, `${scene}, step by step`),
      h("p", { class: "kicker" }, `View ${view.number}, ${view.width} × ${
        view.height} samples, ${shown[0].header.faces.length} faces. `,
      shown[0].kind.hint)),
    chooser()), survey && lessonText(survey, shown[0], (k) => {
      stop();
      lead(0);
      go(k);
    }) || "", bar.element, note, question.element, legend(),
    h("div", { class: `panels of-${panels.length}` },
      panels.map(({ element }) => element)),
    survey && figures(shown[0], (name) =>
      scenes.get(name) === scenes.get(state.a[0]) ? runNamed(name) : null) || "");
  document.title = `${scene}: ${state.a.join(", ")} · hsr`;
  state.to = bar.offer(leader(), state.to, state.face);
  bar.pace(paceWords(), state.speed);
  if (state.pixel) panels.forEach((p) => p.story(state.pixel));
  place(now());
  show();
  writeAddress();
}

function fail(error) {
  main.replaceChildren(h("h1", {}, "Nothing to show"),
    h("p", { role: "alert" }, `This page cannot be read: ${error.message}`));
  throw error;
}

let resizing = 0;
addEventListener("resize", () => {
  cancelAnimationFrame(resizing);
  resizing = requestAnimationFrame(() => panels.length && show());
});
matchMedia("(prefers-color-scheme: dark)").addEventListener("change",
  () => panels.length && show());
addEventListener("beforeprint", () => { setPaper(true); show(); });
addEventListener("afterprint", () => { setPaper(false); show(); });
addEventListener("hashchange", () => {
  readAddress();
  begin().catch(fail);
});

// For tests, and for teachers who want a page to do more.
globalThis.lesson = { names, state, go, run: runNamed, lessons: LESSONS,
  story: (name, at) => runs.get(name).story(at), asks: isQuestion,
  closeness, words: eventWords };

readAddress();
keys(Object.fromEntries(Object.entries(act).map(([name, does]) =>
  [name, (...given) => panels.length ? does(...given) : undefined])));
begin().catch(fail);
