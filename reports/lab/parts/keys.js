// SPDX-License-Identifier: GPL-3.0-or-later
// Keys for the pictures and for edits. Those of the player are in lesson/.
import { h } from "../../page/parts/dom.js";
import { nearer, otherProjection, shifted, turned } from "../views/camera.js";

const TURN = Math.PI / 24, SHIFT = 0.05;

// A picture has the focus: arrows turn the camera or move what is chosen.
export function pictureKeys(element, lab, camera, hand, moves) {
  const { state } = lab;
  const set = (next) => camera() && lab.set({ camera: next(camera()) });
  const arrow = (x, y) => (e) => state.tool === "move" && hand.isChosen()
    ? e.altKey ? hand.nudge(0, 0, y) : hand.nudge(x, y, 0)
    : state.tool === "rotate" && hand.isChosen() && x
      ? hand.rotate(x > 0 ? 0.13165 : -0.13165) // 15 degrees
      : set((c) => e.shiftKey ? shifted(c, SHIFT * x, SHIFT * y)
        : turned(c, TURN * x, TURN * y));
  const does = {
    ArrowLeft: arrow(-1, 0), ArrowRight: arrow(1, 0), ArrowUp: arrow(0, 1),
    ArrowDown: arrow(0, -1), "+": () => set((c) => nearer(c, 0.9)),
    "=": () => set((c) => nearer(c, 0.9)), "-": () => set((c) => nearer(c, 1 / 0.9)),
    p: () => set(otherProjection), 0: () => lab.set({ camera: null }),
  };
  element.addEventListener("keydown", (e) => {
    if (!e.target.closest("canvas") || e.ctrlKey || e.metaKey ||
        !Object.hasOwn(does, e.key)) return;
    e.preventDefault();
    moves();
    does[e.key](e);
  });
}

export function editKeys(lab, hand, history) {
  const typing = (e) => e.target.closest("input:not([type=range], [type=checkbox]), " +
    "select, textarea");
  addEventListener("keydown", (e) => {
    if (typing(e)) return;
    const key = e.key.toLowerCase(), held = e.ctrlKey || e.metaKey;
    if (held && key === "z") e.shiftKey ? history.redo() : history.undo();
    else if (held && key === "y") history.redo();
    else if (lab.state.mode !== "look") return;
    else if (e.key === "Delete" || e.key === "Backspace") hand.remove();
    else if (e.key === "Escape") lab.set({ chosen: null, tool: "turn" });
    else if (e.key === "Enter" && lab.state.tool === "polygon" &&
      !e.target.closest("button")) hand.closePolygon();
    else return;
    e.preventDefault();
  });
}

const KEYS = [["drag, or arrows", "turn the camera"], ["Shift and drag, or arrows",
  "shift it"], ["wheel, two fingers, + −", "come nearer"], ["p", "parallel or not"],
["0", "the scene’s own view"], ["click", "choose a solid or a face"],
["arrows, with Alt to and fro", "move what is chosen (tool Move)"],
["Delete", "delete it"], ["Ctrl+z, Ctrl+Shift+z", "undo, redo"],
["Esc", "choose nothing"]];

export const keyHelp = () => h("details", { class: "key-help" },
  h("summary", {}, "Keys"), h("dl", { id: "view-keys" }, KEYS.map(([key, what]) =>
    h("div", {}, h("dt", {}, h("kbd", {}, key)), h("dd", {}, what)))));
