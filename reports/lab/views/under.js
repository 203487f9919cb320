// SPDX-License-Identifier: GPL-3.0-or-later
// What lies under the pointer: the visible face; and after a click all faces over the
// sample, the nearest first, as exact numbers have them.
import { digits } from "../../page/data/format.js";
import { h } from "../../page/parts/dom.js";
import { orderOf } from "../scene/mesh.js";

const NONE = 0xffffffff, SHOWN = 6;

// answer(): what the canvas shows; asked(): { algorithm, m, n, camera or view } of it.
export function under(canvas, source, judge, answer, asked) {
  const element = h("p", { class: "under", hidden: true });
  let name = null, key = null; // of the faces of the scene with that key

  async function namesNow() {
    const now = await source.current();
    if (key === now.key) return;
    key = now.key;
    name = (id) => `face ${id}`;
    const mesh = await now.mesh().catch(() => null), order = mesh && orderOf(mesh);
    if (!mesh || key !== now.key) return;
    name = (id) => {
      const solid = mesh.solids[mesh.faces[order[id]]?.solid];
      return `face ${id}${solid ? ` (${solid})` : ""}`;
    };
  }

  const say = (text) => {
    element.hidden = !text;
    element.textContent = text;
  };
  const sampleAt = ({ clientX, clientY }, { m, n }) => {
    const box = canvas.getBoundingClientRect();
    const at = (x, size) => Math.max(0, Math.min(size - 1, Math.floor(x * size)));
    return [at((clientX - box.left) / box.width, m),
      at((clientY - box.top) / box.height, n)];
  };

  canvas.addEventListener("pointermove", async (e) => {
    const shown = answer();
    if (e.buttons || !shown?.ids) return say("");
    await namesNow();
    const [i, j] = sampleAt(e, shown), id = shown.ids[j * shown.m + i];
    say(id === NONE ? "background" : name(id));
  });
  canvas.addEventListener("pointerleave", () => say(""));

  canvas.addEventListener("click", async (e) => {
    const shown = answer();
    if (!shown) return;
    const [i, j] = sampleAt(e, shown), { subject } = await source.current();
    await namesNow();
    const over = await judge.after(subject, (client, id) =>
      client.why(id, { ...asked(), m: shown.m, n: shown.n }, i, j)).catch(() => null);
    if (over?.length > 1) say(over.slice(0, SHOWN).map(({ face, depth }) =>
      `${name(face)} at depth ${digits(depth)}`).join(", before ") +
      (over.length > SHOWN ? ` and ${over.length - SHOWN} more` : ""));
  });
  return element;
}
