import { strict as assert } from "node:assert";
import { test } from "node:test";
import { arranged, placed, stepFrom, textOf } from "../../frontend/model/homework/ordering.js";

const blocks = [..."abcd"].map((id) => ({ id, title: id, announced: id, latex: "", marked: "", spoken: "" }));
/** @param {import("../../frontend/model/homework/ordering.js").Arrangement} arrangement */
const shown = ({ used, left }) => `${used.map(({ id }) => id).join("")}|${left.map(({ id }) => id).join("")}`;

for (const [text, expected] of /** @type {const} */ ([
  ["", "abcd|"],
  ["c; a; b; d", "cabd|"],
  ["c; a", "ca|bd"],
  ["C, A", "ca|bd"],
  ["c; c; a", "ca|bd"],
  ["x; c; y^2", "c|abd"],
  ["m*l^2", "abcd|"],
])) test(`"${text}" arranges the blocks`, () => assert.equal(shown(arranged(blocks, text)), expected));

for (const [text, id, place, expected] of /** @type {const} */ ([
  ["a;b;c;d", "a", 2, "bcad|"],
  ["a;b;c;d", "d", 0, "dabc|"],
  ["a;b;c;d", "b", null, "acd|b"],
  ["c;d", "c", null, "d|abc"],
  ["c;d", "a", 1, "cad|b"],
  ["c;d", "a", 2, "cda|b"],
  ["c", "c", null, "c|abd"],
  ["c", "b", null, "c|abd"],
  ["c", "x", 0, "c|abd"],
])) test(`${id} of ${text} comes to ${place}`, () => assert.equal(shown(placed(arranged(blocks, text), id, place)), expected));

/** @type {(text: string, id: string, by: -1 | 1) => string | undefined} */
function stepped(text, id, by) {
  const arrangement = arranged(blocks, text);
  const place = stepFrom(arrangement, id, by);
  return place === undefined ? undefined : textOf(placed(arrangement, id, place));
}

test("a step leads past one block, or out of the order and into it again", () => {
  assert.equal(stepped("a;b;c;d", "b", -1), "b; a; c; d");
  assert.equal(stepped("a;b;c;d", "b", 1), "a; c; b; d");
  assert.equal(stepped("a;b;c;d", "a", -1), undefined);
  assert.equal(stepped("a;b;c;d", "d", 1), "a; b; c");
  assert.equal(stepped("a;b;c", "d", -1), "a; b; c; d");
  assert.equal(stepped("a;b;c", "d", 1), undefined);
  assert.equal(stepped("a", "a", 1), undefined);
});

test("steps lead to every arrangement, and nowhere else", () => {
  const seen = new Set(["a; b; c; d"]);
  for (const text of seen)
    for (const { id } of blocks)
      for (const by of /** @type {const} */ ([-1, 1])) {
        const next = stepped(text, id, by);
        if (next !== undefined) seen.add(next);
      }
  // 4 + 4·3 + 4·3·2 + 4·3·2·1 orders of some of four
  assert.equal(seen.size, 64);
});
