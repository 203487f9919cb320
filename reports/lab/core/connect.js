// SPDX-License-Identifier: GPL-3.0-or-later
// The core, which lies in this page: packed WebAssembly, and the worker's script.
import { connect } from "hsr-client";
import { bytesOf, inflate } from "../state/pack.js";
import { seat } from "./seats.js";

const textOf = (id) => document.getElementById(id).textContent.trim();

async function packedCore() {
  const wasm = await inflate(bytesOf(textOf("core-wasm")), "gzip");
  const script = await inflate(bytesOf(textOf("core-script")), "gzip");
  return { module: await WebAssembly.compile(wasm), worker: URL.createObjectURL(
    new Blob([script], { type: "text/javascript" })) };
}

// { algorithms, builtins, kinds, version, seats: one for each picture, judge }. The
// first n seats are made ready at once.
export async function openCore(n) {
  const parts = packedCore();
  const client = () => connect(parts);
  const seats = [0, 1, 2].map(() => seat(client));
  seats.slice(1, n).forEach((s) => s.lists((c) => c.version).catch(() => {}));
  const [version, algorithms, builtins, kinds] = await seats[0].lists((c) =>
    Promise.all([c.version, c.algorithms(), c.builtins(), c.kinds()]));
  return { version, algorithms, builtins, kinds, seats, judge: seat(client) };
}
