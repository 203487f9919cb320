// SPDX-License-Identifier: GPL-3.0-or-later
// Lists of priority, which stand beside the scene.
import { above, outcomeOf } from "./run.js";

// { title, ofPieces, at(k): { painted, order, marked, sorting } }: the items
// that are done, and those that wait, the next first. marked: those of them that
// bear a marker, which all lose when a piece is done or divided. An item is a piece or a face.
export function listOf(run) {
  if (run.trace.lists.length) return priorityList(run);
  const pieces = run.counterOf("piece");
  if (pieces >= 0 && run.trace.structure.nodes)
    return growingList(run, "The order of the tree", pieces);
  const cull = run.counterOf("back-face-cull");
  if (cull >= 0 && run.trace.structure.separators)
    return growingList(run, "The priority list, the highest first", cull, "front");
  const sort = run.counterOf("face-sort");
  return sort >= 0 ? sortedFaces(run, sort) : null;
}

// Whether rows are kept until all pieces are in them.
export const keepsRows = (run) => Boolean(run.list?.ofPieces) &&
  run.counterOf("list-segment") >= 0;

// Each event of the counter, or each with an outcome of that key, puts its subject at
// the end.
function growingList(run, title, counter, outcome) {
  const { trace } = run;
  const word = outcome === undefined ? -1
    : outcomeOf(run.header.counters[counter], outcome);
  const when = [];
  for (let k = 0; k < trace.kept; k++)
    if (trace.counter[k] === counter && (word < 0 || trace.outcome[k] === word))
      when.push(k);
  const items = when.map((k) => ({ face: trace.a0[k], piece:
    run.header.counters[counter].a === "piece" ? trace.a1[k] : null }));
  const sorted = Uint32Array.from(when);
  return { title, faults: [],
    ofPieces: run.header.counters[counter].a === "piece",
    at: (k) => ({ painted: items.slice(0, above(sorted, k)), order: [],
      marked: new Set(), sorting: false }) };
}

// Painter: all is sorted, and then painted face by face.
function sortedFaces(run, sort) {
  const { trace, accepts } = run;
  const items = [], when = [];
  let begin = 0;
  for (let k = 0; k < trace.kept; k++)
    if (trace.counter[k] === sort) begin = k + 1;
  for (const k of accepts)
    if (!items.length || items.at(-1).face !== trace.a0[k]) {
      items.push({ face: trace.a0[k], piece: null });
      when.push(k);
    }
  const sorted = Uint32Array.from(when);
  return { title: "The list, the farthest first", faults: [], at: (k) => {
    const n = k >= run.n ? items.length : Math.max(0, above(sorted, k) - 1);
    return { painted: items.slice(0, n), order: k >= begin ? items.slice(n) : [],
      marked: new Set(), sorting: k < begin };
  } };
}

// --- Newell's list ---

const KEPT = 64; // operations from one copy of the list to the next

// Bucket by bucket, from the farthest on; within one, as they are numbered.
function sorted(pieces) {
  const whole = pieces.map((piece, p) => [p, piece]).filter(([, [, parent]]) =>
    parent < 0);
  const bucket = ([, [, , own]]) => own;
  return whole.sort((a, b) => bucket(a) - bucket(b)).map(([p]) => p);
}

// One operation on { list, painted, order, marked, sorting }.
function apply(state, { what, list, p, at, order }) {
  if (what === "sort") {
    Object.assign(state, { list, painted: [], order: [], marked: new Set(),
      sorting: true });
  } else if (what === "begin") {
    Object.assign(state, { order: order.slice(), sorting: false });
  } else if (what === "paint") {
    state.painted.push(state.order.shift());
    state.marked.clear();
  } else if (what === "move") {
    state.order = [p, ...state.order.filter((x) => x !== p)];
    state.marked.add(p);
  } else if (what === "out") {
    state.order = state.order.filter((x) => x !== p);
    state.marked.clear();
  } else if (what === "in") {
    state.order.splice(at, 0, p);
  }
}

const copyOf = (state) => ({ ...state, painted: state.painted.slice(),
  order: state.order.slice(), marked: new Set(state.marked) });

// Replays the list from the events. `faults` are events that do not agree with the
// list; there should be none.
function priorityList(run) {
  const { trace, header } = run;
  const { lists, counter, a0, a1, b1, outcome } = trace;
  const keys = header.counters.map(({ key }) => key);
  const ends = header.counters.map((c) => outcomeOf(c, "end-of-q"));
  const ops = [], copies = [], faults = [];
  let state = { list: -1, painted: [], order: [], marked: new Set(),
    sorting: false }, last = null, asked = -1;

  const doNow = (e, op) => {
    if (ops.length % KEPT === 0) copies.push(copyOf(state));
    ops.push({ e, ...op });
    apply(state, op);
  };
  const paintUpTo = (e, isHead) => {
    while (state.order.length && !isHead(state.order[0]))
      doNow(e, { what: "paint" });
    if (!state.order.length) faults.push(e);
  };
  const pieces = () => lists[state.list].pieces;

  for (let e = 0, next = 0; e < trace.kept; e++) {
    const key = keys[counter[e]];
    if (key === "list-sort" && next < lists.length && lists[next].from === e) {
      doNow(e, { what: "sort", list: next++ });
      asked = -1;
    }
    if (state.sorting && keys[counter[e + 1]] !== "list-sort")
      doNow(e, { what: "begin", order: sorted(pieces()) });
    if (key === "list-test" || key === "list-minimax") {
      const p = a1[e];
      if (state.order[0] !== p) paintUpTo(e, (x) => x === p);
      if (key === "list-minimax") continue;
      // Each Q comes after the one before, but the last may end {Q}.
      const place = state.order.indexOf(b1[e]);
      if (place < 1 || (asked === p && place !== last + 1)) faults.push(e);
      asked = outcome[e] === ends[counter[e]] ? -1 : p;
      last = place;
    } else if (key === "list-move") {
      if (state.order[0] !== a1[e] || !state.order.includes(b1[e])) faults.push(e);
      doNow(e, { what: "move", p: b1[e] });
      asked = -1;
    } else if (key === "list-division") {
      if (!state.order.includes(a1[e])) faults.push(e);
      doNow(e, { what: "out", p: a1[e] });
      let f = e + 1;
      pieces().forEach(([, parent], child) => {
        if (parent !== a1[e]) return;
        let at = 0;
        for (; keys[counter[f]] === "list-insertion" && a1[f] === child; f++) at += 1;
        doNow(f - 1, { what: "in", p: child, at });
      });
      asked = -1;
    } else if (key === "list-segment" && pieces()[state.order[0]]?.[0] !== a0[e]) {
      paintUpTo(e, (x) => pieces()[x][0] === a0[e]);
    }
  }
  for (const shown = firstShown(run); shown < trace.kept && state.order.length;)
    doNow(shown, { what: "paint" });
  const when = Uint32Array.from(ops, (op) => op.e);
  const at = (k) => {
    const n = above(when, k), copy = Math.floor(n / KEPT);
    const now = copy < copies.length ? copyOf(copies[copy]) : copyOf(state);
    for (let o = copy * KEPT; o < n; o++) apply(now, ops[o]);
    if (k >= run.n) now.painted.push(...now.order.splice(0));
    const itemOf = (p) => ({ face: lists[now.list].pieces[p][0], piece: p });
    return { painted: now.painted.map(itemOf), order: now.order.map(itemOf),
      marked: now.marked, sorting: now.sorting };
  };
  // Where all pieces are put in order first, later steps name them by their places.
  const search = run.counterOf("place-search");
  const places = search < 0 ? [] : at(run.n).painted.map(({ piece }) => piece);
  return { title: "The priority list, the far end first", at, faults, ofPieces: true,
    numberOf: (c, p) => c === search ? places[p] : p };
}

// When every piece is painted: at the first event that shows something, after the last
// segment was put into its row. An algorithm without such segments: at the end.
function firstShown({ counterOf, header, trace }) {
  const { counter, kept } = trace;
  const last = counter.lastIndexOf(counterOf("list-segment"));
  let e = last < 0 ? kept : last + 1;
  while (e < kept && header.counters[counter[e]].kind !== "accept") e++;
  return e;
}

// The face whose segment is merged among the beads of its row at event k: that of the
// last segment. -1: the step merges none.
export function mergedFace(run, { k, counter, a, b }) {
  const segments = run.counterOf("list-segment");
  if (segments < 0 || counter.key !== "bead-merge" || a.kind !== "face" ||
      b.kind !== "window") return -1;
  const { trace } = run;
  while (k >= 0 && trace.counter[k] !== segments) k--;
  return k < 0 ? -1 : trace.a0[k];
}
