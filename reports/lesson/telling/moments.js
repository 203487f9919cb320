// SPDX-License-Identifier: GPL-3.0-or-later
// The key moments of a run: some twenty steps that tell its idea. The rules of its
// lesson choose them. A rule is
//
// of         a counter, by its key; name: one without a key, by its name
// outcome    one of its outcomes; like: a pattern of them
// where      (run, e): whether the event will do
// real       its faces are faces, not the background
// covers     the step writes over what another face has written
// nth        the nth such event, -1 the last (standard: the first)
// among      only the first so many such events: a long run is told early
// at         the one at that share of all such events
// pick       "largest": the one with the most to see; "apart": whose subjects are
//            large, and well apart; "over": whose subject overlaps the window most;
//            "widest": the one with the largest window
// id         a name, for rules that follow
// with       [id, "a" | "place" | "row"]: of the first subject, in the window or on
//            the row of that moment
// before     id: before that moment, the last one (or by pick); after: likewise
// or         another rule, if there is no such event
import { lessonOf } from "../lessons/all.js";
import { looksOf } from "../looks/all.js";
import { counterNamed } from "./figures.js";

const LEAST = 6, MOST = 20; // moments of a run
const QUARTERS = [[0.25, "A quarter"], [0.5, "Half"], [0.75, "Three quarters"]];
const LOOKED_AT = 1500; // events at most, to find the largest

// [{ k, say, ask, words }], by k: the moment is step k, event k - 1.
export function momentsOf(run) {
  run.moments ??= chosen(run);
  return run.moments;
}

function chosen(run) {
  const lesson = lessonOf(run);
  const taken = new Map(), named = {};
  for (const [say, rule, ask, words] of lesson?.moments ?? []) {
    const e = eventBy(run, rule, taken, named);
    if (e === null) continue;
    if (rule.id) named[rule.id] = e;
    if (say) taken.set(e + 1, { k: e + 1, say, ask, words });
  }
  if (taken.size < LEAST) addGeneral(run, taken);
  taken.set(run.n, { ...taken.get(run.n), k: run.n, say: "The picture is complete" });
  return [...taken.values()].sort((a, b) => a.k - b.k);
}

// What lessons leave out, and all of a run without a lesson: the first step of each
// line of the outline, quarters of the picture, and in a small run quarters of its steps.
function addGeneral(run, taken) {
  const { header, trace } = run;
  const known = new Set([...taken.keys()].map((k) => trace.counter[k - 1]));
  header.counters.forEach((c, number) => {
    if (known.has(number) || c.computed || !trace.counts[number] || !c.line ||
        taken.size >= MOST) return;
    const e = eventBy(run, { name: c.key ?? c.name, pick: "largest" }, taken);
    if (e !== null) taken.set(e + 1, { k: e + 1, say: sentence(c.meaning) });
  });
  const add = (k, say, most) => {
    if (!taken.has(k) && k > 0 && k < run.n && taken.size < most)
      taken.set(k, { k, say });
  };
  for (const [share, words] of QUARTERS)
    add(stepWith(run, share), `${words} of the answer`, MOST);
  for (const [share, words] of QUARTERS)
    add(Math.round(share * trace.kept), `${words} of the steps`, LEAST);
}

const sentence = (text) => text.charAt(0).toUpperCase() + text.slice(1);

// The step by which that share of the answer is there.
function stepWith(run, share) {
  let low = 0, high = run.trace.kept;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (run.painting.decided(middle) < share) low = middle + 1;
    else high = middle;
  }
  return low;
}

// --- Rules ---

// The event of a rule that no other rule has taken; null: there is none. named: the
// events of the moments with an id.
export function eventBy(run, rule, taken = new Map(), named = {}) {
  return eventByOne(run, rule, taken, named) ??
    (rule.or ? eventByOne(run, rule.or, taken, named) : null);
}

function eventByOne(run, rule, taken, named) {
  const anchor = named[rule.with?.[0] ?? rule.before ?? rule.after];
  if ((rule.with || rule.before || rule.after) && anchor === undefined) return null;
  const found = eventsBy(run, rule, named).filter((k) => !taken.has(k + 1))
    .slice(0, rule.among);
  if (!found.length) return null;
  if (rule.pick) return best(run, found, rule.pick);
  if (rule.at !== undefined) return found[Math.floor(rule.at * (found.length - 1))];
  const nth = rule.nth ?? (rule.before ? -1 : 1);
  return found.at(nth > 0 ? nth - 1 : nth) ?? null;
}

function eventsBy(run, rule, named) {
  const c = counterNamed(run, rule.of ?? rule.name);
  const words = run.header.counters[c]?.outcomes ?? [];
  const isOutcome = rule.outcome === undefined && !rule.like ? null
    : words.map((w) => w === rule.outcome || Boolean(rule.like?.test(w)));
  const { counter, outcome, kept } = run.trace;
  const from = rule.after ? named[rule.after] + 1 : 0;
  const to = rule.before ? named[rule.before] : kept;
  const isNear = nearness(run, rule, named);
  const found = [];
  for (let k = from; k < to; k++)
    if (counter[k] === c && (!isOutcome || isOutcome[outcome[k]]) && isNear(k) &&
        isWanted(run, k, rule)) found.push(k);
  return found;
}

// Whether event k is of the same subject, place or row as the one that a rule names.
function nearness({ trace }, { with: by }, named) {
  if (!by) return () => true;
  const fields = { a: ["aKind", "a0", "a1"], row: ["y"],
    place: ["x", "y", "width", "height"] }[by[1]];
  const e = named[by[0]];
  return (k) => fields.every((f) => trace[f][k] === trace[f][e]);
}

function isWanted(run, k, rule) {
  if (!rule.real && !rule.where && !rule.covers) return true;
  const e = run.event(k);
  if (rule.real && !isReal(e)) return false;
  if (rule.covers && !coversAnother(run, e)) return false;
  return !rule.where || rule.where(run, e);
}

const isFace = ({ kind, ids }) => /face|piece/.test(kind) && ids[0] >= 0;
const isReal = ({ a, b, counter }) =>
  (!/face|piece/.test(counter.a) || isFace(a)) &&
  (!/face|piece/.test(counter.b) || isFace(b));

function coversAnother(run, { k, window: w, a }) {
  const there = run.painting.at(k)[w.y * run.width + w.x];
  return there >= 0 && there !== a.ids[0];
}

function best(run, found, pick) {
  const stride = Math.ceil(found.length / LOOKED_AT);
  let most = -Infinity, which = found[0];
  for (let p = 0; p < found.length; p += stride) {
    const value = stake(run, run.event(found[p]), pick);
    if (value > most) [most, which] = [value, found[p]];
  }
  return which;
}

// How much is to be seen of a step: the size of the smaller subject, and how far the
// two overlap, or are apart.
function stake(run, e, pick) {
  if (pick === "widest") return e.window ? e.window.width * e.window.height : 0;
  const { a, b, where } = looksOf(run, e);
  if (isUnseen(e.a, a) || isUnseen(e.b, b)) return -1;
  const boxes = (pick === "over" ? [a, where] : [a, b])
    .map((shapes) => boxOf(run, shapes)).filter(Boolean);
  if (!boxes.length) return sizeOf(boxOf(run, where));
  const least = Math.min(...boxes.map((box) => interest(run, sizeOf(box))));
  if (boxes.length < 2) return least + 0.2 * sizeOf(boxOf(run, where));
  const both = overlap(...boxes);
  return pick === "apart" ? least * (both < 0 ? 1 : 0.1)
    : least + 2 * Math.max(0, both);
}

// Whether a subject that could be drawn is not: it lies outside of the picture.
const isUnseen = ({ kind, ids }, shapes) => /face|piece|edge|volume|cube/.test(kind) &&
  ids[0] >= 0 && !shapes.length;

const FILLS = 0.6; // of the picture's width and height: more is a ground, no figure

// The larger the better, but what fills the picture tells little.
function interest({ width, height }, size) {
  const most = FILLS * (width + height);
  return size <= most ? size : most - 3 * (size - most);
}

// Of the part that is in the picture: half of its width and height together.
const sizeOf = (box) => box ? Math.max(0, box.x1 - box.x0) +
  Math.max(0, box.y1 - box.y0) : 0;

const overlap = (p, q) => Math.min(Math.min(p.x1, q.x1) - Math.max(p.x0, q.x0),
  Math.min(p.y1, q.y1) - Math.max(p.y0, q.y0));

export function boxOf(run, shapes) {
  let box = null;
  for (const { points } of shapes)
    for (const [x, y] of points) {
      box ??= { x0: x, y0: y, x1: x, y1: y };
      box.x0 = Math.min(box.x0, x);
      box.y0 = Math.min(box.y0, y);
      box.x1 = Math.max(box.x1, x);
      box.y1 = Math.max(box.y1, y);
    }
  const clip = (x, most) => Math.min(most, Math.max(0, x));
  if (box && (box.x1 < 0 || box.y1 < 0 || box.x0 > run.width || box.y0 > run.height))
    [box.x1, box.y1] = [box.x0, box.y0]; // nothing of it is in the picture
  return box && { x0: clip(box.x0, run.width), y0: clip(box.y0, run.height),
    x1: clip(box.x1, run.width), y1: clip(box.y1, run.height) };
}

// --- What the scene lacks ---

// Why the scene cannot show some of the idea, and which one does: [{ why, instead }].
export const lacks = (run) => (lessonOf(run)?.needs ?? []).filter(({ of, name }) => {
  const c = counterNamed(run, of ?? name);
  return c >= 0 && !run.trace.counts[c];
});
