import { strict as assert } from "node:assert";
import { test } from "node:test";
import { scene } from "./fixtures.js";
import { failure, own, page, rest, swing } from "./server.js";

const PARTS = ["coordinates", "rates", "positions", "loads", "multipliers", "energy", "error"];
const methods = /** @type {any} */ ([{ id: "dop853", adaptive: true }, { id: "rk4", adaptive: false }]);

for (const [name, patch, expected] of /** @type {[string, any, any][]} */ ([
  ["as the scene has it", {}, { scene: "swing", initial: {}, parameters: {}, t_end: 10, samples: 242, include: PARTS, lang: "en" }],
  ["longer, in German", { place: { duration: 20, lang: "de" } }, { scene: "swing", initial: {}, parameters: {}, t_end: 20, samples: 488, include: PARTS, lang: "de" }],
  ["by an adaptive method", { place: { method: "dop853" } }, { scene: "swing", initial: {}, parameters: {}, t_end: 10, samples: 242, include: PARTS, lang: "en", method: "dop853" }],
  ["by a method of fixed step, with a sample for each", { place: { method: "rk4" } }, { scene: "swing", initial: {}, parameters: {}, t_end: 10, samples: 1001, include: PARTS, lang: "en", method: "rk4", step: 0.01 }],
  ["by a method that nobody knows", { place: { method: "magic" } }, { scene: "swing", initial: {}, parameters: {}, t_end: 10, samples: 242, include: PARTS, lang: "en" }],
  ["with more samples than the server has", { place: { method: "rk4", duration: 1000 } }, { scene: "swing", initial: {}, parameters: {}, t_end: 1000, samples: 20001, include: PARTS, lang: "en", method: "rk4", step: 0.01 }],
  ["with other values and members", { place: { n: 4 }, changes: { initial: { y: { value: 1, rate: 2 } }, parameters: { m: 3 } } }, { scene: "swing", initial: { y: { value: 1, rate: 2 } }, parameters: { m: 3, n: 4 }, t_end: 10, samples: 242, include: PARTS, lang: "en" }],
  ["with what is let go in thought", { place: { release: "l,y" } }, { scene: "swing", initial: {}, parameters: {}, t_end: 10, samples: 242, include: PARTS, lang: "en", release: ["l", "y"] }],
  ["of one's own scene", { place: { scene: "own" } }, { scene: own, initial: {}, parameters: {}, t_end: 10, samples: 242, include: PARTS, lang: "en" }],
])) {
  test(`the motion is asked for ${name}`, async () => {
    const { session, last, pass } = page({ methods, own, ...patch });
    session.resimulate({});
    await pass(0);
    assert.deepEqual(last("simulate").given[0], expected);
  });
}

test("without a scene no motion is asked for", async () => {
  for (const place of /** @type {any[]} */ ([{ scene: "" }, { scene: "own" }])) {
    const { session, asked, pass } = page({ place });
    session.resimulate({});
    await pass(200);
    assert.deepEqual(asked(), []);
  }
});

test("a motion is on the page with its end; until then the page says that it is being computed", async () => {
  const { session, last, get, clock, pass } = page();
  session.resimulate({ duration: 5 });
  await pass(0);
  assert.deepEqual([get().simulating, get().trajectory], [true, null]);
  const answer = { ...rest(last("simulate").given[0]), method: "dop853" };
  await last("simulate").answer(answer);
  assert.deepEqual([get().simulating, get().trajectory, clock.end], [false, { ...answer, coarse: false }, 5]);
  assert.equal(get().scene, scene);
});

test("of many values a slider runs through the first and the last are computed, a tenth of a second apart", async () => {
  const { session, all, last, pass } = page();
  const slide = (/** @type {number} */ m) => session.change({ initial: {}, parameters: { m } });
  slide(1);
  await pass(0);
  [2, 3, 4].forEach(slide);
  await last("simulate").answer(rest(last("simulate").given[0]));
  await pass(99);
  assert.equal(all("simulate").length, 1);
  await pass(1);
  assert.deepEqual(all("simulate").map(({ given }) => given[0].parameters.m), [1, 4]);
});

test("what few samples do not show is asked for again with more, and shown meanwhile as coarse", async () => {
  const { session, all, last, get, pass } = page();
  session.resimulate({});
  await pass(0);
  await last("simulate").answer(swing(last("simulate").given[0], 5));
  assert.deepEqual([get().trajectory?.coarse, get().simulating], [true, true]);
  await pass(100);
  const [few, many] = all("simulate").map(({ given }) => given[0]);
  assert.deepEqual({ ...many, samples: 0 }, { ...few, samples: 0 });
  assert.ok(many.samples > 1.4 * few.samples, `${many.samples} after ${few.samples}`);
  await last("simulate").answer(swing(many, 5));
  assert.deepEqual([get().trajectory?.coarse, get().simulating, get().trajectory?.t.length], [false, false, many.samples]);
});

test("a motion of which no number of samples is enough is asked for six times, not for ever", async () => {
  const { session, all, last, get, pass } = page();
  session.resimulate({ duration: 1 });
  await pass(0);
  for (let round = 0; round < 10 && get().simulating; round += 1) {
    const asked = last("simulate").given[0];
    await last("simulate").answer({ ...rest(asked), cost: { steps: 2 * asked.samples + 2 } });
    await pass(100);
  }
  assert.deepEqual([all("simulate").length, get().simulating], [6, false]);
});

/** The samples of a first motion of 5 Hz until it is shown, and of the motion after it. @param {any} then @param {any} [more] */
async function following(then, more = {}) {
  const { session, last, get, pass, store } = page({ methods, ...more });
  session.resimulate({});
  await pass(0);
  for (let round = 0; round < 6 && get().simulating; round += 1) {
    await last("simulate").answer(swing(last("simulate").given[0], 5));
    await pass(100);
  }
  const dense = last("simulate").given[0].samples;
  store.set(then.own ? { own: then.own } : {});
  session.resimulate(then);
  await pass(100);
  return { dense, next: last("simulate").given[0].samples };
}

test("the next motion of a scene is asked for as densely as the last one needed", async () => {
  const { dense, next } = await following({});
  assert.ok(next >= dense && next < 1.05 * dense, `${next} after ${dense}`);
  const longer = await following({ duration: 20 });
  assert.ok(longer.next > 1.9 * longer.dense && longer.next < 2.1 * longer.dense, `${longer.next} after ${longer.dense}`);
});

test("one's own scene stays about as swift while it is written", async () => {
  const { dense, next } = await following({ own: { ...own } }, { place: { scene: "own" }, own });
  assert.ok(next >= dense, `${next} after ${dense}`);
});

test("another scene or method begins with the usual samples", async () => {
  assert.equal((await following({ scene: "other" })).next, 242);
  assert.equal((await following({ method: "dop853" })).next, 242);
  assert.equal((await following({ scene: "own", own })).next, 242);
});

test("a method of fixed step keeps a sample for each of its steps", async () => {
  const { session, last, pass } = page({ methods, place: /** @type {any} */ ({ method: "rk4" }) });
  for (const duration of [10, 10, 5, 20]) {
    session.resimulate({ duration });
    await pass(100);
    await last("simulate").answer(rest(last("simulate").given[0]));
    assert.equal(last("simulate").given[0].samples, 100 * duration + 1);
  }
});

test("a failure is told of the simulation, and the motion before it stays", async () => {
  const { session, last, get, pass } = page();
  session.resimulate({});
  await pass(0);
  await last("simulate").answer(rest(last("simulate").given[0]));
  const before = get().trajectory;
  session.resimulate({ duration: 7 });
  await pass(100);
  await last("simulate").refuse();
  assert.deepEqual([get().trajectory, get().simulating, get().failures.simulation], [before, false, failure]);
});

test("a motion that was called off is neither shown nor a failure, and the next one is asked for anew", async () => {
  const { session, last, get, clock, pass } = page();
  session.resimulate({});
  await pass(0);
  const { given, refuse } = last("simulate");
  void session.choose("other");
  assert.equal(given[1].aborted, true);
  await refuse(new DOMException("", "AbortError"));
  await pass(100);
  const next = last("simulate");
  assert.deepEqual([get().failures.simulation, next.given[0].scene, next.given[1].aborted], [null, "other", false]);
  await next.answer(rest(next.given[0]));
  assert.equal(clock.end, 10);
});

test("an error in the page itself is not hidden as a failure of the server", async () => {
  const { session, last } = page();
  const ends = session.formulate("hamilton");
  void last("derive").refuse(new TypeError("a fault"));
  await assert.rejects(ends, new TypeError("a fault"));
});

test("one's own scene is shown with its motion, once for each document", async () => {
  const { session, last, get, pass } = page({ own, scene: null, place: /** @type {any} */ ({ scene: "own" }) });
  const ask = async () => {
    session.resimulate({});
    await pass(100);
    await last("simulate").answer(rest(last("simulate").given[0]));
    return get().scene;
  };
  const first = await ask();
  assert.deepEqual([first?.id, first?.parameters[0].value], ["own", 3]);
  assert.equal(await ask(), first);
});
