/** A drawing for a scene that brings none, found in its motion: rods keep their length, supports stay at rest. */

/** @typedef {import("../types.js").Scene} Scene */
/** @typedef {import("../types.js").Trajectory} Trajectory */
/** @typedef {import("../types.js").Element} Element */
/** @typedef {{from: string, to: string}} Link */

/** Lengths and places that differ by less than this part of the scene's size are equal. */
const EQUAL = 1e-4;
/** Samples looked at. */
const LOOKS = 24;

/**
 * @param {Scene} scene @param {Trajectory} trajectory
 * @returns {Element[]}
 */
export function sketchOf(scene, trajectory) {
  const paths = pathsOf(trajectory);
  const size = sizeOf(paths);
  const rods = rodsOf(scene, paths, size * EQUAL);
  const coils = scene.loads
    .filter(joins)
    .map((load) => ({ kind: load.kind, from: load.from, to: load.to, load: load.name }));
  const held = [...new Set([...rods, ...coils].flatMap(({ from, to }) => [from ?? "", to ?? ""]))].filter((place) =>
    isPoint(scene, place),
  );
  return [
    ...held.flatMap((place) => support(place, paths[place] ?? [], size * EQUAL)),
    ...scene.bodies.filter(hasPlace).map((body) => ({ kind: "trail", at: body.name })),
    ...coils,
    ...rods.map((rod) => ({ kind: "rod", ...rod })),
    ...rods.filter(({ from }) => isPoint(scene, from)).map(({ from }) => ({ kind: "pivot", at: from })),
    ...(scene.dimension === 2 ? rods.flatMap((rod) => angles(scene, trajectory, paths, rod)) : []),
    ...scene.loads
      .filter(({ kind }) => kind === "force" || kind === "gravity")
      .map((load) => ({ kind: "force", load: load.name })),
    ...scene.bodies.filter(hasPlace).map((body) => ({ kind: "bob", at: body.name })),
  ];
}

/** @param {Scene} scene @param {string} place */
const isPoint = (scene, place) => scene.points.some((point) => point.name === place);
/** @param {import("../types.js").Body} body */
const hasPlace = (body) => body.kind !== "continuum";
/** @param {import("../types.js").Load} load */
const joins = (load) => (load.kind === "spring" || load.kind === "damper") && Boolean(load.from && load.to);

/** A few moments of the motion. @param {Trajectory} trajectory @returns {Record<string, number[][]>} */
function pathsOf({ positions, t }) {
  const looks = Array.from({ length: LOOKS }, (_, i) => Math.round((i * (t.length - 1)) / (LOOKS - 1)));
  return Object.fromEntries(
    Object.entries(positions).map(([name, path]) => [name, looks.map((i) => path[i] ?? path[0])]),
  );
}

/** @param {number[]} a @param {number[]} b */
const distance = (a, b) => Math.hypot(...a.map((x, c) => x - b[c]));

/** @param {Record<string, number[][]>} paths */
function sizeOf(paths) {
  return Math.max(1e-9, ...Object.values(paths).flat().flat().map(Math.abs).filter(Number.isFinite));
}

/** @param {number[]} values */
const spread = (values) => Math.max(...values) - Math.min(...values);

/**
 * One rod to each body that moves: from the last place before it, points first, that keeps its distance.
 * @param {Scene} scene @param {Record<string, number[][]>} paths @param {number} equal
 * @returns {Link[]}
 */
function rodsOf(scene, paths, equal) {
  const bodies = scene.bodies.filter(hasPlace);
  return bodies.flatMap(({ name: to }, index) => {
    const path = paths[to];
    if (!path) return [];
    const before = [...bodies.slice(0, index), ...scene.points]
      .map(({ name }) => name)
      .filter((name) => name !== to && paths[name]);
    const from = before.find((name) => {
      const lengths = path.map((place, i) => distance(place, paths[name][i]));
      const turns = path.some((place, i) =>
        place.some((x, c) => Math.abs(x - paths[name][i][c] - (path[0][c] - paths[name][0][c])) > equal),
      );
      return turns && spread(lengths) < equal && lengths[0] > equal;
    });
    return from ? [{ from, to }] : [];
  });
}

/** Ground where a held point rests, rails where it keeps to a line. @param {string} at @param {number[][]} path @param {number} equal @returns {Element[]} */
function support(at, path, equal) {
  const [across, along] = [0, 1].map((c) => (path.length ? spread(path.map((place) => place[c])) : 0));
  if (across < equal && along < equal) return [{ kind: "ground", at }];
  if (across < equal) return [{ kind: "guide", at, direction: "vertical" }];
  return along < equal ? [{ kind: "guide", at, direction: "horizontal" }] : [];
}

/**
 * The coordinate that turns a rod, counted from the second axis as everywhere in the lecture.
 * @param {Scene} scene @param {Trajectory} trajectory @param {Record<string, number[][]>} paths @param {Link} rod
 * @returns {Element[]}
 */
function angles(scene, { coordinates, t }, paths, { from, to }) {
  if (verticalOf(scene) !== "down") return [];
  const turned = paths[to].map(([x, y], i) => Math.atan2(x - paths[from][i][0], y - paths[from][i][1]));
  const found = scene.coordinates.find(
    ({ name, unit }) =>
      unit === "rad" &&
      turned.every((angle, i) => {
        const value = coordinates[name]?.[Math.round((i * (t.length - 1)) / (LOOKS - 1))];
        return value !== undefined && Math.abs(Math.sin((value - angle) / 2)) < 1e-3;
      }),
  );
  return found ? [{ kind: "angle", at: from, coordinate: found.name }] : [];
}

/** Along the last component gravity pulls to greater values, 1, to smaller ones, −1, or not at all. @param {Scene} scene */
export function pullOf(scene) {
  const pull = String(scene.loads.find((load) => load?.kind === "gravity")?.acceleration?.at(-1) ?? "0").trim();
  return pull === "0" ? 0 : pull.startsWith("-") ? -1 : 1;
}

/** Where the last component grows: as the drawing says, else along gravity. @param {Scene} scene @returns {"up" | "down"} */
export const verticalOf = (scene) => scene.drawing?.vertical || (pullOf(scene) > 0 ? "down" : "up");
