import { strict as assert } from "node:assert";
import { test } from "node:test";
import { groupsOf } from "../../frontend/model/reference.js";

const text = { type: "string" };
const curl = (/** @type {string} */ rest) => [{ lang: "Shell", source: `curl http://localhost:8000${rest}` }];
const DOCUMENT = {
  tags: [{ name: "others", description: "Other things." }, { name: "things", description: "Things." }],
  paths: {
    "/api/v1/things": {
      get: { tags: ["things"], operationId: "list", description: "All things.", parameters: [{ name: "lang", in: "query", required: false, schema: { anyOf: [{ enum: ["de", "en"] }, { type: "null" }] } }], responses: { 200: { description: "fine" } }, "x-codeSamples": curl("/api/v1/things") },
      post: { tags: ["things"], operationId: "make", summary: "Make", requestBody: { content: { "application/json": { schema: { $ref: "#/components/schemas/Thing" } } } }, responses: {}, "x-codeSamples": curl("/api/v1/things -d '{}'") },
    },
  },
  components: {
    schemas: {
      Thing: { required: ["name"], properties: { name: { ...text, description: "its name" }, parts: { type: "array", items: { $ref: "#/components/schemas/Part" } } }, examples: [{ name: "it's" }] },
      Part: { type: "object" },
    },
  },
};

test("calls stand by subject, with their fields, kinds and answers", () => {
  const [others, { subject, text: about, calls }] = groupsOf(DOCUMENT, "https://deltaq.test");
  assert.deepEqual(others, { subject: "others", text: "Other things.", calls: [] });
  assert.deepEqual([subject, about], ["things", "Things."]);
  assert.deepEqual(calls.map(({ method, path, text }) => [method, path, text]), [["GET", "/api/v1/things", "All things."], ["POST", "/api/v1/things", "Make"]]);
  assert.deepEqual(calls[0].fields, [{ name: "lang", kind: "de | en", text: "", required: false }]);
  assert.deepEqual(calls[0].answers, [{ status: "200", text: "fine" }]);
  assert.deepEqual(calls[1].fields, [{ name: "name", kind: "string", text: "its name", required: true }, { name: "parts", kind: "[object]", text: "", required: false }]);
});

test("a call says what is to be filled in, with its examples", () => {
  const { calls } = groupsOf(DOCUMENT, "")[1];
  assert.deepEqual(calls[0].inputs, [{ name: "lang", place: "query", text: "", required: false, choices: ["de", "en"], example: "" }]);
  assert.deepEqual([calls[0].type, calls[0].examples], ["", []]);
  assert.deepEqual([calls[1].type, calls[1].examples], ["application/json", ['{\n  "name": "it\'s"\n}']]);
});

test("samples name the service that shows them", () => {
  const { calls } = groupsOf(DOCUMENT, "https://deltaq.test")[1];
  assert.deepEqual(calls[1].samples, [{ lang: "Shell", source: "curl https://deltaq.test/api/v1/things -d '{}'" }]);
});
