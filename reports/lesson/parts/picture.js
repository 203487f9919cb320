// SPDX-License-Identifier: GPL-3.0-or-later
// The picture of a run: what is painted so far, the images of all faces, and
// over them what the algorithm does now.
import { colourOf, kindColour, packed } from "../data/kinds.js";
import { facesOf } from "../data/run.js";

const DASH = [6, 4];

// canvas: where to draw; run. Returns { draw(k, { pixel, faces }), at(event) }.
export function picture(canvas, run) {
  const { width: m, height: n, header } = run;
  const context = canvas.getContext("2d");
  const small = new OffscreenCanvas(m, n);
  const smallContext = small.getContext("2d");
  const image = smallContext.createImageData(m, n);
  const pixels = new Uint32Array(image.data.buffer);
  const colours = Uint32Array.from(header.faces, ([, , colour]) =>
    packed(colour));
  const background = packed(header.background);
  const paths = header.faces.map(([, , , , polygon]) => pathOf(polygon));
  const every = new Path2D();
  paths.forEach((path) => every.addPath(path));
  let scale = 1;

  const fit = () => {
    const wide = Math.max(1, canvas.clientWidth);
    const dots = Math.round(wide * Math.min(3, globalThis.devicePixelRatio || 1));
    if (canvas.width !== dots) {
      canvas.width = dots;
      canvas.height = Math.round(dots * n / m);
    }
    scale = canvas.width / m;
  };
  const line = (width) => width / scale * (canvas.width / canvas.clientWidth || 1);

  // A stroke with a pale seam, which is seen on every colour.
  const stroke = (path, colour, width, dashed) => {
    context.setLineDash(dashed ? DASH.map(line) : []);
    context.strokeStyle = colourOf("--paper");
    context.lineWidth = line(width + 2.5);
    context.globalAlpha = 0.75;
    context.stroke(path);
    context.globalAlpha = 1;
    context.strokeStyle = colour;
    context.lineWidth = line(width);
    context.stroke(path);
    context.setLineDash([]);
  };

  // The picture, of a pixel for each sample k; 0: nothing.
  const put = (pixel) => {
    for (let k = 0; k < pixels.length; k++) pixels[k] = pixel(k);
    smallContext.putImageData(image, 0, 0);
    context.imageSmoothingEnabled = false;
    context.drawImage(small, 0, 0, m, n);
  };
  // What a kind of answer draws with: in samples; line(width) is of so many pixels.
  const easel = { run, context, line, put, colours, background };

  // --- what is done now ---

  const vertex = (v) => header.vertices[v] ?? null;

  const tint = (path, colour, strength) => {
    context.fillStyle = colour;
    context.globalAlpha = strength;
    context.fill(path);
    context.globalAlpha = 1;
  };

  // Of a piece, what is left of its face.
  const mark = (subject, colour, dashed, fill, k) => {
    const left = subject.kind === "piece"
      ? run.outline(k, subject.ids[1], subject.ids[0]) : null;
    for (const f of facesOf(subject)) {
      if (!paths[f]) continue;
      const path = left ? pathOf(left) : paths[f];
      if (fill && subject.kind !== "edge")
        tint(path, colour, dashed ? 0.16 : 0.28);
      stroke(path, colour, subject.kind === "edge" ? 1 : 2, dashed);
    }
    const [p, q] = subject.ids;
    if (subject.kind === "cube") markCube(run.cubes.get(`${p},${q}`), colour);
    if (subject.kind === "edge" && vertex(p) && vertex(q))
      stroke(pathOf([vertex(p), vertex(q)]), colour, 3.5, dashed);
    if (subject.kind === "vertex" && vertex(p)) {
      const dot = new Path2D();
      dot.arc(...vertex(p), line(5), 0, 2 * Math.PI);
      stroke(dot, colour, 2.5, false);
    }
  };

  const markCube = (corners, colour) => {
    const box = new Path2D();
    for (let c = 0; corners && c < 8; c++)
      for (const d of [c | 1, c | 2, c | 4])
        if (d !== c && corners[c] && corners[d]) {
          box.moveTo(...corners[c]);
          box.lineTo(...corners[d]);
        }
    stroke(box, colour, 2, false);
  };

  // The halves of a piece that is divided, and between them the plane.
  const markHalves = (e, colour) => {
    const halves = run.children(e.k, e.a.ids[1]).filter(Boolean).map(pathOf);
    halves.forEach((half, k) => {
      tint(half, colour, k ? 0.15 : 0.5);
      stroke(half, colour, 2.5, false);
    });
    const cut = run.cut(e.k, e.a.ids[1], e.a.ids[0]);
    if (cut) stroke(pathOf(cut), colourOf("--ink"), 2.5, true);
  };

  const markWindow = (w, colour, kind) => {
    const grow = w.width * w.height === 1 ? line(2) : 0;
    const box = new Path2D();
    box.rect(w.x - grow, w.y - grow, w.width + 2 * grow, w.height + 2 * grow);
    if (w.height === 1 && w.width < m) { // the row that it is on
      context.fillStyle = colour;
      context.globalAlpha = 0.13;
      context.fillRect(0, w.y, m, 1);
      context.globalAlpha = 1;
    }
    if (kind === "subdivide" && w.height > 1) {
      box.moveTo(w.x + w.width / 2, w.y);
      box.lineTo(w.x + w.width / 2, w.y + w.height);
      box.moveTo(w.x, w.y + w.height / 2);
      box.lineTo(w.x + w.width, w.y + w.height / 2);
    }
    if (kind === "reject") {
      box.moveTo(w.x, w.y);
      box.lineTo(w.x + w.width, w.y + w.height);
    }
    stroke(box, colour, kind === "accept" ? 3 : 2, kind === "retire");
  };

  const markEvent = (e) => {
    const colour = kindColour(e.kind);
    const window = e.window && (e.window.width < m || e.window.height < n ||
      e.a.kind === "window" || e.b.kind === "window") ? e.window : null;
    const fill = e.kind !== "accept";
    mark(e.b, colour, true, fill, e.k);
    if (e.kind !== "accept" || run.kind.partLine)
      mark(e.a, colour, false, fill, e.k);
    if (e.kind === "split" && e.a.kind === "piece") markHalves(e, colour);
    if (window) markWindow(window, colour, e.kind);
    const part = e.part && run.kind.partLine?.(e.part);
    if (part) stroke(pathOf(part.points), colour, 3.5, part.dashed);
  };

  const markPixel = ({ i, j }) => {
    const cross = new Path2D();
    const r = line(9);
    cross.arc(i + 0.5, j + 0.5, r, 0, 2 * Math.PI);
    for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
      cross.moveTo(i + 0.5 + dx * r, j + 0.5 + dy * r);
      cross.lineTo(i + 0.5 + dx * 1.9 * r, j + 0.5 + dy * 1.9 * r);
    }
    stroke(cross, colourOf("--ink"), 1.5, false);
  };

  const draw = (k, { pixel, outlines = true, event = true } = {}) => {
    fit();
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.fillStyle = colourOf("--paper");
    context.fillRect(0, 0, canvas.width, canvas.height);
    context.setTransform(scale, 0, 0, scale, 0, 0);
    run.kind.draw(easel, run.painting.at(k), k);
    if (outlines) {
      context.strokeStyle = colourOf("--ink");
      context.globalAlpha = 0.22;
      context.lineWidth = line(0.8);
      context.stroke(every);
      context.globalAlpha = 1;
    }
    // At the end, nothing lies over the picture.
    if (event && k > 0 && k <= run.trace.kept && k < run.n) markEvent(run.event(k - 1));
    if (pixel) markPixel(pixel);
  };

  // The sample under the pointer.
  const at = ({ clientX, clientY }) => {
    const box = canvas.getBoundingClientRect();
    const place = (x, low, size, most) =>
      Math.min(most - 1, Math.max(0, Math.floor((x - low) / size * most)));
    return { i: place(clientX, box.left, box.width, m),
      j: place(clientY, box.top, box.height, n) };
  };
  return { draw, at };
}

function pathOf(points) {
  const path = new Path2D();
  points.forEach(([x, y], k) => k ? path.lineTo(x, y) : path.moveTo(x, y));
  if (points.length > 2) path.closePath();
  return path;
}
