// SPDX-License-Identifier: GPL-3.0-or-later
// One algorithm's run, to be looked at after any number of steps k, from 0. Step
// k is event k - 1. If the page does not have all events, one more step stands
// for all that were left out: it leads to the end.
import { kindNamed } from "../kinds/all.js";
import { sampleStory } from "./story.js";
import { structureOf } from "./structure.js";

export const NONE = -1; // no id; as a face: the background
const COUNTED = 2048; // events from one keyframe of counts to the next

// The keys of each outcome of a counter, and of one of them by its word.
const keysOf = ({ outcome_keys: all }) =>
  (all ?? []).map((words) => words ? words.split(" ") : []);
export const keysOfOutcome = (counter, word) =>
  keysOf(counter)[counter.outcomes?.indexOf(word) ?? 0] ?? [];

// Whether what a step decides, or the step, has this key; and the outcome of a counter
// that has it, -1: none.
export const hasOutcome = (e, key) => e.keys.includes(key);
export const outcomeOf = (counter, key) =>
  keysOf(counter).findIndex((words) => words.includes(key));

export function runOf(trace) {
  const { header, kept, events } = trace;
  const { counters, faces, objects } = header;
  const n = kept + (kept < events ? 1 : 0);
  const kinds = counters.map((c) => c.kind);
  const keys = counters.map(keysOf);
  const isAccept = Uint8Array.from(kinds, (kind) => kind === "accept" ? 1 : 0);
  const accepts = acceptsOf(trace.counter, isAccept);
  const frames = countFrames(trace.counter, counters.length);
  const units = unitsOf(trace);
  const subjects = header.subjects.map((s) => s.name);

  const run = {
    trace, n, header, accepts, units,
    name: header.algorithm.variant, title: header.algorithm.title,
    width: header.view.width, height: header.view.height,
    kind: kindNamed(header.algorithm.answer),
    leftOut: events - kept,

    // The place of the counter of that key; -1: this run has none.
    counterOf: (key) => counters.findIndex((c) => c.key === key),

    // What event k is about.
    event: (k) => {
      const c = trace.counter[k];
      return { k, counter: counters[c], number: c, kind: counters[c].kind,
        a: subject("a", k), b: subject("b", k), window: windowOf(trace, k),
        outcome: counters[c].outcomes?.[trace.outcome[k]] ?? null,
        keys: keys[c][Math.max(0, trace.outcome[k])] ?? [],
        ...partsAt(k) };
    },

    // How often each counter was raised in the first k steps; null: not known
    // before the end.
    counts: (k) => {
      if (k >= n) return trace.counts;
      const frame = Math.floor(k / COUNTED);
      const counts = Array.from(frames[frame]);
      for (let e = frame * COUNTED; e < k; e++) counts[trace.counter[e]] += 1;
      return counts.map((x, c) => counters[c].computed ? null : x);
    },

    // How many of the accepted events are among the first k.
    accepted: (k) => k > kept ? accepts.length : above(accepts, k),

    // The k after which the next, or the last, event is one that matches.
    after: (k, matches) => {
      for (let e = k; e < kept; e++) if (matches(e)) return e + 1;
      return null;
    },
    before: (k, matches) => {
      for (let e = k - 2; e >= 0; e--) if (matches(e)) return e + 1;
      return null;
    },

    // Where the next row or window ends, and where this one, or the one before
    // it, began.
    nextUnit: (k) => {
      const place = above(units, k + 1);
      return place < units.length ? units[place] : n;
    },
    lastUnit: (k) => {
      const place = above(units, k) - 1;
      return place >= 0 ? units[place] : 0;
    },

    // How many faces, or faces of pieces, the steps name.
    facesNamed: () => {
      const isOf = subjects.map((kind) => /^(face|piece)$/.test(kind));
      const named = new Set();
      for (let k = 0; k < kept; k++) {
        if (isOf[aKind[k]]) named.add(a0[k]);
        if (isOf[bKind[k]]) named.add(b0[k]);
      }
      named.delete(NONE);
      return named.size;
    },

    faceName: (f) => f === NONE ? "the background"
      : `face ${f}${objects[faces[f]?.[1]] ? ` (${objects[faces[f][1]]})` : ""}`,
  };

  const { aKind, a0, a1, a2, bKind, b0, b1, b2 } = trace;
  // What it adds to the answer; else the piece that it is about.
  function partsAt(k) {
    const list = isAccept[trace.counter[k]] ? trace.parts : trace.shapes;
    const one = trace.part[k] ? list[trace.part[k] - 1] : null;
    return isAccept[trace.counter[k]] ? { part: one, shape: null }
      : { part: null, shape: one };
  }
  function subject(which, k) {
    const s = which === "a"
      ? { kind: subjects[aKind[k]], ids: [a0[k], a1[k], a2[k]] }
      : { kind: subjects[bKind[k]], ids: [b0[k], b1[k], b2[k]] };
    if (s.kind === "cell" && run.isCube(trace.counter[k], which)) s.kind = "cube";
    if (s.kind === "piece" && run.list?.numberOf)
      s.ids[1] = run.list.numberOf(trace.counter[k], s.ids[1]);
    return s;
  }

  Object.assign(run, structureOf(run));
  run.painting = run.kind.painting(run);
  run.story = (place) => (run.kind.story ?? sampleStory)(run, place);
  run.facesOf = (k) => [...facesOf(subject("a", k)), ...facesOf(subject("b", k))];
  return run;
}

// The faces that a subject names.
export function facesOf({ kind, ids }) {
  if (kind === "face" || kind === "piece") return ids[0] < 0 ? [] : [ids[0]];
  if (kind === "edge") return ids[2] < 0 ? [] : [ids[2]];
  return kind === "implied edge" ? ids.slice(0, 2).filter((f) => f >= 0) : [];
}

export function windowOf({ x, y, width, height }, k) {
  return width[k] ? { x: x[k], y: y[k], width: width[k], height: height[k] }
    : null;
}

function acceptsOf(counter, isAccept) {
  const accepts = [];
  for (let k = 0; k < counter.length; k++)
    if (isAccept[counter[k]]) accepts.push(k);
  return Uint32Array.from(accepts);
}

// The counts before every COUNTED-th event.
function countFrames(counter, n) {
  const now = new Uint32Array(n), frames = [];
  for (let k = 0; k < counter.length; k++) {
    if (k % COUNTED === 0) frames.push(now.slice());
    now[counter[k]] += 1;
  }
  frames.push(now.slice());
  if (counter.length % COUNTED === 0) frames.push(now.slice());
  return frames;
}

// Where a row or window begins: the step before the first event of another row,
// window or, where events have no window, first subject.
function unitsOf(trace) {
  const { x, y, width, height, aKind, a0, a1, counter } = trace;
  const units = [];
  let last = "";
  for (let k = 0; k < counter.length; k++) {
    const unit = !width[k] ? aKind[k] * 1e9 + a0[k] + a1[k] / 1e6
      : height[k] === 1 ? -1 - y[k]
        : `${x[k]},${y[k]},${width[k]},${height[k]}`;
    if (k && unit !== last) units.push(k);
    last = unit;
  }
  return Uint32Array.from(units);
}

// How many of the sorted values are less than x.
export function above(sorted, x) {
  let low = 0, high = sorted.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (sorted[middle] < x) low = middle + 1;
    else high = middle;
  }
  return low;
}
