// SPDX-License-Identifier: GPL-3.0-or-later
// One look for each kind of step, the same for all algorithms: a colour (of
// style.css, with its light form for paper), a sign, and a verb.

export const KINDS = {
  sort: { hue: 4, light: "#a88600", sign: "⇅", verb: "put into its place" },
  compare: { hue: 0, light: "#0663f9", sign: "⇔", verb: "compared" },
  split: { hue: 3, light: "#e45cb0", sign: "✂\ufe0e", verb: "divided" },
  subdivide: { hue: 6, light: "#5a0aa0", sign: "⊞", verb: "divided" },
  activate: { hue: 5, light: "#0a3040", sign: "⊕", verb: "taken up" },
  retire: { hue: 7, light: "#7a7a7a", sign: "⊖", verb: "put aside" },
  span: { hue: 5, light: "#0a3040", sign: "▬", verb: "looked at" },
  sample: { hue: 4, light: "#a88600", sign: "⊙", verb: "looked at" },
  reject: { hue: 1, light: "#b01a00", sign: "✕", verb: "rejected" },
  accept: { hue: 2, light: "#049f52", sign: "✓", verb: "shown" },
};

export const kindLook = (kind) => KINDS[kind] ?? KINDS.sample;

// A colour of the page, or on paper its light form.
const LIGHT = { "--paper": "#ffffff", "--ink": "#1d1f22", "--faint": "#5d6269",
  "--line": "#d4d5d2" };
let onPaper = false;
export const setPaper = (is) => { onPaper = is; };

export function colourOf(name) {
  return onPaper && LIGHT[name] ? LIGHT[name]
    : getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

export function kindColour(kind) {
  const { hue, light } = kindLook(kind);
  return onPaper ? light : colourOf(`--hue-${hue}`);
}

// "#rrggbb" as a pixel has it.
export function packed(colour) {
  const [r, g, b] = [1, 3, 5].map((k) => parseInt(colour.slice(k, k + 2), 16));
  return (255 << 24 | b << 16 | g << 8 | r) >>> 0;
}
