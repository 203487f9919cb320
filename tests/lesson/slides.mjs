// SPDX-License-Identifier: GPL-3.0-or-later
// node slides.mjs MODULES BROWSER HSR FOLDER SIZE [SCENE ALGORITHM,ALGORITHM...]...
// Slides of hsr lesson --frames against the page of the same run, and prints TAP:
// each line and each sheet that the page draws over a step is on the slide of it. The
// steps are the key moments, and of each kind of event and outcome one more.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync, readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { addressOf, begin } from "../browser.mjs";

const [modules, executablePath, hsr, folder, size, ...subjects] = process.argv.slice(2);
const { test, open, end } = await begin(modules, executablePath);

const NEAR = 0.15; // samples
const MOST = 120; // steps of a run

// Runs in the page: the steps, and what is drawn over each: [{ points, dash, what }].
function shown([name, most]) {
  return globalThis.lesson.run(name).then((run) => {
    const { lesson } = globalThis, { trace } = run;
    const seen = new Map(lesson.moments(run).map(({ k }) => [k, true]));
    const kinds = new Set();
    for (let e = 0; e < trace.kept && seen.size < most; e++) {
      const kind = `${trace.counter[e]} ${trace.outcome[e]}`;
      if (kinds.has(kind)) continue;
      kinds.add(kind);
      seen.set(e + 1, true);
    }
    return [...seen.keys()].filter((k) => k < run.n).sort((p, q) => p - q).map((k) => {
      const e = run.event(k - 1);
      const { a, b, where } = lesson.looks(run, e);
      const list = run.list?.at(k);
      return { k, flags: lesson.markers(run, e).length,
        list: list ? [list.painted.length, list.order.length] : null,
        kept: list && run.list.ofPieces && run.counterOf("list-segment") >= 0
          ? list.painted.length : null,
        what: `${e.counter.name}${e.outcome ? `: ${e.outcome}` : ""}`,
        shapes: [...a, ...b, ...where, ...lesson.markers(run, e)].filter((x) =>
          (x.width || x.fill) && !x.ring && !x.isSmall).map((x) => ({ points: x.points,
          dash: !x.width ? "none" : x.dotted ? "dotted" : x.dashed ? "dashed" : "solid",
          isInk: x.role === "ink" })) };
    });
  });
}

// The lines and sheets of a slide's picture, in samples: [{ points, dash, isInk }]. They
// are those that cairo has scaled, but for the images of all faces.
function drawnOn(file, unit) {
  const paths = readFileSync(file, "utf8").match(/<path [^>]*>/g) ?? [];
  return paths.map((text) => {
    const matrix = /matrix\(([^)]*)\)/.exec(text)?.[1].split(",").map(Number);
    const d = / d="([^"]*)"/.exec(text)[1];
    const points = [...d.matchAll(/(-?[\d.]+) (-?[\d.]+)/g)].map(([, x, y]) =>
      matrix ? [Number(x), Number(y)] : [(x - 20) / unit, (y - 20) / unit]);
    const dashes = /stroke-dasharray:([\d.]+),([\d.]+)/.exec(text);
    return { points, isFill: /fill-rule/.test(text),
      dash: !dashes ? "solid" : Number(dashes[1]) < 0.5 * dashes[2] + 1e-6 ? "dotted"
        : "dashed",
      isMark: /stroke-opacity:1;/.test(text) || /fill-rule/.test(text),
      isInk: /(stroke|fill):rgb\(11\.37/.test(text) };
  }).filter((path) => path.isMark);
}

// Whether the slide has all corners of the shape in paths of its dash and colour. Of what
// reaches beyond the picture, the corners within.
function has(paths, shape, [width, height]) {
  const [low, high] = [Math.min, Math.max].map((of) => [0, 1].map((c) =>
    of(...shape.points.map((p) => p[c]))));
  if (low[0] >= width || low[1] >= height || high[0] <= 0 || high[1] <= 0) return true;
  const like = paths.filter((p) => (shape.dash === "none" ? p.isFill
    : p.dash === shape.dash && !p.isFill) && p.isInk === shape.isInk);
  return shape.points.filter(([x, y]) => x >= 0 && y >= 0 && x <= width && y <= height)
    .every(([x, y]) => like.some((p) => p.points.some(([u, v]) =>
      Math.hypot(x - u, y - v) < NEAR)));
}

// How many cells of the list a slide has beneath the picture: those that are done, which
// are low if others are to come, and these.
function cellsOn(file) {
  const paths = readFileSync(file, "utf8").match(/<path [^>]*>/g) ?? [];
  const rows = paths.filter((text) => /fill-rule/.test(text) && !/matrix/.test(text) &&
    !/fill:rgb\(11\.37/.test(text)) // nor markers, nor where painting is
    .map((text) => [...text.match(/ d="([^"]*)"/)[1].matchAll(/(-?[\d.]+) (-?[\d.]+)/g)]
      .map(([, x, y]) => [Number(x), Number(y)]))
    .filter((points) => points.length && points.every(([, y]) => y >= TOP && y <= FOOT));
  const done = rows.filter((points) => Math.min(...points.map(([, y]) => y)) > TOP).length;
  return [done, rows.length - done];
}
const TOP = 471, FOOT = 483; // points, as in bench/lesson/frame_list.c

// How many pieces are pale, where an algorithm keeps rows.
const keptOn = (file) => (readFileSync(file, "utf8").match(/fill-opacity:0\.4;/g) ?? []).length;

// How many flags of markers a slide has: five corners, filled with ink.
const flagsOn = (file) => (readFileSync(file, "utf8").match(/<path [^>]*>/g) ?? [])
  .filter((text) => /fill:rgb\(11\.37[^;]*;fill-opacity:1;/.test(text) &&
    / d="M( [^ML]* L){4}[^ML]*Z/.test(text)).length;

const numberOf = (name) => Number(/(\d+)\.svg/.exec(name)[1]);

// What the slides of a run lack, in words.
function lackingOn(slides, steps) {
  const [width, height] = size.split("x").map(Number);
  const files = readdirSync(slides).sort((p, q) => numberOf(p) - numberOf(q));
  assert.deepEqual(files.map(numberOf), steps.map(({ k }) => k));
  return steps.flatMap(({ k, what, shapes, flags, list, kept }, n) => {
    const pale = keptOn(join(slides, files[n]));
    if (kept !== null && pale !== kept)
      return [`step ${k}, ${what}: ${pale} pieces are kept in rows, not ${kept}`];
    const cells = cellsOn(join(slides, files[n]));
    const wanted = !list ? [0, 0] : list[1] ? list : [0, list[0]];
    if (String(cells) !== String(wanted))
      return [`step ${k}, ${what}: ${cells} cells of the list, not ${wanted}`];
    const drawn = flagsOn(join(slides, files[n]));
    if (drawn !== flags) return [`step ${k}, ${what}: ${drawn} flags, not ${flags}`];
    const paths = drawnOn(join(slides, files[n]), 448 / Math.max(width, height));
    return shapes.filter((shape) => !has(paths, shape, [width, height]))
      .map(({ dash, isInk, points }) => `step ${k}, ${what}: a ${dash}${
        isInk ? " ink" : ""} shape at ${points.slice(0, 3).map((p) =>
        p.map(Math.round)).join(" ")}`);
  });
}

async function compare(page, scene, names) {
  const own = join(folder, scene.replace(":", "-"));
  const file = join(own, "page.html");
  mkdirSync(own, { recursive: true });
  execFileSync(hsr, ["lesson", scene, "-a", names.join(","), "-s", size, "-o", file]);
  await page.goto(addressOf(file));
  await page.waitForSelector(".panel .words");
  for (const name of names)
    await test(`${name} on ${scene}: slides show what the page shows`, async () => {
      const steps = await page.evaluate(shown, [name, MOST]);
      assert.ok(steps.length > 5 && steps.some(({ shapes }) => shapes.length));
      const slides = join(own, name);
      execFileSync(hsr, ["lesson", scene, "-a", name, "-s", size, "--frames", slides,
        "--steps", steps.map(({ k }) => k).join(",")]);
      const lacking = lackingOn(slides, steps);
      assert.equal(lacking.length, 0, `${lacking.length}:\n${lacking.slice(0, 20)
        .join("\n")}`);
    });
}

const { page, faults } = await open();
for (let k = 0; k < subjects.length; k += 2)
  await compare(page, subjects[k], subjects[k + 1].split(","));
await test("no script error", () => assert.deepEqual(faults, []));
await end();
