// SPDX-License-Identifier: GPL-3.0-or-later
// node links.mjs MODULES BROWSER FOLDER
// Follows the links that lead to FOLDER/lab.html, and prints TAP. FOLDER has:
//   house.html   lessons of house@eye=9,5,9 by watkins and bouknight
//   file.html    a lesson of a file that lab.html has in it
//   report/      a report of house and of a file
import assert from "node:assert/strict";
import { join } from "node:path";
import { addressOf, begin } from "../browser.mjs";

const [modules, executablePath, folder] = process.argv.slice(2);
const { test, open, end } = await begin(modules, executablePath);
const { page, faults, close } = await open();
const shown = async () => {
  await page.waitForFunction(() => globalThis.lab?.pictures?.isSettled(), null,
    { timeout: 120000 });
  return page.evaluate(async () => {
    const { lab } = globalThis, [first] = lab.pictures.shown();
    const { views, nFaces } = await (await lab.source.current()).info;
    return { scene: lab.state.scene, a: lab.state.a, eye: views[lab.state.view].eye,
      camera: lab.state.camera, refused: first.answer === undefined, nFaces };
  });
};

await test("a lesson leads to its scene and its algorithm", async () => {
  await page.goto(`${addressOf(join(folder, "house.html"))}#/?a=bouknight,watkins`);
  await page.click(".try");
  const { scene, a, eye, camera, refused } = await shown();
  assert.deepEqual([scene, a, eye, camera, refused],
    ["house@eye=9,5,9", ["bouknight", "watkins"], [9, 5, 9], null, false]);
});

await test("a lesson of a file leads to the file in the page", async () => {
  await page.goto(addressOf(join(folder, "file.html")));
  await page.click(".try");
  const { a, nFaces, refused } = await shown();
  assert.deepEqual([a, nFaces, refused], [["zbuffer"], 3, false]);
});

await test("a report leads to a page of its own", async () => {
  const index = addressOf(join(folder, "report", "index.html"));
  await page.goto(index);
  await page.click("text=try them in the laboratory");
  assert.equal((await shown()).refused, false);
  await page.goto(`${index}#/algorithm/watkins`);
  await page.click("text=try it");
  const { scene, a, refused } = await shown();
  assert.deepEqual([scene, a, refused], ["house", ["watkins"], false]);
});

await test("so do its lessons, but not of a file", async () => {
  await page.goto(addressOf(join(folder, "report", "lessons.html")) + "#/?a=newell");
  await page.click(".try");
  const { a, refused } = await shown();
  assert.deepEqual([a, refused], [["newell"], false]);
  const tries = [];
  for (const name of ["lesson-1.html", "lesson-2.html"]) {
    await page.goto(addressOf(join(folder, "report", name)));
    await page.waitForSelector(".kicker");
    tries.push(await page.locator(".try").count());
  }
  assert.deepEqual(tries.sort(), [0, 1]);
});

await test("nothing was asked of the network", () => assert.deepEqual(faults, []));
await close();
await end();
