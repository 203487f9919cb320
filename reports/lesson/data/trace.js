// SPDX-License-Identifier: GPL-3.0-or-later
// Reads what bench/lesson writes: one algorithm's run, in columns.

const FIELDS = ["aKind", "a0", "a1", "a2", "bKind", "b0", "b1", "b2",
  "x", "y", "width", "height", "outcome", "part"];
const SMALL = new Set(["aKind", "bKind", "outcome"]);

function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let k = 0; k < bytes.length; k++) bytes[k] = text.charCodeAt(k);
  return bytes;
}

async function inflate(bytes) {
  const stream = new Blob([bytes]).stream()
    .pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

export const readTrace = async (base64) =>
  traceOf(await inflate(bytesOf(base64.trim())));

// The members of the JSON text, and an array for each field: what it is in each
// event. `counter` has the events' counters.
export function traceOf(bytes) {
  const length = new DataView(bytes.buffer, bytes.byteOffset).getUint32(0, true);
  const said = JSON.parse(new TextDecoder().decode(bytes.subarray(4,
    4 + length)));
  const { kept, header } = said;
  const counter = bytes.slice(4 + length, 4 + length + kept);
  const columns = Object.fromEntries(FIELDS.map((name) =>
    [name, new (SMALL.has(name) ? Uint8Array : Int32Array)(kept)]));
  const events = eventsOf(counter, header.counters.length);
  let at = 4 + length + kept;
  for (const own of events)
    for (const name of FIELDS) at = fill(columns[name], own, bytes, at);
  return { ...said, counter, ...columns };
}

// The events of each counter.
function eventsOf(counter, n) {
  const many = new Uint32Array(n);
  for (let k = 0; k < counter.length; k++) many[counter[k]] += 1;
  const events = Array.from(many, (size) => new Uint32Array(size));
  many.fill(0);
  for (let k = 0; k < counter.length; k++)
    events[counter[k]][many[counter[k]]++] = k;
  return events;
}

// The differences of a field in the events of one counter; returns where the
// next field begins.
function fill(column, events, bytes, at) {
  let value = 0;
  for (let k = 0; k < events.length; k++) {
    let byte = bytes[at++];
    let number = byte & 127;
    for (let place = 128; byte > 127; place *= 128) {
      byte = bytes[at++];
      number += (byte & 127) * place;
    }
    value += number % 2 ? -(number + 1) / 2 : number / 2;
    column[events[k]] = value;
  }
  return at;
}
