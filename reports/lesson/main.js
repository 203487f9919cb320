// SPDX-License-Identifier: GPL-3.0-or-later
// The page of hsr lesson: up to three algorithms at work on one view, stepped
// through together. One of them leads; the others follow it.
import { read, set as setAddress } from "../page/data/address.js";
import { h } from "../page/parts/dom.js";
import { figures } from "./figures/all.js";
import { closeness } from "./data/projection.js";
import { runOf } from "./data/run.js";
import { contradicts, numbersOf } from "./data/numbers.js";
import { searchAt } from "./data/stretches.js";
import { readTrace } from "./data/trace.js";
import { eventWords } from "./data/words.js";
import { lessonOf, LESSONS } from "./lessons/all.js";
import { looksOf, unseen } from "./looks/all.js";
import { areaOf } from "./looks/clipped.js";
import { markerLooks } from "./looks/tests.js";
import { keys, LEVELS, TOGETHER } from "./parts/controls.js";
import { courseIndex } from "./parts/course.js";
import { ideaOf, knownWrong, lessonText, wayThrough } from "./parts/lesson.js";
import { player, playerState } from "./parts/player.js";
import { whenLooksChange } from "./parts/redraw.js";
import { stepDrawing } from "./parts/save_step.js";
import { slides } from "./parts/slides.js";
import { GLOSSARY } from "./telling/glossary.js";
import { momentsOf } from "./telling/moments.js";
import { secondsOf } from "./telling/pace.js";
import { questionsOf } from "./telling/questions.js";

const MOST = 3; // algorithms side by side
const main = document.querySelector("main");
const scripts = [...document.querySelectorAll("script.run")];
const texts = new Map(scripts.map((e) => [e.dataset.name, e.textContent]));
const scenes = new Map(scripts.map((e) => [e.dataset.name, e.dataset.scene]));
const labs = new Map(scripts.map((e) => [e.dataset.name, e.dataset.lab]));
const parsed = (id) =>
  JSON.parse(document.querySelector(`#${id}`)?.textContent ?? "null");
const survey = parsed("survey"); // of the lessons; null: the page is of one scene
const names = [...texts.keys()];
const runs = new Map();

const state = { a: [], ...playerState(), level: "moment" };
const playing = player(state, writeAddress);

async function runNamed(name) {
  if (!runs.has(name)) runs.set(name, runOf(await readTrace(texts.get(name))));
  return runs.get(name);
}

// --- The address ---

let known = ""; // the address, as it was last read or written

function readAddress() {
  known = location.hash;
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
  state.level = one("level", LEVELS, "moment");
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

// Written when all rests: browsers limit the number of changes a second. Where a reader
// has just gone is not written over.
let waiting = 0;
function writeAddress() {
  clearTimeout(waiting);
  if (!state.a.length) return;
  waiting = setTimeout(() => {
    if (location.hash !== known) return;
    setAddress(changes());
    known = location.hash;
  }, 200);
}

const changes = () => ({ a: state.a.join(","),
  k: state.k.join(","), lead: state.lead || null,
  level: state.level === "moment" ? null : state.level,
  by: state.by === "share" ? null : state.by, speed: state.speed,
  to: state.to, face: state.face, quiz: state.quiz ? 1 : null,
  outlines: state.outlines ? null : 0,
  at: state.pixel ? `${state.pixel.i},${state.pixel.j}` : null });

// --- The page ---

function chooser() {
  const choose = (p) => (e) => {
    const a = state.a.slice();
    if (e.target.value) a[p] = e.target.value;
    else a.splice(p, 1);
    state.a = [...new Set(a)];
    if (!p) state.k = []; // another run is seen from its beginning
    keepToOneScene();
    state.lead = 0;
    begin().catch(fail);
  };
  const slot = (p) => h("label", {}, h("span", {}, p ? "beside" : "algorithm"),
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
  playing.end();
  main.replaceChildren(...courseIndex(survey, parsed("survivors")));
  document.title = "Hidden surfaces, step by step · hsr";
}

let begun = 0;
let shownLast = ""; // the first algorithm, or "": another one is seen from the top

async function begin() {
  const own = ++begun;
  if (!state.a.length) {
    shownLast = "";
    return showIndex();
  }
  const shown = await Promise.all(state.a.map(runNamed));
  if (own !== begun) return; // the reader has gone elsewhere
  const [first] = shown;
  const { bar, note, question, legend, panels } = playing.begin(shown);
  const work = h("div", { class: "at-work" }, bar, note, question, panels);
  // From the lesson's text to a step: keys are for the player again.
  const goTo = (k) => {
    playing.stop();
    playing.lead(0);
    playing.go(k);
    playing.focus();
    scrollTo(0, 0);
    if (panels.getBoundingClientRect().top > innerHeight / 2) work.scrollIntoView();
  };
  main.replaceChildren(
    h("div", { class: "top" }, h("div", { class: "title" },
      wayThrough(survey, first), h("h1", { tabindex: -1 }, ideaOf(first)),
      h("p", { class: "kicker" }, sceneWords(first), tryIt()),
      knownWrong(first, goTo)), chooser()),
    work, lessonText(first, goTo, () => showSlides(first)), legend,
    figures(first, (name) =>
      scenes.get(name) === scenes.get(state.a[0]) ? runNamed(name) : null) || "");
  document.title = `${sceneName(first)}: ${state.a.join(", ")} · hsr`;
  playing.open();
  if (state.a[0] !== shownLast) scrollTo(0, 0);
  shownLast = state.a[0];
}

function showSlides(run) {
  playing.end();
  main.replaceChildren(h("h1", { tabindex: -1 }, ideaOf(run)),
    slides(run, () => begin().catch(fail)));
  scrollTo(0, 0);
}

// The scene's own name, without the folders of its file.
const sceneName = ({ header }) => header.scene.replace(/@.*/, "").replace(/^.*\//, "")
  .replace(/\.(scene\.json|\w{2,4})$/, "");

function sceneWords(run) {
  const { view, faces } = run.header;
  return `${sceneName(run)}, view ${view.number}, ${view.width} × ${view.height} ` +
    `samples, ${facesWords(run, faces.length)}. ${run.kind.hint ?? ""}`;
}

// How many faces the scene has, and how many of them the steps name, if these are
// fewer: the others turn their backs to the eye, or are outside of the picture.
function facesWords(run, n) {
  const named = run.kind.holdsFaces ? run.facesNamed() : 0;
  return named && named < n ? `${named} of ${n} faces take part`
    : `${n} ${n === 1 ? "face" : "faces"}`;
}

// The same view in the laboratory, if the page knows where that is.
function tryIt() {
  const lab = labs.get(state.a[0]);
  return lab ? [" ", h("a", { class: "try", href: `${lab}&a=${state.a.join(",")}` },
    "Try it in the laboratory")] : null;
}

function fail(error) {
  main.replaceChildren(h("h1", {}, "Nothing to show"),
    h("p", { role: "alert" }, `This page cannot be read: ${error.message}`));
  throw error;
}

whenLooksChange(playing.show);
addEventListener("hashchange", () => {
  readAddress();
  begin().catch(fail);
});

// For tests, and for teachers who want a page to do more.
globalThis.lesson = { names, state, go: playing.go, run: runNamed, lessons: LESSONS,
  story: (name, at) => runs.get(name).story(at), closeness, words: eventWords,
  moments: momentsOf, questions: questionsOf, lesson: lessonOf, unseen, numbersOf,
  contradicts, drawing: stepDrawing, seconds: secondsOf, looks: looksOf, searchAt,
  markers: markerLooks, areaOf, glossary: GLOSSARY };

readAddress();
keys(playing.act);
begin().catch(fail);
