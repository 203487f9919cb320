// SPDX-License-Identifier: GPL-3.0-or-later
// The legends of pictures whose colours are quantities: a ramp, with marks. All
// pictures of a kind have one scale.
import { interpolateInferno } from "d3";
import { h } from "./dom.js";

// marks: [place from 0 to 1, label].
function scale(marks, meaning, caption) {
  const stops = Array.from({ length: 21 }, (_, k) => interpolateInferno(k / 20));
  return h("figure", { class: "scale" },
    h("div", { class: "ramp", role: "img", "aria-label": meaning, style:
      `background: linear-gradient(to right, ${stops.join(", ")})` }),
    h("ul", { "aria-hidden": "true" }, marks.map(([at, label]) =>
      h("li", { style: `left: ${100 * at}%` }, label))),
    h("figcaption", {}, caption));
}

// Dark for samples that were not touched, logarithmically to bright for 255
// touches or more (hsr report writes them so).
export function workScale() {
  return scale([0, 1, 3, 10, 30, 100, 255].map((touches) =>
    [Math.log2(1 + touches) / 8, String(touches)]),
  "From dark, no touch, to bright, 255 touches or more",
  "Work: how often a sample was touched. All work pictures have this scale, " +
    "which is logarithmic.");
}

// Dark up to 2^-16, logarithmically to bright for 1 (hsr errors writes them so).
export function errorScale() {
  return scale([[0, "0"], ...[0.0001, 0.001, 0.01, 0.1, 1].map((error) =>
    [1 + Math.log2(error) / 16, String(error)])],
  "From dark, no error, to bright, an error of 1",
  "The error of a pixel. All these pictures have this scale, which is " +
    "logarithmic.");
}
