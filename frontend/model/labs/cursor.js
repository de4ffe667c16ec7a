/** A place on a map that the keyboard moves, as column and row of its grid. */

/** @typedef {import("./chart.js").Chart} Chart */
/** @typedef {import("./chart.js").MapTrace} MapTrace */
/** @typedef {{column: number, row: number}} Spot */

const WIDE = 10;
/** @type {Record<string, [number, number]>} */
const WAYS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, -1], ArrowUp: [0, 1] };

/** The map in a chart, if it has one: its trace with x, y, z and who stands on the axes. @param {Chart} chart @returns {MapTrace | null} */
export const mapOf = (chart) =>
  /** @type {MapTrace | undefined} */ (
    chart.data.find(({ meta }) => ["map", "flips", "basins"].includes(meta?.role ?? ""))
  ) ?? null;

/** @param {MapTrace} map @returns {Spot} */
export const middleOf = (map) => ({ column: Math.floor(map.x.length / 2), row: Math.floor(map.y.length / 2) });

/**
 * Where an arrow key leads, with Shift ten places on; null for other keys.
 * @param {Spot} spot @param {string} key @param {boolean} wide @param {MapTrace} map @returns {Spot | null}
 */
export function moved({ column, row }, key, wide, map) {
  const way = WAYS[key];
  if (!way) return null;
  const [right, up] = way.map((one) => one * (wide ? WIDE : 1));
  return { column: within(column + right, map.x.length), row: within(row + up, map.y.length) };
}

/** @param {number} place @param {number} count */
const within = (place, count) => Math.min(Math.max(place, 0), count - 1);

/** What the map says there; it may have become coarser meanwhile. @param {Spot} spot @param {MapTrace} map */
export function seenAt({ column, row }, map) {
  const [i, j] = [within(column, map.x.length), within(row, map.y.length)];
  return {
    x: map.x[i],
    y: map.y[j],
    value: map.z[j]?.[i] ?? null,
  };
}
