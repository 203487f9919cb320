// SPDX-License-Identifier: GPL-3.0-or-later
// What the reader has chosen, and who wants to know when it changes.
import { playerState } from "../../lesson/parts/player.js";

export const MODES = { look: "Look", step: "Step", measure: "Measure",
  decide: "You decide" };
export const MOST = 3; // algorithms side by side

export const standard = () => ({
  scene: "house", // a built-in scene with its parameters, or the name of `own`
  own: null, // a file of the reader: { name, bytes }
  note: "", // to whoever opens the link
  edits: [], // as of scene/edits.js
  view: 0, camera: null, // null: the scene's own camera, number `view`
  a: ["watkins", "zbuffer"], // with options
  size: null, // of the picture, [m, n]; null: as large as there is room
  mode: "look",
  tool: "turn", // what dragging the picture does: of TOOLS
  whole: true, // whether a click chooses a solid or a face
  chosen: null, // the target of edits
  overlay: "", // "": nothing, "work" or "differ"
  blink: false,
  held: new Map(), // counts by the names of algorithms, to see how others compare
  holds: false, // whether the first counts of each algorithm are held
  play: playerState(),
  steps: "96x72", // size of the picture that is stepped through
  window: null, // of that, [x0, y0, x1, y1]
  measure: { by: "scene", what: "compare", values: [] },
  decide: { task: "seen", seed: 1 },
});

export function makeLab() {
  const state = standard(), listeners = [];
  const tell = (names) => {
    for (const [wanted, does] of listeners)
      if (names.some((name) => wanted.includes(name))) does(names);
  };
  return {
    state,
    // does(names): called when one of these has changed, or is told to have.
    when: (names, does) => listeners.push([names.split(" "), does]),
    set: (changes) => {
      Object.assign(state, changes);
      tell(Object.keys(changes));
    },
    tell: (name) => tell([name]),
  };
}
