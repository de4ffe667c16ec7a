import { strict as assert } from "node:assert";
import { readdirSync, readFileSync } from "node:fs";
import { test } from "node:test";

const FRONTEND = new URL("../../frontend/", import.meta.url);
const files = (/** @type {string} */ folder) => readdirSync(new URL(folder, FRONTEND), { recursive: true }).map(String).filter((f) => f.endsWith(".js")).map((f) => `${folder}/${f}`);
const source = (/** @type {string} */ file) => readFileSync(new URL(file, FRONTEND), "utf8");

for (const file of files("model")) {
  test(`${file} knows no DOM and no view`, () => {
    assert.doesNotMatch(source(file), /\b(document|window|location|history)\.|from "\.\.\/view|lit-html|HTMLElement/);
  });
}

for (const file of files("view")) {
  test(`${file} asks no server`, () => {
    assert.doesNotMatch(source(file), /\bfetch\(|XMLHttpRequest|model\/(api|session)\.js";/);
  });
}

test("no file is longer than 200 lines", () => {
  const long = ["app.js", ...files("model"), ...files("view")].filter((file) => source(file).split("\n").length > 201);
  assert.deepEqual(long, []);
});

test("every module but the editor's is asked for at once, and none that is not there", () => {
  const asked = [...source("index.html").matchAll(/rel="modulepreload" href="\/((?:model|view)\/[^"]+)"/g)].map((match) => match[1]);
  const there = [...files("model"), ...files("view")].filter((file) => file !== "model/types.js" && !file.includes("/editor/"));
  assert.deepEqual(asked.sort(), there.sort());
});
