// SPDX-License-Identifier: GPL-3.0-or-later
// The way in to the lessons, and what stands above each.
import { href } from "../../page/data/address.js";
import { h, link } from "../../page/parts/dom.js";
import { LESSONS, stepOf } from "../data/survey.js";
import { figureCount } from "../figures/all.js";

const to = (name) => href("", "", { a: name });

// What each sorts, when and by which method, as the survey's figure 29 has it.
export function lessonIndex(survey) {
  const known = survey.filter(({ name }) => LESSONS[name]);
  const classOf = (a) => [a.taxonomy, a.branch].filter(Boolean).join(", ");
  const row = (a, k) => h("tr", {},
    h("th", { scope: "row" }, link(to(a.name), `${k + 1}. ${a.title}`), h("br"),
      h("small", {}, [a.authors, a.year].filter(Boolean).join(", "))),
    h("td", {}, LESSONS[a.name].idea, h("br"), h("small", {}, classOf(a))),
    h("td", {}, a.sort_order ?? "–"),
    h("td", {}, h("ol", { class: "sorts" }, a.sorts.map((s) => h("li", {},
      h("b", {}, s.what), `, ${s.key}: ${s.method}, ${s.often}`)))),
    h("td", {}, a.coherence ?? "–"));
  return [
    h("h1", { tabindex: -1 }, "Hidden surfaces, step by step"),
    h("p", { class: "lead" }, "In 1974 Sutherland, Sproull and Schumacker compared " +
      "ten algorithms, and found that all of them sort: they differ in what they " +
      "sort, in which order, by which method, and in what they take to be much the " +
      "same from one place to the next. Here you can watch each of them at work."),
    h("p", {}, h("a", { class: "begin", href: to(known[0].name) },
      "Begin with the first")),
    h("div", { class: "table" }, h("div", { class: "scroll", tabindex: 0,
      role: "region", "aria-label": "The algorithms and their sorts" },
    h("table", { class: "figure-29" },
      h("caption", {}, "What each sorts, after figure 29 of the survey; choose one " +
        "to watch it."),
      h("thead", {}, h("tr", {}, ["algorithm", "idea", "order", "sorts",
        "coherence"].map((text) => h("th", { scope: "col" }, text)))),
      h("tbody", {}, known.map(row))))),
  ];
}

// The text of a lesson, with its steps worth seeing. go(k).
export function lessonText(survey, run, go) {
  const order = survey.map(({ name }) => name).filter((name) => LESSONS[name]);
  const place = order.indexOf(run.name);
  const lesson = LESSONS[run.name];
  if (!lesson) return null;
  const marks = lesson.see.map(([words, mark]) => [words, stepOf(run, mark)])
    .filter(([, k]) => k !== null);
  return h("section", { class: "lesson", "aria-label": "The lesson" },
    h("p", { class: "way" }, link("#/", "All lessons"),
      ` · ${place + 1} of ${order.length}`,
      place > 0 ? [" · ", link(to(order[place - 1]), "previous")] : null,
      place + 1 < order.length ? [" · ", link(to(order[place + 1]), "next")]
        : null),
    h("div", { class: "lesson-body" },
      h("div", {}, h("h2", {}, lesson.idea),
        lesson.text.map((text) => h("p", {}, text)),
        h("p", {}, h("small", {}, lesson.source, "."))),
      h("div", {}, h("h3", {}, "See"), h("ul", { class: "plain marks" },
        marks.map(([words, k]) => h("li", {}, h("button", { type: "button",
          "data-step": k, onclick: () => go(k) }, words)))),
      h("h3", {}, "Find out"), h("p", {}, lesson.ask),
      figureCount(run.name) ? h("p", {}, h("button", { type: "button", class: "plain",
        onclick: () => document.querySelector(".figures-box").scrollIntoView() },
      figureCount(run.name) === 1 ? "A figure of the paper, below"
        : "Figures of the paper, below")) : null)));
}
