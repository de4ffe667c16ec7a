/** The numbers of a motion as the server packs them: in less room than decimals, and quicker to write and to read. */

/** @typedef {import("./types.js").Trajectory} Trajectory */
/** @typedef {import("./types.js").Answered<"/simulations">} Answer */

const DOUBLE = 8;

/**
 * Numbers whose bytes come plane by plane: all first bytes, then all second ones …, little-endian, as is every machine
 * that a browser runs on.
 * @param {string} packed @returns {number[]}
 */
export function numbersOf(packed) {
  const planes = atob(packed);
  const doubles = new Float64Array(planes.length / DOUBLE);
  const bytes = new Uint8Array(doubles.buffer);
  for (let plane = 0, from = 0; plane < DOUBLE; plane += 1)
    for (let to = plane; to < bytes.length; to += DOUBLE, from += 1) bytes[to] = planes.charCodeAt(from);
  return Array.from(doubles);
}

/** @typedef {Answer["t"]} Column */
/** @typedef {NonNullable<Answer["multipliers"]>[string]} Partial */
/** @typedef {NonNullable<Answer["positions"]>[string]} Rows */

/** @param {Column} column */
const asNumbers = (column) => (typeof column === "string" ? numbersOf(column) : column);

/** The same where not all is determined: null is not a number. @param {Partial} column */
const asPartial = (column) => (typeof column === "string" ? numbersOf(column) : column.map((value) => value ?? NaN));

/** @template C, W @param {Record<string, C> | null | undefined} columns @param {(column: C) => W} change */
const each = (columns, change) =>
  columns && Object.fromEntries(Object.entries(columns).map(([name, column]) => [name, change(column)]));

/** The motion with plain numbers in all of its columns. @param {Answer} answer @returns {Trajectory} */
export function unpacked(answer) {
  const t = asNumbers(answer.t);
  /** @param {Rows} rows */
  const asRows = (rows) => {
    if (typeof rows !== "string") return rows;
    const numbers = numbersOf(rows);
    const wide = t.length ? numbers.length / t.length : 0;
    return t.map((_, i) => numbers.slice(i * wide, (i + 1) * wide));
  };
  const { coordinates, rates, positions, loads, multipliers, friction, contacts, energy } = answer;
  const { drift, works, power, work, ...energies } = energy ?? {};
  const columns = power && work ? { ...energies, power, work } : energies;
  const made = {
    ...answer,
    columns: "numbers",
    t,
    coordinates: each(coordinates, asNumbers),
    rates: each(rates, asNumbers),
    positions: each(positions, asRows),
    loads: each(loads, asRows),
    multipliers: each(multipliers, asPartial),
    friction: each(friction, ({ force, largest }) => ({ force: asPartial(force), largest: asNumbers(largest) })),
    contacts: each(contacts, ({ force, unit }) => ({ force: asPartial(force), unit })),
    energy: energy && { ...each(columns, asNumbers), drift, works },
  };
  return /** @type {Trajectory} */ (made);
}
