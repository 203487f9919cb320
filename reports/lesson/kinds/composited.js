// SPDX-License-Identifier: GPL-3.0-or-later
// Splats of a volume: red, green, blue and opacity of each sample.
import { ofChannels } from "./shared/channels.js";

export const composited = { ...ofChannels("composited",
  { many: 4, shown: (channels) => channels }), windows: "pixels" };
