// SPDX-License-Identifier: GPL-3.0-or-later
// The stretches of two segments that a logarithmic search compares (figure 28 of the
// survey): it begins with the whole segments on the row, and halves them. The events
// are replayed from where the search of the pair began.
import { closeness, segmentsOn } from "./projection.js";
import { hasOutcome } from "./run.js";

// { two, comparisons, divisions, half } at event k. two: the stretches, { x0, x1, q0, q1 }
// each, q as of closeness; how often the two segments have been compared and divided so
// far. half, where one is divided: halfOf of it. null: the event is none of such a search.
export function searchAt(run, k) {
  const search = run.counterOf("depth-search");
  const divide = run.counterOf("depth-division");
  const { counter, a0, b0 } = run.trace;
  const notes = ["pair-divided", "second-half"].map(run.counterOf);
  const isOf = (e) => [search, divide, ...notes].includes(counter[e]) &&
    ((a0[e] === a0[k] && b0[e] === b0[k]) || (a0[e] === b0[k] && b0[e] === a0[k]));
  if (divide < 0 || !isOf(k)) return null;
  let first = k;
  while (first > 0 && isOf(first - 1)) first -= 1;
  return new Replay(run, search, notes, first, k).found;
}

class Replay {
  // notes: counters whose events only tell about a search. The replay skips them.
  constructor(run, search, notes, first, wanted) {
    Object.assign(this, { run, search, notes, at: first, wanted, found: null,
      comparisons: 0, divisions: 0 });
    while (this.at <= wanted && !this.found) {
      const before = this.at;
      this.begin();
      if (this.at === before) break;
    }
  }

  // A new search of the pair, from the whole segments on.
  begin() {
    const { run, at } = this;
    const { trace } = run;
    if (trace.counter[at] !== this.search) return;
    const [l, r, j] = [trace.x[at], trace.x[at] + trace.width[at], trace.y[at]];
    Object.assign(this, { comparisons: 0, divisions: 0 });
    const [f, g] = [trace.a0[at], trace.b0[at]].map((face) =>
      wholeSegment(run, face, l, r, j));
    if (f && g) this.searched(f, g, l, r);
  }

  // Takes the next event, of the samples [l, r), and notes the stretches if it is the
  // wanted one.
  take(f, g, l, r) {
    while (this.notes.includes(this.run.trace.counter[this.at])) this.at += 1;
    const isDivision = this.run.trace.counter[this.at] !== this.search;
    if (isDivision) this.divisions += 1;
    else this.comparisons += 1;
    if (this.at === this.wanted) {
      const two = this.isTurned(f, g), { comparisons, divisions } = this;
      this.found = { two, comparisons, divisions,
        half: isDivision ? halfOf(two, l, r) : null };
    }
    this.at += 1;
    return this.at - 1;
  }

  // A division names the longer one first.
  isTurned(f, g) {
    return this.run.trace.a0[this.at] === f.face ? [f, g] : [g, f];
  }

  // Where the answer of the search in [l, r) ends; null: the wanted event is found.
  searched(f, g, l, r) {
    for (;;) {
      const e = this.take(f, g, l, r);
      if (this.found) return null;
      const compared = this.run.event(e);
      if (!hasOutcome(compared, "undecided")) return { outcome: compared.outcome, end: r };
      this.take(f, g, l, r);
      if (this.found) return null;
      const isLonger = f.x1 - f.x0 >= g.x1 - g.x0;
      const halves = [narrowed(f, l, r), narrowed(g, l, r)];
      const [which, other] = isLonger ? [0, 1] : [1, 0];
      if (!halves[which] && !halves[other]) break;
      const chosen = halves[which] ? which : other;
      if (chosen === 0) f = halves[0];
      else g = halves[1];
    }
    const middle = splitOf(f.x1 - f.x0 >= g.x1 - g.x0 ? f : g);
    const first = this.searched(f, g, l, middle);
    if (!first || first.end < middle) return first;
    const second = this.searched(f, g, middle, r);
    return second && { outcome: first.outcome,
      end: second.outcome === first.outcome ? second.end : middle };
  }
}

// The segment of a face on row j that has the samples [l, r).
function wholeSegment(run, face, l, r, j) {
  const near = run.near ??= closeness(run);
  const rows = run.rowSegments ??= new Map();
  if (!rows.has(j)) rows.set(j, segmentsOn(run, j, near));
  const sample = (x) => Math.ceil(x - 0.5);
  const own = rows.get(j).find((s) => s.face === face && sample(s.x0) < r &&
    sample(s.x1) > l);
  if (!own) return null;
  const [x0, x1] = [Math.max(0, sample(own.x0)),
    Math.min(run.width, sample(own.x1)) - 1];
  const q = (x) => near(face)(x + 0.5, j + 0.5);
  return { face, x0, x1, q0: q(x0), q1: q(x1) };
}

// The half that has all samples [l, r); null: neither has.
function narrowed(p, l, r) {
  const middle = (p.x0 + p.x1) / 2, q = (p.q0 + p.q1) / 2;
  if (r - 1 <= middle && middle < p.x1) return { ...p, x1: middle, q1: q };
  return l >= middle && middle > p.x0 ? { ...p, x0: middle, q0: q } : null;
}

// The sample with which the right part begins, where samples are divided too.
const splitOf = ({ x0, x1 }) => Math.floor((x0 + x1) / 2) + 1;

// What becomes of two stretches for the samples [l, r), the longer one first: { which,
// middle, kept: [x0, x1], side, split }. Stretch number `which` is divided at column
// `middle`; of it, the half on that side is kept. No side: the samples lie on both sides
// of both midpoints, and their right part begins at column `split`.
function halfOf(two, l, r) {
  const which = two.findIndex((p) => narrowed(p, l, r));
  if (which < 0) return { which: 0, middle: (two[0].x0 + two[0].x1 + 1) / 2, kept: null,
    side: null, split: splitOf(two[0]) };
  const { x0, x1 } = two[which], kept = narrowed(two[which], l, r);
  return { which, middle: (x0 + x1 + 1) / 2, kept: [kept.x0, kept.x1],
    side: kept.x0 === x0 ? "left" : "right", split: null };
}
