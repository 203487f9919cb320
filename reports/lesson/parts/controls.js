// SPDX-License-Identifier: GPL-3.0-or-later
// The buttons and choices above the panels, and what keys do.
import { h } from "../../page/parts/dom.js";

export const LEVELS = { moment: "a key moment", unit: "a row or window",
  step: "a single step", whole: "the whole" };
export const TOGETHER = { share: "by share of the steps",
  decided: "by what is drawn", apart: "each by itself" };

const button = (label, title, onclick, attributes = {}) => h("button",
  { type: "button", title, "aria-label": title, onclick, ...attributes }, label);
const options = (all, chosen) => Object.entries(all).map(([value, label]) =>
  h("option", { value, selected: value === chosen }, label));
const labelled = (text, control) => h("label", {}, text, control);
const grouped = (text, ...parts) => h("div", { class: "field", role: "group",
  "aria-label": text }, h("span", {}, text), h("span", { class: "jump" }, parts));

// act: what is done: start, back, play, forward, end, goTo(k), set({ name: value }),
// jump(direction), jumpFace(direction). state: what is chosen at first.
export function controls(act, state, several) {
  const select = (name, all) => h("select", { name,
    onchange: (e) => act.set({ [name]: e.target.value }) },
  options(all, state[name]));
  const play = button("Play", "Play (space)", () => act.play(), { class: "play" });
  const speed = h("input", { type: "range", name: "speed", min: 0, max: 100,
    value: state.speed,
    oninput: (e) => act.set({ speed: Number(e.target.value) }) });
  const pace = h("span", { class: "pace" });
  const jumpTo = h("select", { name: "to", "aria-label": "Kind of step, or counter",
    onchange: (e) => act.set({ to: e.target.value }) });
  const face = h("input", { type: "number", name: "face", min: 0,
    "aria-label": "Number of a face",
    onchange: (e) => act.set({ face: e.target.value }) });
  const number = h("input", { type: "number", name: "number", min: 0, value: 0,
    onchange: (e) => act.goTo(Number(e.target.value)) });
  const quiz = h("input", { type: "checkbox", name: "quiz", checked: state.quiz,
    onchange: (e) => act.set({ quiz: e.target.checked }) });
  const outlines = h("input", { type: "checkbox", name: "outlines",
    checked: state.outlines,
    onchange: (e) => act.set({ outlines: e.target.checked }) });

  const element = h("form", { class: "controls", "aria-label": "Stepping",
    onsubmit: (e) => e.preventDefault() },
  h("div", { class: "buttons" },
    button("|◀", "To the start (Home)", act.start, { name: "start" }),
    button("◀", "Back (left arrow)", act.back, { name: "back" }),
    play,
    button("▶", "Forward (right arrow)", act.forward, { name: "forward" }),
    button("▶|", "To the end (End)", act.end, { name: "end" })),
  labelled("Move by", select("level", LEVELS)),
  labelled("Speed", h("span", { class: "speed" }, speed, pace)),
  several ? labelled("Together", select("by", TOGETHER)) : null,
  h("label", { class: "check" }, quiz, "ask me questions"),
  h("details", { class: "more" }, h("summary", {}, "More"),
    h("div", { class: "more-fields" },
      labelled("Step", number),
      grouped("Previous and next",
        button("‹", "Previous one of this kind (p)", () => act.jump(-1)), jumpTo,
        button("›", "Next one of this kind (n)", () => act.jump(1))),
      grouped("Of face",
        button("‹", "Previous step of this face (Shift+f)", () => act.jumpFace(-1)),
        face, button("›", "Next step of this face (f)", () => act.jumpFace(1))),
      h("label", { class: "check" }, outlines, "outlines of all faces"),
      h("button", { type: "button", class: "save", onclick: act.save },
        "Save this step as SVG"),
      keyHelp())));

  return {
    element,
    focus: () => play.focus({ preventScroll: true }),
    playing: (is) => {
      play.textContent = is ? "Pause" : "Play";
      play.title = is ? "Pause (space)" : "Play (space)";
      play.setAttribute("aria-label", play.title);
    },
    pace: (text, value) => {
      pace.textContent = text;
      speed.value = value;
      speed.setAttribute("aria-valuetext", text);
    },
    level: (name) => { element.elements.level.value = name; },
    quiz: (is) => { quiz.checked = is; },
    step: (k) => { if (Number(number.value) !== k) number.value = k; },
    // What can be jumped to in this run.
    offer: (run, chosen, faceChosen) => {
      const own = run.header.counters.filter((c) => !c.computed);
      const kinds = [...new Set(own.map((c) => c.kind))];
      const groups = [["a kind of step", kinds.map((k) => [`kind:${k}`, k])],
        ["a counter", own.map((c) => [`counter:${c.name}`, c.name])]];
      jumpTo.replaceChildren(...groups.map(([label, all]) =>
        h("optgroup", { label }, all.map(([value, text]) => h("option",
          { value, selected: value === chosen }, text)))));
      number.max = run.n;
      face.max = run.header.faces.length - 1;
      face.value = faceChosen;
      return jumpTo.value;
    },
  };
}

// Keys for everything; in fields that take letters and arrows themselves they
// keep their own meaning. isOn(): whether they do anything now.
export function keys(act, isOn = () => true) {
  const taken = (e) => e.target.closest("select, input[type=number]") ||
    (e.target.closest("input[type=range]") && /^(Arrow|Home|End|Page)/.test(e.key))
    || e.altKey || e.ctrlKey || e.metaKey;
  const pressing = (e) => e.key === " " && e.target.closest(
    "button, summary, a, input[type=checkbox]");
  const does = {
    ArrowRight: (e) => e.shiftKey ? act.move(1, "unit") : act.forward(),
    ArrowLeft: (e) => e.shiftKey ? act.move(-1, "unit") : act.back(),
    ".": () => act.move(1, "step"), ",": () => act.move(-1, "step"),
    Home: act.start, End: act.end, " ": act.play,
    n: () => act.jump(1), p: () => act.jump(-1),
    f: () => act.jumpFace(1), F: () => act.jumpFace(-1),
    l: act.nextLevel, q: act.toggleQuiz,
    "+": () => act.faster(1), "-": () => act.faster(-1),
    1: () => act.leadNumber(0), 2: () => act.leadNumber(1),
    3: () => act.leadNumber(2),
    Escape: () => act.pixel(null),
  };
  addEventListener("keydown", (e) => {
    if (!isOn() || !Object.hasOwn(does, e.key) || taken(e) || pressing(e)) return;
    e.preventDefault();
    does[e.key](e);
  });
}

const KEYS = [["space", "play and pause"], ["← →", "back and forward"],
  ["Shift ← →", "a row or window"], [", .", "a single step, always"],
  ["Home End", "start and end"], ["l", "deeper: moments, rows, steps"], ["+ −", "speed"],
  ["n p", "next and previous step of the kind chosen"],
  ["f Shift+f", "next and previous step of the face chosen"],
  ["1 2 3", "which algorithm leads"], ["q", "questions on and off"],
  ["arrows on a picture", "choose a sample"], ["Esc", "no sample"]];

function keyHelp() {
  return h("dl", { class: "key-help" }, KEYS.map(([key, what]) => h("div", {},
    h("dt", {}, h("kbd", {}, key)), h("dd", {}, what))));
}
