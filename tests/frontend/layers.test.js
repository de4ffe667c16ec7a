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

const PAGES = readdirSync(FRONTEND).filter((file) => file.endsWith(".html")).map((file) => file.replace(".html", ""));

test("no file is longer than 200 lines", () => {
  const long = [...PAGES.map((page) => driverOf(page)), ...files("model"), ...files("view")].filter((file) => source(file).split("\n").length > 201);
  assert.deepEqual(long, []);
});

const driverOf = (/** @type {string} */ page) => `${page}.js`;

/** What a module imports, and what that imports; types and what is fetched later do not count. @param {string} file @param {Set<string>} seen */
function imported(file, seen = new Set()) {
  for (const [, path] of source(file).matchAll(/^(?:import|export)[^;]*? from "(\.[^"]+)";/gm)) {
    const found = new URL(path, new URL(file, FRONTEND)).pathname.slice(FRONTEND.pathname.length);
    if (!seen.has(found)) imported(found, seen.add(found));
  }
  return seen;
}

for (const page of PAGES) {
  test(`${page}.html asks at once for every module it needs, and for no other`, () => {
    const asked = [...source(`${page}.html`).matchAll(/rel="modulepreload" href="\/((?:model|view)\/[^"]+)"/g)].map((match) => match[1]);
    assert.deepEqual(asked.sort(), [...imported(driverOf(page))].sort());
  });
}
