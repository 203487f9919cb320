// SPDX-License-Identifier: GPL-3.0-or-later
// What the reader's hand does on a picture: it turns the camera, or chooses, moves
// and turns faces and solids, or draws a polygon.
import { boundsOf, facesOf, pointsOf } from "../scene/mesh.js";
import { pick } from "../scene/pick.js";
import { axes, minus, nearer, rayThrough, shifted, turned } from "../views/camera.js";
import { pointers } from "../views/turning.js";
import { acrossView, boxEdit, colourOf, cornerAt, gridOf, moveEdit, triangleEdit,
  turnEdit } from "./edits_by_hand.js";

export const TOOLS = { turn: "Turn the camera", move: "Move what is chosen",
  rotate: "Turn what is chosen", polygon: "Draw a polygon" };
const MANY = 400; // faces that are outlined

// view: { now() -> { camera, size: [m, n] } of the pictures; moving(is): they may be
// smaller while something moves; repaint(): what lies over them }
export function hand(lab, source, history, view) {
  const { state } = lab;
  let mesh = null, drag = null, corners = [];
  let before = []; // the edits before a drag

  const lookAgain = async () => {
    const wanted = state.edits;
    const found = await (await source.current()).mesh().catch(() => null);
    if (wanted !== state.edits) return;
    mesh = found;
    view.repaint();
  };

  // --- Choosing ---

  const chosenFaces = () => mesh && state.chosen ? facesOf(mesh, state.chosen) : [];
  const isChosen = () => chosenFaces().length > 0;

  function targetAt({ x, y }) {
    const { camera, size: [m, n] } = view.now();
    const hit = mesh && camera && pick(mesh, rayThrough(camera, x * m, y * n, m, n));
    return hit && { ...hit, target: state.whole ? `o${mesh.faces[hit.face].solid}`
      : `f${hit.face}` };
  }

  // --- Dragging ---

  function grab(point) {
    const hit = targetAt(point);
    if (hit && !chosenFaces().includes(hit.face)) lab.set({ chosen: hit.target });
    if (!isChosen()) return null;
    return { at: hit?.point ?? boundsOf(pointsOf(mesh, chosenFaces())).middle,
      x: 0, y: 0 };
  }

  function dragThing(dx, dy, isDeep) {
    drag.x += dx;
    drag.y += dy;
    const given = { ...drag, camera: view.now().camera, isDeep,
      snap: gridOf(mesh).snap };
    lab.set({ edits: [...before, state.tool === "move"
      ? moveEdit(state.chosen, given) : turnEdit(state.chosen, given)] });
  }

  const dragCamera = (dx, dy, isShift) => lab.set({ camera: isShift
    ? shifted(view.now().camera, -dx, dy)
    : turned(view.now().camera, -dx * Math.PI, dy * Math.PI) });

  const act = {
    press: (point, e) => {
      before = state.edits;
      drag = e.button !== 2 && mesh && /move|rotate/.test(state.tool) ? grab(point)
        : null;
    },
    drag: (dx, dy, e) => {
      if (!view.now().camera) return;
      view.moving(true);
      if (drag) dragThing(dx, dy, e.shiftKey);
      else dragCamera(dx, dy, e.shiftKey || e.buttons === 2);
    },
    drop: () => {
      if (drag && state.edits !== before) history.done();
      drag = null;
      view.moving(false);
    },
    click: (point) => {
      if (state.tool === "polygon") addCorner(point);
      else lab.set({ chosen: targetAt(point)?.target ?? null });
    },
    zoom: (factor) => {
      if (!view.now().camera) return;
      view.moving(true);
      lab.set({ camera: nearer(view.now().camera, factor) });
    },
    shift: (dx, dy) => view.now().camera && dragCamera(dx, dy, true),
  };

  // --- Drawing a polygon ---

  function addCorner(point) {
    if (!mesh || !view.now().camera) return;
    const { snap, bounds } = gridOf(mesh), k = acrossView(view.now().camera);
    const corner = cornerAt(point, view.now(), k,
      corners[0]?.[k] ?? snap(bounds.middle[k]), snap);
    if (!corner) return;
    const isFirst = corners.length > 2 &&
      Math.hypot(...minus(corner, corners[0])) < bounds.size / 50;
    if (isFirst) return closePolygon();
    if (!corners.some((c) => String(c) === String(corner))) corners.push(corner);
    view.repaint();
  }

  function closePolygon() {
    if (corners.length > 2) history.add(["polygon", colourOf(state.edits.length),
      ...corners.flat()]);
    lab.set({ tool: "turn" });
  }

  // --- Adding ---

  function added(edit) {
    const solid = mesh.solids.length;
    history.add(edit);
    lab.set({ tool: "move", whole: true, chosen: `o${solid}` });
  }
  const addBox = () => mesh && added(boxEdit(gridOf(mesh),
    colourOf(state.edits.length)));
  const addTriangle = () => mesh && added(triangleEdit(gridOf(mesh),
    acrossView(view.now().camera), colourOf(state.edits.length)));

  // By keys: steps to the right, upwards and away.
  function nudge(x, y, z) {
    if (!isChosen()) return;
    const { step, snap } = gridOf(mesh), a = axes(view.now().camera);
    history.add(["move", state.chosen, ...[0, 1, 2].map((k) => snap(8 * step *
      (x * a.right[k] + y * a.above[k] + z * a.forward[k])))]);
  }

  function layers() {
    const outlines = chosenFaces().slice(0, MANY).map((f) => ({ colour: "--link",
      points: mesh.faces[f].ring.map((p) => mesh.points[p]) }));
    if (corners.length) outlines.push({ points: corners, colour: "--bad",
      open: corners.length < 3 });
    return { outlines };
  }

  lab.when("scene own edits", lookAgain);
  lab.when("tool scene own", () => { corners = []; view.repaint(); });
  return {
    attach: (canvas) => pointers(canvas, act), lookAgain, layers, isChosen, nudge,
    addBox, addTriangle, closePolygon,
    rotate: (t) => isChosen() && history.add(["turn", state.chosen, 0, 1, 0, t]),
    remove: () => {
      if (!isChosen()) return;
      history.add(["delete", state.chosen]);
      lab.set({ chosen: null });
    },
    words: () => !isChosen() ? "" : state.chosen[0] === "f"
      ? `face ${state.chosen.slice(1)}` : mesh.solids[Number(state.chosen.slice(1))],
  };
}
