/** A server whose answers come when a test says so, and a page that asks it. */

import { mock } from "node:test";
import { ApiError } from "../../frontend/model/api.js";
import { createClock } from "../../frontend/model/clock.js";
import { createSession } from "../../frontend/model/session.js";
import { START } from "../../frontend/model/state.js";
import { createStore } from "../../frontend/model/store.js";
import { HOME } from "../../frontend/model/url.js";
import { scene, trajectory } from "./fixtures.js";

/** @typedef {{name: string, given: any[], answer: (found: unknown) => Promise<void>, refuse: (error?: Error) => Promise<void>}} Question */

/** Until everything that has been answered is on the page. */
export const settled = async () => {
  for (let turn = 0; turn < 3; turn += 1) await new Promise((done) => setImmediate(done));
};

/** A motion that its samples show: at rest, as many samples as were asked for. @param {{samples: number, t_end: number}} request */
export function rest({ samples, t_end }) {
  const t = Array.from({ length: samples }, (_, i) => (i * t_end) / (samples - 1));
  const still = t.map(() => 0);
  return { ...trajectory, t, coordinates: { y: still, phi: still }, rates: { y: still, phi: still }, positions: {}, loads: {}, energy: null, error: null };
}

/** A swing of this frequency, which few samples do not show. @param {{samples: number, t_end: number}} request @param {number} frequency in Hz */
export function swing(request, frequency) {
  const { t, ...others } = rest(request);
  const turn = 2 * Math.PI * frequency;
  return { ...others, t, coordinates: { y: t.map((s) => Math.sin(turn * s)) }, rates: { y: t.map((s) => turn * Math.cos(turn * s)) } };
}

/** A derivation of the steps of these names, in one chapter. @param {string[]} steps */
export const derivation = (...steps) => ({ chapters: [{ id: "only", title: "", steps: steps.map((id) => ({ id })) }] });

export const failure = { title: "busy", detail: "", problems: [], status: 503 };
export const busy = () => new ApiError(failure);

/** What the page asks, in order; each question waits for its answer. */
export function server() {
  /** @type {Question[]} */
  const asked = [];
  const pose = (/** @type {string} */ name) => (/** @type {any[]} */ ...given) =>
    new Promise((answer, refuse) => {
      const then = (/** @type {(value: any) => void} */ does) => (/** @type {any} */ value) => (does(value), settled());
      asked.push({ name, given, answer: then(answer), refuse: (error = busy()) => then(refuse)(error) });
    });
  const api = Object.fromEntries(["scenes", "scene", "methods", "catalog", "derive", "simulate"].map((name) => [name, pose(name)]));
  const all = (/** @type {string} */ name) => asked.filter((one) => one.name === name);
  return {
    api: /** @type {import("../../frontend/model/api.js").Api} */ (/** @type {any} */ (api)),
    asked: () => asked.map(({ name }) => name),
    all,
    /** The latest question of its kind. @param {string} name @returns {Question} */
    last: (name) => /** @type {Question} */ (all(name).at(-1)),
  };
}

/** @typedef {import("../../frontend/model/state.js").State} State */

/**
 * A page about the scene "swing" in English, which asks such a server. Time stands still until `pass` lets it go on.
 * @param {Partial<State>} [patch]
 */
export function page(patch = {}) {
  mock.timers.reset();
  mock.timers.enable({ apis: ["setTimeout", "Date"] });
  const place = { ...HOME, scene: "swing", lang: "en", ...patch.place };
  const store = createStore(/** @type {State} */ (/** @type {any} */ ({ ...START, scene, ...patch, place })));
  const [asked, clock] = [server(), createClock()];
  const pass = async (/** @type {number} */ ms) => {
    await settled();
    mock.timers.tick(ms);
    await settled();
  };
  return { ...asked, store, clock, pass, get: store.get, session: createSession(store, asked.api, clock) };
}

/** Another document than any of the library. */
export const own = { format: 1, coordinates: [{ name: "u" }], parameters: [{ name: "k", value: 3 }] };
