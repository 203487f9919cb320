// SPDX-License-Identifier: GPL-3.0-or-later
// Pyramids of cells, which stand beside the scene.

// { levels: [{ level, size, across, down }], of(counter): "a", "b" or null: which
//   subject is a cell of the pyramid, touched(k): for each level, how often each
//   cell was asked about }. A counter's cells are those of a pyramid if its
//   windows lie where the cells' places say.
export function pyramidOf(run) {
  const { trace, header, width: m, height: n } = run;
  const side = header.counters.map((c) => c.computed ? null
    : c.a === "cell" ? "a" : c.b === "cell" ? "b" : null);
  const sizes = new Map(), good = side.map(() => false);
  const cellOf = (k, which) => which === "a"
    ? [trace.a0[k], trace.a1[k], trace.a2[k]]
    : [trace.b0[k], trace.b1[k], trace.b2[k]];
  const isOf = side.map(() => true);
  for (let k = 0; k < trace.kept; k++) {
    const c = trace.counter[k];
    if (!side[c]) continue;
    const [level, x, y] = cellOf(k, side[c]);
    if (!trace.width[k] || x < 0) isOf[c] = false;
    else if (trace.x[k] + trace.width[k] < m || trace.width[k] >= m)
      sizes.set(`${c},${level}`, Math.max(trace.width[k], trace.height[k],
        sizes.get(`${c},${level}`) ?? 0));
    if (x || y) good[c] = true;
  }
  for (let k = 0; k < trace.kept; k++) {
    const c = trace.counter[k];
    if (!side[c] || !isOf[c]) continue;
    const [level, x, y] = cellOf(k, side[c]);
    const size = sizes.get(`${c},${level}`);
    if (size && (trace.x[k] !== x * size || trace.y[k] !== y * size))
      isOf[c] = false;
  }
  const own = side.map((which, c) => which && isOf[c] && good[c] ? which : null);
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
