// SPDX-License-Identifier: GPL-3.0-or-later
import { h } from "./dom.js";

// A formula as it is printed: the r of F_r below its F, and the 2 of ^2 above.
export function formula(text) {
  return h("span", { class: "formula" }, text.split(/([A-Z]_[a-z]|\^\d)/)
    .map((part, k) => k % 2 === 0 ? part : part[0] === "^" ? h("sup", {}, part[1])
      : h("i", {}, part[0], h("sub", {}, part[2]))));
}
