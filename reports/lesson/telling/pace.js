// SPDX-License-Identifier: GPL-3.0-or-later
// How fast a run is played. At the standard speed nothing plays for two minutes.
import { momentsOf } from "./moments.js";

export const STANDARD = 30; // the speed, from 0 to 100
const LONGEST = 110; // seconds
const USUAL = { moment: 0.25, unit: 4, step: 16, whole: 0.25 }; // moves a second

// How many moves of a level a run has.
const movesOf = (run, level) => ({ moment: momentsOf(run).length,
  unit: run.units.length + 1, step: run.n, whole: 1 })[level];

// Moves a second; eight more of speed are twice as fast.
export const rateOf = (run, level, speed) =>
  Math.max(USUAL[level], movesOf(run, level) / LONGEST) * 2 ** ((speed - STANDARD) / 8);

// How long the whole run plays at the standard speed.
export const secondsOf = (run, level) =>
  movesOf(run, level) / rateOf(run, level, STANDARD);
