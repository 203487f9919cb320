// SPDX-License-Identifier: GPL-3.0-or-later
// Before a decision, a question; the next step answers it.
import { subjectWords } from "../data/words.js";
import { h } from "../../page/parts/dom.js";

const DEPTHS = ["nearer", "farther", "behind", "in front", "hides"];

// Whether event k decides something that can be asked: in depth, if the run
// compares depths at all.
export function isQuestion(run, k) {
  if (k >= run.trace.kept) return false;
  const { counters } = run.header;
  run.asks ??= asksOf(counters);
  return run.asks[run.trace.counter[k]];
}

function asksOf(counters) {
  const compares = (c) => c.kind === "compare" && c.outcomes?.length > 1 &&
    !c.computed;
  const deep = (c) => compares(c) && c.outcomes.some((x) => DEPTHS.includes(x));
  return counters.map(counters.some(deep) ? deep : compares);
}

// answered(): called when the reader has chosen and wants to go on.
export function quiz(answered) {
  const score = { right: 0, asked: 0 };
  const element = h("div", { class: "quiz", role: "group", hidden: true,
    "aria-label": "Question" });

  const ask = (run, k) => {
    const e = run.event(k);
    const a = subjectWords(run, e.a, e.window);
    const b = subjectWords(run, e.b, e.window);
    const question = e.counter.outcomes.includes("nearer")
      ? `Which is nearer: is ${a}, nearer or farther than ${b}?`
      : `${a}${b ? ` against ${b}` : ""}: which is it?`;
    const reply = h("p", { role: "status" });
    const choose = (word, button) => {
      score.asked += 1;
      score.right += word === e.outcome ? 1 : 0;
      reply.textContent = `${word === e.outcome ? "Yes" : "No"}: ${e.outcome}. ${
        score.right} of ${score.asked} right. `;
      for (const other of button.parentNode.children) other.disabled = true;
      const on = h("button", { type: "button", onclick: () => {
        element.hidden = true;
        answered();
      } }, "Go on");
      reply.append(on);
      on.focus();
    };
    element.hidden = false;
    element.replaceChildren(
      h("p", {}, h("b", {}, question.charAt(0).toUpperCase() + question.slice(1))),
      h("div", { class: "buttons" }, e.counter.outcomes.map((word) =>
        h("button", { type: "button",
          onclick: (event) => choose(word, event.currentTarget) }, word))),
      reply);
    element.querySelector("button").focus();
  };
  return { element, ask, hide: () => { element.hidden = true; },
    open: () => !element.hidden };
}
