// SPDX-License-Identifier: GPL-3.0-or-later
// The text that names an algorithm with its options, "watkins:x-list=tree", and the
// fields in which it is chosen.
import { h } from "../../page/parts/dom.js";
import { MOST } from "../state/lab.js";

export const plainName = (text) => text.split(":")[0];

function optionsOf(text) {
  return new Map(text.split(":").slice(1).map((part) => {
    const at = part.indexOf("=");
    return [part.slice(0, at), part.slice(at + 1)];
  }));
}

const withOptions = (name, options) => [name, ...[...options].map(
  ([key, value]) => `${key}=${value}`)].join(":");

// A list of all algorithms, by their places in the survey's taxonomy.
export function algorithmSelect(all, chosen, attributes, onchange) {
  const groups = new Map();
  for (const a of all) {
    const group = a.isOracle ? "exact, from the definition"
      : [a.className, a.branch].filter(Boolean).join(", ");
    groups.set(group, [...groups.get(group) ?? [], a]);
  }
  return h("select", { ...attributes, onchange: (e) => onchange(e.target.value) },
    [...groups].map(([label, own]) => h("optgroup", { label },
      own.map((a) => h("option", { value: a.name, selected: a.name === chosen,
        title: a.title }, a.isKnownWrong ? `${a.name} (wrong at times)`
        : a.name)))));
}

// What a bar has in place of stages: a list for each algorithm, one to leave it out,
// and one to put another beside them.
export function algorithmSlots(lab, all, name) {
  const { a } = lab.state;
  const set = (p, text) => lab.set({ a: a.map((x, k) => k === p ? text : x) });
  const offered = (text) => all.some((x) => x.name === plainName(text)) ? all
    : [...all, { name: plainName(text), title: text, className: "not here" }];
  return [...a.map((text, p) => h("span", { class: "slot" },
    algorithmSelect(offered(text), plainName(text), { name: `${name}-${p}`,
      "aria-label": `Algorithm ${p + 1}` }, (next) => set(p, next)),
    a.length > 1 ? h("button", { type: "button", class: "quiet",
      "aria-label": `Leave out ${text}`, title: "Leave it out", onclick: () =>
        lab.set({ a: a.filter((_, k) => k !== p) }) }, "×") : null)),
  a.length < MOST ? h("button", { type: "button", class: "quiet",
    onclick: () => lab.set({ a: [...a, another(a)] }) }, "+ beside") : ""];
}

export const another = (a) => ["zbuffer", "newell", "watkins", "warnock"].find(
  (name) => !a.map(plainName).includes(name));

// A field for each option; changed(text).
export function optionFields(algorithm, text, changed) {
  const chosen = optionsOf(text);
  const set = (name, value) => {
    if (value === null) chosen.delete(name);
    else chosen.set(name, value);
    changed(withOptions(algorithm.name, chosen));
  };
  return algorithm.options.filter(({ name }) => name !== "window").map((option) =>
    h("label", { class: "option" }, h("span", {}, option.name),
      option.words.length ? wordField(option, chosen, set)
        : numberField(option, chosen, set),
      h("small", {}, option.kind ? `${option.meaning} (${option.kind})`
        : option.meaning)));
}

function wordField({ name, words, standard }, chosen, set) {
  const now = chosen.get(name) ?? words[standard]?.name ?? "";
  return h("select", { name: `option-${name}`, onchange: (e) =>
    set(name, e.target.value === (words[standard]?.name ?? "") ? null
      : e.target.value) },
  standard < 0 ? h("option", { value: "", selected: !now }, "none") : null,
  words.map((word) => h("option", { value: word.name, title: word.meaning,
    selected: word.name === now }, word.name)));
}

function numberField({ name, least, most, standard, isReal }, chosen, set) {
  return h("input", { type: "number", name: `option-${name}`, min: least, max: most,
    step: isReal ? "any" : 1, value: chosen.get(name) ?? standard,
    onchange: (e) => e.target.checkValidity() && set(name,
      Number(e.target.value) === standard ? null : e.target.value) });
}
