// SPDX-License-Identifier: GPL-3.0-or-later
// How large a picture may be while it moves.

const FRAME = 0.03; // seconds: 30 frames in a second, and a little for the page
const SMALL = 160, LEAST = 48; // columns

// size(whole): the size now; took(all, drawn): seconds that a frame took, of them those
// in which it was drawn. A picture that is small gets smaller only for drawing's sake.
export function pacer() {
  let share = 0.5, least = SMALL;
  return {
    size: ([m, n]) => {
      share = Math.max(Math.min(1, least / m), Math.min(1, share));
      return share > 0.95 ? [m, n] : [Math.round(m * share), Math.round(n * share)];
    },
    took: (all, drawn) => {
      least = drawn > FRAME || least < SMALL && drawn > FRAME / 3 ? LEAST : SMALL;
      share *= Math.max(0.4, Math.min(1.25, Math.sqrt(FRAME / Math.max(all, 1e-4))));
    },
  };
}
