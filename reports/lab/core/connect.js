// SPDX-License-Identifier: GPL-3.0-or-later
// The core, which lies in this page: packed WebAssembly, and the worker's script.
import { connect } from "../../../bench/web/client.js";
import { bytesOf, inflating } from "../state/pack.js";
import { seat } from "./seats.js";

// A packed file of this page, while it is unpacked.
const unpacking = (name, type) => new Response(
  inflating(bytesOf(document.getElementById(name).textContent), "gzip"),
  { headers: { "content-type": type } });

// The core is compiled while it is unpacked, and its worker starts meanwhile.
const packedCore = () => ({
  module: WebAssembly.compileStreaming(unpacking("core-wasm", "application/wasm")),
  worker: unpacking("core-script", "text/javascript").blob().then(URL.createObjectURL) });

// { algorithms, builtins, kinds, version, seats: one for each picture, judge }. The
// first seat is made ready; makeReady does so with the first n.
export async function openCore() {
  const parts = packedCore();
  const client = () => connect(parts);
  const seats = [0, 1, 2].map(() => seat(client));
  const [version, algorithms, builtins, kinds] = await seats[0].lists((c) =>
    Promise.all([c.version, c.algorithms(), c.builtins(), c.kinds()]));
  return { version, algorithms, builtins, kinds, seats, judge: seat(client),
    makeReady: (n) => seats.slice(1, n).forEach((s) =>
      s.lists((c) => c.version).catch(() => {})) };
}
