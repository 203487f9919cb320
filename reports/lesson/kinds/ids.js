// SPDX-License-Identifier: GPL-3.0-or-later
// The visible face of each sample; -1 is the background.
import { NONE } from "../data/run.js";
import { sampleStory } from "../data/story.js";
import { drawSamples, isAnswer, PROGRESS, samplesPainting, spread }
  from "./shared/samples.js";

function painting(run) {
  const final = () => spread(run, run.trace.answer);
  const own = samplesPainting(run, run.trace.a0, final);
  return { ...own, equal: () => isAnswer(run, own) };
}

function story(run, place) {
  const face = Math.max(run.painting.at(run.n)[place.j * run.width + place.i], NONE);
  return { ...sampleStory(run, place), face, end: face === NONE
    ? "Nothing is seen here but the background."
    : `Seen here in the end: ${run.faceName(face)}.` };
}

export const ids = { name: "ids", progress: PROGRESS, windows: "samples", holdsFaces: true,
  hint: "Click a sample for its story.", painting, story,
  draw: (easel, faces) => drawSamples(easel, faces, (f) => easel.colours[f]) };
