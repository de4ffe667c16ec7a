import { strict as assert } from "node:assert";
import { test } from "node:test";
import { evaluator } from "../../frontend/model/kinematics/expression.js";
import { configured, kinematicsOf } from "../../frontend/model/kinematics/kinematics.js";
import { reached } from "../../frontend/model/kinematics/reach.js";
import { snapshotAt } from "../../frontend/model/trajectory.js";
import { readChoice, writeChoice } from "../../frontend/model/virtual/choice.js";
import { frictionOf, reactionOf, releasedOf, stressOf } from "../../frontend/model/figure/reactions.js";
import { vectorFigure, vectorSymbols } from "../../frontend/model/figure/vectors.js";
import { virtualFigure } from "../../frontend/model/virtual/figure.js";
import { virtualOf } from "../../frontend/model/virtual/virtual.js";
import { stageOf } from "../../frontend/model/drawing/stage.js";
import { scene, square, trajectory } from "./fixtures.js";

const VALUES = { x: 3, y: 2, l: 0.5, phi: 0.4, t: 2, "dot(phi)": 7, "delta(phi)": 0.1 };
/** @type {[string, number][]} */
const EXPRESSIONS = [
  ["2*x - y/4", 5.5],
  ["x - y - 1", 0],
  ["-x^2", -9],
  ["2^3^2", 512],
  ["x^(-1)", 1 / 3],
  ["-(x + y)*l", -2.5],
  ["l*sin(phi)", 0.5 * Math.sin(0.4)],
  ["atan2(y, x)", Math.atan2(2, 3)],
  ["dot(phi)^2*delta(phi)", 4.9],
  ["1.5e-3*t", 0.003],
  ["cos(pi)", -1],
];
for (const [text, value] of EXPRESSIONS) {
  test(`the value of ${text}`, () => assert.ok(Math.abs(evaluator(text)(VALUES) - value) < 1e-12));
}
for (const text of ["", "x +", "(x", "x y", "f(x)", "x; y", "2**x", "x)"]) {
  test(`“${text}” is refused`, () => assert.throws(() => evaluator(text), SyntaxError));
}
test("an unknown name has no value", () => assert.ok(Number.isNaN(evaluator("z + 1")(VALUES))));

/** The pendulum of the fixtures on a base that a guide moves: y = 0.5 sin t. */
const RESULT = {
  points: { pivot: { plain: ["0", "0.5*sin(t)"] } },
  positions: { bob: { plain: ["sin(phi)", "0.5*sin(t) + cos(phi)"] } },
  virtual_work: { terms: [{ plain: "-m*g*sin(phi)*delta(phi)", sources: ["load:weight"] }, { plain: "2*delta(phi)", sources: ["load:F"] }] },
};
const guided = { ...scene, guides: [{ coordinate: "y", value: "0.5*sin(t)" }] };
const kinematics = kinematicsOf(guided, RESULT, { m: 2 });
const near = (/** @type {number[]} */ a, /** @type {number[]} */ b) => a.every((x, i) => Math.abs(x - b[i]) < 1e-6);

test("a place for any values of the coordinates, and its slope with and without time", () => {
  assert.deepEqual(kinematics.free, ["phi"]);
  assert.ok(near(kinematics.places({ y: 0, phi: 0 }, Math.PI / 2).bob, [0, 1.5]));
  assert.ok(near(kinematics.slope({ y: 0, phi: 0.3 }, 1, { phi: 2 }).bob, [2 * Math.cos(0.3), -2 * Math.sin(0.3)]));
  assert.ok(near(kinematics.slope({ y: 0, phi: 0.3 }, 1, {}, 1).bob, [0, 0.5 * Math.cos(1)]));
});

test("the work of each load, with parameters as changed", () => {
  const [weight, force] = kinematics.works({ y: 0, phi: 0.5 }, {}, 0, { phi: 0.1 });
  assert.deepEqual([weight.load, force.load], ["weight", "F"]);
  assert.ok(Math.abs(weight.work + 2 * 9.81 * Math.sin(0.5) * 0.1) < 1e-12);
  assert.equal(force.work, 0.2);
});

const now = { ...snapshotAt(trajectory, 1), rates: { y: 0, phi: 0.25 } };

test("the variation stands still in time, the differential does not", () => {
  const { displacements: [bob], later } = virtualOf(kinematics, now, ["bob"], { delta: { phi: 0.25 * 0.2 }, dt: 0.2 });
  assert.ok(near(bob.variation, bob.frozen), "the motion's own change of the coordinates, as a variation");
  assert.ok(near(bob.explicit, [0, 0.2 * 0.5 * Math.cos(1)]), "what the guide adds");
  assert.ok(near(later?.positions.pivot ?? [], [0, 0.5 * Math.sin(1.2)]));
  assert.equal(virtualOf(kinematics, now, ["bob"], { delta: {}, dt: 0 }).later, null);
});

test("the ghost has the members and nothing else; each displacement has its arrow", () => {
  const stage = stageOf(guided, trajectory, square(400));
  const figure = virtualFigure(stage, virtualOf(kinematics, now, ["bob"], { delta: { phi: 0.5 }, dt: 0.4 }));
  const kinds = new Set(figure.under.shapes.map(({ key }) => key.replace(/\d.*/, "")));
  assert.deepEqual([...kinds], ["ghost-varied rod", "ghost-varied bob", "ghost-later rod", "ghost-later bob"]);
  assert.deepEqual(figure.over.labels.map(({ key }) => key), ["variation-bob", "differential-bob", "explicit-bob"]);
});

test("where several coordinates move a place, δr is made of their parts, one after the other", () => {
  const free = kinematicsOf(scene, { ...RESULT, points: { pivot: { plain: ["0", "y"] } }, positions: { bob: { plain: ["sin(phi)", "y + cos(phi)"] } } }, {});
  const stage = stageOf(scene, trajectory, square(400));
  const { over } = virtualFigure(stage, virtualOf(free, now, ["bob"], { delta: { y: 0.4, phi: 0.5 }, dt: 0 }));
  assert.deepEqual(over.labels.map(({ latex }) => latex), ["\\delta\\mathbf r", "\\frac{\\partial\\mathbf r}{\\partial q_1}\\,\\delta q_1", "\\frac{\\partial\\mathbf r}{\\partial q_2}\\,\\delta q_2"]);
  const [whole, ...ends] = over.shapes.filter(({ key }) => /head/.test(key)).map(({ d }) => d.slice(1).split("L")[0].split(" ").map(Number));
  const [x, y] = stage.project(now.positions.bob);
  assert.ok(Math.hypot(ends[0][0] - x, ends[0][1] - y - 0.4 * stage.scale) < 0.02, "δy alone moves the bob down");
  assert.ok(Math.hypot(ends[1][0] - whole[0], ends[1][1] - whole[1]) < 0.02, "the parts end where δr does");
  assert.equal(virtualFigure(stage, virtualOf(free, now, ["bob"], { delta: { phi: 0.5 }, dt: 0 })).over.labels.length, 1);
});

test("a place is brought where the hand is, or as near as it can come", () => {
  const project = (/** @type {number[]} */ [x, y]) => /** @type {[number, number]} */ ([100 * x, 100 * y]);
  const free = kinematicsOf(scene, { ...RESULT, points: { pivot: { plain: ["0", "y"] } }, positions: { bob: { plain: ["sin(phi)", "y + cos(phi)"] } } }, {});
  const there = reached(free, "bob", { y: 0, phi: 0.2 }, 0, [60, 110], project);
  assert.ok(near(configured(free, now, there).positions.bob, [0.6, 1.1]));
  const nearest = reached(kinematics, "bob", { y: 0, phi: 0.2 }, 0, [300, 0], project);
  assert.ok(Math.abs(nearest.phi - Math.PI / 2) < 1e-2 && nearest.y === 0);
});

test("what is varied has an address; at first something is", () => {
  const free = scene.coordinates;
  assert.equal(writeChoice(readChoice("y:0.1,phi:-0.2,dt:0.3", free)), "y:0.1,phi:-0.2,dt:0.3");
  assert.ok(Object.values(readChoice("on", free).delta).some((value) => value > 0));
  assert.deepEqual(readChoice("phi:9,dt:-1,z:3", free), { delta: { y: 0, phi: 1 }, dt: 0 });
});

test("r leads from the origin to its body, v along its motion, with the symbols of the formulas", () => {
  const stage = stageOf(guided, trajectory, square(400));
  const step = /** @type {any} */ ({ marked: "\\htmlClass{body-bob vector-r}{\\mathbf{r}_{\\text{el}}} = \\htmlClass{body-bob}{\\delta\\mathbf{r}_{\\text{x}}} + \\htmlClass{body-bob}{\\mathbf{v}}" });
  const symbols = vectorSymbols([{ steps: [step] }]);
  const at = (/** @type {number} */ t) => ({ ...snapshotAt(trajectory, t), rates: { y: 0, phi: 0.25 } });
  const arrows = /** @type {const} */ ([{ of: "bob", vector: "r" }, { of: "bob", vector: "v" }, { of: "none", vector: "v" }]);
  const { shapes, labels } = vectorFigure(stage, now, arrows, { kinematics, symbols, at, multipliers: () => ({}), frictions: () => ({}), end: 4 });
  assert.deepEqual(labels.map(({ latex }) => latex), ["\\mathbf{r}_{\\text{el}}", "\\mathbf{v}"]);
  const ends = shapes.map(({ d }) => [d.slice(1).split("L")[0], d.slice(d.lastIndexOf("M") + 1).split("L")[0]].map((pair) => pair.split(" ").map(Number)));
  const [[origin, tip], [from, to]] = ends;
  const close = (/** @type {number[]} */ a, /** @type {number[]} */ b) => assert.ok(Math.hypot(a[0] - b[0], a[1] - b[1]) < 0.02, `${a} ${b}`);
  close(origin, stage.project([0, 0]));
  close(tip, stage.project(now.positions.bob));
  close(from, stage.project(now.positions.bob));
  const [vx, vy] = [0.25 * Math.cos(0.25), 0.5 * Math.cos(1) - 0.25 * Math.sin(0.25)];
  assert.ok(Math.abs(Math.atan2(to[1] - from[1], to[0] - from[0]) - Math.atan2(vy, vx)) < 1e-3);
});

/** Two particles on rods from the origin, in Cartesian coordinates, and one whose velocity keeps to a direction. */
const rods = /** @type {any} */ ({
  dimension: 2, coordinates: ["x", "y", "u", "w", "phi"].map((name) => ({ name })), parameters: [], bodies: [{ name: "upper" }, { name: "lower" }], loads: [], points: [{ name: "pivot" }],
  constraints: [{ name: "first", kind: "distance", from: "pivot", to: "upper" }, { name: "second", kind: "distance", from: "upper", to: "lower" }, { name: "edge", kind: "equation" }, { name: "both", kind: "equation" }],
});
const expressed = (/** @type {Record<string, string>} */ forces) => Object.entries(forces).map(([coordinate, plain]) => ({ coordinate, plain }));
const held = kinematicsOf(rods, /** @type {any} */ ({
  points: { pivot: { plain: ["0", "0"] }, tip: { plain: ["u + 2*cos(phi)", "w + 2*sin(phi)"] } },
  positions: { upper: { plain: ["x", "y"] }, lower: { plain: ["u", "w"] } },
  constraints: [
    { name: "first", multiplier: { plain: "S" }, forces: expressed({ x: "-S*x/sqrt(x^2 + y^2)", y: "-S*y/sqrt(x^2 + y^2)" }) },
    { name: "second", multiplier: { plain: "T" }, forces: [] },
    { name: "edge", multiplier: { plain: "lambda" }, forces: expressed({ u: "-3*lambda*sin(phi)", w: "3*lambda*cos(phi)", phi: "6*lambda" }) },
    { name: "both", multiplier: { plain: "mu" }, forces: expressed({ x: "mu", phi: "mu" }) },
  ],
}), {});

test("a rod pulls at both ends that can move, and a constraint acts at the place whose work is the same", () => {
  const here = /** @type {any} */ ({ t: 0, coordinates: { x: 3, y: 4, u: 3, w: 6, phi: 0.5 }, rates: {}, positions: { pivot: [0, 0], upper: [3, 4], lower: [3, 6] } });
  const of = (/** @type {string} */ name) => reactionOf(rods, held, here, { S: 10, T: 2, lambda: 4, mu: 1 }, name);
  const places = (/** @type {ReturnType<typeof of>} */ found) => found.map(({ place, force, plain }) => [place, ...force.map((x) => Number(x.toFixed(6)) + 0), plain]);
  assert.deepEqual(places(of("first")), [["upper", -6, -8, true]]);
  assert.deepEqual(places(of("second")), [["lower", 0, -2, true], ["upper", 0, 2, true]]);
  const [edge] = of("edge");
  assert.deepEqual([edge.place, edge.plain], ["tip", false]);
  assert.ok(near(edge.force, [-12 * Math.sin(0.5), 12 * Math.cos(0.5)]));
  assert.deepEqual([of("both"), of("none")], [[], []]);
});

test("friction acts at the place that its coordinate alone moves, along that way", () => {
  const slide = /** @type {any} */ ({ dimension: 2, coordinates: [{ name: "s", unit: "m" }, { name: "phi", unit: "rad" }], parameters: [], bodies: [{ name: "block" }], points: [], loads: [{ name: "dry", kind: "friction", coordinate: "s" }, { name: "pivot", kind: "friction", coordinate: "phi" }] });
  const positions = { block: { plain: ["0.8*s", "0.6*s"] }, bob: { plain: ["0.8*s + 2*sin(phi)", "0.6*s - 2*cos(phi)"] } };
  const moving = kinematicsOf(slide, /** @type {any} */ ({ points: {}, positions }), {});
  const here = /** @type {any} */ ({ t: 0, coordinates: { s: 1, phi: 0.3 }, rates: {}, positions: {} });
  const [found, ...others] = frictionOf(slide, moving, here, { dry: -5, pivot: 2 }, "dry");
  assert.deepEqual([found.place, found.plain, others], ["block", true, []]);
  assert.ok(near(found.force, [-4, -3]));
  assert.deepEqual(frictionOf(slide, moving, here, { dry: -5, pivot: 2 }, "pivot"), [], "a moment is no force at one place");
  assert.deepEqual(frictionOf(slide, moving, here, {}, "dry"), []);
});

/** A rod on a pivot, and what is released of it: its length, the height of its pivot, and a radius that nothing is drawn with. */
const hung = /** @type {any} */ ({
  dimension: 2, coordinates: [{ name: "phi" }], parameters: [{ name: "l", value: 2 }, { name: "R", value: 2 }], bodies: [{ name: "bob" }], loads: [], points: [{ name: "pivot" }],
  drawing: { elements: [{ kind: "rod", from: "pivot", to: "bob", label: "l" }] },
});
const away = { bob: ["sin(phi)", "-cos(phi)"] };
const whole = (/** @type {string} */ kind) => kinematicsOf(hung, /** @type {any} */ ({
  points: { pivot: { plain: ["0", "0"] } },
  positions: { bob: { plain: ["l*sin(phi)", "-l*cos(phi)"] } },
  reactions: [
    { name: "l", kind, displacements: away },
    { name: "R", kind: "length", displacements: away },
    { name: "y", kind: "guide", displacements: { bob: ["0", "1"], pivot: ["0", "1"] } },
  ],
}), {});
const swung = /** @type {any} */ ({ t: 0, coordinates: { phi: 0.5 }, rates: { phi: 0 }, positions: { pivot: [0, 0], bob: [2 * Math.sin(0.5), -2 * Math.cos(0.5)] } });
/** @type {[string, string, string, string, (number | string | boolean)[][]][]} */
const RELEASED = [
  ["a rod pulls what hangs on it", "length", "l", "tension", [["bob", -3 * Math.sin(0.5), 3 * Math.cos(0.5), true]]],
  ["a rod with mass pulls where it hangs", "rod", "l", "tension", [["pivot", 3 * Math.sin(0.5), -3 * Math.cos(0.5), true]]],
  ["what no rod is drawn with is held where it is", "length", "R", "", [["bob", -3 * Math.sin(0.5), 3 * Math.cos(0.5), true]]],
  ["a guide acts where it alone works", "length", "y", "", [["pivot", 0, -3, true]]],
];
for (const [title, kind, name, stress, expected] of RELEASED) {
  test(`${title}: where what is released is held`, () => {
    const moving = whole(kind);
    const found = releasedOf(hung, moving, swung, { [name]: -3 }, name);
    const round = (/** @type {unknown} */ x) => (typeof x === "number" ? Number(x.toFixed(4)) + 0 : x);
    assert.deepEqual(found.map(({ place, force, plain }) => [place, ...force, plain].map(round)), expected.map((row) => row.map(round)));
    const stressed = stressOf(hung, moving, swung, { [name]: -3 }, name);
    assert.deepEqual(stressed && [stressed.ends, stressed.tension], stress ? [["pivot", "bob"], 3] : null);
    assert.deepEqual(releasedOf(hung, moving, swung, {}, name), [], "nothing is drawn where it is not determined");
  });
}

test("a rod has a colour for tension and one for thrust, below its arrow", () => {
  const stage = stageOf(/** @type {any} */ ({ ...scene, ...hung, drawing: { ...scene.drawing, ...hung.drawing } }), { ...trajectory, positions: { bob: trajectory.positions.bob } }, square(400));
  for (const [force, name] of /** @type {const} */ ([[-3, "tension"], [3, "thrust"]])) {
    const motion = { kinematics: whole("length"), symbols: new Map([["h l", "S_{l}"]]), at: () => swung, multipliers: () => ({ l: force }), frictions: () => ({}), end: 1 };
    const { shapes, labels } = vectorFigure(stage, swung, [{ of: "l", vector: "h" }], motion);
    assert.deepEqual(shapes.map(({ className }) => className), [`stress ${name}`, "pointed arrow vector vector-h q-1 released-l"]);
    assert.deepEqual(labels.map(({ latex }) => latex), ["S_{l}"]);
  }
});
