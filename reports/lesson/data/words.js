// SPDX-License-Identifier: GPL-3.0-or-later
// An event in words.
import { kindLook } from "./kinds.js";
import { isOfBody, isRegion, planeOfCell } from "../looks/solids.js";
import { numberWords } from "./numbers.js";
import { outcomeWords, ownCellWords, ownWords } from "./own_words.js";
import { hasOutcome } from "./run.js";
import { searchAt } from "./stretches.js";

// e: the event, where its words depend on it.
export function subjectWords(run, { kind, ids }, window, e) {
  const [p, q, r] = ids;
  if (kind === "cell" && isRegion(run, ids)) return `region ${p} of the map`;
  if (kind === "cell" && e && planeOfCell(run, e.number, p))
    return `plane ${p} of the tree`;
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
    case "volume": return `${e && isOfBody(e) ? "body" : "volume"} ${p}`;
    case "cube": return run.trace.structure.isGrid ? `cell ${p}`
      : run.trace.structure.isBoxes ? q < 0 || run.openings.has(`${p},${q}`)
        ? `cell ${p}` : `cube ${p} of layer ${q}`
      : q < 0 || isOneInstance(run) ? `cube ${p}` : `cube ${p} of instance ${q}`;
    case "cell": return ownCellWords(run, ids) ?? (e && run.pyramid?.of(e.number)
      ? `cell ${q}, ${r} of level ${p}` : cellWords(p, Math.max(q, 0), Math.max(r, 0)));
    case "window": return window ? placeWords(run, window) : "the picture";
    default: return "";
  }
}

// Whether all cubes are of one instance, so that its number tells nothing.
const isOneInstance = (run) => run.oneInstance ??= ![...run.cubes.keys()].some((key) =>
  Number(key.split(",")[1]) > 0);

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

// Where an event is, unless that is the whole picture.
export const whereWords = (run, window) =>
  !window || isWhole(run, window) ? "" : placeWords(run, window);

const placeWords = (run, window) => isWhole(run, window) ? "the whole picture"
  : window.height === 1 && window.width >= run.width ? `row ${window.y}`
    : run.kind.windows === "pixels" ? windowWords(window).replace(/^sample/, "pixel")
      : windowWords(window);

const placeWord = (w) => w?.height !== 1 ? "in" : w.width === 1 ? "at" : "on";

// What becomes of two things that are sorted.
function sortWords({ counter: { key } }, a, b) {
  if (key === "list-move")
    return `${b} is moved to the far end of the list, before ${a}, with a marker`;
  if (key === "interchange") return `${a} and ${b} change places`;
  return key === "list-insertion" ? `${a} goes past ${b}`
    : `${a} is put into its place, with ${b}`;
}

const FARTHEST = 64; // how many events before are looked at

// How often this was done, up to event e, while the run was about nothing else:
// the trace does not tell what changed in between.
function timesSo(run, e) {
  const { trace } = run;
  const same = (k, fields) => fields.every((f) => trace[f][k] === trace[f][e.k]);
  const faces = new Set(run.facesOf(e.k));
  let times = 1;
  for (let k = e.k - 1; k >= 0 && k > e.k - FARTHEST; k--) {
    if (same(k, ALL)) times += 1;
    else if (!same(k, WINDOW) || !faces.size ||
        !run.facesOf(k).every((f) => faces.has(f))) break;
  }
  return times;
}
const WINDOW = ["x", "y", "width", "height"];
const ALL = ["counter", "aKind", "a0", "a1", "a2", "bKind", "b0", "b1", "b2",
  "outcome", ...WINDOW];

const ENDINGS = { 1: "st", 2: "nd", 3: "rd" };
const nth = (n) => `${n}${n % 100 > 10 && n % 100 < 14 ? "th"
  : ENDINGS[n % 10] ?? "th"}`;

function timesWords(run, e) {
  const times = e.kind === "accept" ? 1 : timesSo(run, e);
  const isSome = [e.a, e.b].some(({ kind, ids }) => kind === "edge" && ids[0] < 0);
  return times < 2 || searchAt(run, e.k) ? "" : isSome ? `, the ${nth(times)} such edge`
    : `, the ${nth(times)} time`;
}

// The subjects alone, while a question about the step is open.
export function askedWords(run, e) {
  const [a, b] = [e.a, e.b].map((s) => subjectWords(run, s, e.window, e));
  const where = whereWords(run, e.window);
  return capital(`${[a, b].filter(Boolean).join(" and ")}${
    where && where !== a && where !== b ? ` (${where})` : ""}.`);
}

// The subjects and what becomes of them: "face 12 (chimney) against face 3
// (ground): farther".
export function eventWords(run, e) {
  const a = subjectWords(run, e.a, e.window, e);
  const b = subjectWords(run, e.b, e.window, e);
  const where = whereWords(run, e.window);
  const { verb } = kindLook(e.kind);
  const first = a || b || where || (e.window ? "the picture" : "");
  const second = a && b ? b : "";
  let text = first;
  if (isIntoRows(e))
    return `${capital(a)} ${bucketWords(e.window)}${timesWords(run, e)}`;
  const own = ownWords(run, e, a, b, where || "the picture");
  if (own) text = own;
  else if (e.kind === "sort" && second) text = sortWords(e, a, b);
  else if (/pass(es)? through$/.test(e.outcome))
    return `The plane of ${b} ${e.outcome} ${a}`;
  else if (e.outcome && e.kind !== "compare")
    text += !second ? "" : e.b.kind === "window" ? ` ${placeWord(e.window)} ${second}`
      : `, with ${second}`;
  else if (e.kind === "compare") text += second ? ` against ${second}` : "";
  else if (e.kind === "split" && e.b.kind === "face")
    text += ` is divided by the plane of ${second}`;
  else if (e.kind === "split" || e.kind === "subdivide")
    text += ` is ${verb}${second ? `, with ${second}` : ""}`;
  else if (e.kind === "accept")
    text += ` ${run.kind.doneWith?.(e.part) ?? `is ${run.kind.verb ?? verb}`}${
      second && e.b.kind !== "window"
        ? `, ${e.b.kind === "cell" ? "in" : isBehind(e) ? "behind" : "not"} ${second}` : ""}`;
  else if (e.b.kind === "window" && second)
    text += ` is ${verb} ${placeWord(e.window)} ${second}`;
  else text += ` is ${verb}${second ? `, with ${second}` : ""}`;
  const numbers = numberWords(run, e);
  if (e.outcome) text += `: ${outcomeWords(run, e)}`;
  if (numbers) text += `${e.outcome ? ", " : ": "}${numbers}`;
  text += timesWords(run, e);
  if (e.part) text += run.kind.partWords?.(e.part) ?? "";
  const shown = [e.a, e.b].some(({ kind }) => kind === "window" ||
    (kind === "cell" && run.trace.structure.numbered === "squares"));
  const isBox = e.kind === "sort" && e.a.kind === "face" && e.window?.height > 1;
  if (where && where !== first && !isBox && !(shown && e.kind !== "accept"))
    text += ` (${where})`;
  return capital(text);
}

// Whether the face is shown around another one, which is before it and comes next.
const isBehind = (e) => hasOutcome(e, "behind");

const capital = (text) => text.charAt(0).toUpperCase() + text.slice(1);

const bucketWords = ({ y, height }) => `is put into the bucket of row ${y}${
  height > 1 ? `; it reaches to row ${y + height - 1}` : ""}`;

// Whether a thing is put into the bucket of the row where its window begins.
const isIntoRows = (e) => e.kind === "sort" && e.window &&
  hasOutcome(e, "first-row");
