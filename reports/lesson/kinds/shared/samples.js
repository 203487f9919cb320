// SPDX-License-Identifier: GPL-3.0-or-later
// Kinds of answers with one number a sample.

export const UNDECIDED = -2;
export const PROGRESS = "of the samples painted";
const WORK = 1 << 18; // samples painted from one keyframe to the next
const ROOM = 1 << 24; // samples of all keyframes

// An Int32Array of what was written to each sample; values[k] by event k.
export function samplesPainting(run, values, final) {
  const { trace, accepts, width: m, height: n } = run;
  const { x, y, width, height } = trace;
  const ids = new Int32Array(m * n);
  const seen = new Uint32Array(accepts.length); // samples painted by then
  const frames = [], from = []; // ids before accepted event from[]
  let done = 0, painted = 0;

  const paint = (k) => {
    const value = values[k];
    const left = Math.max(x[k], 0), right = Math.min(x[k] + width[k], m);
    const bottom = Math.min(y[k] + height[k], n);
    for (let j = Math.max(y[k], 0); j < bottom; j++)
      ids.fill(value, j * m + left, j * m + Math.max(right, left));
  };
  const vacant = (k) => {
    let many = 0;
    const right = Math.min(x[k] + width[k], m);
    const bottom = Math.min(y[k] + height[k], n);
    for (let j = Math.max(y[k], 0); j < bottom; j++)
      for (let i = Math.max(x[k], 0); i < right; i++)
        many += ids[j * m + i] === UNDECIDED ? 1 : 0;
    return many;
  };

  // All once, for keyframes and for how much is painted when.
  const least = Math.max(WORK, 2 * m * n);
  const most = Math.max(1, Math.floor(ROOM / (m * n)));
  let work = least, step = 1;
  ids.fill(UNDECIDED);
  for (let p = 0; p < accepts.length; p++) {
    if (work >= least * step) {
      frames.push(ids.slice());
      from.push(p);
      work = 0;
      if (frames.length >= most) { // keep every other one
        for (let k = 1; 2 * k < frames.length; k++) {
          frames[k] = frames[2 * k];
          from[k] = from[2 * k];
        }
        frames.length = from.length = Math.ceil(frames.length / 2);
        step *= 2;
      }
    }
    const k = accepts[p];
    painted += vacant(k);
    seen[p] = painted;
    paint(k);
    work += width[k] * height[k] + 16;
  }
  done = accepts.length;

  const at = (k) => {
    const wanted = run.accepted(k);
    if (k >= run.n && run.leftOut) return final();
    if (wanted < done || wanted > done + 4096) {
      let frame = from.length - 1;
      while (frame > 0 && from[frame] > wanted) frame -= 1;
      if (!from.length || from[frame] > wanted) {
        ids.fill(UNDECIDED);
        done = 0;
      } else if (wanted < done || from[frame] > done) {
        ids.set(frames[frame]);
        done = from[frame];
      }
    }
    for (; done < wanted; done++) paint(accepts[done]);
    return ids;
  };

  const decided = (k) => {
    if (k >= run.n) return 1;
    const p = run.accepted(k);
    return p ? seen[p - 1] / (m * n) : 0;
  };
  return { at, decided, final };
}

// The numbers of all samples, of runs of equal ones; null is -1.
export function spread({ width, height }, runs) {
  const out = new Int32Array(width * height);
  for (let k = 0, at = 0; k < runs.length; k += 2)
    out.fill(runs[k] ?? -1, at, at += runs[k + 1]);
  return out;
}

// Whether a painting ends as the answer, in which nothing is the background.
export function isAnswer(run, painting) {
  const answer = painting.final();
  return painting.at(run.n).every((f, k) =>
    (f === UNDECIDED ? -1 : f) === answer[k]);
}

// colour(value): packed, of a value from 0 on.
export function drawSamples({ put, background }, values, colour) {
  put((k) => values[k] >= 0 ? colour(values[k])
    : values[k] === UNDECIDED ? 0 : background);
}
