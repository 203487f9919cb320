// SPDX-License-Identifier: GPL-3.0-or-later
// What an experiment varies: a parameter of the scene, the size of the picture, or
// the depth complexity.
import { layers } from "../scene/layers.js";
import { ladder, nameOf, parametersOf, withValues } from "../scene/params.js";

export const VARIED = { scene: "the faces of the scene", size: "the picture",
  depth: "the depth complexity" };
const M = 320, N = 240; // of pictures that are not varied

// { label, of: what, least, most, values, at(value): { subject, view, m, n } }; null:
// the scene has no parameter.
export function varied(by, state, core, source) {
  return { size: () => bySize(state, source), depth: byDepth,
    scene: () => byFaces(state, core) }[by]();
}

const bySize = (state, source) => ({ label: "columns of the picture", of: state.scene,
  least: 16, most: 1024, values: ladder({ least: 16, most: 1024 }, 13),
  at: async (m) => ({ subject: (await source.current()).subject, m,
    n: Math.round(m * 3 / 4), ...state.camera ? { camera: state.camera }
      : { view: state.view } }) });

const byDepth = () => ({ label: "walls, one behind another", of: "walls of squares",
  least: 1, most: 64, values: ladder({ least: 1, most: 64 }), at: async (depth) =>
    ({ subject: layers(depth), m: M, n: N, view: 0 }) });

function byFaces(state, core) {
  const builtin = state.own ? null
    : core.builtins.find((b) => b.name === nameOf(state.scene));
  const [first, ...rest] = builtin ? parametersOf(builtin.usage, state.scene) : [];
  if (!first) return null;
  const named = (value) => withValues(builtin.usage, [value,
    ...rest.map((p) => p.value)]);
  return { label: `${first.word} of ${builtin.name}`, of: named(first.word),
    least: Math.max(1, first.least), most: first.most, values: ladder(first),
    at: async (value) => ({ m: M, n: N, view: state.camera ? 0 : state.view,
      subject: { key: named(value), open: (client) =>
        client.open({ name: named(value) }) } }) };
}
