import { strict as assert } from "node:assert";
import { test } from "node:test";
import { createHandout } from "../../frontend/model/handout.js";
import { picturesOf, ROOM, SIZE } from "../../frontend/model/history.js";
import { createStore } from "../../frontend/model/store.js";
import { HOME, readPlace } from "../../frontend/model/url.js";

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

/** The pictures of a sheet, and what was asked for it, where the service answers with what it was asked. @param {string} query */
async function sheetOf(query) {
  /** @type {any[]} */
  const asked = [];
  const parts = { ...MOTION, multipliers: { rod: [1, null, 2] }, reactions: { rod: { unit: "N" } } };
  const answers = {
    catalog: async () => ({}),
    scene: async () => ({ ...SCENE, parameters: [] }),
    derive: async (/** @type {any} */ body) => (asked.push(body), { chapters: [] }),
    simulate: async (/** @type {any} */ body) => {
      asked.push(body);
      return Object.fromEntries(Object.entries(parts).filter(([part]) => !["multipliers", "reactions"].includes(part) || body.include.includes("multipliers")));
    },
  };
  const store = createStore(/** @type {any} */ ({ place: { ...HOME, ...readPlace(query), lang: "en" }, lines: [], proof: "" }));
  await createHandout(store, /** @type {any} */ (answers), null).load();
  const { trajectory, scene } = store.get();
  return { asked, pictures: picturesOf(/** @type {any} */ (scene), /** @type {any} */ (trajectory)) };
}

test("what constraints do has a picture, in its unit, between those of coordinates and of energies", async () => {
  const { pictures } = await sheetOf("?scene=pendulum");
  assert.deepEqual(pictures.map(({ unit, lines }) => [unit, lines.map(({ latex }) => latex)]), [["rad", ["\\varphi"]], ["m", ["y"]], ["N", ["\\mathit{rod}"]], ["J", ["E", "V"]]]);
});

test("what is let go in thought on the page is so on its handout", async () => {
  const { asked } = await sheetOf("?scene=pendulum&release=l,y");
  assert.ok(asked.length > 1);
  for (const { release } of asked) assert.deepEqual(release, ["l", "y"]);
  const plain = await sheetOf("?scene=pendulum");
  assert.ok(plain.asked.every((body) => !("release" in body)));
});
