// SPDX-License-Identifier: GPL-3.0-or-later
// What stands beside the scene: lists of priority, trees of planes, pyramids of
// cells, and what pieces and cubes look like. All of it is read from the trace.
import { above } from "./run.js";

export function structureOf(run) {
  const pyramid = pyramidOf(run);
  return { list: listOf(run), tree: treeOf(run), pyramid,
    outline: outlines(run),
    pieceFace: (k, p, face) => pieceAt(run, k, p, face)?.[0] ?? null,
    children: (k, p) => childrenOf(run, k, p),
    cut: (k, p, face) => cutOf(childrenOf(run, k, p).filter(Boolean),
      pieceAt(run, k, p, face)?.at(-1) ?? run.header.faces[face][4]),
    cubes: cubesOf(run), isCube: cubeSides(run) };
}

const numberOf = (run, name, matches = () => true) =>
  run.header.counters.findIndex((c) => c.name === name && matches(c));

// --- Pieces ---

// The list that was at hand at event k.
function listAt(run, k) {
  const { lists } = run.trace;
  run.begins ??= Uint32Array.from(lists, (l) => l.from);
  return lists[above(run.begins, k + 1) - 1] ?? null;
}

// The place of piece p of a face in the list of all pieces of all trees.
function placeOfPiece(run, p, face) {
  const { bases } = run.trace.structure;
  run.treesBegin ??= Int32Array.from(bases, ([first]) => first);
  return (bases[above(run.treesBegin, face + 1) - 1]?.[1] ?? 0) + p;
}

const pieceAt = (run, k, p, face) => run.trace.structure.pieces
  ? run.trace.structure.pieces[placeOfPiece(run, p, face)]
  : listAt(run, k)?.pieces[p];

// What is left of a face: the outline of its piece p at event k; null: all of it,
// or not known.
const outlines = (run) => (k, p, face) => pieceAt(run, k, p, face)?.at(-1) ?? null;

// The pieces that a division of piece p made.
function childrenOf(run, k, p) {
  const pieces = listAt(run, k)?.pieces ?? [];
  return pieces.filter(([, parent]) => parent === p).map((piece) => piece.at(-1));
}

// Two points on the line along which a piece was divided, beyond its ends: the line
// through the corners that the halves have in common, or, of a single half, that
// the piece did not have. null: not known.
function cutOf([half, other], whole) {
  if (!half) return null;
  const isOf = (points, [x, y]) =>
    points.some(([u, v]) => Math.hypot(x - u, y - v) < 0.1);
  const ends = half.filter((p) => other ? isOf(other, p) : !isOf(whole, p));
  const [p, q] = [ends[0], ends.at(-1)];
  if (!p || p === q) return null;
  const beyond = (from, to) => to.map((x, c) => x + 0.7 * (x - from[c]));
  return [beyond(q, p), beyond(p, q)];
}

// "node,instance" -> the images of a cube's corners.
function cubesOf(run) {
  return new Map((run.trace.structure.cubes ?? []).map(([node, instance, at]) =>
    [`${node},${instance}`, at]));
}

// (counter, "a" or "b") -> whether its cells are cubes: all of them are known.
function cubeSides(run) {
  const cubes = cubesOf(run), { trace } = run;
  const are = (c, side) => {
    if (run.header.counters[c][side] !== "cell" || !cubes.size) return false;
    for (let k = 0; k < trace.kept; k++)
      if (trace.counter[k] === c && (trace[`${side}2`][k] !== 0 || !cubes.has(
        `${trace[`${side}0`][k]},${trace[`${side}1`][k]}`))) return false;
    return true;
  };
  const known = run.header.counters.map((_, c) => ({ a: are(c, "a"),
    b: are(c, "b") }));
  return (c, side) => known[c][side];
}

// --- Lists of priority ---

// { title, ofPieces, at(k): { painted, order, marked, sorting } }: the items
// that are done, and those that wait, the next first. marked: those of them that
// bear a marker. An item is a piece or a face.
function listOf(run) {
  if (run.trace.lists.length) return priorityList(run);
  const pieces = numberOf(run, "pieces", (c) => c.a === "piece");
  if (pieces >= 0 && run.trace.structure.nodes)
    return growingList(run, "The order of the tree", pieces);
  const cull = numberOf(run, "back-face cull");
  if (cull >= 0 && run.trace.structure.separators)
    return growingList(run, "The priority list, the highest first", cull, "front");
  const sort = numberOf(run, "Z sort", (c) => c.kind === "compare" &&
    c.a === "face");
  return sort >= 0 && run.header.counters.length === 2 ? sortedFaces(run, sort)
    : null;
}

// Each event of the counter puts its subject at the end.
function growingList(run, title, counter, outcome) {
  const { trace } = run;
  const word = outcome === undefined ? -1
    : run.header.counters[counter].outcomes.indexOf(outcome);
  const when = [];
  for (let k = 0; k < trace.kept; k++)
    if (trace.counter[k] === counter && (word < 0 || trace.outcome[k] === word))
      when.push(k);
  const items = when.map((k) => ({ face: trace.a0[k], piece:
    run.header.counters[counter].a === "piece" ? trace.a1[k] : null }));
  const sorted = Uint32Array.from(when);
  return { title, faults: [], ofPieces: run.header.counters[counter].a ===
    "piece", at: (k) => ({ painted: items.slice(0, above(sorted, k)), order: [], marked: new Set(),
    sorting: false }) };
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
  } else if (what === "move") {
    state.order = [p, ...state.order.filter((x) => x !== p)];
    state.marked.add(p);
  } else if (what === "out") {
    state.order = state.order.filter((x) => x !== p);
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
  // The steps of the list, perhaps of one algorithm within another.
  const { name: first } = header.counters.find(({ name, a }) =>
    a === "piece" && name.endsWith("Z sort"));
  const within = first.slice(0, -"Z sort".length);
  const roles = header.counters.map(({ name }) =>
    name.startsWith(within) ? name.slice(within.length) : "");
  const ends = header.counters.map(({ outcomes }) =>
    outcomes?.indexOf("end of {Q}") ?? -1);
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
    const role = roles[counter[e]];
    if (role === "Z sort" && next < lists.length && lists[next].from === e) {
      doNow(e, { what: "sort", list: next++ });
      asked = -1;
    }
    if (state.sorting && roles[counter[e + 1]] !== "Z sort")
      doNow(e, { what: "begin", order: sorted(pieces()) });
    if (role === "Newell special" || role === "minimax tests") {
      const p = a1[e];
      if (state.order[0] !== p) paintUpTo(e, (x) => x === p);
      if (role === "minimax tests") continue;
      // Each Q comes after the one before, but the last may end {Q}.
      const place = state.order.indexOf(b1[e]);
      if (place < 1 || (asked === p && place !== last + 1)) faults.push(e);
      asked = outcome[e] === ends[counter[e]] ? -1 : p;
      last = place;
    } else if (role === "interchanges") {
      if (state.order[0] !== a1[e] || !state.order.includes(b1[e])) faults.push(e);
      doNow(e, { what: "move", p: b1[e] });
      asked = -1;
    } else if (role === "divisions") {
      if (!state.order.includes(a1[e])) faults.push(e);
      doNow(e, { what: "out", p: a1[e] });
      let f = e + 1;
      pieces().forEach(([, parent], child) => {
        if (parent !== a1[e]) return;
        let at = 0;
        for (; roles[counter[f]] === "insertions" && a1[f] === child; f++) at += 1;
        doNow(f - 1, { what: "in", p: child, at });
      });
      asked = -1;
    } else if (role === "segments" && pieces()[state.order[0]]?.[0] !== a0[e]) {
      paintUpTo(e, (x) => pieces()[x][0] === a0[e]);
    }
  }
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
  const search = numberOf(run, "priority search", (c) => c.a === "piece");
  const places = search < 0 ? [] : at(run.n).painted.map(({ piece }) => piece);
  return { title: "The priority list, the far end first", at, faults, ofPieces: true,
    numberOf: (c, p) => c === search ? places[p] : p };
}

// --- Trees ---

// { nodes: [{ face, words, front, behind, x, y, name }], roots, at(k): { now, seen,
//   path } }. A leaf has a name and no sides.
function treeOf(run) {
  const { structure } = run.trace;
  return structure.separators ? separatorTree(run, structure)
    : structure.nodes ? bspTree(run, structure) : null;
}

// Puts leaves and nodes side by side, in the order of the trees; returns how many.
function layOut(nodes, roots) {
  let x = 0, deepest = 0;
  const waiting = roots.slice().reverse().map((root) => [root, 0, false]);
  while (waiting.length) {
    const [n, y, ready] = waiting.pop();
    const { front, behind } = nodes[n];
    deepest = Math.max(deepest, y);
    if (ready || (front < 0 && behind < 0)) {
      Object.assign(nodes[n], { x: x++, y });
      continue;
    }
    if (behind >= 0) waiting.push([behind, y + 1, false]);
    waiting.push([n, y, true]);
    if (front >= 0) waiting.push([front, y + 1, false]);
  }
  return { width: x, depth: deepest + 1 };
}

// The way from the root: [node, side], and at last [node, null].
function pathTo(nodes, end) {
  const path = [[end, null]];
  for (let n = end; nodes[n].parent !== undefined; n = nodes[n].parent)
    path.unshift([nodes[n].parent,
      nodes[nodes[n].parent].front === n ? "front" : "behind"]);
  return path;
}

function withParents(nodes) {
  nodes.forEach(({ front, behind }, n) => [front, behind].forEach((child) => {
    if (child >= 0) nodes[child].parent = n;
  }));
  return nodes;
}

function separatorTree(run, { separators, root, clusters }) {
  const { trace } = run;
  const place = (side) => side >= 0 ? side : separators.length - 1 - side;
  const nodes = withParents([
    ...separators.map(([face, axis, at, front, behind]) => ({ face,
      words: face === null ? `the plane ${"xyz"[axis]} = ${at}`
        : `the plane of ${run.faceName(face)}`,
      front: place(front), behind: place(behind) })),
    ...clusters.map((faces, c) => ({ faces, words: `cluster ${c}`, name: String(c),
      front: -1, behind: -1 }))]);
  const { when, which } = visits(run, nodes, place(root), separators.length);
  return walked(nodes, [place(root)], when, which);
}

// The nodes in the order in which they are visited, and from which event on. At
// a separator, the eye's side tells which one comes first, and the next separator
// whether that is the nearer or the farther one. A cluster is at hand while its
// faces are tested for being back faces.
function visits(run, nodes, root, n) {
  const { trace } = run;
  const counter = numberOf(run, "inter-cluster priority");
  const cull = numberOf(run, "back-face cull");
  const asked = [], culled = [];
  for (let k = 0; k < trace.kept; k++)
    if (trace.counter[k] === counter) asked.push(k);
    else if (trace.counter[k] === cull) culled.push(k);
  const replay = (nearestFirst) => {
    const open = [root], when = [], which = [];
    let s = 0, f = 0, k = 0;
    while (open.length) {
      const node = open.pop();
      if (node < n) {
        if (trace.b0[asked[s]] !== node) return null;
        k = asked[s++];
        const { front, behind } = nodes[node];
        const frontFirst = (trace.outcome[k] === 2) === nearestFirst;
        open.push(frontFirst ? behind : front, frontFirst ? front : behind);
      } else if (cull >= 0) {
        if (!nodes[node].faces.length) continue;
        k = culled[f];
        f += nodes[node].faces.length;
      } else {
        k += 1;
      }
      when.push(k);
      which.push(node);
    }
    return { when, which };
  };
  return replay(true) ?? replay(false) ?? { when: [], which: [] };
}

function bspTree(run, { nodes: given, roots }) {
  const { trace } = run;
  const nodes = withParents(given.map(([face, front, behind, first, n]) => ({ face,
    words: `the plane of ${run.faceName(face)}`, front, behind, first, n })));
  const nodeOf = new Int32Array(trace.structure.pieces.length).fill(-1);
  nodes.forEach(({ first, n }, k) => nodeOf.fill(k, first, first + n));
  const counter = numberOf(run, "pieces");
  const when = [], which = [];
  for (let k = 0; k < trace.kept; k++)
    if (trace.counter[k] === counter) {
      const node = nodeOf[placeOfPiece(run, trace.a1[k], trace.a0[k])];
      if (node === which.at(-1)) continue;
      when.push(k);
      which.push(node);
    }
  return walked(nodes, roots, when, which);
}

function walked(nodes, roots, when, which) {
  const size = layOut(nodes, roots);
  const sortedWhen = Uint32Array.from(when);
  return { nodes, roots, ...size, at: (k) => {
    const n = above(sortedWhen, k);
    const now = n ? which[n - 1] : -1;
    return { now, seen: which.slice(0, n), path: now < 0 ? []
      : pathTo(nodes, now) };
  } };
}

// --- Pyramids of cells ---

// { levels: [{ level, size, across, down }], of(counter): "a", "b" or null: which
//   subject is a cell of the pyramid, touched(k): for each level, how often each
//   cell was asked about }. A counter's cells are those of a pyramid if its
//   windows lie where the cells' places say.
function pyramidOf(run) {
  const { trace, header, width: m, height: n } = run;
  const side = header.counters.map((c) => c.computed ? null
    : c.a === "cell" ? "a" : c.b === "cell" ? "b" : null);
  const sizes = new Map(), good = side.map(() => false);
  const cellOf = (k, which) => which === "a"
    ? [trace.a0[k], trace.a1[k], trace.a2[k]]
    : [trace.b0[k], trace.b1[k], trace.b2[k]];
  const isOf = side.map(() => true);
  for (let k = 0; k < trace.kept; k++) {
    const c = trace.counter[k];
    if (!side[c]) continue;
    const [level, x, y] = cellOf(k, side[c]);
    if (!trace.width[k] || x < 0) isOf[c] = false;
    else if (trace.x[k] + trace.width[k] < m || trace.width[k] >= m)
      sizes.set(`${c},${level}`, Math.max(trace.width[k], trace.height[k],
        sizes.get(`${c},${level}`) ?? 0));
    if (x || y) good[c] = true;
  }
  for (let k = 0; k < trace.kept; k++) {
    const c = trace.counter[k];
    if (!side[c] || !isOf[c]) continue;
    const [level, x, y] = cellOf(k, side[c]);
    const size = sizes.get(`${c},${level}`);
    if (size && (trace.x[k] !== x * size || trace.y[k] !== y * size))
      isOf[c] = false;
  }
  const own = side.map((which, c) => which && isOf[c] && good[c] ? which : null);
  const level = new Map();
  for (const [key, size] of sizes) {
    const [c, l] = key.split(",").map(Number);
    if (own[c]) level.set(l, Math.max(size, level.get(l) ?? 0));
  }
  if (!level.size) return null;
  const levels = [...level].sort(([, p], [, q]) => q - p).map(([l, size]) => ({
    level: l, size, across: Math.ceil(m / size), down: Math.ceil(n / size) }));
  const placeOf = new Map(levels.map(({ level: l }, k) => [l, k]));
  let touched = null, done = 0;
  const clear = () => {
    touched = levels.map(({ across, down }) => new Uint32Array(across * down));
    done = 0;
  };
  return { levels, of: (c) => own[c], cellOf,
    placeOf: (l) => placeOf.get(l) ?? -1,
    touched: (k) => {
      if (!touched || k < done) clear();
      for (; done < Math.min(k, trace.kept); done++) {
        const which = own[trace.counter[done]];
        if (!which) continue;
        const [l, x, y] = cellOf(done, which);
        const p = placeOf.get(l);
        if (p !== undefined) touched[p][y * levels[p].across + x] += 1;
      }
      return touched;
    } };
}
