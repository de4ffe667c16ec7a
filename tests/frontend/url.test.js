import { strict as assert } from "node:assert";
import { test } from "node:test";
import { HOME, pageAddress, PAGES, readPlace, startLanguage, startPlace, writePlace } from "../../frontend/model/url.js";

const PLACES = [
  ["nothing said", "", HOME],
  ["scene and step", "?scene=pendulum&step=virtual-displacement:bob", { ...HOME, scene: "pendulum", step: "virtual-displacement:bob" }],
  ["everything", "?scene=a&step=b&lang=de&theme=dark&method=rk4&n=6&formulation=hamilton&duration=20&speed=0.25&panel=plots&edit=json&view=lecture&part=2&pace=substeps&beside=plots&vary=phi:0.2&set=l:0.5&at=1.5&with=bars&runs=%40rk4&plot=wrapped%2C2:4&show=figure&why=b&more=canonical&release=l",
    { scene: "a", step: "b", lang: "de", theme: "dark", method: "rk4", n: 6, formulation: "hamilton", duration: 20, speed: 0.25, panel: "plots", edit: "json", view: "lecture", part: 2, pace: "substeps", beside: "plots", vary: "phi:0.2", set: "l:0.5", at: 1.5, with: "bars", runs: "@rk4", plot: "wrapped,2:4", show: "figure", why: "b", more: "canonical", release: "l" }],
];

for (const [name, query, place] of PLACES) {
  test(`address: ${name}`, () => {
    assert.deepEqual(readPlace(query), place);
    assert.equal(writePlace(place), query);
  });
}

const USUAL = { scene: "", step: "", lang: "", theme: "auto", method: "", n: 0, formulation: "dalembert-lagrange", duration: 10, speed: 1, panel: "derivation", edit: "", view: "", part: 0, pace: "", beside: "", vary: "", set: "", at: 0, with: "", runs: "", plot: "", show: "", why: "", more: "", release: "" };
const CHOICES = {
  lang: ["de", "en"], theme: ["auto", "light", "dark", "projector"], formulation: ["dalembert-lagrange", "hamilton"], more: ["canonical"],
  panel: ["derivation", "plots", "values"], edit: ["form", "json", "toml"], view: ["lecture"], pace: ["substeps"], beside: ["plots", "nothing"],
  show: ["figure", "derivation"], speed: [0.1, 0.25, 0.5, 1, 2, 4], duration: [0.5, 100], n: [1, 99], part: [1, 99], at: [0.5, 100],
  scene: ["a".repeat(100)], set: ["a".repeat(400)],
};

test("every choice has an address, and what is as usual has none", () => {
  assert.deepEqual(readPlace(""), USUAL);
  assert.deepEqual(HOME, USUAL);
  for (const [key, values] of Object.entries(CHOICES)) {
    for (const value of values) {
      const place = { ...USUAL, [key]: value };
      assert.deepEqual(readPlace(`?${key}=${value}`), place);
      assert.equal(writePlace(/** @type {any} */ (place)), value === /** @type {any} */ (USUAL)[key] ? "" : `?${key}=${value}`);
    }
  }
  for (const [query, place] of /** @type {[string, any][]} */ ([
    ["?edit=", { edit: "form" }],
    ["?n=100&part=1e9&at=101", { n: 99, part: 99, at: 100 }],
    ["?n=2.9&at=-1&duration=0", { n: 2 }],
    [`?scene=${"a".repeat(101)}&set=${"a".repeat(401)}&duration=100.1`, {}],
    ["?scene=a.b,c%40d%2B-e:_1", { scene: "a.b,c@d+-e:_1" }],
    ["?scene=%20a&step=a%20", {}],
  ])) assert.deepEqual(readPlace(query), { ...USUAL, ...place });
});

test("pages take the reader's language and appearance along, and the scene where they are about one", () => {
  const reader = { lang: /** @type {const} */ ("de"), theme: /** @type {const} */ ("dark"), scene: "pendulum", step: "a" };
  assert.deepEqual(PAGES, ["scene", "variations", "proof", "labs", "homework", "lecture", "docs", "help"]);
  for (const name of PAGES) {
    const about = ["scene", "labs", "homework"].includes(name);
    assert.equal(pageAddress(name, reader), `/${name}?${about ? "scene=pendulum&" : ""}lang=de&theme=dark`);
    assert.equal(pageAddress(name, { lang: "de", theme: "auto" }), `/${name}?lang=de`);
  }
});

const STRANGE = [
  ["an unknown language", "?lang=xx"],
  ["an unknown side of the editor", "?edit=xml"],
  ["a chain of no number", "?n=many"],
  ["a chain of less than nothing", "?n=-3"],
  ["an unknown formulation", "?formulation=newton"],
  ["an unknown theme", "?theme=pink"],
  ["markup as a scene", "?scene=%3Cscript%3E"],
  ["an unknown view", "?view=cinema"],
  ["less than no substep", "?part=-1"],
  ["a negative duration", "?duration=-3"],
  ["an endless duration", "?duration=1e9"],
  ["a duration without number", "?duration=long"],
  ["a speed that nobody can choose", "?speed=3"],
  ["a speed without number", "?speed=fast"],
];

for (const [name, query] of STRANGE) {
  test(`address: ${name} is passed over`, () => assert.deepEqual(readPlace(query), HOME));
}

test("the language: asked for, then the browser's first known one, then English", () => {
  assert.equal(startLanguage("de", ["en-GB"]), "de");
  assert.equal(startLanguage("", ["fr-FR", "de-AT", "en"]), "de");
  assert.equal(startLanguage("", ["fr"]), "en");
});

test("a page that has no place of its own takes over the looks alone", () => {
  const asked = readPlace("?scene=pendulum&step=velocity:bob&theme=dark");
  assert.deepEqual(startPlace(asked, ["de-AT"]), { ...HOME, theme: "dark", lang: "de" });
});
