// SPDX-License-Identifier: GPL-3.0-or-later
// The picture of a run: what is painted so far, the images of all faces, and
// over them what the algorithm does now.
import { colourOf, kindColour, packed } from "../data/kinds.js";
import { keepsRows } from "../data/lists.js";
import { looksOf } from "../looks/all.js";
import { markerLooks, middleSeen } from "../looks/tests.js";
import { wrongSamples } from "../telling/wrong.js";

const DASH = [6, 4];
const DOTS = [2, 4];

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
    const dots = canvas.clientWidth ? Math.round(canvas.clientWidth *
      Math.min(3, globalThis.devicePixelRatio || 1)) : canvas.width;
    if (canvas.width !== dots) {
      canvas.width = dots;
      canvas.height = Math.round(dots * n / m);
    }
    scale = canvas.width / m;
  };
  const line = (width) => width / scale * (canvas.width / canvas.clientWidth || 1);

  // A stroke with a pale seam, which is seen on every colour.
  const stroke = (path, colour, width, dash) => {
    context.setLineDash(dash ? dash.map(line) : []);
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

  // A ring and a box of one sample have a size on the screen.
  const pathOfShape = ({ points, closed, ring, isSmall }) => {
    if (ring) {
      const dot = new Path2D();
      dot.arc(...ring, line(5), 0, 2 * Math.PI);
      return dot;
    }
    const grow = isSmall ? line(2) : 0;
    const [[x, y], , [right, bottom] = []] = points;
    return isSmall ? boxPath(x - grow, y - grow, right + grow, bottom + grow)
      : pathOf(points, closed);
  };

  const drawShape = (shape, colour) => {
    const path = pathOfShape(shape);
    const own = shape.role === "ink" ? colourOf("--ink") : colour;
    if (shape.fill) {
      context.fillStyle = own;
      context.globalAlpha = shape.fill * (shape.dashed ? 0.6 : 1);
      context.fill(path);
      context.globalAlpha = 1;
    }
    if (shape.width) stroke(path, own, shape.width, shape.dotted ? DOTS
      : shape.dashed ? DASH : null);
  };

  const markEvent = (e) => {
    const colour = kindColour(e.kind);
    const { a, b, where } = looksOf(run, e);
    for (const shape of [...b, ...a, ...where, ...markerLooks(run, e)]) drawShape(shape, colour);
    nameSubject(e.b, b);
    nameSubject(e.a, a);
  };

  // The number of a face or piece, as the sentence says it, in what is seen of it.
  const nameSubject = ({ kind, ids }, [shape]) => {
    if (!/^(face|piece)$/.test(kind) || ids[0] < 0 || !shape?.closed) return;
    const [x, y] = middleSeen(run, shape.points);
    const text = String(kind === "piece" ? ids[1] : ids[0]);
    context.font = `600 ${line(15)}px system-ui, sans-serif`;
    context.textAlign = "center";
    context.textBaseline = "middle";
    context.lineJoin = "round";
    context.lineWidth = line(4);
    context.strokeStyle = colourOf("--paper");
    context.strokeText(text, x, y);
    context.fillStyle = colourOf("--ink");
    context.fillText(text, x, y);
  };

  const markPixel = ({ i, j }) => {
    const cross = new Path2D();
    const r = line(9);
    cross.arc(i + 0.5, j + 0.5, r, 0, 2 * Math.PI);
    for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
      cross.moveTo(i + 0.5 + dx * r, j + 0.5 + dy * r);
      cross.lineTo(i + 0.5 + dx * 1.9 * r, j + 0.5 + dy * 1.9 * r);
    }
    stroke(cross, colourOf("--ink"), 1.5, null);
  };

  // Crosses at the samples that are wrong in the end.
  const markWrong = () => {
    const crosses = new Path2D();
    for (const at of wrongSamples(run).keys()) {
      const [i, j] = [at % m, Math.floor(at / m)];
      crosses.moveTo(i, j);
      crosses.lineTo(i + 1, j + 1);
      crosses.moveTo(i + 1, j);
      crosses.lineTo(i, j + 1);
    }
    stroke(crosses, kindColour("reject"), 1.5, null);
  };

  // asked: an event that is asked about, drawn before it is decided.
  const draw = (k, { pixel, outlines = true, event = true, asked = null } = {}) => {
    fit();
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.fillStyle = colourOf("--paper");
    context.fillRect(0, 0, canvas.width, canvas.height);
    context.setTransform(scale, 0, 0, scale, 0, 0);
    if (k < run.n) drawBuffered(run, context, k);
    run.kind.draw(easel, run.painting.at(k), k);
    if (outlines) {
      context.strokeStyle = colourOf("--ink");
      context.globalAlpha = 0.22;
      context.lineWidth = line(0.8);
      context.stroke(every);
      context.globalAlpha = 1;
    }
    // At the end, nothing lies over the picture.
    if (asked !== null) markEvent({ ...run.event(asked), kind: "compare", isAsked: true });
    else if (event && k > 0 && k <= run.trace.kept && k < run.n)
      markEvent(run.event(k - 1));
    if (k >= run.n) markWrong();
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

// Where rows are kept until all is done: the pieces that are in them, pale.
function drawBuffered(run, context, k) {
  if (!keepsRows(run)) return;
  context.globalAlpha = 0.4;
  for (const { face, piece } of run.list.at(k).painted) {
    const outline = run.outline(k - 1, piece, face) ?? run.header.faces[face][4];
    context.fillStyle = run.header.faces[face][2];
    context.fill(pathOf(outline, true));
  }
  context.globalAlpha = 1;
}

function pathOf(points, closed = points.length > 2) {
  const path = new Path2D();
  points.forEach(([x, y], k) => k ? path.lineTo(x, y) : path.moveTo(x, y));
  if (closed) path.closePath();
  return path;
}

function boxPath(left, top, right, bottom) {
  const path = new Path2D();
  path.rect(left, top, right - left, bottom - top);
  return path;
}
