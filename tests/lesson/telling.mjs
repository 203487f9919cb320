// SPDX-License-Identifier: GPL-3.0-or-later
// What the pages of hsr lesson tell: all that a step names is drawn, numbers agree with
// outcomes, key moments and questions are there, texts agree with counters, and a
// projector and a phone show what matters. Used by watch.mjs.
import assert from "node:assert/strict";
import { LESSONS } from "../../reports/lesson/lessons/all.js";
import { addressOf } from "../browser.mjs";

// For every algorithm of a page.
export async function telling({ test, open, file }) {
  const { page, faults, go, close } = await open(file);
  await page.goto(addressOf(file));
  await page.waitForFunction(() => globalThis.lesson);
  const names = await page.evaluate(() => globalThis.lesson.names);
  const scene = file.split("/").at(-2);
  for (const name of names) {
    await go(`#/?a=${encodeURIComponent(name)}`);
    const seen = await page.evaluate(told, name);
    // Of a lesson of its own, most are its own, unless the scene has not half of these.
    const [general, all, ofLesson] = seen.general;
    if (name in LESSONS && 2 * (all - general - 1) >= ofLesson &&
        general > Math.max(3, all / 2))
      seen.moments.push(`${general} of ${all} are not of the lesson`);
    await test(`${name} on ${scene}: all that a step names is drawn`, () =>
      assert.deepEqual(seen.undrawn, []));
    await test(`${name} on ${scene}: numbers are as the outcomes say`, () =>
      assert.deepEqual(seen.against, []));
    await test(`${name} on ${scene}: key moments, and two minutes at most`, () => {
      assert.deepEqual(seen.moments, []);
      for (const seconds of seen.seconds) assert.ok(seconds <= 120, `${seconds} s`);
    });
    await test(`${name} on ${scene}: questions can be answered`, () =>
      assert.deepEqual(seen.questions, []));
    await test(`${name} on ${scene}: texts agree with the counters`, () =>
      assert.deepEqual(seen.texts, []));
    await test(`${name} on ${scene}: its steps as drawings`, () =>
      assert.deepEqual(seen.drawings, []));
    await test(`${name} on ${scene}: what is divided and what is kept is told`, () =>
      assert.deepEqual(seen.halves, []));
    await test(`${name} on ${scene}: tests by planes and lines, and markers, are seen`,
      () => assert.deepEqual(seen.tests, []));
    await test(`${name} on ${scene}: the words of the field are explained`, () =>
      assert.deepEqual(seen.unexplained, []));
    await test(`${name} on ${scene}: its sentences have a subject`, () =>
      assert.deepEqual(seen.sentences, []));
    await test(`${name} on ${scene}: pieces are drawn where they are cut`, () =>
      assert.deepEqual(seen.cut, []));
  }
  await test(`${scene}: printing is without errors`, async () => {
    await page.emulateMedia({ media: "print" });
    await page.pdf();
    await page.emulateMedia({ media: "screen" });
    assert.deepEqual(faults, []);
  });
  await close();
}

// Runs in the page.
function told(name) {
  const { lesson } = globalThis;
  return lesson.run(name).then((run) => {
    const { trace, header } = run;
    const out = { undrawn: [], against: [], moments: [], questions: [], texts: [],
      drawings: [], halves: [], tests: [], unexplained: [], sentences: [], cut: [],
      seconds: [] };
    const say = (list, text) => list.length < 4 && list.push(text);

    // Some events of every counter and outcome.
    const of = new Map();
    for (let k = 0; k < trace.kept; k++) {
      const key = `${trace.counter[k]},${trace.outcome[k]}`;
      if (!of.has(key)) of.set(key, []);
      of.get(key).push(k);
    }
    for (const ks of of.values())
      for (let p = 0; p < ks.length; p += Math.max(1, Math.floor(ks.length / 40))) {
        const e = run.event(ks[p]);
        for (const kind of lesson.unseen(run, e))
          say(out.undrawn, `${e.counter.name}, step ${e.k + 1}: ${kind}`);
        const found = lesson.numbersOf(run, e);
        if (found && lesson.contradicts(found))
          say(out.against, `${lesson.words(run, e)}: ${found.words}`);
        if (found && /NaN|Infinity|undefined|-\d/.test(found.words) &&
            !/column|row/.test(found.words))
          say(out.against, found.words);
      }

    // Sentences begin with a subject; a cell has a number, or a level and a place.
    for (const ks of of.values())
      for (let p = 0; p < ks.length; p += Math.max(1, Math.floor(ks.length / 10))) {
        const words = lesson.words(run, run.event(ks[p]));
        const isArea = run.kind.name === "area" && /cell \d.* of level/.test(words);
        if (isArea || !/^[A-Z]/.test(words) || /undefined|null|NaN| {2}|: :/.test(words) ||
            /\bof (?:the )?(?:cell|cube|face) -1/.test(words))
          say(out.sentences, `step ${ks[p] + 1}: ${words}`);
      }

    // The pieces that a clip polygon makes are together the polygon that it cuts, and
    // that is a piece which was made before. What is drawn is the piece.
    const area = (points) => Math.abs(points.reduce((sum, [x, y], k) => {
      const [u, v] = points[(k + 1) % points.length];
      return sum + x * v - u * y;
    }, 0)) / 2;
    // Corners have nine digits.
    const differ = (p, q, { a: { ids: [f] } }) => Math.abs(p - q) >
      1e-6 * area(header.faces[f][4]) + 1e-8 * (run.width + run.height);
    const known = new Set();
    for (let k = 0; name === "weiler-atherton" && k < trace.kept; k++) {
      const e = run.event(k), own = e.shape ?? e.part, is = e.counter.name;
      if (/^(polygons|pieces)$/.test(is) || (is === "culled" &&
          run.event(k - 1).outcome === "both")) known.add(own);
      const drawn = lesson.looks(run, e).a.filter(({ width }) => width === 0)
        .reduce((sum, { points }) => sum + area(points), 0);
      if (differ(drawn, lesson.areaOf(own), e)) say(out.cut, `step ${k + 1}: ${
        drawn} is drawn, of ${lesson.areaOf(own)}`);
      if (is !== "examinations" || e.outcome !== "divided or inside") continue;
      let sum = 0;
      for (let p = k + 1; run.event(p).counter.name === "pieces"; p++)
        sum += lesson.areaOf(run.event(p).shape);
      if (differ(sum, lesson.areaOf(own), e)) say(out.cut, `step ${k + 1}: ${sum} of ${
        lesson.areaOf(own)}`);
      if (!known.has(own) && !header.counters.some(({ name: c }, n) =>
        c === "penetrations" && trace.counts[n])) say(out.cut, `step ${k + 1}: not made`);
    }

    // Key moments: in order, within the run, each with its own words.
    const moments = lesson.moments(run);
    const own = lesson.lesson(run) ? 5 : 2;
    if (/^(octants|children)$/.test(trace.structure.gridParts) &&
        !moments.some(({ say: text }) => /octant/.test(text)))
      say(out.moments, "none is of an octant");
    if (moments.length < Math.min(own, run.n) || moments.length > 24)
      say(out.moments, `${moments.length} moments`);
    moments.forEach(({ k, say: text }, p) => {
      if (k < 1 || k > run.n || (p && k <= moments[p - 1].k))
        say(out.moments, `moment ${p} is step ${k}`);
      if (!text || moments.findIndex((m) => m.say === text) !== p)
        say(out.moments, `moment ${p}: “${text}”`);
    });
    if (moments.at(-1).k !== run.n) say(out.moments, "it does not end at the end");
    out.seconds = ["moment", "unit", "step"].map((l) => lesson.seconds(run, l));

    // Moments that any run has.
    const texts = new Set((lesson.lesson(run)?.moments ?? []).map(([text]) => text));
    out.general = [moments.filter(({ say: text }) => !texts.has(text)).length - 1,
      moments.length, texts.size];

    // Questions: the step says the answer, which is one of those offered; both
    // subjects are drawn.
    const questions = lesson.questions(run);
    if (questions.length > 8) say(out.questions, `${questions.length} questions`);
    for (const { k, text, right, answers } of questions) {
      const e = run.event(k - 1);
      if (e.outcome !== right || !answers.some(([word]) => word === right) ||
          !lesson.words(run, e).includes(right))
        say(out.questions, `step ${k}: ${text} ${right}`);
      if (lesson.unseen(run, e).length) say(out.questions, `step ${k} is not drawn`);
      if (!text.endsWith("?")) say(out.questions, text);
      // Of two edges the outcome is about the second one, which is dashed.
      if (e.a.kind === "edge" && e.b.kind === "edge" && /^(nearer|farther)$/.test(right) &&
          /^Is the solid one/.test(text)) say(out.questions, `step ${k}: ${text}`);
      if (right === "undecided" || answers.some(([word]) => word === "undecided"))
        say(out.questions, `step ${k}: nothing is decided`);
    }

    // A segment that is divided: the next comparison is of the half that is kept, or
    // of the left part.
    for (const ks of of.values())
      for (let p = 0; p < ks.length; p += Math.max(1, Math.floor(ks.length / 100))) {
        const e = run.event(ks[p]);
        const half = e.counter.key === "depth-division" && run.kind.name === "ids"
          ? lesson.searchAt(run, e.k)?.half : null;
        if (!half) continue;
        const next = run.event(e.k + 1).window, words = lesson.words(run, e);
        const isDashed = lesson.looks(run, e).where.some(({ points, dashed }) => dashed &&
          points.every(([x]) => x === half.middle));
        const isSo = half.kept ? next.x >= half.kept[0] &&
          next.x + next.width - 1 <= half.kept[1] &&
          half.kept[half.side === "left" ? 1 : 0] + 0.5 === half.middle &&
          words.includes(`the ${half.side} half`)
          : next.x === e.window.x && next.x + next.width === half.split &&
            words.includes(`divided at ${half.split}`);
        if (!isDashed || !isSo) say(out.halves, `step ${e.k + 1}: ${words}`);
      }

    // Tests 4 to 6 of a list of priority, among the key moments; and its markers.
    for (const { k } of moments) {
      const e = k <= trace.kept ? run.event(k - 1) : null;
      const test = e?.counter.key === "list-test" ? /^test ([456])/.exec(e.outcome) : null;
      const { where } = test ? lesson.looks(run, e) : {};
      if (test && test[1] < 6 && !where.some(({ closed, role }) => closed && role === "ink"))
        say(out.tests, `step ${k}: no plane`);
      if (test?.[1] === "6" && !where.some(({ dotted }) => dotted) &&
          !/on no row/.test(lesson.words(run, e))) say(out.tests, `step ${k}: no line`);
      if (e?.counter.key === "list-move" && !lesson.markers(run, e).length)
        say(out.tests, `step ${k}: no marker`);
    }

    // Texts: no number written by hand; those of the answer are counts of the run, or
    // shares and ratios of these.
    const written = lesson.lesson(run);
    if (written) {
      const texts = [written.idea, ...written.text, ...written.moments.map(([t]) => t)];
      for (const text of texts)
        if (/\d/.test(text.replace(/8 × 8|64 bits|[Tt]est \d/g, "")) ||
            /\b(fewer|less|most|more) (comparisons|spans|tests)/.test(text))
          say(out.texts, text);
      const known = new Set([run.width * run.height, run.height, header.faces.length,
        trace.structure.pieces?.length, ...trace.counts, 0]);
      const sums = new Map();
      for (let k = 0; k < trace.kept; k++) {
        const key = `${trace.counter[k]},${trace.outcome[k]}`;
        sums.set(key, (sums.get(key) ?? 0) + 1);
      }
      for (const n of sums.values()) trace.counts.forEach((c) => {
        known.add(n);
        known.add(c - n);
      });
      const area = run.accepts.reduce((sum, k) =>
        sum + trace.width[k] * trace.height[k], 0);
      const large = run.accepts.reduce((sum, k) => sum + (trace.height[k] > 1
        ? trace.width[k] * trace.height[k] : 0), 0);
      [area, large].forEach((n) => known.add(n));
      if (run.kind.name === "ids")
        known.add(Array.from(run.painting.at(run.n)).filter((f) => f >= 0).length);
      const answer = written.find[1](run).replace(/[\d.]+ %|\d+\.\d+|test \d/g, "");
      const wrong = name === "painter" ? 1 : 0; // how many samples are wrong
      const odd = (answer.match(/\d[\d,]*/g) ?? []).map((t) =>
        Number(t.replaceAll(",", ""))).filter((n) => !known.has(n));
      if (odd.length > wrong) say(out.texts, `${odd}: ${written.find[1](run)}`);
    }

    // Words of the field that its texts use.
    const FIELD = ["back face", "body", "box", "BSP", "bubble sort", "bucket", "circle",
      "clip polygon", "cluster", "concave", "contour", "convex", "crossing", "cull box",
      "disjoint", "footprint", "fragment", "front face", "frustum", "intersecter",
      "interval", "leaf", "linear programme", "logarithmic", "marker", "mask", "midpoint",
      "minimax", "obscure", "octree", "penetrate", "piece", "plane", "portal", "priority",
      "pyramid", "quadtree", "segment", "separating plane", "span", "splat",
      "surround test", "surrounder", "texel", "vertex", "volume", "voxel", "window"];
    const said = [...written?.text ?? [], ...moments.map(({ say: text }) => text),
      ...questions.map(({ text }) => text)].join(" ");
    out.unexplained = FIELD.filter((word) => new RegExp(`\\b${word}`, "i").test(said) &&
      !lesson.glossary.some(([, , pattern]) => pattern.test(word)));

    // Drawings of some steps.
    for (const { k } of moments.slice(0, 4)) {
      const text = new XMLSerializer().serializeToString(lesson.drawing(run, k));
      const parsed = new DOMParser().parseFromString(text, "image/svg+xml");
      const own = text.replace(/data:[^"]*/g, "");
      if (parsed.querySelector("parsererror") || /NaN|undefined|var\(/.test(own) ||
          parsed.querySelectorAll("text").length < 2)
        say(out.drawings, `step ${k}`);
    }
    return out;
  });
}

// On a projector and on a phone, for every lesson.
export async function fits({ test, open, file, names }) {
  const projector = await open(file, { viewport: { width: 1366, height: 657 } });
  for (const name of names)
    await test(`${name}: a projector shows what matters`, async () => {
      await projector.go(`#/?a=${name}`);
      assert.deepEqual(await projector.page.evaluate(fitting, [name,
        [".picture", ".words", ".controls .buttons", ".outline [aria-current]",
          ".strip"]]), []);
    });
  await projector.close();
  const phone = await open(file, { viewport: { width: 390, height: 844 } });
  for (const name of names)
    await test(`${name}: a phone shows the picture and the sentence first`, async () => {
      await phone.go(`#/?a=${name}`);
      assert.deepEqual(await phone.page.evaluate(fitting, [name,
        [".picture", ".words", ".controls .buttons"]]), []);
    });
  assert.deepEqual(phone.faults, []);
  await phone.close();
}

// Two and three beside one another on a projector: of each, what matters.
export async function fitsBeside({ test, open, file, groups }) {
  const projector = await open(file, { viewport: { width: 1366, height: 657 } });
  for (const group of groups)
    await test(`${group.join(", ")} beside one another: all that matters is seen`,
      async () => {
        await projector.go(`#/?a=${group.map(encodeURIComponent).join(",")}`);
        assert.equal(await projector.page.locator(".panel").count(), group.length);
        assert.deepEqual(await projector.page.evaluate(fitting, [group[0],
          [".picture", ".words", ".controls .buttons", ".outline [aria-current]",
            ".strip"]]), []);
      });
  assert.deepEqual(projector.faults, []);
  await projector.close();
}

// Runs in the page: at each key moment, what is not wholly seen.
function fitting([name, parts]) {
  const { lesson } = globalThis;
  return lesson.run(name).then((run) => {
    const bad = [];
    const look = (k, part, e) => {
      const box = e.getBoundingClientRect();
      const list = e.closest(".outline")?.getBoundingClientRect();
      const bottom = Math.min(innerHeight, list?.bottom ?? Infinity);
      const top = Math.max(0, list?.top ?? 0);
      if (box.top < top - 1 || box.bottom > bottom + 1 || box.right > innerWidth ||
          box.height < 5 || box.width < 60 || e.scrollHeight > e.clientHeight + 4)
        bad.push(`step ${k}: ${part} from ${Math.round(box.top)} to ${
          Math.round(box.bottom)} of ${Math.round(bottom)}, ${
          Math.round(box.width)} wide, ${e.scrollHeight} of ${e.clientHeight}`);
    };
    for (const { k } of lesson.moments(run)) {
      lesson.go(k);
      scrollTo(0, 0);
      for (const part of parts) {
        const all = [...document.querySelectorAll(part)];
        if (!all.length && !/aria-current|strip/.test(part)) bad.push(`no ${part}`);
        all.forEach((e) => look(k, part, e));
      }
    }
    return bad.slice(0, 4);
  });
}
