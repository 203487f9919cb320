// SPDX-License-Identifier: GPL-3.0-or-later
// node watch.mjs MODULES BROWSER STORIES PAGE...
// Opens pages of hsr lesson from disk as a reader would, and prints TAP. Beside a
// page there are, for each of its algorithms, NAME.ndjson of hsr trace and, where it
// draws faces, NAME.png of hsr render. STORIES: how many samples of each run are
// asked for their story.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { kindNamed } from "../../reports/lesson/kinds/all.js";
import { addressOf, begin, blemishes } from "../browser.mjs";
import { figuresShow } from "./figures.mjs";
import { fits, fitsBeside, telling } from "./telling.mjs";

const [modules, executablePath, stories, ...files] = process.argv.slice(2);
const { test, open: openWindow, serious, end } =
  await begin(modules, executablePath);

async function open(file, options = {}) {
  const opened = await openWindow(options);
  const go = async (hash) => {
    await opened.page.goto("about:blank");
    await opened.page.goto(addressOf(file) + hash);
    await opened.page.waitForSelector(".panel .words");
  };
  return { ...opened, go };
}

// --- every algorithm ---

// Runs in the page, for one algorithm. Compares what it shows with a replay of
// its own; returns what is wrong.
function watched([name, stories]) {
  return globalThis.lesson.run(name).then((run) => {
    const bad = [];
    const { trace, n, width: m, height } = run;
    const shownCounts = () => run.header.counters.map((_, c) =>
      document.querySelector(`.counters [data-counter="${c}"] td`).textContent);
    const shownSum = () => document.querySelector(".counters tfoot td").textContent;
    const sumOf = (counts) => counts.reduce((sum, x, c) =>
      sum + (run.header.counters[c].kind === "compare" ? x ?? 0 : 0), 0);
    const go = (k) => globalThis.lesson.go(k);
    const expect = (what, got, wanted) => {
      if (JSON.stringify(got) !== JSON.stringify(wanted) && bad.length < 5)
        bad.push(`${what}: ${JSON.stringify(got)?.slice(0, 200)}, not ${
          JSON.stringify(wanted)?.slice(0, 200)}`);
    };
    const numbers = (counts) => counts.map((x) => x === null ? "at the end"
      : x.toLocaleString("en"));

    // Forward to the end, by strides; the first steps singly.
    const stride = Math.max(1, Math.floor(n / 60));
    for (let k = 0; k < Math.min(n, 60); k++) go(k);
    for (let k = 60; k < n; k += stride) go(k);
    go(n);
    expect("counts at the end", shownCounts(), numbers(trace.counts));
    expect("all comparisons", shownSum(), sumOf(trace.counts).toLocaleString("en"));
    trace.counts.forEach((x, c) => {
      const row = document.querySelector(`.counters [data-counter="${c}"]`);
      if (Boolean(row.closest(".idle")) !== (x === 0)) bad.push(`fold of ${c}`);
      const line = run.header.counters[c].line;
      if (x && line && document.querySelectorAll(".outline li")[line - 1]
        .matches(".unused")) bad.push(`line ${line} is not unused`);
    });
    if (!run.painting.equal()) bad.push("the painting is not the answer");
    for (let k = n; k > 0; k -= stride) go(k);
    go(0);
    expect("counts at the start", shownCounts(), trace.counts.map((_, c) =>
      run.header.counters[c].computed ? "at the end" : "0"));
    expect("drawn at the start", run.painting.decided(0), 0);
    const listed = [...document.querySelectorAll(".outline li:not(.unused)")]
      .map((li) => li.textContent);
    expect("the first line", document.querySelector(".words small").textContent,
      listed[0] ?? "");

    // Anywhere: against a replay from the start.
    let seed = 7;
    const random = (most) => {
      seed = (seed * 1103515245 + 12345) % 2147483648;
      return Math.floor(seed / 2147483648 * most);
    };
    for (let t = 0; t < 12; t++) {
      const k = random(n + 1);
      go(k);
      if (document.querySelector(".outline .unused:is([aria-current], .asked)"))
        bad.push(`step ${k} marks a line that is not in this run`);
      const counts = run.header.counters.map((c) => c.computed ? null : 0);
      const ids = new Int32Array(m * height).fill(-2);
      for (let e = 0; e < Math.min(k, trace.kept); e++) {
        counts[trace.counter[e]] += 1;
        if (run.kind.name !== "ids" || run.event(e).kind.localeCompare("accept"))
          continue;
        for (let j = Math.max(0, trace.y[e]);
          j < Math.min(height, trace.y[e] + trace.height[e]); j++)
          for (let i = Math.max(0, trace.x[e]);
            i < Math.min(m, trace.x[e] + trace.width[e]); i++)
            ids[j * m + i] = trace.a0[e];
      }
      if (k < n) {
        expect(`counts at ${k}`, shownCounts(), numbers(counts));
        expect(`sum at ${k}`, shownSum(), sumOf(counts).toLocaleString("en"));
      }
      if (run.kind.name === "ids")
        expect(`ids at ${k}`, Array.from(run.painting.at(k)), Array.from(ids));
    }

    // The list of priority agrees with every event; at the end, all is done.
    if (run.list) {
      expect("events against the list", run.list.faults, []);
      const { painted, order } = run.list.at(n);
      expect("left in the list", order.length, 0);
      if (!painted.length) bad.push("nothing was in the list");
    }
    // What is said of a piece is said of its face.
    const pieces = run.trace.structure.pieces;
    for (let e = 0; e < trace.kept && (run.list || pieces); e++) {
      const { a, b } = run.event(e);
      for (const { kind, ids: [face, p] } of [a, b])
        if (kind === "piece" && run.pieceFace(e, p, face) !== face)
          expect(`piece ${p} at ${e}`, run.pieceFace(e, p, face), face);
    }

    // The words of one step are not those of the next, nor, after a division of two
    // faces' span, of the question before it.
    const wordsOf = (e) => globalThis.lesson.words(run, run.event(e));
    for (let e = 2; e < Math.min(trace.kept, 20000); e++) {
      const { kind, counter } = run.event(e);
      const before = run.event(e - 1);
      const asked = before.kind === "subdivide" && before.b.kind === "face" &&
        before.a.kind === "face" ? e - 2 : e - 1;
      if (kind !== "accept" && run.event(asked).counter === counter &&
          wordsOf(e) === wordsOf(asked)) expect(`words of ${e}`, wordsOf(e), "new");
    }
    if (run.list?.ofPieces && ![...document.querySelectorAll(".board h3")].some((x) =>
      x.textContent.includes("numbers of pieces")))
      bad.push("whose numbers are in the list?");

    // Along the line of a division the piece is as deep as the plane.
    const near = run.header.faces.every((f) => f[3].length)
      ? globalThis.lesson.closeness(run) : null;
    for (let e = 0; e < trace.kept && trace.lists.length && near; e++) {
      const { kind, a, b } = run.event(e);
      if (kind !== "split" || a.kind !== "piece" || b.kind !== "face") continue;
      const cut = run.cut(e, a.ids[1], a.ids[0]);
      if (!cut) bad.push(`division ${e} without its line`);
      for (const [x, y] of cut ?? []) {
        const [p, q] = [near(a.ids[0])?.(x, y), near(b.ids[0])?.(x, y)];
        if (!(Math.abs(p - q) <= 0.02 * Math.abs(q)))
          bad.push(`division ${e}: ${p} and ${q} deep`);
      }
    }

    // Segments of a divided face lie in the outline of the piece at the head.
    const named = (c) => run.header.counters.findIndex((x) => x.name === c);
    const boundsOf = (points) => [0, 1].map((c) => points.map((p) => p[c]))
      .map((x) => [Math.min(...x) - 1, Math.max(...x) + 1]);
    for (let e = 0; e < trace.kept && trace.lists.length === 1; e++) {
      if (trace.counter[e] !== named("segments")) continue;
      const { piece } = run.list.at(e + 1).order[0];
      const outline = run.outline(e, piece);
      if (!outline) continue;
      const [[x0, x1], [y0, y1]] = boundsOf(outline);
      if (trace.x[e] < x0 || trace.x[e] + trace.width[e] > x1 ||
          trace.y[e] < y0 || trace.y[e] + 1 > y1)
        bad.push(`segment ${e} is outside of piece ${piece}`);
    }
    // Each piece of a BSP tree is in one node.
    const inNodes = run.trace.structure.nodes?.flatMap(([, , , first, many]) =>
      Array.from({ length: many }, (_, p) => first + p)).sort((p, q) => p - q);
    if (inNodes) expect("pieces in nodes", inNodes, pieces.map((_, p) => p));
    // A cube of Clark's holds the faces that are met in it.
    for (let e = 0; e < trace.kept && name === "clark"; e++) {
      if (trace.counter[e] !== named("faces met")) continue;
      const { ids } = run.event(e).b;
      const at = run.cubes.get(`${ids[0]},${ids[1]}`);
      const polygon = run.header.faces[trace.a0[e]][4];
      if (!at) bad.push(`no cube ${ids}`);
      if (!at?.every(Boolean) || !polygon.length) continue;
      const cube = boundsOf(at), face = boundsOf(polygon);
      if ([0, 1].some((c) => face[c][0] < cube[c][0] - 1 ||
          face[c][1] > cube[c][1] + 1))
        bad.push(`face ${trace.a0[e]} is outside of cube ${ids}`);
    }
    // From a plane, Schumacker goes to the eye's side.
    const seen = run.tree ? run.tree.at(n).seen : [];
    if (run.tree && !seen.length) bad.push("the tree is not walked");
    for (let e = 0; e < trace.kept && name === "schumacker"; e++) {
      if (trace.counter[e] !== named("inter-cluster priority")) continue;
      const node = run.tree.nodes[trace.b0[e]];
      const side = run.event(e).outcome === "in front" ? "front" : "behind";
      const next = seen[seen.indexOf(trace.b0[e]) + 1];
      if (run.tree.nodes[node[side]].faces?.length === 0) continue; // left out
      if (next !== node[side]) bad.push(`after plane ${trace.b0[e]}: ${next}`);
    }

    // Comparisons of two faces at single samples of an accepted span, since the
    // span before it; and the first division of its face, with the question that
    // found its plane, and the pair's last tests.
    const nameOf = (e) => run.header.counters[trace.counter[e]].name;
    const kindOf = (e) => run.header.counters[trace.counter[e]].kind;
    const atSamples = run.header.counters.map((c, number) =>
      c.kind === "compare" && c.a === "face" && c.b === "face" &&
      !trace.counter.some((x, e) => x === number && trace.width[e] !== 1));
    const decisions = (accepted, face) => {
      const found = [];
      for (let e = (accepted ?? 0) - 1; e >= 0 && kindOf(e) !== "accept"; e--)
        if (atSamples[trace.counter[e]] && trace.y[e] === trace.y[accepted] &&
            trace.height[accepted] === 1 && trace.x[e] >= trace.x[accepted] &&
            trace.x[e] < trace.x[accepted] + trace.width[accepted]) found.push(e);
      const split = trace.counter.findIndex((_, e) => kindOf(e) === "split" &&
        run.event(e).a.kind === "piece" && trace.a0[e] === face);
      if (split >= 0) {
        found.push(split);
        for (let e = split; !/special|priority tests/.test(nameOf(e)); e--)
          if (run.facesOf(e).every((f) => f === face || f === trace.b0[split]))
            found.push(e);
      }
      return found;
    };
    const rowOf = (e) => {
      while (trace.height[e] !== 1) e -= 1;
      return trace.y[e];
    };
    // The stories of some samples.
    for (let t = 0; t < stories && run.kind.name === "ids"; t++) {
      const at = { i: random(m), j: random(height) };
      const { events, face } = globalThis.lesson.story(name, at);
      const accepted = events.filter((e) => run.event(e).kind === "accept");
      expect(`story of ${at.i}, ${at.j}`,
        accepted.length ? trace.a0[accepted.at(-1)] : -1, face);
      const told = new Set(events);
      for (let e = 0; e < trace.kept; e++) {
        const w = { x: trace.x[e], y: trace.y[e] };
        const whole = trace.width[e] >= m && trace.height[e] >= height;
        if (!whole && at.i >= w.x && at.i < w.x + trace.width[e] &&
            at.j >= w.y && at.j < w.y + trace.height[e] && !told.has(e))
          expect(`story of ${at.i}, ${at.j}`, "without", e);
      }
      for (const e of decisions(accepted.at(-1), face))
        if (!told.has(e))
          expect(`story of ${at.i}, ${at.j}`, "without the decision", e);
      for (const e of events)
        if (trace.height[e] === 1 && trace.y[e] !== at.j)
          expect(`story of ${at.i}, ${at.j}`, "of another row", e);
        else if (run.event(e).outcome === "turned off" && rowOf(e) !== at.j)
          expect(`story of ${at.i}, ${at.j}`, "turned off elsewhere", e);
    }
    go(n);
    return { bad, steps: n, kind: run.kind.name,
      ids: run.kind.name === "ids" ? Array.from(run.painting.at(n)) : null,
      counts: trace.counts, parts: trace.answer };
  });
}

// Whether the faces, in their colours, are the picture. Runs in the page.
function picturesDiffer([name, png]) {
  return globalThis.lesson.run(name).then(async (run) => {
    const image = new Image();
    image.src = png;
    await image.decode();
    const canvas = new OffscreenCanvas(image.width, image.height);
    const context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, image.width, image.height);
    const { faces, background } = run.header;
    let differ = 0;
    run.painting.at(run.n).forEach((id, k) => {
      const colour = id >= 0 ? faces[id][2] : background;
      const shown = `#${[0, 1, 2].map((c) =>
        data[4 * k + c].toString(16).padStart(2, "0")).join("")}`;
      if (colour !== shown) differ += 1;
    });
    return differ;
  });
}

const unrun = (runs) => runs.flatMap((x, k) =>
  k % 2 ? Array(x).fill(runs[k - 1] ?? -1) : []);

async function everyAlgorithm(file) {
  const { page, faults, go, close } = await open(file);
  await go("");
  const names = await page.evaluate(() => globalThis.lesson.names);
  const folder = dirname(file);
  const scene = folder.slice(folder.lastIndexOf("/") + 1);
  for (const name of names)
    await test(`${name} on ${scene}: forward, back, anywhere`, async () => {
      await go(`#/?a=${encodeURIComponent(name)}`);
      const seen = await page.evaluate(watched, [name, Number(stories)]);
      assert.deepEqual(seen.bad, []);
      const lines = readFileSync(join(folder, `${name}.ndjson`), "utf8").trim()
        .split("\n");
      const last = JSON.parse(lines.at(-1));
      assert.deepEqual(seen.counts, last.counts);
      assert.equal(seen.steps, last.events);
      if (seen.kind === "ids") {
        assert.deepEqual(seen.ids.map((f) => Math.max(f, -1)), unrun(last.ids));
        const png = readFileSync(join(folder, `${name}.png`)).toString("base64");
        assert.equal(await page.evaluate(picturesDiffer,
          [name, `data:image/png;base64,${png}`]), 0, "samples of hsr render");
      } else {
        assert.equal(seen.parts.length, last[seen.kind].length);
      }
      assert.deepEqual(faults, []);
    });
  await close();
  return names;
}

// --- the page ---

const step = (page) => page.evaluate(() => globalThis.lesson.state.k[0]);

async function asAReader(file, names) {
  const { page, faults, go, close } = await open(file);
  const some = names.slice(0, 3).join(",");
  const known = ["bouknight", "watkins", "newell"].filter((a) => names.includes(a));
  await go("");
  // At the end of those that are known to be wrong, crosses lie over the picture.
  const sound = await page.evaluate(async (all) => (await Promise.all(all.map((name) =>
    globalThis.lesson.run(name)))).filter((run) => !run.trace.knownWrong)
    .map((run) => run.name), names);
  const three = known.length === 3 ? known : sound.slice(0, 3);
  const words = () => page.textContent(".panel .words");

  await test("keys step, forward and back", async () => {
    await go("#/?level=step");
    await page.keyboard.press("ArrowRight");
    await page.keyboard.press(".");
    assert.equal(await step(page), 2);
    assert.equal(await page.locator(".outline [aria-current]").count(), 1);
    const said = await words();
    await page.keyboard.press("ArrowRight");
    await page.keyboard.press("ArrowLeft");
    assert.equal(await words(), said);
    await page.keyboard.press("End");
    assert.ok(await step(page) > 100);
    assert.equal(Number(await page.inputValue("input[name=number]")),
      await step(page));
    await page.keyboard.press("Home");
    assert.equal(await step(page), 0);
    await page.click(".controls summary");
    assert.match(await page.innerText(".controls"), /play and pause/);
    assert.match(await words(), /Before the first step/);
  });

  await test("rows, jumps to kinds and faces", async () => {
    await go("");
    await page.keyboard.press("Shift+ArrowRight");
    assert.ok(await step(page) > 0);
    await page.click(".more summary");
    await page.selectOption("select[name=to]", "kind:accept");
    await page.focus("h1");
    await page.keyboard.press("n");
    assert.match(await words(), /accept/);
    const face = await page.evaluate(async () => {
      const { run, state } = globalThis.lesson;
      const own = await run(state.a[0]);
      for (let k = 0; k < own.n; k++)
        for (const f of own.facesOf(k)) if (f >= 0) return String(f);
    });
    const first = await step(page);
    await page.keyboard.press("n");
    assert.ok(await step(page) > first);
    await page.keyboard.press("p");
    assert.equal(await step(page), first);
    await page.fill("input[name=number]", "17");
    await page.press("input[name=number]", "Enter");
    assert.equal(await step(page), 17);
    await page.fill("input[name=face]", face);
    await page.click("button[name=start]");
    await page.focus("h1");
    await page.keyboard.press("f");
    assert.match(await words(), new RegExp(`face ${face}\\b`, "i"));
  });

  await test("it plays and pauses, and tells only when paused", async () => {
    await go("#/?speed=80");
    await page.focus("h1");
    await page.keyboard.press(" ");
    assert.equal(await page.getAttribute(".words", "aria-live"), "off");
    await page.waitForFunction(() => globalThis.lesson.state.k[0] > 5);
    await page.keyboard.press(" ");
    assert.equal(await page.getAttribute(".words", "aria-live"), "polite");
    const k = await step(page);
    await page.waitForTimeout(100);
    assert.equal(await step(page), k);
  });

  await test("the address keeps the place", async () => {
    await go("");
    await page.click("canvas.picture", { position: { x: 200, y: 150 } });
    await page.keyboard.press("ArrowDown");
    await page.evaluate(() => globalThis.lesson.go(123));
    await page.waitForFunction(() => location.hash.includes("k=123"));
    const story = await page.textContent(".story-box h3");
    assert.match(story, /The story of/);
    await page.reload();
    await page.waitForSelector(".panel");
    assert.equal(await step(page), 123);
    assert.equal(await page.textContent(".story-box h3"), story);
    const entries = page.locator(".story button");
    const wanted = Number(await entries.first().getAttribute("data-step"));
    await entries.first().click();
    assert.equal(await step(page), wanted);
  });

  await test("algorithms beside one another go together", async () => {
    await go(`#/?a=${some}`);
    assert.equal(await page.locator(".panel").count(), Math.min(3, names.length));
    for (const by of ["share", "decided"]) {
      await page.selectOption("select[name=by]", by);
      await page.focus("h1");
      await page.keyboard.press("End");
      assert.ok(await page.evaluate(async () => {
        const { state, run } = globalThis.lesson;
        const ends = await Promise.all(state.a.map(async (a) => (await run(a)).n));
        return ends.every((n, k) => state.k[k] === n);
      }));
    }
    await page.keyboard.press("2");
    assert.equal(await page.evaluate(() => globalThis.lesson.state.lead), 1);
  });

  await test("at the end nothing lies over the picture", async () => {
    await go(`#/?a=${three[0]}&outlines=0&k=1000000000`);
    const other = await page.evaluate(async () => {
      const { run, state } = globalThis.lesson;
      const { header, width, height, painting, n, kind } = await run(state.a[0]);
      const canvas = document.querySelector(".picture");
      const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width,
        canvas.height);
      const ids = painting.at(n);
      let wrong = 0;
      for (let s = 0; s < width * height && kind.name === "ids"; s++) {
        const place = (c, many, size) => Math.floor((c + 0.5) * size / many);
        const at = 4 * (place(Math.floor(s / width), height, canvas.height) *
          canvas.width + place(s % width, width, canvas.width));
        const shown = `#${[0, 1, 2].map((c) =>
          data[at + c].toString(16).padStart(2, "0")).join("")}`;
        wrong += shown === (ids[s] < 0 ? header.background
          : header.faces[ids[s]][2]) ? 0 : 1;
      }
      return wrong;
    });
    assert.equal(other, 0);
  });

  await test("key moments, then rows, then steps", async () => {
    await go(`#/?a=${three[0]}`);
    const first = () => page.evaluate(async () => {
      const { moments, run, state } = globalThis.lesson;
      return moments(await run(state.a[0])).map((m) => m.k);
    });
    const ks = await first();
    for (const k of ks.slice(0, 3)) {
      await page.keyboard.press("ArrowRight");
      assert.equal(await step(page), k);
      assert.match(await words(), /Key moment/);
    }
    await page.keyboard.press("l");
    await page.keyboard.press("l");
    assert.equal(await page.inputValue("select[name=level]"), "step");
    await page.keyboard.press("ArrowRight");
    assert.equal(await step(page), ks[2] + 1);
  });

  await test("questions: answered by the next step, and a result at the end", async () => {
    await go(`#/?a=${three[0]}&quiz=1`);
    const asked = await page.evaluate(async () => {
      const { questions, run, state } = globalThis.lesson;
      return questions(await run(state.a[0])).map(({ k, right }) => [k, right]);
    });
    assert.ok(asked.length >= 2 && asked.length <= 8);
    for (const [n, [k, right]] of asked.entries()) {
      for (let t = 0; t < 40 && await page.isHidden(".quiz .buttons"); t++)
        await page.keyboard.press("ArrowRight");
      assert.equal(await step(page), k - 1);
      await page.evaluate(() => document.activeElement.matches(".quiz button"))
        .then((is) => assert.ok(!is, "the first answer has the focus"));
      await page.keyboard.press("ArrowRight");
      assert.equal(await step(page), k - 1, "it waits");
      const over = await page.evaluate(() => {
        const [p, q] = [".picture", ".quiz"].map((x) =>
          document.querySelector(x).getBoundingClientRect());
        return p.right > q.left && q.right > p.left && p.bottom > q.top &&
          q.bottom > p.top;
      });
      assert.ok(!over, "the question lies over the picture");
      const answer = n === 1
        ? page.locator(`.quiz .buttons button:not([data-answer="${right}"])`).first()
        : page.locator(`.quiz .buttons button[data-answer="${right}"]`);
      await answer.click();
      assert.match(await page.textContent(".quiz [role=status]"),
        n === 1 ? /^Not so\. / : /^Right\. \S+/);
      await page.click("text=Go on");
      assert.equal(await step(page), k);
    }
    await page.keyboard.press("End");
    assert.match(await page.textContent(".quiz"), new RegExp(
      `${asked.length - 1} of ${asked.length} questions answered right`));
  });

  await test("a step says who does what to whom", async () => {
    const said = await page.evaluate(async (all) => {
      if (!all.includes("newell")) return null;
      const { run, words } = globalThis.lesson;
      const newell = await run("newell");
      const numberOf = (name) =>
        newell.header.counters.findIndex((x) => x.name === name);
      const first = (name) => words(newell,
        newell.event(newell.trace.counter.indexOf(numberOf(name))));
      if (!newell.trace.counts[numberOf("circle search")]) return null;
      return ["Z sort", "minimax tests", "overlap tests", "plane tests",
        "circle search", "interchanges"].map(first);
    }, names);
    if (!said) return;
    [/by the low digit$/, /: test [23]: /, /: test 6: /, /: (test [45]|tests 4 and 5): /,
      /^The plane of piece \d+ of .* passes through piece \d+|does not pass through/,
      /^Piece .* moved to the far end of the list, before piece .*with a marker$/]
      .forEach((wanted, k) => assert.match(said[k], wanted));
  });

  await test("without JavaScript it says so", async () => {
    const bare = await open(file, { javaScriptEnabled: false });
    await bare.page.goto(addressOf(file));
    assert.match(await bare.page.innerText("main"), /needs\s+JavaScript/);
    await bare.close();
  });

  for (const [width, colorScheme] of [[1280, "light"], [390, "dark"],
    [320, "light"]])
    await test(`at ${width} pixels, ${colorScheme}`, async () => {
      const small = await open(file,
        { viewport: { width, height: 800 }, colorScheme });
      for (const hash of [`#/?a=${names[0]}&k=500&at=20,15`,
        `#/?a=${some}&k=900&at=20,15`]) {
        await small.go(hash);
        assert.deepEqual(await small.page.evaluate(blemishes), [], hash);
        assert.deepEqual(await serious(small.page), [], hash);
      }
      assert.deepEqual(small.faults, []);
      await small.close();
    });

  await test("a step and a jump are fast", async () => {
    await go(`#/?a=${names[0]}`);
    const [forward, anywhere] = await page.evaluate(async () => {
      const { go: to, run, state } = globalThis.lesson;
      const { n } = await run(state.a[0]);
      const median = (ks) => ks.map((k) => {
        const before = performance.now();
        to(k);
        return performance.now() - before;
      }).sort((a, b) => a - b)[ks.length >> 1];
      const ks = Array.from({ length: 101 }, (_, k) => k);
      return [median(ks), median(ks.map((k) => k * 7919 % n))];
    });
    console.log(`# ${forward.toFixed(1)} ms a step, ${anywhere.toFixed(1)} ms a ` +
      "jump");
    assert.ok(forward < 160 && anywhere < 1000);
  });
  await test("no errors in all this", () => assert.deepEqual(faults, []));
  await close();
}

// --- the lessons ---

// Runs in the page: the tries in which the way back to all lessons was lost. A page
// writes its address 200 ms after it has opened; it is held busy until then.
async function goOnAtOnce() {
  const rest = (ms) => new Promise((done) => { setTimeout(done, ms); });
  const lost = [];
  for (let k = 0; k < 30; k++) {
    location.hash = "#/?a=painter";
    while (!document.querySelector(".way")) await rest(5);
    const opened = performance.now();
    await rest(150);
    while (performance.now() - opened < 200 + k % 10) { /* busy */ }
    document.querySelector(".way a").click();
    await rest(300);
    if (document.querySelector(".figure-29")) continue;
    lost.push(`${k}: ${location.hash}`);
    location.hash = "#/";
    while (!document.querySelector(".figure-29")) await rest(5);
  }
  return lost;
}

async function lessons(file) {
  const { page, faults, go, close } = await open(file);
  await test("the way in leads to every lesson", async () => {
    await page.goto(addressOf(file));
    await page.waitForSelector(".figure-29");
    assert.deepEqual(await page.evaluate(blemishes), []);
    assert.deepEqual(await serious(page), []);
    const named = await page.$$eval(".figure-29 tbody a", (all) =>
      all.map((a) => a.getAttribute("href")));
    assert.equal(named.length, 16);
    await page.click(".begin");
    for (let k = 0; k < named.length; k++) {
      await page.waitForFunction((place) => document.querySelector(".way")
        ?.textContent.includes(place), `· ${k + 1} of 16`);
      if (k + 1 < named.length) await page.click(".way a:text-is('next')");
    }
    await page.click(".way a:text-is('All lessons')");
    await page.waitForSelector(".figure-29");
  });
  await test("whoever goes on while the address is written gets there", async () => {
    await page.goto("about:blank");
    await page.goto(addressOf(file));
    await page.waitForSelector(".figure-29");
    assert.deepEqual(await page.evaluate(goOnAtOnce), []);
  });
  await test("the tree of the ten and their work can be saved", async () => {
    await page.goto("about:blank");
    await page.goto(addressOf(file));
    await page.waitForSelector(".taxonomy svg");
    assert.equal(await page.locator(".taxonomy svg a").count(), 10);
    const text = await page.textContent(".survivors svg");
    for (const name of ["roberts", "appel", "loutrel", "galimberti", "schumacker",
      "newell", "warnock", "romney", "bouknight", "watkins"])
      assert.ok(text.includes(name), name);
    const { drawn, predicted } = await page.evaluate(() => {
      const { algorithms } = JSON.parse(document.querySelector("#survivors")
        .textContent);
      const steps = algorithms.flatMap((a) => a.costs.map((c) => [c.predicted,
        c.terms.reduce((sum, [n, f]) => sum + f * a.counts[n], 0)]));
      return { drawn: steps.filter(([p, m]) => p || m).length ===
          document.querySelectorAll(".survivors rect").length,
      predicted: steps.filter(([p]) => p).length ===
          document.querySelectorAll(".survivors circle").length };
    });
    assert.ok(drawn && predicted);
    for (const figure of [".taxonomy", ".survivors"]) {
      const saved = page.waitForEvent("download");
      await page.locator(`${figure} button.save`).first().click();
      const svg = readFileSync(await (await saved).path(), "utf8");
      assert.match(svg, /^<svg/);
      assert.doesNotMatch(svg, /var\(|NaN|undefined/);
    }
  });
  await test("key moments as slides, each a page of a PDF", async () => {
    await go("#/?a=newell");
    const many = await page.locator(".marks button").count();
    await page.click("text=All of these as slides");
    assert.equal(await page.locator(".slide").count(), many);
    assert.deepEqual(await serious(page), []);
    assert.ok(await page.locator(".slide .outline [aria-current]").count() > many / 2);
    const pdf = (await page.pdf({ preferCSSPageSize: true })).toString("latin1");
    const pages = pdf.match(/\/Type \/Page\b/g).length;
    assert.ok(pages >= many && pages <= many + 1, `${pages} pages for ${many}`);
    await page.click("text=Back");
    await page.waitForSelector(".panel .words");
  });
  await test("a slide has what its sentence names", async () => {
    await go("#/?a=roberts");
    await page.click("text=All of these as slides");
    const drawn = (words, path) => page.$$eval(".slide", (all, [w, p]) => all.filter((e) =>
      e.textContent.includes(w)).map((e) => e.querySelectorAll(`svg ${p}`).length),
    [words, path]);
    const dotted = 'path[stroke-dasharray="2 4"]';
    assert.deepEqual(await drawn(": two pieces left", dotted), [2]); // and its seam
    assert.deepEqual(await drawn("The edge starts as one fragment", dotted), [0]);
    const boxes = 'path[stroke-width="1.2"]';
    assert.deepEqual(await drawn("body out of the way, rows", boxes), [2]);
    assert.deepEqual(await drawn("The edge starts as one fragment", boxes), [0]);
  });
  await test("a step is saved as SVG", async () => {
    await go("#/?a=newell&k=40");
    await page.click(".more summary");
    const saved = page.waitForEvent("download");
    await page.click("text=Save this step as SVG");
    const file40 = await saved;
    assert.equal(file40.suggestedFilename(), "newell-40.svg");
    assert.match(readFileSync(await file40.path(), "utf8"), /is divided by the plane/);
  });
  const names = await page.evaluate(() => globalThis.lesson.names);
  const figures = { painter: 1, zbuffer: 1, raycast: 1, "bsp-painter": 1, roberts: 1,
    appel: 1, galimberti: 1, loutrel: 1, schumacker: 3, newell: 1, warnock: 2, romney: 1,
    bouknight: 1, watkins: 2, hzbuffer: 2, tiling: 1 };
  for (const name of names)
    await test(`${name}: its figures`, async () => {
      await go(`#/?a=${name}`);
      const wanted = figures[name] ?? 0;
      if (wanted) await page.waitForSelector(".figures figure");
      const seen = await page.$$eval(".figures figure", (all) => all.map((e) =>
        ({ drawn: e.querySelectorAll("svg *, canvas").length, html: e.innerHTML })));
      assert.equal(seen.length, wanted);
      for (const { drawn, html } of seen) {
        assert.ok(drawn > 2, html.slice(0, 200));
        assert.doesNotMatch(html, /NaN|undefined|Infinity/);
      }
    });
  await figuresShow({ test, page, go });
  for (const name of names)
    await test(`${name}: its key moments and its answer`, async () => {
      await go(`#/?a=${name}`);
      assert.deepEqual(await page.evaluate(blemishes), []);
      assert.deepEqual(await serious(page), []);
      const marks = page.locator(".marks button");
      const many = await marks.count();
      assert.ok(many >= 6 && many <= 24, `${many} moments`);
      for (let k = 0; k < many; k++) {
        await marks.nth(k).click();
        assert.equal(await step(page),
          Number(await marks.nth(k).getAttribute("data-step")));
        assert.equal(await page.textContent(".words .caption"),
          await marks.nth(k).textContent());
      }
      assert.ok(await page.isHidden(".find p"));
      await page.click(".find summary");
      assert.match(await page.innerText(".find p"), /\d/);
      assert.deepEqual(faults, []);
    });
  await fits({ test, open, file, names });
  const groups = [["bouknight", "watkins"], ["watkins", "warnock", "bouknight"],
    ["galimberti", "appel"], ["loutrel", "schumacker", "romney"],
    ["painter", "zbuffer", "bsp-painter"]];
  await fitsBeside({ test, open, file, groups });
  await close();
}

// Groups of so many, each name in one of them.
function inGroups(names, many) {
  const groups = [];
  for (let k = 0; k + many <= names.length; k += many)
    groups.push(names.slice(k, k + many));
  return groups;
}

await test("kinds of answers have names; others are refused in words", () => {
  for (const name of ["ids", "segments", "voxels"])
    assert.equal(kindNamed(name).name, name);
  assert.throws(() => kindNamed("none"), /knows no answers of the kind “none”/);
});
for (const file of files) {
  if (file.endsWith("lessons.html")) {
    await lessons(file);
    await telling({ test, open, file });
    continue;
  }
  const names = await everyAlgorithm(file);
  await telling({ test, open, file });
  if (file !== files[0]) continue;
  await asAReader(file, names);
  const groups = [2, 3].flatMap((many) => inGroups(names, many));
  await fitsBeside({ test, open, file, groups });
}
await end();
