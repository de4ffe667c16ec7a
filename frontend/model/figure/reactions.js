/**
 * Reactions of constraints, of what is released and of dry friction as arrows: a rod pulls both of its ends together; of any other
 * reaction the force F(P) at the one place P that does the same work, Qᵢ = F · ∂r(P)/∂qᵢ for every coordinate, where there is one.
 */

/** @typedef {import("../types.js").Snapshot} Snapshot */
/** @typedef {import("../types.js").Scene} Scene */
/** @typedef {import("../kinematics/kinematics.js").Kinematics} Kinematics */
/** @typedef {{place: string, force: number[], plain: boolean}} Reaction  plain: as large as the multiplier */

/** Part of the generalized forces that a force at one place may leave over. */
const LEFT = 1e-4;
/** ε of least squares, as a part of the largest entry. */
const SMALL = 1e-7;

/** @param {readonly number[]} a @param {readonly number[]} b */
const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);

/**
 * The smallest F of least squares with J F = Q, by elimination with pivots on (JᵀJ + ε) F = JᵀQ: across the only way that
 * a place can go it has no component. ε is small beside JᵀJ and large beside the errors of its difference quotients.
 * @param {readonly number[][]} rows  J: a row for each coordinate @param {readonly number[]} given  Q
 */
function leastSquares(rows, given) {
  const size = rows[0]?.length ?? 0;
  const columns = Array.from({ length: size }, (_, c) => rows.map((row) => row[c]));
  const system = columns.map((column) => [...columns.map((other) => dot(column, other)), dot(column, given)]);
  const scale = Math.max(...system.map((row, i) => row[i]), 0);
  system.forEach((row, i) => (row[i] += SMALL * scale));
  /** @type {number[]} */
  const pivots = [];
  for (let c = 0; c < size; c += 1) {
    const free = system.map((_, i) => i).filter((i) => !pivots.includes(i));
    const pivot = free.reduce((best, i) => (Math.abs(system[i][c]) > Math.abs(system[best][c]) ? i : best), free[0]);
    if (!(Math.abs(system[pivot][c]) > 0)) return columns.map(() => NaN);
    pivots.push(pivot);
    system.forEach((row, i) => {
      if (i === pivot) return;
      const part = row[c] / system[pivot][c];
      row.forEach((_, k) => (row[k] -= part * system[pivot][k]));
    });
  }
  return pivots.map((pivot, c) => system[pivot][size] / system[pivot][c]);
}

/** How every place moves with each coordinate: ∂r/∂qᵢ by place. @param {Kinematics} kinematics @param {Snapshot} now @param {readonly string[]} coordinates */
function slopesOf(kinematics, { coordinates: q, t }, coordinates) {
  const along = coordinates.map((name) => kinematics.slope(q, t, { [name]: 1 }));
  const places = Object.keys(along[0] ?? {});
  return Object.fromEntries(places.map((place) => [place, along.map((slope) => slope[place])]));
}

/**
 * The force at each place that alone does the work of the generalized forces.
 * @param {Record<string, number[][]>} slopes @param {readonly number[]} given  Qᵢ @param {number} multiplier @returns {Reaction[]}
 */
function alone(slopes, given, multiplier) {
  const size = Math.hypot(...given);
  if (!(size > 0)) return [];
  return Object.entries(slopes).flatMap(([place, rows]) => {
    const force = leastSquares(rows, given);
    const left = Math.hypot(...rows.map((row, i) => dot(row, force) - given[i]));
    const plain = Math.abs(Math.hypot(...force) - Math.abs(multiplier)) < 1e-3 * Math.abs(multiplier);
    return left < LEFT * size ? [{ place, force, plain }] : [];
  });
}

/** A rod pulls at those of its ends that can move. @param {Record<string, number[][]>} slopes @param {Snapshot} now @param {[string, string]} ends @param {number} pull @returns {Reaction[]} */
function pulled(slopes, { positions }, [from, to], pull) {
  if (!positions[from] || !positions[to] || !Number.isFinite(pull)) return [];
  const span = positions[to].map((x, c) => x - positions[from][c]);
  const length = Math.hypot(...span);
  return [
    { place: to, force: span.map((x) => (-pull * x) / length), plain: true },
    { place: from, force: span.map((x) => (pull * x) / length), plain: true },
  ].filter(({ place }) => slopes[place]?.some((row) => Math.hypot(...row) > 0));
}

/**
 * Where dry friction acts, which does the work R δq of its coordinate alone, and with which force in newtons; empty where
 * it is a moment, or where no place moves as far as its coordinate.
 * @param {Scene} scene @param {Kinematics} kinematics @param {Snapshot} now @param {Record<string, number>} frictions  R by load @param {string} name
 * @returns {Reaction[]}
 */
export function frictionOf(scene, kinematics, now, frictions, name) {
  const load = scene.loads.find((candidate) => candidate.name === name);
  const given = kinematics.free.map((coordinate) => (coordinate === load?.coordinate ? (frictions[name] ?? 0) : 0));
  const isMoment = scene.coordinates.find((one) => one.name === load?.coordinate)?.unit === "rad";
  if (isMoment) return [];
  return alone(slopesOf(kinematics, now, kinematics.free), given, frictions[name] ?? 0)
    .filter(({ plain }) => plain)
    .slice(0, 1);
}

/**
 * Where a constraint acts, and with which force in newtons; empty where no force at one place does its work.
 * @param {Scene} scene @param {Kinematics} kinematics @param {Snapshot} now @param {Record<string, number>} multipliers @param {string} name
 * @returns {Reaction[]}
 */
export function reactionOf(scene, kinematics, now, multipliers, name) {
  const constraint = (scene.constraints ?? []).find((candidate) => candidate.name === name);
  const found = kinematics.reactions(now, multipliers).find((one) => one.constraint === name);
  if (!constraint || !found) return [];
  const slopes = slopesOf(kinematics, now, kinematics.free);
  const { from, to } = constraint;
  if (from && to) return pulled(slopes, now, [from, to], found.multiplier);
  return alone(
    slopes,
    kinematics.free.map((coordinate) => found.forces[coordinate] ?? 0),
    found.multiplier,
  ).slice(0, 1);
}

/**
 * The rod or string that is drawn with a length, between two places; none where several are, or where what was released is no
 * single rod.
 * @param {Scene} scene @param {Kinematics} kinematics @param {string} name @returns {[string, string] | null}
 */
function rodOf(scene, kinematics, name) {
  if (!["length", "rod"].includes(kinematics.held[name])) return null;
  const drawn = (scene.drawing?.elements ?? []).filter(
    ({ kind, label }) => (kind === "rod" || kind === "string") && label === name,
  );
  const [{ from, to } = {}] = drawn;
  return drawn.length === 1 && typeof from === "string" && typeof to === "string" ? [from, to] : null;
}

/**
 * Where what was released is held, and with which force in newtons: by a rod at those of its ends that can move, of one with mass
 * at its near end; else by the force at one place that works on what was released alone.
 * @param {Scene} scene @param {Kinematics} kinematics @param {Snapshot} now @param {Record<string, number>} multipliers  Z by name @param {string} name
 * @returns {Reaction[]}
 */
export function releasedOf(scene, kinematics, now, multipliers, name) {
  const force = multipliers[name];
  if (!Number.isFinite(force)) return [];
  const slopes = slopesOf(kinematics, now, kinematics.free);
  const rod = rodOf(scene, kinematics, name);
  if (rod) return kinematics.held[name] === "rod" ? atNearEnd(now, rod, -force) : pulled(slopes, now, rod, -force);
  const along = Object.entries(kinematics.displacements[name]?.(now) ?? {});
  const wider = along.map(([place, slope]) => [place, [...(slopes[place] ?? []), slope]]);
  const found = alone(Object.fromEntries(wider), [...kinematics.free.map(() => 0), force], force);
  return [...found.filter(({ plain }) => plain), ...found].slice(0, 1);
}

/** What a rod with mass does to the place that it hangs on. @param {Snapshot} now @param {[string, string]} ends @param {number} pull @returns {Reaction[]} */
function atNearEnd({ positions }, [from, to], pull) {
  if (!positions[from] || !positions[to]) return [];
  const span = positions[to].map((x, c) => x - positions[from][c]);
  const length = Math.hypot(...span);
  return [{ place: from, force: span.map((x) => (pull * x) / length), plain: true }];
}

/**
 * The two ends of the rod that a reaction belongs to, and its force, positive in tension; null where it is no rod's.
 * @param {Scene} scene @param {Kinematics} kinematics @param {Snapshot} now @param {Record<string, number>} multipliers @param {string} name
 * @returns {{ends: [string, string], tension: number} | null}
 */
export function stressOf(scene, kinematics, now, multipliers, name) {
  const rod = rodOf(scene, kinematics, name);
  if (rod) return { ends: rod, tension: -multipliers[name] };
  const { from, to } = (scene.constraints ?? []).find((candidate) => candidate.name === name) ?? {};
  const found = from && to ? kinematics.reactions(now, multipliers).find((one) => one.constraint === name) : null;
  return from && to && found ? { ends: [from, to], tension: found.multiplier } : null;
}
