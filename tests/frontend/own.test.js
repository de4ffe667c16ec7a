import { strict as assert } from "node:assert";
import { test } from "node:test";
import { completed, documentIn, fragmentOf, readDraft } from "../../frontend/model/own.js";

const document = { id: "a", coordinates: [{ name: "q" }] };
const keeping = (/** @type {string | null} */ kept) => ({ getItem: () => kept, setItem: () => {} });

for (const [name, kept] of /** @type {[string, unknown][]} */ ([
  ["nothing", null],
  ["a number", 3],
  ["a list", [{ document }]],
  ["a document that stands alone", document],
  ["a document that is a text", { document: "a" }],
  ["a document that is a list", { document: [document] }],
  ["no document", { document: null, text: "{", earlier: [document] }],
]))
  test(`what the browser kept is no draft if it is ${name}`, () => assert.equal(readDraft(keeping(JSON.stringify(kept))), null));

test("what the browser kept is no draft if it cannot be read", () => {
  assert.equal(readDraft(keeping("{")), null);
  assert.equal(readDraft({ ...keeping(null), getItem: () => { throw new Error("denied"); } }), null);
});

test("of a draft stays what can be one", () => {
  const draft = readDraft(keeping(JSON.stringify({ document, text: 3, earlier: [document, "b", [document], null] })));
  assert.deepEqual(draft, { document, text: null, earlier: [document] });
  assert.deepEqual(readDraft(keeping(JSON.stringify({ document, earlier: "b" }))), { document, text: null, earlier: [] });
});

test("the end of an address that is for something else is no document", async () => {
  const fragment = await fragmentOf(document);
  assert.deepEqual(await documentIn(fragment), document);
  for (const start of ["#a=", "#x=", "#S=", "?s="]) assert.equal(await documentIn(start + fragment.slice(3)), null, start);
});

test("an own scene has one name, and what is no row is passed over", () => {
  const { id, coordinates, bodies, guides, parameters } = completed({ ...document, bodies: ["x", null, [1], { name: "b" }], guides: 3, parameters: [{ name: "m", value: 2 }] });
  assert.deepEqual([id, coordinates.map(({ name }) => name), bodies, guides], ["own", ["q"], [{ name: "b" }], []]);
  assert.deepEqual(parameters, [{ unit: "", value: 2, name: "m", latex: "m" }]);
});

test("a member that the page does not know stays with the scene", () => {
  const events = [{ name: "slack", value: "q" }];
  const drawing = { vertical: "up" };
  assert.deepEqual(completed({ ...document, events, drawing }), { ...completed(document), events, drawing });
  assert.equal(completed(document).drawing, null);
});
