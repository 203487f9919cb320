// SPDX-License-Identifier: GPL-3.0-or-later
// Intervals that hold the integrals of red, green and blue over each pixel, of which
// the middles are shown.
import { ofChannels } from "./shared/channels.js";

const shown = (bounds) => [...[0, 2, 4].map((k) =>
  Math.min(65535, Math.max(0, 65535 * (bounds[k] + bounds[k + 1]) / 2))), 65535];

export const area = { ...ofChannels("area", { many: 6, shown }), windows: "pixels" };
