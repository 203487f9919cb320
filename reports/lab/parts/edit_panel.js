// SPDX-License-Identifier: GPL-3.0-or-later
// What can be done to the scene.
import { h } from "../../page/parts/dom.js";
import { TOOLS } from "../editing/hand.js";

const MANY = 400; // solids in the list
const button = (text, title, onclick, more = {}) => h("button",
  { type: "button", title, onclick, ...more }, text);

export function editPanel(lab, source, hand, history) {
  const { state } = lab;
  const undo = button("Undo", "Undo (Ctrl+z)", history.undo);
  const redo = button("Redo", "Redo (Ctrl+Shift+z)", history.redo);
  const remove = button("Delete", "Delete what is chosen (Delete)", hand.remove);
  const colour = h("input", { type: "color", name: "colour", value: "#c8553d",
    "aria-label": "Colour of what is chosen", onchange: (e) => hand.isChosen() &&
      history.add(["paint", state.chosen, e.target.value]) });
  const list = h("select", { name: "solid", "aria-label": "What is chosen",
    onchange: (e) => lab.set({ chosen: e.target.value || null }) });
  const tools = h("div", { class: "tools", role: "group",
    "aria-label": "What dragging does" }, Object.entries(TOOLS).map(([name, title]) =>
    button(LABELS[name], title, () => lab.set({ tool: name }),
      { "data-tool": name })));
  const units = h("label", {}, "a click chooses ", h("select", { name: "unit",
    onchange: (e) => lab.set({ whole: e.target.value === "solid", chosen: null }) },
  h("option", { value: "solid" }, "a solid"), h("option", { value: "face" },
    "a face")));
  const hint = h("p", { class: "hint", role: "status" });

  async function showList() {
    const mesh = await (await source.current()).mesh().catch(() => null);
    const names = new Map();
    mesh?.faces.forEach((face) => face && names.set(face.solid,
      mesh.solids[face.solid]));
    list.replaceChildren(h("option", { value: "" }, "nothing chosen"),
      ...[...names].slice(0, MANY).map(([k, name]) => h("option",
        { value: `o${k}` }, name || `solid ${k}`)),
      ...(state.chosen?.[0] === "f" ? [h("option", { value: state.chosen },
        hand.words())] : []));
    list.value = state.chosen ?? "";
  }

  function show() {
    undo.disabled = !history.canUndo();
    redo.disabled = !history.canRedo();
    remove.disabled = colour.disabled = !state.chosen;
    for (const b of tools.children)
      b.setAttribute("aria-pressed", b.dataset.tool === state.tool);
    units.querySelector("select").value = state.whole ? "solid" : "face";
    hint.textContent = HINTS[state.tool];
  }

  lab.when("history edits chosen tool whole scene own", show);
  lab.when("edits chosen scene own", showList);
  show();
  showList();
  return h("details", { class: "edit", open: innerWidth > 700 },
    h("summary", {}, "Edit it"), tools, hint, units,
    h("div", { class: "row" }, list, colour),
    h("div", { class: "row" }, undo, redo, remove),
    h("div", { class: "row" }, h("span", {}, "add"),
      button("box", "Add a box", hand.addBox),
      button("triangle", "Add a triangle", hand.addTriangle),
      button("polygon", "Click its corners in the picture",
        () => lab.set({ tool: "polygon" }))));
}

const LABELS = { turn: "View", move: "Move", rotate: "Turn", polygon: "Draw" };
const HINTS = {
  turn: "Drag to turn the camera; click to choose.",
  move: "Drag a thing along the picture; with Shift, to and fro.",
  rotate: "Drag a thing to turn it, by 5° at a time.",
  polygon: "Click the corners; the first one again, or Enter, ends it.",
};
