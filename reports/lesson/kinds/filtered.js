// SPDX-License-Identifier: GPL-3.0-or-later
// Weighted sums of red, green and blue over the samples around each pixel. A pixel to
// which colours will be added yet is too dark.
import { ofChannels } from "./shared/channels.js";

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

export const filtered = { ...ofChannels("filtered", { many: 3, partsOf: sumsOf,
  shown: (sums) => [...sums.map((c) => c / 65536), 65535] }), windows: "pixels" };
