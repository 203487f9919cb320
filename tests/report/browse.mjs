// SPDX-License-Identifier: GPL-3.0-or-later
// node browse.mjs MODULES BROWSER sample SAMPLE BARE DAMAGED
// node browse.mjs MODULES BROWSER any REPORT
// node browse.mjs MODULES BROWSER hostile REPORT SAID
// Opens reports from disk as a reader would, and prints TAP.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { addressOf, begin, blemishes } from "../browser.mjs";

const [modules, executablePath, kind, ...folders] = process.argv.slice(2);
const { test, open: openWindow, serious, end } =
  await begin(modules, executablePath);
const pageOf = (folder) => addressOf(join(folder, "index.html"));

async function open(folder, options = {}) {
  const opened = await openWindow(options);
  const go = async (hash) => {
    await opened.page.goto(pageOf(folder) + hash);
    await opened.page.waitForSelector("main h1");
    await settle(opened.page);
  };
  return { ...opened, go };
}

// Plots are drawn two frames after the rest, when their width is known.
function settle(page) {
  return page.evaluate(() => new Promise((done) =>
    requestAnimationFrame(() => requestAnimationFrame(done))));
}

// --- checks that hold for every page of every report ---

async function visitAll(folder, width, colorScheme) {
  await test(`every page at ${width} pixels, ${colorScheme}`, async () => {
    const { page, faults, go, close } = await open(folder,
      { viewport: { width, height: 800 }, colorScheme });
    await go("");
    const links = new Set(await hashes(page));
    for (const hash of ["#/check", "#/sweeps", "#/timings", "#/errors",
      "#/tables"]) links.add(hash);
    await go("#/check");
    const probes = (await hashes(page)).filter((x) => x.startsWith("#/probe/"));
    for (const path of new Set(probes.map((x) => x.split("?")[0])))
      links.add(probes.find((x) => x.startsWith(path)));
    const seen = new Set();
    for (const hash of links) {
      await go(hash);
      assert.deepEqual(await page.evaluate(blemishes), [], hash);
      const kind = hash.split(/[/?]/)[1] ?? "";
      if (!seen.has(kind)) // axe takes its time: one page of each kind
        assert.deepEqual(await serious(page), [], hash);
      seen.add(kind);
      assert.deepEqual(faults, [], hash);
    }
    assert.ok(links.size >= 5);
    console.log(`# ${links.size} pages`);
    await close();
  });
}

function hashes(page) {
  return page.$$eval("a[href^='#/']", (all) =>
    all.map((a) => a.getAttribute("href")));
}

async function any(folder) {
  await visitAll(folder, 1280, "light");
  await visitAll(folder, 320, "dark");

  await test("every listed algorithm is in the tree or beside it", async () => {
    const { page, go, close } = await open(folder);
    await go("");
    const listed = await page.evaluate(() =>
      (window.hsr.algorithms ?? []).map((a) => a.name));
    const shown = await page.$$eval("#tree .leaf a", (all) =>
      all.map((a) => a.textContent));
    assert.deepEqual(listed.filter((name) => !shown.includes(name)), []);
    await close();
  });

  await test("without JavaScript it says so", async () => {
    const { page, close } = await open(folder, { javaScriptEnabled: false });
    await page.goto(pageOf(folder));
    assert.match(await page.innerText("main"), /needs\s+JavaScript/);
    await close();
  });
}

// --- checks of the sample ---

const column = (page, table, n) => page.$$eval(`#${table}-table tbody tr`,
  (rows, k) => rows.map((row) => row.children[k].textContent), n);

async function choose(page, name, value) {
  await page.selectOption(`select[name=${name}]`, value);
  await settle(page);
}

async function sampled(folder) {
  const { page, faults, go, close } = await open(folder);
  const hash = () => page.evaluate(() => location.hash);
  const heading = () => page.textContent("h1");
  const follow = async (selector) => {
    const before = await hash();
    await page.click(selector);
    await page.waitForFunction((old) => location.hash !== old, before);
    await settle(page);
  };

  await test("the tree leads to Watkins' page", async () => {
    await go("");
    await follow(".tree a:text-is('watkins')");
    assert.match(await heading(), /Watkins/);
    assert.match(await page.textContent(".facts"), /YXZ/);
    assert.match(await page.textContent("#sorts"), /logarithmic search/);
    assert.match(await page.textContent("#steps"), /X merge.*Er Sl/);
    assert.match(await page.textContent("#pictures"), /touched/);
  });

  await test("figure 13 is a drawing that can be saved; the ten are framed", async () => {
    await go("#/tables/figure-13");
    assert.equal(await page.locator("#figure-13 .taxonomy svg a:not(.watch)").count(), 10);
    assert.equal(await page.locator("#figure-13 .leaf.ten").count(), 10);
    const saved = page.waitForEvent("download");
    await page.locator("#figure-13 .taxonomy button.save").click();
    const svg = readFileSync(await (await saved).path(), "utf8");
    assert.match(svg, /^<svg/);
    assert.doesNotMatch(svg, /var\(|NaN|undefined/);
    await follow("#figure-13 .taxonomy a:has-text('Watkins')");
    assert.match(await heading(), /Watkins/);
  });

  await test("Watkins beside Bouknight", async () => {
    await choose(page, "with", "bouknight");
    assert.match(await hash(), /with=bouknight/);
    await page.reload();
    const beside = await page.textContent(".beside");
    assert.match(beside, /Watkins/);
    assert.match(beside, /Bouknight/);
    assert.ok((await column(page, "beside", 3)).length > 5);
  });

  await test("Watkins beside two others: pictures, steps, counters", async () => {
    await choose(page, "with-1", "zbuffer-fast");
    assert.match(await hash(), /with=bouknight%2Czbuffer|with=bouknight,zbuffer/);
    await page.reload();
    assert.deepEqual(await page.evaluate(blemishes), []);
    assert.deepEqual(await serious(page), []);
    const heads = await page.$$eval(".beside thead th", (all) =>
      all.map((e) => e.textContent.trim()));
    assert.deepEqual(heads.slice(1), ["watkins", "bouknight", "zbuffer-fast"]);
    assert.equal(await page.locator(".scale").count(), 1);
    const columns = await page.$$eval(".row-of", (all) =>
      all.map((e) => e.children.length));
    assert.ok(columns.length > 0 && columns.every((n) => n === 3));
    const steps = await page.textContent("#steps");
    for (const word of ["X merge", "span cull", "all of a frame"])
      assert.ok(steps.includes(word), word);
    assert.match(await page.textContent("#counters"), /depth search/);
    await choose(page, "with", "");
    assert.doesNotMatch(await hash(), /bouknight/);
  });

  await test("restrictions are spelled out", async () => {
    await go("#/algorithm/romney");
    assert.match(await page.textContent(".facts"), /TR\s+faces are triangles/);
  });

  await test("an algorithm that nobody knows has its place", async () => {
    await go("");
    await follow(".tree a:text-is('newcomer')");
    assert.match(await heading(), /nobody knows/);
  });

  await test("filters change the matrix and the address, and last", async () => {
    await go("#/check");
    const rows = () => page.$$eval(".matrix tbody tr", (all) => all.length);
    const before = await rows();
    await choose(page, "scene", "house");
    const after = await rows();
    assert.ok(after < before && after > 0, `${after} of ${before}`);
    assert.match(await hash(), /scene=house/);
    await page.reload();
    assert.equal(await rows(), after);
    assert.equal(await page.inputValue("select[name=scene]"), "house");
  });

  await test("states stand in words and symbols", async () => {
    await go("#/check");
    const text = await page.textContent("main");
    for (const word of ["✓ ok", "✗ 341", "∅ refused", "◷ timeout", "! crash",
      "▤ memory"]) assert.ok(text.includes(word), word);
    assert.match(await page.textContent("#failed"), /NP: face 17/);
  });

  await test("a wrong picture has no time, a peer has both", async () => {
    await go("#/timings?algorithms=painter");
    const places = await column(page, "modules", 1);
    const views = await column(page, "modules", 2);
    assert.ok(places.length > 3);
    assert.ok(!places.some((s, k) => s === "house" && views[k] === "1"));
    await go("#/timings?algorithms=embree");
    assert.match(await page.textContent("#peers"), /17 of 5,917/);
    assert.equal(await page.$("#modules"), null);
  });

  await test("errors of filters have a table and pictures", async () => {
    await go("");
    await follow("header nav a:text-is('Filters')");
    assert.deepEqual(await column(page, "errors-0", 0),
      ["zbuffer-fast, 4 × 4 samples", "a-buffer"]);
    assert.deepEqual(await column(page, "errors-0", 2), ["0.0312", "0.0580"]);
    assert.deepEqual(await column(page, "errors-0", 3), ["1.25 %", "0.100 %"]);
    assert.deepEqual(await column(page, "errors-0", 4), ["(5, 7)", "(2, 9)"]);
    const drawn = await page.$$eval("#errors-0 img", (all) =>
      all.map((e) => e.complete && e.naturalWidth));
    assert.deepEqual(drawn, [97]);
    assert.equal(await page.locator("#errors-1 img").count(), 0);
  });

  await test("ticked algorithms alone are left, in their colours", async () => {
    const colours = () => page.$$eval(".legend a", (all) => Object.fromEntries(
      all.map((a) => [a.textContent, a.querySelector("path").outerHTML])));
    await go("#/sweeps");
    const before = await colours();
    assert.ok(Object.keys(before).length > 15);
    await page.click(".choice summary");
    await page.check("input[value=watkins]");
    await page.check("input[value=zbuffer-fast]");
    await settle(page);
    assert.match(await hash(), /algorithms=/);
    await page.reload();
    await settle(page);
    const { watkins, "zbuffer-fast": zbuffer } = before;
    assert.deepEqual(await colours(), { watkins, "zbuffer-fast": zbuffer });
    const hue = /--hue-\d/.exec(watkins)[0];
    assert.ok(await page.$(`.plot svg [fill="var(${hue})"]`), "in the plot");
  });

  await test("tables sort by any column, and the address keeps it", async () => {
    await go("#/timings?view=house%2C+view+1");
    const medians = () => page.evaluate(() => {
      const { cells, places } = window.hsr;
      const house = places.findIndex((p) => p.scene === "house" && p.view === 1);
      const of = new Map(cells.filter((c) => c.place === house && c.seconds).map((c) => [c.algorithm, c.seconds[0]]));
      return [...document.querySelectorAll("#modules-table tbody tr")].map((row) =>
        of.get(row.children[0].textContent));
    });
    const sorted = (list) => [...list].sort((a, b) => a - b);
    const given = await medians();
    assert.ok(given.length > 10);
    assert.notDeepEqual(given, sorted(given));
    await page.click("#modules-table th button:has-text('median')");
    assert.deepEqual(await medians(), sorted(given));
    await page.click("#modules-table th button:has-text('median')");
    assert.deepEqual(await medians(), sorted(given).reverse());
    await page.reload();
    assert.deepEqual(await medians(), sorted(given).reverse());
    assert.equal(await page.getAttribute("#modules-table [aria-sort]", "aria-sort"),
      "descending");
  });

  await test("what is not distinguishable is said to be so", async () => {
    await go("#/timings");
    assert.match(await page.textContent("#modules"), /not distinguishable/);
  });

  // Row of a module at the pixel that is chosen: verdict, face, depth, object.
  const seen = (name) => page.$$eval("#readout tbody tr", (rows, n) =>
    [...rows.find((r) => r.children[0].textContent === n).children].slice(1)
      .map((td) => td.textContent), name);
  const pixel = async (i, j) => {
    await page.fill("input[name=i]", String(i));
    await page.fill("input[name=j]", String(j));
    await page.keyboard.press("Tab");
  };

  await test("the matrix leads to the probe, which tells face and depth",
    async () => {
      await go("#/check?scene=house");
      await follow("td.wrong a");
      await page.waitForSelector("#readout table");
      await pixel(45, 30);
      assert.deepEqual(await seen("oracle"),
        ["✓", "2", "3.203125", "box B, face 1"]);
      assert.deepEqual(await seen("watkins"), await seen("oracle"));
      assert.deepEqual(await seen("painter"),
        ["✗ differs", "1", "3.500000", "box <A>, face 1"]);
      assert.equal(await page.textContent("[role=status]"),
        "i = 45, j = 30: box B, face 1, depth 3.203125; otherwise by painter");
      await pixel(20, 20);
      assert.deepEqual(await seen("painter"),
        ["✓", "1", "3.500000", "box <A>, face 1"]);
      await pixel(96, 0);
      assert.deepEqual(await seen("zbuffer-fast"), ["✓", "none", "–", "background"]);
    });

  await test("keys, pointer and the next difference choose a pixel",
    async () => {
      await pixel(39, 30);
      await page.focus(".stage");
      await page.keyboard.press("ArrowRight");
      assert.equal(await page.inputValue("input[name=i]"), "40");
      assert.equal((await seen("painter"))[0], "✗ differs");
      await page.keyboard.press("Shift+ArrowDown");
      assert.equal(await page.inputValue("input[name=j]"), "40");
      const area = await (await page.$(".stage")).boundingBox();
      const scale = area.width / 97;
      await page.mouse.click(area.x + 60.5 * scale, area.y + 3.5 * scale);
      assert.match(await page.textContent("#readout caption"),
        /i = 60, j = 3$/);
      await page.click("button:has-text('Next')");
      assert.match(await page.textContent("#readout caption"),
        /i = 40, j = 20$/);
    });

  await test("the probe's state lasts, and layers are shown", async () => {
    await page.check("input[value=differences]");
    assert.match(await page.getAttribute(".stage img", "src"), /^difference/);
    await page.waitForFunction(() => /i=40&j=20/.test(location.hash));
    await page.reload();
    await page.waitForSelector("#readout table");
    assert.match(await page.textContent("#readout caption"), /i = 40, j = 20$/);
    assert.match(await page.getAttribute(".stage img", "src"), /^difference/);
    assert.equal(await page.$eval(".stage img", (e) =>
      getComputedStyle(e).imageRendering), "pixelated");
    await choose(page, "module", "watkins");
    assert.match(await page.textContent(".next"), /No pixel of watkins differs/);
  });

  await test("odd names are text", async () => {
    await go("#/check");
    assert.match(await page.textContent("main"), /odd <b>&"name'\/50%/);
    assert.equal(await page.$("main th b"), null);
    await go("#/timings");
    await choose(page, "view", "odd <b>&\"name'/50%, view 1");
    await page.reload();
    const names = await column(page, "modules", 1);
    assert.ok(names.length && names.every((n) => n.startsWith("odd <b>")));
  });

  await test("all tables of 1974 are there, also by address", async () => {
    await go("#/tables/figure-29b");
    const titles = await page.$$eval("h2", (all) =>
      all.map((e) => e.textContent));
    for (const wanted of ["Table I:", "Table II:", "Table III:", "Table IV:",
      "Table V:", "Table VI:", "Table VII:", "Figure 13:", "Figure 29a:",
      "Figure 29b:", "The sorting orders", "What the paper concluded", "Greene"])
      assert.ok(titles.some((t) => t.startsWith(wanted)), wanted);
    assert.match(await page.textContent("#conclusions"), /✗ not borne out/);
    assert.ok(await page.evaluate(() => scrollY > 500), "scrolled to it");
  });

  await test("going back shows the page before, from its top", async () => {
    await go("");
    await follow("nav a:has-text('Growth')");
    assert.equal(await heading(), "How they grow");
    assert.match(await page.title(), /^How they grow/);
    await page.goBack();
    await settle(page);
    assert.equal(await heading(), "A made-up report");
  });

  await test("tables and plots are saved as files that stand alone", async () => {
    const saved = async (selector) => {
      const [download] = await Promise.all([page.waitForEvent("download"),
        page.click(selector)]);
      return [download.suggestedFilename(),
        readFileSync(await download.path(), "utf8")];
    };
    await go("#/timings");
    const [name, rows] = await saved("#modules .save");
    assert.equal(name, "seconds-a-frame-of-the-algorithms.csv");
    assert.match(rows, /^algorithm,scene,view,size,median,/);
    assert.match(rows, /\r\nwatkins,"odd <b>&""name'\/50%",1,97 × 61,[\d.e-]+,/);
    const [file, svg] = await saved("figure .save");
    assert.match(file, /^seconds-a-frame-a-mark-.*\.svg$/);
    assert.match(svg, /^<svg [^>]*xmlns="http/);
    assert.match(svg, /soup:100:7, view 1/);
    assert.doesNotMatch(svg, /var\(/);
  });

  await test("every algorithm has looks of its own", async () => {
    await go("");
    const keys = await page.$$eval("#tree .leaf a:has(.key)", (all) =>
      all.map((a) => [a.textContent, a.querySelector(".key").innerHTML]));
    const own = keys.filter(([n]) => n !== "newcomer" && n !== "embree" &&
      n !== "llvmpipe").map(([, look]) => look);
    assert.equal(new Set(own).size, own.length);
  });

  await test("the timings' rows are sorted, and their marks are of scenes",
    async () => {
      await go("#/timings?view=house%2C+view+1&algorithms=watkins,zbuffer-fast,yzx");
      const rows = await (await page.$("figure .plot")).$$eval("text", (all) =>
        all.map((e) => e.textContent));
      const named = rows.filter((r) => ["watkins", "zbuffer-fast", "yzx"].includes(r));
      const median = await page.evaluate(() => {
        const { cells } = window.hsr;
        return Object.fromEntries(cells.filter((c) => c.place === 0 && c.seconds)
          .map((c) => [c.algorithm, c.seconds[0]]));
      });
      assert.deepEqual(named, [...named].sort((a, b) => median[a] - median[b]));
      assert.match(await page.textContent("figure .legend"), /house, view 1/);
    });

  await test("a wide table prints whole", async () => {
    await go("#/check");
    await page.emulateMedia({ media: "print" });
    await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
    const wide = await page.$$eval(".scroll table", (all) =>
      all.map((e) => e.getBoundingClientRect().width));
    assert.ok(wide.every((w) => w <= 1020), String(wide));
    await page.evaluate(() => dispatchEvent(new Event("afterprint")));
    await page.emulateMedia({ media: "screen" });
  });

  await test("nothing went wrong on the way", async () =>
    assert.deepEqual(faults, []));
  await close();
}

async function lacking(bare, damaged) {
  await visitAll(bare, 320, "light");
  await test("data of another form, or damaged, are told", async () => {
    const { page, close } = await open(damaged);
    await page.goto(pageOf(damaged));
    assert.match(await page.innerText("main"), /missing beside this page/);
    await close();
  });
}

// Of results that try to break the page. said: what the command printed.
async function hostile(folder, said) {
  await test("names are text on every page, and no script of theirs runs",
    async () => {
      const { page, faults, go, close } = await open(folder);
      page.on("dialog", (dialog) => faults.push(`dialog: ${dialog.message()}`));
      for (const hash of ["", "#/check", "#/sweeps", "#/timings", "#/tables",
        "#/algorithm/watkins", "#/algorithm/__proto__", "#/probe/constructor"]) {
        await go(hash);
        assert.equal(await page.evaluate(() => window.attacked), undefined);
        assert.equal(await page.$("main script, main [onerror], main [onload], " +
          "main iframe, main a[href^='javascript']"), null, hash);
        assert.deepEqual(faults, [], hash);
      }
      await go("#/check");
      const text = await page.textContent("main");
      assert.ok(text.includes("</script><script>window.attacked"));
      await close();
    });

  await test("the command prints no control character", () =>
    assert.doesNotMatch(readFileSync(said, "utf8"), /[^\n\x20-\x7e]/));
}

await any(folders[0]);
if (kind === "hostile") await hostile(...folders);
if (kind === "sample") {
  await sampled(folders[0]);
  await lacking(folders[1], folders[2]);
}
await end();
