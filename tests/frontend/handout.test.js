import { strict as assert } from "node:assert";
import { test } from "node:test";
import { picturesOf, ROOM, SIZE } from "../../frontend/model/history.js";

const SCENE = /** @type {any} */ ({ coordinates: [{ name: "phi", latex: "\\varphi", unit: "rad" }, { name: "y", unit: "m" }] });
const MOTION = /** @type {any} */ ({
  t: [0, 1, 2], coordinates: { phi: [0, 1, -1], y: [3, 3, 3] }, rates: { phi: [2, -0.5, -3], y: [0, 0, 0] },
  energy: { kinetic: [0, 1, 2], potential: [2, 1, 0], balance: [2, 2, 2] },
});

/** Places of a path. @param {string} path */
const places = (path) => path.slice(1).split("L").map((pair) => pair.split(" ").map(Number));

test("each unit has a picture, the energies another, without what is only drawn to be compared", () => {
  const pictures = picturesOf(SCENE, MOTION);
  assert.deepEqual(pictures.map(({ unit, lines }) => [unit, lines.map(({ latex }) => latex)]), [["rad", ["\\varphi"]], ["m", ["y"]], ["J", ["E", "V"]]]);
});

test("curves go from the first moment to the last, and stay between their numbers", () => {
  for (const { lines, rows, columns } of picturesOf(SCENE, MOTION)) {
    const points = lines.flatMap(({ path }) => places(path));
    assert.deepEqual([points[0][0], points[points.length - 1][0]], [ROOM.left, SIZE.width - ROOM.right]);
    assert.ok(points.every(([, y]) => y > ROOM.top && y < SIZE.height - ROOM.bottom));
    assert.deepEqual([columns[0].value, columns.at(-1)?.value], [0, 2]);
    assert.ok(rows.length >= 1);
  }
});

test("between samples the curve is the one that the rates tell", () => {
  const [{ lines: [{ path }], rows }] = picturesOf({ coordinates: [SCENE.coordinates[0]] }, { ...MOTION, coordinates: { phi: [0, 0, 0] }, rates: { phi: [0, 4, 0] }, energy: undefined });
  const [a, b] = [rows[0], rows[rows.length - 1]];
  const values = places(path).map(([, y]) => a.value + ((y - a.position) / (b.position - a.position)) * (b.value - a.value));
  // A cubic that is zero at both ends, with slope 4 at one: 4·4/27 at its farthest.
  assert.deepEqual([Math.min(...values), Math.max(...values)].map((value) => value.toFixed(2)), ["-0.59", "0.59"]);
});
