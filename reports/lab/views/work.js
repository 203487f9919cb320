// SPDX-License-Identifier: GPL-3.0-or-later
// Where in the picture an algorithm works: how often it looks at each sample, as
// hsr render --work has it.
import { count } from "../../page/data/format.js";

export async function workOf(client, scene, request) {
  const { m, n, work: values } = await client.draw(scene, { ...request, work: true });
  const most = values.reduce((a, b) => Math.max(a, b), 0);
  const all = values.reduce((a, b) => a + b, 0);
  return { m, n, values, most, words: `it looked ${count(Math.round(all))} times at a ` +
    `sample, at one of them ${count(Math.round(most))} times` };
}
