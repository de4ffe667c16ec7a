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

const DRIVERS = readdirSync(FRONTEND).filter((file) => file.endsWith(".js"));

test("no file is longer than 300 lines", () => {
  const long = [...DRIVERS, ...files("model"), ...files("view")].filter((file) => source(file).split("\n").length > 301);
  assert.deepEqual(long, []);
});

const SHEETS = readdirSync(new URL("styles", FRONTEND), { recursive: true }).map(String).filter((file) => file.endsWith(".css")).map((file) => `styles/${file}`);

test("no style sheet is longer than 600 lines", () => {
  assert.deepEqual(SHEETS.filter((file) => source(file).split("\n").length > 601), []);
});

test("every part of a style sheet is imported by it, once", () => {
  const imported = SHEETS.flatMap((file) => [...source(file).matchAll(/^@import "([^"]+)";$/gm)].map((match) => `styles/${match[1]}`));
  assert.deepEqual(imported.sort(), SHEETS.filter((file) => file.split("/").length > 2).sort());
});
