import { strict as assert } from "node:assert";
import { test } from "node:test";
import { createSpeech } from "../../frontend/model/speech.js";
import { createStore } from "../../frontend/model/store.js";
import { HOME } from "../../frontend/model/url.js";

/** A server whose answers come when they are told to. */
function slowServer() {
  /** @type {(() => void)[]} */
  const coming = [];
  const catalog = (/** @type {string} */ lang, /** @type {string[]} */ ...sections) =>
    new Promise((done) => coming.push(() => done(Object.fromEntries(["page", "lang", ...sections].map((name) => [name, lang])))));
  return { coming, api: /** @type {any} */ ({ catalog }) };
}

test("an answer that was overtaken takes no section away", async () => {
  const { coming, api } = slowServer();
  const store = createStore({ place: { ...HOME, lang: "de" }, catalog: /** @type {import("../../frontend/model/types.js").Catalog} */ ({ page: "de" }) });
  const { need } = createSpeech(store, api, (task) => task());
  need("figure");
  need("laws");
  for (const answer of coming.reverse()) {
    answer();
    await new Promise((done) => setTimeout(done));
  }
  assert.deepEqual(Object.keys(store.get().catalog).sort(), ["figure", "lang", "laws", "page"]);
});

for (const [order, sorted] of /** @type {[string, <T>(list: T[]) => T[]][]} */ ([["first", (list) => list], ["last", (list) => list.reverse()]])) {
  test(`texts of a language that was left again are not shown, though they come ${order}`, async () => {
    const { coming, api } = slowServer();
    const store = createStore({ place: { ...HOME, lang: "de" }, catalog: /** @type {import("../../frontend/model/types.js").Catalog} */ ({}) });
    const { speak } = createSpeech(store, api, (task) => task());
    void speak("en");
    void speak("de");
    for (const answer of sorted(coming)) {
      answer();
      await new Promise((done) => setTimeout(done));
      assert.ok(["de", undefined].includes(/** @type {any} */ (store.get().catalog).lang));
    }
    assert.equal(store.get().catalog.lang, "de");
  });
}

test("what is needed before there are any texts comes with the first of them", async () => {
  const { coming, api } = slowServer();
  const store = createStore({ place: HOME, catalog: /** @type {import("../../frontend/model/types.js").Catalog} */ ({}) });
  const { need, speak } = createSpeech(store, api, (task) => task());
  need("figure");
  assert.equal(coming.length, 0);
  const spoken = speak("en");
  coming[0]();
  await spoken;
  assert.deepEqual([coming.length, store.get().catalog], [1, { page: "en", lang: "en", figure: "en" }]);
});
