// SPDX-License-Identifier: GPL-3.0-or-later
// The faces over each sample, folded into red, green and blue.
import { ofChannels } from "./shared/channels.js";

// hsr_filter_colour of HSR_BACKGROUND.
const BACKGROUND = [3604, 4587, 6554];

export const transparent = { ...ofChannels("transparent", { many: 3,
  nothing: BACKGROUND, shown: (channels) => [...channels, 65535] }), windows: "samples" };
