// SPDX-License-Identifier: GPL-3.0-or-later
// The scene at the side: which one, its parameters, and what can be done to it.
import { number, whole } from "../../page/data/format.js";
import { h } from "../../page/parts/dom.js";
import { fits, nameOf, parametersOf, standardScene, withValues }
  from "../scene/params.js";
import { KINDS_OF_FILES, ownScene } from "../scene/own.js";
import { editPanel } from "./edit_panel.js";

export function scenePanel(lab, core, source, editing, history) {
  const { state } = lab;
  const told = h("p", { class: "about" });
  const facts = h("p", { class: "scene-facts", role: "status" });
  const sliders = h("div", { class: "sliders" });
  const there = core.builtins.filter(fits);
  const select = h("select", { name: "scene", "aria-label": "Scene",
    onchange: (e) => open(standardScene(usageOf(e.target.value))) });
  const file = h("input", { type: "file", hidden: true, "aria-label": "Own file",
    accept: KINDS_OF_FILES, onchange: () => file.files[0] && openFile(file.files[0]) });
  const edits = editPanel(lab, source, editing, history);

  const usageOf = (name) => there.find((b) => b.name === name)?.usage ?? name;
  const open = (scene) => {
    history.forget();
    lab.set({ scene, own: null, edits: [], camera: null, view: 0, chosen: null,
      window: null });
  };

  async function openFile(from) {
    try {
      const own = await ownScene(from);
      history.forget();
      lab.set({ scene: own.name, own, edits: [], camera: null, view: 0,
        chosen: null, window: null });
    } catch (error) {
      facts.textContent = error.message;
    }
  }

  function slider({ word, least, most, value }, k, all) {
    const out = h("output", {}, whole(value));
    const input = h("input", { type: "range", name: `parameter-${word}`, min: 0,
      max: 200, value: placeOf(value, least, most), "aria-valuetext": String(value),
      oninput: (e) => {
        const next = valueAt(Number(e.target.value), least, most);
        out.textContent = whole(next);
        e.target.setAttribute("aria-valuetext", String(next));
        const values = all.map((p, l) => l === k ? next : p.value);
        all[k].value = next;
        lab.set({ scene: withValues(usageOf(nameOf(state.scene)), values), edits: [],
          chosen: null, window: null });
      } });
    return h("label", {}, h("span", {}, word.toLowerCase()), input, out);
  }

  function show() {
    const name = nameOf(state.scene);
    const builtin = state.own ? null : there.find((b) => b.name === name);
    select.replaceChildren(
      ...(builtin ? [] : [h("option", { value: "", selected: true }, state.scene)]),
      ...there.map((b) => h("option", { value: b.name, title: b.about,
        selected: b === builtin }, b.name)));
    told.textContent = builtin ? sentence(builtin.about) : "Your own file.";
    const focused = sliders.contains(document.activeElement);
    if (!focused && builtin) {
      const all = parametersOf(builtin.usage, state.scene);
      sliders.replaceChildren(...all.map(slider));
    } else if (!builtin) sliders.replaceChildren();
  }

  async function showFacts() {
    const now = await source.current();
    try {
      const { nFaces, nObjects, notes } = await now.info;
      const mesh = state.edits.length ? await now.mesh() : null;
      facts.textContent = [`${number(mesh ? mesh.faces.filter(Boolean).length
        : nFaces, "faces")} in ${number(mesh ? new Set(mesh.faces.filter(Boolean)
        .map((f) => f.solid)).size : nObjects, "solids")}.`, notes].join(" ");
    } catch (error) {
      facts.textContent = error.text ?? error.message;
    }
  }

  lab.when("scene own", show);
  lab.when("scene own edits", showFacts);
  addEventListener("dragover", (e) => e.preventDefault());
  addEventListener("drop", (e) => {
    e.preventDefault();
    if (e.dataTransfer.files[0]) openFile(e.dataTransfer.files[0]);
  });
  show();
  showFacts();
  return h("div", { class: "scene-panel" },
    h("h2", {}, "Scene"),
    h("div", { class: "scene-choice" }, select, file,
      h("button", { type: "button", class: "quiet", onclick: () => file.click(),
        title: `Open a file: ${KINDS_OF_FILES}. Or drop one on the page` },
      "Open a file …")),
    told, sliders, facts, edits);
}

// Sliders over more than two powers of ten go by ratios.
const isWide = (least, most) => most > 100 * Math.max(1, least);
const valueAt = (place, least, most) => isWide(least, most)
  ? Math.round((least + 1) * ((most + 1) / (least + 1)) ** (place / 200)) - 1
  : Math.round(least + (most - least) * place / 200);
const placeOf = (value, least, most) => isWide(least, most)
  ? 200 * Math.log((value + 1) / (least + 1)) / Math.log((most + 1) / (least + 1))
  : 200 * (value - least) / (most - least || 1);

const sentence = (text) => `${text.charAt(0).toUpperCase()}${text.slice(1)}.`;
