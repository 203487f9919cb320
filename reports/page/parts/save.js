// SPDX-License-Identifier: GPL-3.0-or-later
// Buttons that save a table as CSV (RFC 4180) and a plot as SVG.
import { shortened } from "../data/format.js";
import { h } from "./dom.js";

export function offer(name, type, text) {
  const url = URL.createObjectURL(new Blob([text], { type }));
  h("a", { href: url, download: name }).click();
  URL.revokeObjectURL(url);
}

function fileName(caption, suffix) {
  const words = caption.toLowerCase().replace(/[^a-z0-9]+/g, "-");
  return `${words.replace(/^-|-$/g, "").slice(0, 60) || "hsr"}.${suffix}`;
}

function button(label, caption, save) {
  return h("button", { type: "button", class: "save",
    "aria-label": `${label}: ${caption}`, onclick: save }, label);
}

// A text that begins like a formula is kept from being one in a spreadsheet.
function field(x) {
  if (x === null || x === undefined) return "";
  const text = typeof x === "string" && /^[=+\-@\t\r]/.test(x) ? `'${x}`
    : String(x);
  return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

// rows(): arrays of numbers and texts, the first of them the heads.
export function saveCsv(caption, rows) {
  return button("Save CSV", caption, () => offer(fileName(caption, "csv"),
    "text/csv", rows().map((row) => `${row.map(field).join(",")}\r\n`).join("")));
}

// svg(): the plot as it is shown; keys: [{ key, label }], its legend.
export function saveSvg(caption, svg, keys) {
  return button("Save SVG", caption, () => offer(fileName(caption, "svg"),
    "image/svg+xml", new XMLSerializer().serializeToString(
      alone(svg(), caption, keys)).replace(NO_XML, "\ufffd")));
}

const NO_XML = /[\0-\x08\x0b\x0c\x0e-\x1f]/g;
const COLUMN = 210, ROW = 20, LETTERS = 28;

// A copy that needs no style sheet, with its legend below.
function alone(svg, caption, keys) {
  const copy = svg.cloneNode(true);
  const style = getComputedStyle(document.documentElement);
  const width = Number(svg.getAttribute("width"));
  const height = Number(svg.getAttribute("height"));
  const across = Math.max(1, Math.floor(width / COLUMN));
  const all = height + ROW * Math.ceil(keys.length / across) + 8;
  const add = (tag, attributes, text) => {
    const element = document.createElementNS(copy.namespaceURI, tag);
    for (const [k, v] of Object.entries(attributes)) element.setAttribute(k, v);
    element.textContent = text;
    return element;
  };
  keys.forEach(({ key, label }, k) => {
    const x = k % across * COLUMN + 8;
    const y = height + ROW * Math.floor(k / across);
    const symbol = key.cloneNode(true);
    symbol.setAttribute("x", x);
    symbol.setAttribute("y", y);
    copy.append(symbol, add("text", { x: x + 34, y: y + 11,
      fill: "currentColor" }, shortened(label, LETTERS)));
  });
  copy.prepend(add("title", {}, caption), add("rect", { width, height: all,
    fill: style.getPropertyValue("--paper") }));
  copy.setAttribute("height", all);
  copy.setAttribute("viewBox", `0 0 ${width} ${all}`);
  copy.setAttribute("color", style.getPropertyValue("--ink"));
  copy.setAttribute("font-family", "sans-serif");
  for (const element of copy.querySelectorAll("*"))
    for (const { name, value } of [...element.attributes])
      if (value.includes("var("))
        element.setAttribute(name, value.replace(/var\((--[\w-]+)[^)]*\)/g,
          (_, variable) => style.getPropertyValue(variable)));
  return copy;
}
