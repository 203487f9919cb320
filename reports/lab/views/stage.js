// SPDX-License-Identifier: GPL-3.0-or-later
// One algorithm: its name and options, its picture, what it did in a line, and its
// counters.
import { seconds } from "../../page/data/format.js";
import { h } from "../../page/parts/dom.js";
import { FIRST_WORDS } from "../state/asked.js";
import { algorithmSelect, optionFields, plainName } from "./algorithms.js";
import { countTable } from "./counts.js";
import { painter } from "./paint.js";

// act: { choose(text), remove: a function or null }
export function stage(lab, algorithms, text, act) {
  const algorithm = algorithms.find((a) => a.name === plainName(text)) ??
    algorithms[0];
  const canvas = h("canvas", { class: "view", tabindex: 0, role: "application",
    "aria-describedby": "view-keys" });
  const brush = painter(canvas);
  const facts = h("p", { class: "facts-of" });
  const refusal = h("p", { class: "refusal", role: "status", hidden: true });
  const table = countTable(algorithm, lab);
  const label = h("p", { class: "blink-name", hidden: true });
  const fields = optionFields(algorithm, text, act.choose);
  const options = fields.length ? h("details", { class: "options" },
    h("summary", { title: "Options" }, text.includes(":") ? "options ●" : "options"),
    h("div", { class: "option-box" }, fields)) : null;
  const element = h("section", { class: "easel", "aria-label": algorithm.title },
    h("div", { class: "easel-head" },
      algorithmSelect(algorithms, algorithm.name, { "aria-label": "Algorithm" },
        act.choose),
      options,
      act.remove ? h("button", { type: "button", class: "quiet",
        "aria-label": `Leave out ${algorithm.name}`, title: "Leave it out",
        onclick: act.remove }, "×") : null),
    h("div", { class: "frame" }, canvas, label, refusal), facts,
    h("details", { class: "below", open: innerWidth > 700 },
      h("summary", {}, "What it has counted"),
      h("p", { class: "who" }, `${algorithm.title}. `, h("small", {},
        [algorithm.authors, algorithm.year || null].filter(Boolean).join(", "),
        algorithm.sortOrder ? `; sorts ${algorithm.sortOrder}` : "")),
      table.element));

  // A picture that is seen until there is an answer.
  let first = null;
  const begin = (picture) => {
    first = picture;
    canvas.after(first);
    facts.textContent = FIRST_WORDS;
  };

  // The answer; isWhole: not one of those while it moves.
  const show = (answer, camera, isWhole) => {
    first?.remove();
    refusal.hidden = Boolean(answer.rgba || answer.segments);
    refusal.textContent = `Answers of the kind “${answer.kind}” are seen in Step.`;
    element.classList.remove("late");
    brush.show(answer, camera);
    const { m, n } = answer;
    canvas.setAttribute("aria-label", `The picture that ${algorithm.name} draws, ${
      m} by ${n}. Arrow keys turn the camera. ${answer.summary ?? ""}`);
    facts.replaceChildren(`${m} × ${n}`, answer.seconds
      ? ` in ${seconds(answer.seconds.draw)} with counting` : "",
    answer.seconds?.prepare > 1e-4 && isWhole
      ? `, made ready in ${seconds(answer.seconds.prepare)}` : "",
    answer.adapted ? `; adapted: ${answer.adapted}` : "",
    answer.ids || !answer.summary ? "" : `; ${answer.summary}`);
    if (answer.counts) table.show(answer.counts, isWhole);
  };
  const wait = () => {
    if (first?.isConnected) return;
    element.classList.add("late");
    facts.textContent = "It is drawing …";
  };
  const refuse = (error) => {
    first?.remove();
    element.classList.remove("late");
    brush.show(null, null);
    refusal.hidden = false;
    refusal.textContent = error.text ?? error.message;
    facts.textContent = "";
    table.clear();
  };
  return { element, canvas, algorithm, text, begin, show, refuse, wait,
    over: brush.over,
    paint: brush.paint, predict: table.predict,
    tell: (words) => words && facts.append(`; ${words}`),
    areOptionsOpen: () => options?.open,
    openOptions: () => { if (options) options.open = true; },
    showOther: (answer, camera) => brush.show(answer, camera),
    name: (words) => {
      label.hidden = !words;
      label.textContent = words ?? "";
    } };
}
