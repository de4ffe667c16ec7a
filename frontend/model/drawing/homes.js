/**
 * Which symbols are at home in which element of a drawing: a mass in its body, a stiffness in its spring, a length in its
 * rod. What is lit in a formula is lit there, and the other way round.
 */

import { parameterClass } from "../symbols.js";

/** @typedef {import("../types.js").Element} Element */
/** @typedef {import("../types.js").Scene} Scene */

const NAME = /[A-Za-z_]\w*/g;
/** Elements that show a body, in whose position, mass or moments of inertia a symbol stands. */
const BODIES = /^(bob|disc|hoop|block|cart|top|wheel|rod|string|spring)$/;

/** Members of a load that are no expressions. */
const NAMES = new Set(["name", "kind", "at", "from", "to", "latex", "coordinate"]);

/** The names in expressions, however they are nested. @param {unknown} given @returns {Set<string>} */
function namesIn(given) {
  if (typeof given === "string") return new Set(given.match(NAME) ?? []);
  return new Set(Array.isArray(given) ? given.flatMap((one) => [...namesIn(one)]) : []);
}

/** Expressions of a load, without its name and where it acts. @param {Scene} scene @param {string | undefined} name */
function inLoad({ loads }, name) {
  const load = name === undefined ? undefined : loads.find((candidate) => candidate.name === name);
  const expressions = Object.entries(load ?? {}).filter(([member]) => !NAMES.has(member));
  return namesIn(expressions.map(([, expression]) => expression));
}

/** @param {Scene} scene @param {string | undefined} place */
const bodyAt = ({ bodies }, place) => bodies.find(({ name }) => name === place);

/** What an element says by itself: its letter, its sizes, its load, its coordinate's guide, the mass of its body. @param {Scene} scene @param {Element} element @returns {Set<string>} */
function own(scene, { kind, at, load, label, coordinate, radius, width, height }) {
  const guide = (scene.guides ?? []).find((candidate) => candidate.coordinate === coordinate);
  const body = BODIES.test(kind) ? bodyAt(scene, at) : undefined;
  const gravity = kind === "weight" ? scene.loads.find((candidate) => candidate.kind === "gravity") : undefined;
  return new Set([
    ...namesIn([label, radius, width, height].filter((size) => typeof size === "string")),
    ...inLoad(scene, load ?? gravity?.name),
    ...namesIn(guide?.value),
    ...namesIn([body?.mass, body?.inertia]),
  ]);
}

/** What moves with a place: the names in its position, and in the guides that move it. @param {Scene} scene @param {string | undefined} place */
function behind(scene, place) {
  const body = bodyAt(scene, place);
  const point = scene.points.find(({ name }) => name === place);
  const names = namesIn(
    [
      body?.position,
      point?.position,
      body?.inertia,
      body?.mass,
      body?.density,
      body?.angular_velocity,
      body?.angle,
    ].filter(Boolean),
  );
  const guides = (scene.guides ?? []).filter(({ coordinate }) => names.has(coordinate));
  return new Set([...names, ...guides.flatMap(({ value }) => [...namesIn(value)])]);
}

/** Whether two sets have a name in common. @param {Set<string>} a @param {readonly string[]} b */
const share = (a, b) => b.some((name) => a.has(name));

/** The coordinates on which bodies and loads depend that a parameter belongs to. @param {Scene} scene @param {string} name */
function dependsOn(scene, name) {
  const sets = [
    ...scene.bodies.map((body) => behind(scene, body.name)),
    ...scene.loads.map((load) => inLoad(scene, load.name)),
  ];
  const belonging = sets.filter((names) => names.has(name));
  return scene.coordinates.map((one) => one.name).filter((one) => belonging.some((names) => names.has(one)));
}

/**
 * For every element the classes of its parameters. A parameter that is at home nowhere is with the elements whose place
 * depends on it, else with those that move by the same coordinates, else with all bodies.
 * @param {Scene} scene @param {readonly Element[]} elements @returns {string[]}
 */
export function homesOf(scene, elements) {
  const homes = elements.map((element) => own(scene, element));
  const settled = new Set(homes.flatMap((home) => [...home]));
  const moved = elements.map(({ kind, at, from, to }) =>
    BODIES.test(kind) ? new Set([at, from, to].flatMap((place) => [...behind(scene, place)])) : new Set(),
  );
  const found = elements.map((_, i) => scene.parameters.filter(({ name }) => homes[i].has(name)));
  for (const parameter of scene.parameters.filter(({ name }) => !settled.has(name))) {
    const by = [[parameter.name], dependsOn(scene, parameter.name)].find((names) =>
      moved.some((each) => share(each, names)),
    );
    elements.forEach(({ kind }, i) => {
      if (by ? share(moved[i], by) : BODIES.test(kind)) found[i].push(parameter);
    });
  }
  const bodies = bodiesOf(scene, elements, moved);
  const kept = constraintsOf(scene, elements, moved);
  const loads = loadsOf(scene, elements, moved);
  return found.map((parameters, i) =>
    [
      ...parameters.map(({ name }) => parameterClass(scene, name)),
      ...bodies[i].map((name) => `body-${name}`),
      ...kept[i].map((name) => `constraint-${name}`),
      ...loads[i].map((name) => `load-${name}`),
    ].join(" "),
  );
}

/**
 * Bodies that no element stands for by itself (a rod that has mass, a hoop about its hub): with the elements that move as
 * they do, else with those that share a coordinate.
 * @param {Scene} scene @param {readonly Element[]} elements @param {readonly Set<string>[]} moved @returns {string[][]}
 */
function bodiesOf(scene, elements, moved) {
  const coordinates = scene.coordinates.map(({ name }) => name);
  const of = (/** @type {Set<string>} */ names) => coordinates.filter((name) => names.has(name));
  const found = elements.map(() => /** @type {string[]} */ ([]));
  const shown = new Set(
    elements.filter(({ kind }) => !/^(rod|string)$/.test(kind) && BODIES.test(kind)).flatMap(({ at, to }) => [at, to]),
  );
  for (const { name, angle, position } of scene.bodies.filter((body) => !shown.has(body.name))) {
    const own = of(new Set([...behind(scene, name), ...namesIn([angle, position].filter(Boolean))]));
    const alike = moved.map((names) => of(names).join() === own.join() && own.length > 0);
    elements.forEach(({ kind }, i) => {
      const same = alike.some((one, j) => one && BODIES.test(elements[j].kind)) ? alike[i] : share(moved[i], own);
      if (BODIES.test(kind) && same) found[i].push(name);
    });
  }
  return found;
}

/**
 * What keeps a constraint: the rod between its two places, else the bodies that move by coordinates that it binds.
 * @param {Scene} scene @param {readonly Element[]} elements @param {readonly Set<string>[]} moved @returns {string[][]}
 */
function constraintsOf({ constraints, coordinates }, elements, moved) {
  const found = elements.map(() => /** @type {string[]} */ ([]));
  for (const { name, from, to, equation } of constraints ?? []) {
    const between = elements.map((element) => Boolean(from) && element.from === from && element.to === to);
    const names = namesIn(equation ?? "");
    const bound = coordinates.map((one) => one.name).filter((one) => names.has(one));
    elements.forEach((_, i) => {
      if (between.includes(true) ? between[i] : share(moved[i], bound)) found[i].push(name ?? "");
    });
  }
  return found;
}

/**
 * Loads that no element shows: with the bodies that move by what is in them, else by where they act.
 * @param {Scene} scene @param {readonly Element[]} elements @param {readonly Set<string>[]} moved @returns {string[][]}
 */
function loadsOf(scene, elements, moved) {
  const found = elements.map(() => /** @type {string[]} */ ([]));
  const coordinates = scene.coordinates.map(({ name }) => name);
  const hidden = scene.loads.filter(
    ({ kind, name }) => kind !== "gravity" && !elements.some(({ load }) => load === name),
  );
  for (const load of hidden) {
    const names = new Set([...inLoad(scene, load.name), ...behind(scene, load.at)]);
    const by = coordinates.filter((name) => names.has(name));
    elements.forEach((_, i) => {
      if (share(moved[i], by)) found[i].push(load.name);
    });
  }
  return found;
}
