// SPDX-License-Identifier: GPL-3.0-or-later
// Random edits, each drawn by one algorithm and judged. Runs in the page; returns
// what is wrong.
export async function editsAreRight({ edits, seed }) {
  const { lab } = globalThis, { state, core } = lab, bad = [];
  const names = ["watkins", "bouknight", "romney", "newell", "warnock", "schumacker",
    "zbuffer", "hzbuffer", "tiling", "bsp-painter", "naylor", "appel", "roberts",
    "weiler-atherton", "yzx"];
  const scenes = ["cyclic-overlap", "house", "soup:8:1", "color-cube:2", "grid:2:1"];
  let x = (seed * 2654435761 + 99) >>> 0;
  const random = (n) => {
    x ^= x << 13; x >>>= 0;
    x ^= x >>> 17;
    x ^= x << 5; x >>>= 0;
    return x % n;
  };
  const place = () => (random(257) - 128) / 32;
  const colour = () => `#${(random(1 << 24)).toString(16).padStart(6, "0")}`;

  // Edits are of a size that the scene has.
  async function edit() {
    const mesh = await (await lab.source.current()).mesh();
    const there = mesh.faces.map((f, k) => f ? k : -1).filter((k) => k >= 0);
    const face = there[random(there.length)];
    const target = random(3) ? `f${face}` : `o${mesh.faces[face].solid}`;
    const kinds = there.length > 12 ? 6 : 5;
    switch (random(kinds)) {
      case 0: return ["move", target, place(), place(), place()];
      case 1: {
        const axis = [0, 0, 0];
        axis[random(3)] = 1;
        return ["turn", target, ...axis, (random(200) - 100) / 64];
      }
      case 2: return ["box", place(), place(), place(), (1 + random(64)) / 16,
        (1 + random(64)) / 16, (1 + random(64)) / 16, colour()];
      case 3: return ["polygon", colour(), ...triangle()];
      case 4: return ["paint", target, colour()];
      default: return ["delete", `f${face}`];
    }
  }
  function triangle() {
    const p = [place(), place(), place()];
    return [...p, p[0] + 1, p[1] + place() / 8, p[2], p[0], p[1] + 1 + random(8) / 8,
      p[2] + place()];
  }

  for (let k = 0; k < edits && bad.length < 5; k++) {
    if (k % 20 === 0) {
      lab.history.forget();
      lab.set({ scene: scenes[random(scenes.length)], edits: [], camera: null,
        view: random(2) });
    }
    const one = await edit();
    lab.history.add(one);
    if (random(8) === 0) { lab.history.undo(); lab.history.redo(); }
    const now = await lab.source.current(), algorithm = names[random(names.length)];
    const request = { algorithm, m: 32, n: 24, view: 0 };
    const said = await core.judge.must(now.subject, (client, id) =>
      client.judgeAlgorithm(id, request)).catch((error) => error);
    const refused = said instanceof Error || said.text !== undefined;
    if (refused ? said.status !== 6 && said.status !== "refused" : said.differing)
      bad.push(`${k}: ${state.scene}, ${algorithm}: ${refused
        ? `${said.status} ${said.text ?? said.message}`
        : `${said.differing} wrong, ${said.first}`}: ${JSON.stringify(state.edits)}`);
  }
  return bad;
}
