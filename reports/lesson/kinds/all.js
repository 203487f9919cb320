// SPDX-License-Identifier: GPL-3.0-or-later
// The kinds of answers that the page can show, a file each. A kind is an object:
//
// name         as the trace has it
// progress     what is counted when it is said how far a picture is
// painting(run)
//              what is drawn after k steps: { at(k): that, decided(k): how much of
//              it, 0 to 1, final(): the answer of the trace in the same form,
//              equal(): whether all events make that }
// draw(easel, drawn, k)
//              draws what at(k) gives; of the easel see parts/picture.js
//
// and, where it has them:
//
// hint         what a click on the picture does, in words
// story(run, { i, j })
//              what the steps were that led to that sample; otherwise as in
//              data/story.js
// verb         what becomes of the subject of an accepted event
// doneWith(part)   what becomes of a part, in words; null: the verb tells it
// partWords(part)
//              what follows of the part of an accepted event
// partLine(part)
//              the line of a part, { points, dashed }, or null; what is accepted
//              is then marked in the picture
// strip(run)   what stands below the picture: { element, show(k, event) }
// windows      what the smallest windows of steps are: "samples"; "pixels", which have
//              many samples or none
// holdsFaces   the answer is the visible face of each sample
// hasShapes    a part is a shape: [face, cycles of sides]
// cornersOfCell(run, [level, number])
//              a cell of the algorithm that makes it: the images of its corners, some
//              undefined
// cellWords([level, x, y])
//              such a cell in words
import { area } from "./area.js";
import { composited } from "./composited.js";
import { filtered } from "./filtered.js";
import { ids } from "./ids.js";
import { polygons } from "./polygons.js";
import { segments } from "./segments.js";
import { shadowed } from "./shadowed.js";
import { transparent } from "./transparent.js";
import { voxels } from "./voxels.js";

const all = [ids, segments, filtered, composited, area, transparent, shadowed,
  polygons, voxels];

export function kindNamed(name) {
  const kind = all.find((k) => k.name === name);
  if (!kind) throw new Error(`it knows no answers of the kind “${name}”`);
  return kind;
}
