// SPDX-License-Identifier: GPL-3.0-or-later
// Draws an answer into a canvas, and over it what the reader wants to see.
import { colourOf } from "../../lesson/data/kinds.js";
import { projection } from "../../lesson/data/projection.js";
import { kindNamed } from "../../lesson/kinds/all.js";

// show(answer, camera): the picture; over(layers): what lies over it: { mask,
// heat, outlines: [{ points, colour }], dots: [point] }. Points are of the world.
export function painter(canvas) {
  const context = canvas.getContext("2d");
  const small = new OffscreenCanvas(1, 1);
  const smallContext = small.getContext("2d");
  let answer = null, camera = null, layers = {};

  const fit = () => {
    const dots = Math.min(2, globalThis.devicePixelRatio || 1);
    const wide = Math.max(1, Math.round(canvas.clientWidth * dots));
    const high = Math.max(1, Math.round(canvas.clientHeight * dots));
    if (canvas.width !== wide || canvas.height !== high) {
      canvas.width = wide;
      canvas.height = high;
    }
  };

  const put = (data, m, n) => {
    small.width = m;
    small.height = n;
    smallContext.putImageData(new ImageData(data, m, n), 0, 0);
    context.imageSmoothingEnabled = m > canvas.width;
    context.drawImage(small, 0, 0, canvas.width, canvas.height);
  };

  // Of layers with one number a sample: colour(k) gives red, green, blue, opacity.
  const putSamples = (m, n, colour) => {
    const data = new Uint8ClampedArray(4 * m * n);
    for (let k = 0; k < m * n; k++) {
      const rgba = colour(k);
      if (rgba) data.set(rgba, 4 * k);
    }
    put(data, m, n);
  };

  const line = (width) => width * canvas.width / Math.max(1, canvas.clientWidth);

  const paint = () => {
    fit();
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.fillStyle = colourOf("--paper");
    context.fillRect(0, 0, canvas.width, canvas.height);
    if (!answer) return;
    if (answer.rgba) put(answer.rgba, answer.m, answer.n);
    if (answer.segments) drawing();
    if (layers.heat) {
      grey();
      putSamples(layers.heat.m, layers.heat.n, warmth(layers.heat));
    }
    if (layers.mask) marks(layers.mask);
    vectors();
  };

  // Without colours, so that those of a layer are seen.
  const grey = () => {
    context.globalCompositeOperation = "saturation";
    context.fillStyle = "#000";
    context.fillRect(0, 0, canvas.width, canvas.height);
    context.globalCompositeOperation = "source-over";
  };

  const drawing = () => {
    const see = projection({ ...camera, width: canvas.width, height: canvas.height });
    const many = answer.segments.length; // thinner, the more there are
    const thin = many > 2000 ? 0.5 : many > 400 ? 0.7 : 1;
    const parts = answer.segments.map((s) => [null, s.invisibility, s.t0, s.t1, null,
      null, ...[s.from, s.to].map((p) => see(p)?.slice(0, 2))]);
    kindNamed("segments").draw({ context, line: (w) => line(w * thin) }, parts);
  };

  // Samples that differ, as squares that are seen from afar.
  const marks = ({ m, places }) => {
    const size = canvas.width / m, r = Math.max(size, line(2.5));
    context.fillStyle = colourOf("--bad");
    for (const k of places)
      context.fillRect((k % m + 0.5) * size - r / 2,
        (Math.floor(k / m) + 0.5) * size - r / 2, r, r);
  };

  const vectors = () => {
    if (!camera) return;
    context.lineJoin = "round";
    const see = projection({ ...camera, width: canvas.width, height: canvas.height });
    const trace = (points, closed) => {
      const at = points.map(see);
      if (at.some((p) => !p)) return;
      context.beginPath();
      at.forEach(([x, y], k) => k ? context.lineTo(x, y) : context.moveTo(x, y));
      if (closed) context.closePath();
    };
    for (const { points, colour, open } of layers.outlines ?? []) {
      trace(points, !open);
      context.strokeStyle = colourOf("--paper");
      context.lineWidth = line(4);
      context.stroke();
      context.strokeStyle = colourOf(colour);
      context.lineWidth = line(2);
      context.stroke();
    }
  };

  return { paint,
    show: (next, from) => { answer = next; camera = from; paint(); },
    over: (next) => { layers = next; paint(); } };
}

// From clear to the colour of rejection, by the logarithm.
function warmth({ values, most }) {
  const [r, g, b] = [1, 3, 5].map((k) =>
    parseInt(colourOf("--hue-1").slice(k, k + 2), 16));
  const share = (x) => (Math.log(1 + x) / Math.log(1 + most)) ** 1.6;
  return (k) => values[k] > 0 ? [r, g, b, 10 + 225 * share(values[k])] : null;
}
