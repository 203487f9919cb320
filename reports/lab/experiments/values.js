// SPDX-License-Identifier: GPL-3.0-or-later
// What is drawn over N. A measured point is { algorithm, x, counts, costs, seconds }:
// costs as core.predicted gives them.
import { KINDS } from "../../lesson/data/kinds.js";

const SPECIAL = { compare: "all comparisons", predicted:
  "the weighed steps of Table III", seconds: "the time to draw" };

export const labelOf = (what) => SPECIAL[what] ?? (what.startsWith("counter:")
  ? what.slice(8) : `steps of the kind “${what}”`);

// { what: its label } for algorithms with these counters.
export function offered(counters) {
  const kinds = Object.keys(KINDS).filter((kind) => kind !== "compare" &&
    counters.some((c) => c.step === kind));
  const names = [...new Set(counters.map((c) => c.name))];
  return { ...SPECIAL, ...Object.fromEntries(kinds.map((k) => [k, labelOf(k)])),
    ...Object.fromEntries(names.map((n) => [`counter:${n}`, n])) };
}

const sum = (all) => all?.length ? all.reduce((a, b) => a + (b ?? 0), 0) : null;

// null: the point has none.
export function valueOf({ counts, costs, seconds }, what, counters) {
  if (what === "seconds") return seconds;
  if (what === "predicted") return sum(costs?.map((c) => c.measured));
  const isWanted = what.startsWith("counter:") ? (c) => c.name === what.slice(8)
    : (c) => c.step === what;
  return sum(counts.filter((_, k) => isWanted(counters[k])));
}

export const predictedOf = ({ costs }, what) => what !== "predicted" ? null
  : sum(costs?.map((c) => c.predicted).filter((x) => x !== null));
