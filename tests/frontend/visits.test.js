import { strict as assert } from "node:assert";
import { test } from "node:test";
import { HOME, readPlace, writePlace } from "../../frontend/model/url.js";
import { createVisits } from "../../frontend/model/visits.js";

/** The history of a browser tab, as far as it is asked; `gone` counts ways out of the page. */
function browser() {
  const entries = [{ state: /** @type {any} */ (null), address: "?scene=swing&step=a" }];
  let at = 0;
  return {
    get state() {
      return entries[at].state;
    },
    pushState: (/** @type {any} */ state, /** @type {any} */ _, /** @type {any} */ address) => entries.splice(++at, Infinity, { state, address }),
    replaceState: (/** @type {any} */ state, /** @type {any} */ _, /** @type {any} */ address) => void (entries[at] = { state, address }),
    back: () => void at--,
    forward: () => void (at = Math.min(at + 1, entries.length - 1)),
    addresses: () => entries.map(({ address }) => address),
    here: () => entries[at]?.address,
  };
}

/** A page that writes down places, each so many milliseconds after the one before. @param {[number, Partial<import("../../frontend/model/types.js").Address>][]} changes @param {{embedded?: boolean}} [page] */
function visited(changes, page) {
  const past = browser();
  let time = 0;
  const visits = createVisits(past, () => time, page);
  /** @type {any} */
  let place = { ...HOME, scene: "swing", step: "a" };
  const keep = (/** @type {number} */ later, /** @type {any} */ patch) => {
    time += later;
    place = { ...place, ...patch };
    visits.keep(place, writePlace(place));
  };
  const returned = () => visits.returned((place = readPlace(past.here())));
  keep(0, {});
  for (const [later, patch] of changes) keep(later, patch);
  return { past, visits, keep, returned };
}

test("what stands in the address already is not written again, unless the page has been somewhere else", () => {
  const { past, keep, returned } = visited([[2000, { step: "b" }]]);
  const written = /** @type {string[]} */ ([]);
  past.replaceState = (/** @type {any} */ _state, /** @type {any} */ _, /** @type {any} */ address) => void written.push(address);
  keep(20, {});
  keep(2000, {});
  assert.equal(written.length, 0);
  past.back();
  returned();
  keep(20, {});
  assert.deepEqual(written, [FIRST]);
});

const FIRST = "?scene=swing&step=a";
for (const [name, changes, entries] of /** @type {[string, [number, any][], string[]][]} */ ([
  ["each step is an entry", [[2000, { step: "b" }], [2000, { step: "c" }]], [FIRST, "?scene=swing&step=b", "?scene=swing&step=c"]],
  ["a drag is one", [[2000, { set: "l:1" }], [20, { set: "l:2" }], [20, { set: "l:3" }]], [FIRST, "?scene=swing&step=a&set=l:3"]],
  ["two drags are two", [[2000, { set: "l:1" }], [20, { set: "l:2" }], [2000, { set: "l:3" }]], [FIRST, "?scene=swing&step=a&set=l:2", "?scene=swing&step=a&set=l:3"]],
  ["a step soon after a value is its own", [[2000, { set: "l:1" }], [20, { step: "b" }]], [FIRST, "?scene=swing&step=a&set=l:1", "?scene=swing&step=b&set=l:1"]],
  ["the first step of a new scene belongs to it", [[2000, { scene: "top", step: "" }], [900, { step: "x" }]], [FIRST, "?scene=top&step=x"]],
  ["how it looks and what is played are no entries", [[2000, { theme: "dark" }], [2000, { speed: 2 }], [2000, { at: 3 }]], ["?scene=swing&step=a&theme=dark&speed=2&at=3"]],
  ["method, principle, links and view are", [[900, { method: "rk4" }], [900, { formulation: "hamilton" }], [900, { n: 4 }], [900, { view: "lecture" }]],
    [FIRST, `${FIRST}&method=rk4`, `${FIRST}&method=rk4&formulation=hamilton`, `${FIRST}&method=rk4&n=4&formulation=hamilton`, `${FIRST}&method=rk4&n=4&formulation=hamilton&view=lecture`]],
])) {
  test(name, () => assert.deepEqual(visited(changes).past.addresses(), entries));
}

test("a page in another page leaves no entries", () => {
  assert.deepEqual(visited([[2000, { step: "b" }], [2000, { step: "c" }]], { embedded: true }).past.addresses(), ["?scene=swing&step=c"]);
});

test("undo goes back as far as the page has come, and no further", () => {
  const { past, visits, returned } = visited([[2000, { step: "b" }], [2000, { set: "l:1" }]]);
  const seen = [1, 2, 3, 4].map(() => (visits.undo(), returned(), past.here()));
  assert.deepEqual(seen, ["?scene=swing&step=b", FIRST, FIRST, FIRST]);
  visits.redo();
  assert.equal(past.here(), "?scene=swing&step=b");
});

test("a change after going back is a new entry, however soon", () => {
  const { past, visits, keep, returned } = visited([[2000, { set: "l:1" }], [2000, { set: "l:2" }]]);
  visits.undo();
  returned();
  keep(5, {});
  keep(5, { set: "l:3" });
  assert.deepEqual(past.addresses(), [FIRST, "?scene=swing&step=a&set=l:1", "?scene=swing&step=a&set=l:3"]);
});
