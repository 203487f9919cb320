// SPDX-License-Identifier: GPL-3.0-or-later
// The lines of an outline: which the run comes to, and which a step takes.

const depthOf = (text) => text.length - text.trimStart().length;

// For each line, whether it is within line k: below it and further in.
function within(outline, k) {
  const found = [];
  for (let l = k + 1; l < outline.length &&
    depthOf(outline[l]) > depthOf(outline[k]); l++) found.push(l);
  return found;
}

// The lines that this run does not come to: all their counters, or all lines within
// them, stay 0.
export function unusedLines({ header, trace }) {
  const { outline } = header;
  const own = outline.map((_, k) => trace.counts.filter((_, c) =>
    header.counters[c].line === k + 1));
  const unused = own.map(() => false);
  for (let k = own.length - 1; k >= 0; k--) {
    const inner = within(outline, k);
    const isIdle = inner.every((l) => unused[l]);
    unused[k] = own[k].length ? own[k].every((n) => !n) && isIdle
      : inner.length ? isIdle : isVariant(outline[k]);
  }
  return unused;
}

// A line that only a variant has, as its first word says.
const isVariant = (text) => /^\s*(with|lazily|where)\b/.test(text);

// The first line that this run comes to.
export function firstLine(run) {
  const unused = unusedLines(run);
  return run.header.outline.find((_, k) => !unused[k])?.trim() ?? "";
}

// The line within `line` that names the test of the outcome "test 2: ..."; null: none.
function lineOfTest({ header: { outline } }, { outcome }, line) {
  const test = /^test (\d)/.exec(outcome ?? "")?.[1];
  const found = test && within(outline, line - 1).find((l) =>
    new RegExp(`\\btest ${test}\\b`).test(outline[l]));
  return found ? found + 1 : null;
}

// The line that event k takes, as a number from 1: that of the test that decides; if
// the next step is one of the same subject in a line within the one that asks, that
// line; otherwise its own.
export function branchOf(run, k) {
  const e = run.event(k), line = e.counter.line;
  const test = line && lineOfTest(run, e, line);
  if (test) return test;
  if (!line || e.kind === "accept" || k + 1 >= run.trace.kept) return line;
  const next = run.event(k + 1);
  const isSame = next.a.kind === e.a.kind &&
    next.a.ids.every((x, c) => x === e.a.ids[c]);
  return isSame && next.counter.line && next.kind !== "compare" &&
    within(run.header.outline, line - 1).includes(next.counter.line - 1)
    ? next.counter.line : line;
}
