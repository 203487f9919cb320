// SPDX-License-Identifier: GPL-3.0-or-later
// The pixels of one picture: what the oracle saw, and where others differ. They
// are in a separate file, a call of hsrProbe, which is loaded when needed.

const loaded = new Map();

window.hsrProbe = (id, data) => loaded.set(id, data);

export async function loadProbe(id, source) {
  if (!loaded.has(id)) {
    await new Promise((resolve, reject) => {
      const script = document.createElement("script");
      script.onload = resolve;
      script.onerror = () => reject(new Error(`${source} cannot be read`));
      script.src = source;
      document.head.append(script);
    });
  }
  if (!loaded.has(id)) throw new Error(`${source} holds no probe of ${id}`);
  return decode(loaded.get(id));
}

// { width, height, faceAt(k), depthAt(k), differs(name, k), differing(name),
// drew(name), object(face) } with k = j * width + i.
function decode({ width, height, ids, depth, objects, differences = {} }) {
  const faces = new Int32Array(width * height);
  let k = 0;
  for (let run = 0; run + 1 < ids.length; run += 2) {
    faces.fill(ids[run], k, k + ids[run + 1]);
    k += ids[run + 1];
  }
  const depths = depth ? floats(depth) : null;
  const maps = new Map(Object.entries(differences).map(([name, list]) =>
    [name, new Map(list.map(([at, face, t]) => [at, { face, depth: t }]))]));
  return {
    width, height,
    oracle: (at) => ({ face: faces[at], depth: depths?.[at] ?? null }),
    drew: (name) => maps.has(name),
    seen: (name, at) => maps.get(name)?.get(at) ?? null,
    differing: (name) => [...maps.get(name)?.keys() ?? []]
      .sort((a, b) => a - b),
    anyDiffering: () => [...new Set([...maps.values()]
      .flatMap((map) => [...map.keys()]))].sort((a, b) => a - b),
    object: (face) => objectOf(objects ?? [], face),
  };
}

function floats(text) {
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const view = new DataView(bytes.buffer);
  return Float32Array.from({ length: bytes.length / 4 },
    (_, k) => view.getFloat32(4 * k, true));
}

// The object that a face belongs to, and the face's number within it, from 1.
function objectOf(objects, face) {
  const found = objects.find(([, first, n]) =>
    first <= face && face < first + n);
  return found ? { name: found[0], number: face - found[1] + 1 } : null;
}
