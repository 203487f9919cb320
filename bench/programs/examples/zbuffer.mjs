#!/usr/bin/env node
// SPDX-License-Identifier: GPL-3.0-or-later
// A z-buffer in JavaScript for Node, which hsr judges and times: docs/programs.md.
//
//   hsr check house -a ./zbuffer.mjs
//
// Every quantity of a triangle is c0 + c1 x + c2 y in the coordinates of the screen.
import { openSync, readFileSync, readSync, writeSync } from "node:fs";

const begin = performance.now();
const folder = process.argv[2];
const words = {}; // of the job, which has one camera: each name comes once
for (const line of readFileSync(`${folder}/job`, "utf8").trim().split("\n")) {
  const [name, ...rest] = line.split(" ");
  words[name] = rest;
}
// It declines walks, and lines.
if (words.cameras[0] !== "1" || words.answer[0] !== "ids") process.exit(6);
const [m, n] = words.size.map(Number);
const [E, F, R, U] = ["eye", "forward", "right", "up"].map((k) => words[k].map(Number));
const near = Number(words.near[0]), parallel = words.camera[0] === "parallel";

const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                         a[0] * b[1] - a[1] * b[0]];

const [head, body] = readFileSync(`${folder}/triangles.ply`, "utf8").split("end_header\n");
const [, nVertices] = head.match(/element vertex (\d+)/).map(Number);
const lines = body.trim().split("\n").map((line) => line.split(" ").map(Number));
const V = lines.slice(0, nVertices).map((v) => sub(v, E));
const triangles = lines.slice(nVertices); // 3 a b c face one_sided

// det(a, b, ray): on which side of the edge a sample is.
function edge(a, b) {
  const c = cross(a, b), d = parallel ? cross(F, sub(b, a)) : c;
  return [dot(c, F), dot(d, R), dot(d, U)];
}
const at = (p, x, y) => p[0] + p[1] * x + p[2] * y;
// A sample on the edge is a little to the right, and much less down.
const side = (p, x, y) => (at(p, x, y) || p[1] || -p[2]) > 0;

const ids = new Uint32Array(m * n), nearest = new Float64Array(m * n);
function draw() {
  const counts = { "depth tests": 0, writes: 0 };
  ids.fill(0xffffffff);
  nearest.fill(-Infinity);
  for (const [, i0, i1, i2, face, oneSided] of triangles) {
    const a = V[i0], b = V[i1], c = V[i2], N = cross(sub(b, a), sub(c, a));
    const front = parallel ? dot(N, F) : dot(N, a); // < 0: seen from its front
    if (front === 0 || (oneSided && front > 0)) continue;
    const edges = [edge(a, b), edge(b, c), edge(c, a)];
    // 1/t or, in parallel projection, -t: the greater is nearer.
    const depth = [parallel ? -dot(N, a) : dot(N, F), dot(N, R), dot(N, U)];
    for (let j = 0, s = 0; j < n; j++)
      for (let i = 0; i < m; i++, s++) {
        const x = (2 * i + 1 - m) / m, y = (n - 2 * j - 1) / n;
        const first = side(edges[0], x, y);
        if (first !== side(edges[1], x, y) || first !== side(edges[2], x, y)) continue;
        const q = at(depth, x, y) / front;
        if (parallel ? -q <= near : q <= 0 || q * near >= 1) continue;
        counts["depth tests"]++;
        if (q <= nearest[s]) continue;
        counts.writes++;
        nearest[s] = q;
        ids[s] = face;
      }
  }
  return counts;
}

const file = openSync(`${folder}/ids`, "r+"), byte = new Uint8Array(1);
writeSync(1, JSON.stringify({ import: (performance.now() - begin) / 1e3 }) + "\n");
while (readSync(0, byte)) {
  const counts = draw();
  writeSync(file, ids, 0, ids.byteLength, 0);
  writeSync(1, JSON.stringify({ counts }) + "\n");
}
