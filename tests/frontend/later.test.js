import { strict as assert } from "node:assert";
import { before, test } from "node:test";
import { createLater } from "../../frontend/model/later.js";
import { missedOf } from "../../frontend/view/missed.js";
import { readFileSync, readdirSync } from "node:fs";

const LANGUAGES = ["de", "en"];
const FRONTEND = new URL("../../frontend/", import.meta.url);
const read = (/** @type {string} */ path) => readFileSync(new URL(path, FRONTEND), "utf8");
const texts = (/** @type {string} */ lang) =>
  JSON.parse(read(`../backend/deltaq/narration/locales/${lang}/page.json`));

// A part that failed tells so on the console; here that is meant.
before(() => {
  console.error = () => {};
});

/** A part that fails this many times before it comes. @param {number} failures */
function unsteady(failures) {
  const seen = { fetched: 0, changed: 0 };
  const later = createLater(
    async () => {
      seen.fetched += 1;
      if (seen.fetched <= failures) throw new TypeError("Failed to fetch");
      return "part";
    },
    () => {
      seen.changed += 1;
    },
  );
  return { later, seen };
}

/** Failures before it comes, what is asked in turn; then: the answers, whether it failed, how often it was fetched. */
const COURSES = /** @type {const} */ ([
  [0, ["want", "want"], ["part", "part"], false, 1],
  [0, ["again", "want"], ["part", "part"], false, 1],
  [1, ["want"], [null], true, 1],
  [1, ["want", "want", "want"], [null, null, null], true, 1],
  [1, ["want", "again"], [null, "part"], false, 2],
  [1, ["want", "again", "again", "want"], [null, "part", "part", "part"], false, 2],
  [2, ["want", "again", "want"], [null, null, null], true, 2],
  [2, ["want", "again", "again"], [null, null, "part"], false, 3],
]);

for (const [failures, asked, answers, failed, fetched] of COURSES)
  test(`after ${failures} failures ${asked.join(", ")} give ${answers.join(", ")}`, async () => {
    const { later, seen } = unsteady(failures);
    /** @type {(string | null)[]} */
    const got = [];
    for (const name of asked) got.push(await later[name]());
    assert.deepEqual(got, answers);
    assert.deepEqual([later.failed, later.part], [failed, failed ? null : "part"]);
    assert.deepEqual(seen, { fetched, changed: fetched });
  });

test("whoever asks while it is on its way waits for the same", async () => {
  const { later, seen } = unsteady(1);
  assert.deepEqual(await Promise.all([later.want(), later.want(), later.again()]), [null, null, null]);
  assert.deepEqual(await Promise.all([later.again(), later.again()]), ["part", "part"]);
  assert.equal(seen.fetched, 2);
});

test("what is wanted at each rendering is not fetched at each rendering once it has failed", async () => {
  let fetched = 0;
  /** @type {ReturnType<typeof createLater<string>>} */
  const later = createLater(
    async () => {
      fetched += 1;
      throw new TypeError("Failed to fetch");
    },
    () => void later.want(),
  );
  await later.want();
  await new Promise((done) => setTimeout(done, 5));
  assert.equal(fetched, 1);
});

test("only what failed and is wanted is told", async () => {
  const { later } = unsteady(1);
  const told = () => missedOf([{ says: "missed.editor", later, wanted: true }, { says: "missed.sharing", later, wanted: false }]);
  assert.deepEqual(told(), []);
  await later.want();
  assert.deepEqual(told().map(({ says }) => says), ["missed.editor"]);
  await later.again();
  assert.deepEqual(told(), []);
});

/** The scripts of the pages, with what is fetched late. */
const scripts = readdirSync(FRONTEND, { recursive: true, encoding: "utf8" })
  .filter((path) => path.endsWith(".js") && !/^(node_modules|vendor|tools)\//.test(path))
  .map((path) => ({ path, text: read(path) }));

for (const { path, text } of scripts.filter(({ text }) => /createLater\(/.test(text) && !/function createLater/.test(text)))
  test(`${path}: what comes late is told where it does not come`, () => {
    const names = [...text.matchAll(/const (\w+) = createLater\(/g)].map(([, name]) => name);
    assert.ok(names.length);
    const drivers = scripts.filter(({ text: other }) => /says: "missed\.\w+"/.test(other)).map(({ text: other }) => other);
    for (const name of names)
      assert.ok(drivers.some((other) => new RegExp(`later: (\\{ failed: )?([\\w.]+\\.)?${name}\\b`).test(other)), `${name} is never told`);
  });

const tools = [...new Set(scripts.flatMap(({ text }) => [...text.matchAll(/says: "missed\.(\w+)"/g)].map(([, tool]) => tool)))];
for (const lang of LANGUAGES)
  test(`${lang}: each tool that may fail has its sentence`, () => {
    const sentences = texts(lang);
    assert.deepEqual(tools.filter((tool) => !sentences[`missed.${tool}`]), []);
    assert.deepEqual(
      Object.keys(sentences).filter((key) => key.startsWith("missed.")).sort(),
      tools.map((tool) => `missed.${tool}`).sort(),
    );
  });

test("each import() is either held by a later part or has its failure caught", () => {
  const bare = scripts.flatMap(({ path, text }) =>
    [...text.matchAll(/^(?!.*(?:@|\*)).*\bawait import\(.*$/gm)]
      .map(([line]) => line)
      .filter((line) => !line.includes(".catch(") && !text.includes("createLater(") && !/try \{\s*\n.*await import/.test(text))
      .map((line) => `${path}: ${line.trim()}`),
  );
  assert.deepEqual(bare, []);
});
