// SPDX-License-Identifier: GPL-3.0-or-later
// node wrong.mjs MODULES BROWSER [PAGE ALGORITHM=WHAT...]...
// Pages of hsr lesson say of each algorithm that is known to be wrong that it is, near the
// title, and prints TAP. WHAT: the number of wrong samples that hsr check has counted;
// "untold", where the page cannot tell; "right", where the page should say nothing.
import assert from "node:assert/strict";
import { addressOf, begin, blemishes } from "../browser.mjs";

const [modules, executablePath, ...rest] = process.argv.slice(2);
const { test, open, serious, end } = await begin(modules, executablePath);
const { page, faults } = await open({ viewport: { width: 1366, height: 657 } });

const WORDS = { untold: /known to be wrong sometimes: hsr check \S+ -a \S+ counts/,
  0: /known to be wrong sometimes, but not in this view\.$/,
  1: /Here one sample is wrong: at the end, crosses mark it\./ };
const wordsOf = (what) => WORDS[what] ??
  new RegExp(`Here ${what} samples are wrong: at the end, crosses mark them\\.`);

let file = null;
for (const word of rest) {
  if (/\.html$/.test(word)) {
    file = word;
    continue;
  }
  const [name, what] = word.split(/=(?=[^=]*$)/);
  await test(`${name} is ${what}`, async () => {
    await page.goto("about:blank");
    await page.goto(`${addressOf(file)}#/?a=${encodeURIComponent(name)}`);
    await page.waitForSelector(".panel .words");
    const said = page.locator(".top .known-wrong");
    assert.equal(await said.count(), what === "right" ? 0 : 1);
    if (what === "right") return;
    assert.match(await said.innerText(), /^This algorithm is known to be wrong/);
    assert.match(await said.innerText().then((x) => x.replace(/ ?Show$/, "")),
      wordsOf(what));
    assert.equal(await said.locator("button").count(), Number(what) > 0 ? 1 : 0);
    assert.deepEqual(await page.evaluate(blemishes), []);
    assert.deepEqual(await serious(page), []);
    if (!(Number(what) > 0)) return;
    await said.locator("button").click();
    assert.ok(await page.evaluate(async (own) => {
      const { run, state } = globalThis.lesson;
      return state.k[0] === (await run(own)).n;
    }, name));
  });
}
await test("no script error", () => assert.deepEqual(faults, []));
await end();
