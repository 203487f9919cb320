// SPDX-License-Identifier: GPL-3.0-or-later
// The functions of core.js as promises: a Worker does the work. It is started when it is
// first needed. stop() ends it, whatever it does; the next call starts another, which
// opens anew what it is asked about. So ids of scenes and drawers stay valid.

const CALLS = ["builtins", "kinds", "algorithms"];
const OF_SCENES = ["geometry", "draw", "judge", "judgeAlgorithm", "steps", "table1",
  "predicted", "why"];
const STOPPED = 7, INTERNAL = 5;

export class HsrError extends Error {
  constructor({ status, text }) {
    super(text);
    Object.assign(this, { name: "HsrError", status, text });
  }
}

// { wasm: bytes, or module: compiled; worker: where its script is }, or a promise of that.
// Each of these may be a promise itself: the Worker starts while the module is compiled.
// The script is a module, or one file if it is a blob.
export function connect(parts) {
  let running = null; // { worker, loaded, waiting }
  let next = 0;
  const opened = new Map();  // id -> { call, args, of, own, on }
  const load = async (on) => {
    const { worker, wasm, module } = await parts;
    const script = await worker;
    if (on.ended) throw new HsrError(on.ended);
    on.worker = start(script, on);
    return ask(on, "load", [{ wasm: await wasm, module: await module }]);
  };

  function start(url, on) {
    const isBlob = String(url).startsWith("blob:");
    const worker = new Worker(url, isBlob ? {} : { type: "module" });
    worker.onmessage = ({ data: { id, value, error } }) => {
      const { give, fail } = on.waiting.get(id);
      on.waiting.delete(id);
      if (error) fail(new HsrError(error)); else give(value);
      if (error?.isFatal) end(on, error);
    };
    worker.onerror = (event) => end(on, { status: INTERNAL,
      text: `the core has ended: ${event.message ?? "its worker failed"}` });
    return worker;
  }

  // Ends a Worker. What it was asked fails.
  function end(on, error) {
    if (running === on) running = null;
    on.ended = error;
    on.worker?.terminate();
    for (const { fail } of on.waiting.values()) fail(new HsrError(error));
    on.waiting.clear();
  }

  function ask(on, call, args) {
    if (on.ended) return Promise.reject(new HsrError(on.ended));
    return new Promise((give, fail) => {
      const id = next++;
      on.waiting.set(id, { give, fail });
      on.worker.postMessage({ id, call, args });
    });
  }

  async function started() {
    if (!running) {
      const on = running = { waiting: new Map(), worker: null, ended: null };
      on.loaded = load(on);
      on.loaded.catch(() => { if (running === on) running = null; });
    }
    const on = running;
    await on.loaded;
    return on;
  }

  // --- What is open ---

  // What the Worker calls a scene or a drawer, which it opens if it has not yet.
  function own(on, id) {
    const one = opened.get(typeof id === "object" ? id.id : id);
    if (!one) throw new HsrError({ status: 2, text: "it is not open" });
    if (one.on !== on) {
      one.on = on;
      one.own = (async () => {
        const first = one.of === null ? [] : [await own(on, one.of)];
        return idIn(await ask(on, one.call, [...first, ...one.args]));
      })();
      one.own.catch(() => { one.on = null; });
    }
    return one.own;
  }
  const idIn = (value) => typeof value === "object" ? value.id : value;

  // Opens it now; gives what the core said of it, with the id that it has here.
  async function open(call, of, args) {
    const on = await started();
    const first = of === null ? [] : [await own(on, of)];
    const value = await ask(on, call, [...first, ...args]);
    const id = ++next;
    opened.set(id, { call, args, of: of === null ? null : idIn(of), on,
      own: Promise.resolve(idIn(value)) });
    return typeof value === "object" ? { ...value, id } : id;
  }

  async function close(call, id) {
    const key = idIn(id), one = opened.get(key);
    opened.delete(key);
    if (one && running && one.on === running) await ask(running, call, [await one.own]);
  }

  const about = (call) => async (id, ...args) => {
    const on = await started();
    return ask(on, call, [await own(on, id), ...args]);
  };

  return {
    get version() { return started().then((on) => on.loaded); },
    ...Object.fromEntries(CALLS.map((call) => [call, async () =>
      ask(await started(), call, [])])),
    ...Object.fromEntries(OF_SCENES.map((call) => [call, about(call)])),
    open: (what) => open("open", null, [what]),
    openArrays: (what) => open("openArrays", null, [what]),
    close: (scene) => close("close", scene),
    prepare: (scene, what) => open("prepare", scene, [what]),
    redraw: about("redraw"),
    release: (drawer) => close("release", drawer),
    stop: () => { if (running) end(running, { status: STOPPED, text: "stopped" }); },
  };
}
