import { strict as assert } from "node:assert";
import { createRequire } from "node:module";
import { test } from "node:test";
import { areOfFormulas, pieces, plainly } from "../../frontend/model/prose.js";

const katex = createRequire(new URL("../../frontend/package.json", import.meta.url))("katex");
const HOSTILE = ["$\\htmlClass{topbar}{x}$", "$ <img src=x onerror=alert(1)> $", "$$x$$", "$", "a $ b", "\\$x\\$"];

test("only what stands between dollar signs is a formula", () => {
  assert.deepEqual(pieces("Force $F_0$ at $q_2$."), [
    { text: "Force ", formula: false }, { text: "F_0", formula: true }, { text: " at ", formula: false }, { text: "q_2", formula: true }, { text: ".", formula: false },
  ]);
});

test("a user's text in a sentence of the server is words, and reads as it was written", () => {
  for (const text of HOSTILE) {
    const sentence = `Position: ${text.replaceAll("$", "＄")}, $x$`;
    assert.deepEqual(pieces(sentence).filter(({ formula }) => formula), [{ text: "x", formula: true }]);
    assert.equal(plainly(sentence), `Position: ${text}, x`);
  }
});

test("a dollar sign by itself opens nothing", () => assert.deepEqual(pieces("5 $"), [{ text: "5 $", formula: false }]));

const OWN = ["q-0", "q-1 variation", "q-2 differential", "body-bob load-gravity-2", "energy-kinetic", "energy-potential", "term-kept", "load-F time-term"];
const FOREIGN = ["topbar", "q-0 topbar", "dialog", "q", "body", "overlay q-1", "", "variations", "q-1;x"];

test("formulas have the classes of quantities and no others", () => {
  for (const classes of OWN) assert.ok(areOfFormulas(classes), classes);
  for (const classes of FOREIGN) assert.ok(!areOfFormulas(classes), classes);
});

test("KaTeX asks for each class", () => {
  const trust = (/** @type {{ command: string, class?: string }} */ { command, class: classes }) => command === "\\htmlClass" && areOfFormulas(classes ?? "");
  const set = (/** @type {string} */ latex) => katex.renderToString(latex, { trust, strict: "ignore", output: "html" });
  assert.match(set("\\htmlClass{q-1 variation}{x}"), /class="enclosing q-1 variation"/);
  assert.doesNotMatch(set("\\htmlClass{topbar}{x}"), /class="[^"]*topbar/);
});
