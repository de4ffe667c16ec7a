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

/** What a page needs of lit-html, with what that imports. @param {string} page */
function libraryOf(page) {
  /** @type {Set<string>} */
  const found = new Set();
  const add = (/** @type {string} */ file) => {
    if (found.has(file)) return;
    found.add(file);
    const within = new URL(`vendor/lit-html/${file}`, FRONTEND);
    for (const [, path] of readFileSync(within, "utf8").matchAll(/from"(\.[^"]+)"/g)) add(new URL(path, within).pathname.split("/lit-html/")[1]);
  };
  for (const file of imported(driverOf(page), new Set([driverOf(page)]))) {
    for (const [, part] of source(file).matchAll(/^import[^;]*? from "lit-html(?:\/([^"]+))?";/gm)) add(part ?? "lit-html.js");
  }
  return found;
}

for (const page of PAGES) {
  test(`${page}.html asks at once for what it needs of lit-html, and for the formulas before the small files`, () => {
    const asked = [...source(`${page}.html`).matchAll(/rel="modulepreload" href="\/vendor\/lit-html\/([^"]+)"/g)].map((match) => match[1]);
    assert.deepEqual(asked.sort(), [...libraryOf(page)].sort());
    const [formulas, first] = [/rel="preload" href="\/vendor\/katex\/dist\/katex.min.js"/, /rel="modulepreload"/].map((link) => source(`${page}.html`).search(link));
    assert.equal(/katex.min.js" defer/.test(source(`${page}.html`)), formulas > 0 && formulas < first);
  });

  test(`${page}.html asks at once for every module it needs, and for no other`, () => {
    const asked = [...source(`${page}.html`).matchAll(/rel="modulepreload" href="\/((?:model|view)\/[^"]+)"/g)].map((match) => match[1]);
    assert.deepEqual(asked.sort(), [...imported(driverOf(page))].sort());
  });
}

const SHEETS = readdirSync(new URL("styles", FRONTEND), { recursive: true }).map(String).filter((file) => file.endsWith(".css")).map((file) => `styles/${file}`);

test("no style sheet is longer than 200 lines", () => {
  assert.deepEqual(SHEETS.filter((file) => source(file).split("\n").length > 201), []);
});

test("every part of a style sheet is imported by it, once", () => {
  const imported = SHEETS.flatMap((file) => [...source(file).matchAll(/^@import "([^"]+)";$/gm)].map((match) => `styles/${match[1]}`));
  assert.deepEqual(imported.sort(), SHEETS.filter((file) => file.split("/").length > 2).sort());
});
