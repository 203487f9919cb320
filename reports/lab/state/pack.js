// SPDX-License-Identifier: GPL-3.0-or-later
// Bytes as short text that an address can hold, and back.

const through = (bytes, stream) => new Blob([bytes]).stream().pipeThrough(stream);
const wholeOf = async (stream) =>
  new Uint8Array(await new Response(stream).arrayBuffer());

// The stream of what is unpacked, and all of it.
export const inflating = (bytes, format = "deflate-raw") =>
  through(bytes, new DecompressionStream(format));
export const inflate = (bytes) => wholeOf(inflating(bytes));

export async function pack(bytes) {
  const small = await wholeOf(through(bytes, new CompressionStream("deflate-raw")));
  let text = "";
  for (const byte of small) text += String.fromCharCode(byte);
  return btoa(text).replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
}

export function bytesOf(base64) {
  const plain = base64.replace(/-/g, "+").replace(/_/g, "/");
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(plain); // much faster
  const text = atob(plain);
  const bytes = new Uint8Array(text.length);
  for (let k = 0; k < bytes.length; k++) bytes[k] = text.charCodeAt(k);
  return bytes;
}

const unpack = (text) => inflate(bytesOf(text));

export const packed = (value) =>
  pack(new TextEncoder().encode(JSON.stringify(value)));
export const unpacked = async (text) =>
  JSON.parse(new TextDecoder().decode(await unpack(text)));
