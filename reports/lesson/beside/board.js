// SPDX-License-Identifier: GPL-3.0-or-later
// A canvas beside the scene, with a title and a line of words.
import { h } from "../../page/parts/dom.js";

// A canvas as wide as its place, of `height` pixels; draw(context, width).
export function board(label, title) {
  const canvas = h("canvas", { role: "img", "aria-label": label });
  const words = h("p", { class: "where" });
  const element = h("div", { class: "board" }, h("h3", {}, title), words, canvas);
  const draw = (height, paint) => {
    const dots = globalThis.devicePixelRatio || 1;
    const width = canvas.clientWidth;
    if (!width) return;
    canvas.width = Math.round(width * dots);
    canvas.height = Math.round(height * dots);
    canvas.style.height = `${height}px`;
    const context = canvas.getContext("2d");
    context.setTransform(dots, 0, 0, dots, 0, 0);
    paint(context, width);
  };
  const say = (text) => {
    if (words.textContent !== text) words.textContent = text;
    canvas.setAttribute("aria-label", `${label}: ${text}`);
  };
  return { element, draw, say, width: () => canvas.clientWidth };
}
