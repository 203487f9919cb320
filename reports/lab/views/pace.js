// SPDX-License-Identifier: GPL-3.0-or-later
// How large a picture may be while it moves.

const FRAME = 0.028; // seconds; 30 frames are 33 ms each, and the page needs some
const LEAST = 48; // columns

// share: of the whole picture's sides, in the last frame.
export function pacer() {
  let share = 0.6;
  return {
    size: ([m, n]) => {
      const least = Math.min(1, LEAST / m);
      share = Math.max(least, Math.min(1, share));
      return share > 0.95 ? [m, n] : [Math.round(m * share), Math.round(n * share)];
    },
    took: (seconds) => {
      share *= Math.max(0.5, Math.min(1.2, Math.sqrt(FRAME / Math.max(seconds, 1e-4))));
    },
  };
}
