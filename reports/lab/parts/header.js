// SPDX-License-Identifier: GPL-3.0-or-later
// The head of the page: modes, and what to do with what is shown.
import { h } from "../../page/parts/dom.js";
import { MODES } from "../state/lab.js";

// act: { link() -> a promise of the words, save: [[label, title, does]] }
export function header(lab, act) {
  const { state } = lab;
  const said = h("span", { class: "said", role: "status" });
  let clearing = 0;
  const say = (text) => {
    said.textContent = text;
    clearTimeout(clearing);
    clearing = setTimeout(() => { said.textContent = ""; }, 6000);
  };
  const modes = h("div", { class: "modes", role: "group", "aria-label": "What to do" },
    Object.entries(MODES).map(([name, text]) => h("button", { type: "button",
      "data-mode": name, onclick: () => lab.set({ mode: name }) }, text)));
  const show = () => {
    for (const b of modes.children)
      b.setAttribute("aria-pressed", b.dataset.mode === state.mode);
  };
  lab.when("mode", show);
  show();
  return { say, element: h("header", { class: "lab-head" },
    h("p", { class: "name" }, "hsr ", h("small", {}, "the laboratory")), modes,
    h("div", { class: "acts" }, said, h("button", { type: "button", class: "main-act",
      title: "Copy a link to all that is shown", onclick: () =>
        act.link().then(say, (error) => say(error.message)) }, "Copy link"),
    h("details", { class: "saves" }, h("summary", {}, "Save"), h("div", {},
      act.save.map(([label, title, does]) => h("button", { type: "button", title,
        onclick: () => does().then((text) => text && say(text),
          (error) => say(error.message)) }, label)))))) };
}
