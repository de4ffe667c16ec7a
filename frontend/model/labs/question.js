/** What a lab is asked: which experiment, on which scene, with which values; as an address, and as a request. */

/** @typedef {{parameter: string, from: number, to: number}} Side */
/**
 * @typedef {object} Question
 * @property {string} lab
 * @property {string} scene
 * @property {number} duration  seconds; 0 for the usual
 * @property {boolean} peers
 * @property {number} steps  of the energy drift
 * @property {"state" | "rest"} at
 * @property {string} stiffness
 * @property {Side | null} x
 * @property {Side | null} y
 * @property {boolean} flips
 * @property {number} allowed  relative error of the least rung, in percent
 * @property {Record<string, number>} parameters
 * @property {Record<string, {value?: number, rate?: number}>} initial
 */

/** @type {Question} */
export const NOTHING = { lab: "work-precision", scene: "", duration: 0, peers: false, steps: 0, at: "state", stiffness: "", x: null, y: null, flips: true, allowed: 1, parameters: {}, initial: {} };

/** @type {Record<string, Partial<Question>>} */
const EXAMPLES = {
  "work-precision": { scene: "double-pendulum" },
  convergence: { scene: "elastic-pendulum" },
  "energy-drift": { scene: "elastic-pendulum" },
  stability: { scene: "quarter-car" },
  "stability-map": { scene: "kapitza", x: { parameter: "omega", from: 10, to: 120 }, y: { parameter: "y0", from: 0.01, to: 0.2 } },
  chaos: { scene: "double-pendulum", initial: { phi1: { value: 2 }, phi2: { value: 2.5 } } },
  fidelity: { scene: "elastic-pendulum" },
};

/** The scene that shows a lab best, and what else to ask there. @param {string} lab */
export const exampleOf = (lab) => EXAMPLES[lab] ?? { scene: "double-pendulum" };

/** @param {string} query */
export function readQuestion(query) {
  const given = new URLSearchParams(query);
  const number = (/** @type {string} */ key) => Math.max(0, Number(given.get(key)) || 0);
  /** @type {Question} */
  const question = {
    ...NOTHING,
    lab: given.get("lab") || NOTHING.lab,
    scene: given.get("scene") ?? "",
    duration: number("t"),
    peers: given.get("peers") === "1",
    steps: number("steps"),
    at: given.get("at") === "rest" ? "rest" : "state",
    stiffness: given.get("stiffness") ?? "",
    x: sideOf(given.get("x")),
    y: sideOf(given.get("y")),
    flips: given.get("flips") !== "0",
    allowed: number("allowed") || NOTHING.allowed,
    parameters: {},
    initial: {},
  };
  for (const [key, text] of given) put(question, key, Number(text));
  return question;
}

/** A value in the address: p.l, q.phi, v.phi. @param {Question} question @param {string} key @param {number} value */
function put(question, key, value) {
  const [kind, name] = [key.slice(0, 2), key.slice(2)];
  if (!name || !Number.isFinite(value)) return;
  if (kind === "p.") question.parameters[name] = value;
  if (kind === "q.") question.initial[name] = { ...question.initial[name], value };
  if (kind === "v.") question.initial[name] = { ...question.initial[name], rate: value };
}

/** @param {string | null} text parameter:from:to */
function sideOf(text) {
  const [parameter, from, to] = (text ?? "").split(":");
  return parameter && Number.isFinite(Number(from)) && Number.isFinite(Number(to)) ? { parameter, from: Number(from), to: Number(to) } : null;
}

/** The query of a question, without what is as usual. @param {Question} question */
export function writeQuestion(question) {
  const { parameters, initial, x, y, lab, scene, duration, peers, steps, at, stiffness, flips, allowed } = question;
  const side = (/** @type {Side | null} */ s) => (s ? `${s.parameter}:${s.from}:${s.to}` : "");
  const own = { lab, scene, t: duration || "", peers: peers ? 1 : "", steps: steps || "", at: at === "rest" ? at : "", stiffness, x: side(x), y: side(y), flips: flips ? "" : "0", allowed: allowed === NOTHING.allowed ? "" : allowed };
  const values = Object.entries(parameters).map(([name, value]) => [`p.${name}`, value]);
  const starts = Object.entries(initial).flatMap(([name, { value, rate }]) => [[`q.${name}`, value], [`v.${name}`, rate]]);
  const query = new URLSearchParams();
  for (const [key, value] of [...Object.entries(own), ...values, ...starts]) {
    if (value !== "" && value !== undefined) query.set(String(key), String(value));
  }
  return query.toString().replaceAll("%3A", ":");
}

/** What a lab reads besides scene and values. @type {Record<string, ((question: Question) => object) | undefined>} */
const OWN = {
  "work-precision": ({ peers }) => ({ peers }),
  "energy-drift": ({ steps }) => (steps ? { steps } : {}),
  stability: ({ at, stiffness }) => ({ at, ...(stiffness ? { stiffness } : {}) }),
  "stability-map": ({ x, y }) => ({ x, y }),
  chaos: ({ flips }) => ({ map: flips }),
  fidelity: ({ allowed }) => ({ tolerance: allowed / 100 }),
};

/** @param {Question} question @param {string | object} scene @param {string} lang */
export function requestOf(question, scene, lang) {
  const { lab, parameters, initial, duration } = question;
  const span = duration && lab !== "energy-drift" && lab !== "stability-map" ? { t_end: duration } : {};
  return { scene, parameters, initial, ...span, lang, ...OWN[lab]?.(question) };
}

/** The motion at a point of a map: two parameters, or two angles at rest. @param {Question} question @param {{role: string, x: string, y: string}} map @param {number} x @param {number} y @returns {Pick<Question, "parameters" | "initial">} */
export function pointOf({ parameters, initial }, map, x, y) {
  if (map.role === "map") return { parameters: { ...parameters, [map.x]: x, [map.y]: y }, initial };
  const still = Object.fromEntries(Object.entries(initial).map(([name, start]) => [name, { ...start, rate: 0 }]));
  return { parameters, initial: { ...still, [map.x]: { value: x, rate: 0 }, [map.y]: { value: y, rate: 0 } } };
}
