import { strict as assert } from "node:assert";
import { test } from "node:test";
import { picturesOf, ROOM, SIZE } from "../../frontend/model/history.js";

const SCENE = /** @type {any} */ ({ coordinates: [{ name: "phi", latex: "\\varphi", unit: "rad" }, { name: "y", unit: "m" }] });
const MOTION = /** @type {any} */ ({
  t: [0, 1, 2], coordinates: { phi: [0, 1, -1], y: [3, 3, 3] },
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
    assert.deepEqual([points[0][0], points[2][0]], [ROOM.left, SIZE.width - ROOM.right]);
    assert.ok(points.every(([, y]) => y > ROOM.top && y < SIZE.height - ROOM.bottom));
    assert.deepEqual([columns[0].value, columns.at(-1)?.value], [0, 2]);
    assert.ok(rows.length >= 1);
  }
});

test("a run that ended early is drawn as far as it came", () => {
  const [{ lines }] = picturesOf(SCENE, { ...MOTION, coordinates: { phi: [0, 1, NaN] }, energy: undefined });
  assert.equal(places(lines[0].path).length, 2);
});
