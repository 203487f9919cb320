// SPDX-License-Identifier: GPL-3.0-or-later
// Kinds of answers with several numbers a sample: values are places in the list of
// parts, from 1; 0 if all parts are not there.
import { colourOf, packed } from "../../data/kinds.js";
import { PROGRESS, samplesPainting, UNDECIDED } from "./samples.js";

// many: how many numbers a sample has; shown(numbers): its red, green, blue and
// opacity; partsOf(run): what the accepted events make of their samples; nothing:
// what a sample holds that is not written.
export function ofChannels(name, { many, shown, nothing = Array(many).fill(0),
  partsOf = (run) => run.trace.parts }) {
  return { name, progress: PROGRESS, draw,
    painting: (run) => painting(run, many, shown, partsOf(run), nothing) };
}

function painting(run, many, shown, parts, nothing) {
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

const encoded = (c) => Math.round(255 * (c <= 0.0031308 ? 12.92 * c
  : 1.055 * c ** (1 / 2.4) - 0.055));

// What is written; and before that, the more opaque the more often touched.
function draw({ run, put }, values, k) {
  const touches = run.painting.touches(k);
  const grey = packed(colourOf("--faint"));
  put((s) => {
    const rgba = run.painting.colour(values[s], k);
    const [r, g, b] = rgba?.map((c) => encoded(c / 65535)) ?? [];
    return rgba ? (255 << 24 | b << 16 | g << 8 | r) >>> 0
      : ((Math.min(200, 26 * Math.log2(1 + touches[s])) << 24) |
        (grey & 0xffffff)) >>> 0;
  });
}
