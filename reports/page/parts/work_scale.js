// SPDX-License-Identifier: GPL-3.0-or-later
// The legend of the work pictures. All have one scale: dark for samples that were
// not touched, logarithmically to bright for 255 touches or more (hsr report
// writes them so).
import { interpolateInferno } from "d3";
import { h } from "./dom.js";

const MARKS = [0, 1, 3, 10, 30, 100, 255];
const BITS = 8;
const at = (touches) => Math.log2(1 + touches) / BITS;

export function workScale() {
  const stops = Array.from({ length: 21 }, (_, k) => interpolateInferno(k / 20));
  return h("figure", { class: "scale" },
    h("div", { class: "ramp", role: "img", style:
      `background: linear-gradient(to right, ${stops.join(", ")})`,
    "aria-label": "From dark, no touch, to bright, 255 touches or more" }),
    h("ul", { "aria-hidden": "true" }, MARKS.map((touches) =>
      h("li", { style: `left: ${100 * at(touches)}%` }, String(touches)))),
    h("figcaption", {}, "Work: how often a sample was touched. All work " +
      "pictures have this scale, which is logarithmic."));
}
