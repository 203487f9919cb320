// SPDX-License-Identifier: GPL-3.0-or-later
// Parameters of built-in scenes: "soup:1000:7" of "soup:N:SEED".

// What a slider goes to: a page in a browser is no place for millions of faces.
// [least, standard, most] by scene and word; others by word alone.
const RANGES = {
  "harbor:N": [100, 800, 8000], "color-cube:N": [1, 6, 12],
  "color-sides:N": [1, 8, 60], "twist:N": [1, 40, 400],
  "sphere:N": [8, 2048, 20000], "terrain:N": [2, 32, 128],
  "terrain:PLANTS": [0, 0, 4], "rooms:N": [1, 5, 12], "rooms:DOORS": [0, 100, 100],
  "soup:N": [1, 200, 3000], "lattice:N": [1, 200, 2000], "panes:N": [1, 60, 600],
  "checker-cube:N": [3, 12, 24], "grid:N": [2, 6, 16], "heights:N": [2, 32, 96],
};
const BY_WORD = { NX: [1, 1, 3], NY: [0, 0, 3], NZ: [0, 0, 3],
  SEED: [0, 1, 99], N: [1, 10, 200] };

// Too large for a page.
const LARGE = new Set(["tower", "tower-bare", "traffic"]);
export const fits = ({ name, isThere }) => isThere && !LARGE.has(name);

export const nameOf = (scene) => scene.split(":")[0];

// [{ word, least, most, standard, value }]
export function parametersOf(usage, scene) {
  const given = scene.split(":").slice(1).map(Number);
  return usage.split(":").slice(1).map((word, k) => {
    const [least, normal, most] = RANGES[`${nameOf(usage)}:${word}`] ??
      BY_WORD[word] ?? [1, 10, 100];
    const value = Number.isInteger(given[k]) ? given[k] : normal;
    return { word, least: Math.min(least, value), most: Math.max(most, value),
      standard: normal, value };
  });
}

// With its parameters as they are first.
export const standardScene = (usage) => withValues(usage,
  parametersOf(usage, usage).map((p) => p.standard));
export const withValues = (usage, values) => [nameOf(usage), ...values].join(":");

// Numbers of one parameter, as for a chart: about n, each more than the last.
export function ladder({ least, most }, n = 12) {
  const from = Math.max(1, least);
  return [...new Set(Array.from({ length: n }, (_, k) =>
    Math.round(from * (most / from) ** (k / (n - 1)))))];
}
