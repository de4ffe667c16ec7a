/**
 * What a step does to the terms it was made of: kept, turned in sign (as when a term goes to the other side), derived,
 * multiplied out, brought together, or cancelled; and the steps they come from. The server tells it, term by term.
 */

/** @typedef {import("../types.js").Step} Step */
/** @typedef {import("../reveal.js").Line} Line */
/** @typedef {Step["terms"][number]} Term */
/** @typedef {Term["from"][number]["change"] | "gone"} Change */
/** @typedef {{formulas: Map<Step, string>, from: Map<Change, string[]>}} Origins  LaTeX with marked terms, and the numbers of the steps they come from */

/** In this order they are told. @type {readonly Change[]} */
export const CHANGES = ["kept", "sign-turned", "differentiated", "integrated", "expanded", "merged", "gone"];
const MARK = /\\htmlClass\{([^}]*\bt-\d+-\d+-\d+)\}/g;

/** @param {string} term its id @returns {string} the id of its step */
const stepOf = (term) => term.slice(0, term.lastIndexOf("/"));
/** @param {string} term its id @returns {string} its class in the marked formula */
const classOf = (term) => `t-${term.slice(term.lastIndexOf("/") + 1).replaceAll(".", "-")}`;
/** @param {Step} step @returns {Step[]} */
const within = (step) => [step, ...step.substeps.flatMap(within)];

/**
 * @param {readonly Line[]} lines @param {number} index of the step
 * @returns {Origins}
 */
export function originsOf(lines, index) {
  const { step } = lines[index];
  const numbers = new Map(lines.flatMap(({ step, number }) => within(step).map(({ id }) => [id, number])));
  /** @type {Map<Change, Set<string>>} */
  const from = new Map();
  const tell = (/** @type {Change} */ change, /** @type {string} */ id) => {
    const number = numbers.get(id);
    if (number) from.set(change, (from.get(change) ?? new Set()).add(number));
  };
  const changes = new Map(results(step).flatMap((term) => changed(term, step, tell)));
  const formulas = new Map([[step, marked(step, changes)]]);
  const lost = new Set(step.cancelled);
  for (const part of within(step).slice(1)) {
    const gone = part.terms.filter(({ id }) => lost.has(id));
    if (!gone.length) continue;
    tell("gone", part.id);
    formulas.set(part, marked(part, new Map(gone.map(({ id }) => [classOf(id), /** @type {Change} */ ("gone")]))));
  }
  return { formulas, from: new Map([...from].map(([change, found]) => [change, [...found]])) };
}

/** The terms that the lines of a step lead to, where there are several: what stands alone needs no mark. @param {Step} step @returns {Term[]} */
function results(step) {
  /** @type {Map<string, Term[]>} */
  const members = new Map();
  for (const term of step.terms) {
    const [line, member] = term.id.slice(term.id.lastIndexOf("/") + 1).split(".");
    const key = `${line}.${member}`;
    members.set(key, [...(members.get(key) ?? []), term]);
  }
  const last = new Map([...members.keys()].map((key) => [key.split(".")[0], key]));
  return [...last.values()]
    .filter((key) => !key.endsWith(".0"))
    .map((key) => members.get(key) ?? [])
    .filter((terms) => terms.length > 1)
    .flat();
}

/** The class of a term with its change, as told by the steps before if they are told of. @param {Term} term @param {Step} step @param {(change: Change, id: string) => void} tell @returns {[string, Change][]} */
function changed(term, step, tell) {
  const earlier = term.from.filter(({ term: id }) => stepOf(id) !== step.id);
  const [first] = earlier.length ? earlier : term.from;
  if (!first) return [];
  for (const { term: id, change } of earlier.length ? earlier : [first]) tell(change, stepOf(id));
  return [[classOf(term.id), first.change]];
}

/** The formula with the class of a change beside that of each term. @param {Step} step @param {ReadonlyMap<string, Change>} changes */
function marked(step, changes) {
  return (step.marked || step.latex).replace(MARK, (whole, classes) => {
    const change = changes.get(classes.slice(classes.lastIndexOf("t-")));
    return change ? `\\htmlClass{${classes} term-${change}}` : whole;
  });
}
