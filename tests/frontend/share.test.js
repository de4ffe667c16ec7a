import { strict as assert } from "node:assert";
import { test } from "node:test";
import { createExports, frameAddress, pathOf, proofFrameAddress, snippet } from "../../frontend/model/share.js";
import { createStore } from "../../frontend/model/store.js";
import { START } from "../../frontend/model/state.js";
import { HOME } from "../../frontend/model/url.js";

const place = { ...HOME, scene: "pendulum", step: "position:bob", view: /** @type {const} */ ("lecture"), panel: /** @type {const} */ ("plots") };

test("a frame shows the place, without what belongs to the page alone", () => {
  assert.equal(frameAddress("https://dq.example", place, "", ""), "https://dq.example/embed?scene=pendulum&step=position:bob");
  assert.equal(frameAddress("https://dq.example", HOME, "figure", "#s=x"), "https://dq.example/embed?show=figure#s=x");
});

test("a frame shows the proof at its step, without what belongs to a page", () => {
  assert.equal(proofFrameAddress("https://dq.example", { ...place, step: "product-rule", lang: "de" }), "https://dq.example/embed/proof?step=product-rule&lang=de");
});

test("a scene's own words stay words in HTML", () => {
  const html = snippet('https://x/embed?a=1&b="', "", 'Pendulum"><script>alert(1)</script>');
  assert.ok(html.startsWith('<iframe src="https://x/embed?a=1&amp;b=&quot;" title="Pendulum&quot;&gt;&lt;script&gt;'));
  assert.equal(html.match(/</g)?.length, 2);
});

test("the path of a code has a square for each module that is on", () => {
  assert.equal(pathOf({ size: 2, get: (x, y) => x === y }), "M0 0h1v1h-1zM1 1h1v1h-1z");
});

/** @param {number} status @param {string} body @param {Record<string, string>} headers @returns {any} */
const answering = (status, body, headers) => async () => new Response(body, { status, headers });

test("a file has the name the server gives it; a failure is kept until the next file", async () => {
  const store = createStore({ ...START, place });
  const failing = createExports(answering(504, '{"title": "too large", "detail": "Too large."}', {}), store);
  assert.equal(await failing("latex"), null);
  assert.equal(store.get().failures.export?.detail, "Too large.");
  const headers = { "content-disposition": 'attachment; filename="pendulum.tex"', "content-type": "application/x-tex" };
  const file = await createExports(answering(200, "text", headers), store)("latex");
  assert.deepEqual(file, { text: "text", name: "pendulum.tex", type: "application/x-tex" });
  assert.equal(store.get().failures.export, null);
});

test("a file tells what holds the released, as the page does", async () => {
  const bodies = /** @type {any[]} */ ([]);
  const send = async (/** @type {any} */ _, /** @type {any} */ options) => (bodies.push(JSON.parse(options.body)), new Response("text"));
  await createExports(/** @type {any} */ (send), createStore({ ...START, place: { ...place, release: "l" } }))("markdown");
  assert.deepEqual(bodies[0].release, ["l"]);
});

test("a server that is not there is a failure, too", async () => {
  const store = createStore({ ...START, place });
  const gone = createExports(/** @type {any} */ (async () => { throw new TypeError("no network"); }), store);
  assert.equal(await gone("python"), null);
  assert.equal(store.get().failures.export?.status, 0);
});
