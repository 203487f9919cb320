// SPDX-License-Identifier: GPL-3.0-or-later
import { h } from "../../page/parts/dom.js";

// A list to choose from, { value: words }, with its label.
export const choice = (name, all, now, onchange, label) => h("label", {}, label,
  h("select", { name, onchange: (e) => onchange(e.target.value) },
    Object.entries(all).map(([value, text]) => h("option",
      { value, selected: value === now }, text))));
