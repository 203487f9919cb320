// SPDX-License-Identifier: GPL-3.0-or-later
// Before a decision, a question; the next step answers it.
import { subjectWords, whereWords } from "../data/words.js";
import { h } from "../../page/parts/dom.js";

const MEANINGS = { undecided: "undecided: neither is nearer all over, as far as " +
  "this comparison can tell; the algorithm divides and asks again." };

// Whether event k decides something that can be asked: between two faces or
// pieces, if the run ever compares two of these.
export function isQuestion(run, k) {
  if (k >= run.trace.kept) return false;
  run.asks ??= asksOf(run);
  return run.asks[run.trace.counter[k]] && !sumsUp(run, k);
}

// Whether the step before, of a line within its own, has decided it.
function sumsUp(run, k) {
  if (!k) return false;
  const [now, before] = [run.event(k), run.event(k - 1)];
  const isSame = (p, q) => p.kind === q.kind && p.ids.every((x, c) => x === q.ids[c]);
  return before.kind === "compare" && before.counter.line > now.counter.line &&
    isSame(now.a, before.a) && isSame(now.b, before.b);
}

function asksOf({ header, trace }) {
  const compares = header.counters.map((c, k) => c.kind === "compare" &&
    c.outcomes?.length > 1 && !c.computed && trace.counts[k] > 0);
  const ofFaces = header.counters.map(({ a, b }, k) => compares[k] &&
    [a, b].every((x) => x === "face" || x === "piece"));
  return ofFaces.includes(true) ? ofFaces : compares;
}

// The answers to choose from: of a counter with several questions, those to the
// question that is asked ("test 2: apart", but not "test 3: apart").
function answersTo({ counter, outcome }) {
  const of = (word) => word.includes(":") ? word.split(":")[0] : null;
  const same = counter.outcomes.filter((word) => of(word) === of(outcome));
  return same.length > 1 ? same : counter.outcomes;
}

// The question; if the line of the outline asks one of P and Q, that.
function questionOf(run, e) {
  const a = subjectWords(run, e.a, e.window);
  const b = subjectWords(run, e.b, e.window);
  const where = whereWords(run, e.window);
  const pair = `P is ${a}, Q is ${b}`;
  const line = run.header.outline[e.counter.line - 1].trim();
  const has = (word) => e.counter.outcomes.includes(word);
  const text = has("nearer") ? `Is ${a} nearer or farther than ${b}?`
    : has("passes through") ? `Does the plane of ${b} pass through ${a}?`
      : has("P may obscure Q") ? `${pair}: which of the six tests parts them?`
        : line.endsWith("?") && e.b.kind === "piece" ? `${pair}: ${line}`
          : `${e.counter.name}, ${a}${b ? ` against ${b}` : ""}: which is it?`;
  return text.charAt(0).toUpperCase() + text.slice(1) + (where && ` (${where})`);
}

// answered(): called when the reader has chosen and wants to go on.
export function quiz(answered) {
  const score = { right: 0, asked: 0 };
  const element = h("div", { class: "quiz", role: "group", hidden: true,
    "aria-label": "Question" });

  const ask = (run, k) => {
    const e = run.event(k);
    const answers = answersTo(e);
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
      h("p", {}, h("b", {}, questionOf(run, e))),
      h("div", { class: "buttons" }, answers.map((word) =>
        h("button", { type: "button",
          onclick: (event) => choose(word, event.currentTarget) }, word))),
      ...answers.filter((word) => MEANINGS[word]).map((word) =>
        h("p", {}, h("small", {}, MEANINGS[word]))),
      reply);
    element.querySelector("button").focus();
  };
  return { element, ask, hide: () => { element.hidden = true; },
    open: () => !element.hidden };
}
