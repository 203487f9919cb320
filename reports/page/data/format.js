// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers as people read them. A number that was not measured is a dash.

export const NOTHING = "–";

const absent = (x) => x === null || x === undefined || Number.isNaN(x);

export function seconds(s) {
  if (absent(s)) return NOTHING;
  if (s === 0) return "0 s";
  if (s >= 1000) return `${s.toFixed(0)} s`;
  const [unit, name] = [[1, "s"], [1e-3, "ms"], [1e-6, "µs"], [1e-9, "ns"]]
    .find(([u]) => s >= 0.9995 * u) ?? [1e-9, "ns"];
  return `${digits(s / unit)} ${name}`;
}

// Three digits, without a power of ten.
export function digits(x) {
  if (absent(x)) return NOTHING;
  if (x === 0) return "0";
  return Math.abs(x) >= 100 ? x.toFixed(0) : Number(x.toPrecision(3)) === 0
    ? "0" : plain(x);
}

function plain(x) {
  const places = 2 - Math.floor(Math.log10(Math.abs(x)) + 1e-9);
  return x.toFixed(Math.min(Math.max(places, 0), 9));
}

// Counts as the 1974 paper prints them: 430K, 50M, 31G.
export function count(x) {
  if (absent(x)) return NOTHING;
  const [unit, name] = [[1e12, "T"], [1e9, "G"], [1e6, "M"], [1e4, "K"]]
    .find(([u]) => Math.abs(x) >= u) ?? [1, ""];
  if (name === "") return Number.isInteger(x) ? String(x) : digits(x);
  return `${digits(x / (name === "K" ? 1e3 : unit))}${name}`;
}

export function whole(x) {
  return absent(x) ? NOTHING : x.toLocaleString("en");
}

// "1 view", "2 views": of a plural that ends in s.
export function number(n, things) {
  return `${whole(n)} ${n === 1 ? things.slice(0, -1) : things}`;
}

export function memory(kb) {
  if (absent(kb)) return NOTHING;
  return kb >= 10240 ? `${whole(Math.round(kb / 1024))} MB` : `${whole(kb)} KB`;
}

// "0.42 [0.38, 0.46]"; the interval may be missing.
export function interval(value, low, high, show = digits) {
  if (absent(value)) return NOTHING;
  const bounds = absent(low) || absent(high) ? ""
    : ` [${show(low)}, ${show(high)}]`;
  return show(value) + bounds;
}

export function exponent(x) {
  return absent(x) ? NOTHING : x.toFixed(2).replace("-", "−");
}

export function size(record) {
  return `${record.width} × ${record.height}`;
}

// One view, or those of a walk: "1–8".
export function views({ view, walk }) {
  return walk > 1 ? `${view}–${view + walk - 1}` : view;
}

export function where(record) {
  return `${record.scene}, view ${views(record)}, ${size(record)}`;
}

// A name that may be long, where there is little room and one line.
export function shortened(name, most) {
  const line = name.replace(/\s+/g, " ");
  return line.length > most ? `${line.slice(0, most - 1)}…` : line;
}
