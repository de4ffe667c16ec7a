import { strict as assert } from "node:assert";
import { test } from "node:test";
import { createApi } from "../../frontend/model/api.js";
import { numbersOf, unpacked } from "../../frontend/model/columns.js";

/** Numbers as Python packs them: `base64.b64encode(array("d", …))`, bytes plane by plane. @param {number[]} numbers */
function planes(numbers) {
  const bytes = Buffer.alloc(8 * numbers.length);
  numbers.forEach((number, i) => bytes.writeDoubleLE(number, 8 * i));
  return Buffer.from(Array.from(bytes, (_, k) => bytes[8 * (k % numbers.length) + Math.floor(k / numbers.length)])).toString("base64");
}

test("a string that the server wrote", () => {
  // base64.b64encode(numpy.array([1.0, -2.5], "<f8").reshape(-1, 1).view("u1").T.tobytes())
  assert.deepEqual(numbersOf("AAAAAAAAAAAAAAAA8AQ/wA=="), [1, -2.5]);
  assert.deepEqual(numbersOf(""), []);
});

test("the page asks for planes and has plain numbers", async () => {
  const t = [0, 0.1, 1 / 3];
  const told = { status: "ok", columns: "planes", t: planes(t), coordinates: { x: planes([1, -0, 1e-300]) }, rates: { x: planes(t) }, positions: { P: planes([1, 2, 3, 4, 5, 6]) }, loads: null, friction: { ground: { force: planes(t), largest: planes(t) } }, contacts: { floor: { force: planes(t), unit: "N" } }, energy: { kinetic: planes(t), works: true, drift: 0.5 }, error: { estimate: [1e-9, 2e-9, 3e-9] } };
  /** @type {any[]} */
  const asked = [];
  const send = async (/** @type {any} */ _url, /** @type {any} */ options) => (asked.push(JSON.parse(options.body)), new Response(JSON.stringify(told)));
  const found = await createApi(send).simulate({ scene: "pendulum", t_end: 1 });
  assert.deepEqual(asked, [{ scene: "pendulum", t_end: 1, columns: "planes" }]);
  assert.deepEqual(found, { ...told, columns: "numbers", t, coordinates: { x: [1, -0, 1e-300] }, rates: { x: t }, positions: { P: [[1, 2], [3, 4], [5, 6]] }, multipliers: undefined, friction: { ground: { force: t, largest: t } }, contacts: { floor: { force: t, unit: "N" } }, energy: { kinetic: t, works: true, drift: 0.5 } });
});

test("numbers that are plain already stay, and no sample has no columns", () => {
  const plain = { columns: "numbers", t: [0, 1], coordinates: { x: [1, 2] }, rates: { x: [0, 0] }, positions: { P: [[1, 2], [3, 4]] }, loads: {}, energy: { kinetic: [1, 2], works: false, drift: 0 } };
  assert.deepEqual(unpacked(/** @type {any} */ ({ ...plain, multipliers: { rod: [1, null] }, friction: { ground: { force: [null, 2], largest: [3, 3] } } })).multipliers, { rod: [1, NaN] });
  assert.deepEqual(unpacked(/** @type {any} */ (plain)), { ...plain, multipliers: undefined, friction: undefined, contacts: undefined });
  assert.deepEqual(unpacked(/** @type {any} */ ({ columns: "planes", t: "", positions: { P: "" } })).positions, { P: [] });
});
