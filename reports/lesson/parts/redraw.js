// SPDX-License-Identifier: GPL-3.0-or-later
import { setPaper } from "../data/kinds.js";

// Calls show() when what is drawn must be drawn anew: the window has another size,
// the colours become dark or light, or the page goes to paper.
export function whenLooksChange(show) {
  let resizing = 0;
  addEventListener("resize", () => {
    cancelAnimationFrame(resizing);
    resizing = requestAnimationFrame(show);
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", show);
  addEventListener("beforeprint", () => { setPaper(true); show(); });
  addEventListener("afterprint", () => { setPaper(false); show(); });
}
