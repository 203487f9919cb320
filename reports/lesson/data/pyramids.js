// SPDX-License-Identifier: GPL-3.0-or-later
// Pyramids of cells, which stand beside the scene.

// { levels: [{ level, size, across, down }], of(counter): "a", "b" or null: which
//   subject is a cell of the pyramid, touched(k): for each level, how often each
//   cell was asked about }. A counter's cells are those of a pyramid if its
//   windows lie where the cells' places say.
export function pyramidOf(run) {
  const { trace, header, width: m, height: n } = run;
  const cellOf = (k, which) => which === "a"
    ? [trace.a0[k], trace.a1[k], trace.a2[k]]
    : [trace.b0[k], trace.b1[k], trace.b2[k]];
  const sizes = new Map(); // of levels, by counter
  const own = header.counters.map((counter, c) => counter.computed ? null
    : ["a", "b"].find((which) => counter[which] === "cell" &&
      isPyramid(run, c, (k) => cellOf(k, which), sizes)) ?? null);
  const level = new Map();
  for (const [key, size] of sizes) {
    const [c, l] = key.split(",").map(Number);
    if (own[c]) level.set(l, Math.max(size, level.get(l) ?? 0));
  }
  if (!level.size) return null;
  const levels = [...level].sort(([, p], [, q]) => q - p).map(([l, size]) => ({
    level: l, size, across: Math.ceil(m / size), down: Math.ceil(n / size) }));
  const placeOf = new Map(levels.map(({ level: l }, k) => [l, k]));
  let touched = null, done = 0;
  const clear = () => {
    touched = levels.map(({ across, down }) => new Uint32Array(across * down));
    done = 0;
  };
  return { levels, of: (c) => own[c], cellOf,
    placeOf: (l) => placeOf.get(l) ?? -1,
    touched: (k) => {
      if (!touched || k < done) clear();
      for (; done < Math.min(k, trace.kept); done++) {
        const which = own[trace.counter[done]];
        if (!which) continue;
        const [l, x, y] = cellOf(done, which);
        const p = placeOf.get(l);
        if (p !== undefined) touched[p][y * levels[p].across + x] += 1;
      }
      return touched;
    } };
}

// Whether the cells of a counter lie where their windows do; then its sizes are noted,
// by counter and level. A cell outside of the picture has no window.
function isPyramid({ trace, width: m }, c, cellOf, sizes) {
  const own = new Map();
  const events = [];
  let hasPlaces = false;
  for (let k = 0; k < trace.kept; k++) {
    if (trace.counter[k] !== c) continue;
    const [level, x, y] = cellOf(k);
    if (x < 0) return false;
    hasPlaces ||= x > 0 || y > 0;
    if (!trace.width[k]) continue;
    events.push(k);
    if (trace.x[k] + trace.width[k] < m || trace.width[k] >= m)
      own.set(level, Math.max(trace.width[k], trace.height[k], own.get(level) ?? 0));
  }
  const isThere = events.every((k) => {
    const [level, x, y] = cellOf(k);
    const size = own.get(level);
    return !size || (trace.x[k] === x * size && trace.y[k] === y * size);
  });
  if (!hasPlaces || !events.length || !isThere) return false;
  own.forEach((size, level) => sizes.set(`${c},${level}`, size));
  return true;
}
