// SPDX-License-Identifier: GPL-3.0-or-later
// The way in to the lessons: the tree of figure 13, and the course in its order.
import { href } from "../../page/data/address.js";
import { h, link } from "../../page/parts/dom.js";
import { taxonomyTree } from "../../page/parts/taxonomy.js";
import { LESSONS } from "../lessons/all.js";
import { survivorsFigure } from "../figures/survivors.js";
import { glossary } from "./lesson.js";

const to = (name) => href("", "", { a: name });

// survivors: null if the page has none.
export function courseIndex(survey, survivors) {
  const known = Object.keys(LESSONS).map((name) => survey.find((a) => a.name === name))
    .filter(Boolean);
  return [
    h("h1", { tabindex: -1 }, "Hidden surfaces, step by step"),
    h("p", { class: "lead" }, "In 1974 Sutherland, Sproull and Schumacker compared " +
      "ten algorithms, and found that all of them sort: they differ in what they " +
      "sort, in which order, by which method, and in what they take to be much the " +
      "same from one place to the next. Here you can watch each of them at work. " +
      "Four simple ones come first, two later ones last."),
    h("p", {}, h("a", { class: "begin", href: to(known[0].name) },
      "Begin with the first")),
    taxonomyTree(known, { to, said: (name) => LESSONS[name].idea,
      end: "Choose one to watch it." }),
    courseTable(known),
    survivors && survivorsFigure(survivors),
    glossary(),
  ].filter(Boolean);
}

// What each sorts, when and by which method, as the survey's figure 29 has it.
function courseTable(known) {
  const row = (a, k) => h("tr", {},
    h("th", { scope: "row" }, link(to(a.name), `${k + 1}. ${a.title}`), h("br"),
      h("small", {}, [a.authors, a.year].filter(Boolean).join(", "))),
    h("td", {}, LESSONS[a.name].idea),
    h("td", {}, a.sort_order ?? "–"),
    h("td", {}, a.sorts.length ? h("ol", { class: "sorts" }, a.sorts.map((s) => h("li", {},
      h("b", {}, s.what), `, ${s.key}: ${s.method}, ${s.often}`))) : "none"),
    h("td", {}, a.coherence ?? "–"));
  return h("div", { class: "table" }, h("div", { class: "scroll", tabindex: 0,
    role: "region", "aria-label": "The algorithms and their sorts" },
  h("table", { class: "figure-29" },
    h("caption", {}, "The course. What each sorts is after figure 29 of the survey."),
    h("thead", {}, h("tr", {}, ["algorithm", "idea", "order", "sorts", "coherence"]
      .map((text) => h("th", { scope: "col" }, text)))),
    h("tbody", {}, known.map(row)))));
}
