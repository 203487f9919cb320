// SPDX-License-Identifier: GPL-3.0-or-later
// What stands around a run: the way through the lessons, the idea, the key moments,
// and something to find out.
import { firstLine } from "../data/branches.js";
import { href } from "../../page/data/address.js";
import { whole } from "../../page/data/format.js";
import { h, link } from "../../page/parts/dom.js";
import { figureCount } from "../figures/all.js";
import { lessonOf, LESSONS } from "../lessons/all.js";
import { GLOSSARY } from "../telling/glossary.js";
import { lacks, momentsOf } from "../telling/moments.js";
import { tellsWrong, wrongSamples } from "../telling/wrong.js";

const to = (name) => href("", "", { a: name });

// Where this lesson is among all of the page. survey: null if the page has none.
export function wayThrough(survey, run) {
  const order = Object.keys(LESSONS).filter((name) =>
    survey?.some((a) => a.name === name));
  const place = order.indexOf(run.name);
  if (place < 0) return null;
  return h("p", { class: "way" }, link("#/", "All lessons"),
    ` · ${place + 1} of ${order.length}`,
    place > 0 ? [" · ", link(to(order[place - 1]), "previous")] : null,
    place + 1 < order.length ? [" · ", link(to(order[place + 1]), "next")] : null);
}

// "Newell, …: the painter’s list, made safe".
export function ideaOf(run) {
  const lesson = lessonOf(run);
  return lesson ? `${run.name}: ${lesson.idea.charAt(0).toLowerCase()}${
    lesson.idea.slice(1)}` : `${run.name}: ${run.title}`;
}

// Of an algorithm that is known to be wrong: that it is, how much of this answer, and
// where to look; null of all others.
export function knownWrong(run, go) {
  if (!run.trace.knownWrong) return null;
  const known = "This algorithm is known to be wrong sometimes";
  const many = tellsWrong(run) ? wrongSamples(run).size : null;
  return h("p", { class: "known-wrong" }, many === null ? [`${known}: `,
    h("code", {}, `hsr check ${run.header.scene} -a ${run.name}`), " counts how often."]
    : many === 0 ? `${known}, but not in this view.`
      : [`${known}. Here ${many === 1 ? "one sample is" : `${whole(many)} samples are`
      } wrong: at the end, crosses mark ${many === 1 ? "it" : "them"}. `,
      h("button", { type: "button", class: "plain", onclick: () => go(run.n) },
        "Show")]);
}

// The text of a lesson, folded. go(k) shows a step, slides() all key moments.
export function lessonText(run, go, slides) {
  const lesson = lessonOf(run);
  return h("details", { class: "lesson", open: true },
    h("summary", {}, "The idea, the key moments, something to find out"),
    h("div", { class: "lesson-body" },
      h("div", {}, h("h2", {}, lesson?.idea ?? run.title),
        (lesson?.text ?? generalText(run)).map((text) => h("p", {}, text)),
        h("p", {}, h("small", {}, lesson?.source ?? run.header.algorithm.source, ".")),
        lackWords(run), figureLink(run)),
      h("div", {}, h("h3", {}, "Key moments"), momentList(run, go),
        h("p", {}, h("button", { type: "button", class: "plain", onclick: slides },
          "All of these as slides")),
        lesson ? findOut(run, lesson) : null, glossary())));
}

// Of an algorithm without a lesson: what it sorts, and what it takes to be alike.
function generalText(run) {
  const { trace } = run;
  return [[trace.order ? `It sorts ${trace.order.split("").join(", then ")}.` : "",
    trace.coherence ? `It bets on this: ${trace.coherence}.` : "",
    `Its first step: ${firstLine(run)}.`].filter(Boolean).join(" ")];
}

const lackWords = (run) => lacks(run).map(({ why, instead }) => h("p",
  { class: "lacks" }, why, " ", h("code", {}, `hsr lesson ${instead} -a ${run.name} ` +
    "-o lesson.html"), " shows it."));

const momentList = (run, go) => h("ol", { class: "marks" }, momentsOf(run).map((m) =>
  h("li", {}, h("button", { type: "button", "data-step": m.k,
    onclick: () => go(m.k) }, m.say))));

// The answer is behind a click; the run gives it.
function findOut(run, lesson) {
  const [question, answer] = lesson.find;
  return [h("h3", {}, "Find out"), h("details", { class: "find" },
    h("summary", {}, question), h("p", {}, answer(run)))];
}

const figureLink = (run) => figureCount(run.name) ? h("p", {}, h("button",
  { type: "button", class: "plain",
    onclick: () => document.querySelector(".figures-box").scrollIntoView() },
  figureCount(run.name) === 1 ? "A figure of the paper, below"
    : "Figures of the paper, below")) : null;

export const glossary = () => h("details", { class: "glossary" },
  h("summary", {}, "Words"), h("dl", {}, GLOSSARY.map(([word, meaning]) =>
    h("div", {}, h("dt", {}, word), h("dd", {}, meaning)))));
