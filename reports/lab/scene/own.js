// SPDX-License-Identifier: GPL-3.0-or-later
// The reader's own file.

export const KINDS_OF_FILES = ".obj,.glb,.gltf,.stl,.ply,.off,.json";
const LARGEST = 64 << 20; // bytes
let opened = 0;

export async function ownScene(file) {
  if (file.size > LARGEST)
    throw new Error(`${file.name} has more than ${LARGEST >> 20} MB: too much here`);
  return { name: file.name, bytes: new Uint8Array(await file.arrayBuffer()),
    number: ++opened };
}

export const ownOf = (name, bytes) => ({ name, bytes, number: ++opened });
