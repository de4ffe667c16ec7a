import { strict as assert } from "node:assert";
import { test } from "node:test";
import { HOME, readPlace, startLanguage, writePlace } from "../../frontend/model/url.js";

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
