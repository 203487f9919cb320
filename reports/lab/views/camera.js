// SPDX-License-Identifier: GPL-3.0-or-later
// Cameras, and how they move. The numbers of a camera are short, so that a link
// holds exactly the camera that drew the picture.

export const minus = (a, b) => a.map((x, k) => x - b[k]);
export const plus = (a, b, t = 1) => a.map((x, k) => x + t * b[k]);
export const dot = (a, b) => a.reduce((sum, x, k) => sum + x * b[k], 0);
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => a.map((x) => x / Math.hypot(...a));

export const short = (x) => Number(x.toPrecision(6));
const shortAll = (a) => a.map((x) => short(Math.abs(x) < 1e-9 ? 0 : x));
const made = (camera, changes) => {
  const { eye, at } = { ...camera, ...changes };
  return { ...camera, ...changes, eye: shortAll(eye), at: shortAll(at) };
};

export function axes({ eye, at, up }) {
  const forward = unit(minus(at, eye));
  const right = unit(cross(forward, up));
  return { forward, right, above: cross(right, forward) };
}

// What a sample's length is in the world, at a distance along the view.
export const unitAt = ({ fov, parallel }, distance, n) => (parallel > 0 ? parallel
  : 2 * distance * Math.tan(fov * Math.PI / 360)) / n;

// Around the point that it looks at: by angles to the right and upwards.
export function turned(camera, right, upwards) {
  const up = unit(camera.up);
  const arm = minus(camera.eye, camera.at);
  const far = Math.hypot(...arm);
  const height = Math.asin(Math.max(-1, Math.min(1, dot(arm, up) / far)));
  const next = Math.max(-1.5, Math.min(1.5, height + upwards));
  let flat = minus(arm, up.map((x) => x * dot(arm, up)));
  if (Math.hypot(...flat) < 1e-9 * far) flat = cross(up, axes(camera).right);
  const side = unit(flat), other = cross(up, side);
  const around = side.map((x, k) => x * Math.cos(right) + other[k] * Math.sin(right));
  return made(camera, { eye: camera.at.map((x, k) => x + far *
    (Math.cos(next) * around[k] + Math.sin(next) * up[k])) });
}

// Nearer by a factor below 1.
export const nearer = (camera, factor) => camera.parallel > 0
  ? { ...camera, parallel: short(camera.parallel * factor) }
  : made(camera, { eye: plus(camera.at, minus(camera.eye, camera.at), factor) });

// Sideways and upwards, by shares of the height of the picture.
export function shifted(camera, right, upwards) {
  const { right: x, above: y } = axes(camera);
  const far = Math.hypot(...minus(camera.at, camera.eye));
  const height = unitAt(camera, far, 1);
  const by = plus(x.map((c) => c * right * height), y, upwards * height);
  return made(camera, { eye: plus(camera.eye, by), at: plus(camera.at, by) });
}

// Parallel with the same picture at the distance of `at`, or perspective again.
export function otherProjection(camera) {
  const far = Math.hypot(...minus(camera.at, camera.eye));
  const fov = camera.fov > 0 ? camera.fov : 45;
  return { ...camera, fov, parallel: camera.parallel > 0 ? 0
    : short(unitAt({ fov, parallel: 0 }, far, 1)) };
}

// The line of sight through (x, y), samples from the corner of m x n.
export function rayThrough(camera, x, y, m, n) {
  const { forward, right, above } = axes(camera);
  const [i, j] = [x - m / 2, n / 2 - y];
  const size = unitAt(camera, 1, n);
  const off = plus(right.map((c) => c * i * size), above, j * size);
  return camera.parallel > 0 ? { from: plus(camera.eye, off), along: forward }
    : { from: camera.eye, along: plus(forward, off) };
}

const NUMBERS = ["fov", "near", "parallel"];
const hasLight = ({ light }) => light?.some((x) => x !== 0) ?? false;
export const cameraText = (camera) => [...camera.eye, ...camera.at, ...camera.up,
  ...NUMBERS.map((name) => camera[name]),
  ...hasLight(camera) ? camera.light : []].join(",");

// null: the text is no camera. The light is left out if it is the standard one.
export function cameraOf(text) {
  const x = text.split(",").map(Number);
  if (![12, 16].includes(x.length) || x.some((c) => !Number.isFinite(c))) return null;
  return { eye: x.slice(0, 3), at: x.slice(3, 6), up: x.slice(6, 9),
    fov: x[9], near: x[10], parallel: x[11],
    ...x.length === 16 ? { light: x.slice(12) } : {} };
}
