// SPDX-License-Identifier: GPL-3.0-or-later
// The scene as it is now: what the core opens, and its faces as they can be edited.
import { edited } from "./edits.js";
import { sceneFile } from "./file.js";
import { meshOf, orderOf } from "./mesh.js";
import { whole } from "../../page/data/format.js";

const LARGEST = 100000; // faces of a scene that is edited

// ask(subject, does): asks a worker for what is in a scene.
export function makeSource(state, ask) {
  let base = null, now = null;

  const baseSubject = () => {
    const { own, scene } = state;
    return own && own.name === scene
      ? { key: `own ${own.name} ${own.number}`, open: (client) =>
        client.open({ name: own.name, bytes: own.bytes }) }
      : { key: scene, open: (client) => client.open({ name: scene }) };
  };

  // The scene without edits: { key, subject, info, views, mesh: a promise }.
  function baseNow() {
    const subject = baseSubject();
    if (base?.key === subject.key) return base;
    const info = ask(subject, (client, id, found) => found);
    const faces = async () => {
      const { nFaces } = await info;
      if (nFaces > LARGEST)
        throw new Error(`More than ${whole(LARGEST)} faces are not edited here`);
      return meshOf(await ask(subject, (client, id) => client.geometry(id)));
    };
    let mesh = null; // asked for when somebody wants it
    base = { key: subject.key, subject, info, mesh: () => mesh ??= faces() };
    return base;
  }

  // { key, subject, mesh(), order() }, of which the edits are part.
  async function current() {
    const own = baseNow(), { edits } = state;
    if (now?.base === own && now.edits === edits) return now.made;
    const made = edits.length ? await withEdits(own, edits)
      : { key: own.key, subject: own.subject, info: own.info, mesh: own.mesh };
    now = { base: own, edits, made };
    return made;
  }

  async function withEdits(own, edits) {
    const { views } = await own.info;
    const mesh = edited(await own.mesh(), edits);
    const name = state.scene.replace(/[^\w.-]+/g, "-");
    const text = sceneFile(mesh, name, views);
    const key = `${own.key} ${JSON.stringify(edits)}`;
    return { key, info: own.info, mesh: async () => mesh, text,
      subject: { key, open: (client) => client.open({ name: `${name}.scene.json`,
        bytes: new TextEncoder().encode(text) }) } };
  }

  return { base: baseNow, current,
    // The numbers that faces have in the mesh, by their ids in the picture.
    order: async () => orderOf(await (await current()).mesh()) };
}
