// SPDX-License-Identifier: GPL-3.0-or-later
// The line of welcome, and four experiments to begin with.
import { h } from "../../page/parts/dom.js";

export const TRIES = [
  ["Why the painter fails",
    { s: "cyclic-overlap", a: "painter,newell", overlay: "differ" }],
  ["Newell divides",
    { s: "soup:2:7", a: "newell", mode: "step", to: "kind:split" }],
  ["Double Warnock’s work",
    { s: "house", a: "warnock", overlay: "work" }],
  ["Watkins against Bouknight",
    { s: "harbor:800", a: "watkins,bouknight", mode: "measure" }],
];

export function welcome() {
  return h("nav", { class: "welcome", "aria-label": "Welcome" },
    h("p", {}, h("b", {}, "Sixty hidden-surface algorithms at work, live."),
      " Drag the picture, or try:"),
    h("ul", {}, TRIES.map(([words, params]) => h("li", {}, h("a", {
      href: `#/?${new URLSearchParams(params)}` }, words)))));
}
