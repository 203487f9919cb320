// SPDX-License-Identifier: GPL-3.0-or-later
import { h } from "./dom.js";

// A formula as it is printed: the r of F_r below its F.
export function formula(text) {
  return h("span", { class: "formula" }, text.split(/([A-Z]_[a-z])/)
    .map((part, k) => k % 2 === 0 ? part
      : h("i", {}, part[0], h("sub", {}, part[2]))));
}
