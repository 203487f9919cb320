// SPDX-License-Identifier: GPL-3.0-or-later
// What an experiment varies: a parameter of the scene, the size of the picture, or
// the depth complexity.
import { layers } from "../scene/layers.js";
import { ladder, nameOf, parametersOf, withValues } from "../scene/params.js";

export const VARIED = { scene: "the faces of the scene", size: "the picture",
  depth: "the depth complexity" };
export const M = 320, N = 240; // of pictures that are not varied

// { label, of: what, least, most, values, at(value): { subject, view, m, n } }, or
// null.
export function varied(by, state, core, source) {
  const view = state.camera ? { camera: state.camera } : { view: state.view };
  if (by === "size") return { label: "columns of the picture →", of: state.scene, most: 1024, least: 16,
    values: ladder({ least: 16, most: 1024 }, 13), at: async (m) =>
      ({ subject: (await source.current()).subject, m, n: Math.round(m * 3 / 4),
        ...view }) };
  if (by === "depth") return { label: "walls, one behind another →", of: "walls of squares", least: 1, most: 64,
    values: ladder({ least: 1, most: 64 }, 12), at: async (depth) =>
      ({ subject: layers(depth), m: M, n: N, view: 0 }) };
  const builtin = state.own ? null
    : core.builtins.find((b) => b.name === nameOf(state.scene));
  const [first, ...rest] = builtin ? parametersOf(builtin.usage, state.scene) : [];
  if (!first) return null;
  return { label: `${first.word} of ${builtin.name} →`, of: state.scene, least: Math.max(1, first.least),
    most: first.most, values: ladder(first, 12), at: async (value) => {
      const name = withValues(builtin.usage, [value, ...rest.map((p) => p.value)]);
      return { subject: { key: name, open: (client) => client.open({ name }) }, m: M,
        n: N, view: state.camera ? 0 : state.view };
    } };
}
