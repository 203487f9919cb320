// SPDX-License-Identifier: GPL-3.0-or-later
// The regions of a visibility map, a tree of lines over the picture: when it is shown,
// rectangles of samples are compared with its nodes. Those that are not on both sides of
// a node's line are, together, the samples of its region.
import { outcomeOf } from "./run.js";

// node -> [rectangle as points, ...]; null: the run has no such map.
export function regionsOf(run) {
  const { trace, header } = run;
  const shown = run.counterOf("region-compared");
  if (shown < 0) return { regionOf: null };
  const divided = outcomeOf(header.counters[shown], "divided");
  const regions = new Map();
  for (let k = 0; k < trace.kept; k++) {
    if (trace.counter[k] !== shown || trace.outcome[k] === divided) continue;
    const [x, y, w, h] = [trace.x[k], trace.y[k], trace.width[k], trace.height[k]];
    const node = trace.a0[k];
    if (!regions.has(node)) regions.set(node, []);
    regions.get(node).push([[x, y], [x + w, y], [x + w, y + h], [x, y + h]]);
  }
  return { regionOf: (node) => regions.get(node) ?? [] };
}
