import { strict as assert } from "node:assert";
import { motionAt } from "../../frontend/model/labs/bifurcation.js";
import { readdirSync } from "node:fs";
import { test } from "node:test";
import { ApiError } from "../../frontend/model/api.js";
import { mapOf, middleOf, moved, seenAt } from "../../frontend/model/labs/cursor.js";
import { cheapestFor, themed, withStep, withTolerance } from "../../frontend/model/labs/figure.js";
import { createBench } from "../../frontend/model/labs/bench.js";
import { experimentsOf, KNOWN } from "../../frontend/model/labs/experiments.js";
import { titleOf } from "../../frontend/model/labs/ladder.js";
import { answered, exampleOf, inLab, NOTHING, onScene, pointOf, readQuestion, requestOf, writeQuestion } from "../../frontend/model/labs/question.js";
import { inUnicode } from "../../frontend/model/labs/symbols.js";
import { stepRange } from "../../frontend/model/labs/step.js";
import { eventReader, experiment } from "../../frontend/model/labs/stream.js";
import { createWatch, motionOf, written } from "../../frontend/model/labs/watch.js";

const TEXT = 'event: part\ndata: {"done":1}\n\nevent: result\ndata: {"experiment":"chaos"}\n\n';
const EVENTS = [{ kind: "part", data: { done: 1 } }, { kind: "result", data: { experiment: "chaos" } }];

test("events are read wherever the text is cut", () => {
  for (let cut = 0; cut <= TEXT.length; cut += 1) {
    const read = eventReader();
    assert.deepEqual([...read(TEXT.slice(0, cut)), ...read(TEXT.slice(cut))], EVENTS);
  }
});

/** @param {string} text @param {number} [status] */
const answering = (text, status = 200) => async () => new Response(text, { status });
const signal = new AbortController().signal;

test("an experiment lets hear its parts and ends with its result", async () => {
  /** @type {any[]} */
  const heard = [];
  const found = await experiment(answering(TEXT), "chaos", {}, (part) => heard.push(part), signal);
  assert.deepEqual([heard, found], [[{ done: 1 }], { experiment: "chaos" }]);
});

test("comments that keep a connection alive are no events", () => {
  const read = eventReader();
  assert.deepEqual(read(":\n\n:\n\nevent: part\ndata: 1\n\n: still here\n\n"), [{ kind: "part", data: 1 }]);
});

test("an experiment that has to wait tells for what", async () => {
  const text = 'event: preparing\ndata: {"kernels":3,"of":60}\n\n:\n\nevent: waiting\ndata: {"place":2,"seconds":14.5}\n\nevent: waiting\ndata: {"place":0,"seconds":0}\n\n' + TEXT;
  /** @type {any[]} */
  const told = [];
  await experiment(answering(text), "chaos", {}, () => told.push("part"), signal, false, (waiting) => told.push(waiting));
  assert.deepEqual(told, [{ kernels: 3, of: 60 }, { place: 2, seconds: 14.5 }, { place: 0, seconds: 0 }, "part"]);
});

test("what was measured before is measured anew on demand alone", async () => {
  /** @type {any[]} */
  const asked = [];
  const send = async (/** @type {any} */ _path, /** @type {any} */ { headers }) => { asked.push(headers["cache-control"]); return new Response(TEXT); };
  for (const anew of [false, true]) await experiment(send, "chaos", {}, () => {}, signal, anew);
  assert.deepEqual(asked, [undefined, "no-cache"]);
});

test("a problem in the stream, a refusal and a stream that breaks off are failures that can be shown", async () => {
  const problem = { status: 422, title: "no", detail: "because", problems: [] };
  const failing = (/** @type {any} */ send) => experiment(send, "chaos", {}, () => {}, signal).catch((error) => error.failure);
  assert.deepEqual(await failing(answering(`event: problem\ndata: ${JSON.stringify(problem)}\n\n`)), problem);
  assert.deepEqual(await failing(answering(JSON.stringify(problem), 422)), problem);
  assert.equal((await failing(answering("event: part\ndata: {}\n\n"))).status, 0);
});

const ASKED = { ...NOTHING, lab: "stability-map", scene: "kapitza", duration: 5, peers: true, steps: 1000, plane: "phi", direction: "both", horizontal: "", vertical: "dot(phi)^2", energy: -1.5, grid: 4, crossings: 80, skip: 7, uncertain: "all", spread: 0.02, tolerances: "phi = 0.1; dot(phi) = 0,25, l = x", distribution: "uniform", runs: 50, share: 10, x_from: -1, x_to: 2, y_from: null, y_to: 0, "basin-grid": 20, pairs: 9, basin_x: "phi", basin_y: "dot(phi)", at: /** @type {const} */ ("rest"), stiffness: "k", x: { parameter: "omega", from: -10, to: 120.5 }, y: { parameter: "y0", from: 0.01, to: 0.2 }, sweep: { parameter: "y0", from: 0.01, to: 0.2, count: 24 }, period: "", passing: "both", settle: 7, shown: 48, folds: 8, orbits: true, flips: false, allowed: 0.5, parameters: { l: 0.4 }, initial: { phi: { value: -1.5, rate: 2 } } };

test("every question has an address, and the usual one a short one", () => {
  assert.deepEqual(readQuestion(`?${writeQuestion(ASKED)}`), ASKED);
  assert.equal(writeQuestion({ ...NOTHING, scene: "pendulum" }), "lab=work-precision&scene=pendulum");
});

test("an address that makes no sense is read as the usual", () => {
  assert.deepEqual(readQuestion("?lab=&t=-3&x=omega:a:b&p.l=x&at=noon&allowed=none"), NOTHING);
});

test("each lab asks for what it knows", () => {
  const bodies = Object.fromEntries(["work-precision", "convergence", "energy-drift", "stability", "stability-map", "chaos", "poincare-section", "bifurcation", "uncertainty", "basins", "fidelity"].map((lab) => [lab, Object.keys(requestOf({ ...ASKED, lab }, "kapitza", "en")).filter((key) => !["scene", "parameters", "initial", "lang"].includes(key)).sort()]));
  assert.deepEqual(bodies, {
    "work-precision": ["peers", "t_end"], convergence: ["t_end"], "energy-drift": ["steps"], stability: ["at", "stiffness", "t_end"],
    "stability-map": ["x", "y"], chaos: ["map", "t_end"], "poincare-section": ["count", "direction", "energy", "plane", "skip", "t_end", "vertical"],
    bifurcation: ["direction", "plane", "skip", "sweep", "t_end", "vertical"],
    uncertainty: ["distribution", "runs", "share", "t_end", "tolerance", "tolerances", "uncertain"],
    basins: ["count", "horizontal", "pairs", "t_end", "vertical", "x_from", "x_to", "y_to"], fidelity: ["t_end", "tolerance"],
  });
  assert.equal(/** @type {any} */ (requestOf({ ...ASKED, lab: "fidelity" }, "kapitza", "en")).tolerance, 0.005);
  const body = /** @type {any} */ (requestOf({ ...ASKED, lab: "uncertainty" }, "kapitza", "en"));
  assert.deepEqual([body.tolerances, body.share], [{ phi: 0.1, "dot(phi)": 0.25, l: NaN }, 0.1]);
});

test("a sweep begins beside a drive at rest, with fewer values where motions jump or stick", () => {
  const parameters = [{ name: "a", value: 1, min: 0.5, max: 2 }, { name: "omega", value: 3, min: 0, max: 40 }];
  const usual = (/** @type {object} */ scene) => answered({ ...NOTHING, lab: "bifurcation" }, /** @type {any} */ ({ parameters, ...scene })).sweep;
  const range = { parameter: "omega", from: 2, to: 40 };
  assert.deepEqual(usual({}), range);
  assert.deepEqual(usual({ events: [{ name: "hit", value: "z", then: "bounce" }] }), { ...range, count: 24 });
  assert.deepEqual(usual({ loads: [{ kind: "friction", name: "rubbing" }] }), { ...range, count: 24 });
  assert.deepEqual(usual({ events: [{ name: "end", value: "z" }], loads: [{ kind: "gravity", name: "weight" }] }), range);
  assert.deepEqual(usual({ parameters: parameters.slice(0, 1) }), { parameter: "a", from: 0.5, to: 2 });
});

test("a place on a map is two parameters, or two angles at rest", () => {
  assert.deepEqual(pointOf(ASKED, { role: "map", x: "omega", y: "y0" }, 30, 0.1), { parameters: { l: 0.4, omega: 30, y0: 0.1 }, initial: ASKED.initial });
  assert.deepEqual(pointOf(ASKED, { role: "flips", x: "a", y: "b" }, 1, 2), { parameters: { l: 0.4 }, initial: { phi: { value: -1.5, rate: 0 }, a: { value: 1, rate: 0 }, b: { value: 2, rate: 0 } } });
  assert.deepEqual(pointOf(ASKED, { role: "basins", x: "phi", y: "dot(phi)" }, 1, -3), { parameters: { l: 0.4 }, initial: { phi: { value: 1, rate: -3 } } });
});

test("a place in a bifurcation diagram is the motion next to it, of the part that is pressed", () => {
  const motion = (/** @type {number} */ value, /** @type {number[]} */ seen, initial = { phi: { value, rate: seen[0] } }) => ({ value, seen, initial });
  const result = /** @type {any} */ ({
    parameter: "gamma", up: [motion(1, [5]), motion(2, [6]), { value: 3, seen: [], initial: null }], down: [motion(2, [7])],
    branches: [{ motions: [] }, { motions: [motion(1, [0]), motion(2, [1]), motion(2, [4, 9])] }],
    bifurcations: [{ ...motion(1.5, [3]), kind: "torus" }, { ...motion(1.4, [3]), kind: "saddle-node" }],
  });
  const at = (/** @type {any} */ meaning, /** @type {number} */ x, y = 0) => motionAt(result, meaning, x, y)?.initial.phi;
  assert.deepEqual(at({ role: "sweep", part: "up" }, 2.9), { value: 2, rate: 6 });
  assert.deepEqual(at({ role: "sweep", part: "down" }, 1), { value: 2, rate: 7 });
  assert.deepEqual(at({ role: "branch", part: "1" }, 2, 8.5), { value: 2, rate: 4 });
  assert.deepEqual(at({ role: "bifurcation", part: "torus" }, 1.4), { value: 1.5, rate: 3 });
  assert.equal(at({ role: "branch", part: "0" }, 2), undefined);
  assert.equal(at({ role: "eigenvalues" }, 2), undefined);
  assert.deepEqual(motionAt(result, { role: "sweep", part: "up" }, 1, 0)?.parameters, { gamma: 1 });
});

const PALETTE = { ink: "ink", muted: "muted", grid: "grid", paper: "paper" };
const CHART = { id: "c", title: "", subject: "", caption: "", data: [{ name: "a", x: [1], y: [2], marker: { color: "#222222" }, meta: { role: "eigenvalues" } }, { name: "b", x: [1], y: [2] }], layout: { xaxis: { title: "x" }, legend: { x: 1.02 }, font: {} } };

test("a chart takes the page's colours, and puts the legend below where it is narrow", () => {
  const wide = themed(CHART, PALETTE, 1000, 16, "de");
  const narrow = themed(CHART, PALETTE, 320, 16, "en");
  assert.equal(wide.data[0].marker.color, "ink");
  assert.equal(wide.layout.xaxis.gridcolor, "grid");
  assert.equal(wide.layout.xaxis.title, "x");
  assert.deepEqual([wide.layout.separators, narrow.layout.separators], [",.", ".,"]);
  assert.deepEqual([wide.layout.legend.orientation, narrow.layout.legend.orientation], [undefined, "h"]);
  assert.ok(narrow.layout.height > wide.layout.height);
  const wall = themed(CHART, PALETTE, 3000, 40, "de");
  assert.equal(wall.data[0].marker.size / wide.data[0].marker.size, 40 / 16);
  assert.equal(CHART.data[0].marker?.color, "#222222");
  const lined = { ...CHART, data: [{ name: "a", line: { color: "#222222" } }] };
  assert.equal(themed(lined, PALETTE, 900, 16, "en").data[0].line?.color, "ink");
  const ringed = { ...CHART, data: [{ name: "a", marker: { color: "#0072b2", line: { color: "#222222", width: 3 } } }] };
  assert.deepEqual(themed(/** @type {any} */ (ringed), PALETTE, 1000, 16, "de").data[0].marker, { color: "#0072b2", size: 6, line: { color: "ink", width: 3 } });
});

test("the crosses follow the step, and nothing else does", () => {
  const { data } = withStep(CHART, 0.5);
  assert.deepEqual([data[0].x, data[0].y, data[1].x], [[0.5], [1], [1]]);
  assert.equal(withTolerance(CHART, 1e-3, "grey").layout.shapes[0].y0, 1e-3);
});

test("the cheapest run for a tolerance is that of the next finer wish", () => {
  const runs = [1e-2, 1e-4, 1e-6].map((wanted, i) => ({ wanted, method: `m${i}`, time: i }));
  assert.deepEqual([0.5, 1e-2, 1e-3, 1e-6, 1e-9].map((tolerance) => cheapestFor(runs, tolerance)?.method), ["m0", "m0", "m1", "m2", undefined]);
});

test("the slider of h reaches from where nothing fails to where all explicit methods have", () => {
  assert.deepEqual(stepRange([[0, 10], [-3, 4]]), [0.002, 0.8]);
  assert.deepEqual(stepRange([]), [0.02, 8]);
});

test("what is watched keeps the question's values unless it has its own", () => {
  const watched = motionOf(ASKED, { method: "rk4", step: 0.1, t_end: 2 }, "kapitza", "en");
  assert.deepEqual([watched.parameters, watched.step, watched.t_end], [{ l: 0.4 }, 0.1, 2]);
  assert.deepEqual(motionOf(ASKED, { parameters: { l: 1 } }, "kapitza", "en").parameters, { l: 1 });
  const point = { parameters: { l: 0.123456 }, initial: { phi: { value: 1 } } };
  assert.equal(written(point, "en"), "l = 0.1235; phi = 1");
  assert.equal(written(point, "de"), "l = 0,1235; phi = 1");
});

test("what is pointed at last is played, however late what was pointed at before comes", async () => {
  /** @type {((answer: any) => void)[]} */
  const answers = [];
  const watching = createWatch({ simulate: () => new Promise((done) => answers.push((/** @type {string} */ method) => done({ t: [0], method }))) });
  /** @type {any[]} */
  const played = [];
  const asked = [1, 2, 3].map(() => watching.ask({ t_end: 1, samples: 1 }, ({ method }) => played.push(method), () => played.push("failed")));
  for (const which of [1, 2, 0]) answers[which](which);
  await Promise.all(asked);
  const forgotten = watching.ask({ t_end: 1, samples: 1 }, ({ method }) => played.push(method), () => played.push("failed"));
  watching.forget();
  answers[3](3);
  await forgotten;
  assert.deepEqual(played, [2]);
});

test("rungs are named by what they leave out", () => {
  const t = (/** @type {string} */ key, /** @type {any} */ given = {}) => `${key.split(".")[2]}(${Object.values(given)})`;
  assert.equal(titleOf({ parts: [] }, t), "full()");
  assert.equal(titleOf({ parts: [{ kind: "rigid", parameters: { load: "spring" } }, { kind: "linearized", parameters: {} }] }, t), "rigid(spring), linearized()");
  const names = { phi: "φ", psi: "ψ", spring: { de: "Feder", en: "spring" } };
  const parts = [{ kind: "rigid", parameters: { load: "spring" } }, { kind: "cyclic", parameters: { coordinate: "phi, psi" } }];
  assert.equal(titleOf({ parts }, t, names, "de"), "rigid(Feder), cyclic(φ, ψ)");
});

test("symbols in a menu are letters, not their names", () => {
  const shown = { "\\omega": "ω", "\\varphi_{1}": "φ₁", y0: "y₀", "\\ell": "ℓ", m: "m", "k_2": "k₂", "c_d": "c_d", phi1: "φ₁" };
  assert.deepEqual(Object.keys(shown).map(inUnicode), Object.values(shown));
});

test("a legend below a narrow chart breaks its lines and has room for them", () => {
  const chart = /** @type {any} */ ({ id: "a", data: [{ name: "Symplektisches Euler-Verfahren: nicht einmal die erste Ziffer bleibt" }], layout: {} });
  const palette = { ink: "", muted: "", grid: "", paper: "" };
  const [narrow, wide] = [328, 1200].map((width) => themed(chart, palette, width, 16, "de"));
  assert.equal(narrow.data[0].name, "Symplektisches Euler-Verfahren: nicht<br>einmal die erste Ziffer bleibt");
  assert.equal(wide.data[0].name, chart.data[0].name);
  assert.ok(Math.abs(narrow.layout.height - wide.layout.height - 2 * 1.35 * 16) < 1e-9);
});

const SCENE = /** @type {any} */ ({ id: "pendulum", parameters: [], coordinates: [] });

test("the bench shows parts, then the result; stopped, it keeps what was measured", async () => {
  /** @type {(() => void)[]} */
  const ends = [];
  const run = (/** @type {string} */ name, /** @type {object} */ body, /** @type {(part: any) => void} */ hear) => new Promise((done) => {
    hear({ done: 1, total: 4, charts: [name] });
    ends.push(() => done({ experiment: name, charts: [name, body] }));
  });
  const bench = createBench(/** @type {any} */ ({ run, scene: async () => SCENE, document: (/** @type {string} */ id) => id, lang: () => "en" }), { ...NOTHING, scene: "pendulum" });
  await bench.load();
  const first = bench.start();
  assert.deepEqual([bench.get().running, bench.get().progress, bench.get().charts], [true, 0.25, ["work-precision"]]);
  ends[0]();
  await first;
  assert.deepEqual([bench.get().running, bench.get().progress, bench.get().result?.experiment], [false, 1, "work-precision"]);
  const second = bench.start();
  bench.stop();
  ends[1]();
  await second;
  assert.deepEqual([bench.get().running, bench.get().stopped, bench.get().charts.length, bench.get().result], [false, "stopped", 1, null]);
});

test("the bench says where an experiment stands in the queue until it is measured, stopped or refused", async () => {
  /** @type {any[]} */
  const seen = [];
  const place = { place: 3, seconds: 40 };
  const bench = createBench(/** @type {any} */ ({
    run: async (/** @type {any} */ ...[, , hear, , , wait]) => {
      wait(place);
      seen.push(bench.get().waiting);
      if (seen.length === 2) throw new ApiError({ title: "Busy", detail: "", problems: [], status: 503 });
      if (seen.length === 3) return new Promise(() => {});
      hear({ done: 1, total: 4, charts: [] });
      seen.push(bench.get().waiting);
      return { experiment: "chaos", charts: [] };
    },
    scene: async () => SCENE, document: (/** @type {string} */ id) => id, lang: () => "en",
  }), { ...NOTHING, scene: "pendulum" });
  await bench.start();
  assert.deepEqual([seen, bench.get().waiting], [[place, null], null]);
  seen.pop();
  await bench.start();
  assert.deepEqual([seen, bench.get().waiting, bench.get().failure?.status], [[place, place], null, 503]);
  void bench.start();
  assert.deepEqual(bench.get().waiting, place);
  bench.stop();
  assert.deepEqual([bench.get().waiting, bench.get().running], [null, false]);
});

test("a file that cannot be had is told, and what was measured stays", async () => {
  const run = async () => ({ experiment: "chaos", charts: ["c"] });
  const bench = createBench(/** @type {any} */ ({ run, scene: async () => SCENE, document: (/** @type {string} */ id) => id, lang: () => "en" }), { ...NOTHING, scene: "pendulum" });
  await bench.start();
  const failure = { title: "Busy", detail: "", problems: [], status: 503 };
  bench.fail(new ApiError(failure));
  assert.deepEqual([bench.get().failure, bench.get().charts], [failure, ["c"]]);
});

test("the same question is measured anew, another one is not", async () => {
  /** @type {boolean[]} */
  const asked = [];
  const run = async (/** @type {any[]} */ ...[name, , , , anew]) => { asked.push(anew); return { experiment: name, charts: [] }; };
  const bench = createBench(/** @type {any} */ ({ run, scene: async () => SCENE, document: (/** @type {string} */ id) => id, lang: () => "en" }), { ...NOTHING, scene: "pendulum" });
  await bench.start();
  await bench.start();
  bench.edit({ duration: 3 });
  await bench.start();
  bench.open("convergence");
  await bench.start();
  assert.deepEqual(asked, [false, true, false, false]);
});

test("in another language what was measured is told again, never measured anew, and stays until it is", async () => {
  /** @type {[string, boolean][]} */
  const asked = [];
  let lang = "en";
  const run = async (/** @type {any[]} */ ...[, body, , , anew]) => { asked.push([body.lang, anew]); return { experiment: "chaos", charts: [body.lang] }; };
  const bench = createBench(/** @type {any} */ ({ run, scene: async () => SCENE, document: (/** @type {string} */ id) => id, lang: () => lang }), { ...NOTHING, scene: "pendulum" });
  await bench.retell();
  assert.deepEqual(asked, []);
  await bench.start();
  lang = "de";
  const told = bench.retell();
  assert.deepEqual([bench.get().charts, bench.get().result?.charts], [["en"], ["en"]]);
  await told;
  await bench.retell();
  assert.deepEqual(bench.get().charts, ["de"]);
  assert.deepEqual(asked, [["en", false], ["de", false], ["de", false]]);
});

test("every experiment with a file is known by its name, and every answer has a place of its own in the address", () => {
  const named = readdirSync(new URL("../../frontend/model/labs/experiments/", import.meta.url)).map((file) => file.replace(".js", ""));
  assert.deepEqual(named.filter((lab) => KNOWN.experiment(lab).example === KNOWN.experiment("alchemy").example), []);
  const keys = [...KNOWN.options("chaos").map(({ key }) => key), "lab", "scene", "lang", "theme"];
  assert.deepEqual(keys.length, new Set(keys).size);
});

test("an experiment without options of its own needs no file", () => {
  assert.deepEqual(requestOf({ ...NOTHING, lab: "alchemy", scene: "pendulum", duration: 3, flips: false }, "pendulum", "en"), { scene: "pendulum", parameters: {}, initial: {}, lang: "en", t_end: 3 });
  assert.equal(exampleOf("alchemy").scene, "double-pendulum");
});

/** @type {any} */
const MENU = [
  { id: "chaos", options: [{ name: "t_end", kind: "number", default: 30, min: 1e-6, max: 200, choices: [] }] },
  { id: "energy-drift", options: [{ name: "steps", kind: "number", default: 1e5, min: 1e3, max: 1e5, choices: [] }] },
  { id: "fidelity", options: [{ name: "tolerance", kind: "number", default: null, min: 1e-9, max: 10, choices: [] }] },
  { id: "stability", options: [{ name: "at", kind: "choice", default: "state", choices: ["state"] }] },
  {
    id: "alchemy",
    options: [
      { name: "t_end", kind: "number", default: 5, min: 0, max: 50, choices: [] },
      { name: "digits", kind: "number", default: 12, min: 2, max: 15, choices: [], description: "significant digits" },
      { name: "apart", kind: "number", default: null, min: 0, max: 1, choices: [] },
      { name: "sorted", kind: "tick", default: true, choices: [] },
      { name: "at", kind: "choice", default: "noon", choices: ["noon", "night"] },
    ],
  },
];
const SERVED = experimentsOf(MENU);
/** @param {string} lab @param {string} wanted */
const option = (lab, wanted) => SERVED.experiment(lab).options.find(({ name }) => name === wanted);

test("bounds and defaults are those that the service tells", () => {
  assert.deepEqual(option("chaos", "duration")?.range, { shown: 30, min: 1e-6, max: 200 });
  assert.deepEqual(option("fidelity", "allowed")?.range, { shown: 1, min: 1e-7, max: 1000 });
  assert.deepEqual(option("energy-drift", "steps")?.choices, [1e3, 1e4, 1e5]);
  assert.deepEqual(option("stability", "at")?.choices, ["state"]);
  assert.equal(option("stability", "duration")?.range, undefined);
});

test("an experiment of which only the service knows is asked whatever may be asked of it", () => {
  const { options } = SERVED.experiment("alchemy");
  assert.deepEqual(options.map(({ name, kind }) => [name, kind]), [["duration", "number"], ["digits", "number"], ["apart", "number"], ["sorted", "tick"], ["at", "choice"]]);
  assert.deepEqual(option("alchemy", "digits")?.range, { shown: 12, min: 2, max: 15 });
  assert.equal(option("alchemy", "digits")?.label, "experiments.alchemy.options.digits");
  const usual = readQuestion("?lab=alchemy&scene=pendulum", SERVED);
  assert.deepEqual(requestOf(usual, "pendulum", "en", SERVED), { scene: "pendulum", parameters: {}, initial: {}, lang: "en" });
  assert.deepEqual(inLab({ ...NOTHING, scene: "pendulum" }, "alchemy", SERVED).digits, 12);
  const given = { ...usual, duration: 3, digits: 6, apart: 0.5, sorted: false, at: "night" };
  assert.deepEqual(readQuestion(`?${writeQuestion(given, SERVED)}`, SERVED), given);
  const { t_end, digits, apart, sorted, at } = /** @type {any} */ (requestOf(given, "pendulum", "en", SERVED));
  assert.deepEqual({ t_end, digits, apart, sorted, at }, { t_end: 3, digits: 6, apart: 0.5, sorted: false, at: "night" });
  assert.deepEqual(readQuestion("?lab=alchemy&digits=x&at=never&sorted=2", SERVED), { ...usual, scene: "" });
});

test("what was said of one scene is not said of another", () => {
  const { x, y, stiffness, parameters, initial, steps, scene } = onScene(ASKED, "pendulum");
  assert.deepEqual({ x, y, stiffness, parameters, initial, steps, scene }, { x: null, y: null, stiffness: "", parameters: {}, initial: {}, steps: 1000, scene: "pendulum" });
});

test("a map begins with the parameters that drive its scene", () => {
  const driven = { ...SCENE, parameters: [{ name: "l", value: 1 }, { name: "y0", value: 2, min: 0, max: 3 }, { name: "omega", value: 4 }] };
  const question = answered({ ...NOTHING, lab: "stability-map", scene: "own" }, /** @type {any} */ (driven));
  assert.deepEqual([question.x, question.y], [{ parameter: "omega", from: 2, to: 8 }, { parameter: "y0", from: 0, to: 3 }]);
  assert.deepEqual(answered(ASKED, /** @type {any} */ (driven)), ASKED);
});

test("a lab opens on its own example as long as nobody has chosen a scene: chaos on a chaotic motion", () => {
  const opened = { ...NOTHING, ...exampleOf("work-precision") };
  const chaos = inLab(opened, "chaos");
  assert.deepEqual([chaos.scene, chaos.initial], ["double-pendulum", { phi1: { value: 2 }, phi2: { value: 2.5 } }]);
  const back = inLab(chaos, "work-precision");
  assert.deepEqual([back.scene, back.initial], [opened.scene, {}]);
  const chosen = { ...opened, initial: { phi1: { value: 0.1 } } };
  assert.deepEqual(inLab(chosen, "chaos").initial, chosen.initial);
});

test("another lab keeps the scene, but for the map, which needs a driven one", async () => {
  const bench = createBench(/** @type {any} */ ({ run: async () => {}, scene: async () => SCENE, document: (/** @type {string} */ id) => id, lang: () => "en" }), { ...NOTHING, scene: "pendulum" });
  bench.open("chaos");
  assert.deepEqual([bench.get().question.lab, bench.get().question.scene], ["chaos", "pendulum"]);
  bench.open("stability-map");
  assert.deepEqual([bench.get().question.scene, bench.get().question.x?.parameter], ["kapitza", "omega"]);
});

const MAP = { meta: { role: "map", x: "omega", y: "y0" }, x: [10, 20, 30], y: [0.1, 0.2], z: [[0, 1, 2], [3, null, 5]] };

test("arrow keys move over a map, as far as it goes", () => {
  const rows = /** @type {const} */ ([
    ["ArrowRight", false, { column: 2, row: 1 }],
    ["ArrowLeft", true, { column: 0, row: 1 }],
    ["ArrowUp", false, { column: 1, row: 1 }],
    ["ArrowDown", false, { column: 1, row: 0 }],
    ["a", false, null],
  ]);
  for (const [key, wide, place] of rows) assert.deepEqual(moved(middleOf(MAP), key, wide, MAP), place);
});

test("a map says what is at a place, even if it has become coarser", () => {
  assert.deepEqual(seenAt({ column: 0, row: 1 }, MAP), { x: 10, y: 0.2, value: 3 });
  assert.deepEqual(seenAt({ column: 1, row: 1 }, MAP), { x: 20, y: 0.2, value: null });
  assert.deepEqual(seenAt({ column: 9, row: 9 }, MAP), { x: 30, y: 0.2, value: 5 });
});

test("only maps take the keyboard", () => {
  const chart = (/** @type {any[]} */ ...data) => /** @type {any} */ ({ data });
  assert.equal(mapOf(chart({ meta: { role: "eigenvalues" } }, MAP)), MAP);
  assert.equal(mapOf(chart({})), null);
});
