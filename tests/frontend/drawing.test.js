import { strict as assert } from "node:assert";
import { test } from "node:test";
import { FRONT, turned, viewBy } from "../../frontend/model/drawing/camera.js";
import { figureOf, KINDS, withDrawing } from "../../frontend/model/drawing/figure.js";
import { arcFrom, coil, sliverFrom, wrapped } from "../../frontend/model/drawing/geometry.js";
import { forceLatex } from "../../frontend/model/drawing/marks.js";
import { axesOf } from "../../frontend/model/drawing/axes.js";
import { letterSize, placed } from "../../frontend/model/drawing/placing.js";
import { stageOf, viewOf } from "../../frontend/model/drawing/stage.js";
import { markerOf } from "../../frontend/model/symbols.js";
import { snapshotAt } from "../../frontend/model/trajectory.js";
import { scene, square, trajectory } from "./fixtures.js";

const stage = stageOf(scene, trajectory, square(400));
const figureAt = (/** @type {number} */ t, given = scene) => figureOf(stageOf(given, trajectory, square(400)), snapshotAt(trajectory, t));
const shape = (/** @type {import("../../frontend/model/types.js").Figure} */ figure, /** @type {string} */ key) => figure.shapes.find((s) => s.key === key);

/** The numbers of a path. */
const numbers = (/** @type {string | undefined} */ d) => (d ?? "").match(/-?[\d.]+/g)?.map(Number) ?? [];

/** What an element draws by itself: without the axes, and the weights that every drawing has. @param {import("../../frontend/model/types.js").Figure} figure */
const alone = ({ shapes, labels }) => {
  const is = (/** @type {{key: string, className: string}} */ { key, className }) => key !== "origin" && !key.startsWith("coordinate") && !/axes|load-weight/.test(className);
  return { shapes: shapes.filter(is), labels: labels.filter(is) };
};

test("the origin of a centred view is in the middle, and down is down", () => {
  assert.deepEqual(stage.project([0, 0]), [200, 200]);
  assert.deepEqual(stage.project([1, 1]), [300, 300]);
});

test("where the second component grows upwards, it does so on the screen", () => {
  const up = { ...scene, drawing: { ...scene.drawing, vertical: /** @type {const} */ ("up") } };
  assert.deepEqual(stageOf(up, trajectory, square(400)).project([1, 1]), [300, 100]);
});

for (const [acceleration, vertical, down] of /** @type {const} */ ([["g", "down", true], ["-g", "up", true], ["-g", "down", false], ["g", "up", false], ["0", "up", true]]))
  test(`weights point where the scene says: ${acceleration} with the last component growing ${vertical}`, () => {
    const given = /** @type {any} */ ({ ...scene, loads: [{ kind: "gravity", name: "weight", acceleration: ["0", acceleration] }], drawing: { ...scene.drawing, vertical, elements: [{ kind: "weight", at: "bob" }] } });
    const label = figureAt(0, given).labels.find(({ className }) => /load-weight/.test(className));
    const bob = stageOf(given, trajectory, square(400)).project(/** @type {number[]} */ (trajectory.positions.bob[0]));
    assert.equal((label?.at[1] ?? NaN) > bob[1], down);
  });

test("a letter makes room for an arrow of another layer as soon as there is one, and stays there", () => {
  const letter = { key: "m", latex: "m", at: /** @type {[number, number]} */ ([200, 200]), others: [/** @type {[number, number]} */ ([200, 240])], className: "" };
  const own = stageOf(scene, trajectory, square(400));
  const where = (/** @type {Parameters<typeof placed>[3]} */ beside) => placed(own, { shapes: [], labels: [letter] }, 0.5, beside).labels[0].at;
  const arrow = { boxes: [], strips: [/** @type {[[number, number], [number, number]]} */ ([[150, 200], [260, 200]])], letters: [], turn: 0.001 };
  assert.deepEqual(where(undefined), [200, 200]);
  const [first, second] = [where(arrow), where(arrow)];
  assert.ok(Math.abs(first[1] - 200) > 0.4 * letterSize(own), "letters are as high as that above and below their middle");
  assert.deepEqual(second, first);
});

test("a scene without a view of its own is seen with the origin of its coordinates, where that is near", () => {
  const given = { ...scene, drawing: undefined };
  const view = (/** @type {number[][]} */ ...bob) => viewOf(given, { ...trajectory, positions: { bob } });
  const [x0, x1, y0, y1] = view([0.3, 0]);
  assert.ok(x0 < 0 && x1 > 0.3 && y0 < 0 && y1 > 0, "at rest beside it");
  const [, right, bottom] = view([-1, 2], [-2, 3]);
  assert.ok(right > 0 && bottom < 0, "on two sides");
  assert.ok(view([1000, 0], [1001, 0])[0] > 999, "far away it would leave a dot of the motion");
});

test("a view is widened on the side where the motion leaves it, and not without end", () => {
  const far = (/** @type {number} */ x) => ({ ...trajectory, positions: { bob: [[x, 0]] } });
  assert.deepEqual(viewOf(scene, far(1.8)), [-2, 2, -2, 2]);
  assert.deepEqual(viewOf(scene, far(1.97)), [-2, 2.5, -2, 2], "a body has a size");
  assert.deepEqual(viewOf(scene, far(2.3)), [-2, 2.5, -2, 2]);
  assert.deepEqual(viewOf(scene, { ...trajectory, positions: { bob: [[-2.3, 0], [0, 2.3]] } }), [-2.5, 2, -2, 2.5], "two sides");
  const swung = { ...trajectory, positions: { bob: Array.from({ length: 20 }, (_, i) => [i ? 0 : 2.8, 0]) } };
  assert.ok(viewOf(scene, swung)[1] > 2.8, "what comes there for a moment is seen as well where that is cheap");
  const ran = { ...trajectory, positions: { bob: Array.from({ length: 20 }, (_, i) => [i ? 0 : 50, 0]) } };
  assert.deepEqual(viewOf(scene, ran), [-2, 2, -2, 2]);
  assert.ok(viewOf(scene, far(1e9))[1] < 20);
  assert.ok(viewOf(scene, far(NaN)).every(Number.isFinite));
});

test("the bob stands where the trajectory says", () => {
  assert.deepEqual(shape(figureAt(0), "bob0")?.at, [200, 300]);
  const moved = /** @type {number[]} */ (shape(figureAt(4), "bob0")?.at);
  assert.ok(Math.abs(moved[0] - (200 + 100 * Math.sin(1))) < 1e-9);
});

test("a ring stands where an event ends the motion, at the place that the scene names", () => {
  const given = { ...scene, events: [{ name: "slack", value: "g", at: "bob" }, { name: "other", value: "g" }] };
  const ring = (/** @type {string | undefined} */ name) => {
    const ended = { ...trajectory, event: name ? { name, t: 4 } : null };
    return shape(figureOf(stageOf(given, ended, square(400)), snapshotAt(ended, 0)), "event")?.at;
  };
  assert.deepEqual(ring("slack"), stage.project(/** @type {number[]} */ (trajectory.positions.bob.at(-1))));
  assert.deepEqual([ring("other"), ring(undefined)], [undefined, undefined]);
});

test("what stands in one frame stands in all, and what hangs hangs", () => {
  const elements = [{ kind: "ground", at: "pivot" }, { kind: "pivot", at: "pivot" }];
  for (const [view, stands] of /** @type {const} */ ([[[-2, 2, -0.5, 2], false], [[-2, 2, -2, 0.5], true]]))
    for (const size of [square(400), { width: 400, height: 1000 }, { width: 1200, height: 300 }]) {
      const given = /** @type {any} */ ({ ...scene, drawing: { ...scene.drawing, view, elements } });
      const made = stageOf(given, trajectory, size);
      const { shapes } = figureOf(made, snapshotAt(trajectory, 0));
      const [, , y] = /** @type {RegExpMatchArray} */ (shapes.find(({ key }) => key === "ground0-line")?.d.match(/^M([-\d.]+) ([-\d.]+)/)).map(Number);
      const { pivot } = trajectory.positions;
      assert.equal(y > made.project(pivot?.[0] ?? [0, 0])[1], stands, JSON.stringify([view, size]));
    }
});

test("bob above rod above ground, whatever the order in the scene", () => {
  const keys = figureAt(1).shapes.map((s) => s.key);
  assert.ok(keys.indexOf("ground4-line") < keys.indexOf("rod1") && keys.indexOf("rod1") < keys.indexOf("bob0"));
});

test("what does not move is made once; what moves is made anew", () => {
  const guided = { ...scene, drawing: { ...scene.drawing, elements: [{ kind: "ground", at: "pivot" }, { kind: "wall", from: "pivot", to: "bob" }] } };
  const stage = stageOf(guided, trajectory, square(400));
  const [first, second] = [0, 2].map((t) => figureOf(stage, snapshotAt(trajectory, t)));
  assert.equal(shape(first, "ground0-hatch"), shape(second, "ground0-hatch"));
  assert.notEqual(shape(first, "wall1-hatch")?.d, shape(second, "wall1-hatch")?.d);
});

test("an angle carries the colour and the symbol of its coordinate", () => {
  const label = figureAt(4).labels.find((l) => l.key === "angle2");
  assert.equal(label?.latex, "q_2");
  assert.equal(label?.className, "q-1");
});

test("the largest force is as long as every other largest force; a vanishing one is not drawn", () => {
  const length = (/** @type {number[][]} */ loads) => {
    const stage = stageOf(scene, { ...trajectory, loads: { F: loads } }, square(400));
    const figure = figureOf(stage, { ...snapshotAt(trajectory, 0), loads: { F: loads[0] } });
    return figure.shapes.find((s) => s.key === "force3")?.d;
  };
  assert.match(length([[2, 0], [1, 0]]) ?? "", /^M.*L.*M.*Z$/, "a shaft and a head in one path");
  assert.equal(length([[2, 0], [1, 0]]), length([[2000, 0], [1, 0]]));
  assert.equal(length([[0, 0], [1, 0]]), undefined);
});

test("every kind of element draws something, with finite numbers", () => {
  for (const kind of Object.keys(KINDS)) {
    const element = { kind, at: "bob", from: "pivot", to: "bob", coordinate: "phi", load: "F", radius: 0.2 };
    const dimension = ["polar", "azimuth", "top", "wheel"].includes(kind) ? 3 : 2;
    const { shapes } = figureAt(2, { ...scene, dimension, drawing: { ...scene.drawing, elements: [element] } });
    assert.ok(shapes.some((s) => s.d !== ""), kind);
    assert.ok(!shapes.some((s) => /NaN|Infinity/.test(s.d + s.at)), kind);
  }
});

test("a size that is the name of a parameter is its value, for every kind that has it", () => {
  const named = { ...scene, parameters: [...scene.parameters, { name: "size", latex: "s", unit: "m", value: 0.37 }] };
  const paths = (/** @type {import("../../frontend/model/types.js").Shape[]} */ shapes) => JSON.stringify(shapes.map(({ key, d, at }) => [key, d, at]));
  const drawn = (/** @type {string} */ kind, /** @type {string} */ size, /** @type {unknown} */ given) =>
    paths(figureAt(0.25, /** @type {any} */ ({ ...named, drawing: { ...scene.drawing, elements: [{ kind, at: "bob", from: "pivot", to: "bob", coordinate: "y", load: "F", [size]: given }] } })).shapes);
  /** @type {Record<string, string[]>} */
  const found = {};
  for (const size of ["radius", "width", "height", "offset"]) {
    const having = Object.keys(KINDS).filter((kind) => drawn(kind, size, 0.37) !== drawn(kind, size, 0.74));
    for (const kind of having) assert.equal(drawn(kind, size, "size"), drawn(kind, size, 0.37), `${kind} ${size}`);
    found[size] = having.sort();
  }
  assert.deepEqual(found, { radius: ["disc", "hoop"], width: ["block", "cart", "ground"], height: ["block", "cart"], offset: ["angle", "damper", "dimension", "spring"] });
});

test("the pieces of a trail join, fade with age, and stay as they are while they do", () => {
  const trailed = { ...scene, drawing: { ...scene.drawing, elements: [{ kind: "trail", at: "bob" }] } };
  const same = stageOf(trailed, trajectory, square(400));
  const at = (/** @type {number} */ t) => figureOf(same, snapshotAt(trajectory, t)).shapes.filter((s) => s.d && s.opacity);
  const [early, late] = [at(1.95), at(2.05)];
  const kept = early.filter((piece) => late.some((other) => other.key === piece.key && other.d === piece.d));
  assert.ok(kept.length >= early.length - 2, `${kept.length} of ${early.length}`);
  for (const piece of kept) assert.ok((late.find((s) => s.key === piece.key)?.opacity ?? 1) <= (piece.opacity ?? 0));
  const ends = new Set(late.map(({ d }) => d.split("L").at(-1)));
  assert.equal(late.filter(({ d }) => !ends.has(d.slice(1).split("L")[0])).length, 1, "only the oldest piece joins none before it");
});

test("an unknown kind is passed over", () => {
  assert.deepEqual(alone(figureAt(0, { ...scene, drawing: { elements: [{ kind: "unicorn", at: "bob" }] } })), { shapes: [], labels: [] });
});

test("a scene without a drawing shows its bodies", () => {
  const kinds = withDrawing({ ...scene, loads: [], drawing: null }, trajectory).drawing?.elements?.map((e) => e.kind);
  assert.deepEqual(kinds, ["ground", "trail", "rod", "pivot", "bob"]);
});

for (const pull of ["g", "-g"]) {
  for (const vertical of /** @type {const} */ ([undefined, "up", "down"])) {
    test(`a weight along ${pull} points to where places with such values are, in a drawing that says ${vertical ?? "nothing"}`, () => {
      const weight = { kind: "gravity", name: "weight", acceleration: ["0", pull] };
      const given = { ...scene, loads: [weight], drawing: { elements: [{ kind: "bob", at: "bob" }], vertical } };
      const stage = stageOf(withDrawing(given, trajectory), trajectory, square(400));
      const arrow = figureOf(stage, snapshotAt(trajectory, 0)).shapes.find(({ className }) => className.includes("load-weight"));
      const [, from, , to] = numbers(arrow?.d);
      const along = stage.project([0, 1])[1] - stage.project([0, 0])[1];
      assert.equal(Math.sign(to - from), Math.sign(pull === "g" ? along : -along));
      if (!vertical) assert.ok(to > from);
    });
  }
}

test("a spring begins and ends at its places, keeps its coils, and survives length zero", () => {
  const path = coil([0, 0], [0, 100], 8, 5);
  assert.ok(path.startsWith("M0 0L") && path.endsWith("L0 100"));
  assert.equal(path.split("L").length, coil([0, 0], [0, 40], 8, 5).split("L").length);
  assert.ok(!coil([3, 3], [3, 3], 8, 5).includes("NaN"));
});

test("angles are shown between minus and plus half a turn", () => {
  assert.ok(Math.abs(wrapped(2 * Math.PI + 0.3) - 0.3) < 1e-12);
  assert.ok(arcFrom(0, [0, 0], 10, 0.5).includes(" 0 0 0 "));
  assert.ok(arcFrom(0, [0, 0], 10, -0.5).includes(" 0 0 1 "));
});

test("an arc there and back encloses nothing: it ends where it begins, the other way round", () => {
  for (const angle of [0.5, -0.5, 3.5]) {
    const [, begin, out, back, end] = /** @type {RegExpMatchArray} */ (sliverFrom(0, [5, 5], 10, angle).match(/^M(\S+ \S+)A10 10 0 (\d \d) \S+ \S+A10 10 0 (\d \d) (\S+ \S+)$/));
    assert.equal(begin, end);
    assert.deepEqual([out[0], out[2] === back[2]], [back[0], false]);
  }
});

const FORCES = [["F", "\\mathbf{F}"], ["F0", "\\mathbf{F}_{0}"], ["F_1", "\\mathbf{F}_{1}"], ["drive", "\\mathbf{F}"]];
for (const [name, latex] of FORCES) {
  test(`the symbol of a force named ${name}`, () => assert.equal(forceLatex({ kind: "force", name }), latex));
}

test("a dashpot keeps its cup and moves its piston; beside a spring it stands aside", () => {
  const drawn = (/** @type {number} */ t, offset = 0) => figureAt(t, { ...scene, drawing: { ...scene.drawing, elements: [{ kind: "damper", from: "pivot", to: "bob", offset }] } });
  const [early, late] = [drawn(0), drawn(4)].map((figure) => numbers(shape(figure, "damper0-cup")?.d));
  assert.deepEqual(early.slice(0, 2), late.slice(0, 2), "it hangs at its first end");
  const [x] = numbers(shape(drawn(0, 0.3), "damper0")?.d);
  assert.ok(Math.abs(Math.abs(x - numbers(shape(drawn(0), "damper0")?.d)[0]) - 30) < 1e-6);
});

test("a moment goes round its place with its symbol, in the colour of its load", () => {
  const turned = { ...scene, parameters: [...scene.parameters, { name: "M", latex: "M_0", unit: "N*m", value: 1 }], loads: [...scene.loads, { kind: "moment", name: "drive", moment: "M" }], drawing: { ...scene.drawing, elements: [{ kind: "moment", at: "pivot", load: "drive" }] } };
  const { shapes, labels } = alone(figureAt(1, turned));
  assert.deepEqual(shapes.map(({ className }) => className), ["arrow load load-drive p-2", "head load load-drive p-2"]);
  assert.equal(labels[0].latex, "M_0");
});

for (const [moment, wanted] of [["M", "M_0"], ["gamma*cos(omega*t)", "M"], ["", "M"]])
  test(`a moment that is ${moment || "not given"} is called ${wanted}`, () => {
    const element = { kind: "moment", at: "pivot", load: "drive" };
    const symbols = [...scene.parameters, { name: "M", latex: "M_0", unit: "N*m", value: 1 }];
    const driven = { ...scene, parameters: symbols, loads: [...scene.loads, { kind: "moment", name: "drive", moment }], drawing: { ...scene.drawing, elements: [element] } };
    const { labels } = figureAt(0, /** @type {typeof scene} */ (/** @type {unknown} */ (driven)));
    assert.deepEqual(labels.filter(({ className }) => className?.includes("load-drive")).map(({ latex }) => latex), [wanted]);
  });

/** A place in space at ϑ from the vertical and ψ round it, and its two angles as drawn. */
function spherical(/** @type {number} */ theta, /** @type {number} */ psi) {
  const bob = [Math.sin(theta) * Math.cos(psi), Math.sin(theta) * Math.sin(psi), Math.cos(theta)];
  const elements = [{ kind: "polar", from: "pivot", to: "bob", coordinate: "phi" }, { kind: "azimuth", at: "pivot", to: "bob", coordinate: "y" }];
  const given = /** @type {any} */ ({ ...scene, dimension: 3, drawing: { ...scene.drawing, elements } });
  const moving = { ...trajectory, positions: { pivot: [[0, 0, 0]], bob: [bob] } };
  const space = stageOf(given, moving, square(400));
  const now = /** @type {any} */ ({ t: 0, coordinates: { phi: theta, y: psi }, positions: { pivot: [0, 0, 0], bob }, loads: {} });
  return { figure: figureOf(space, now), space, bob };
}

for (const [theta, psi] of [[0.9, 0.7], [2.4, -2], [1.2, 3]])
  test(`the arcs of spherical coordinates end on the line to the place and on its level: ${theta}, ${psi}`, () => {
    const { figure, space, bob } = spherical(theta, psi);
    const ends = ["polar0", "azimuth1"].map((key) => /M.*M(\S+) (\S+?)L/.exec(shape(figure, `${key}-arc`)?.d ?? "")?.slice(1).map(Number) ?? []);
    const seen = space.project(bob);
    for (const [end, from] of /** @type {const} */ ([[ends[0], space.project([0, 0, 0])], [ends[1], space.project([0, 0, bob[2]])]]))
      assert.ok(Math.abs((end[0] - from[0]) * (seen[1] - from[1]) - (end[1] - from[1]) * (seen[0] - from[0])) < 0.02 * 400, "the tip lies on the line");
    assert.deepEqual(alone(figure).labels.map(({ latex }) => latex), ["q_2", "q_1"]);
  });

test("where an angle of space is zero there is no arc", () => {
  assert.deepEqual(alone(spherical(0, 0).figure).labels, []);
});

test("a wire is where its place can be, and follows what holds it", () => {
  const wired = { ...scene, drawing: { ...scene.drawing, elements: [{ kind: "wire", at: "bob", coordinate: "phi" }] } };
  const rising = { ...trajectory, coordinates: { ...trajectory.coordinates, y: trajectory.t.map((t) => t / 10) } };
  const stage = stageOf(wired, rising, square(400));
  const corners = (/** @type {number} */ t) =>
    (shape(figureOf(stage, snapshotAt(rising, t)), "wire0")?.d ?? "").slice(1).split("L").map((pair) => pair.split(/[ ,]/).map(Number));
  for (const t of [0, 1]) {
    const { y } = snapshotAt(rising, t).coordinates;
    const centre = stage.project([0, y]);
    const far = corners(t).map(([x, z]) => Math.hypot(x - centre[0], z - centre[1]) / stage.scale);
    assert.ok(far.length > 20 && far.every((one) => Math.abs(one - 1) < 0.01), `${t}: ${far}`);
  }
  assert.notDeepEqual(corners(0), corners(1));
});

test("a wire that only the server can read is left out", () => {
  const bodies = [{ ...scene.bodies[0], position: ["2 sin phi", "y"] }];
  const { shapes } = alone(figureAt(0, { ...scene, bodies, drawing: { ...scene.drawing, elements: [{ kind: "wire", at: "bob", coordinate: "phi" }] } }));
  assert.deepEqual(shapes, []);
});

for (const [dimension, vertical, ways] of /** @type {const} */ ([
  [2, "down", { x: [1, 0], y: [0, 1] }],
  [2, "up", { x: [1, 0], y: [0, -1] }],
  [3, "up", { x: [1, -1], y: [-1, -1], z: [0, -1] }],
  [3, "down", { x: [1, -1], y: [1, 1], z: [0, 1] }],
]))
  test(`axes point where components grow, in a corner, and the origin is marked: ${dimension}, ${vertical}`, () => {
    const given = /** @type {any} */ ({ ...scene, dimension, drawing: { ...scene.drawing, vertical, elements: [] } });
    const place = dimension === 3 ? [0.1, 0.2, 0.3] : [0.1, 0.2];
    const moving = { ...trajectory, positions: { pivot: [place.map(() => 0)], bob: [place] } };
    const space = stageOf(given, moving, square(400));
    const { shapes, labels } = figureOf(space, /** @type {any} */ ({ t: 0, coordinates: {}, positions: { bob: place }, loads: {} }));
    const seen = Object.fromEntries(
      labels.filter(({ className }) => className === "axes").map(({ key, latex, at }) => {
        const from = numbers(shapes.find((each) => each.key === key)?.d).slice(0, 2);
        assert.equal(latex, `\\mathbf{e}_${key.at(-1)}`);
        assert.ok(at[0] > 0 && at[0] < 200 && at[1] > 200 && at[1] < 400, "in the corner");
        return [key.at(-1), at.map((value, c) => Math.sign(Math.round(value - from[c])) + 0)];
      }),
    );
    assert.deepEqual(seen, ways);
    const cross = numbers(shapes.find(({ key }) => key === "origin")?.d);
    assert.deepEqual([(cross[0] + cross[2]) / 2, (cross[5] + cross[7]) / 2], space.project(place.map(() => 0)));
  });

test("all bodies have their weights unless the drawing shows some itself; no continuum has, whose centre nobody says", () => {
  const weights = (/** @type {any[]} */ elements, /** @type {any} */ more = {}) =>
    figureAt(0, /** @type {any} */ ({ ...scene, ...more, drawing: { ...scene.drawing, elements } })).labels.filter(({ className }) => /load-weight/.test(className)).length;
  const gravity = scene.loads.find(({ kind }) => kind === "gravity")?.name;
  const many = [scene.bodies[0], { ...scene.bodies[0], name: "second" }, { ...scene.bodies[0], name: "rope", kind: "continuum" }];
  assert.deepEqual(
    [weights([]), weights([{ kind: "force", load: gravity }]), weights([], { bodies: many }), weights([{ kind: "weight", at: "bob" }], { bodies: many }), weights([], { loads: [] })],
    [1, 1, 2, 1, 0],
  );
});

test("a rod has the letter of its length on the side away from the vertical, until it has swung to the other side", () => {
  const named = { ...scene, drawing: { ...scene.drawing, elements: [{ kind: "rod", from: "pivot", to: "bob", label: "l" }] } };
  const path = (/** @type {number} */ angle) => [Math.sin(angle), Math.cos(angle)];
  const swung = stageOf(/** @type {any} */ (named), { ...trajectory, positions: { pivot: [[0, 0]], bob: [path(1)] } }, square(400));
  const sides = [1, 0.5, 0.1, -0.1, -0.5, -1, -0.1, 0.1, 0.5].map((angle) => {
    const bob = path(angle);
    const { labels } = alone(figureOf(swung, /** @type {any} */ ({ t: 0, coordinates: {}, positions: { pivot: [0, 0], bob }, loads: {} })));
    const [from, to] = [swung.project([0, 0]), swung.project(bob)];
    assert.equal(labels[0].latex, "l");
    const side = (labels[0].at[0] - from[0]) * (to[1] - from[1]) - (labels[0].at[1] - from[1]) * (to[0] - from[0]);
    return [Math.sign(Math.round(side)), labels[0].moves];
  });
  assert.deepEqual(sides, [[1, 0], [1, 0], [1, 0], [1, 0], [-1, 1], [-1, 1], [-1, 1], [-1, 1], [1, 2]]);
});

test("the spoke of a top turns with its spin, on a rim that is level along the line of nodes", () => {
  const [theta, psi] = [0.7, 0.4];
  const along = [Math.sin(theta) * Math.sin(psi), -Math.sin(theta) * Math.cos(psi), Math.cos(theta)];
  const given = /** @type {any} */ ({ ...scene, dimension: 3, drawing: { ...scene.drawing, elements: [{ kind: "top", from: "pivot", to: "bob", coordinate: "phi", radius: 0.5 }] } });
  const space = stageOf(given, { ...trajectory, positions: { pivot: [[0, 0, 0]], bob: [along] } }, square(400));
  const spoke = (/** @type {number} */ spin) =>
    numbers(figureOf(space, /** @type {any} */ ({ t: 0, coordinates: { phi: spin }, positions: { pivot: [0, 0, 0], bob: along }, loads: {} })).shapes.find(({ key }) => key === "top0-spoke")?.d);
  // The body's first axis, by the rotation about z, the line of nodes and the body's own axis (Goldstein's angles).
  for (const spin of [0, 0.3, 2, -1]) {
    const axis = [
      Math.cos(psi) * Math.cos(spin) - Math.sin(psi) * Math.cos(theta) * Math.sin(spin),
      Math.sin(psi) * Math.cos(spin) + Math.cos(psi) * Math.cos(theta) * Math.sin(spin),
      Math.sin(theta) * Math.sin(spin),
    ];
    const [x, y] = space.project(along.map((value, c) => value + 0.5 * axis[c]));
    const found = spoke(spin);
    assert.ok(Math.hypot(found[2] - x, found[3] - y) < 0.02, `${spin}: ${found}`);
  }
});

test("a coordinate that the drawing does not show is shown, from zero to its value, in its colour", () => {
  const swung = { ...scene, dimension: 2, coordinates: [{ name: "y", latex: "y", unit: "rad", value: 0 }], bodies: [{ ...scene.bodies[0], position: ["sin(y)", "cos(y)"] }], drawing: { ...scene.drawing, elements: [{ kind: "bob", at: "bob" }] } };
  const moved = { ...trajectory, coordinates: { y: trajectory.t.map(() => 1.2) } };
  const { shapes, labels } = figureOf(stageOf(/** @type {any} */ (swung), /** @type {any} */ (moved), square(400)), snapshotAt(/** @type {any} */ (moved), 0));
  const letter = labels.find(({ key }) => key.startsWith("coordinate"));
  assert.deepEqual([letter?.latex, letter?.className.split(" ")[0]], ["y", "q-0"]);
  const [x, y] = numbers(shapes.find(({ key }) => /^coordinate.*-side$/.test(key))?.d).slice(2);
  assert.ok(Math.abs(Math.atan2(x - 200, y - 200) - 1.2) < 0.01);
});

test("the arc about a disc ends at the mark that turns with it", () => {
  const turned = { ...scene, dimension: 2, coordinates: [{ name: "y", latex: "y", unit: "rad", value: 0 }], bodies: [{ ...scene.bodies[0], position: ["0", "1"], angular_velocity: ["0", "0", "y"], angle: "y" }], drawing: { ...scene.drawing, elements: [{ kind: "disc", at: "bob", coordinate: "y", radius: 0.4 }] } };
  for (const a of [0.7, 2.5, -1.1]) {
    const moved = { ...trajectory, coordinates: { y: trajectory.t.map(() => a) }, positions: { bob: trajectory.t.map(() => [0, 1]) } };
    const { shapes } = figureOf(stageOf(/** @type {any} */ ({ ...turned, points: [] }), /** @type {any} */ (moved), square(400)), snapshotAt(/** @type {any} */ (moved), 0));
    const [mx, my] = numbers(shapes.find(({ key }) => key === "disc0-mark")?.d).slice(2);
    const arrow = shapes.find(({ key }) => /^coordinate.*-arc$/.test(key))?.d ?? "";
    const [tx, ty] = numbers(arrow.slice(arrow.lastIndexOf("M")));
    assert.ok(Math.abs(Math.atan2(tx - 200, ty - 300) - Math.atan2(mx, my)) < 0.02, `at ${a}`);
  }
});

test("parameters are marked in formulas where they stand alone, and nothing that only looks like them", () => {
  const mark = markerOf({ parameters: /** @type {any} */ ([{ name: "m", latex: "" }, { name: "l", latex: "\\ell" }]) });
  assert.equal(mark("m^{h}_{1} m\\ell^2 + m_1 x^m \\dot m \\mathrm{m}"), "m^{h}_{1} \\htmlClass{p-0}{m}\\htmlClass{p-1}{\\ell^2} + m_1 x^m \\dot m \\mathrm{m}");
});

/** Formulas of the server, and what stands about their symbols then. @type {[string, string][]} */
const OF_THE_SYSTEM = [
  ["\\htmlClass{energy-kinetic}{E} = 0", "\\htmlClass{energy-kinetic of-body_bob}{E} = 0"],
  ["\\frac{\\partial L}{\\partial q}", "\\frac{\\partial \\htmlClass{of-body_bob of-load_weight}{L}}{\\partial q}"],
  ["\\delta W_{a}", "\\htmlClass{of-load_weight of-load_F}{\\delta W_{a}}"],
  ["Q_{\\htmlClass{q-1}{2}}^{d}", "\\htmlClass{of-q_1 of-load_F}{Q_{\\htmlClass{q-1}{2}}^{d}}"],
  ["p_{\\htmlClass{q-0}{1}}", "\\htmlClass{of-q_0}{p_{\\htmlClass{q-0}{1}}}"],
  ["L^{h}_{\\text{bob}} + L^{2}", "L^{h}_{\\text{bob}} + \\htmlClass{of-body_bob of-load_weight}{L^{2}}"],
  ["\\mathbf{M} \\dot L", "\\htmlClass{of-body_bob}{\\mathbf{M}} \\dot L"],
];
for (const [latex, marked] of OF_THE_SYSTEM)
  test(`what belongs to the whole system is marked by that: ${latex}`, () => {
    const forces = /** @type {any} */ ({ generalized_forces: { total: [{ coordinate: "phi", terms: [{ sources: ["load:F"] }] }] } });
    assert.equal(markerOf(/** @type {any} */ ({ ...scene, parameters: [] }), forces)(latex), marked);
  });

test("a letter that the scene has taken is not the system's", () => {
  const mark = markerOf(/** @type {any} */ ({ ...scene, parameters: [{ name: "L", latex: "" }] }));
  assert.equal(mark("L = 1"), "\\htmlClass{p-0}{L} = 1");
});

for (const up of [true, false])
  for (const camera of [FRONT, { turn: -2, raised: 1 }, { turn: 3, raised: -0.4 }])
    test(`a camera sees right-handed axes at their lengths: ${up ? "up" : "down"}, ${JSON.stringify(camera)}`, () => {
      const seen = viewBy(camera, up);
      const [x, y, z] = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((axis) => seen(axis).map((value, c) => (c && !up ? -value : value)));
      for (const c of [0, 1]) assert.ok(Math.abs(x[c] ** 2 + y[c] ** 2 + z[c] ** 2 - 1) < 1e-12);
      assert.ok(Math.abs(x[0] * x[1] + y[0] * y[1] + z[0] * z[1]) < 1e-12);
      // Who looks against an axis sees the turn from the one that follows it to the next as positive.
      const fromAbove = x[0] * y[1] - x[1] * y[0];
      assert.equal(Math.sign(fromAbove), Math.sign((up ? 1 : -1) * camera.raised));
      assert.equal(Math.sign(z[1]), up ? 1 : -1);
    });

test("space follows the hand that drags it: what is near goes with it, and never over the top", () => {
  const near = [0, -1, 0];
  const [before, after] = [FRONT, turned(FRONT, [20, 0])].map((camera) => viewBy(camera, true)(near));
  assert.ok(after[0] > before[0], `${before} ${after}`);
  assert.ok(turned(FRONT, [0, 20]).raised > FRONT.raised);
  assert.ok(Math.abs(turned(FRONT, [0, 1e4]).raised) < Math.PI / 2);
});

test("turning space leaves the size in which it is drawn", () => {
  const space = /** @type {any} */ ({ ...scene, dimension: 3, drawing: { vertical: "up", elements: [] } });
  const moving = { ...trajectory, positions: { bob: [[0, 0, 0], [2, 0, 0], [0, 1, 1]] } };
  const scales = [FRONT, { turn: 1.5, raised: 0.1 }].map((camera) => stageOf(space, moving, square(400), { camera }).scale);
  assert.equal(scales[0], scales[1]);
});

test("the rim of a wheel in space goes through both of its places", () => {
  const space = /** @type {any} */ ({ ...scene, dimension: 3, drawing: { vertical: "up", elements: [{ kind: "wheel", at: "bob", from: "a", to: "b" }] } });
  const places = { bob: [0, 0, 1], a: [0.6, 0, 1.8], b: [0, 1, 1] };
  const stage = stageOf(space, { ...trajectory, positions: Object.fromEntries(Object.entries(places).map(([name, at]) => [name, [at]])) }, square(400));
  const rim = numbers(shape(figureOf(stage, /** @type {any} */ ({ t: 0, coordinates: {}, positions: places, loads: {} })), "wheel0")?.d);
  for (const end of [places.a, places.b]) {
    const [x, y] = stage.project(end);
    assert.ok(rim.some((value, i) => i % 2 === 0 && Math.hypot(value - x, rim[i + 1] - y) < 0.02), `${end}`);
  }
});

test("letters of the axes are whole in a drawing however small", () => {
  for (const side of [150, 200, 400, 1600]) {
    for (const vertical of /** @type {const} */ (["up", "down"])) {
      const small = stageOf({ ...scene, drawing: { ...scene.drawing, vertical } }, trajectory, square(side), { rem: 28 });
      const half = letterSize(small) * 0.6;
      for (const { at, key } of axesOf(small).labels) {
        assert.ok(at[0] >= half && at[1] >= half && at[1] <= side - half, `${key} at ${at} of ${side}`);
      }
    }
  }
});
