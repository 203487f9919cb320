// SPDX-License-Identifier: GPL-3.0-or-later
// An event in words.
import { kindLook } from "./kinds.js";

export function subjectWords(run, { kind, ids }, window) {
  const [p, q, r] = ids;
  switch (kind) {
    case "face": return run.faceName(p);
    case "piece": return `piece ${q} of ${run.faceName(p)}`;
    case "edge": {
      const name = p < 0 ? "an edge" : `edge ${p}–${q}`;
      return r < 0 ? name : `${name} of ${run.faceName(r)}`;
    }
    case "implied edge":
      return `the edge where faces ${p} and ${q} penetrate`;
    case "vertex": return `vertex ${p}`;
    case "volume": return `volume ${p}`;
    case "cube": return q < 0 ? `cube ${p}` : `cube ${p} of instance ${q}`;
    case "cell": return cellWords(p, Math.max(q, 0), Math.max(r, 0));
    case "window": return window ? windowWords(window) : "the picture";
    default: return "";
  }
}

// A number; or a level, and the number or place there.
function cellWords(p, q, r) {
  return !q && !r ? `cell ${p}` : !r ? `cell ${q} of level ${p}`
    : `cell ${q}, ${r} of level ${p}`;
}

export function windowWords({ x, y, width, height }) {
  if (width === 1 && height === 1) return `sample ${x}, ${y}`;
  if (height === 1) return `row ${y}, columns ${x} to ${x + width - 1}`;
  return `the window of ${width} × ${height} at ${x}, ${y}`;
}

const isWhole = (run, w) => w && w.x <= 0 && w.y <= 0 &&
  w.x + w.width >= run.width && w.y + w.height >= run.height;

// Of the list of priority, an interchange puts the second piece before the first;
// others are of neighbours.
function sortWords(e, a, b) {
  const name = e.counter.name.replace(/^.*: /, "");
  if (name === "interchanges") return `${b} is put before ${a}, with a marker`;
  if (/interchange/.test(name)) return `${a} and ${b} change places`;
  return name === "insertions" ? `${a} goes past ${b}`
    : `${a} is put into its place, with ${b}`;
}

// The subjects and what becomes of them: "face 12 (chimney) against face 3
// (ground): farther".
export function eventWords(run, e) {
  const a = subjectWords(run, e.a, e.window);
  const b = subjectWords(run, e.b, e.window);
  const where = e.window && !isWhole(run, e.window) ? windowWords(e.window) : "";
  const { verb } = kindLook(e.kind);
  const first = a || b || where || (e.window ? "the picture" : "");
  const second = a && b ? b : "";
  let text = first;
  if (e.kind === "sort" && second) text = sortWords(e, a, b);
  else if (e.outcome && e.kind !== "compare") text += second ? `, with ${second}` : "";
  else if (e.kind === "compare") text += second ? ` against ${second}` : "";
  else if (e.kind === "split" && e.b.kind === "face")
    text += ` is divided by the plane of ${second}`;
  else if (e.kind === "split" || e.kind === "subdivide")
    text += ` is ${verb}${second ? `, with ${second}` : ""}`;
  else if (e.kind === "accept")
    text += ` is ${run.kind === "segments" ? "drawn" : verb}${
      second && e.b.kind !== "window"
        ? `, ${e.b.kind === "cell" ? "in" : "not"} ${second}` : ""}`;
  else text += ` is ${verb}${second ? `, with ${second}` : ""}`;
  if (e.outcome) text += `: ${e.outcome}`;
  if (e.part && run.kind === "segments")
    text += e.part[1] ? `: hidden by ${e.part[1] === 1 ? "one face"
      : `${e.part[1]} faces`}` : ": visible";
  const shown = e.a.kind === "window" || e.b.kind === "window";
  if (where && where !== first && !(shown && e.kind !== "accept"))
    text += ` (${where})`;
  return text.charAt(0).toUpperCase() + text.slice(1);
}
