import { strict as assert } from "node:assert";
import { readdirSync, readFileSync } from "node:fs";
import { test } from "node:test";
import { called, inLanguage, translator } from "../../frontend/model/catalog.js";
import { SECTIONS } from "../../frontend/model/editor/schema.js";
import { GUIDE } from "../../frontend/model/guide.js";
import { COURSE } from "../../frontend/model/start/course.js";
import { FORMS, SHOWN } from "../../frontend/model/share.js";
import { PAGES } from "../../frontend/model/url.js";
import { KNOWN } from "../../frontend/model/labs/experiments.js";
import { LEVELS, SIDES } from "../../frontend/model/homework/place.js";
import { ONLY } from "../../frontend/model/homework/roster.js";
import { EXAMPLES, GROUPS } from "../../frontend/model/variations/examples.js";
import { HOLDS, KINDS } from "../../frontend/model/variations/question.js";

const FRONTEND = new URL("../../frontend/", import.meta.url);
const LOCALES = new URL("../../backend/deltaq/narration/locales/", import.meta.url);

test("of one thing the sentence for one is taken, where there is one", () => {
  const t = translator({ "found.steps": "{count} steps", "found.steps-one": "1 step", more: "{count} more", "more-one": "" });
  const said = [0, 1, "1", 2, 11].map((count) => t("found.steps", { count }));
  assert.deepEqual(said, ["0 steps", "1 step", "1 step", "2 steps", "11 steps"]);
  assert.equal(t("found.steps"), "{count} steps");
  assert.equal(t("more", { count: 1 }), "");
});

test("a text by flat key, by nested key, with parameters, and an absent one", () => {
  const t = translator({ "a.b": "flat {n}", c: { d: "nested" } });
  assert.equal(t("a.b", { n: 3 }), "flat 3");
  assert.equal(t("a.b"), "flat {n}");
  assert.equal(t("c.d"), "nested");
  assert.equal(t("c.x.y"), "c.x.y");
});

test("a text in the asked language, else in English, else in any", () => {
  assert.equal(inLanguage({ de: "ja", en: "yes" }, "de"), "ja");
  assert.equal(inLanguage({ en: "yes" }, "de"), "yes");
  assert.equal(inLanguage({ de: "ja" }, "en"), "ja");
  assert.equal(inLanguage(undefined, "en"), "");
});

const source = [...readdirSync(FRONTEND).filter((f) => f.endsWith(".js")), ...["view", "model"].flatMap((folder) => readdirSync(new URL(folder, FRONTEND), { recursive: true }).map(String).filter((f) => f.endsWith(".js")).map((f) => `${folder}/${f}`))]
  .map((file) => readFileSync(new URL(file, FRONTEND), "utf8")).join("\n");
/** Nested texts by flat keys. @param {Record<string, any>} texts @param {string} prefix @returns {Record<string, string>} */
const flat = (texts, prefix) => Object.assign({}, ...Object.entries(texts).map(([key, text]) => (typeof text === "string" ? { [`${prefix}${key}`]: text } : flat(text, `${prefix}${key}.`))));
const read = (/** @type {string} */ lang, /** @type {string} */ section) => JSON.parse(readFileSync(new URL(`${lang}/${section}.json`, LOCALES), "utf8"));
const catalogs = Object.fromEntries(["de", "en"].map((lang) => [lang, Object.assign({}, ...["page", "editor", "variations", "start", "lecture", "reference", "guide", "exercises", "figure", "lectures"].map((section) => read(lang, section)), flat(read(lang, "labs"), "labs."), flat(read(lang, "ladder"), "ladder."))]));

test("both languages have the same texts with the same parameters", () => {
  const holes = (/** @type {string} */ text) => [...text.matchAll(/\{\w+\}/g)].map(String).sort().join();
  const shape = (/** @type {Record<string, string>} */ catalog) => Object.entries(catalog).map(([key, text]) => `${key} ${holes(text)}`).sort();
  assert.deepEqual(shape(catalogs.de), shape(catalogs.en));
});

test("every text that the page asks for is there", () => {
  const asked = [...source.matchAll(/\b(?:t|say)\("([a-z][\w.-]*)"/g)].map((match) => match[1]);
  assert.ok(asked.length > 30);
  assert.deepEqual(asked.filter((key) => !(key in catalogs.en)), []);
});

const fields = SECTIONS.flatMap((section) => [...section.fields, ...Object.values(section.kinds ?? {}).flat()].map(({ key }) => key));
/** What the editor asks for by section, field, kind and state. */
const EDITOR = [
  ...SECTIONS.flatMap(({ key, kinds }) => [`editor.${key}`, `editor.add.${key}`, ...Object.keys(kinds ?? {}).map((kind) => `editor.kind.${kind}`)]),
  ...[...fields, "angular_velocity"].map((key) => `editor.field.${key}`),
  ...["title", "summary"].map((key) => `editor.field.${key}`),
  ...["waiting", "valid", "invalid", "unreachable"].map((verdict) => `editor.${verdict}`),
];

/** What the page of variations asks for by example, kind, end and quotient. */
const VARIATIONS = [
  ...EXAMPLES.map((id) => `variations.example.${id}`),
  ...Object.keys(GROUPS).map((group) => `variations.group.${group}`),
  ...KINDS.map((kind) => `variations.kind-${kind}`),
  ...["from", "to", "end-from", "end-to", ...HOLDS.map((hold) => `end-${hold}`), "syntax-plain", "syntax-latex", "declare-functions", "declare-parameters", "one_sided", "central"].map((key) => `variations.${key}`),
];

/** What the help asks for by part and entry. */
const HELP = GUIDE.flatMap(({ id, entries }) => [id, `${id}.lead`, ...entries.flatMap((entry) => [`${id}.${entry.id}`, `${id}.${entry.id}.text`])]).map((key) => `guide.${key}`);

/** What the start page asks for by page and by entry of the course. */
const START = [
  ...PAGES.map((name) => `place.${name}`),
  ...PAGES.filter((name) => name !== "scene").map((name) => `start.${name}`),
  ...COURSE.flatMap((part) => [`course.${part.id}`, ...part.entries.map((entry) => `course.${part.id}.${entry.id}`)]),
];

/** What the page of homework asks for by outcome, part of the answer, row of the keyboard and side. */
const EXERCISES = [
  ...["correct", "wrong", "undecided", "invalid", "follow_through"].flatMap((outcome) => [`homework.outcome.${outcome}`, `homework.status-${outcome}`]),
  ...["correct", "wrong", "undecided"].map((outcome) => `homework.part-${outcome}`),
  ...["keys-motion", "keys-parameters", "keys-operations", "status-solved", "status-begun"].map((key) => `homework.${key}`),
  ...["latex", "plain"].flatMap((syntax) => ["syntax", "to", "kept"].map((key) => `homework.${key}-${syntax}`)),
  ...SIDES.map((side) => `homework.side-${side}`),
  ...LEVELS.map((level) => `practice.level-${level}`),
  ...ONLY.map((one) => `homework.only-${one || "all"}`),
  ...["up", "down", "remove"].flatMap((way) => [`homework.pick-${way}`, `homework.pick-${way}-task`]),
  ...["values", "axes", "coordinates", "factors"].map((aspect) => `homework.pick-vary-${aspect}`),
  ...["pick-late", "pick-follow_through", "page-previous", "page-next"].map((key) => `homework.${key}`),
  ...["row", "student", "task", "answer", "outcome", "points"].map((key) => `homework.class-${key}`),
  ...["checking", "check", "solution", "points", "points-one", "hint", "next-hint", "compare", "moving", "mark"].map((key) => `homework.${key}`),
];

const LABS = Object.keys(read("en", "labs").experiments);

/** What the labs ask for by lab and option; charts are made by the server, with its texts. */
const LAB = [
  ...LABS.flatMap((lab) => [`labs.experiments.${lab}.title`, `labs.experiments.${lab}.summary`]),
  ...KNOWN.options("chaos").flatMap(({ kind, label, choices = [] }) => [label, ...choices.filter((one) => typeof one === "string").map((one) => `${label}-${one}`), ...(["parameter", "text"].includes(kind) ? [`${label}-usual`] : [])]).map((key) => `labs.${key}`),
];
const CHARTS = ["axis", "hover", "status", ...LABS].map((part) => `labs.${part}.`).concat("ladder.", "labs.without-result", "labs.minimal");

/** What sharing asks for by form of file, by why there is none, and by what a frame shows. */
const SHARE = [
  ...[...FORMS, "svg", "png", "csv"].map((form) => `share.${form}`),
  ...["no-motion", "too-large", "no-film", "film-broke", "unknown"].map((why) => `share.trouble-${why}`),
  ...SHOWN.map((shown) => `share.show-${shown || "both"}`),
];

/** What own lectures ask for by button and by what may be wrong with a document. */
const LECTURES = [
  ...["up", "down", "remove"].map((at) => `lectures.stop-${at}`),
  ...[...new Set([...source.matchAll(/code: "([a-z]+)"/g)].map(([, code]) => code))].map((code) => `lectures.problem.${code}`),
];

for (const [name, asked] of Object.entries({ lectures: LECTURES, labs: LAB, editor: EDITOR, variations: VARIATIONS, start: START, share: SHARE, exercises: EXERCISES, guide: HELP })) {
  test(`every text of the part "${name}" is there`, () => assert.deepEqual(asked.filter((key) => !(key in catalogs.en)), []));
}

test("every text that is there is used", () => {
  const composed = ["theme.", "motion.", "tools.", "why.", "player.", "release.", "formulation.", "panel.", "language.", "editor.side.", "editor.dimension.", "editor.flag.", "editor.vertical.", "kinds.", "reference.subject.", "reference.about.", "plots.axes-", ...CHARTS];
  const unused = Object.keys(catalogs.en).filter((key) => ![...EDITOR, ...VARIATIONS, ...START, ...SHARE, ...LECTURES, ...LAB, ...EXERCISES, ...HELP].includes(key) && !source.includes(`"${key.replace(/-one$/, "")}"`) && !composed.some((prefix) => key.startsWith(prefix)));
  assert.deepEqual(unused, []);
});

for (const [name, lang, wanted] of [["gravity", "de", "Gewicht"], ["spring-2", "de", "Feder 2"], ["spring-2", "en", "spring 2"], ["bob", "de", "bob"], ["suspension", "de", "Aufhängung"], ["friction-3b", "en", "friction-3b"]])
  test(`${name} is called ${wanted} (${lang})`, () => assert.equal(called({ suspension: { de: "Aufhängung", en: "suspension" } }, name, lang, translator(catalogs[lang])), wanted));
