import { strict as assert } from "node:assert";
import { test } from "node:test";
import { latestOnly, newest } from "../../frontend/model/latest.js";

/** A clock that waits by moving itself on. */
function steppedTime() {
  let now = 0;
  return {
    now: () => now,
    wait: async (/** @type {number} */ ms) => {
      now += ms;
    },
  };
}

const settled = () => new Promise((done) => setTimeout(done, 5));

test("of many wishes the first and the last are fulfilled", async () => {
  /** @type {number[]} */
  const done = [];
  const queue = latestOnly(async (/** @type {number} */ wish) => void done.push(wish), 100, steppedTime());
  queue.ask(1);
  await settled();
  [2, 3, 4].forEach(queue.ask);
  await settled();
  assert.deepEqual(done, [1, 4]);
});

test("an offer gives way to what waits, and is taken up where nothing does", async () => {
  /** @type {string[]} */
  const done = [];
  /** @type {ReturnType<typeof latestOnly<string>>} */
  const queue = latestOnly(async (wish) => {
    done.push(wish);
    if (wish === "first") queue.ask("newer");
    if (wish !== "offer") queue.offer("offer");
  }, 0, steppedTime());
  queue.ask("first");
  await settled();
  assert.deepEqual(done, ["first", "newer", "offer"]);
});

test("a wish that fails does not keep those after it waiting", async () => {
  /** @type {string[]} */
  const done = [];
  const queue = latestOnly(async (/** @type {string} */ wish) => {
    if (wish === "bad") throw new TypeError(wish);
    done.push(wish);
  }, 0, steppedTime());
  await assert.rejects(queue.ask("bad"), new TypeError("bad"));
  await queue.ask("good");
  assert.deepEqual(done, ["good"]);
});

test("starts are a pause apart", async () => {
  const time = steppedTime();
  /** @type {number[]} */
  const starts = [];
  const queue = latestOnly(async () => void starts.push(time.now()), 100, time);
  for (const wish of [1, 2, 3]) {
    queue.ask(wish);
    await settled();
  }
  assert.deepEqual(starts, [0, 100, 200]);
});

test("only one runs at a time", async () => {
  let running = 0;
  let most = 0;
  const queue = latestOnly(async () => {
    most = Math.max(most, ++running);
    await settled();
    running -= 1;
  }, 0, steppedTime());
  [1, 2, 3].forEach(queue.ask);
  await settled();
  queue.ask(4);
  await new Promise((done) => setTimeout(done, 40));
  assert.equal(most, 1);
});

test("cancelling aborts what runs and forgets what waits", async () => {
  /** @type {[number, AbortSignal][]} */
  const begun = [];
  const queue = latestOnly(async (/** @type {number} */ wish, signal) => {
    begun.push([wish, signal]);
    await settled();
  }, 0, steppedTime());
  queue.ask(1);
  await Promise.resolve();
  queue.ask(2);
  await Promise.resolve();
  queue.cancel();
  await settled();
  await settled();
  assert.deepEqual(begun.map(([wish, signal]) => [wish, signal.aborted]), [[1, true]]);
  queue.ask(3);
  await settled();
  assert.equal(begun.at(-1)?.[1].aborted, false);
});

test("of signals the last one stands: each new one aborts the one before", () => {
  const next = newest();
  const signals = [next(), next(), next()];
  assert.deepEqual(signals.map(({ aborted }) => aborted), [true, true, false]);
});
