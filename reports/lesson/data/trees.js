// SPDX-License-Identifier: GPL-3.0-or-later
// Trees of planes, which stand beside the scene.
import { placeOfPiece } from "./pieces.js";
import { above } from "./run.js";

// { nodes: [{ face, words, front, behind, x, y, name }], roots, at(k): { now, seen,
//   path } }. A leaf has a name and no sides.
export function treeOf(run) {
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
  const counter = run.counterOf("inter-cluster");
  const cull = run.counterOf("back-face-cull");
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
  const counter = run.counterOf("piece");
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
