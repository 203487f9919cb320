// SPDX-License-Identifier: GPL-3.0-or-later
// A scene of which the depth complexity is chosen: walls of squares, one behind
// another.

const COLUMNS = 8, ROWS = 6;

function layersFile(depth) {
  const vertices = [], faces = [], colours = [];
  for (let d = 0; d < depth; d++)
    for (let j = 0; j < ROWS; j++)
      for (let i = 0; i < COLUMNS; i++) {
        const first = vertices.length, z = -d;
        vertices.push([i - 4, j - 3, z], [i - 3, j - 3, z], [i - 3, j - 2, z],
          [i - 4, j - 2, z]);
        faces.push([first, first + 1, first + 2, first + 3]);
        const tone = 0.15 + 0.7 * ((i * 7 + j * 5 + d * 3) % 11) / 11;
        colours.push([tone, 0.6 - 0.4 * d / Math.max(1, depth), 1 - tone]);
      }
  return JSON.stringify({ schema: "hsr-scene/1", name: `layers-${depth}`,
    objects: [{ name: "layers", vertices, faces, face_colours: colours,
      one_sided: false }],
    views: [{ eye: [0.3, 0.2, 10], at: [0.3, 0.2, 0], up: [0, 1, 0], parallel: 5 }] });
}

export const layers = (depth) => ({ key: `layers ${depth}`, open: (client) =>
  client.open({ name: `layers-${depth}.scene.json`,
    bytes: new TextEncoder().encode(layersFile(depth)) }) });
