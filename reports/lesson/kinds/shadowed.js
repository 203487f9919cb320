// SPDX-License-Identifier: GPL-3.0-or-later
// The visible face of each sample, and whether it is lit: face f as 2 f, or 2 f + 1
// where it is lit. An event without a part shows a face that is not lit.
import { drawSamples, isAnswer, PROGRESS, samplesPainting, spread }
  from "./shared/samples.js";

function painting(run) {
  const { trace } = run;
  const values = Int32Array.from(trace.a0, (f, k) =>
    f < 0 ? f : 2 * f + (trace.part[k] && trace.parts[trace.part[k] - 1] ? 1 : 0));
  const final = () => {
    const lit = spread(run, trace.answer.lit);
    return spread(run, trace.answer.ids).map((f, k) => f < 0 ? f : 2 * f + lit[k]);
  };
  const own = samplesPainting(run, values, final);
  return { ...own, equal: () => isAnswer(run, own) };
}

const dark = (colour) => (colour & 0xff000000 | colour >> 1 & 0x7f7f7f) >>> 0;

export const shadowed = { name: "shadowed", progress: PROGRESS, windows: "samples", painting,
  draw: (easel, values) => drawSamples(easel, values, (value) => {
    const colour = easel.colours[value >> 1];
    return value & 1 ? colour : dark(colour);
  }) };
