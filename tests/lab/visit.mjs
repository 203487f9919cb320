// SPDX-License-Identifier: GPL-3.0-or-later
// node visit.mjs MODULES BROWSER PAGE FIRST EDITS SEED
// FIRST is a page of hsr lab, by newell:special=groups and painter.
// Opens the laboratory from disk as a reader would, and prints TAP.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { addressOf, begin, blemishes } from "../browser.mjs";
import { editsAreRight } from "./edits.mjs";

const [modules, executablePath, file, first, edits, seed] = process.argv.slice(2);
const { test, open: openWindow, serious, end } =
  await begin(modules, executablePath);

async function open(options = {}) {
  const opened = await openWindow(options);
  const { page } = opened;
  await opened.page.context().grantPermissions(["clipboard-read",
    "clipboard-write"]).catch(() => {});
  const settled = () => page.waitForFunction(() => globalThis.lab?.core &&
    (globalThis.lab.state.mode !== "look" || globalThis.lab.pictures.isSettled()),
  null, { timeout: 120000 });
  const go = async (hash) => {
    await page.goto("about:blank");
    await page.goto(addressOf(file) + hash);
    await settled();
  };
  const set = async (changes) => {
    await page.evaluate((c) => globalThis.lab.set(c), changes);
    await settled();
  };
  return { ...opened, go, set, settled };
}

const hashes = (page) => page.evaluate(() => globalThis.lab.pictures.shown()
  .map(({ answer }) => answer?.hash));
const differing = (page) => page.evaluate(() => {
  const [a, b] = globalThis.lab.pictures.shown().map(({ answer }) => answer?.ids);
  return a && b ? a.reduce((sum, id, k) => sum + (id === b[k] ? 0 : 1), 0) : null;
});

// --- pictures ---

const { page, faults, go, set, settled, close } = await open();

await test("it opens from disk, with two pictures that agree", async () => {
  await go("");
  assert.equal(await page.locator("canvas.view").count(), 2);
  assert.equal(await differing(page), 0);
  assert.match(await page.textContent(".verdict"), /✓ 0 of [\d,]+ samples differ/);
  assert.match(await page.textContent(".welcome"), /Sixty hidden-surface algorithms/);
  const drawn = await page.evaluate(() => performance.now());
  console.log(`# ${Math.round(drawn)} ms`);
});

await test("every algorithm draws the house, or a volume, or says why not", async () => {
  const all = await page.evaluate(() => globalThis.lab.core.algorithms.map((a) =>
    ({ name: a.name, isKnownWrong: a.isKnownWrong, kind: a.kind,
      drawsNothing: a.drawsNothing })));
  assert.ok(all.length >= 55, `${all.length} algorithms`);
  const bad = [];
  for (const { name, isKnownWrong, kind, drawsNothing } of all) {
    await set({ scene: "house", size: [64, 48], a: [name, "zbuffer"] });
    if (await page.locator(".frame .refusal:visible").count()) {
      const said = await page.textContent(".frame .refusal:visible");
      if (said.trim().length < 10 || said.includes("\n")) bad.push(`${name}: “${said}”`);
      if (kind === "voxels") continue;
      await set({ scene: "checker-cube:5", a: [name] });
    }
    if (await page.locator(".frame .refusal:visible").count()) {
      await set({ scene: "checker-plane", a: [name] });
      if (await page.locator(".frame .refusal:visible").count())
        bad.push(`${name} draws nothing`);
    }
    if (kind === "ids" && !isKnownWrong && !drawsNothing && await differing(page))
      bad.push(`${name}: ${await differing(page)} samples differ`);
  }
  assert.deepEqual(bad, []);
  assert.deepEqual(faults, []);
});

await test("the painter is shown to be wrong, and Newell is not", async () => {
  await go("#/?s=cyclic-overlap&a=painter,newell&overlay=differ&size=128x96");
  assert.ok(await differing(page) > 0);
  assert.match(await page.textContent(".verdict"), /painter is known to be wrong/);
  await page.click(".ask");
  await page.waitForFunction(() => /newell: all .* right\./.test(
    document.querySelector(".verdict").textContent));
  assert.match(await page.textContent(".verdict"), /painter: [\d,]+ of [\d,]+ wrong/);
});

await test("the camera turns by dragging, by keys and by the wheel", async () => {
  await go("#/?s=house&a=watkins");
  const before = await hashes(page);
  const { x, y } = await page.locator("canvas.view").first().boundingBox();
  await page.mouse.move(x + 100, y + 100);
  await page.mouse.down();
  for (let k = 0; k < 12; k++) await page.mouse.move(x + 100 + 10 * k, y + 100 + k);
  await page.mouse.up();
  await settled();
  const turned = await hashes(page);
  assert.notDeepEqual(turned, before);
  await page.focus("canvas.view");
  for (const key of ["ArrowLeft", "+", "p"]) {
    const camera = await page.evaluate(() => JSON.stringify(globalThis.lab.state.camera));
    await page.keyboard.press(key);
    assert.notEqual(await page.evaluate(() =>
      JSON.stringify(globalThis.lab.state.camera)), camera, key);
  }
  await page.mouse.wheel(0, -200);
  await page.waitForTimeout(400);
  await settled();
  await page.focus("canvas.view");
  await page.keyboard.press("0");
  await settled();
  assert.deepEqual(await hashes(page), before);
});

await test("an edited scene keeps its sides", async () => {
  for (const scene of ["one-sided", "house", "cyclic-overlap"]) {
    await go(`#/?s=${scene}&a=zbuffer&size=128x96`);
    const ids = () => page.evaluate(() =>
      globalThis.lab.pictures.shown()[0].answer.ids.join());
    const before = await ids();
    await set({ edits: [["paint", "f0", "#804020"]] });
    assert.equal(await ids(), before, scene);
  }
});

await test("what lies under the pointer is named, and why", async () => {
  await go("#/?s=house&a=watkins&size=256x192");
  const { x, y, width, height } = await page.locator("canvas.view").boundingBox();
  await page.mouse.move(x + 0.5 * width, y + 0.75 * height);
  await page.waitForFunction(() => /^face \d+ \(/.test(
    document.querySelector(".under").textContent));
  const { name, all } = await page.evaluate(() => ({ name: document.querySelector(
    ".under").textContent, all: globalThis.lab.pictures.shown()[0].answer.ids }));
  assert.match(name, new RegExp(`^face ${all[256 * 144 + 128]} `));
  await page.mouse.click(x + 0.5 * width, y + 0.75 * height);
  await page.waitForFunction(() => /at depth .* before/.test(
    document.querySelector(".under").textContent));
  assert.ok((await page.textContent(".under")).startsWith(`${name} at depth`));
});

await test("pictures blink, and show where the work went", async () => {
  await go("#/?s=house&a=warnock,watkins&overlay=work&blink=1");
  await page.waitForFunction(() => /looked .* times at a sample/.test(
    document.querySelector(".facts-of").textContent));
  assert.equal(await page.locator(".easel:visible").count(), 1);
  assert.equal(await page.locator(".blink-name:visible").count(), 1);
});

await test("counts are held, and those of another picture stand beside them", async () => {
  await go("#/?s=house&a=watkins&size=128x96");
  await page.click(".hold");
  const all = () => page.locator(".counters tfoot td:visible").allTextContents();
  const [held] = await all();
  assert.deepEqual(await all(), [held, held, "1.00"]);
  await page.evaluate(() =>
    globalThis.lab.set({ size: [64, 48], a: ["watkins:x-list=tree"] }));
  await settled();
  const [now, was, ratio] = await all();
  const number = (text) => Number(text.replace(/[^0-9]/g, ""));
  assert.equal(was, held);
  assert.equal(ratio, (number(now) / number(held)).toFixed(2));
  await page.click(".hold");
  assert.deepEqual(await all(), [now]);
});

await test("a link has the counts that are held, or holds the first ones", async () => {
  const subdivisions = () => page.locator(
    ".counters tr:visible", { hasText: "subdivisions" }).locator("td").allTextContents();
  await go("#/?s=house&a=warnock&size=128x96&held=1");
  const [first, held, ratio] = await subdivisions();
  assert.deepEqual([held, ratio], [first, "1.00"]);
  await set({ size: [256, 192] });
  const [now, ...then] = await subdivisions();
  assert.equal(then[0], first);
  assert.ok(Number(then[1]) > 1.5, `${now} of ${then}`);
  await page.waitForFunction(() => /held=warnock\.\d/.test(location.hash) &&
    location.hash.includes("256x192"));
  await page.reload();
  await settled();
  assert.deepEqual(await subdivisions(), [now, ...then]);
  const box = await page.evaluate(() => ["table.counters", ".easel"].map((name) =>
    document.querySelector(name).getBoundingClientRect().right));
  assert.ok(box[0] <= box[1], "the ratio is in sight");
  await go("#/?s=house&a=warnock&held=warnock.1,x");
  assert.match(await page.textContent(".said"), /cannot be read: held counts/);
});

// --- the first pictures ---

await test("pictures of hsr lab are those that the core draws", async () => {
  const written = readFileSync(first, "utf8");
  const pictures = [...written.matchAll(
    /<img class="view" width="(\d+)" height="(\d+)"[^>]* src="(data:[^"]*)"/g)]
    .map(([, m, n, src]) => ({ m: Number(m), n: Number(n), src }));
  assert.equal(pictures.length, 2);
  await page.goto("about:blank");
  await page.goto(addressOf(first));
  await settled();
  assert.equal(await page.locator("img").count(), 0, "they are shown no more");
  const found = await page.evaluate((all) => Promise.all(all.map(async (one, p) => {
    const { lab } = globalThis, { subject } = await lab.source.current();
    const { rgba } = await lab.core.seats[p].must(subject, (client, id) =>
      client.draw(id, { algorithm: lab.state.a[p], m: one.m, n: one.n,
        camera: lab.state.camera }));
    const image = Object.assign(new Image(), { src: one.src });
    await image.decode();
    const context = new OffscreenCanvas(one.m, one.n).getContext("2d");
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, one.m, one.n);
    return { name: lab.state.a[p], samples: rgba.length,
      differ: data.reduce((sum, x, k) => sum + (x === rgba[k] ? 0 : 1), 0) };
  })), pictures);
  assert.deepEqual(found, ["newell:special=groups", "painter"].map((name) =>
    ({ name, samples: 4 * 480 * 360, differ: 0 })));
});

await test("they are seen until the core has drawn, but not of another link", async () => {
  for (const [hash, n] of [["", 2], ["#/?s=house&a=watkins", 0]]) {
    const own = await open();
    await own.page.addInitScript(() => {
      WebAssembly.compileStreaming = () => new Promise(() => {});
    });
    await own.page.goto(addressOf(first) + hash);
    await own.page.waitForFunction(() => document.readyState === "complete");
    assert.equal(await own.page.locator(".frame img:visible").count(), n);
    assert.equal(await own.page.locator("text=Drawn by hsr when").count(), n ? 1 : 0);
    if (n) assert.deepEqual(await serious(own.page), []);
    await own.close();
  }
});

// --- links ---

await test("a link opens what it was copied from", async () => {
  const links = ["#/?s=soup:40:3&a=newell,zbuffer:samples=1,watkins:x-list=tree",
    "#/?s=house&a=watkins&v=3&overlay=differ&size=200x150"];
  for (const hash of links) {
    await go(hash.replace(",zbuffer:samples=1", ",zbuffer"));
    await page.evaluate(() => {
      const { lab } = globalThis;
      lab.history.add(["box", 1, 1, 1, 2, 2, 2, "#3d7dc8"]);
      lab.history.add(["turn", "o0", 0, 1, 0, 0.25]);
    });
    await page.focus("canvas.view");
    await page.keyboard.press("ArrowRight");
    await settled();
    await page.click(".lab-head .main-act");
    await page.waitForFunction(() => /copied/.test(
      document.querySelector(".said").textContent));
    const link = await page.evaluate(() => navigator.clipboard.readText());
    const state = await page.evaluate(() => JSON.stringify(globalThis.lab.state.edits));
    const drawn = await hashes(page);
    await page.goto("about:blank");
    await page.goto(link);
    await settled();
    assert.equal(await page.evaluate(() =>
      JSON.stringify(globalThis.lab.state.edits)), state);
    assert.deepEqual(await hashes(page), drawn);
  }
});

await test("what is wrong in an address has its standard", async () => {
  for (const hash of ["#/?e=!!!", "#/?a=nothing&s=house", "#/?c=1,2&size=x&mode=z",
    "#/?s=no-such-scene", "#/?w=3,3,1,1&mode=step&steps=9"]) {
    await go(hash);
    assert.deepEqual(await page.evaluate(blemishes), [], hash);
  }
  await go("#/?e=!!!&c=1,2");
  assert.match(await page.textContent(".said"), /cannot be read: edits, camera/);
  assert.deepEqual(faults, []);
});

// --- edits ---

await test("a solid is chosen, moved, deleted; undo and redo", async () => {
  await go("#/?s=house&a=watkins,newell&size=128x96");
  const before = await hashes(page);
  await page.click("[data-tool=move]");
  const box = await page.locator("canvas.view").first().boundingBox();
  const at = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(...at);
  await page.mouse.down();
  for (let k = 1; k < 8; k++) await page.mouse.move(at[0] + 9 * k, at[1] - 5 * k);
  await page.mouse.up();
  await settled();
  assert.equal(await page.evaluate(() => globalThis.lab.state.edits.length), 1);
  assert.equal(await differing(page), 0);
  const moved = await hashes(page);
  assert.notDeepEqual(moved, before);
  await page.focus("[data-tool=move]");
  await page.keyboard.press("Delete");
  await settled();
  assert.equal(await differing(page), 0);
  await page.keyboard.press("Control+z");
  await settled();
  assert.deepEqual(await hashes(page), moved);
  await page.keyboard.press("Control+z");
  await settled();
  await page.keyboard.press("Control+Shift+z");
  await settled();
  assert.deepEqual(await hashes(page), moved);
  for (const what of ["box", "triangle"])
    await page.click(`.edit button:text-is("${what}")`);
  await settled();
  assert.equal(await page.evaluate(() => globalThis.lab.state.edits.length), 3);
  assert.equal(await differing(page), 0);
});

await test("a polygon is drawn by its corners", async () => {
  await go("#/?s=house&a=zbuffer,newell&size=128x96");
  await page.click('.edit button:text-is("polygon")');
  const box = await page.locator("canvas.view").first().boundingBox();
  for (const [x, y] of [[0.2, 0.2], [0.5, 0.1], [0.7, 0.4], [0.4, 0.7]])
    await page.mouse.click(box.x + x * box.width, box.y + y * box.height);
  await page.keyboard.press("Enter");
  await settled();
  const [edit] = await page.evaluate(() => globalThis.lab.state.edits);
  assert.equal(edit[0], "polygon");
  assert.equal(edit.length, 2 + 4 * 3);
  assert.equal(await differing(page), 0);
});

await test(`${edits} random edits are right, as the judge says`, async () => {
  await go("#/?s=cyclic-overlap&a=zbuffer&size=32x24");
  assert.deepEqual(await page.evaluate(editsAreRight,
    { edits: Number(edits), seed: Number(seed) }), []);
});

// --- one's own file ---

await test("one's own file is opened; a small one is in the link", async () => {
  await go("");
  const off = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  await page.setInputFiles("input[type=file]", { name: "four.off",
    mimeType: "text/plain", buffer: Buffer.from(off) });
  await page.waitForFunction(() => globalThis.lab.state.own);
  await settled();
  assert.match(await page.textContent(".scene-facts"), /4 faces/);
  const drawn = await hashes(page);
  await page.waitForFunction(() => location.hash.includes("f="));
  await page.reload();
  await settled();
  assert.deepEqual(await hashes(page), drawn);
  await page.setInputFiles("input[type=file]", { name: "bad.obj",
    mimeType: "text/plain", buffer: Buffer.from("f 1 2 99\n") });
  await page.waitForFunction(() => /bad\.obj/.test(
    document.querySelector(".scene-facts").textContent));
});

// --- the other modes ---

await test("steps go forward and back, and have stories and questions", async () => {
  await go("#/?s=house&a=newell,watkins&mode=step&steps=32x24");
  await page.waitForSelector(".panel .words");
  const k = () => page.evaluate(() => globalThis.lab.state.play.k[0]);
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press(".");
  assert.equal(await k(), 2);
  await page.keyboard.press("ArrowLeft");
  assert.equal(await k(), 1);
  await page.keyboard.press("End");
  assert.ok(await k() > 1000);
  assert.ok(await page.evaluate(() => globalThis.lab.modes.step.runs().every((run) =>
    run.painting.equal())), "the steps make the answer");
  await page.click("canvas.picture >> nth=0", { position: { x: 100, y: 80 } });
  assert.match(await page.textContent(".story-box h3"), /The story of/);
  await page.check("input[name=quiz]");
  await page.keyboard.press("Home");
  await page.waitForFunction(() => location.hash.includes("quiz=1"));
  await page.reload();
  await page.waitForSelector(".panel .words");
  assert.match(await page.textContent(".story-box h3"), /The story of/);
  assert.deepEqual(faults, []);
});

await test("the steps of one row are those of that row", async () => {
  await go("#/?s=house&a=watkins&mode=step&steps=32x24&w=0,12,32,13");
  await page.waitForSelector(".panel .words");
  const rows = await page.evaluate(() => {
    const { trace } = globalThis.lab.modes.step.runs()[0];
    return [...new Set(Array.from(trace.y).filter((_, k) => trace.height[k] === 1))];
  });
  assert.deepEqual(rows, [12]);
});

await test("faces that penetrate are divided by Newell", async () => {
  await go("#/?s=soup:2:6&a=newell&mode=step&to=kind:split");
  await page.waitForSelector(".panel .words");
  const splits = await page.evaluate(() => {
    const { trace, header } = globalThis.lab.modes.step.runs()[0];
    return header.counters.reduce((n, c, k) =>
      n + (c.kind === "split" ? trace.counts[k] : 0), 0);
  });
  assert.ok(splits > 0);
});

await test("the chart grows, and is saved", async () => {
  await go("#/?s=soup:40:3&a=watkins,bouknight&mode=measure");
  await page.evaluate(() => globalThis.lab.modes.measure.sweep());
  await page.waitForSelector(".chart svg");
  const n = await page.evaluate(() => globalThis.lab.modes.measure.points().length);
  assert.ok(n >= 16, `${n} points`);
  const [csv] = await Promise.all([page.waitForEvent("download"),
    page.click(".chart summary").then(() => page.click("button:text-is('Save CSV')"))]);
  assert.match(csv.suggestedFilename(), /\.csv$/);
  const [svg] = await Promise.all([page.waitForEvent("download"),
    page.click("button:text-is('Save SVG')")]);
  assert.match(svg.suggestedFilename(), /\.svg$/);
  for (const by of ["size", "depth"]) {
    await page.selectOption("select[name=varied]", by);
    await page.focus("input[name=n]");
    for (let k = 0; k < 3; k++) await page.keyboard.press("PageUp");
    await page.waitForSelector(".chart svg");
  }
  assert.deepEqual(await page.evaluate(blemishes), []);
  assert.deepEqual(faults, []);
});

await test("the reader decides, and exact depths say why", async () => {
  await go("#/?s=cyclic-overlap&mode=decide&task=seen&a=zbuffer");
  await page.waitForSelector(".answers button");
  const right = await page.evaluate(() => globalThis.lab.modes.decide.task().answer());
  await page.click(`.answers button:has-text("face ${right} ")`).catch(() =>
    page.click(`.answers button:text-is("face ${right}")`));
  assert.match(await page.textContent(".decide-side"), /✓ Yes.*is seen/s);
  await page.click('button:text-is("Paint it in order")');
  await page.waitForFunction(() => globalThis.lab.modes.decide.task()?.faces);
  while (await page.locator(".answers button").count())
    await page.click(".answers button >> nth=0");
  await page.click('button:text-is("Judge it")');
  await page.waitForSelector(".decide-side .bad");
  assert.match(await page.textContent(".decide-side"), /No order is right/);
  const colours = await page.evaluate(() => Array.from({ length: 16 }, (_, k) =>
    getComputedStyle(document.documentElement).getPropertyValue(`--hue-${k}`).trim()));
  assert.equal(new Set(colours).size, 16);
  assert.ok(await page.evaluate((all) => all.every((text) =>
    CSS.supports("color", text)), colours));
});

// --- looks ---

await test("nothing was asked of the network, and no script failed", async () => {
  assert.deepEqual(faults, []);
});
await close();

for (const [width, height, colorScheme] of [[1440, 900, "light"], [1366, 657, "dark"],
  [390, 844, "light"]])
  await test(`at ${width} pixels, ${colorScheme}`, async () => {
    const own = await open({ viewport: { width, height }, colorScheme });
    for (const mode of ["look", "step", "measure", "decide"]) {
      await own.go(`#/?s=cyclic-overlap&a=watkins,newell&mode=${mode}&mx=64,128`);
      await own.page.waitForTimeout(500);
      assert.deepEqual(await own.page.evaluate(blemishes), [], mode);
      assert.deepEqual(await serious(own.page), [], mode);
    }
    if (height < 800) {
      await own.go("");
      const bottoms = await own.page.evaluate(() =>
        [...document.querySelectorAll("canvas.view")].map((e) =>
          e.getBoundingClientRect().bottom));
      for (const y of bottoms) assert.ok(y <= height, `down to ${y}`);
    }
    assert.deepEqual(own.faults, []);
    await own.close();
  });
await end();
