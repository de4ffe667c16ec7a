/** The two charts of the h-slider as paths: the functions with their neighbours, and error against h. */

/** @typedef {import("./lab.js").Quotient} Quotient */
/** @typedef {import("../types.js").Contract["QuotientErrors"]} Errors */
/** @typedef {{width: number, height: number, em: number}} Size */
/** @typedef {{at: number, text: string | number}} Tick */
/** @typedef {{left: number, right: number, top: number, bottom: number}} Frame */
/** @typedef {{className: string, d: string}} Line */
/** @typedef {{className: string, x: number, y: number, text: string}} Note */

const FLOOR = -18;
const CEILING = 2;
const DECADES = 16;

/** @param {Size} size @returns {Frame} */
export const frameOf = ({ width, height, em }) => ({
  left: 4.8 * em,
  right: width - 0.8 * em,
  top: 0.7 * em,
  bottom: height - 2.6 * em,
});

/** @param {number} low @param {number} high @param {number} from @param {number} to */
const scale = (low, high, from, to) => (/** @type {number} */ value) =>
  from + ((value - low) / (high - low || 1)) * (to - from);

/** A path through points; where one is missing it is broken. @param {([number, number] | null)[]} points */
export function pathOf(points) {
  let pen = "M";
  return points
    .map((point) => {
      const piece = point ? `${pen}${point[0].toFixed(1)} ${point[1].toFixed(1)}` : "";
      pen = point ? "L" : "M";
      return piece;
    })
    .join("");
}

/** At most `count` round numbers between two. @param {number} low @param {number} high @param {number} count */
export function ticksBetween(low, high, count) {
  const raw = (high - low) / count;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = power * ([1, 2, 5, 10].find((lead) => lead * power >= raw * 0.999) ?? 10);
  const first = Math.ceil(low / step - 1e-9);
  return Array.from({ length: Math.floor(high / step + 1e-9) - first + 1 }, (_, i) =>
    Number(((first + i) * step).toPrecision(12)),
  );
}

/**
 * Each function x(t), and its neighbour x(t) + h v(t); the range is that of h = 1, so that nothing jumps.
 * @param {Quotient} quotient @param {number} h @param {Size} size
 */
export function curvesChart({ curves }, h, size) {
  const frame = frameOf(size);
  const names = Object.keys(curves.functions);
  const moved = (/** @type {string} */ name, /** @type {number} */ by) =>
    curves.functions[name].map((value, i) =>
      value === null || curves.direction[name][i] === null ? null : value + by * Number(curves.direction[name][i]),
    );
  const values = names.flatMap((name) => [0, 1].flatMap((by) => moved(name, by))).filter((value) => value !== null);
  const [low, high] = values.length ? [Math.min(...values), Math.max(...values)] : [0, 1];
  const room = 0.06 * (high - low || 1);
  const times = /** @type {const} */ ([curves.t[0], curves.t[curves.t.length - 1]]);
  const x = scale(...times, frame.left, frame.right);
  const y = scale(low - room, high + room, frame.bottom, frame.top);
  const line = (/** @type {(number | null)[]} */ list) =>
    pathOf(list.map((value, i) => (value === null ? null : [x(curves.t[i]), y(value)])));
  return {
    frame,
    across: ticksBetween(...times, 5).map((value) => ({ at: x(value), text: value })),
    up: ticksBetween(low - room, high + room, 5).map((value) => ({ at: y(value), text: value })),
    lines: names.flatMap((name, i) => [
      { className: `q-${i} plain`, d: line(curves.functions[name]) },
      { className: `q-${i} neighbour`, d: line(moved(name, h)) },
    ]),
    between: names.map((name, i) => ({
      className: `q-${i} between`,
      d: bars(curves.functions[name], moved(name, h), (k) => x(curves.t[k]), y),
    })),
    at: curves.at === null ? null : x(curves.at),
  };
}

/** Thin bars from a curve to its neighbour: h v(t). @param {(number | null)[]} from @param {(number | null)[]} to @param {(k: number) => number} x @param {(value: number) => number} y */
function bars(from, to, x, y) {
  const ends = from.map((value, k) =>
    k % 8 || value === null || to[k] === null
      ? ""
      : `M${x(k).toFixed(1)} ${y(value).toFixed(1)}V${y(Number(to[k])).toFixed(1)}`,
  );
  return ends.join("");
}

/**
 * |quotient − derivative| over h, both logarithmic; an error of exactly zero stands at the foot.
 * Truncation falls with slope 1 (one-sided) or 2 (central); rounding rises as 1/h.
 * @param {Quotient} quotient @param {Size} size
 */
export function errorChart(quotient, size) {
  const frame = frameOf(size);
  const x = scale(-DECADES, 0, frame.left, frame.right);
  const y = scale(FLOOR, CEILING, frame.bottom, frame.top);
  const kinds = /** @type {const} */ (["one_sided", "central"]);
  const point = (/** @type {number} */ h, /** @type {number | null} */ error) => {
    const height = error === null ? null : Math.log10(Math.abs(error));
    return height === null
      ? null
      : /** @type {[number, number]} */ ([x(Math.log10(h)), y(Math.min(CEILING, Math.max(FLOOR, height)))]);
  };
  const rounding = roundingLevel(quotient);
  const law = quotient.h.map((h) =>
    rounding === null || rounding / h < 10 ** FLOOR || rounding / h > 10 ** CEILING ? null : point(h, rounding / h),
  );
  return {
    frame,
    across: [-16, -12, -8, -4, 0].map((power) => ({ at: x(power), text: power })),
    up: [-16, -12, -8, -4, 0].map((power) => ({ at: y(power), text: power })),
    dots: kinds.map((kind) => ({
      className: kind,
      points: quotient[kind].error.map((error, i) => point(quotient.h[i], error)),
    })),
    truncation: kinds.map((kind) => ({
      className: kind,
      d: pathOf(
        quotient[kind].truncation.map((part, i) =>
          Math.abs(part ?? 0) < 10 ** FLOOR ? null : point(quotient.h[i], part),
        ),
      ),
    })),
    rounding: pathOf(law),
    optima: kinds.flatMap((kind) =>
      quotient[kind].predicted
        ? [{ className: kind, x: x(Math.log10(quotient[kind].predicted)), h: quotient[kind].predicted }]
        : [],
    ),
    x: (/** @type {number} */ h) => x(Math.log10(h)),
    notes: [...kinds.flatMap((kind) => slopeNote(kind, quotient, point)), ...roundingNote(quotient, rounding, point)],
  };
}

/** What rounding times h is, typically; null where there is none. @param {Quotient} quotient */
export function roundingLevel({ one_sided: { rounding }, h }) {
  const levels = rounding
    .flatMap((part, i) => (part && h[i] < 1e-3 ? [Math.abs(part) * h[i]] : []))
    .sort((a, b) => a - b);
  return levels.length ? levels[Math.floor(levels.length * 0.75)] : null;
}

/** "h" or "h²" at its slope, where it is seen best. @param {"one_sided" | "central"} kind @param {Quotient} quotient @param {(h: number, error: number | null) => [number, number] | null} point @returns {Note[]} */
function slopeNote(kind, quotient, point) {
  const [size, text] = kind === "central" ? [1e-3, "∝ h²"] : [1e-4, "∝ h"];
  const index = quotient.h.findIndex((h) => h <= size * 1.01);
  const part = quotient[kind].truncation[index];
  const place = part && Math.abs(part) > 10 ** (FLOOR + 1) ? point(quotient.h[index], part) : null;
  return place ? [{ className: kind, x: place[0], y: place[1], text }] : [];
}

/** @param {Quotient} quotient @param {number | null} level @param {(h: number, error: number | null) => [number, number] | null} point @returns {Note[]} */
function roundingNote(quotient, level, point) {
  const index = quotient.h.findIndex((h) => h <= 1.01e-12);
  const place = level === null ? null : point(quotient.h[index], level / quotient.h[index]);
  return place ? [{ className: "rounding", x: place[0], y: place[1], text: "∝ 1/h" }] : [];
}

/** The place in the list of h that is nearest to a pixel of the chart. @param {readonly number[]} h @param {number} pixel @param {Size} size */
export function sizeAt(h, pixel, size) {
  const { left, right } = frameOf(size);
  const share = 1 - Math.max(0, Math.min(1, (pixel - left) / (right - left)));
  return Math.round(share * (h.length - 1));
}
