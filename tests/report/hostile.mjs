// SPDX-License-Identifier: GPL-3.0-or-later
// node hostile.mjs FILE: writes results, in the form of hsr bench, whose names
// and fields try to break the page: markup, scripts, ends of lines, escape
// sequences, words that objects have anyway, and values of other types.
import { writeFileSync } from "node:fs";

const [file] = process.argv.slice(2);
const ATTACK = "window.attacked = true";
const NAMES = [
  `</script><script>${ATTACK}</script>`,
  `<img src=x onerror="${ATTACK}">`,
  `"><svg onload='${ATTACK}'>`,
  `javascript:${ATTACK}`,
  `line 1\nline 2\r\nline 3\ttab`,
  "\u001b[31mred\u001b[0m\u0007\u0008",
  "\u2028\u2029\u202eback\u202c\ufeff",
  "*/ `${window.attacked = 1}` // '\\",
  `=HYPERLINK("http://127.0.0.1/","x")`,
  "__proto__", "constructor", "hasOwnProperty", "toString",
  "../../../../etc/passwd", "/dev/zero", "house:1e309", "mesh:", "%s%n%c1",
  "é".repeat(150),
];
const TYPES = [null, true, -1, 1e308, "text", [], [[]], {}, { length: 3 }];
const any = (k) => TYPES[k % TYPES.length];

const header = (k) => ({ schema: "hsr-bench/1", record: "header",
  run: NAMES[k], date: NAMES[k], command: k % 2 ? NAMES : any(k),
  version: NAMES[k], commit: any(k), code: NAMES[k], compiler: NAMES[k],
  flags: NAMES[k], seed: any(k), starts: any(k), repetitions: NAMES[k],
  timeout: any(k), memory_mb: any(k), machine: k % 3 ? { cpu: NAMES[k],
    cores: NAMES[k], threads: any(k), memory_kb: NAMES[k],
    caches: k % 2 ? [any(k), NAMES[k]] : NAMES[k], os: NAMES[k],
    governor: NAMES[k], load: k % 2 ? [NAMES[k], any(k)] : NAMES[k] }
    : any(k) });
const place = (scene, k) => ({ scene, view: 1, width: 32, height: 24 + k });
const view = (scene, k) => ({ record: "view", run: "0", scene_hash: scene,
  ...place(scene, k), table1: k % 2 ? { F_r: any(k), F_t: NAMES[k],
    __proto__: null, [NAMES[k]]: any(k) } : any(k) });
const cell = (scene, algorithm, k) => ({ record: "cell", run: "0",
  ...place(scene, k % 3), algorithm, peer: k % 2 ? k % 4 === 1 : any(k),
  known_wrong: false, kind: k % 3 ? "ids" : NAMES[k % NAMES.length], threads: 1,
  status: ["ok", "wrong", "crash", NAMES[k % NAMES.length], any(k)][k % 5],
  mismatches: any(k), compared: any(k + 1), reason: NAMES[k % NAMES.length],
  adapted: k % 2 ? NAMES : any(k), depths: any(k),
  counts: k % 2 ? JSON.parse(`{"__proto__": 3, "spans": 5, ${
    JSON.stringify(NAMES[k % NAMES.length])}: 7, "constructor": "x"}`) : any(k),
  starts: k % 3 ? [{ seconds: [1 + k, 2], phases: { import: NAMES[0] } },
    { seconds: [1, 2 + k] }] : [] });

// A line of JSON escapes all that would end it.
const records = [...NAMES.map((_, k) => header(k)),
  ...NAMES.flatMap((scene, k) => [view(scene, k % 3),
    ...["watkins", "zbuffer-fast", ...NAMES.filter((name) => name.length < 99)]
      .map((name, i) => cell(scene, name, k + i))]),
  { ...view("house", 0) }, { ...cell("house", "watkins", 1), status: "ok" }];
writeFileSync(file, records.map((r) => `${JSON.stringify(r)}\n`).join(""));
