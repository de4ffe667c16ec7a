import { strict as assert } from "node:assert";
import { test } from "node:test";
import { ask, curlOf, draftIn, draftOf, fragmentOf, readable, sendingOf } from "../../frontend/model/trial.js";

const input = { text: "", required: true, choices: [] };
/** @type {import("../../frontend/model/reference.js").Call} */
const READ = {
  id: "read", method: "GET", path: "/things/{name}/parts", text: "", fields: [], type: "", examples: [], answers: [],
  inputs: [{ ...input, name: "name", place: "path", example: "a b" }, { ...input, name: "most", place: "query", required: false, example: "" }],
};
/** @type {import("../../frontend/model/reference.js").Call} */
const WRITE = { ...READ, id: "write", method: "POST", path: "/things", inputs: [], type: "application/json", examples: ['{\n  "name": "it\'s"\n}', "{}"] };
const ASIDE = new AbortController().signal;

test("a request has what stands in the fields, written so that an address can hold it", () => {
  const draft = draftOf(READ);
  assert.deepEqual(sendingOf(READ, draft), { address: "/things/a%20b/parts", options: { method: "GET" } });
  const more = { ...draft, values: { name: "x/y", most: "3" } };
  assert.equal(sendingOf(READ, more).address, "/things/x%2Fy/parts?most=3");
  assert.deepEqual(sendingOf(WRITE, draftOf(WRITE, 1)).options, { method: "POST", headers: { "content-type": "application/json" }, body: "{}" });
});

test("a line for a shell says the same, whatever the body holds", () => {
  assert.equal(curlOf(READ, draftOf(READ)), 'curl "$DELTAQ/things/a%20b/parts"');
  assert.equal(curlOf(WRITE, draftOf(WRITE)), `curl "$DELTAQ/things" -H 'content-type: application/json' \\\n  --data-binary '{"name":"it'\\''s"}'`);
  assert.match(curlOf(WRITE, { values: {}, body: "{ broken" }), /'\{ broken'$/);
});

test("an address holds the call and only what was changed of its example; without a call it means the first with an example", () => {
  const calls = [READ, WRITE];
  assert.equal(fragmentOf(WRITE, draftOf(WRITE)), "#write");
  const drafts = [{ values: { name: "ü?&#", most: "" }, body: "" }, { values: {}, body: '{"a": "100 %"}\n' }];
  drafts.forEach((draft, i) => assert.deepEqual(draftIn(calls, fragmentOf(calls[i], draft)), { call: calls[i], draft }));
  assert.equal(draftIn(calls, "#nothing?name=x").call, WRITE);
});

test("answers are told with status and size; JSON in lines, the rest as it came, very long ones cut", async () => {
  let time = 0;
  const sent = /** @type {any} */ (async () => new Response('{"ä":1}', { status: 422 }));
  const answer = await ask(sent, { address: "/", options: { method: "GET" } }, ASIDE, () => (time += 5));
  assert.deepEqual(answer, { status: 422, milliseconds: 5, bytes: 8, text: '{\n  "ä": 1\n}', cut: 0 });
  const failing = /** @type {any} */ (async () => { throw new TypeError("no network"); });
  assert.equal(await ask(failing, { address: "/", options: { method: "GET" } }, ASIDE, () => 0), null);
  assert.equal(readable('{"t":[0,-1.5e-9,null],"to":["a"]}').text, '{\n  "t": [ 0, -1.5e-9, null ],\n  "to": [\n    "a"\n  ]\n}');
  assert.deepEqual(readable("<a/>"), { text: "<a/>", cut: 0 });
  assert.deepEqual(readable("x".repeat(60_007)).cut, 7);
});
