// SPDX-License-Identifier: GPL-3.0-or-later
// The outline of the algorithm: the lines that this run comes to. The line that a step
// takes is marked; where the step asks in one line and goes on in another, both are.
// Below it, what its words mean, and what is drawn.
import { branchOf, unusedLines } from "../data/branches.js";
import { explained, glossed } from "../telling/glossary.js";
import { legendOf } from "../telling/legend.js";
import { h } from "../../page/parts/dom.js";

export function outlineOf(run) {
  const { outline } = run.header;
  const unused = unusedLines(run);
  const lines = outline.map((text, k) => h("li", {
    style: `--depth: ${(text.length - text.trimStart().length) / 2}`,
    class: unused[k] ? "unused" : null, value: k + 1,
    title: unused[k] ? "not in this run" : null }, text.trim()));
  const list = h("ol", { class: "outline", tabindex: 0,
    "aria-label": `What ${run.name} does` }, lines);
  const gloss = h("p", { class: "gloss" }), legend = h("p", { class: "gloss legend" });
  const idle = unused.filter(Boolean).length;
  const all = h("label", { class: "wider" }, h("input", { type: "checkbox",
    name: "all-lines", onchange: (e) => list.classList.toggle("whole",
      e.target.checked) }),
  `the ${idle === 1 ? "line" : `${idle} lines`} that this run does not come to`);
  let current = null, asked = null;

  const mark = (number, asks) => {
    const [next, from] = [lines[number - 1] ?? null, lines[asks - 1] ?? null];
    if (next !== current || from !== asked) {
      current?.removeAttribute("aria-current");
      asked?.classList.remove("asked");
      next?.setAttribute("aria-current", "step");
      if (from !== next) from?.classList.add("asked");
      [current, asked] = [next, from];
      gloss.replaceChildren(...glossed(next ? `${from?.textContent} ${
        next.textContent}` : ""));
    }
    reveal();
  };

  // Keeps the marked line in the list’s own view, which shows whole lines only.
  const reveal = () => {
    list.style.clipPath = "";
    if (!current || list.scrollHeight <= list.clientHeight) return;
    const shown = lines.filter((line) => line.offsetHeight);
    const from = current.offsetTop - list.clientHeight / 2;
    list.scrollTop = shown.find((line) => line.offsetTop >= from)?.offsetTop ?? from;
    const end = list.scrollTop + list.clientHeight;
    const first = shown.find((line) => line.offsetTop >= list.scrollTop - 1);
    const last = shown.findLast((line) => line.offsetTop + line.offsetHeight <= end + 1);
    if (first && last) list.style.clipPath = `inset(${first.offsetTop - list.scrollTop}px 0 ${
      end - last.offsetTop - last.offsetHeight}px 0)`;
  };

  new ResizeObserver(reveal).observe(list);

  // isAsked: the step is asked about, so that the line it takes is not told.
  const show = (k, e, isAsked = false) => {
    legend.replaceChildren(...explained(e && k < run.n ? legendOf(run, e) : []));
    const line = e?.counter.line ?? null;
    mark(e && !isAsked ? branchOf(run, e.k) : line, line);
  };
  return { element: h("div", { class: "outline-box" }, list, gloss,
    legend, idle ? all : null), show };
}
