// SPDX-License-Identifier: GPL-3.0-or-later
// The pictures of all algorithms in one place, one after another.
const EACH = 700; // ms
const isCalm = matchMedia("(prefers-reduced-motion: reduce)");

// Begins, and returns what ends it. shown(k): shows picture k.
export function blinking(n, shown) {
  let k = 0;
  const next = () => {
    k = (k + 1) % n;
    shown(k);
  };
  next();
  const timer = setInterval(next, isCalm.matches ? 4 * EACH : EACH);
  return () => clearInterval(timer);
}
