// SPDX-License-Identifier: GPL-3.0-or-later
// Before a key moment, a question; the step answers it, and says why.
import { askedWords, eventWords } from "../data/words.js";
import { h } from "../../page/parts/dom.js";

// answered(question): called when the reader has chosen and wants to go on.
export function quiz(answered) {
  const score = { right: 0, asked: 0 };
  let goOn = null; // once the reader has chosen
  const done = new Set();
  const element = h("div", { class: "quiz", role: "group", hidden: true,
    "aria-label": "Question" });
  const scored = () => `${score.right} of ${score.asked} right so far.`;

  function ask(run, question) {
    goOn = null;
    const reply = h("p", { role: "status" });
    const buttons = question.answers.map(([word, label]) => h("button",
      { type: "button", "data-answer": word, onclick: () => choose(word) }, label));
    const choose = (word) => {
      const isRight = word === question.right;
      const [, label] = question.answers.find(([w]) => w === question.right);
      done.add(question.k);
      score.asked += 1;
      score.right += isRight ? 1 : 0;
      buttons.forEach((b) => {
        b.disabled = true;
        const of = b.dataset.answer;
        b.classList.toggle("is-right", of === question.right);
        b.classList.toggle("is-wrong", of === word && !isRight);
      });
      goOn = () => {
        element.hidden = true;
        answered(question);
      };
      const on = h("button", { type: "button", onclick: goOn }, "Go on");
      reply.replaceChildren(h("b", {}, isRight ? "Right" : `Not so. The answer: ${label}`), ". ",
        eventWords(run, run.event(question.k - 1)), ". ", h("small", {}, scored()),
        " ", on);
      on.focus({ preventScroll: true });
    };
    element.hidden = false;
    element.replaceChildren(h("p", { tabindex: -1 }, h("b", {}, question.text), " ",
      h("small", {}, askedWords(run, run.event(question.k - 1)))),
      h("div", { class: "buttons" }, buttons), reply);
    element.firstChild.focus({ preventScroll: true });
  }

  // Somebody wants to go on without an answer.
  function remind() {
    element.querySelector("p[role=status]").textContent =
      "Choose an answer first; the key q goes on without questions.";
  }

  // At the end of a run with n questions.
  function result(n) {
    element.hidden = false;
    element.replaceChildren(h("p", { role: "status" }, h("b", {}, `${score.right} of ${
      score.asked} questions answered right`), score.asked < n
      ? `; this run has ${n}.` : "."));
  }

  return { element, ask, remind, result, goOn: () => goOn(),
    isChosen: () => goOn !== null, score: () => score,
    isAnswered: ({ k }) => done.has(k),
    hide: () => { element.hidden = true; },
    open: () => !element.hidden && Boolean(element.querySelector(".buttons")) };
}
