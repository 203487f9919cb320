// SPDX-License-Identifier: GPL-3.0-or-later
// A seat is a worker with the core in it, which does one thing at a time. It keeps
// the scene that it was last asked about, and the algorithm that is ready to draw
// it.
//
// What is asked waits in one of three rows. "must" is always done. Of "draw" and of
// "after" the latest alone is done, and a new drawing makes the wish for what was to
// come after an old one void. The promise of what is left out gives undefined.

const STOPPED = 7; // as hsr.h has it
// ms after which work that nobody waits for any more is ended. A new worker has to open
// the scene anew, so pictures that move are given time.
const SLOW = 400, SLOW_MOVING = 2500;
const ROWS = ["must", "draw", "after"];

// connect(): a new client of the core.
export function seat(connect) {
  let own = null, scene = null, drawer = null, running = null, since = 0;
  const rows = { must: [], draw: [], after: [] };
  const client = () => own ??= connect();

  // --- What waits ---

  const leaveOut = (row) => rows[row].splice(0).forEach(({ give }) => give(undefined));

  function enqueue(row, work, patience = SLOW) {
    if (row !== "must") leaveOut("after");
    if (row === "draw") leaveOut("draw");
    if (row === "draw" && running && running.row !== "must" &&
        performance.now() - since > running.patience) client().stop();
    return new Promise((give, fail) => {
      rows[row].push({ row, work, patience, give, fail });
      if (!running) advance();
    });
  }

  function advance() {
    const row = ROWS.find((name) => rows[name].length);
    const item = running = row ? rows[row].shift() : null;
    if (!item) return;
    since = performance.now();
    item.work().then(item.give, (error) => error.status === STOPPED
      ? item.give(undefined) : item.fail(error)).finally(advance);
  }

  // --- What is open ---

  // subject: { key, open(client) -> promise of a scene }
  async function opened(subject) {
    if (scene?.key === subject.key) return scene;
    await release();
    const old = scene;
    scene = null;
    if (old) await client().close(old.id);
    return scene = { ...await subject.open(client()), key: subject.key };
  }

  async function release() {
    const old = drawer;
    drawer = null;
    if (old) await client().release(old.id);
  }

  async function ready(subject, algorithm) {
    const { id } = await opened(subject);
    if (drawer?.algorithm !== algorithm) {
      await release();
      drawer = { algorithm, id: await client().prepare(id,
        { algorithm, counts: true }) };
    }
    return drawer.id;
  }

  // does(client, number of the scene, what the core says of it)
  const ask = (row) => (subject, does) => enqueue(row, async () => {
    const open = await opened(subject);
    return does(client(), open.id, open);
  });

  return {
    // Draws by an algorithm that stays ready, for pictures that move.
    redraw: (subject, request) => enqueue("draw", async () =>
      client().redraw(await ready(subject, request.algorithm), request), SLOW_MOVING),
    // Draws as if nothing had been drawn before.
    draw: (subject, request) => enqueue("draw", async () =>
      client().draw((await opened(subject)).id, request)),
    must: ask("must"), ask: ask("draw"), after: ask("after"),
    lists: (does) => enqueue("must", () => does(client())),
    stop: () => own?.stop(),
  };
}
