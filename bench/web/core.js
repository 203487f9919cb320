// SPDX-License-Identifier: GPL-3.0-or-later
// The core of hsr: scenes, algorithms, answers, the judge. Every call is done when it
// returns. docs/web.md describes the calls; bench/web/calls/ has their other half.
//
// Arguments   a scene is what open() gives, or its id; a drawer is its number.
// Results     arrays are copies.
// Errors      a call that fails throws an HsrError.
import createHsr from "./hsr.js";

// The statuses of hsr.h, by number.
export const STATUS = ["OK", "DIFFERENCE", "USAGE", "INPUT", "NOMEM", "INTERNAL",
  "REFUSED", "STOPPED"];

// status: as hsr.h has it; text: one line. isFatal: the core has ended.
export class HsrError extends Error {
  constructor(status, text, isFatal = false) {
    super(text);
    Object.assign(this, { name: "HsrError", status, text, isFatal });
  }
}

const fatal = (error) => new HsrError(STATUS.indexOf("INTERNAL"),
  `the core has ended: ${error?.message ?? error}`, true);

// Under node, wasm may be left out: it lies beside this file.
async function moduleOf({ wasm, module }) {
  if (module) return module;
  if (wasm) return WebAssembly.compile(await wasm);
  const { readFile } = await import("node:fs/promises");
  return WebAssembly.compile(await readFile(new URL("hsr.wasm", import.meta.url)));
}

// { wasm: its bytes, or module: compiled }
export async function loadCore(parts = {}) {
  const module = await moduleOf(parts);
  const hsr = await createHsr({
    instantiateWasm: (imports, done) => {
      WebAssembly.instantiate(module, imports).then((instance) => done(instance));
      return {};
    },
    print: () => {}, printErr: () => {},
  });
  return coreOf(hsr);
}

function coreOf(hsr) {
  let ended = null;

  // --- Memory of the core ---

  const buffer = () => hsr.HEAPU8.buffer;
  const copyOf = (Type, address, n) => address === null ? undefined
    : new Type(buffer(), address, n).slice();

  const textAt = (address) => {
    const bytes = hsr.HEAPU8;
    return new TextDecoder().decode(bytes.subarray(address, bytes.indexOf(0, address)));
  };

  // Gives does() the addresses of copies of texts and typed arrays; 0 for null.
  function withCopies(all, does) {
    const places = [];
    try {
      for (const one of all) {
        const array = typeof one === "string" ? new TextEncoder().encode(`${one}\0`) : one;
        const place = array ? hsr._web_allocate(array.byteLength) >>> 0 : 0;
        if (array && !place) throw new HsrError(STATUS.indexOf("NOMEM"), "out of memory");
        if (array) hsr.HEAPU8.set(new Uint8Array(array.buffer, array.byteOffset,
          array.byteLength), place);
        places.push(place);
      }
      return does(...places);
    } finally {
      if (!ended) places.forEach((place) => hsr._web_free(place));
    }
  }

  // --- Calls ---

  function call(name, ...args) {
    if (ended) throw ended;
    try {
      const status = hsr[`_web_${name}`](...args);
      const reply = textAt(hsr._web_reply() >>> 0);
      if (status) throw new HsrError(status, reply);
      return JSON.parse(reply);
    } catch (error) {
      if (error instanceof HsrError) throw error;
      throw ended = fatal(error);
    }
  }

  const idOf = (scene) => typeof scene === "object" ? scene.id : scene;
  const request = (what) => JSON.stringify(what);
  const asked = (name, scene, what, ...more) =>
    withCopies([request(what)], (text) => call(name, idOf(scene), text, ...more));

  const polygonsOf = ({ nRegions, nCycles, nPoints, ...p }) => ({
    face: copyOf(Uint32Array, p.face, nRegions),
    cycle: copyOf(Uint32Array, p.cycle, nRegions + 1),
    point: copyOf(Uint32Array, p.point, nCycles + 1),
    xy: copyOf(Float64Array, p.xy, 2 * nPoints) });

  const answerOf = ({ ids, rgba, segments, polygons, counts, work, ...rest }) => ({ ...rest,
    ids: copyOf(Uint32Array, ids, rest.m * rest.n),
    rgba: copyOf(Uint8ClampedArray, rgba, 4 * rest.m * rest.n),
    work: copyOf(Float32Array, work, rest.m * rest.n), segments: segments ?? undefined,
    polygons: polygons ? polygonsOf(polygons) : undefined, counts: counts ?? undefined });

  // --- Scenes ---

  // A file lies in a folder of its own while it is read.
  function open({ name, bytes, twoSided = false, weld = 0 }) {
    const path = bytes ? `/${name.split("@")[0].replaceAll("/", "_")}` : null;
    if (bytes) hsr.FS.writeFile(path, new Uint8Array(bytes));
    try {
      return withCopies([name, path], (...texts) =>
        call("open", ...texts, twoSided ? 1 : 0, weld));
    } finally {
      if (bytes && !ended) hsr.FS.unlink(path);
    }
  }

  function openArrays({ name = "arrays", xyz, ring, vertex, rgb, opacity,
    twoSided = false }) {
    const corners = Uint32Array.from(vertex), rings = ring && Uint32Array.from(ring);
    const faces = rings ? rings.length : corners.length / 3;
    const floats = (list) => list ? Float32Array.from(list) : null;
    return withCopies([name, Float64Array.from(xyz), rings ?? null, corners,
      floats(rgb), floats(opacity)], (text, points, sizes, list, colours, shares) =>
      call("open_arrays", text, points, xyz.length / 3, sizes, faces, list,
        corners.length, colours, shares, twoSided ? 1 : 0));
  }

  function geometry(scene) {
    const g = call("geometry", idOf(scene));
    return { xyz: copyOf(Float64Array, g.xyz, 3 * g.nVertices),
      ring: copyOf(Uint32Array, g.ring, g.nFaces),
      vertex: copyOf(Uint32Array, g.vertex, g.nCorners),
      rgb: copyOf(Float32Array, g.rgb, 3 * g.nFaces),
      opacity: copyOf(Float32Array, g.opacity, g.nFaces),
      object: copyOf(Uint32Array, g.object, g.nFaces), objects: g.objects,
      oneSided: copyOf(Uint8Array, g.oneSided, g.nFaces) };
  }

  // --- Steps and judging ---

  function steps(scene, what, { events = 2000000 } = {}) {
    const { bytes, size } = asked("steps", scene, what, events);
    return copyOf(Uint8Array, bytes, size);
  }

  function judge(scene, what, ids) {
    return withCopies([request(what), Uint32Array.from(ids)], (text, list) =>
      call("judge", idOf(scene), text, list, ids.length));
  }

  return {
    version: call("version"),
    builtins: () => call("builtins"),
    kinds: () => call("kinds"),
    algorithms: () => call("algorithms"),
    open, openArrays, geometry,
    memory: () => buffer().byteLength, // of the core, bytes
    close: (scene) => { call("close", idOf(scene)); },
    draw: (scene, what) => answerOf(asked("draw", scene, what)),
    prepare: (scene, what) => asked("prepare", scene, what),
    redraw: (drawer, what) => answerOf(asked("redraw", drawer, what)),
    release: (drawer) => { call("release", drawer); },
    judge,
    judgeAlgorithm: (scene, what) => asked("judge_algorithm", scene, what),
    steps,
    table1: (scene, what) => asked("table1", scene, what),
    predicted: (scene, what) => asked("predicted", scene, what),
    why: (scene, what, i, j) => asked("why", scene, what, i, j),
  };
}
