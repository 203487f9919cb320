// SPDX-License-Identifier: GPL-3.0-or-later
// What an algorithm has drawn after k steps. Each kind of answer has a painting:
// { at(k): what is drawn, decided(k): how much of it, 0 to 1, final(): the answer
//   of the trace in the same form, equal(): whether all events make that }.

export const UNDECIDED = -2;
const WORK = 1 << 18; // samples painted from one keyframe to the next
const ROOM = 1 << 24; // samples of all keyframes

export function painting(run) {
  return { ids: idsPainting, composited: (own) => channelsPainting(own, 4, (c) => c),
    area: (own) => channelsPainting(own, 6, middles),
    filtered: (own) => channelsPainting(own, 3, whole, sumsOf(own)),
    transparent: (own) =>
      channelsPainting(own, 3, (c) => [...c, 65535], own.trace.parts, BACKGROUND),
    shadowed: shadowedPainting, segments: segmentsPainting, polygons: polygonsPainting, voxels: voxelsPainting }[run.kind](run);
}

// --- samples: an Int32Array of what was written to each; values[k] by event k ---

function samplesPainting(run, values, final) {
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

// --- ids: faces; -1 is the background ---

function idsPainting(run) {
  const { width: m, height: n, trace } = run;
  const final = () => {
    const out = new Int32Array(m * n);
    const runs = trace.answer;
    for (let k = 0, at = 0; k < runs.length; k += 2)
      out.fill(runs[k] ?? -1, at, at += runs[k + 1]);
    return out;
  };
  const own = samplesPainting(run, trace.a0, final);
  const equal = () => {
    const answer = final();
    return own.at(run.n).every((f, k) =>
      (f === UNDECIDED ? -1 : f) === answer[k]);
  };
  return { ...own, equal };
}

// --- shadowed: a face f as 2 f, or 2 f + 1 where it is lit. An event without a part
//     shows a face that is not lit. ---

function shadowedPainting(run) {
  const { width: m, height: n, trace } = run;
  const values = Int32Array.from(trace.a0, (f, k) =>
    f < 0 ? f : 2 * f + (trace.part[k] && trace.parts[trace.part[k] - 1] ? 1 : 0));
  const spread = (runs) => {
    const out = new Int32Array(m * n);
    for (let k = 0, at = 0; k < runs.length; k += 2)
      out.fill(runs[k] ?? -1, at, at += runs[k + 1]);
    return out;
  };
  const final = () => {
    const lit = spread(trace.answer.lit);
    return spread(trace.answer.ids).map((f, k) => f < 0 ? f : 2 * f + lit[k]);
  };
  const own = samplesPainting(run, values, final);
  const equal = () => {
    const answer = final();
    return own.at(run.n).every((f, k) =>
      (f === UNDECIDED ? -1 : f) === answer[k]);
  };
  return { ...own, equal };
}

// --- composited, area, filtered and transparent: places in the list of parts, from 1;
//     0 if all parts are not there. Samples that are not written stay black, or as the
//     background is in a transparent picture. ---

// The background of a transparent picture: hsr_filter_colour of HSR_BACKGROUND.
const BACKGROUND = [3604, 4587, 6554];

// Of intervals of red, green and blue, as composited samples have them.
const middles = (bounds) => [...[0, 2, 4].map((k) =>
  Math.min(65535, Math.max(0, 65535 * (bounds[k] + bounds[k + 1]) / 2))), 65535];

// Of the sums of a filtered picture. A pixel to which colours will be added yet is
// too dark.
const whole = (sums) => [...sums.map((c) => c / 65536), 65535];

// Each part adds to the sums of its pixel: the sums after each.
function sumsOf({ trace, accepts, width: m }) {
  const sums = new Map(), all = [];
  for (const k of accepts) {
    const place = trace.y[k] * m + trace.x[k];
    const before = sums.get(place) ?? [0, 0, 0];
    const after = before.map((c, n) => c + trace.parts[trace.part[k] - 1][n]);
    sums.set(place, after);
    all[trace.part[k] - 1] = after;
  }
  return all;
}

// Of `many` numbers a sample; parts: what an accepted event makes of it;
// shown(numbers): its red, green, blue and opacity; nothing: what a sample holds that
// is not written.
function channelsPainting(run, many, shown, parts = run.trace.parts,
  nothing = Array(many).fill(0)) {
  const { width: m, height: n, trace } = run;
  const own = samplesPainting(run, trace.part, () => {
    const all = new Int32Array(m * n);
    return all.map((_, k) => k + 1);
  });
  const answer = Array.from({ length: m * n }, (_, k) =>
    trace.answer.slice(many * k, many * (k + 1)));
  const numbers = (value, k) => value === UNDECIDED ? null
    : k >= run.n && run.leftOut ? answer[value - 1] : parts[value - 1];
  // The colour of a value that at(k) holds: red, green, blue, opacity.
  const colour = (value, k) => {
    const own = numbers(value, k);
    return own && shown(own);
  };
  // How many events have touched each sample by then.
  const touched = new Uint32Array(m * n);
  const isSample = run.header.counters.map((c) => c.kind === "sample");
  const { counter, x, y, width, height } = trace;
  let done = 0;
  const touches = (k) => {
    if (k < done) {
      touched.fill(0);
      done = 0;
    }
    for (; done < Math.min(k, trace.kept); done++)
      if (isSample[counter[done]] && width[done] * height[done] === 1)
        touched[y[done] * m + x[done]] += 1;
    return touched;
  };
  const equal = () => own.at(run.n).every((value, k) => {
    const got = numbers(value, run.n) ?? nothing;
    return got.every((c, place) => c === answer[k][place]);
  });
  return { ...own, colour, touches, equal };
}

// --- segments: the list of accepted intervals ---

// An interval that goes on where the last one of its edge ended, with the same
// invisibility, lengthens that one.
function joined(parts) {
  const out = [];
  for (const [edge, invisibility, t0, t1] of parts) {
    const last = out.at(-1);
    if (last && last.key === String(edge) && last.t1 === t0 &&
        last.invisibility === invisibility) last.t1 = t1;
    else out.push({ key: String(edge), invisibility, t0, t1 });
  }
  return out.map((s) => `${s.key} ${s.invisibility} ${s.t0} ${s.t1}`).sort();
}

function segmentsPainting(run) {
  return partsPainting(run, joined);
}

// The accepted parts, one after another; sorted(parts): what two answers share.
function partsPainting(run, sorted) {
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

// --- polygons: the list of accepted regions ---

function polygonsPainting(run) {
  return partsPainting(run, (parts) => parts.map(String).sort());
}

// --- voxels: the list of accepted cubes ---

// [x, y, z] and size of each cube of a part, in voxels.
export function cubesOf([, corner, size, low, high]) {
  const cubes = [];
  for (let bit = 0; bit < 64; bit++) {
    if (!((bit < 32 ? low >>> bit : high >>> (bit - 32)) & 1)) continue;
    cubes.push([corner[0] + size * (bit & 3), corner[1] + size * (bit >> 2 & 3),
      corner[2] + size * (bit >> 4)]);
  }
  return cubes;
}

function voxelsPainting(run) {
  const { trace, accepts } = run;
  const { n, solids } = trace.answer;
  const at = (k) => trace.parts.slice(0, run.accepted(k));
  const final = () => {
    const out = new Int32Array(n[0] * n[1] * n[2]);
    for (let k = 0, place = 0; k < solids.length; k += 2)
      out.fill(solids[k], place, place += solids[k + 1]);
    return out;
  };
  const filled = (parts) => {
    const out = new Int32Array(n[0] * n[1] * n[2]);
    for (const part of parts)
      for (const [x, y, z] of cubesOf(part))
        for (let k = z; k < Math.min(z + part[2], n[2]); k++)
          for (let j = y; j < Math.min(y + part[2], n[1]); j++)
            for (let i = x; i < Math.min(x + part[2], n[0]); i++)
              out[(k * n[1] + j) * n[0] + i] = part[0];
    return out;
  };
  return { at, final,
    decided: (k) => accepts.length ? run.accepted(k) / accepts.length : 1,
    equal: () => {
      const answer = final();
      return filled(at(run.n)).every((s, k) => s === answer[k]);
    } };
}
