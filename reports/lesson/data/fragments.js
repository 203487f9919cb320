// SPDX-License-Identifier: GPL-3.0-or-later
// Of an algorithm that compares edges with convex volumes: the fragment of the edge
// that is at hand, and the part of it that the volume hides. The steps of an edge are
// replayed: the trace says what was left, and the scene says where.
import { hasOutcome } from "./run.js";
import { planesOf } from "./volumes.js";

// { from, to, hidden: [from, to] or null } at event k, as shares of the edge from its
// first end; null: the event is none of these, or the places are not known.
export function fragmentAt(run, k) {
  const test = run.counterOf("edge-volume");
  if (test < 0) return null;
  run.fragments ??= new Map();
  const first = beginOf(run, k);
  if (first === null) return null;
  if (!run.fragments.has(first)) run.fragments.set(first, replay(run, first, test));
  return run.fragments.get(first).get(k) ?? null;
}

const isSame = ({ a0, a1, aKind }, k, l) => a0[k] === a0[l] && a1[k] === a1[l] &&
  aKind[k] === aKind[l];

// The first step of the fragments of this edge; null: it has not come to them.
function beginOf(run, k) {
  const { trace } = run;
  const counter = run.counterOf("fragment");
  let first = null;
  for (let e = k; e >= 0 && isSame(trace, e, k); e--)
    if (trace.counter[e] === counter) first = e;
  return first;
}

// Event -> fragment, for the steps of one edge.
function replay(run, first, test) {
  const { trace } = run;
  const counter = run.counterOf("fragment"), condition = run.counterOf("fragment-condition");
  const known = new Map(), stack = [[0, 1]];
  let at = null, volume = null;
  for (let e = first; e < trace.kept && isSame(trace, e, first); e++) {
    const { counter: own } = trace;
    if (own[e] === counter) {
      at = stack.pop();
      if (!at) break;
      known.set(e, { from: at[0], to: at[1], hidden: null });
    } else if (own[e] === test) {
      volume = hiddenBy(run, first, trace.b0[e]);
      const left = leftOf(at, volume, run.event(e));
      if (!left) break;
      const now = { from: at[0], to: at[1], hidden: left.hidden };
      for (let l = e - 1; l > first && own[l] === condition; l--) known.set(l, { ...now, hidden: null });
      known.set(e, now);
      known.set(e + 1, now); // what it comes to
      [at] = left.pieces;
      if (left.pieces.length > 1) stack.push(left.pieces[1]);
    }
  }
  return known;
}

const NEAR = 1e-6;

// { hidden, pieces } by what the step says; null: the places do not agree with it.
function leftOf(at, volume, e) {
  if (!at) return null;
  const [from, to] = at;
  if (hasOutcome(e, "none-hidden")) return { hidden: null, pieces: [at] };
  const all = hasOutcome(e, "all-hidden");
  if (!volume) return all ? { hidden: at, pieces: [] } : null;
  const hidden = [Math.max(from, volume[0]), Math.min(to, volume[1])];
  if (all) return { hidden: at, pieces: [] };
  if (hidden[1] - hidden[0] < -NEAR) return null;
  const before = [from, hidden[0]], after = [hidden[1], to];
  if (hasOutcome(e, "middle-hidden")) return { hidden, pieces: [before, after] };
  return { hidden, pieces: [hidden[0] - from > to - hidden[1] ? before : after] };
}

// --- What a convex volume hides of an edge ---

// With a point of the edge at share t, and a point of the line of sight to it at share l
// from the eye, E + l (A - E) + l t (B - A): all that is within a volume is linear in l
// and u = l t. So the triangle 0 <= u <= l <= 1 is cut by the volume's planes.
// The shares [from, to] between which it is hidden; null: nowhere, or not known.
function hiddenBy(run, k, v) {
  const key = `${run.trace.a0[k]},${run.trace.a1[k]},${v}`;
  run.hiddenBy ??= new Map();
  if (!run.hiddenBy.has(key)) run.hiddenBy.set(key, cutBy(run, k, v));
  return run.hiddenBy.get(key);
}

function cutBy(run, k, v) {
  const planes = planesOf(run, v);
  const { view } = run.header;
  const [a, b] = [run.trace.a0[k], run.trace.a1[k]].map((p) => run.trace.points[p]);
  if (!planes || !a || !b || view.parallel) return null;
  let cut = [[0, 0], [1, 0], [1, 1]];
  for (const { normal, offset } of planes) {
    const at = dot(normal, view.eye) - offset;
    const sight = dot(normal, a) - dot(normal, view.eye);
    const along = dot(normal, b) - dot(normal, a);
    cut = clipped(cut, ([l, u]) => -(at + l * sight + u * along));
    if (cut.length < 3) return null;
  }
  const shares = cut.filter(([l]) => l > 1e-9).map(([l, u]) => u / l);
  return shares.length ? [Math.min(...shares), Math.max(...shares)] : null;
}

const dot = (p, q) => p.reduce((sum, x, k) => sum + x * q[k], 0);

// What of a polygon lies where inside(point) >= 0.
function clipped(polygon, inside) {
  const out = [];
  polygon.forEach((p, n) => {
    const q = polygon[(n + 1) % polygon.length];
    const [s, t] = [inside(p), inside(q)];
    if (s >= 0) out.push(p);
    if ((s > 0 && t < 0) || (s < 0 && t > 0))
      out.push(p.map((x, c) => x + (q[c] - x) * s / (s - t)));
  });
  return out;
}
