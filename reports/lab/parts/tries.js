// SPDX-License-Identifier: GPL-3.0-or-later
// The line of welcome, with experiments to begin with; and below it a note to whoever
// opens the link, as a teacher's task.
import { h } from "../../page/parts/dom.js";

const TRIES = [
  ["Why the painter fails", { s: "cyclic-overlap", a: "painter,newell",
    overlay: "differ", note: "Each bar lies over the next, so no order to paint them " +
      "is right. Turn the picture: where is the painter wrong? Then choose Step, and " +
      "see where Newell divides a bar." }],
  ["Newell divides", { s: "soup:2:6", a: "newell", mode: "step", to: "kind:split",
    note: "Two triangles penetrate. Press › for the next division. Which plane " +
      "divides which piece?" }],
  ["Double Warnock’s work", { s: "house", a: "warnock", overlay: "work",
    held: 1, note: "Warnock divides each window that is not simple yet. Its first " +
      "counts are held. Edit the house, add to it, come nearer, or choose another " +
      "size, until it subdivides twice as often: a ratio of 2." }],
  ["Watkins against Bouknight", { s: "harbor:800", a: "watkins,bouknight",
    mode: "measure", mwhat: "counter:spans", note: "Press Measure all. Which of " +
      "the two shows fewer spans? Then count all comparisons: which makes fewer? In " +
      "the scene deep-stack, in Look, it is the other way round. Why?" }],
];

const LONGEST = 400; // letters of a note

export function welcome(lab) {
  const { state } = lab;
  const field = h("input", { type: "text", name: "note", maxlength: LONGEST,
    hidden: true, "aria-label": "A note that is in the link",
    placeholder: "A note or a task, which is in the link",
    onchange: () => lab.set({ note: field.value.trim() }),
    onkeydown: (e) => e.key === "Enter" && edit(false) });
  const words = h("span", {});
  const said = h("p", { class: "task" }, words, " ", h("button", { type: "button",
    class: "quiet", onclick: () => lab.set({ note: "" }) }, "Done with it"));
  const edit = (is) => {
    field.hidden = !is;
    if (is) field.focus();
  };
  const show = () => {
    words.textContent = state.note;
    said.hidden = !state.note;
    field.value = state.note;
  };
  lab.when("note", show);
  show();
  return h("div", { class: "welcome" },
    h("p", {}, h("b", {}, "Sixty hidden-surface algorithms at work, live."),
      " Drag the picture, or:"),
    h("ul", { class: "plain" }, TRIES.map(([words, params]) => h("li", {}, h("a", {
      href: `#/?${new URLSearchParams(params)}` }, words)))),
    h("button", { type: "button", class: "quiet", onclick: () => edit(field.hidden),
      title: "A note or a task, which is in the link" }, "note"),
    said, field);
}
