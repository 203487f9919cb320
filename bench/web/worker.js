// SPDX-License-Identifier: GPL-3.0-or-later
// A Worker with a core in it. A message { id, call, args } is answered by { id, value }
// or { id, error: { status, text, isFatal } }. The first call is "load", whose argument
// is that of loadCore. Arrays of answers are handed over, not copied.
import { loadCore } from "./core.js";

let core = null;

const arraysOf = (value) => value && typeof value === "object"
  ? Object.values(value).concat(value).filter(ArrayBuffer.isView)
    .map((array) => array.buffer) : [];

async function answer(call, args) {
  if (call === "load") {
    core = await loadCore(...args);
    return core.version;
  }
  return core[call](...args);
}

globalThis.onmessage = async ({ data: { id, call, args } }) => {
  try {
    const value = await answer(call, args);
    globalThis.postMessage({ id, value }, arraysOf(value));
  } catch (error) {
    const { status = 5, text = String(error), isFatal = false } = error;
    globalThis.postMessage({ id, error: { status, text, isFatal } });
  }
};
