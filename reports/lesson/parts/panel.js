// SPDX-License-Identifier: GPL-3.0-or-later
// One algorithm at work: its picture, the step in words, its outline, and its
// counters beside the survey's prediction.
import { kindLook } from "../data/kinds.js";
import { count, whole } from "../../page/data/format.js";
import { h } from "../../page/parts/dom.js";
import { formula } from "../../page/parts/symbols.js";
import { beside } from "../beside/all.js";
import { outlineOf } from "./outline.js";
import { picture } from "./picture.js";
import { sentence } from "./sentence.js";
import { storyList } from "./story_list.js";
import { timeline } from "./timeline.js";

// act: { go(k), pixel({ i, j }), pixelNow(), lead() }
export function panel(run, act) {
  const canvas = h("canvas", { class: "picture", tabindex: 0, role: "application",
    style: `aspect-ratio: ${run.width} / ${run.height}`,
    "aria-label": `The picture that ${run.name} makes. Arrow keys choose a ` +
      "sample, with Shift eight samples on; its story is told beside it." });
  const view = picture(canvas, run);
  const line = timeline(run, act.go);
  const said = sentence(run);
  const outline = outlineOf(run);
  const counters = counterTable(run);
  const costs = costTable(run);
  const strip = run.kind.strip?.(run);
  const around = beside(run);
  const story = storyList(run, act.go);
  chooseSamples(canvas, view, run, act);

  // options.asked: an event that is asked about, which is shown undecided.
  const show = (k, options) => {
    view.draw(k, options);
    line.draw(k);
    const e = k > 0 && k <= run.trace.kept ? run.event(k - 1) : null;
    const asked = Number.isInteger(options.asked) ? run.event(options.asked) : null;
    said.show(k, e);
    outline.show(k, asked ?? e, Boolean(asked));
    strip?.show(k, e);
    around.show(k, asked ?? e);
    counters.show(k, e?.number);
    costs.show(k);
    story.show(k);
  };

  const element = h("section", { class: "panel", "aria-label": run.title,
    style: `--shape: ${run.width / run.height}` },
    h("h2", {}, run.title), h("p", { class: "facts-line" }, factsOf(run)),
    h("div", { class: "left" },
      h("div", { class: "seen" }, canvas, line.element, strip?.element)),
    h("div", { class: "right" }, said.element,
      h("div", { class: "told" }, h("div", { class: "does" },
        h("h3", {}, "What it does"), outline.element),
      h("div", { class: "around", tabindex: 0, role: "region",
        "aria-label": "What stands beside the scene" }, story.element, around.element))),
    h("details", { class: "counted" }, h("summary", {}, "What it has counted"),
      h("div", { class: "counted-body" }, counters.element, costs.element)));
  element.addEventListener("focusin", () => act.lead());
  return { element, show, run, view,
    ask: (question) => said.element.after(question),
    story: (place) => story.tell(place),
    live: (is) => said.element.setAttribute("aria-live", is ? "polite" : "off") };
}

function factsOf({ header, trace }) {
  const { authors, year, adapted } = header.algorithm;
  return [[authors, year].filter(Boolean).join(", "),
    trace.order && `sorts ${trace.order}`, trace.coherence,
    adapted.length && `the scene was adapted: ${adapted.join(", ")}`]
    .filter(Boolean).join(" · ");
}

// A sample is chosen by a click, or by arrow keys.
function chooseSamples(canvas, view, run, act) {
  canvas.addEventListener("pointerdown", (e) => {
    act.lead();
    act.pixel(view.at(e));
  });
  canvas.addEventListener("keydown", (e) => {
    const step = e.shiftKey ? 8 : 1;
    const move = { ArrowLeft: [-step, 0], ArrowRight: [step, 0],
      ArrowUp: [0, -step], ArrowDown: [0, step] }[e.key];
    if (!move) return;
    e.preventDefault();
    e.stopPropagation();
    const { i, j } = act.pixelNow() ?? { i: run.width >> 1, j: run.height >> 1 };
    act.pixel({ i: Math.min(run.width - 1, Math.max(0, i + move[0])),
      j: Math.min(run.height - 1, Math.max(0, j + move[1])) });
  });
}

// The counters so far, and in the end. Those that stay 0 are folded.
function counterTable(run) {
  const { counters } = run.header;
  const { counts } = run.trace;
  const cells = counters.map(() => h("td", { class: "number" }));
  const rows = counters.map((c, k) => {
    const look = kindLook(c.kind);
    return h("tr", { title: c.meaning, "data-counter": k }, h("th", { scope: "row" },
      h("span", { class: "sign", "aria-hidden": "true",
        style: `color: var(--hue-${look.hue})` }, look.sign), c.name),
    cells[k], h("td", { class: "number faint" }, whole(counts[k])));
  });
  const sumOf = (values) => counters.reduce((sum, { kind }, c) =>
    sum + (kind === "compare" ? values[c] ?? 0 : 0), 0);
  const all = h("td", { class: "number" });
  const table = (label, body, foot) => h("table", { class: "counters",
    "aria-label": label },
  h("thead", {}, h("tr", {}, h("th", { scope: "col" }, "counter"),
    h("th", { scope: "col", class: "number" }, "so far"),
    h("th", { scope: "col", class: "number" }, "in the end"))),
  h("tbody", {}, body), foot);
  const idle = rows.filter((_, c) => !counts[c]);
  let last = null;
  return {
    element: h("div", {}, table("Counters", rows.filter((_, c) => counts[c]),
      h("tfoot", {}, h("tr", {}, h("th", { scope: "row" }, "all comparisons"), all,
        h("td", { class: "number faint" }, whole(sumOf(counts)))))),
    idle.length ? h("details", { class: "idle" }, h("summary", {},
      idle.length === 1 ? "One counter stayed 0" : `${idle.length} counters stayed 0`),
    table("Counters that stayed 0", idle)) : null),
    show: (k, raised) => {
      const now = run.counts(k);
      now.forEach((x, c) => {
        const text = x === null ? "at the end" : whole(x);
        if (cells[c].textContent !== text) cells[c].textContent = text;
      });
      all.textContent = whole(sumOf(now));
      last?.classList.remove("raised");
      last = raised === undefined ? null : rows[raised];
      last?.classList.add("raised");
    },
  };
}

// The steps of Table III: what they cost so far, and what the survey predicts. A
// step's cost is the sum of its counters, each times its weight.
function costTable(run) {
  const { costs, letters } = run.trace;
  if (!costs.some((c) => c.predicted !== null))
    return { element: null, show: () => {} };
  const termOf = ([c, weight], k) => {
    const sign = weight < 0 ? "−" : k ? "+" : "", size = Math.abs(weight);
    return [k ? ` ${sign} ` : sign, size === 1 ? "" : `${whole(size)} × `,
      run.header.counters[c].name].join("");
  };
  const cells = costs.map(() => h("td", { class: "number" }));
  const sums = costs.map(({ terms }) =>
    terms.filter(([n]) => run.trace.counts[n]).map(termOf).join(""));
  const rows = costs.map((c, k) => h("tr", {}, h("th", { scope: "row" }, c.label,
    sums[k] && sums[k] !== c.label ? [h("br"), h("small", {}, sums[k])] : null),
  cells[k], h("td", { class: "number" }, count(c.predicted)),
  h("td", {}, c.formula ? lettered(c.formula, letters) : "")));
  const used = letters.filter(([symbol]) =>
    costs.some((c) => lettersIn(c.formula ?? "").includes(symbol)));
  return {
    element: h("div", {},
      h("h3", {}, "Weighed steps, and the survey’s prediction"),
      h("p", { class: "note" }, "The survey weighs steps by their work: here each " +
        "counter is multiplied by its weight."),
      h("div", { class: "scroll", tabindex: 0, role: "region", "aria-label":
        `Weighed steps of ${run.name}, and the survey’s prediction` },
      h("table", { class: "costs" },
        h("thead", {}, h("tr", {}, ["step of Table III", "so far, weighed",
          "predicted", "by the formula"].map((text, k) => h("th", { scope: "col",
          class: k === 1 || k === 2 ? "number" : null }, text)))),
        h("tbody", {}, rows))),
      h("p", { class: "note" }, used.map(([symbol, meaning, value], k) => [
        k ? "; " : "", formula(symbol), `: ${meaning}${
          value === null ? "" : ` (${count(value)})`}`]))),
    show: (k) => {
      const counts = run.counts(k);
      costs.forEach(({ terms }, row) => {
        const cost = terms.reduce((sum, [c, factor]) =>
          sum + factor * (counts[c] ?? 0), 0);
        cells[row].textContent = count(cost);
      });
    },
  };
}

const LETTER = /([A-Z]_[a-z]|\b[nm]\b)/;
const lettersIn = (text) => text.split(LETTER).filter((_, k) => k % 2);

// A formula whose letters say what they mean.
function lettered(text, letters) {
  return text.split(LETTER).map((part, k) => k % 2
    ? h("abbr", { title: letters.find(([symbol]) => symbol === part)?.[1] },
      formula(part)) : formula(part));
}
