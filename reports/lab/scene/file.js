// SPDX-License-Identifier: GPL-3.0-or-later
// An edited scene as a file that hsr opens, here and everywhere: hsr-scene/1.
import { orderOf } from "./mesh.js";

// views: the cameras that it has.
export function sceneFile(mesh, name, views) {
  const order = orderOf(mesh);
  const objects = [];
  let place = null, last = -1;
  for (const f of order) {
    const { ring, rgb, opacity = 1, solid } = mesh.faces[f];
    const sides = mesh.sides[solid];
    if (solid !== last) {
      last = solid;
      place = new Map();
      objects.push({ name: mesh.solids[solid], vertices: [], faces: [],
        face_colours: [], ...(sides ? { one_sided: sides === 1 } : {}) });
    }
    const own = objects.at(-1);
    own.faces.push(ring.map((p) => {
      if (!place.has(p)) place.set(p, own.vertices.push(mesh.points[p]) - 1);
      return place.get(p);
    }));
    own.face_colours.push(opacity < 1 ? [...rgb, opacity] : rgb);
  }
  return JSON.stringify({ schema: "hsr-scene/1", name, objects,
    views: views.map(viewOf) });
}

const viewOf = ({ eye, at, up, fov, near, parallel, light }) =>
  ({ eye: [...eye], at: [...at], up: [...up], near, ...(parallel > 0 ? { parallel }
    : { fov }), ...lightOf(light ?? [0, 0, 0, 0]) });

// A light at a point, a sun in a direction, or, of noughts, the standard one.
const lightOf = ([x, y, z, w]) => w > 0 ? { light: [x, y, z] }
  : x || y || z ? { sun: [x, y, z] } : {};
