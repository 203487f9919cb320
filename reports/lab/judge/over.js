// SPDX-License-Identifier: GPL-3.0-or-later
// Which faces lie over the samples of a small picture, the nearest first, as exact
// numbers have it.

export const M = 64, N = 48; // samples

// A list of [{ face, depth }] for each sample.
export async function facesOver(client, scene, view) {
  const request = { ...view, m: M, n: N }, rows = [];
  for (let j = 0; j < N; j++)
    rows.push(...await Promise.all(Array.from({ length: M }, (_, i) =>
      client.why(scene, request, i, j))));
  return rows;
}

// Numbers from 0 to 1 that follow a seed.
export function chance(seed) {
  let x = (seed * 2654435761 + 12345) >>> 0;
  return () => {
    x ^= x << 13; x >>>= 0;
    x ^= x >>> 17;
    x ^= x << 5; x >>>= 0;
    return x / 4294967296;
  };
}

export function shuffled(all, random) {
  const out = all.slice();
  for (let k = out.length - 1; k > 0; k--) {
    const l = Math.floor(random() * (k + 1));
    [out[k], out[l]] = [out[l], out[k]];
  }
  return out;
}

// Faces f, g, h ... of which each must be painted after the next, and the last after
// the first; null: there is an order.
export function circleIn(over) {
  const after = new Map(); // face -> faces that are painted before it
  for (const list of over)
    for (const { face } of list.slice(1)) {
      if (!after.has(list[0].face)) after.set(list[0].face, new Set());
      after.get(list[0].face).add(face);
    }
  const state = new Map(), path = [];
  const visit = (f) => {
    state.set(f, "open");
    path.push(f);
    for (const g of after.get(f) ?? []) {
      if (state.get(g) === "open") return path.slice(path.indexOf(g));
      const found = state.has(g) ? null : visit(g);
      if (found) return found;
    }
    path.pop();
    state.set(f, "done");
    return null;
  };
  for (const f of after.keys()) {
    const found = state.has(f) ? null : visit(f);
    if (found) return found;
  }
  return null;
}
