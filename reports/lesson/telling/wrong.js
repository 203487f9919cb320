// SPDX-License-Identifier: GPL-3.0-or-later
// The samples that a run gets wrong: it painted a face there over a nearer one. Only
// where each sample may be painted several times, as by the painter.
import { closeness } from "../data/projection.js";

// Map: the place of a sample -> the event that painted it wrong.
export function wrongSamples(run) {
  run.wrong ??= found(run);
  return run.wrong;
}

// Whether the wrong samples of a run can be told.
export const tellsWrong = ({ kind, header }) => kind.holdsFaces &&
  header.faces.every((f) => f[3].length);

const MORE = 1e-7; // nearer by more than the error of doubles

function found(run) {
  const wrong = new Map();
  if (!tellsWrong(run)) return wrong;
  const { trace, width: m, accepts } = run;
  const near = closeness(run);
  const nearest = new Map(); // of all that were painted at a sample: how close
  for (const k of accepts) {
    const [f, j] = [trace.a0[k], trace.y[k]];
    if (f < 0 || trace.height[k] !== 1) continue;
    for (let i = trace.x[k]; i < trace.x[k] + trace.width[k]; i++) {
      const c = near(f)?.(i + 0.5, j + 0.5) ?? null, at = j * m + i;
      const best = nearest.get(at) ?? -Infinity;
      if (c !== null && best - c > MORE * Math.abs(best)) wrong.set(at, k);
      else wrong.delete(at); // a face seen from its edge has no depth to be told
      nearest.set(at, Math.max(best, c ?? -Infinity));
    }
  }
  return wrong;
}

// Whether event k paints over something nearer, which stays so.
export function paintsWrong(run, { k }) {
  run.wrongEvents ??= new Set(wrongSamples(run).values());
  return run.wrongEvents.has(k);
}
