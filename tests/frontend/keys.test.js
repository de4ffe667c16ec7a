import { strict as assert } from "node:assert";
import { test } from "node:test";
import { KEYS, labelOf } from "../../frontend/model/keys.js";
import { listen, table } from "../../frontend/view/keys.js";

const told = KEYS.flatMap(([names]) => names);

test("every key of the page is told once", () => {
  const meant = Object.keys(table(/** @type {any} */ ({})));
  assert.deepEqual(meant.filter((key) => !told.includes(key)), []);
  assert.equal(new Set(told).size, told.length);
});

test("keys are called by what stands on them", () => {
  const t = (/** @type {string} */ key) => `<${key}>`;
  assert.deepEqual(told.filter((key) => key.length > 1 || key === " ").map((key) => labelOf(key, t)), [
    "→", "<key.space>", "<key.page-down>", "←", "<key.page-up>", "<key.home>", "<key.end>", "<key.escape>", "↓", "↑", "<key.undo>", "<key.redo>", "<key.enter>",
  ]);
  assert.deepEqual(["w", ".", "?"].map((key) => labelOf(key, t)), ["W", ".", "?"]);
});

/** A document that hears a key; what it leads to. @param {Partial<KeyboardEvent> & {inside?: string}} pressed */
function heard({ inside = "", ...pressed }) {
  /** @type {string[]} */
  const done = [];
  /** @type {(event: unknown) => void} */
  let hear = () => {};
  globalThis.Element = /** @type {any} */ (class { closest = (/** @type {string} */ among) => among.split(", ").includes(inside) ? this : null; });
  const keys = { undo: () => done.push("undo"), redo: () => done.push("redo"), covered: () => false, go: () => done.push("go"), more: () => ({}) };
  listen(/** @type {any} */ ({ addEventListener: (/** @type {string} */ _, /** @type {any} */ take) => (hear = take) }), /** @type {any} */ (keys));
  hear({ ctrlKey: false, metaKey: false, altKey: false, shiftKey: false, target: new Element(), preventDefault: () => done.push("ours"), ...pressed });
  return done;
}

test("a key pressed before its meaning has come is done once it has", () => {
  /** @type {string[]} */
  const done = [];
  /** @type {(event: unknown) => void} */
  let hear = () => {};
  let waiting = true;
  globalThis.Element = /** @type {any} */ (class {});
  const more = () => (waiting ? {} : { q: () => done.push("q") });
  const keys = { covered: () => false, go: () => done.push("go"), more, waiting: () => waiting };
  const target = { addEventListener: (/** @type {string} */ _, /** @type {any} */ take) => (hear = take) };
  const pressEarly = listen(/** @type {any} */ (target), /** @type {any} */ (keys));
  for (const key of ["q", "n", "x"]) hear({ key, target: null, preventDefault() {} });
  assert.deepEqual(done, []);
  waiting = false;
  pressEarly();
  pressEarly();
  hear({ key: "q", target: null, preventDefault() {} });
  assert.deepEqual(done, ["q", "go", "q"]);
});

for (const [pressed, done] of /** @type {[any, string[]][]} */ ([
  [{ key: "z", ctrlKey: true }, ["ours", "undo"]],
  [{ key: "z", metaKey: true }, ["ours", "undo"]],
  [{ key: "Z", ctrlKey: true, shiftKey: true }, ["ours", "redo"]],
  [{ key: "y", ctrlKey: true }, ["ours", "redo"]],
  [{ key: "z", ctrlKey: true, altKey: true }, []],
  [{ key: "z", ctrlKey: true, inside: "textarea" }, []],
  [{ key: "x", ctrlKey: true }, []],
  [{ key: "z" }, []],
  [{ key: "n" }, ["ours", "go"]],
])) {
  test(`${JSON.stringify(pressed)} does ${done.join()}`, () => assert.deepEqual(heard(pressed), done));
}
