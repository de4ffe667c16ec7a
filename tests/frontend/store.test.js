import { strict as assert } from "node:assert";
import { test } from "node:test";
import { createStore } from "../../frontend/model/store.js";

test("listeners hear of several changes once, and of no change never", () => {
  /** @type {(() => void)[]} */
  const tasks = [];
  const store = createStore({ a: 1, b: 1 }, (task) => tasks.push(task));
  /** @type {object[]} */
  const heard = [];
  store.subscribe((state) => heard.push(state));
  store.set({ a: 1 });
  assert.equal(tasks.length, 0);
  store.set({ a: 2 });
  store.set({ b: 3 });
  assert.equal(tasks.length, 1);
  tasks[0]();
  assert.deepEqual(heard, [{ a: 2, b: 3 }]);
});

test("states are not changed in place", () => {
  const store = createStore({ a: 1 }, () => {});
  const before = store.get();
  store.set({ a: 2 });
  assert.deepEqual([before, store.get()], [{ a: 1 }, { a: 2 }]);
});

test("who listens hears of every later change as well, until one has had enough", () => {
  /** @type {(() => void)[]} */
  const tasks = [];
  const store = createStore({ a: 1 }, (task) => tasks.push(task));
  /** @type {number[]} */
  const heard = [];
  const stop = store.subscribe(({ a }) => heard.push(a));
  for (const a of [2, 3]) {
    store.set({ a });
    tasks.splice(0).forEach((task) => task());
  }
  stop();
  store.set({ a: 4 });
  tasks.splice(0).forEach((task) => task());
  assert.deepEqual([heard, store.get().a], [[2, 3], 4]);
});
