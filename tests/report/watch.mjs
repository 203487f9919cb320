// SPDX-License-Identifier: GPL-3.0-or-later
// node watch.mjs MODULES BROWSER FOLDER
// Follows all links of the report in FOLDER that lead to lessons, and prints TAP.
import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { basename, join } from "node:path";
import { fileURLToPath } from "node:url";
import { addressOf, begin } from "../browser.mjs";

const [modules, executablePath, folder] = process.argv.slice(2);
const { test, open, end } = await begin(modules, executablePath);
const { page, faults, close } = await open();
const index = addressOf(join(folder, "index.html"));

const isOfLesson = (address) => /\/lessons?(-\d+)?\.html/.test(address);

// { address, text } of all links of a page of the report that lead to lessons.
async function linksOf(hash) {
  await page.goto("about:blank");
  await page.goto(index + hash);
  await page.waitForSelector("h1");
  const all = await page.$$eval("a[href], svg a", (links) => links.map((a) => ({
    text: a.textContent.trim(),
    address: new URL(a.getAttribute("href"), document.baseURI).href })));
  return all.filter(({ address }) => isOfLesson(address));
}

const names = await (async () => {
  await page.goto(index);
  await page.waitForSelector("h1");
  return page.$$eval("a[href^='#/algorithm/']", (links) => [...new Set(links.map((a) =>
    decodeURIComponent(a.getAttribute("href").split("/")[2].split("?")[0])))]);
})();

const found = new Map(); // address -> { text, from }
for (const hash of ["", "#/tables", "#/algorithm/watkins?with=zbuffer",
  ...names.map((name) => `#/algorithm/${encodeURIComponent(name)}`)])
  for (const { address, text } of await linksOf(hash))
    if (!found.has(address)) found.set(address, { text, from: hash });

await test("algorithms of the survey, of culling and of grids can be watched", () => {
  const all = [...found.keys()].join(" ");
  for (const name of ["watkins", "zz-buffer", "pvs", "weiler-atherton", "error-bounded",
    "pbtf", "splat-sheet"])
    assert.ok(all.includes(`a=${name}`), name);
  assert.match(all, /a=watkins(,|%2C)zbuffer/);
});

for (const [address, { text, from }] of found) {
  const url = new URL(address);
  const wanted = new URLSearchParams(url.hash.split("?")[1] ?? "").get("a");
  const scene = /^watch it on (.*)$/.exec(text)?.[1];
  await test(`${from || "the front"}: “${text}” leads to a lesson${
    wanted ? ` of ${wanted}` : ""}`, async () => {
    assert.ok(existsSync(fileURLToPath(address.split(/[?#]/)[0])),
      basename(url.pathname));
    await page.goto("about:blank");
    await page.goto(address);
    await page.waitForFunction(() => globalThis.lesson);
    if (!wanted) return;
    await page.waitForSelector(".panel .words");
    for (const name of wanted.split(",")) {
      const { isThere, shown, of, moments, hasText } = await page.evaluate(told, name);
      assert.ok(isThere, `${name} is not in ${basename(url.pathname)}`);
      if (!wanted.includes(",")) assert.equal(shown, name);
      if (scene) assert.equal(of, scene);
      assert.ok(moments > 1, `${moments} moments`);
      assert.ok(hasText, `nothing is told of ${name}`);
    }
  });
}

// Runs in the page.
async function told(name) {
  const { lesson } = globalThis;
  if (!lesson.names.includes(name)) return { isThere: false };
  const run = await lesson.run(name);
  return { isThere: true, of: run.header.scene, moments: lesson.moments(run).length,
    shown: document.querySelector("h1").textContent.split(":")[0].trim(),
    hasText: document.querySelectorAll(".lesson-body p").length > 1 };
}

await test("no page of these is faulty", () => assert.deepEqual(faults, []));
await close();
await end();
