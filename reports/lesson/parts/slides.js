// SPDX-License-Identifier: GPL-3.0-or-later
// The key moments of a run as slides, one a page: to be shown, printed, or saved as a
// PDF by the browser. Each has its picture, what is told, the marked line, and notes.
import { branchOf, unusedLines } from "../data/branches.js";
import { eventWords } from "../data/words.js";
import { glossed } from "../telling/glossary.js";
import { momentsOf } from "../telling/moments.js";
import { whole } from "../../page/data/format.js";
import { h } from "../../page/parts/dom.js";
import { saveStep, stepDrawing } from "./save_step.js";

// back(): leads back to the run.
export function slides(run, back) {
  const unused = unusedLines(run);
  const all = momentsOf(run);
  return h("div", { class: "slides" },
    h("p", { class: "buttons" },
      h("button", { type: "button", onclick: () => print() }, "Print, or save as PDF"),
      " ", h("button", { type: "button", onclick: back }, "Back")),
    all.map((moment, n) => slide(run, moment, { n, of: all.length, unused })));
}

function slide(run, { k, say }, { n, of, unused }) {
  const e = k <= run.trace.kept && k < run.n ? run.event(k - 1) : null;
  const line = e ? branchOf(run, e.k) : null;
  const lines = run.header.outline.map((text, l) => unused[l] ? null : h("li",
    { style: `--depth: ${(text.length - text.trimStart().length) / 2}`,
      "aria-current": line === l + 1 ? "step" : null }, text.trim()));
  return h("section", { class: "slide", "aria-label": `Slide ${n + 1}` },
    h("h2", {}, say),
    h("div", { class: "slide-body" }, stepDrawing(run, k, true, false),
      h("div", {}, e ? h("p", {}, eventWords(run, e)) : null,
        h("ol", { class: "outline" }, lines),
        h("p", { class: "gloss" }, e ? [`${e.counter.name}: ${e.counter.meaning}. `,
          line ? glossed(run.header.outline[line - 1]) : null] : null))),
    h("p", { class: "where" }, `${run.title}, ${n + 1} of ${of}, step ${whole(k)} `,
      h("button", { type: "button", class: "save", onclick: () =>
        saveStep(run, k, { outlines: true }) }, "Save SVG")));
}
