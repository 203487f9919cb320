// SPDX-License-Identifier: GPL-3.0-or-later
// Kinds of answers that are lists of what was accepted.

export const PROGRESS = "of the answer drawn";

// The accepted parts, one after another; sorted(parts): what two answers share.
export function partsPainting(run, sorted) {
  const { trace, accepts } = run;
  const at = (k) => k >= run.n && run.leftOut ? trace.answer
    : trace.parts.slice(0, run.accepted(k));
  return {
    at,
    decided: (k) => k >= run.n ? 1 : accepts.length
      ? run.accepted(k) / accepts.length : 0,
    final: () => trace.answer,
    equal: () => {
      const own = sorted(at(run.n)), answer = sorted(trace.answer);
      return own.length === answer.length &&
        own.every((s, k) => s === answer[k]);
    },
  };
}
