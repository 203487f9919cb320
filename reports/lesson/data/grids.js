// SPDX-License-Identifier: GPL-3.0-or-later
// Orders of the cells of a grid: the rows, the slices and the octants that they are
// visited in. All is read from the trace and from where the cells are.

const isRow = ({ counter: { key } }) => key === "row-of-cells";
const isOrder = (run) => run.trace.structure.isGrid && run.counterOf("row-of-cells") >= 0;

const placeOf = (run, cell) => run.trace.structure.places?.[cell] ?? null;

// The part of the order that a row is in, its cells from low to high: what the
// algorithm goes by, an octant, a child of the octree's root, or a slice. null: the step
// begins no row.
export function partOfRow(run, e) {
  const place = isOrder(run) && isRow(e) ? placeOf(run, e.a.ids[0]) : null;
  if (!place) return null;
  const { bounds, eyeCell, gridParts } = run.trace.structure;
  const ends = bounds.map((along) => along.length - 2);
  if (gridParts === "octants") return eighth(place, eyeCell, ends);
  if (gridParts === "children") return eighth(place, ends.map(() => middleOf(ends)), ends);
  const axis = gridParts === "slices" || gridParts === "turns" ? outermost(run) : -1;
  return axis < 0 ? null : { name: String(place[axis]), at: place[axis], axis,
    low: place.map((x, k) => k === axis ? x : 0),
    high: place.map((x, k) => k === axis ? x : ends[k]) };
}

// One of the eight parts of a grid that is divided along each axis after that cell.
function eighth(place, last, ends) {
  const isHigh = place.map((x, k) => x > last[k]);
  return { name: isHigh.map((is) => is ? "high" : "low").join(" "),
    low: isHigh.map((is, k) => is ? last[k] + 1 : 0),
    high: isHigh.map((is, k) => is ? ends[k] : Math.min(last[k], ends[k])) };
}

// The last cell of the lower half of the octree's root, which is a cube of the least power
// of two that holds all cells.
function middleOf(ends) {
  let size = 1;
  while (size <= Math.max(...ends)) size *= 2;
  return size / 2 - 1;
}

// The axis along which the cells of the first of each row change least often.
function outermost(run) {
  if (run.outermostAxis !== undefined) return run.outermostAxis;
  const changes = [0, 0, 0];
  let last = null;
  eachRow(run, (k) => {
    const place = placeOf(run, run.trace.a0[k]);
    if (last) place.forEach((x, axis) => { changes[axis] += x !== last[axis] ? 1 : 0; });
    last = place;
  });
  const most = [0, 1, 2].filter((axis) => changes[axis]);
  return run.outermostAxis = most.sort((p, q) => changes[p] - changes[q])[0] ?? -1;
}

function eachRow({ trace, counterOf }, visit) {
  const rows = counterOf("row-of-cells");
  for (let k = 0; k < trace.kept; k++) if (trace.counter[k] === rows) visit(k);
}

// Whether the row is the first of another part than the row before it.
export const beginsPart = (run, e) => isOrder(run) && beginnings(run).has(e.k);

// Whether the row is in the only part that there is.
export const isOnlyPart = (run, e) => partOfRow(run, e) !== null &&
  !beginnings(run).size;

// The rows with which parts begin but the first one, and the part before each.
function beginnings(run) {
  if (run.partBeginnings) return run.partBeginnings;
  run.partBeginnings = new Map();
  let last = null;
  eachRow(run, (k) => {
    const part = partOfRow(run, run.event(k));
    if (part && last && part.name !== last.name) run.partBeginnings.set(k, last);
    last = part ?? last;
  });
  return run.partBeginnings;
}

// Where both sides of the eye take turns, the row before this one, if it is on the other
// side along an axis; else null.
export function rowAcross(run, e) {
  if (!isOrder(run) || !isRow(e) || run.trace.structure.gridParts !== "turns") return null;
  const before = rowsBefore(run).get(e.k), eye = run.trace.structure.eyeCell;
  if (before === undefined) return null;
  const [last, now] = [before, e.k].map((k) => placeOf(run, run.trace.a0[k]));
  return now.filter((x, k) => x > eye[k] !== last[k] > eye[k]).length === 1
    ? run.event(before) : null;
}

// The row before each row.
function rowsBefore(run) {
  if (run.rowBefore) return run.rowBefore;
  run.rowBefore = new Map();
  let last;
  eachRow(run, (k) => {
    if (last !== undefined) run.rowBefore.set(k, last);
    last = k;
  });
  return run.rowBefore;
}

// The cells of a row, up to the last one that is drawn: low and high.
export function cellsOfRow(run, e) {
  if (!isOrder(run) || !isRow(e)) return null;
  const { trace, header } = run;
  const first = placeOf(run, e.a.ids[0]);
  const box = first && { low: [...first], high: [...first] };
  for (let k = e.k + 1; box && k < trace.kept; k++) {
    const { key, a } = header.counters[trace.counter[k]];
    if (key === "row-of-cells") break;
    const place = a === "cell" ? placeOf(run, trace.a0[k]) : null;
    place?.forEach((x, axis) => {
      box.low[axis] = Math.min(box.low[axis], x);
      box.high[axis] = Math.max(box.high[axis], x);
    });
  }
  return box;
}

// The corners of a box of cells in the world: corner c is high along axis k if bit k of
// c is set.
export const cornersOf = ({ trace: { structure: { bounds } } }, { low, high }) =>
  Array.from({ length: 8 }, (_, c) => [0, 1, 2].map((k) =>
    c >> k & 1 ? bounds[k][high[k] + 1] : bounds[k][low[k]]));
