import { strict as assert } from "node:assert";
import { test } from "node:test";
import { ApiError, createApi, failureOf, ofSource } from "../../frontend/model/api.js";

const answer = (/** @type {number} */ status, /** @type {string} */ body) => async () => new Response(body, { status });
const failureFrom = async (/** @type {any} */ send) => {
  try {
    await createApi(send).scenes();
  } catch (error) {
    assert.ok(error instanceof ApiError);
    return error.failure;
  }
  return assert.fail("no failure");
};

test("a problem becomes a failure with its sentences", async () => {
  const problem = { title: "Unknown", status: 404, detail: "There is no such scene.", problems: [{ message: "Did you mean pendulum?", pointer: "/scene" }] };
  const failure = await failureFrom(answer(404, JSON.stringify(problem)));
  assert.deepEqual(failure, { title: "Unknown", detail: "There is no such scene.", status: 404, problems: problem.problems });
});

test("a page of a proxy becomes a failure without words", async () => {
  assert.deepEqual(await failureFrom(answer(502, "<html>")), { title: "", detail: "", status: 502, problems: [] });
});

test("an answer that is no JSON is a failure even with status 200", async () => {
  assert.equal((await failureFrom(answer(200, "<html>"))).status, 200);
});

test("no answer has status 0", async () => {
  assert.equal((await failureFrom(async () => Promise.reject(new TypeError("failed to fetch")))).status, 0);
});

test("an abort stays an abort", async () => {
  const aborted = new DOMException("aborted", "AbortError");
  await assert.rejects(createApi(async () => Promise.reject(aborted)).scenes(), (error) => error === aborted);
});

test("problems without a message are left out", () => {
  assert.deepEqual(failureOf(422, { problems: [{ code: "x" }, null, { message: "m" }] }).problems, [{ message: "m" }]);
});

test("names in addresses are escaped", async () => {
  /** @type {string[]} */
  const asked = [];
  const send = async (/** @type {any} */ url) => (asked.push(url), new Response("{}"));
  await createApi(send).scene("a/b?c", "de");
  assert.deepEqual(asked, ["/api/v1/scenes/a%2Fb%3Fc?lang=de"]);
});

test("what is read is asked for as of the page's version, what is computed as ever", async () => {
  /** @type {string[]} */
  const asked = [];
  const send = async (/** @type {any} */ url) => (asked.push(url), new Response("{}"));
  const api = createApi(ofSource("0123", send));
  await api.methods();
  await api.scene("pendulum", "de");
  await api.derive({ scene: "pendulum" });
  await createApi(ofSource("", send)).methods();
  assert.deepEqual(asked, ["/api/v1/methods?source=0123", "/api/v1/scenes/pendulum?lang=de&source=0123", "/api/v1/derivations", "/api/v1/methods"]);
});

test("texts are asked for until they come, other things once", async () => {
  const answers = [new TypeError("failed to fetch"), new Response("<html>", { status: 502 }), new Response('{"page": {}}')];
  /** @type {number[]} */
  const waited = [];
  const send = async () => {
    const next = /** @type {Error | Response} */ (answers.shift());
    if (next instanceof Error) throw next;
    return next;
  };
  const api = createApi(send, async (ms) => void waited.push(ms));
  assert.deepEqual(await api.catalog("de"), { page: {} });
  assert.deepEqual(waited, [1000, 2000]);
});

test("texts that are refused are not asked for again, nor those that change what can be read", async () => {
  const wait = async () => assert.fail("asked again");
  const refused = createApi(answer(404, "{}"), wait);
  await assert.rejects(refused.catalog("xx"), (error) => error instanceof ApiError && error.failure.status === 404);
  const answers = [new Response("{}"), new Response("", { status: 502 })];
  const api = createApi(async () => /** @type {Response} */ (answers.shift()), wait);
  await api.catalog("de");
  await assert.rejects(api.catalog("en"), (error) => error instanceof ApiError && error.failure.status === 502);
});
