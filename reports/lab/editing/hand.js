// SPDX-License-Identifier: GPL-3.0-or-later
// What the reader's hand does on a picture: it turns the camera, or chooses, moves
// and turns faces and solids, or draws a polygon.
import { h } from "../../page/parts/dom.js";
import { boundsOf, facesOf, pointsOf } from "../scene/mesh.js";
import { pick } from "../scene/pick.js";
import { axes, dot, minus, nearer, plus, rayThrough, shifted, short, turned, unitAt }
  from "../views/camera.js";
import { pointers } from "../views/turning.js";

export const TOOLS = { turn: "Turn the camera", move: "Move what is chosen",
  rotate: "Turn what is chosen", polygon: "Draw a polygon" };
const COLOURS = ["#c8553d", "#3d7dc8", "#4a9d5b", "#c8a23d", "#8a5bb5"];

// view(): { camera, size: [m, n] } of the pictures; moving(is): pictures may be
// smaller while something moves; repaint(): of what lies over them.
export function hand(lab, source, history, view) {
  const { state } = lab;
  let mesh = null, base = [], drag = null, corners = [];

  const lookAgain = async () => {
    const wanted = state.edits;
    const found = await (await source.current()).mesh().catch(() => null);
    if (wanted !== state.edits) return;
    mesh = found;
    view.repaint();
  };

  // --- The grid on which things are put, so that numbers stay short ---

  const bounds = () => boundsOf(mesh.points);
  const grid = () => 2 ** Math.floor(Math.log2((bounds().size || 1) / 512));
  const snap = (x) => Math.round(x / grid()) * grid();

  // --- Choosing ---

  function targetAt({ x, y }) {
    const { camera, size: [m, n] } = view.now();
    const hit = mesh && camera && pick(mesh, rayThrough(camera, x * m, y * n, m, n));
    return hit && { ...hit, target: state.whole ? `o${mesh.faces[hit.face].solid}`
      : `f${hit.face}` };
  }
  const isChosen = () => mesh && state.chosen && facesOf(mesh, state.chosen).length > 0;

  // --- Dragging ---

  const turnBy = (dx, dy) => lab.set({ camera:
    turned(view.now().camera, -dx * Math.PI, dy * Math.PI) });
  const shiftBy = (dx, dy) => lab.set({ camera:
    shifted(view.now().camera, -dx, dy) });

  function grab(point) {
    const hit = targetAt(point);
    if (hit && hit.target !== state.chosen && !isWithin(hit)) lab.set({ chosen: hit.target });
    if (!hit && !isChosen()) return null;
    const own = boundsOf(pointsOf(mesh, facesOf(mesh, state.chosen)));
    return { at: hit?.point ?? own.middle, x: 0, y: 0 };
  }
  const isWithin = ({ face }) => isChosen() &&
    facesOf(mesh, state.chosen).includes(face);

  // Along the picture; with Shift along the view.
  function moveEdit(e) {
    const { camera } = view.now();
    const { forward, right, above } = axes(camera);
    const size = unitAt(camera, dot(minus(drag.at, camera.eye), forward), 1);
    const d = e.shiftKey ? forward.map((x) => -x * drag.y * size)
      : plus(right.map((x) => x * drag.x * size), above, -drag.y * size);
    return ["move", state.chosen, ...d.map(snap)];
  }

  // About the axis of the world that is most upright, or most to the right.
  function turnEdit() {
    const { right, above } = axes(view.now().camera);
    const sideways = Math.abs(drag.x) >= Math.abs(drag.y);
    const axis = sideways ? above : right;
    const most = axis.map(Math.abs), k = most.indexOf(Math.max(...most));
    const u = [0, 0, 0].map((_, c) => c === k ? Math.sign(axis[k]) : 0);
    const angle = (sideways ? drag.x : drag.y) * Math.PI;
    const whole = Math.round(angle / (Math.PI / 36)) * (Math.PI / 36); // by 5 degrees
    return ["turn", state.chosen, ...u, short(Math.tan(whole / 2))];
  }

  const act = {
    press: (point, e) => {
      const asksCamera = e.button === 2 || state.tool === "turn" ||
        state.tool === "polygon" || !mesh;
      base = state.edits;
      drag = asksCamera ? null : grab(point);
    },
    drag: (dx, dy, e) => {
      view.moving(true);
      if (!view.now().camera) return;
      if (!drag) return e.shiftKey || e.buttons === 2 ? shiftBy(dx, dy) : turnBy(dx, dy);
      drag.x += dx;
      drag.y += dy;
      const edit = state.tool === "move" ? moveEdit(e) : turnEdit();
      lab.set({ edits: [...base, edit] });
    },
    drop: () => {
      if (drag && state.edits !== base) history.done(base);
      drag = null;
      view.moving(false);
    },
    click: (point) => {
      if (state.tool === "polygon") return addCorner(point);
      lab.set({ chosen: targetAt(point)?.target ?? null });
    },
    zoom: (factor) => {
      if (!view.now().camera) return;
      view.moving(true);
      lab.set({ camera: nearer(view.now().camera, factor) });
    },
    shift: shiftBy,
  };

  // --- Drawing a polygon: in the plane x, y or z = const. that faces the eye ---

  function plane() {
    const { camera } = view.now();
    const { forward } = axes(camera);
    const most = forward.map(Math.abs), k = most.indexOf(Math.max(...most));
    return { k, at: snap(corners[0]?.[k] ?? bounds().middle[k]) };
  }

  function addCorner({ x, y }) {
    const { camera, size: [m, n] } = view.now();
    const { from, along } = rayThrough(camera, x * m, y * n, m, n);
    const { k, at } = plane();
    const t = (at - from[k]) / along[k];
    if (!(t > 0)) return;
    const corner = plus(from, along, t).map(snap);
    corner[k] = at;
    const [first] = corners;
    const near = first && Math.hypot(...minus(corner, first)) < bounds().size / 50;
    if (near && corners.length > 2) return closePolygon();
    if (!corners.some((c) => c.every((z, a) => z === corner[a]))) corners.push(corner);
    view.repaint();
  }

  function closePolygon() {
    if (corners.length > 2) history.add(["polygon", colour(), ...corners.flat()]);
    corners = [];
    lab.set({ tool: "turn" });
    view.repaint();
  }

  // --- Adding ---

  const colour = () => COLOURS[state.edits.length % COLOURS.length];

  function addBox() {
    const { middle, size } = bounds();
    const side = Math.max(grid(), snap(size / 8));
    added(["box", ...middle.map(snap), side, side, side, colour()]);
  }
  function addTriangle() {
    const { middle, size } = bounds();
    const { k } = plane(), at = middle.map(snap), r = Math.max(grid(), snap(size / 6));
    const [u, v] = [(k + 1) % 3, (k + 2) % 3];
    const corners3 = [[-r, -r], [r, -r], [0, r]].map(([a, b]) => {
      const p = at.slice();
      p[u] += a;
      p[v] += b;
      return p;
    });
    added(["polygon", colour(), ...corners3.flat()]);
  }
  function added(edit) {
    const solid = mesh.solids.length;
    history.add(edit);
    lab.set({ tool: "move", whole: true, chosen: `o${solid}` });
  }

  // By keys: steps to the right, upwards and away.
  function nudge(right, up, away) {
    if (!isChosen()) return;
    const { camera } = view.now();
    const a = axes(camera), step = 8 * grid();
    const d = [0, 1, 2].map((k) => step * (right * a.right[k] + up * a.above[k] +
      away * a.forward[k]));
    history.add(["move", state.chosen, ...d.map(snap)]);
  }

  lab.when("scene own edits", lookAgain);
  lab.when("tool", () => { corners = []; view.repaint(); });
  return {
    attach: (canvas) => pointers(canvas, act), lookAgain, addBox, addTriangle,
    closePolygon, nudge, mesh: () => mesh, isChosen,
    rotate: (t) => isChosen() && history.add(["turn", state.chosen, 0, 1, 0, t]),
    remove: () => {
      if (!isChosen()) return;
      history.add(["delete", state.chosen]);
      lab.set({ chosen: null });
    },
    layers: () => ({ outlines: [
      ...(isChosen() ? facesOf(mesh, state.chosen).slice(0, 400).map((f) => ({
        points: mesh.faces[f].ring.map((p) => mesh.points[p]), colour: "--link" }))
        : []),
      ...(corners.length ? [{ points: corners, colour: "--bad",
        open: corners.length < 3 }] : [])] }),
    words: () => !isChosen() ? "" : state.chosen[0] === "f"
      ? `face ${state.chosen.slice(1)}` : mesh.solids[Number(state.chosen.slice(1))],
  };
}

export const choice = (name, all, now, onchange, label) => h("label", {}, label,
  h("select", { name, onchange: (e) => onchange(e.target.value) },
    Object.entries(all).map(([value, text]) => h("option",
      { value, selected: value === now }, text))));
