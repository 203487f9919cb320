// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of a run, in words. The texts of the lessons take all their numbers from
// here, so that none contradicts the counters.
import { whole } from "../../page/data/format.js";

export const times = (n) => whole(n);

// The place of a counter, by its key or its name; -1: the run has none.
export function counterNamed(run, name) {
  const byKey = run.counterOf(name);
  return byKey >= 0 ? byKey : run.header.counters.findIndex((c) => c.name === name);
}

export function countOf(run, name) {
  const c = counterNamed(run, name);
  return c < 0 ? 0 : run.trace.counts[c];
}

export const share = (part, all) => all ? `${(100 * part / all).toFixed(
  part && part / all < 0.01 ? 1 : 0)} %` : "none of none";

// How many events of the counter have that outcome; the page may have left some out.
export function withOutcome(run, name, outcome) {
  const c = counterNamed(run, name);
  const word = run.header.counters[c]?.outcomes?.indexOf(outcome) ?? -1;
  const { counter, outcome: outcomes, kept } = run.trace;
  let n = 0;
  for (let k = 0; k < kept && word >= 0; k++)
    if (counter[k] === c && outcomes[k] === word) n += 1;
  return n;
}

// "1,234 of A for 56 of B: 22.0 for each." B is a counter, or a number of `what`.
export function perEach(run, name, other, what) {
  const a = countOf(run, name);
  const b = typeof other === "number" ? other : countOf(run, other);
  const label = (x) => run.header.counters[counterNamed(run, x)]?.name ?? x;
  return `${times(a)} × ${label(name)} for ${times(b)} × ${what ?? label(other)}: ${
    b ? (a / b).toFixed(2) : "none"} for each.`;
}

// How often each outcome of a counter came, of those like a pattern, the most frequent
// first.
export function mostOutcomes(run, name, like = /./) {
  const words = run.header.counters[counterNamed(run, name)]?.outcomes ?? [];
  return `${words.map((word) => [withOutcome(run, name, word), word])
    .filter(([n, word]) => n && like.test(word)).sort(([n], [m]) => m - n)
    .map(([n, word]) => `${word}: ${times(n)}`).join("; ")}.`;
}
