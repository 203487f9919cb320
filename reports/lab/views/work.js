// SPDX-License-Identifier: GPL-3.0-or-later
// Where in the picture an algorithm works: each of its steps is spread over the
// window that it is about. Steps about the whole picture, or none of it, are told.
import { count } from "../../page/data/format.js";
import { traceOf } from "../../lesson/data/trace.js";

const COLUMNS = 96; // of the picture that is looked at: steps take memory
const EVENTS = 400000;

export async function workOf(client, scene, request) {
  const m = Math.min(COLUMNS, request.m);
  const n = Math.max(1, Math.round(m * request.n / request.m));
  const trace = await traceOf(await client.steps(scene, { ...request, m, n },
    { events: EVENTS }));
  return spread(trace, m, n);
}

function spread({ kept, x, y, width, height }, m, n) {
  const values = new Float32Array(m * n);
  let elsewhere = 0;
  for (let k = 0; k < kept; k++) {
    const area = width[k] * height[k];
    if (!area || area >= m * n) {
      elsewhere += 1;
      continue;
    }
    const right = Math.min(m, x[k] + width[k]), end = Math.min(n, y[k] + height[k]);
    for (let j = Math.max(0, y[k]); j < end; j++)
      for (let i = Math.max(0, x[k]); i < right; i++) values[j * m + i] += 1 / area;
  }
  const most = values.reduce((a, b) => Math.max(a, b), 0);
  return { m, n, values, most, words: `the work at ${m} × ${n}: up to ${
    count(Math.round(most))} steps a sample${elsewhere
    ? `, and ${count(elsewhere)} of no place` : ""}` };
}
